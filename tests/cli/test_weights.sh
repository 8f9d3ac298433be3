# shellcheck shell=bash disable=SC1091
# --weight and --weight-field: an invalid weight is an error that names the feature; null is 1. With GeoPackage,
# Shapefile and texts.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

# Two squares that overlap by 1 along x. The lengths of their moves show the weights: the first moves w2 / (w1 + w2).
two() { # FILE TYPE WEIGHT1 WEIGHT2
    cat >two.csv <<X
w,WKT
$3,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
$4,"POLYGON((3 0,7 0,7 4,3 4,3 0))"
X
    printf '%s,WKT\n' "$2" >two.csvt
    rm -f "$1" two.shp two.dbf
    ogr2ogr "$1" two.csv -nln two -nlt POLYGON -a_srs EPSG:25832 -oo GEOM_POSSIBLE_NAMES=WKT -oo KEEP_GEOM_COLUMNS=NO \
        -oo EMPTY_STRING_AS_NULL=YES 2>/dev/null || fail "cannot make $1"
    rm two.csv two.csvt
}
first() { case $1 in *.gpkg) echo 1 ;; *) echo 0 ;; esac; } # FID of the first feature
taken() { # FILE WANTED ARGS: the length of the move of the first square
    local file=$1 wanted=$2
    shift 2
    rm -f o.gpkg
    expect 0 separate "$file" o.gpkg -q "$@"
    value o.gpkg two "$(first "$file")" sunder_len |
        awk -v want="$wanted" '{ seen = 1; d = $1 - want; if (d > 1e-6 || d < -1e-6) exit 1 } END { exit !seen }' ||
        fail "moved by '$(value o.gpkg two "$(first "$file")" sunder_len)', not $wanted: $file $*"
    rm -f o.gpkg
}

for file in two.gpkg two.shp; do
    n=$(first $file)
    for type in Real Integer String; do
        two $file $type 1 3
        taken $file 0.75 --weight-field w
        taken $file 0.75 --weight-field W # names of fields are not case-sensitive
        taken $file 0.75 --weight-field w --weight area
        taken $file 0.5
        two $file $type 3 "" # a null weight is 1
        taken $file 0.25 --weight-field w
        two $file $type "" ""
        taken $file 0.5 --weight-field w
        for bad in 0 -2; do
            two $file $type 1 $bad
            refused 1 "layer two, FID $((n + 1)): the weight in w is $bad" separate $file never.gpkg --weight-field w
            two $file $type $bad 1
            refused 1 "FID $n: the weight" separate $file never.gpkg --weight-field w
        done
    done
    for bad in heavy 2kg 1e999 nan inf 1,5 0x10 -0; do
        two $file String 1 "\"$bad\""
        refused 1 "FID $((n + 1)): the weight in w is $bad" separate $file never.gpkg --weight-field w
    done
    two $file String 1 '" 3 "'
    taken $file 0.75 --weight-field w
    two $file String 1 '"  "' # a format without nulls writes blanks
    taken $file 0.5 --weight-field w
    two $file Date 2020-01-01 2020-01-02
    refused 1 'is of type Date; numbers are needed' separate $file never.gpkg --weight-field w
    refused 1 'no field weight' separate $file never.gpkg --weight-field weight
    # A feature that cannot be in conflict needs no weight.
    two $file Real 1 0
    expect 0 separate $file o.gpkg -q --weight-field w --ignore-where 'w = 0'
    rm o.gpkg
done

# Infinity and NaN as doubles.
two two.gpkg Real 1 5
for bad in 9e999 -9e999; do
    ogrinfo -q two.gpkg -sql "UPDATE two SET w = $bad WHERE fid = 2" >/dev/null
    refused 1 'FID 2: the weight in w is' separate two.gpkg never.gpkg --weight-field w
done
cat >two.geojson <<'X'
{"type": "FeatureCollection", "name": "two", "features": [
{"type": "Feature", "properties": {"w": 1.5}, "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 4], [0, 0]]]}},
{"type": "Feature", "properties": {"w": NaN}, "geometry": {"type": "Polygon", "coordinates": [[[9, 0], [13, 0], [13, 4], [9, 0]]]}}]}
X
refused 1 'FID 1: the weight in w is nan' separate two.geojson never.gpkg --weight-field w --input-crs EPSG:25832
# A GeoPackage has no NaN: SQLite stores null, which means 1.
ogrinfo -q two.gpkg -sql "UPDATE two SET w = 9e999 - 9e999 WHERE fid = 2" >/dev/null
taken two.gpkg 0.5 --weight-field w
finish
