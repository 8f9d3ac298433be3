# shellcheck shell=bash
# The output keeps everything of the input: fields with all their properties, FIDs, names, metadata, CRS, Z and M. A
# message reports what a format cannot store, once for each field.
set -eu
. "$(dirname "${BASH_SOURCE[0]}")/io_layers.sh"
make_rich

# ---- GeoPackage to GeoPackage: nothing is lost
"$SUNDER" separate --quiet --strict rich.gpkg out.gpkg
ogrinfo -ro rich.gpkg | grep -A1 '^Metadata' >rich.metadata
ogrinfo -ro out.gpkg | grep -A1 '^Metadata' | diff rich.metadata - || fail "the dataset's metadata changed"
schema() { ogrinfo -ro -so "$1" 'Häuser 1' | grep -v -e '^INFO' -e 'using driver' -e '^Extent' -e '^sunder_'; }
schema rich.gpkg >rich.schema
schema out.gpkg >out.schema
diff rich.schema out.schema || fail "the layer's definition changed"
for each in 'IDENTIFIER=The houses' 'DESCRIPTION=Words; with "signs"' 'FID Column = nr' \
    'Geometry Column = outline' 'domain name=heights' 'UNIQUE' "NOT NULL DEFAULT 'w'" 'Integer(Int16)' 'String(JSON)'; do
    grep -q -e "$each" out.schema || fail "$each did not survive"
done
dump rich.gpkg 'Häuser 1' >rich.features
dump out.gpkg 'Häuser 1' | grep -v '^  sunder_' >out.features
diff rich.features out.features || fail "features without a conflict changed"
dump out.gpkg 'Häuser 1' | grep 'sunder_st' >states
[ "$(grep -c skipped states)" = 2 ] && [ "$(grep -c unmoved states)" = 2 ] || fail "null and empty geometries are not skipped"

# ---- moved: attributes stay, X and Y shift, Z and M do not
"$SUNDER" separate --quiet --gap 3 rich.gpkg moved.gpkg
dump moved.gpkg 'Häuser 1' | grep -v -e '^  sunder_' -e POLYGON >moved.features
grep -v POLYGON rich.features | diff - moved.features || fail "attributes changed in a move"
[ "$(dump moved.gpkg 'Häuser 1' | grep -c 'sunder_st (String) = moved')" -gt 0 ] || fail "nothing moved"
heights() { dump "$1" 'Häuser 1' | grep -o '[0-9.]* [0-9.]* [0-9]* [0-9]*[,)]' | sed 's/^[^ ]* [^ ]* //'; }
[ "$(heights rich.gpkg)" = "$(heights moved.gpkg)" ] || fail "Z or M changed in a move"

# ---- Shapefile: losses are reported
"$SUNDER" separate rich.gpkg out.shp >/dev/null 2>warnings
for each in 'field name_of_the_building: called name_of_th' 'no domain kinds' 'field time: Date instead of DateTime' \
    'field key: .*1 value cannot be held as it is (first: FID 7)' 'field small: Integer instead of Int16'; do
    grep -q -e "$each" warnings || { cat warnings; fail "no warning of: $each"; }
done
for field in name_of_the_building kind height key time; do
    [ "$(grep -c "field $field:" warnings)" -eq 1 ] || fail "field $field is not warned of once"
done
[ "$(cat out.cpg)" = UTF-8 ] || fail "the Shapefile is not UTF-8"
dump out.shp out >shape.features
grep -q 'Bäckerei' shape.features && grep -q 'sunder_fid.* = 1000000007' shape.features || fail "text or FID lost"
grep -q 'POLYGON ZM .*),(500002' shape.features || { cat shape.features; fail "the hole is not a hole any more"; }
[ "$(ogrinfo -ro -so out.shp out | sed -n 's/^Feature Count: //p')" = 4 ] || fail "features are missing"
refused 1 --strict "$SUNDER" separate --strict rich.gpkg strict.shp
[ -z "$(ls strict* 2>/dev/null)" ] || fail "--strict left files"

# ---- Shapefile to Shapefile keeps the code page
ogr2ogr -f 'ESRI Shapefile' latin.shp rich.gpkg -sql "SELECT name_of_the_building AS name, outline FROM \"Häuser 1\" WHERE nr < 10" \
    -dim XY -lco ENCODING=ISO-8859-1 2>/dev/null
"$SUNDER" separate --quiet latin.shp latin_out.shp
[ "$(cat latin_out.cpg)" = "$(cat latin.cpg)" ] || fail "the code page changed"
dump latin_out.shp latin_out | grep -q 'Bäckerei' || fail "text changed with the code page"
"$SUNDER" separate --quiet --lco ENCODING=UTF-8 latin.shp latin_utf8.shp
[ "$(cat latin_utf8.cpg)" = UTF-8 ] || fail "--lco ENCODING was ignored"

# ---- a field that has the name of the FID or geometry column
printf 'wkt,fid,geom\n"POLYGON ((0 0,1 0,1 1,0 0))",3000000017,g\n' >named.csv
ogr2ogr -f 'ESRI Shapefile' named.shp named.csv -oo AUTODETECT_TYPE=YES -oo GEOM_POSSIBLE_NAMES=wkt -oo KEEP_GEOM_COLUMNS=NO
"$SUNDER" separate --quiet named.shp named.gpkg
dump named.gpkg named >named.features
grep -q '  fid (.* = 3000000017' named.features && grep -q '  geom (String) = g' named.features ||
    { cat named.features; fail "fields called fid and geom were lost"; }

# ---- a member that lies within another is not a hole of it, and does not become one in a Shapefile
printf 'wkt,n\n"MULTIPOLYGON (((0 0,10 0,10 10,0 10,0 0)),((2 2,4 2,4 4,2 4,2 2)))",1\n' >member.csv
ogr2ogr -f GPKG member.gpkg member.csv -a_srs EPSG:25832 -oo GEOM_POSSIBLE_NAMES=wkt -oo KEEP_GEOM_COLUMNS=NO
"$SUNDER" separate --quiet --stats member.json member.gpkg member.shp
dump member.shp member | grep -q 'MULTIPOLYGON (((.*)),((' || { dump member.shp member; fail "a member became a hole"; }
grep -q '"verified": true' member.json || fail "a Shapefile that came out right is not verified"
