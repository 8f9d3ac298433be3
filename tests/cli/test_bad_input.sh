# shellcheck shell=bash disable=SC1091
# Input that is wrong, unusual or empty: the run gives the right result, or one clear line of message and no output.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

layer in.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,"POLYGON((3 0,7 0,7 4,3 4,3 0))"
X
# Both separate and check refuse the input before anything is written.
both() { either_way 1 "$@"; }
either_way() {
    local wanted=$1 words=$2 input=$3
    shift 3
    refused "$wanted" "$words" separate "$input" never.gpkg "$@"
    refused "$wanted" "$words" check "$input" "$@"
    rm -f never.gpkg
}
both 'no such file' nothing.gpkg
refused 1 'the order is INPUT OUTPUT' separate nothing.gpkg in.gpkg
both 'houses' in.gpkg -l huts
echo 'this is no GeoPackage' >text.gpkg
both 'text.gpkg' text.gpkg
head -c 5000 in.gpkg >cut.gpkg
both 'cut.gpkg' cut.gpkg
cp in.gpkg broken.gpkg
printf 'nonsense' | dd of=broken.gpkg bs=1 seek=100 conv=notrunc 2>/dev/null
both 'broken.gpkg' broken.gpkg
ogr2ogr whole.geojson in.gpkg
head -c 400 whole.geojson >cut.geojson
both 'cut.geojson' cut.geojson
escape=$(printf 'no\033[31m\013such.gpkg')
both 'such.gpkg' "$escape"
if LC_ALL=C grep -q '[[:cntrl:]]' err; then fail "control characters in a message"; fi
: >nothing.geojson
both 'nothing.geojson' nothing.geojson
for part in shx shp dbf; do # an incomplete Shapefile
    ogr2ogr whole.shp in.gpkg -lco ENCODING=UTF-8
    for each in whole.*; do cp "$each" "cut.${each#*.}"; done
    case $part in
    shx) rm cut.shx ;;
    shp) truncate -s 250 cut.shp ;;
    dbf) truncate -s 80 cut.dbf ;;
    esac
    both 'cut' cut.shp
    rm -f cut.??? whole.???
done
gdal_create -q -of GTiff -outsize 4 4 raster.tif 2>/dev/null && both 'raster.tif' raster.tif
both '/dev/null' /dev/null
mkdir empty.dir
both 'empty.dir' empty.dir
cp in.gpkg secret.gpkg
chmod 000 secret.gpkg
[ -r secret.gpkg ] || both 'secret.gpkg' secret.gpkg # (root can read every file)
rm -f secret.gpkg
cp in.gpkg two.gpkg
ogr2ogr -update two.gpkg in.gpkg houses -nln sheds
both 'sheds' two.gpkg
says err houses
layer roads.gpkg roads LINESTRING <<'X'
id,WKT
1,"LINESTRING(0 0,1 0)"
X
both 'roads' roads.gpkg
ogr2ogr plain.gpkg in.gpkg -nlt NONE
both 'no geometry' plain.gpkg
either_way 2 'where' in.gpkg --where 'id = = 1'
either_way 2 'where' in.gpkg --where 'nothing = 1'
both 'sql' in.gpkg --sql 'SELEKT 1'
either_way 2 'EPSG:99999999' in.gpkg --input-crs EPSG:99999999

