#!/bin/sh
# Checks the chunk file on a big-endian machine: tests/machine/run.sh WORLDY
# Bakes a small Earth with both colour formats, and compares what this machine and an IBM S/390, emulated by qemu, read
# and encode. It needs Debian's foreign packages: see machine_packages in .ci/packages.sh.
set -eu
worldy=$(realpath "$1")
cd "$(dirname "$0")/../.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# The rooms that reading a file needs: includes and calls go down only (.ci/layers).
sources="tests/machine/read_whole_file.cpp planet/base/*.cpp planet/spans/*.cpp planet/sphere/*.cpp planet/format/*.cpp"
libraries="-lfmt -lxxhash -lzstd -lsquish"
# Nothing here opens what is installed beside a program.
options='-std=c++20 -O2 -I. -DWORLDY_MODULES="."'
g++ $options $sources -o "$scratch/here" $libraries
s390x-linux-gnu-g++ $options $sources -o "$scratch/there" $libraries
for format in bc1 lossless; do
    "$worldy" bake data/earth/elevation.tif -o "$scratch/$format.chk" --face-size 257 --colour data/earth/colour.jpg \
        --colour-face-size 513 --colour-format $format >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
    "$scratch/here" "$scratch/$format.chk" >"$scratch/read_here"
    qemu-s390x "$scratch/there" "$scratch/$format.chk" >"$scratch/read_there"
    echo "$format here:  $(cat "$scratch/read_here")"
    echo "$format there: $(cat "$scratch/read_there")"
    cmp "$scratch/read_here" "$scratch/read_there"
done
