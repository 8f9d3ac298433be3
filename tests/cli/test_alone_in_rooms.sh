# shellcheck shell=bash disable=SC1091
# Symbols without a limit on moves, each alone among barriers with and without sides (alone_in_rooms.py). Each moves to
# the nearest free place, or stays with a proof, verified by a checker, that there is none. A fifth of the effort
# suffices, and halves the proofs of bounds.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }

printf 'id,WKT\n' >empty.csv
for layer in symbols {line,area,boundary}_{yes,no}; do
    ogr2ogr -q empty_$layer.gpkg empty.csv -nln $layer -a_srs EPSG:25832 -nlt GEOMETRY -lco SPATIAL_INDEX=NO
done
python3 "$SUNDER_SOURCE/tests/cli/alone_in_rooms.py" make || fail "alone_in_rooms.py"
for symbol in *.symbol; do
    name=${symbol%.symbol}
    options=(--symbol "$(cat "$symbol")" --gap "$(cat "$name.gap")")
    for side in yes no; do
        for kind in line area boundary; do
            as=$kind
            [ $kind != line ] || as=area
            options+=(--barrier "${name}_${kind}_$side.gpkg,side=$side,as=$as")
        done
    done
    expect 3 separate "$name.gpkg" "$name.out.gpkg" --quiet --effort 0.2 --ease no "${options[@]}" --proof "$name.jsonl" --layers main,displacement,conflicts
    python3 "$SUNDER_SOURCE/tests/proof/check_proof.py" "$name.jsonl" "$name.gpkg" --result "$name.out.gpkg" --ease no "${options[@]}" \
        >checked 2>&1 || fail "the proofs of $name: $(tail -n 1 checked)"
done
python3 "$SUNDER_SOURCE/tests/cli/alone_in_rooms.py" check || fail "places"

# A corridor exactly as wide as the symbol, crossed by lines up to a wall with sides that ends within the corridor. If it
# ends above the middle the symbol passes it. If it ends below or at the middle, it is proved that there is no room: the
# symbol's anchor would touch the wall.
wkt() { printf 'n,WKT\n' && printf '1,"%s"\n' "$@"; }
wkt 'POINT(0 0)' | layer spot.gpkg spot POINT
wkt 'LINESTRING(-3 1,20 1,20 -1,-3 -1,-3 1)' 'LINESTRING(0 -1,0 1)' 'LINESTRING(1.5 -1,1.5 1)' 'LINESTRING(3 -1,3 1)' \
    'LINESTRING(-1.5 -1,-1.5 1)' | layer lines.gpkg lines LINESTRING
ends_at() { # HEIGHT STATUS STATE,DX,DY REASON
    rm -f walls.gpkg
    wkt 'LINESTRING(-3.5 -1.5,20.5 -1.5,20.5 1.5,-3.5 1.5,-3.5 -1.5)' "LINESTRING(4 $1,4 1)" | layer walls.gpkg walls LINESTRING
    local options=(--symbol square:2 --barrier "lines.gpkg,side=no" --barrier walls.gpkg)
    expect "$2" separate spot.gpkg spot.out.gpkg --overwrite --quiet "${options[@]}" --proof spot.jsonl
    python3 "$SUNDER_SOURCE/tests/proof/check_proof.py" spot.jsonl spot.gpkg --result spot.out.gpkg "${options[@]}" \
        >checked 2>&1 || fail "the proofs with a wall down to $1: $(tail -n 1 checked)"
    same "$(ogr2ogr -f CSV /vsistdout/ spot.out.gpkg -sql 'SELECT sunder_st, sunder_dx, sunder_dy FROM spot' | tail -n 1)" "$3" "wall down to $1:"
    same "$(ogr2ogr -f CSV /vsistdout/ spot.out.gpkg -sql 'SELECT DISTINCT reason FROM spot_conflicts' | tail -n +2 | tr -d '"')" "$4" "wall down to $1:"
}
ends_at 0.25 0 moved,5,0 ''
ends_at 0 3 blocked,0,0 no_room
ends_at -0.25 3 blocked,0,0 no_room
finish