# Destinations that cannot be written.
refused 1 'in.gpkg' separate in.gpkg in.gpkg
refused 1 'in.gpkg' separate in.gpkg ./in.gpkg --overwrite
refused 1 'in.gpkg' separate in.gpkg in.gpkg --update
expect 0 separate in.gpkg in.gpkg --update -nln moved -q
same "$(count in.gpkg houses) $(count in.gpkg moved)" '2 2' "an update of the input with new names"
refused 1 'in.gpkg' separate in.gpkg in.gpkg -l houses --update -nln moved
refused 1 'Not a directory' separate in.gpkg in.gpkg/o.gpkg -l houses
refused 1 'no/such' separate in.gpkg no/such/place.gpkg -l houses
refused 2 'nonsense' separate in.gpkg o.nonsense -l houses
refused 2 'Nonsense' separate in.gpkg o.gpkg -l houses --of Nonsense
mkdir locked
chmod 555 locked
[ -w locked ] || refused 1 'locked' separate in.gpkg locked/o.gpkg -l houses
if mkdir readonly && mount -t tmpfs -o ro none readonly 2>/dev/null; then
    refused 1 'readonly' separate in.gpkg readonly/o.gpkg -l houses
    refused 1 'readonly' separate in.gpkg o.gpkg -l houses --stats readonly/s.json
    refused 1 'readonly' check in.gpkg readonly/o.gpkg -l houses
    refused 1 'readonly' sum square:1 square:1 readonly/o.gpkg
    refused 1 'readonly' pair square:1 square:1 readonly/o.gpkg
    umount readonly
fi
[ ! -d /proc/self ] || refused 1 '/proc' separate in.gpkg /proc/o.gpkg -l houses
if [ -w /dev/full ]; then
    for command in "sum square:1 square:1" "pair square:1 square:1" "check in.gpkg -l houses" "--help" "sum --help"; do
        status=0
        # shellcheck disable=SC2086 # words
        "$SUNDER" $command >/dev/full 2>err || status=$?
        [ "$status" -eq 1 ] && [ "$(grep -c '^sunder: error: ' err)" -eq 1 ] || fail "a full disk, $command: status $status"
    done
    refused 1 '/dev/full' sum square:1 square:1 --stats /dev/full
fi
if mkdir disk && mount -t tmpfs -o size=128k none disk 2>/dev/null; then
    trap 'umount "$work/disk"; rm -rf "$work"' EXIT
    refused 1 'disk' separate "$SUNDER_SOURCE/datasets-synthetic/town.gpkg" disk/o.gpkg -l buildings
    same "$(ls -A disk | wc -l)" 0 "files left on a full disk:"
else
    echo "not tried: a full disk (no right to mount one)"
fi

# Results beyond the range of doubles.
huge='POLYGON ((0 0, 1e308 0, 1e308 1e308, 0 1e308))'
refused 1 'leaves the range of doubles' sum "$huge" "$huge"
refused 1 'leaves the range of doubles' sum "$huge" "$huge" o.gpkg
expect 0 sum "$huge" "$huge" --exact
expect 0 pair "$huge" "$huge"
refused 2 'a double can hold' sum 'POLYGON ((0 0, 1e309 0, 0 1e309))' square:1
refused 2 'not a finite number' pair "$huge" "$huge" --gap 1e309
# sum and pair refuse layers for the same reasons
for command in sum pair; do
    refused 1 'no such file' $command nothing.gpkg square:1
    refused 1 'huts' $command in.gpkg square:1 -l huts
    refused 1 'text.gpkg' $command square:1 text.gpkg
    refused 1 'two.gpkg' $command two.gpkg square:1
    refused 1 'roads' $command roads.gpkg square:1
    refused 2 'where' $command in.gpkg square:1 -l houses --where 'id = = 1'
    refused 1 'no/such' $command square:1 square:1 no/such/place.gpkg
    refused 1 'in.gpkg' $command in.gpkg square:1 in.gpkg -l houses --overwrite
    refused 1 'exists already' $command square:1 square:1 in.gpkg
    refused 2 'wrong' $command square:1 square:1 --invalid wrong
done

