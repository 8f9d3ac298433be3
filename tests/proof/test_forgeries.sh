# shellcheck shell=bash disable=SC1091
# What a forger changes in a file of --proof is refused, or claims no more than is true (forgeries.py): of eleven layers of at most twelve
# features, which together use every kind of line and member, 2,000 forgeries by seed (SUNDER_SEED), all of them with SUNDER_LAWS=all; and
# of three maps, where they are beside the repository, a thousand.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
here=$SUNDER_SOURCE/tests/proof
. "$here/layers.sh"
runs=()

# forged NAME SOURCE OPTIONS...: one more run whose file of --proof is to be forged.
forged() {
    local name=$1 source=$2
    shift 2
    "$SUNDER" separate "$source" "$name.o.gpkg" --overwrite -q -l buildings --layers main,displacement,conflicts --proof "$name.jsonl" "$@" 2>err
    case $? in 0 | 3) ;; *) fail "$name: status $?" ;; esac
    runs+=("$(python3 -c 'import json, sys; print(json.dumps({"only": sys.argv[1], "proof": sys.argv[2], "words": sys.argv[3:]}))' \
        "${only:-}" "$name.jsonl" "$source" --layer buildings --result "$name.o.gpkg" "$@")")
}

# refuted WORDS...: of forgeries.py, on all runs since the last time
refuted() {
    (IFS=,; echo "[${runs[*]}]") >runs.json
    python3 "$here/forgeries.py" runs.json "$@" >said 2>&1 || fail "$(cat said)"
    tail -1 said
    runs=()
}

make_side
make_corners
make_bend
make_lane
make_pierced
make_yard
make_halves
make_lying 4
mv lying.gpkg few.gpkg
make_lying 12
make_pile 8
make_mixed
make_houses
make_through
forged through houses.gpkg --gap 1 --max-shift 1 --no-blocks --barrier through.gpkg
forged side wall.gpkg --no-blocks --fixed-where 'w = 1 AND fid = 2' --barrier side.gpkg
forged bends held.gpkg --gap 3 --max-shift 7 --barrier bends.gpkg
forged bend bent.gpkg --gap 1 --max-shift 1 --barrier bend.gpkg,side=no --barrier edge.gpkg,side=no
lane=(--gap 3 --max-shift 2 --no-blocks --block-field k --fixed-where 'w = 2' --allow-jumps --barrier lane.gpkg,width=5,gap=0,side=no)
forged lane lanes.gpkg "${lane[@]}"
forged pierced pierced.gpkg "${lane[@]}"
forged yard yard.gpkg --gap 3 --no-blocks --contained separate
forged halves halves.gpkg --gap 1 --max-shift 25
forged few few.gpkg --gap 2 --no-blocks --block-field k --contained separate
only='"crowded"' forged crowd lying.gpkg --gap 0.5 --no-blocks --max-shift 3 --allow-jumps --contained separate --effort 0
forged pile pile.gpkg --symbol square:6
forged mixed mixed.gpkg --gap 1 --max-shift-field m --fixed-where 'w = 3' --weight sqrt-area --weight-field w --block-field k --contained ignore
if [ "${SUNDER_LAWS:-}" = all ]; then
    refuted --need-all
else
    refuted --need-all --draw 2000 --seed "${SUNDER_SEED:-1}"
fi
data=$SUNDER_SOURCE/../shared/data
if [ ! -d "$data" ]; then
    echo "without $data: generated layers alone"
else # of each map 300 features
    for name in krems_2013 saint_jean_la_poterie neuss_2026; do
        ogr2ogr "$name.gpkg" "$data/$name.gpkg" buildings -nln buildings -limit 300 2>/dev/null || fail "ogr2ogr: $name"
        forged $name $name.gpkg --gap 3 --max-shift 1.5
    done
    refuted --own-alone --draw 1000 --seed "${SUNDER_SEED:-1}"
fi
finish
