# shellcheck shell=bash disable=SC1091
# The same features with their rings written in other ways: reversed, from another corner, holes and members in another
# order, with the closing vertex repeated, with additional vertices on straight walls. Anchors, moves, conflicts, blocks
# and pushes are the same, and check --before finds no violated rule.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
export PYTHONDONTWRITEBYTECODE=1 SOURCE_DATE_EPOCH=1700000000
rewritten() { /usr/bin/python3 "$SUNDER_SOURCE/tests/cli/rewritten_rings.py" "$@" || fail "rewritten_rings.py $*"; }

ogr2ogr -q -f GeoJSON town.geojson "$SUNDER_SOURCE/datasets-synthetic/town.gpkg" buildings -lco RFC7946=NO
rewritten write town.geojson "${SUNDER_SEED:-1}"
roads=$SUNDER_SOURCE/datasets-synthetic/town.gpkg,layer=roads
n=0
all_ways() { # WAYS EFFORT OPTIONS
    local ways=$1 effort=$2 way
    shift 2
    for way in given $ways; do
        run separate $way.geojson $way.gpkg --output-layer result --overwrite -q --contained ignore --effort "$effort" "$@"
        [ "$status" -eq 0 ] || [ "$status" -eq 3 ] || fail "$way $*: status $status"
        rewritten show $way.gpkg >$way.txt
        cmp -s given.txt $way.txt ||
            fail "$way $*: $(diff given.txt $way.txt | grep -c '^>') rows of $(wc -l <given.txt) differ"
        run check $way.gpkg -l result --before $way.geojson --contained ignore "$@"
        says out 'worse 0, limit 0, side 0, jump 0'
        n=$((n + 1))
    done
    [ "$(grep -c '^result_displacement ' given.txt)" -gt 20 ] || fail "$*: too few features moved for the test"
}
ways="shuffled all" # the others are in `all`
[[ ${SUNDER_LAWS:-} != all ]] || ways="reversed rotated shuffled closed_twice with_middles all"
all_ways "$ways" 0 --gap 3 --max-shift 6 --barrier "$roads,width=4"
all_ways "reversed" 1 --gap 2 --touch-tolerance 0.5
((n >= 5)) || fail "$n runs"
finish
