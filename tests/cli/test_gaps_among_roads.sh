# shellcheck shell=bash disable=SC1091
# What gap would free a building among roads: the town has 97 conflicts for which a gap is found. A search fails at many gaps below
# the largest one; it is asked about other gaps then, so that at most 15 of the values are not proved to be the largest to a
# hundredth.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg
expect 3 separate "$town" out.gpkg --quiet --input-layer buildings --gap 4 --max-shift 3 --barrier "$town,layer=roads,width=8" \
    --trace trace.jsonl
wide=$(grep '"need_gap"' trace.jsonl | grep -c 'a larger gap may have a solution')
proved=$(grep '"need_gap"' trace.jsonl | grep -c 'proved: the largest gap')
[ $((wide + proved)) -ge 97 ] || fail "$((wide + proved)) conflicts have a gap"
[ "$wide" -le 15 ] || fail "$wide of $((wide + proved)) gaps are not proved"
finish
