# shellcheck shell=bash
# The README's example in C compiles and prints the least move, and its commands on the bundled town work.
set -eu
work=$SUNDER_BUILD/readme-test
rm -rf "$work"
mkdir -p "$work"
readme=$SUNDER_SOURCE/README.md

if grep -q '^SUNDER_SANITIZE:STRING=.' "$SUNDER_BUILD/CMakeCache.txt"; then
    echo "skipped: the build carries a sanitizer"
    exit 77
fi

sed -n '/^```c$/,/^```$/p' "$readme" | grep -v '^```' >"$work/example.c"
[ -s "$work/example.c" ]
cc=$(sed -n 's/^CMAKE_C_COMPILER:[A-Z]*=//p' "$SUNDER_BUILD/CMakeCache.txt")
library=$(find "$SUNDER_BUILD" -maxdepth 2 -name libsunder.a | head -n 1)
"$cc" -std=c17 -Wall -Wextra -Werror -I"$SUNDER_SOURCE/src" "$work/example.c" "$library" -lgmp -lm -pthread -o "$work/example"
"$work/example" | tee "$work/example.out"
grep -qx 'move the shed by (1, 1)' "$work/example.out" # the expected move goes into the corner of the L

[ -x "$SUNDER" ] || exit 0
# Every line of "One command" that runs the built program; status 3 means that it found conflicts in the town.
sed -n '/^## One command/,/^## The report/p' "$readme" | grep '^build/release/sunder' | sed 's/  *#.*//' >"$work/commands"
[ "$(wc -l <"$work/commands")" -ge 3 ]
cd "$work"
ln -s "$SUNDER_SOURCE/datasets-synthetic" datasets-synthetic
while IFS= read -r command; do
    echo "\$ $command"
    status=0
    eval "$(printf '%s' "$command" | sed "s|^build/release/sunder|\"\$SUNDER\"|")" >out 2>&1 || status=$?
    tail -n 5 out
    [ "$status" -eq 0 ] || [ "$status" -eq 3 ] || exit 1
done <"$work/commands"
[ -s town_separated.gpkg ]
