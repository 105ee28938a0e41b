#!/bin/sh
# Installs what is missing, builds everything, and runs every test: ./test.sh [--yes] [ctest's arguments]
# PRESET=asan, tsan or clang builds and tests that variant instead of the release.
set -eu
cd "$(dirname "$0")"
assume_yes=no
if [ "${1:-}" = --yes ]; then
    assume_yes=yes
    shift
fi
. .ci/packages.sh
preset=${PRESET:-release}
install_missing "$assume_yes" "$build_packages" "$test_packages"
configure_tests "$preset"
cmake --build --preset "$preset"
folder=build
[ "$preset" = release ] || folder="build-$preset"
# The embedding program wants a display; the window's tests start their own.
display=""
[ -n "${DISPLAY:-}" ] || display='xvfb-run -a -s "-screen 0 1600x1000x24"'
# One more than there are cores: the tests of the window wait for it, and leave a fourth of a core idle each.
eval "$display"' ctest --test-dir "$folder" --output-on-failure -j "$(($(nproc) + 1))" "$@"'
[ "$preset" != release ] || [ $# -gt 0 ] || cat build-fuzz/figures
