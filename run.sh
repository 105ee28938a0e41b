#!/bin/sh
# Installs what is missing, builds Worldy, and runs it: ./run.sh [--yes] [worldy's arguments]
# Without arguments it opens the window on the Earth in data/. --yes installs packages without asking.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
assume_yes=no
if [ "${1:-}" = --yes ]; then
    assume_yes=yes
    shift
fi
. "$here/.ci/packages.sh"
(
    cd "$here"
    install_missing "$assume_yes" "$build_packages"
    configure release
    cmake --build --preset release --target worldy
) >&2
exec "$here/build/worldy" "$@"
