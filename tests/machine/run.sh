#!/bin/sh
# Checks the chunk file on a big-endian machine: tests/machine/run.sh WORLDY
# Bakes a small Earth with both colour formats, and compares what this machine and an IBM S/390, emulated by qemu, read
# and encode.
set -eu
worldy=$(realpath "$1")
cd "$(dirname "$0")/../.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# The libraries of the other machine are unpacked here instead of installed: Debian updates them apart from those of this
# machine, and two versions of one library cannot be installed together.
packages="libfmt-dev libsquish-dev libxxhash-dev libzstd-dev"
mkdir -p "$scratch/apt/lists/partial" "$scratch/apt/archives/partial"
cat >"$scratch/apt.conf" <<EOF
APT::Architecture "s390x";
APT::Architectures { "s390x"; };
APT::Sandbox::User "root";
Dir::State "$scratch/apt";
Dir::State::status "/dev/null";
Dir::Cache "$scratch/apt";
EOF
(
    cd "$scratch"
    export APT_CONFIG="$scratch/apt.conf"
    apt-get update -qq
    apt-get download -qq $packages
    for package in *.deb; do dpkg -x "$package" s390x; done
)

# The rooms that reading a file needs: includes and calls go down only (.ci/layers).
sources="tests/machine/read_whole_file.cpp planet/base/*.cpp planet/spans/*.cpp planet/sphere/*.cpp planet/format/*.cpp"
libraries="-lxxhash -lzstd -lsquish"
# Nothing here opens what is installed beside a program.
options='-std=c++20 -O2 -I. -DWORLDY_MODULES="."'
g++ $options $sources -o "$scratch/here" $libraries -lfmt
# Debian has no static library of fmt. Its libsquish runs on several threads.
s390x-linux-gnu-g++ $options -DFMT_HEADER_ONLY -isystem "$scratch/s390x/usr/include" $sources -o "$scratch/there" \
    -static -fopenmp -L"$scratch/s390x/usr/lib/s390x-linux-gnu" $libraries
for format in bc1 lossless; do
    "$worldy" bake data/earth/elevation.tif -o "$scratch/$format.chk" --face-size 257 --colour data/earth/colour.jpg \
        --colour-face-size 513 --colour-format $format >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
    "$scratch/here" "$scratch/$format.chk" >"$scratch/read_here"
    qemu-s390x "$scratch/there" "$scratch/$format.chk" >"$scratch/read_there"
    echo "$format here:  $(cat "$scratch/read_here")"
    echo "$format there: $(cat "$scratch/read_there")"
    cmp "$scratch/read_here" "$scratch/read_there"
done
