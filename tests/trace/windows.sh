#!/bin/sh
# Compiles planet/trace/lod_trace.h for Windows, as C and as C++, and links an engine that traces itself. Nothing is run.
# It needs windows_packages of .ci/packages.sh.
set -eu
cd "$(dirname "$0")/../.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
warnings="-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror"
for part in "" "#define LOD_TRACE_DISABLE" "#define LOD_TRACE_IMPLEMENTATION"; do
    printf '%s\n#include "planet/trace/lod_trace.h"\n' "$part" >"$scratch/header.c"
    cp "$scratch/header.c" "$scratch/header.cpp"
    # shellcheck disable=SC2086
    x86_64-w64-mingw32-gcc -std=c99 $warnings -O2 -I. -c "$scratch/header.c" -o "$scratch/header.o"
    # shellcheck disable=SC2086
    x86_64-w64-mingw32-g++ -std=c++20 $warnings -O2 -I. -c "$scratch/header.cpp" -o "$scratch/header.o"
done
# shellcheck disable=SC2086
x86_64-w64-mingw32-gcc -std=c99 $warnings -O2 -I. tests/trace/geomipmap_client.c -o "$scratch/client.exe" -lws2_32
echo "lod_trace.h compiles for Windows"
