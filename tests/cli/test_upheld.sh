# shellcheck shell=bash disable=SC1091
# sunder separate with limits: no remaining conflict is worse than before; an independent script compares the two layers
# exactly.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
[ -x "$SUNDER_BUILD/tests/standing_rule" ] || { echo "skipped: no standing_rule"; exit 77; }
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }

# upheld STATUS INPUT LAYER GAP OPTIONS: separates; if conflicts remain, lib.sh checks the result.
upheld() {
    local wanted=$1 input=$2 name=$3 gap=$4
    shift 4
    expect "$wanted" separate "$input" o.gpkg --overwrite -q --input-layer "$name" --gap "$gap" --stats s.json "$@"
    same "$(json .verified s.json)" true "verified:"
}

# A house that projects from its outline beside a block: it can be moved inside. If the block is nearer there is no
# solution, and the house does not move.
layer corner.gpkg corner POLYGON <<'X'
k,WKT
outline,"POLYGON((0 0,100 0,100 100,0 100,0 0))"
house,"POLYGON((94 40,104 40,104 50,94 50,94 40))"
block,"POLYGON((105 20,120 20,120 70,105 70,105 20))"
X
fixed=(--fixed-where "k <> 'house'" --contained ignore)
upheld 0 corner.gpkg corner 3 --max-shift 7 "${fixed[@]}"
same "$(value o.gpkg corner 2 sunder_st)" moved
upheld 3 corner.gpkg corner 3 --max-shift 3 "${fixed[@]}"
same "$(value o.gpkg corner 2 sunder_len) $(value o.gpkg corner_conflicts 1 distance)" '0 0' "nothing moves:"

# A town, and maps, with limits that leave conflicts.
town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg
for limit in 0.25 0.5 1; do
    for mode in block ignore separate; do upheld 3 "$town" buildings 3 --max-shift $limit --contained $mode; done
done
data=$SUNDER_SOURCE/../shared/data
if [ -d "$data" ]; then
    for limit in 1 3; do upheld 3 "$data/krems_2013.gpkg" buildings 3 --max-shift $limit; done
    upheld 3 "$data/neuss_2026.gpkg" buildings 3 --max-shift 1
else
    echo "without $data: the town alone"
fi
[ "$moved_pairs" -gt 0 ] || fail "no pair that stayed in conflict had moved: nothing was tested"
echo "$moved_pairs pairs compared"
finish
