# shellcheck shell=bash disable=SC1091
# --previous and --links with several layers that move: the same sheet again gives the same bytes; a place that is empty
# in one layer makes room in another; a layer that the earlier result does not have is new.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
export SOURCE_DATE_EPOCH=0
worlds() { python3 "$SUNDER_SOURCE/tests/cli/spec_worlds.py" "$@" || fail "spec_worlds.py $1"; }
since() { jq -c '.previous | [.kept, .changed, .new, .gone, .edited, .relaxed]' stats.json; }
most='--layers main,displacement,conflicts,symbols'

for seed in 11 12; do
    rm -f town.gpkg
    worlds make town.gpkg made.json $seed together
    # Without roads and limits nothing has to fall short, so what stands at its preferred places stays there.
    { echo '/* */' && sed 1d made.json | jq 'del(.layers[] | select(.role == "barrier")) | del(.defaults.max_shift)
        | del(.layers[].max_shift) | .gaps |= map(select((.between | inside(["*", "house", "shed", "church", "post"]))))'; } >sheet.json
    # shellcheck disable=SC2086
    expect 0 separate --spec sheet.json first.gpkg -q --allow-conflicts --overwrite $most
    worlds judge first.gpkg town.gpkg sheet.json | grep -q '^[0-9]* 0 0 0$' || fail "seed $seed: something fell short"
    # shellcheck disable=SC2086
    expect 0 separate --spec sheet.json again.gpkg -q --allow-conflicts --overwrite --previous first.gpkg --stats stats.json $most
    same "$(since)" '[67,0,0,0,0,0]' "seed $seed, again:"
    for of in marks moved sheds sheet_displacement; do
        cmp -s <(ogr2ogr -f CSV /vsistdout/ first.gpkg $of -lco GEOMETRY=AS_WKT) \
            <(ogr2ogr -f CSV /vsistdout/ again.gpkg $of -lco GEOMETRY=AS_WKT) || fail "seed $seed, again: other $of"
    done
    # Next month two sheds and a house are gone, and a point has moved: every pair keeps its gap or is listed.
    ogrinfo -q town.gpkg -sql "DELETE FROM sheds WHERE fid IN (3, 7)" >/dev/null
    ogrinfo -q town.gpkg -sql "DELETE FROM houses WHERE fid = 20" >/dev/null
    ogrinfo -q town.gpkg -dialect SQLite -sql "UPDATE points SET geom = ST_Translate(geom, 3, 0, 0) WHERE fid = 4" >/dev/null
    expect 0 separate --spec sheet.json later.gpkg -q --allow-conflicts --overwrite --previous first.gpkg --stats stats.json
    same "$(jq -c '.previous | [.new, .gone, .edited]' stats.json)" '[0,3,1]' "seed $seed, later:"
    read -r _ near found listed < <(worlds judge later.gpkg town.gpkg sheet.json)
    [ "$near" = "$found" ] && [ "$listed" = "$found" ] || fail "seed $seed, later: $near pairs are too near, $listed are listed"
    worlds kept later.gpkg town.gpkg sheet.json
    # What is not free to go back moves less than in a sheet that is made anew.
    expect 0 separate --spec sheet.json anew.gpkg -q --allow-conflicts --overwrite
    for result in later anew; do
        for of in moved sheds marks; do
            ogr2ogr -overwrite -q -nln "${result}_$of" -update both.gpkg $result.gpkg $of 2>/dev/null ||
                ogr2ogr -q -nln "${result}_$of" both.gpkg $result.gpkg $of
            ogr2ogr -overwrite -q -nln "first_$of" -update both.gpkg first.gpkg $of
        done
    done
    changed() {
        for of in moved sheds marks; do
            ogrinfo -q both.gpkg -dialect SQLite -sql "SELECT count(*) AS n FROM $1_$of AS b JOIN first_$of AS a USING (fid)
                WHERE a.sunder_dx <> b.sunder_dx OR a.sunder_dy <> b.sunder_dy" | awk '/n \(/ { print $NF }'
        done | paste -sd+ | bc
    }
    [ "$(changed later)" -le "$(changed anew)" ] || fail "seed $seed: $(changed later) features changed, and $(changed anew) anew"
done

# ---- Three squares in a row, of two layers. The middle one is gone, so the others go back.
squares() { # FILE ID:LEFT:RIGHT ...
    rm -f "$1.gpkg"
    { echo id,WKT && for s in "${@:2}"; do
        IFS=: read -r id a b <<<"$s"
        echo "$id,\"POLYGON(($a 0,$b 0,$b 4,$a 4,$a 0))\""
    done; } | layer "$1.gpkg" "$1" Polygon
}
squares ends 1:0:4 2:8.5:12
squares middles 3:4.5:8 4:100:104
cat >row.json <<'JSON'
{"defaults": {"gap": 1, "rows": "no"},
 "layers": [{"name": "a", "source": "ends.gpkg", "role": "move"}, {"name": "b", "source": "middles.gpkg", "role": "move"}]}
JSON
expect 0 separate --spec row.json three.gpkg -q
dx() { ogrinfo -q "$1" -sql "SELECT sunder_dx FROM $2 WHERE id = $3" | awk '/sunder_dx/ { print $NF }'; }
same "$(dx three.gpkg a 1) $(dx three.gpkg a 2)" '-0.5 0.5' 'three:'
squares middles 4:100:104
jq '.layers[].id_field = "id"' row.json >keys.json
expect 0 separate --spec keys.json two.gpkg -q --previous three.gpkg --stats stats.json
same "$(dx two.gpkg a 1) $(dx two.gpkg a 2) $(since)" '0 0 [1,2,0,1,0,2]' 'two:'
expect 0 separate --spec keys.json two.gpkg -q --overwrite --previous three.gpkg --previous-relax no --stats stats.json
same "$(dx two.gpkg a 1) $(dx two.gpkg a 2) $(since)" '-0.5 0.5 [3,0,0,1,0,0]' 'two that stay:'
# A block of both layers goes back together, though only one member is near the empty place.
squares ends 1:0:4 2:8.5:12
squares middles 3:4.5:8 5:12:30
expect 0 separate --spec row.json block.gpkg -q
squares middles 5:12:30
expect 0 separate --spec keys.json freed.gpkg -q --previous block.gpkg --stats stats.json
same "$(dx freed.gpkg b 5) $(jq .previous.relaxed stats.json)" '0 3' 'a block of two layers:'

# A layer that the earlier result does not have is new; without --quiet the run says so.
squares sheds 9:50:54
jq '.layers += [{"name": "c", "source": "sheds.gpkg", "role": "move"}]' keys.json >more.json
expect 0 separate --spec more.json more.gpkg --previous block.gpkg --stats stats.json
says err 'it has no layer c, whose features are new'
same "$(jq .previous.new stats.json)" 1 'a new layer:'
# One layer in the sheet, under a name that its source does not have, beside what went along.
squares along 7:1:2
jq '.layers = [.layers[0], {"name": "z", "source": "along.gpkg", "role": "follow"}]' keys.json >one.json
expect 0 separate --spec one.json one.gpkg -q
expect 0 separate --spec one.json once_more.gpkg -q --previous one.gpkg --stats stats.json
same "$(since)" '[2,0,0,0,0,0]' 'one layer:'

# ---- Links: places between the old ones prefer the moves of the links
printf 'id,WKT\n1,"LINESTRING(0 0,2 0)"\n2,"LINESTRING(14 0,16 0)"\n' | layer links.gpkg links LineString
jq '.defaults.gap = 0' keys.json >free.json
expect 0 separate --spec free.json linked.gpkg -q --links links.gpkg --links-radius 100
same "$(dx linked.gpkg a 1) $(dx linked.gpkg b 5)" '2 2' 'links:'
finish
