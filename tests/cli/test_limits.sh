# shellcheck shell=bash disable=SC1091
# --max-shift-field: 0 means fixed, null means --max-shift, and an invalid limit is an error that names the feature.
# With GeoPackage and Shapefile, numbers and texts.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

# Two squares that overlap by 2 along x, and a third one far away.
two() { # FILE TYPE LIMIT1 LIMIT2
    cat >two.csv <<X
far,WKT
$3,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
$4,"POLYGON((2 0,6 0,6 4,2 4,2 0))"
,"POLYGON((90 0,94 0,94 4,90 4,90 0))"
X
    printf '%s,WKT\n' "$2" >two.csvt
    rm -f "$1" two.shp two.dbf
    ogr2ogr "$1" two.csv -nln two -nlt POLYGON -a_srs EPSG:25832 -oo GEOM_POSSIBLE_NAMES=WKT -oo KEEP_GEOM_COLUMNS=NO \
        -oo EMPTY_STRING_AS_NULL=YES 2>/dev/null || fail "cannot make $1"
    rm two.csv two.csvt
}
lengths() { # the lengths of the moves, and the states of the features
    for fid in "$n" $((n + 1)) $((n + 2)); do
        printf '%.4g %s ' "$(value o.gpkg two $fid sunder_len)" "$(value o.gpkg two $fid sunder_st)"
    done
}

for file in two.gpkg two.shp; do
    case $file in *.gpkg) n=1 ;; *) n=0 ;; esac
    for type in Real String; do
        two $file $type 0 "" # the first is fixed, the second has no limit
        expect 0 separate $file o.gpkg -q --overwrite --max-shift-field far
        same "$(lengths)" '0 fixed 2 moved 0 unmoved ' "$file, $type:"
        expect 0 separate $file o.gpkg -q --overwrite --max-shift-field FAR --max-shift 2.5
        expect 3 separate $file o.gpkg -q --overwrite --max-shift-field far --max-shift 1
        same "$(value o.gpkg two_conflicts 1 reason)" max_shift
        two $file $type 1 7 # each has its own limit, whatever --max-shift is
        expect 0 separate $file o.gpkg -q --overwrite --max-shift-field far --max-shift 1.5 --weight-field far
        same "$(value o.gpkg two "$n" sunder_len | awk '{ print ($1 <= 1) }')" 1 "$file, $type:"
        two $file $type -1 1
        refused 1 "FID $n: the limit in far is -1" separate $file never.gpkg --max-shift-field far
    done
    refused 1 'no field fat; did you mean far' separate $file never.gpkg --max-shift-field fat
done
for text in wide inf nan 3m 1e999; do
    two two.gpkg String 1 $text
    refused 1 "FID 2: the limit in far is $text" separate two.gpkg never.gpkg --max-shift-field far
done
two two.gpkg Date 2020/01/01 ""
refused 1 'numbers are needed' separate two.gpkg never.gpkg --max-shift-field far
two two.gpkg Real 1 -1 # features that are ignored may have any limit
expect 0 separate two.gpkg o.gpkg -q --overwrite --max-shift-field far --ignore-where 'far = -1'
two two.gpkg Real 1 1
# there are no lengths in degrees
expect 1 separate two.gpkg o.gpkg --overwrite --max-shift-field far --input-crs EPSG:4326
says err "FID 1: the layer's coordinates are degrees"
two two.gpkg Real 0 ""
expect 0 separate two.gpkg o.gpkg -q --overwrite --max-shift-field far --input-crs EPSG:4326
refused 2 'is a rule for moves' check two.gpkg --max-shift-field far
finish
