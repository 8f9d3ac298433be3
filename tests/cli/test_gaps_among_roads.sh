# shellcheck shell=bash disable=SC1091
# The largest gap that resolves a conflict of a building among roads: the program finds such a gap for at least 97
# conflicts of the town. The search for a solution may fail at a gap below the largest one; other gaps are tried then,
# so that at most 10 of the values are not proved to be the largest to within a hundredth.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg
expect 3 separate "$town" out.gpkg --quiet --input-layer buildings --gap 4 --max-shift 3 --barrier "$town,layer=roads,width=8" \
    --trace trace.jsonl
wide=$(grep '"need_gap"' trace.jsonl | grep -c 'a larger gap may have a solution')
proved=$(grep '"need_gap"' trace.jsonl | grep -c 'proved: the largest gap')
[ $((wide + proved)) -ge 97 ] || fail "$((wide + proved)) conflicts have a gap"
[ "$wide" -le 10 ] || fail "$wide of $((wide + proved)) gaps are not proved"
finish
