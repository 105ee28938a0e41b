# The Debian packages that Worldy needs, each with what it is for, and how to install those that are missing.
# Sourced by run.sh and test.sh.

build_packages="\
g++                     C++20 compiler
cmake                   configures the build
ninja-build             runs the build
pkg-config              finds libraries without a CMake package
libglfw3-dev            window and input
libimgui-dev            panels
libopenimageio-dev      reads and writes images
libtiff-dev             where a GeoTIFF lies, which OpenImageIO does not tell
libgdal-dev             reads elevation of any format and projection
libproj-dev             where the coordinates of a raster lie on the planet
libglm-dev              vectors and matrices
libepoxy-dev            OpenGL and EGL entry points
libegl-dev              pictures without a display
libgl1-mesa-dri         OpenGL on machines without a graphics driver
libegl-mesa0            the same, without a display
libexpected-dev         errors as values
libtbb-dev              the bake on all cores
libfmt-dev              messages
libxxhash-dev           checksums of the chunk file
libzstd-dev             colour tiles and recorded flights, and what the benchmark compares the file with
libstb-dev              colour tiles to BC1
libsquish-dev           colour tiles from BC1
libcli11-dev            command line
libtomlplusplus-dev     settings
nlohmann-json3-dev      reports
libspdlog-dev           log
fonts-dejavu-core       a font with Greek letters"

test_packages="\
libgtest-dev            unit tests
libgmock-dev            unit tests
libbenchmark-dev        benchmarks
xvfb                    a display for the window's tests
xauth                   the same
libx11-dev              drops files onto the window in its tests
x11-xserver-utils       says how fine that display is
xdotool                 presses keys in the window's tests
imagemagick             takes their screenshots
gdal-bin                what a bake is measured against
nodejs                  the trace writer in JavaScript
libopenmpi-dev          bakes on several ranks
openmpi-bin             starts them
clang                   fuzzers, and a second compiler
libclang-rt-14-dev      its fuzzer and sanitizers"

ci_packages="\
clang-format            formatting
clang-tidy-22           mistakes and needless includes, in a fourth of the time that the default one takes
qemu-user               a machine of the other byte order
g++-s390x-linux-gnu     programs for it"

# Cross-compile lod_trace.h for Windows.
windows_packages="\
gcc-mingw-w64-x86-64    C compiler for Windows
g++-mingw-w64-x86-64    C++ compiler for Windows"

# Record a trace of CesiumJS. npm comes with other packages of nodejs than Debian's.
browser_packages="\
chromium                runs CesiumJS"
if ! command -v npm >/dev/null; then
    browser_packages="$browser_packages
npm                     fetches CesiumJS"
fi

# install_missing ASSUME_YES PACKAGES...: lines of "package   what for".
install_missing() {
    assume_yes=$1
    shift
    missing=""
    while read -r package reason; do
        if ! dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q "install ok installed"; then
            missing="$missing $package"
            printf '  %-22s %s\n' "$package" "$reason" >&2
        fi
    done <<EOF
$(printf '%s\n' "$@")
EOF
    [ -n "$missing" ] || return 0
    if ! command -v apt-get >/dev/null; then
        echo "These packages are missing; this system has no apt-get, so install their equivalents by hand." >&2
        return 1
    fi
    echo "The packages above are missing." >&2
    as_root=""
    if [ "$(id -u)" != 0 ]; then
        as_root="sudo"
        if [ "$assume_yes" != yes ]; then
            printf 'Install them with sudo apt-get? [y/N] ' >&2
            read -r answer || answer=n
            case "$answer" in [yY]*) ;; *) echo "Nothing was installed." >&2; return 1 ;; esac
        fi
    fi
    $as_root apt-get update -qq &&
        $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >&2
}

# configure PRESET: configures the preset's folder unless that is done. Ninja configures it again when a file changes.
configure() {
    folder=build
    [ "$1" = release ] || folder="build-$1"
    [ -f "$folder/build.ninja" ] || cmake --preset "$1"
}

# configure_tests PRESET: the same with the tests, also in a folder that is configured without them. Under a sanitizer,
# several ranks are tested as threads only, because MPI itself leaks and races.
configure_tests() {
    folder=build mpi=ON
    [ "$1" = release ] || folder="build-$1"
    case "$1" in asan | tsan) mpi=OFF ;; esac
    if [ ! -f "$folder/build.ninja" ] || ! grep -q '^WORLDY_TESTS:BOOL=ON$' "$folder/CMakeCache.txt" ||
        ! grep -q "^WORLDY_MPI:BOOL=$mpi\$" "$folder/CMakeCache.txt"; then
        cmake --preset "$1" -DWORLDY_TESTS=ON -DWORLDY_MPI=$mpi
    fi
}
