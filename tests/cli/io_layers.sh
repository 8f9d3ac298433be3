# shellcheck shell=bash
# Common parts of the tests of reading and writing, to be sourced: a scratch directory, functions, and layers that are
# hard to copy. All of it is made with GDAL's own programs.

for tool in ogr2ogr ogrinfo; do
    command -v "$tool" >/dev/null || { echo "skipped: $tool is not installed"; exit 77; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() { echo "FAILED: $*"; exit 1; }

# refused STATUS WORDS COMMAND...: the command has to end with this status and one line on stderr that contains the
# words.
refused() {
    local status=0 wanted=$1 words=$2
    shift 2
    "$@" >refused.out 2>refused.err || status=$?
    [ "$status" -eq "$wanted" ] || { cat refused.err; fail "exit status $status instead of $wanted: $*"; }
    [ "$(grep -c '^sunder: error: ' refused.err)" -eq 1 ] || { cat refused.err; fail "not exactly one error line: $*"; }
    grep -q -e "$words" refused.err || { cat refused.err; fail "\"$words\" is not in the message: $*"; }
    [ -z "$(ls -d .sunder-* 2>/dev/null)" ] || fail "a staging directory is left: $*"
}

# Prints features. 15 digits do not distinguish neighbouring doubles; tests that need this compare the stored bytes.
dump() { ogrinfo -q -ro "$1" "${@:2}"; }

# Layer "Häuser 1" of rich.gpkg: non-default names for everything, constraints, subtypes, Z and M, a null and an empty
# geometry, gaps in the FIDs; two houses 1 m apart, so that a gap moves them.
make_rich() {
    cat >rich.csv <<'CSV'
nr,wkt,name_of_the_building,kind,height,key,small,yes,f32,json,day,time
7,"POLYGON ZM ((500000.1 5400000.2 1 2,500010.3 5400000.2 3 4,500010.3 5400010.7 5 6,500000.1 5400010.7 7 8,500000.1 5400000.2 1 2),(500002 5400002 1 1,500002 5400004 1 1,500004 5400004 1 1,500004 5400002 1 1,500002 5400002 1 1))",Bäckerei,g,12.345678901234567,1152921504606846977,-7,1,0.5,"{""a"": 1}",2020/02/29,2021/03/04 05:06:07.123+00
1000000007,"POLYGON ZM ((500011.3 5400000.2 1 2,500021 5400000.2 3 4,500021 5400010 5 6,500011.3 5400000.2 1 2))",,w,,3,,,,,,
12,,null geometry,w,,4,,,,,,
13,POLYGON EMPTY,empty geometry,w,,5,,,,,,
CSV
    cat >rich.vrt <<'VRT'
<OGRVRTDataSource><OGRVRTLayer name="source"><SrcDataSource relativeToVRT="1">rich.csv</SrcDataSource>
<OpenOptions><OOI key="EMPTY_STRING_AS_NULL">YES</OOI></OpenOptions><SrcLayer>rich</SrcLayer>
<FID>nr</FID><GeometryType>wkbPolygonZM</GeometryType><LayerSRS>EPSG:25832</LayerSRS><GeometryField encoding="WKT" field="wkt"/>
<Field name="name_of_the_building" type="String" width="300"/>
<Field name="kind" type="String" width="5" nullable="false" default="'w'"/>
<Field name="height" type="Real"/>
<Field name="key" type="Integer64" unique="true"/>
<Field name="small" type="Integer" subtype="Int16"/>
<Field name="yes" type="Integer" subtype="Boolean"/>
<Field name="f32" type="Real" subtype="Float32"/>
<Field name="json" type="String" subtype="JSON"/>
<Field name="day" type="Date"/>
<Field name="time" type="DateTime"/>
</OGRVRTLayer></OGRVRTDataSource>
VRT
    GDAL_XML_VALIDATION=NO ogr2ogr -f GPKG rich.gpkg rich.vrt -nln 'Häuser 1' -preserve_fid \
        -lco FID=nr -lco GEOMETRY_NAME=outline -lco IDENTIFIER='The houses' -lco DESCRIPTION='Words; with "signs"' \
        -mo source='Office & Co'
    # A coded and a range domain, as in the schema extension of GeoPackage.
    ogrinfo -q rich.gpkg -sql "CREATE TABLE IF NOT EXISTS gpkg_data_columns (table_name TEXT NOT NULL, column_name TEXT NOT NULL, name TEXT, title TEXT, description TEXT, mime_type TEXT, constraint_name TEXT, CONSTRAINT pk_gdc PRIMARY KEY (table_name, column_name))" >/dev/null
    ogrinfo -q rich.gpkg -sql "CREATE TABLE IF NOT EXISTS gpkg_data_column_constraints (constraint_name TEXT NOT NULL, constraint_type TEXT NOT NULL, value TEXT, min NUMERIC, min_is_inclusive BOOLEAN, max NUMERIC, max_is_inclusive BOOLEAN, description TEXT, CONSTRAINT gdcc_ntv UNIQUE (constraint_name, constraint_type, value))" >/dev/null
    ogrinfo -q rich.gpkg -sql "INSERT INTO gpkg_extensions SELECT * FROM (VALUES ('gpkg_data_columns', NULL, 'gpkg_schema', 'http://www.geopackage.org/spec121/#extension_schema', 'read-write'), ('gpkg_data_column_constraints', NULL, 'gpkg_schema', 'http://www.geopackage.org/spec121/#extension_schema', 'read-write')) WHERE column1 NOT IN (SELECT table_name FROM gpkg_extensions WHERE table_name IS NOT NULL)" >/dev/null
    ogrinfo -q rich.gpkg -sql "INSERT INTO gpkg_data_column_constraints VALUES ('kinds', 'enum', 'w', NULL, NULL, NULL, NULL, 'dwelling'), ('kinds', 'enum', 'g', NULL, NULL, NULL, NULL, 'trade'), ('heights', 'range', NULL, 0, 1, 300, 0, NULL)" >/dev/null
    ogrinfo -q rich.gpkg -sql "INSERT INTO gpkg_data_columns VALUES ('Häuser 1', 'kind', NULL, NULL, NULL, NULL, 'kinds'), ('Häuser 1', 'height', NULL, NULL, NULL, NULL, 'heights')" >/dev/null
    ogrinfo -ro -so rich.gpkg 'Häuser 1' >rich.check
    grep -q 'domain name=kinds' rich.check && grep -q '3D Measured Polygon' rich.check ||
        { cat rich.check; fail "the test's own layer is not as it should be"; }
}

# squares.gpkg: layer "squares" with overlapping squares, layer "lines".
make_squares() {
    cat >squares.csv <<'CSV'
wkt,name
"POLYGON ((0 0,10 0,10 10,0 10,0 0))",one
"POLYGON ((9 0,19 0,19 10,9 10,9 0))",two
"POLYGON ((100 0,110 0,110 10,100 10,100 0))",three
CSV
    cat >lines.csv <<'CSV'
wkt,name
"LINESTRING (0 0,10 10)",road
CSV
    ogr2ogr -f GPKG squares.gpkg squares.csv -nln squares -nlt POLYGON -a_srs EPSG:25832 -oo GEOM_POSSIBLE_NAMES=wkt -oo KEEP_GEOM_COLUMNS=NO
    ogr2ogr -update -f GPKG squares.gpkg lines.csv -nln lines -nlt LINESTRING -a_srs EPSG:25832 -oo GEOM_POSSIBLE_NAMES=wkt -oo KEEP_GEOM_COLUMNS=NO
}