# Unusual geometries.
ogr2ogr coordinates.shp in.gpkg houses
# The first x of the first ring is at byte 156 of the file.
patch() { printf '%b' "$1" | dd of=coordinates.shp bs=1 seek=156 conv=notrunc 2>/dev/null; }
patch '\0\0\0\0\0\0\0370\0177'
both 'FID 0' coordinates.shp
says err 'coordinates' # the layer
patch '\0\0\0\0\0\0\0360\0377'
both 'FID 0' coordinates.shp
refused 1 'FID 0' sum coordinates.shp square:1
refused 1 'FID 0' pair square:1 coordinates.shp
layer odd.gpkg odd GEOMETRY <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,"POLYGON((3 0,7 4))"
3,"POLYGON((20 0,22 2,22 0,20 2,20 0))"
4,POLYGON EMPTY
5,
6,"POINT(1 1)"
7,"GEOMETRYCOLLECTION(POINT(1 1),POLYGON((3 0,7 0,7 4,3 4,3 0)))"
8,"POLYGON((0 0,0 0,0 0,0 0))"
X
expect 0 separate odd.gpkg odd-out.gpkg --stats s.json
same "$(count odd-out.gpkg odd) $(jq -c '[.features,.invalid,.null,.moved,.conflicts.before.overlap,.conflicts.after.overlap]' s.json)" '8 [8,3,2,2,1,0]'
for fid in 2 3 8; do says err "layer odd, FID $fid: invalid"; done
same "$(for i in 1 2 3 4 5 6 7 8; do value odd-out.gpkg odd $i sunder_st; done | tr '\n' ' ')" 'moved skipped unmoved skipped skipped skipped moved skipped '
expect 0 separate odd.gpkg odd-skip.gpkg --invalid skip --stats s.json
same "$(value odd-skip.gpkg odd 3 sunder_st) $(count odd-skip.gpkg odd)" 'skipped 8'
both 'FID 2' odd.gpkg --invalid fail
same "$(geometry odd-out.gpkg odd 3)" "$(geometry odd.gpkg odd 3)" "an invalid feature is written as it was"

# Empty input.
layer empty.gpkg empty POLYGON <<'X'
id,WKT
X
expect 0 check empty.gpkg
expect 0 separate empty.gpkg empty-out.gpkg --gap 3 --stats s.json
same "$(count empty-out.gpkg empty) $(jq -c '[.features,.verified,.displacement.max_fid,.displacement.optimality_gap]' s.json)" '0 [0,true,null,0]'
expect 0 separate in.gpkg none.gpkg -l houses --where 'id > 99' -q
same "$(count none.gpkg houses)" 0
expect 0 check in.gpkg -l houses --bbox 100,100,101,101
expect 0 sum empty.gpkg square:1
same "$(jq -c .polygons out)" '[]'

# FIDs that occur twice, and features without a FID.
expect 0 separate in.gpkg twice.gpkg --sql 'SELECT fid, geom FROM houses UNION ALL SELECT fid, geom FROM houses' --contained separate -q
same "$(count twice.gpkg in)" 4 "nothing is lost:"
expect 0 check twice.gpkg -l in --no-blocks
expect 0 separate in.gpkg unnumbered.gpkg --dialect sqlite --sql 'SELECT geometry FROM (SELECT geom AS geometry FROM houses)' -q
same "$(count unnumbered.gpkg in)" 2
# Fields of an earlier run are replaced, and one line reports each.
expect 0 separate unnumbered.gpkg third.gpkg
for field in sunder_dx sunder_dy sunder_len sunder_st sunder_blk; do
    same "$(grep -c "^sunder: warning: .*$field" err)" 1 "warnings about $field:"
    same "$(ogrinfo -ro -so third.gpkg in | grep -c "^$field: ")" 1 "fields $field:"
done
ogr2ogr capitals.gpkg third.gpkg -sql 'SELECT sunder_st AS SUNDER_ST, sunder_dx AS "Sunder_DX", geometry FROM "in"' -nln capitals
expect 0 separate capitals.gpkg fourth.gpkg -q
same "$(ogrinfo -ro -so fourth.gpkg capitals | grep -ci '^sunder_[a-z]*: ')" 5 "fields, whatever their capitals:"
# An output path that is not a regular file is not replaced, even with --overwrite, and the program does not wait for
# it.
mkfifo pipe
mkdir kept
touch kept/precious
for format in GeoJSON GPKG; do
    refused 1 'not a regular file' separate in.gpkg pipe --input-layer houses --of $format --overwrite
    refused 1 'is a directory' separate in.gpkg kept --input-layer houses --of $format --overwrite
done
rm pipe
finish
