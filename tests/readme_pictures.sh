#!/bin/bash
# Takes the pictures of the README and the manual: opens Worldy's windows on the Earth under an X server of its own,
# drives them with xdotool, and crops the program's own screenshots.
#     tests/readme_pictures.sh [NAME...]          all of them, or those named, into data/pictures/
# WORLDY is the program, build/worldy by default; OUT another folder for the pictures. Needs Xvfb, xdotool and
# ImageMagick.
here=$(cd "$(dirname "$0")/.." && pwd)
binary=$(realpath "${WORLDY:-$here/build/worldy}")
out=$(realpath -m "${OUT:-$here/data/pictures}")
wanted=" $* "
[ -x "$binary" ] || { echo "there is no $binary; ./run.sh builds it" >&2; exit 2; }
for tool in Xvfb xdotool import convert; do
    command -v $tool >/dev/null || { echo "needs $tool" >&2; exit 2; }
done

work=$(mktemp -d /tmp/worldy.XXXX)
server= worldy= failures=0
trap 'kill $server $worldy 2>/dev/null; rm -rf "$work"' EXIT
mkdir -p "$out" "$work/config" "$work/cache" "$work/shots"
export HOME=$work XDG_CONFIG_HOME=$work/config XDG_CACHE_HOME=$work/cache XDG_PICTURES_DIR=$work/shots
cd "$work" || exit 2
# The shell functions that the window tests use too: click, slide, shown, settled and the like.
sed -n '/windowFunctions = R/,/)sh";/p' "$here/tests/program/window/editor_window.h" | sed '1d;$d' >functions.sh
. ./functions.sh
# A short path, because the pictures show it.
cp -r "$here/data/earth" earth
cp -r "$here/data/regions" regions

Xvfb -displayfd 3 -screen 0 1920x1200x24 -nolisten tcp 3>display.txt 2>/dev/null &
server=$!
for i in $(seq 100); do [ -s display.txt ] && break; sleep 0.1; done
DISPLAY=:$(cat display.txt)
export DISPLAY

# Prints the setting of the camera's initial pose.
pose() { printf 'camera = {latitude_deg = %s, longitude_deg = %s, altitude_m = %s, heading_deg = %s, pitch_deg = %s}\n' "$@"; }
# From the Bay of Bengal to Tibet: chunks of several levels.
above_india() { pose 14 84 1500000 8 -58; }
# Tibet behind the Himalaya.
himalaya() { pose 24.5 83 600000 20 -40; }
window() { printf 'window.width_px = %s\nwindow.height_px = %s\n' "$1" "$2"; }
slow_disk() { printf 'bad_disk.latency_ms = %s\nbad_disk.failure_rate = %s\n' "$1" "$2"; }
# The keys of all panels.
panels=$(sed -n 's/^ *{PanelId::[^"]*"[^"]*", "\([^"]*\)".*/\1/p' "$here/app/settings/panel_list.h")
# Shows one panel alone in a dock of the given width.
only() {
    echo "window.left_width = $2"
    for panel in $panels; do
        [ "$panel" = "$1" ] && echo "panels.$panel = \"left\"" && echo "panels.${panel}_shown = true" && continue
        echo "panels.${panel}_shown = false"
    done
}

