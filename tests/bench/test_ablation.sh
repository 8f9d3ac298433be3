#!/usr/bin/env bash
# Does the ablation harness measure what it claims? On a few clusters of a synthetic town: without a variation all
# results equal those of the ordinary program; a switched-off stage and a changed constant have an effect; an
# interrupted run is continued.
set -euo pipefail
build=${SUNDER_BUILD:?}
[[ -x $build/sunder_ablation && -x $build/sunder-town ]] || { echo "skipped: no sunder_ablation (it needs GDAL)"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
fail() {
    echo "FAILED: $*"
    failures=$((failures + 1))
}

town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg
roads=(--gap 3 --max-shift 10 --barrier "$town,layer=roads,width=5")
draw() { # NAME OPTION ...
    SUNDER_CORPUS=$work/corpus.txt SUNDER_CORPUS_NAME=$1 SUNDER_CORPUS_ITEMS=5 "$build/sunder_ablation" separate "$town" \
        "$work/none.gpkg" -q --input-layer buildings --output-layer l "${@:2}" >/dev/null
}
draw roads "${roads[@]}"
draw free --gap 3
(($(grep -c '^cluster ' "$work/corpus.txt") == 10)) || fail "no corpus of ten clusters"
[[ ! -e $work/none.gpkg ]] || fail "drawing a corpus left a layer"

# ---- The CSV ----
vary() { bash "$SUNDER_SOURCE/tests/bench/ablation.sh" --corpus "$work/corpus.txt" --csv "$work/out.csv" "$@"; }
row() { awk -F'",' -v name="\"$1" '$1 == name { print $2 }' "$work/out.csv"; }
column() { row "$1" | cut -d, -f"$2"; } # 1 clusters, 2 changed, 3 failed, 4 conflicts left, 5 cost, 6 bound, 7 steps, 8 allocations
vary 'search.SOFT*1' off:cluster/descend off:group/grow_tree off:memo/measures 'quadratic.SWEEPS=1' >/dev/null
[[ $(column 'as it is' 1) = 10 ]] || fail "clusters: $(row 'as it is')"
[[ $(row 'search.SOFT*1') = "$(row 'as it is')" ]] || fail "a factor of 1 changes something: $(row 'search.SOFT*1')"
for name in off:cluster/descend off:group/grow_tree; do
    (($(column $name 2) > 0)) || fail "$name changes nothing: $(row $name)"
    (($(column $name 3) == 0)) || fail "$name fails: $(row $name)"
    [[ $(column $name 7) != "$(column 'as it is' 7)" ]] || fail "$name takes as many steps"
done
awk -v b="$(column off:group/grow_tree 6)" 'BEGIN { exit !(b < 1) }' || fail "without trees as much is proved: $(row off:group/grow_tree)"
(($(column off:memo/measures 2) == 0)) || fail "a memo changes a result: $(row off:memo/measures)"
[[ $(column quadratic.SWEEPS=1 7) != "$(column 'as it is' 7)" ]] || fail "a changed constant is not seen"

# ---- Continued runs: existing results are not computed again ----
lines=$(wc -l <"$work/out.csv")
vary off:cluster/descend 'search.SOFT*2' >/dev/null
(($(wc -l <"$work/out.csv") == lines + 1)) || fail "$lines lines became $(wc -l <"$work/out.csv")"
if SUNDER_TUNING='search.NONE*2' "$build/run_corpus" "$work/corpus.txt" >/dev/null 2>&1; then fail "a constant that does not exist is accepted"; fi

# ---- The library with variables and the one with constants give the same results ----
"$SUNDER" separate "$town" "$work/a.geojson" -q --input-layer buildings "${roads[@]}" || (($? == 3))
"$build/sunder_ablation" separate "$town" "$work/b.geojson" -q --input-layer buildings "${roads[@]}" || (($? == 3))
cmp "$work/a.geojson" "$work/b.geojson" || fail "the two programs differ"
SUNDER_TUNING=off:cluster/descend "$build/sunder_ablation" separate "$town" "$work/c.geojson" -q --input-layer buildings "${roads[@]}" || (($? == 3))
if cmp -s "$work/a.geojson" "$work/c.geojson"; then fail "the program ignores SUNDER_TUNING"; fi
exit $((failures > 0))
