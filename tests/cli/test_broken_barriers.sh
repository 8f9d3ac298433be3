# shellcheck shell=bash disable=SC1091
# Barriers with broken geometry (broken_barriers.py). An open ring is closed, as it is in polygons of a layer. A message
# names rings of fewer than three vertices. A coordinate that is not finite ends the run with a message that names it.
# Every command that reads barriers is tested, with and without a limit on moves: with a limit GDAL compares geometries
# with a box, which works only for valid ones.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }

printf 'id,WKT\n' >empty.csv
ogr2ogr -q empty.gpkg empty.csv -nln b -a_srs EPSG:25832 -nlt GEOMETRY -lco SPATIAL_INDEX=NO
python3 "$SUNDER_SOURCE/tests/cli/broken_barriers.py" || fail "broken_barriers.py"
layer in.gpkg houses POLYGON <houses.csv

written() { ogrinfo -q -al "$1" houses | grep -v Layer; }
# The status and the result of each command have to be the same with both barriers.
alike() { # BROKEN SOUND OPTIONS: options of --barrier
    local -a status_of=() result=()
    local barrier
    for barrier in "$1" "$2"; do
        run check in.gpkg --barrier "$barrier.gpkg$3"
        sed "s/$barrier//g" out >"found_$barrier"
        status_of+=("$status")
        for limit in 1000 10; do
            run separate in.gpkg out.gpkg --overwrite --quiet --barrier "$barrier.gpkg$3" --max-shift $limit
            status_of+=("$status")
            written out.gpkg >>"found_$barrier"
        done
    done
    same "${status_of[*]:0:3}" "${status_of[*]:3}" "$1$3, status"
    cmp -s "found_$1" "found_$2" || fail "$1$3: $(diff "found_$1" "found_$2" | head -3)"
}
alike open closed ''
alike open closed ,as=boundary
# With a spatial index GDAL selects by boxes first, and then compares the geometry with the box.
for name in one_0 one_1 open; do ogr2ogr -q indexed_$name.gpkg $name.gpkg 2>/dev/null; done
alike indexed_one_0 closed_0 ''
alike indexed_one_1 closed_1 ''

# The same in parts and in shards.
run separate in.gpkg whole.gpkg --quiet --barrier closed.gpkg --max-shift 10
whole=$status
run separate in.gpkg parts.gpkg --quiet --barrier indexed_open.gpkg --max-shift 10 --max-memory 300M
same "$status" "$whole" "in parts"
expect 0 plan in.gpkg plan --shards 2 --quiet --barrier indexed_open.gpkg --max-shift 10
for k in 1 2; do expect 0 separate --shard $k plan --quiet; done
run merge plan merged.gpkg --quiet
same "$status" "$whole" "merged"
for made in parts merged; do same "$(written $made.gpkg)" "$(written whole.gpkg)" "$made"; done

# A message names rings that enclose no area.
run separate in.gpkg o.gpkg --barrier short.gpkg
same "$(grep -c '^sunder: warning: barrier short.gpkg, layer b, FID [0-9]*: invalid: polygon [01], ring [01], vertex 0 .*under three' err)" 10
run separate in.gpkg o.gpkg --overwrite --barrier short.gpkg --max-shift 10
[ "$status" = 0 ] || [ "$status" = 3 ] || fail "short rings: status $status"
refused 1 'barrier short.gpkg, layer b, FID 1: polygon' separate in.gpkg n.gpkg --barrier short.gpkg --invalid fail

# A message names coordinates that are not numbers.
for k in 0 1; do
    refused 1 "nan_$k.gpkg: layer b, FID 1: a coordinate is not a finite number" check in.gpkg --barrier nan_$k.gpkg
    refused 1 "nan_$k.gpkg: layer b, FID 1: a coordinate is not a finite number" separate in.gpkg n.gpkg --barrier nan_$k.gpkg --max-shift 10
    expect 0 check in.gpkg --barrier nan_$k.gpkg --invalid skip
done

# --bbox: a message names a geometry that GDAL cannot compare with the box.
for command in "check open.gpkg" "separate open.gpkg n.gpkg" "buffer open.gpkg n.gpkg --shape disc:1"; do
    # shellcheck disable=SC2086
    refused 1 ': GDAL cannot compare it with the box of --bbox: a ring is not closed' $command --bbox 110300,20,110310,30
done
finish