# Starts the program on the Earth, or on the source $world, with the settings of stdin.
start() {
    cat >settings.toml
    rm -f items.txt .stderr
    timeout 300 "$binary" "${world:-earth/elevation.tif}" --settings settings.toml --item-map items.txt 2>.stderr </dev/null &
    worldy=$!
    until_true shown viewport/picture || { cat .stderr; failures=$((failures + 1)); }
}
stop() {
    xdotool key --clearmodifiers ctrl+q
    wait $worldy || { echo "the program ended with $?"; cat .stderr; failures=$((failures + 1)); }
    worldy=
}
aside() { xdotool mousemove "${1:-1900}" "${2:-1190}"; sleep 0.5; }
# The program's screenshot of the whole window, as taken.png.
take() {
    local before
    before=$(grep -c 'Screenshot:' .stderr)
    rm -f shots/*
    xdotool key --clearmodifiers shift+F12
    until_true times_said 'Screenshot:' $((before + 1)) || { cat .stderr; failures=$((failures + 1)); }
    mv shots/*.png taken.png
}
asked() { [ "$wanted" = "  " ] || [[ $wanted == *" $1 "* ]]; }
small() { convert "$1" -strip "${@:3}" PNG8:"$2"; }
# The whole window, and the left dock without its empty end.
whole() { take && small taken.png "$out/$1.png" -dither FloydSteinberg -colors 256; }
dock() {
    take
    set -- "$1" $(place viewport/picture)
    convert taken.png -crop "$(($2 - 6))x$5+0+$3" +repage panel.png
    # Trims empty rows at the bottom and keeps the width.
    rows=$(convert panel.png -gravity south -background "$(convert panel.png -format '%[pixel:p{3,3}]' info:)" \
        -splice 0x1 -format '%@' -fuzz 2% info: | sed 's/.*x\([0-9]*\)+.*+\([0-9]*\)$/\1 \2/' |
        awk '{print $1 + $2 + 8}')
    convert panel.png -crop "x$rows+0+0" +repage panel.png
    small panel.png "$out/$1.png" -dither None -colors 128
}

# One function per picture, with the picture's name.

picture_lod() {
    start < <(above_india; window 1400 1080; only lod 300; echo 'lod.tau_px = 0.4')
    settle
    # Changes the tolerance and flies on, so that the plots show something.
    slide "lod/Tolerance τ" 0.5; settle; slide "lod/Tolerance τ" 0.2; settle
    point viewport/picture; xdotool keydown w; sleep 0.7; xdotool keyup w; frames 8
    dock lod
}
picture_seams() {
    start < <(above_india; window 1400 800; only seams 320; echo 'lod.tau_px = 0.4'; echo 'seams.show_pairs = true')
    settle; aside
    dock seams
}
picture_overlay() {
    start < <(above_india; window 1400 760; only overlay 300; echo 'lod.tau_px = 0.4'
        echo 'overlay.colour_by = "error"')
    settle; aside
    dock overlay
}
picture_surface() {
    start < <(himalaya; window 1400 1080; only surface 300; echo 'surface.colour = "ramp"')
    settle; click surface/Hypsometric; aside
    dock surface
}
# Grass, rock and snow below Everest, with the layers' weights there.
picture_layers() {
    start < <(pose 27.5 86.5 20000 10 -22; window 1400 960; only surface 320; echo 'surface.layer_use = "on"')
    settle; reach surface/Colour "surface/Noise size"; click "surface/layer snow"
    for i in $(seq 30); do xdotool click 5; done; frames
    point viewport/picture 0.45 0.72
    whole layers
}
picture_camera() {
    start < <(himalaya; window 1400 1000; only camera 300; echo 'view.mode = "follow_flight"'
        echo "view.flight = \"$here/data/flights/andes_low_fast.toml\"")
    sleep 6
    dock camera
}
picture_presets() {
    start < <(himalaya; window 1400 600; only presets 360)
    settle; click "presets/crack hunting"; aside
    dock presets
}
picture_quadtree() {
    start < <(above_india; window 1400 900; only quadtree 420; echo 'lod.tau_px = 0.4')
    settle
    click viewport/picture 0.5 0.75; click quadtree/Selected; aside
    xdotool mousemove $(at quadtree/Net 0.5 0.5); xdotool click --repeat 5 --delay 100 5; aside
    dock quadtree
}
picture_chunk() {
    start < <(above_india; window 1400 1180; only chunk 330; echo 'lod.tau_px = 0.4'; slow_disk 600 0)
    sleep 3
    click viewport/picture 0.5 0.75; aside
    dock chunk
}
picture_paging() {
    start < <(above_india; window 1820 440; only paging 1000; echo 'lod.tau_px = 0.4'; slow_disk 900 0.1)
    settle; click "paging/Evict all"; aside; sleep 4
    dock paging
}
picture_frame() {
    start < <(above_india; window 1820 440; only frame 1000)
    settle
    point viewport/picture
    xdotool keydown a; sleep 0.5; xdotool keyup a; settle; aside
    dock frame
}
picture_timeline() {
    start < <(above_india; window 1820 620; only timeline 1000; echo 'lod.tau_px = 0.4')
    settle
    point viewport/picture; xdotool click --repeat 10 --delay 150 4; sleep 1
    click timeline/Hold
    # A frame with arrivals.
    for share in 0.9 0.85 0.8 0.75 0.7 0.65 0.6 0.55 0.5 0.45 0.4 0.35 0.3 0.25; do
        click timeline/Lanes $share 0.05
        shown "timeline/Change 3" && break
    done
    aside
    dock timeline
}
picture_bake() {
    start < <(himalaya; window 1400 900; only bake 330)
    settle; choose "bake/Chunk size" "65 vertices"; aside
    # The estimate appears a moment after the last change.
    sleep 6
    dock bake
}
picture_log() {
    start < <(himalaya; window 1820 400; only log 1000; slow_disk 20 0.15)
    sleep 5; aside
    dock log
}

picture_true_error() {
    start < <(above_india; window 1400 1000; only errors 420; echo 'lod.tau_px = 0.4')
    settle; click errors/Measure; sleep 6; aside
    dock true_error
}
picture_cracks() {
    start < <(above_india; window 1400 1000; only cracks 420; echo 'lod.tau_px = 0.4'; echo 'lod.morph = false')
    settle; click cracks/Measure; sleep 3; click "cracks/Find smallest skirts"; sleep 6; aside
    dock cracks
}
picture_pops() {
    start < <(himalaya; window 1820 520; only pops 1000; echo 'lod.tau_px = 0.4'; echo 'lod.morph = false'; slow_disk 200 0
        echo 'view.mode = "follow_flight"'; echo "view.flight = \"$here/data/flights/andes_low_fast.toml\"")
    sleep 40; aside
    dock pops
}
picture_precision() {
    start < <(himalaya; window 1400 700; only probe 380; echo 'lod.tau_px = 0.4')
    settle; point viewport/picture 0.5 0.6; frames 5
    dock precision
}
picture_ruler() {
    start < <(himalaya; window 1400 800; only ruler 380; echo 'lod.tau_px = 4')
    settle; click "ruler/Click places"
    point viewport/picture 0.35 0.75; xdotool click 1; frames 5; point viewport/picture 0.6 0.55; xdotool click 1; frames 5
    sleep 3; aside
    dock ruler
}
picture_flight() {
    start < <(above_india; window 1820 420; only flight 1000; echo 'lod.tau_px = 0.4'; slow_disk 100 0)
    settle; click flight/Record; sleep 1
    point viewport/picture 0.5 0.5; xdotool keydown w; sleep 6; xdotool keyup w; xdotool keydown s; sleep 4; xdotool keyup s
    click "flight/Stop and save"; click "flight/flight 1"; click flight/Replay; sleep 5; click flight/Play; aside
    dock flight
}
# Worldy on a trace of CesiumJS, at a tile that waits for data. WIDTH HEIGHT
trace_window() {
    world=$here/tests/trace/cesium/cesium.lodtrace start < <(window "$1" "$2"
        printf '%s\n' 'data.set = "earth/elevation.tif"' 'window.bottom_height = 290')
    until_true shown trace/Timeline
    tab "Trace findings"; click trace_findings/Kind
    click "$(cut -f1 items.txt | grep -m1 "Kind: starvation")"; click "trace_findings/Fault 0"; tab Trace
    click "trace/Look as engine"; settle
}
# A part of the program's screenshot: NAME GEOMETRY
crop() { take; convert taken.png -crop "$2" +repage panel.png; small panel.png "$out/$1.png" -dither None -colors 128; }
picture_trace_cesium() {
    trace_window 1820 1120
    tab "Trace findings"; aside
    whole trace_cesium
}
picture_trace() {
    trace_window 1600 1000; aside
    set -- $(place viewport/picture)
    crop trace "$(($1 + $3))x$((1000 - $2 - $4 - 24))+0+$(($2 + $4 + 6))"
}
picture_trace_nodes() {
    trace_window 1820 1000; aside
    dock trace_nodes
}
picture_trace_what_if() {
    trace_window 1820 1000
    xdotool key ctrl+shift+w; click "trace_what_if/Run"; settle; aside
    set -- $(place viewport/picture)
    crop trace_what_if "$(($1 + $3))x$((1000 - $2 - $4 - 24))+0+$(($2 + $4 + 6))"
}
picture_sources() {
    world=earth/earth.toml start < <(pose -32.45 -70.5 160000 0 -88; window 1400 1000; only sources 420; echo 'overlay.colour_by = "source"'; echo 'overlay.sources = true')
    until_true shown "sources/layer ETOPO5"; click "sources/layer Andes at Aconcagua"; settle
    point viewport/picture 0.5 0.5; sleep 2
    dock sources
}
# The whole window, because the outlines lie on the globe.
picture_regions() {
    bake india.chk earth/elevation.tif --colour earth/colour.jpg
    cat >india.regions.toml <<'REGIONS'
[[region]]
name = "Himalaya"
tau_factor = 0.5
border_m = 200000
circles = [[29.5, 82, 450000], [28, 87.5, 450000]]

[[region]]
name = "Ganges delta"
tau_factor = 0.7
border_m = 50000
polygons = [[[24.5, 87.5], [24.5, 91.5], [21.5, 92], [21, 87]]]
REGIONS
    world=india.chk start < <(above_india; window 1400 860; only regions 330; echo 'lod.tau_px = 0.25'
        echo 'overlay.colour_by = "region"'; echo 'overlay.opacity = 0.5'; echo 'overlay.outlines = true')
    settle; click "regions/region Himalaya"; aside
    whole regions
}
# The whole window, because the pins lie on the globe.
picture_notes() {
    start < <(himalaya; window 1400 800; only notes 360)
    settle; click notes/Text; xdotool type --delay 20 "The plateau begins here"; frames; click "notes/Add note"
    click "viewport/picture" 0.3 0.6; settle; choose notes/About "the selected chunk"
    click notes/Text; xdotool type --delay 20 "Too coarse at 2 px"; frames; click "notes/Add note"; aside
    whole notes
}
picture_sweep() {
    start < <(above_india; window 1820 460; only sweep 1000)
    settle; choose sweep/Flight "orbit to ground"; click "sweep/Chunk 17"; choose sweep/Picture "640 x 400"; click sweep/Run
    until_true counts swept -eq 20 || until_true counts swept -eq 20; click sweep/Suggest
    until_true counts suggested -eq 2; sleep 2; click "sweep/Row 4"; aside
    dock sweep
}
picture_suggest() {
    start < <(above_india; window 1820 660; only suggest 1000)
    settle; click "suggest/Flight andes low fast"; click "suggest/Flight orbit to ground"; enter suggest/Triangles 100000
    click suggest/Suggest; until_true says 'suggested settings meet' || until_true says 'suggested settings meet'; aside
    dock suggest
}

# The whole window.
picture_compare() {
    start < <(himalaya; window 1440 900; echo 'lod.tau_px = 0.4'; echo 'panels.compare_shown = true'
        echo 'overlay.colour_by = "level"'; echo 'overlay.opacity = 0.4'; echo 'overlay.outlines = true'; echo 'panels.left_front = "compare"')
    settle; click "compare/Snapshot as B"; slide "lod/Tolerance τ" 0.6; settle
    choose compare/Show wipe; click "compare/Measure this view"; sleep 6; aside
    whole compare
}
picture_editor() {
    start < <(above_india; window 1440 900; echo 'lod.tau_px = 0.4'; echo 'overlay.outlines = true')
    settle; click viewport/picture 0.5 0.7; aside
    whole editor
}
picture_errors() {
    start < <(above_india; window 1440 900; echo 'lod.tau_px = 0.4'; echo 'overlay.colour_by = "error"'
        echo 'overlay.labels = "level_and_error"'; echo 'overlay.outlines = true'; echo 'panels.right_front = "overlay"')
    settle; aside
    whole errors
}
picture_observer() {
    start < <(himalaya; window 1440 900; echo 'lod.tau_px = 0.4'; echo 'overlay.colour_by = "level"'; echo 'overlay.opacity = 0.5'
        echo 'overlay.outlines = true'; echo 'view.observer = "split"'; echo 'panels.right_front = "camera"')
    settle
    # The observer steps back.
    point observer/picture; xdotool click --repeat 6 --delay 100 5; settle; aside
    whole observer
}
picture_light() {
    start < <(himalaya; window 1440 900; echo 'window.theme = "light"'; echo 'panels.bottom_front = "frame"')
    settle; aside
    whole light
}

picture_light_panel() {
    start < <(above_india; window 1400 1000; only light 320; echo 'surface.sun_follows = false'
        echo 'surface.sun_by_date = true'; echo 'surface.sun_hour = 7'; echo 'light.sea = "on"')
    settle; aside
    dock light_panel
}

# Views of planets made for them, with every part of light, in software too.
bake() { [ -f "$1" ] || "$binary" bake "${@:2}" -o "$1" >/dev/null 2>&1 || failures=$((failures + 1)); }
detailed_earth() { bake earth_amplified.chk preset:earth-amplified --face-size 4097 --colour earth/colour.jpg; }
regions() { bake regions.chk "$here/data/earth/earth.toml" --colour earth/colour.jpg; }
ridged_world() { bake ridged.chk preset:ridged; }
small_world() {
    bake ridge.chk noise:ridged,seed=9,gain=0.5,amplitude_m=2600,feature_deg=6,offset_m=900 --radius 300000 \
        --face-size 4097 --quantum 0.2
}
# view NAME FILE CAMERA SUN_NORTH SUN_EAST OPTIONS...
view() {
    "$binary" shot "$2" --camera "$3" --size 1280x720 --tau 1 -o view.png --set surface.sun_follows=false \
        --set surface.sun_latitude_deg="$4" --set surface.sun_longitude_deg="$5" --set light.air=on \
        --set light.sea=on --set light.shadows=on --set light.normals=on --set surface.layer_use=on "${@:6}" >/dev/null &&
        convert view.png -strip -quality 88 "$out/$1.jpg" || failures=$((failures + 1))
}
view_whole_earth() { detailed_earth; view whole_earth earth_amplified.chk 22,38,15500000,0,-90 12 20; }
view_sunset_limb() { detailed_earth; view sunset_limb earth_amplified.chk 20,60,400000,270,-17 -5.3 -45.9; }
view_himalaya() {
    detailed_earth
    view himalaya earth_amplified.chk 27,86.4,20000,12,-12 10 35 --set light.air_rayleigh=0.5 \
        --set light.air_haze=0.4 --set surface.layer_use=off
}
view_coast() { detailed_earth; view coast earth_amplified.chk 36.55,-5.2,3000,120,-12 20 35; }
view_ridge() {
    small_world
    view ridge ridge.chk 32,40,1240,200,-6 25 85 --set surface.sea=false --set light.air_thickness=4 \
        --set light.air_haze=0.5
}
view_ridged_world() {
    ridged_world
    view ridged_world ridged.chk 25,40,900000,20,-60 15 85 --set light.air_rayleigh=0.4 --set light.air_haze=0.5
}

view_andes() {
    regions
    view andes regions.chk -32.95,-70.45,9000,48,-10 -25 -110 --set light.air_rayleigh=0.5 \
        --set light.air_haze=0.3 --set surface.layer_use=off
}
view_andes_rim() {
    regions
    "$binary" shot regions.chk --camera -35.2,-70.5,230000,0,-42 --size 1280x720 --tau 1 -o view.png \
        --set overlay.outlines=true --set overlay.colour_by=level --set overlay.opacity=0.35 >/dev/null &&
        convert view.png -strip -quality 88 "$out/andes_rim.jpg" || failures=$((failures + 1))
}

for name in whole_earth sunset_limb himalaya coast ridge ridged_world andes andes_rim; do
    asked $name || continue
    echo "$name"
    view_$name
done

windows="editor errors observer light compare layers lod seams overlay surface light_panel camera presets quadtree \
    chunk paging frame timeline bake sources log true_error cracks pops precision ruler flight sweep suggest trace_cesium trace trace_nodes \
    trace_what_if notes regions"
any=no
for name in $windows; do asked $name && any=yes; done
[ $any = yes ] || exit $((failures > 0))

echo "baking the Earth"
start </dev/null
until_true says 'Baked' || cat .stderr
settle
stop

for name in $windows; do
    asked $name || continue
    echo "$name"
    picture_$name
    stop
done
du -sh "$out"
exit $((failures > 0))
