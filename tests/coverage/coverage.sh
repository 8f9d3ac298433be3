#!/usr/bin/env bash
# How many statements of src/ and gis/ do the ordinary tests run? Counted by gcov in a build of its own
# (build/coverage), summed up by gcovr.
#
#   coverage.sh                  all ordinary tests; then the figures, and the ten files with the least
#   coverage.sh -L unit          some of them: further arguments are passed to ctest, and counts add up
#   coverage.sh --figures        runs no test; the figures of earlier runs
#   coverage.sh --lines FILE     the lines of a file that no test has run
#   coverage.sh --record         the figures, and RECORD.md is written
#
# Statements are lines for which the compiler made code. The counts of a source that was changed since are reset by
# gcov. Assertions and checkers are off, as in the installed library; fuzz targets are not ordinary tests.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
build=$root/build/coverage
ordinary='^(unit|property|golden|gis|watch|cross|cli|proof|faults|plugin|docs)$'
command -v gcovr >/dev/null || { echo "skipped: gcovr is not installed"; exit 77; }

build() {
    cmake --preset coverage -S "$root" >/dev/null
    cmake --build "$build" -j "$(nproc)" >"$build/build.log" 2>&1 || { tail -n 30 "$build/build.log"; exit 1; }
}

# Calls gcovr for a kind of report. After a run that was ended by a signal, a branch may have been entered more often
# than left: gcov then finds negative counts of branches, which do not affect lines and are ignored.
report() { # OPTIONS: which files, what kind of report, where to
    gcovr -r "$root" --object-directory "$build" --gcov-ignore-parse-errors -j "$(nproc)" "$@" "$build" 2>"$build/gcovr.log"
}
# Prints for each file its name, its statements, and those that were run.
counts() {
    [ -n "$(find "$build" -name '*.gcda' -print -quit)" ] || { echo "nothing was run yet" >&2; exit 1; }
    report -f "$root/src/" -f "$root/gis/" --csv -o "$build/counts.csv"
    awk -F, 'NR > 1 { print $1, $2, $3 }' "$build/counts.csv"
}
share() { # share of a tree, in percent
    awk -v tree="^$1/" '$1 ~ tree { all += $2; run += $3 } END { printf "%.2f %% of %d", 100 * run / all, all }' "$2"
}
least() { awk '$2 > 0 { printf "%5.1f %4d %s\n", 100 * $3 / $2, $2 - $3, $1 }' "$1" | LC_ALL=C sort -n | head -n 10; }
figures() {
    counts >"$build/counts"
    for tree in src gis; do echo "$tree/: $(share $tree "$build/counts") statements"; done
    echo "the least, in percent, with the statements that are missing:"
    least "$build/counts"
}
lines() {
    report -f "$root/$1" --txt -o "$build/lines"
    grep -F "$(basename "$1" | cut -c 1-30)" -A 99 "$build/lines" | sed '/^---/,$d'
}

commit() {
    local dirty=
    git -C "$root" diff --quiet HEAD -- 'src/*.[ch]' 'gis/*.[ch]' || dirty=" and changes of it"
    echo "$(git -C "$root" rev-parse --short=7 HEAD)$dirty"
}
outcomes() { sed -n "s/.*Test *#[0-9]*: *\([^ ]*\) [ .]*\**$1.*/\1/p" "$build/outcomes" | LC_ALL=C sort -u; }
named() { outcomes "$1" | paste -sd' ' | sed -n "s/..*/, $1: &/p" | tr SF sf; }

record() {
    figures >"$build/figures"
    {
        echo "# What the ordinary tests run"
        echo
        echo "Written by \`bash tests/coverage/coverage.sh --record\` on $(date +%F), of $(commit), with $(gcc --version | head -n 1) and gcovr $(gcovr --version | sed -n '1s/.* //p')."
        echo "Tests: $(outcomes Passed | wc -l) passed$(named Skipped)$(named Failed)."
        echo
        echo "| tree | statements | run by the ordinary tests | wanted |"
        echo "|---|---|---|---|"
        for tree in src gis; do
            awk -v tree=$tree -v wanted=$([ $tree = src ] && echo 95 || echo 85) \
                'index($1, tree "/") == 1 { all += $2; run += $3 }
                 END { printf "| `%s/` | %d | %.2f %% | %d %% |\n", tree, all, 100 * run / all, wanted }' "$build/counts"
        done
        echo
        echo "The ten files with the least:"
        echo
        echo "| file | run | statements missing |"
        echo "|---|---|---|"
        least "$build/counts" | awk '{ printf "| `%s` | %s %% | %d |\n", $3, $1, $2 }'
        echo
        cat "$root/tests/coverage/left_out.md"
    } >"$root/tests/coverage/RECORD.md"
}

case ${1:-} in
--figures) figures ;;
--lines) lines "$2" ;;
--record) record && cat "$build/figures" ;;
*)
    build
    if [ $# -eq 0 ]; then
        find "$build" -name '*.gcda' -delete
        rm -f "$build/outcomes"
        set -- -L "$ordinary"
    fi
    status=0
    (cd "$build" && ctest --output-on-failure -j "$(nproc)" "$@") | tee -a "$build/outcomes" || status=$?
    figures
    exit $status
    ;;
esac
