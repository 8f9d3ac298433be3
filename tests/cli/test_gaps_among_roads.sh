# shellcheck shell=bash disable=SC1091
# The largest gap that resolves a conflict of a building among roads: the program finds such a gap for each conflict of
# the town. The search for a solution may fail at a gap below the largest one; other gaps are tried then,
# so that at most 10 of the values are not proved to be the largest to within a hundredth.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }

town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg
expect 3 separate "$town" out.gpkg --quiet --rows no --ease no --input-layer buildings --gap 4 --max-shift 3 --barrier "$town,layer=roads,width=8" \
    --trace trace.jsonl --stats stats.json
wide=$(grep '"need_gap"' trace.jsonl | grep -c 'a larger gap may have a solution')
proved=$(grep '"need_gap"' trace.jsonl | grep -c 'proved: the largest gap')
left=$(jq '.conflicts.after | del(.inside_blocks) | add' stats.json)
[ "$left" -ge 50 ] && [ $((wide + proved)) -eq "$left" ] || fail "$((wide + proved)) of $left conflicts have a gap"
[ "$wide" -le 10 ] || fail "$wide of $((wide + proved)) gaps are not proved"
finish
