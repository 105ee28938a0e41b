#!/bin/sh
# Feeds hostile files to every reader of files: tests/fuzz.sh MINUTES
# The minutes are divided among the fuzzers in tests/fuzz/, on all cores. The corpus is kept in build-fuzz/corpus/ for
# the next run. Exits with 1 if a fuzzer found a failure, and prints where its input lies.
# tests/fuzz.sh --short tries the same few thousand inputs each time; it is one of the tests.
set -eu
cd "$(dirname "$0")/.."
root=build-fuzz
#          name           inputs of the short run, largest input in bytes
fuzzers="\
chunk_file     600   40000
decoders       12000 20000
settings       300   20000
layer_set      4000  8000
regions        4000  8000
flight_path    12000 8000
notes          8000  8000
flight_record  2000  20000
raw_faces      8000  1200
raster         1500  20000
trace          8000  8000
atlas          4000  8000"

# run_one NAME SHORT_RUNS LONGEST SECONDS: one fuzzer, 0 seconds for the short run; its output goes to a log.
run_one() {
    name=$1
    corpus=$root/corpus/$name
    limits="-runs=-1 -max_total_time=$4"
    calm=nice
    if [ "$4" = 0 ]; then
        corpus=$root/tmp/$name
        limits="-runs=$2 -seed=1"
        calm=
    fi
    mkdir -p "$corpus"
    case $name in
        settings | layer_set | regions | flight_path | notes) words=-dict=tests/fuzz/toml.dict ;;
        *) words= ;;
    esac
    status=0
    # GDAL's reader of Erdas Imagine allocates up to 2 GB that a header claims. It gets no memory then, as on a machine that
    # has none, whereas an allocation of this project in C++ still ends the fuzzer.
    # shellcheck disable=SC2086
    ASAN_OPTIONS=max_allocation_size_mb=400:allocator_may_return_null=1 \
        $calm "$root/${name}_fuzz" $limits $words -max_len="$3" -timeout=5 -rss_limit_mb=1500 \
        -malloc_limit_mb=400 -print_final_stats=1 -artifact_prefix="$root/found/$name-" \
        "$corpus" "$root/seeds/$name" >"$root/logs/$name" 2>&1 || status=$?
    echo $status >"$root/logs/$name.status"
}

# Prints one line of figures per fuzzer, taken from its log.
figures() {
    printf '%-14s %12s %10s %10s %8s  %s\n' fuzzer inputs features corpus seconds found
    echo "$fuzzers" | while read -r name _; do
        status=$(cat "$root/logs/$name.status")
        found=nothing
        [ "$status" = 0 ] || found="something: see $root/logs/$name"
        awk -v name="$name" -v found="$found" '
            /stat::number_of_executed_units/ { inputs = $2 }
            /DONE/ || /cov: / { for (i = 1; i < NF; ++i) { if ($i == "ft:") ft = $(i + 1); if ($i == "corp:") corpus = $(i + 1) } }
            / in [0-9]+ second/ { for (i = 1; i < NF; ++i) if ($i == "in") seconds = $(i + 1) }
            END { sub("/.*", "", corpus); printf "%-14s %12d %10d %10d %8d  %s\n", name, inputs, ft, corpus, seconds, found }
        ' "$root/logs/$name"
    done
}

if [ "${1:-}" = --one ]; then
    shift
    run_one "$@"
    exit 0
fi
case ${1:-} in
    --short) seconds=0 ;;
    '' | *[!0-9]*) sed -n '2,5s/^# //p' "$0" >&2; exit 2 ;;
    *) seconds=$(($1 * 60 * $(nproc) / $(echo "$fuzzers" | wc -l))) ;;
esac
. .ci/packages.sh
install_missing no "$build_packages" "$test_packages"
configure_tests release
cmake --build --preset release --target fuzz_seeds
configure fuzz
cmake --build --preset fuzz
rm -rf "$root/seeds" "$root/tmp" "$root/logs" "$root/found"
mkdir -p "$root/tmp" "$root/logs" "$root/found"
build/fuzz_seeds "$root/seeds"
echo "$fuzzers" | sed "s/\$/ $seconds/" | xargs -P "$(nproc)" -L 1 "$0" --one
figures | tee "$root/figures"
[ -n "$(ls "$root/found")" ] || { ! grep -qv '^0$' "$root"/logs/*.status; exit; }
echo
echo "Inputs that failed lie in $root/found; to reproduce: $root/NAME_fuzz $root/found/NAME-..."
echo "Fix the failure, and add a named test of it in tests/planet/format/hostile_file_test.cpp or tests/app/settings/hostile_text_test.cpp."
exit 1
