#!/bin/sh
# Compares baking with gdalwarp: tests/bake_benchmark.sh [FACE_SIZE [THREADS]]
# Part 1 bakes the bundled Earth image, and lets gdalwarp write as many samples of it, bicubic, to the six faces of
# PROJ's cube (qsc) as uncompressed GeoTIFFs. The two take turns, three times. A bake also makes all coarser levels,
# measures their errors and compresses.
# Part 2 does the same with a raster in UTM, 4000 x 4000: a bake to its natural depth, and gdalwarp to one face of qsc.
# Part 3 bakes a mosaic of 1000 files and prints the memory that it took and how often each sample was read.
# It needs build/worldy, gdal-bin and python3, and 2 GB in the folder for temporary files.
set -eu
cd "$(dirname "$0")/.."
size=${1:-2049}
threads=${2:-$(nproc)}
worldy=build/worldy
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export GDAL_PAM_ENABLED=NO

now() { date +%s.%N; }

# warp: the six faces of qsc; a face reaches from -R to R.
warp() {
    for place in 0,0 0,90 0,180 0,-90 90,0 -90,0; do
        gdalwarp -q -overwrite -r cubic -multi -wo NUM_THREADS="$threads" -wm 256 \
            -s_srs '+proj=longlat +R=6371000' -t_srs "+proj=qsc +lat_0=${place%,*} +lon_0=${place#*,} +R=6371000" \
            -te -6371000 -6371000 6371000 6371000 -ts "$size" "$size" data/earth/elevation.tif "$work/$place.tif"
    done
}

bake() {
    "$worldy" bake data/earth/elevation.tif --face-size "$size" --threads "$threads" -o "$work/earth.chk" --overwrite \
        >"$work/bake.txt" 2>&1
}

# compare SAMPLES: runs `warp` and `bake` in turns, three times, and prints what each needed for so many samples.
compare() {
    : >"$work/times"
    for _ in 1 2 3; do
        for what in warp bake; do
            start=$(now)
            $what
            echo "$what $start $(now)" >>"$work/times"
        done
    done
    python3 - "$work/times" "$1" "$threads" <<'PYTHON'
import statistics, sys
times = {}
for line in open(sys.argv[1]):
    what, start, end = line.split()
    times.setdefault(what, []).append(float(end) - float(start))
samples = int(sys.argv[2])
print(f"{samples / 1e6:.1f} M samples, {sys.argv[3]} threads, median of 3")
for what, seconds in times.items():
    median = statistics.median(seconds)
    print(f"  {what}: {median:.2f} s, {samples / median / 1e6:.2f} M samples/s")
ratio = statistics.median(times["warp"]) / statistics.median(times["bake"])
print(f"  the bake is {ratio:.2f} times as fast as gdalwarp")
PYTHON
}
echo "the Earth, equirectangular"
compare $((6 * size * size))

gdalwarp -q -r cubic -t_srs EPSG:32719 -tr 25 25 -te 350000 6280000 450000 6380000 data/regions/S33W071.tif "$work/utm.tif"
bake() {
    "$worldy" bake "$work/utm.tif" --threads "$threads" -o "$work/utm.chk" --overwrite --json >"$work/utm.json" 2>/dev/null
}
bake
samples=$(python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["samples"])' "$work/utm.json")
side=$(python3 -c 'import math, sys; print(round(math.sqrt(int(sys.argv[1]))))' "$samples")
warp() {
    gdalwarp -q -overwrite -r cubic -multi -wo NUM_THREADS="$threads" -wm 256 \
        -t_srs '+proj=qsc +lat_0=0 +lon_0=-90 +datum=WGS84' -ts "$side" "$side" "$work/utm.tif" "$work/warped.tif"
}
echo "a raster in UTM"
compare "$samples"

# A thousand tiles of one degree, made from the bundled Earth.
mkdir "$work/tiles"
for latitude in $(seq 20 44); do
    for longitude in $(seq 60 99); do
        gdal_translate -q -projwin "$longitude" $((latitude + 1)) $((longitude + 1)) "$latitude" -outsize 600 600 \
            -r cubic -co COMPRESS=DEFLATE -co TILED=YES data/earth/elevation.tif \
            "$work/tiles/N${latitude}E${longitude}.tif"
    done
done
for cells in 1024 8192 65536; do
    "$worldy" bake "$work/tiles/*.tif" --face-size $((cells + 1)) --threads "$threads" -o "$work/tiles.chk" \
        --overwrite --json >"$work/tiles.json" 2>/dev/null
    python3 - "$work/tiles.json" <<'PYTHON'
import json, sys
report = json.load(open(sys.argv[1]))
print(f"1000 files, faces of {report['face_size']}: {report['samples'] / 1e6:.0f} M samples in {report['seconds']:.1f} s, "
      f"{report['peak_memory_bytes'] / 1e6:.0f} MB, each sample read {report['reads_per_sample']:.2f} times "
      f"(once of them for the range of heights)")
PYTHON
done
