# shellcheck shell=bash
# Formats: which properties are verified for each; standard output; formats that change coordinates; dates set by
# SOURCE_DATE_EPOCH.
set -eu
. "$(dirname "${BASH_SOURCE[0]}")/io_layers.sh"
make_squares
separate() { "$SUNDER" separate --quiet --input-layer squares "$@"; }
verified() { sed -n 's/.*"verified": *\([a-z]*\).*/\1/p' "$1"; }

# Thirds have no short decimal representation, so they reveal a format that rounds.
cat >thirds.csv <<'CSV'
wkt,name
"POLYGON ((451234.33333333331 5411234.666666667,451244.1 5411234.666666667,451244.1 5411244.1,451234.33333333331 5411234.666666667))",one
"POLYGON ((451243.7 5411234.7777777771,451253.1 5411235.1,451253.1 5411244.1,451243.7 5411234.7777777771))",two
CSV
ogr2ogr -f GPKG thirds.gpkg thirds.csv -nln squares -nlt POLYGON -a_srs EPSG:25832 -oo GEOM_POSSIBLE_NAMES=wkt -oo KEEP_GEOM_COLUMNS=NO

# ---- exact formats: verified, with equal doubles after any sequence of formats
separate --stats gpkg.json thirds.gpkg first.gpkg
for each in shp geojson fgb sqlite; do
    separate --stats "$each.json" thirds.gpkg "exact.$each"
    [ "$(verified "$each.json")" = true ] || { cat "$each.json"; fail "$each is not verified"; }
    # Converted back to a GeoPackage: the stored bytes of the geometries show whether every double was kept. Rings may
    # start at another vertex, so vertices are compared one by one.
    layer=squares
    if [ "$each" = shp ]; then layer=exact; fi # the layer of a Shapefile has the name of its file
    ogr2ogr -f GPKG "back_$each.gpkg" "exact.$each" "$layer" -nln squares -lco GEOMETRY_NAME=geom
done
vertices() {
    ogrinfo -q -ro "$1" -dialect sqlite -sql 'WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 3)
        SELECT hex(ST_AsBinary(ST_PointN(ST_ExteriorRing(ST_GeometryN(s.'"$2"', 1)), n.i))) AS p FROM squares s, n' |
        sed -n 's/.*p (String) = //p' | sort
}
if vertices first.gpkg geom >first.vertices 2>/dev/null && [ "$(wc -l <first.vertices)" = 6 ]; then
    for each in shp geojson fgb sqlite; do
        # The first three vertices of a closed triangle are its corners, wherever the ring starts.
        vertices "back_$each.gpkg" geom | sort -u | diff <(sort -u first.vertices) - || fail "$each changed a coordinate"
    done
else
    echo "note: GDAL has no SpatiaLite here; the stored bytes are not compared"
fi

# ---- inexact formats are reported
separate --stats csv.json thirds.gpkg rounded.csv 2>/dev/null
[ "$(verified csv.json)" = false ] || fail "CSV rounds, and is called verified"
separate --lco COORDINATE_PRECISION=3 --stats rounded.json thirds.gpkg rounded.geojson 2>/dev/null
[ "$(verified rounded.json)" = false ] || fail "rounded GeoJSON is called verified"
# creation options that the driver does not have
losses() { separate --overwrite --stats options.json "$@" thirds.gpkg options.gpkg 2>/dev/null && jq -c .losses options.json; }
for words in '--lco SPATIAL_INDX=NO' '--co VERSIONS=1.2'; do
    # shellcheck disable=SC2086
    [ "$(losses $words)" = "[\"creation option ${words#* } has no effect: GPKG has no such option\"]" ] || fail "$words: $(losses $words)"
done
[ "$(losses --lco spatial_index=NO --co VERSION=1.2)" = '[]' ] || fail "creation options that GDAL has"
for each in kml geojsonl; do
    refused 1 'reproject' separate thirds.gpkg "moved.$each"
    [ ! -e "moved.$each" ] || fail "a refused format left a file"
done
refused 1 'reproject' separate --lco RFC7946=YES thirds.gpkg moved.geojson
separate --allow-inexact-output --stats seq.json thirds.gpkg moved.geojsonl 2>/dev/null
[ "$(verified seq.json)" = false ] && [ -s moved.geojsonl ] || fail "reprojected GeoJSONSeq is called verified"
separate --allow-inexact-output --layers main --where "name = 'one'" thirds.gpkg single.geojsonl 2>/dev/null ||
    fail "GeoJSONSeq of one feature is not read back"

# ---- standard output: the complete main layer, and nothing else
"$SUNDER" separate --input-layer squares --of GeoJSON squares.gpkg /vsistdout/ >stdout.geojson 2>message
[ "$(ogrinfo -ro -al -so stdout.geojson | sed -n 's/^Feature Count: //p')" = 3 ] || fail "standard output is not a complete layer"
refused 1 'several files' separate --of 'ESRI Shapefile' squares.gpkg /vsistdout/
[ ! -s refused.out ] || fail "something was written before the refusal"
refused 2 'the format is not known from the name' separate squares.gpkg /vsistdout/

# ---- inside an archive
separate squares.gpkg /vsizip/archive.zip/out.gpkg
[ "$(ogrinfo -ro -so /vsizip/archive.zip/out.gpkg squares | sed -n 's/^Feature Count: //p')" = 3 ] || fail "no layer in the archive"

# ---- the same bytes at another time
SOURCE_DATE_EPOCH=1700000000 separate squares.gpkg one.gpkg
sleep 1.1
SOURCE_DATE_EPOCH=1700000000 separate squares.gpkg two.gpkg
cmp one.gpkg two.gpkg || fail "SOURCE_DATE_EPOCH does not make the bytes reproducible"
for each in one two; do
    cp squares.gpkg "updated_$each.gpkg"
    SOURCE_DATE_EPOCH=1700000000 separate --update --output-layer apart squares.gpkg "updated_$each.gpkg"
    sleep 1.1
done
cmp updated_one.gpkg updated_two.gpkg || fail "SOURCE_DATE_EPOCH does not make the bytes of an update reproducible"
separate squares.gpkg three.gpkg
! cmp -s one.gpkg three.gpkg || fail "the date is not in the file: the comparison proves nothing"
