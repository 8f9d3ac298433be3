# shellcheck shell=bash disable=SC1091
# --proof with --inset and --symbol-size: the checker verifies that each smaller shape is what its rung allows (rungs.py)
# and each clause with the shapes of its levels; and it refuses false statements about them (hide_mutations.py).
. "$SUNDER_SOURCE/tests/proof/room_runs.sh" || exit 1

# proved FILE OPTIONS...: the checker accepts the proof of this run, which has smaller shapes and clauses
proved() {
    checked "$@"
    grep -q '[1-9][0-9]* of [0-9]* smaller shapes, [1-9][0-9]* clauses' said || fail "$*: $(tail -1 said)"
    grep -o 'hidden [^;]*' said
}

make_town
rules=(--gap 0.5 --max-shift 0.5 --barrier roads.gpkg,width-field=w --hide --hide-weight 1)
proved town.gpkg "${rules[@]}" --inset 0.5,1,2
untrue town.gpkg 'larger shape;shape that keeps too little;shape of no rung;shape that is too large for its rung;shape with a tip cut;wall that is cut at two places' \
    "${rules[@]}" --inset 0.5,1,2
proved town.gpkg "${rules[@]}" --symbol-size 4
untrue town.gpkg 'shape of the rung before;shape of no rung;shape that is too large for its rung;shape with a tip cut' "${rules[@]}" --symbol-size 4
proved town.gpkg "${rules[@]}" --trim --crossed trim --inset 0.5,1 --symbol-size 4 --hierarchy-field class --rows no --ease no
proved town.gpkg "${rules[@]}" --trim --inset 0.5,1 --symbol-size 4 --rigid-where 'class = 2'
proved town.gpkg "${rules[@]:0:6}" --inset 0.5,1 --min-size 3

# Terraces and yards with some trimmed houses: the outline of the trimmed houses is moved in.
/usr/bin/python3 -c 'from osgeo import ogr; import shapely' 2>/dev/null || { echo "without GDAL's Python module or shapely: no terraces"; finish; exit 0; }
/usr/bin/python3 "$SUNDER_SOURCE/tests/cli/corner_worlds.py" "$SUNDER" 5 4 || fail "the terraces"
ogr2ogr -q terraces.gpkg inset_houses.gpkg inset_houses -nln buildings
proved terraces.gpkg --gap 3 --max-shift 0.1 --rows no --touch-tolerance 0.1 --trim --trim-keep 0.3 --inset 0.5,1,1.5 --crossed trim \
    --barrier inset_roads.gpkg,width-field=w,gap=0.5 --min-size 3 --hide --hide-weight 1 --rigid-where 'n % 9 = 4'
finish
