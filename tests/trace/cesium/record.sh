#!/bin/sh
# Records a trace of CesiumJS: tests/trace/cesium/record.sh [OUT_FOLDER]
# Writes cesium.lodtrace and cesium.json into the folder, at first build/cesium, and compares them with those beside this
# script. It needs node, npm, chromium and gdal_translate; npm fetches the two packages of package.json into build/cesium/npm
# once. The recording itself uses no network. It takes some minutes without a graphics card.
set -eu
cd "$(dirname "$0")/../../.."
here=tests/trace/cesium
out=${1:-build/cesium}
npm=$PWD/build/cesium/npm

need() {
    command -v "$1" >/dev/null && return
    echo "record.sh: $1 is missing; expected Debian's package $2, or another that has it" >&2
    exit 1
}
need node nodejs
need npm npm
need gdal_translate gdal-bin
chromium=${CHROMIUM:-}
for name in chromium chromium-browser google-chrome; do
    [ -n "$chromium" ] || chromium=$(command -v "$name" || true)
done
if [ -z "$chromium" ]; then
    echo "record.sh: no Chromium; expected Debian's package chromium, or CHROMIUM=path of the program" >&2
    exit 1
fi

mkdir -p "$out" "$npm"
if ! cmp -s "$here/package.json" "$npm/package.json" || [ ! -d "$npm/node_modules/cesium" ]; then
    cp "$here/package.json" "$npm/package.json"
    if ! (cd "$npm" && timeout 600 npm install --ignore-scripts --no-audit --no-fund --no-package-lock --loglevel=error); then
        rm -f "$npm/package.json"
        echo "record.sh: npm could not fetch the packages of $here/package.json; expected a connection to its registry" >&2
        exit 1
    fi
fi
# The Earth of data/, as a page can hold it: 16-bit metres, row by row from the north.
gdal_translate -q -of ENVI -ot Int16 -outsize 2048 1024 -r average data/earth/elevation.tif "$out/heights.bin"
NODE_MODULES=$npm/node_modules timeout 900 node "$here/record.mjs" "$chromium" "$out/heights.bin" "$out"
node "$here/compare.mjs" "$here/cesium.json" "$out/cesium.json"
