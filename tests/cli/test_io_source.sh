# shellcheck shell=bash
# Reading: the choice of the layer, of features, and of geometries.
set -eu
. "$(dirname "${BASH_SOURCE[0]}")/io_layers.sh"
make_squares
separate() { "$SUNDER" separate --quiet "$@"; }
count() { ogrinfo -ro -so "$1" "$2" | sed -n 's/^Feature Count: //p'; }

# ---- which layer: the only polygon layer needs no name, of two one must be named
separate squares.gpkg one.gpkg
[ "$(count one.gpkg squares)" = 3 ] || fail "the only polygon layer was not taken"
cp squares.gpkg two.gpkg
ogr2ogr -update -f GPKG two.gpkg squares.gpkg squares -nln others
refused 1 'squares (Polygon), others (Polygon)' separate two.gpkg out.gpkg
refused 1 'has no layer nowhere; its layers: .*lines' separate --input-layer nowhere two.gpkg out.gpkg
refused 1 'lines is declared as Line String; polygons' separate --input-layer lines squares.gpkg out.gpkg
refused 1 'missing.gpkg' separate missing.gpkg out.gpkg
echo nonsense >nonsense.gpkg
refused 1 'nonsense.gpkg: cannot be opened' separate nonsense.gpkg out.gpkg
printf 'a,b\n1,2\n' >plain.csv
refused 1 'has no geometry' separate plain.csv out.gpkg
[ ! -e out.gpkg ] || fail "a refused input made an output"

# ---- which features
separate --input-layer squares --where "name = 'two'" squares.gpkg where.gpkg
[ "$(count where.gpkg squares)" = 1 ] || fail "--where"
separate --input-layer squares --where "name = 'none'" squares.gpkg none.gpkg
[ "$(count none.gpkg squares)" = 0 ] || fail "a --where that selects nothing does not give an empty layer"
refused 2 'no_such' separate --input-layer squares --where 'no_such = 1' squares.gpkg out.gpkg
refused 2 'WHERE name =' separate --input-layer squares --where 'name =' squares.gpkg out.gpkg
separate --input-layer squares --bbox 95,0,120,20 squares.gpkg bbox.gpkg
[ "$(count bbox.gpkg squares)" = 1 ] || fail "--bbox"
refused 1 '\-\-sql' separate --sql 'SELECT * FROM nowhere' squares.gpkg out.gpkg
refused 2 'crs' separate --input-layer squares --input-crs EPSG:nonsense squares.gpkg out.gpkg
separate --input-layer squares --input-crs EPSG:3857 squares.gpkg crs.gpkg 2>/dev/null
ogrinfo -ro -so crs.gpkg squares | grep -q 'ID\["EPSG",3857\]' || fail "--input-crs"

# ---- --sql: repeated FIDs are written to a field, nothing is lost, and the layer has the name of the file
separate --sql 'SELECT fid, name, geom FROM squares UNION ALL SELECT fid, name, geom FROM squares WHERE fid < 3' \
    --contained separate squares.gpkg twice.gpkg
[ "$(count twice.gpkg squares)" = 5 ] || fail "features with repeated FIDs were lost"
[ "$(dump twice.gpkg squares | grep -c 'sunder_fid (Integer64) = 1$')" = 2 ] || fail "repeated FIDs are not in sunder_fid"
! dump one.gpkg squares | grep -q sunder_fid || fail "a field sunder_fid although FIDs are kept"

# ---- other geometries, collections, arcs: passed through and counted
cat >mixed.csv <<'CSV'
wkt,n
"POLYGON ((0 0,10 0,10 10,0 10,0 0))",1
POINT (3 3),2
"LINESTRING (0 0,50 50)",3
"GEOMETRYCOLLECTION (POINT (9 90),POLYGON ((9 0,19 0,19 10,9 10,9 0)))",4
"CURVEPOLYGON (COMPOUNDCURVE (CIRCULARSTRING (30 0,40 10,30 20),(30 20,20 20,20 0,30 0)))",5
"MULTIPOLYGON (((100 0,110 0,110 10,100 0)),((39 5,49 5,49 15,39 15,39 5)))",6
CSV
ogr2ogr -f GPKG mixed.gpkg mixed.csv -nln mixed -a_srs EPSG:25832 -oo GEOM_POSSIBLE_NAMES=wkt -oo KEEP_GEOM_COLUMNS=NO
separate --stats mixed.json mixed.gpkg mixed_out.gpkg
[ "$(count mixed_out.gpkg mixed)" = 6 ] || fail "features of a mixed layer were lost"
grep -q '"skipped": 2' mixed.json || { cat mixed.json; fail "point and line are not counted as skipped"; }
dump mixed_out.gpkg mixed >mixed.features
grep -q '  POINT (3 3)' mixed.features && grep -q '  LINESTRING (0 0,50 50)' mixed.features || fail "a skipped geometry changed"
grep -q 'CURVEPOLYGON (COMPOUNDCURVE (CIRCULARSTRING (' mixed.features || fail "an arc did not stay an arc"
grep -q 'GEOMETRYCOLLECTION (POINT (' mixed.features || fail "a collection did not stay one"
# The arc bulges out to x = 40, where the last feature starts at 39, so the two must be separated. GDAL's chords of the
# moved arc differ from the moved chords by rounding, so 1e-9 of the overlap of 1 may remain.
deep() { "$SUNDER" check --quiet --no-blocks --allow-conflicts "$1" | awk -F '\t' '$11 + 0 > 1e-9' | grep -q .; }
deep mixed.gpkg || fail "the test's own layer has no overlaps"
! deep mixed_out.gpkg || fail "overlaps remain"

# ---- coordinates that are not numbers: reported with layer and FID
ogr2ogr -f GPKG bad.gpkg squares.gpkg squares
nan=$(printf '47500001%s%s' E9640000 0103000000010000000400000000000000000000000000000000000000000000000000F03F0000000000000000000000000000F03F000000000000F87F00000000000000000000000000000000)
ogrinfo -q bad.gpkg -sql 'DROP TRIGGER IF EXISTS rtree_squares_geom_update1' >/dev/null
for trigger in rtree_squares_geom_update1 rtree_squares_geom_update2 rtree_squares_geom_update3 rtree_squares_geom_update4; do
    ogrinfo -q bad.gpkg -sql "DROP TRIGGER IF EXISTS $trigger" >/dev/null
done
ogrinfo -q bad.gpkg -sql "UPDATE squares SET geom = x'$nan' WHERE fid = 2" >/dev/null
refused 1 'squares, FID 2' separate bad.gpkg out.gpkg
