#!/bin/sh
# Names each of Worldy's headers that a file includes and does not need: tests/includes.sh FOLDER, which holds a
# compile_commands.json that Clang understands. Ends with 1 where there is any.
set -eu
folder=$(realpath "$1")
cd "$(dirname "$0")/.."
git ls-files 'planet/*.cpp' 'ui/*.cpp' 'app/*.cpp' |
    xargs iwyu_tool -p "$folder" -j "$(nproc)" -- -Xiwyu --no_fwd_decls -Xiwyu --max_line_length=200 -Wno-everything \
        >"$folder/includes.txt" 2>&1 || true
# A run that came to nothing is not a clean one.
grep -q "has correct #includes\|should remove these lines" "$folder/includes.txt" || {
    cat "$folder/includes.txt"
    exit 1
}
! awk '/should remove these lines:/ { file = $1; removing = 1; next }
       /should add these lines:|^The full include-list/ { removing = 0 }
       removing && /^- #include "(planet|ui|app)\// && !seen[file $3]++ { print file ": does not need " $3; found = 1 }
       END { exit !found }' "$folder/includes.txt"
