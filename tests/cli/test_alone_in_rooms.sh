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
    expect 3 separate "$name.gpkg" "$name.out.gpkg" --quiet --effort 0.2 "${options[@]}" --proof "$name.jsonl" --layers main,displacement,conflicts
    python3 "$SUNDER_SOURCE/tests/proof/check_proof.py" "$name.jsonl" "$name.gpkg" --result "$name.out.gpkg" "${options[@]}" \
        >checked 2>&1 || fail "the proofs of $name: $(tail -n 1 checked)"
done
python3 "$SUNDER_SOURCE/tests/cli/alone_in_rooms.py" check || fail "places"
finish
