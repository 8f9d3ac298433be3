# shellcheck shell=bash disable=SC1091
# Conditions on features, in the SQL of the format. Conditions on areas and lengths mean the same in all formats, and a
# condition that cannot be parsed is explained.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

# Three overlapping houses of 16, 24 and 100 square metres.
layer in.gpkg in POLYGON <<'X'
id,WKT
a,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
b,"POLYGON((3 0,9 0,9 4,3 4,3 0))"
c,"POLYGON((8 0,18 0,18 10,8 10,8 0))"
X
for format in shp fgb sqlite; do ogr2ogr in.$format in.gpkg; done
ogr2ogr in.json in.gpkg -lco RFC7946=NO

states() { ogrinfo -ro -q out.gpkg -sql 'SELECT sunder_st FROM "out" ORDER BY id' | sed -n 's/^  sunder_st (.*) = //p' | tr '\n' ' '; }
declare -A size=([gpkg]='ST_Area(geom)' [shp]=OGR_GEOM_AREA [fgb]=OGR_GEOM_AREA [json]=OGR_GEOM_AREA)
for format in "${!size[@]}"; do
    same "$("$SUNDER" check in.$format --input-crs EPSG:25832 --where "${size[$format]} < 50" | sed -n 's/.*: \([0-9]*\) features.*/\1/p')" 2 "--where by size, $format:"
    expect 0 separate in.$format out.gpkg --overwrite --input-crs EPSG:25832 --output-layer out --fixed-where "${size[$format]} < 20"
    same "$(states)" 'fixed moved moved ' "--fixed-where by size, $format:"
done
# Conditions on the result of --sql are in OGR SQL for every format, and areas are available in it.
expect 0 separate in.gpkg out.gpkg --overwrite --sql 'SELECT * FROM "in"' --output-layer out --fixed-where 'OGR_GEOM_AREA < 20'
same "$(states)" 'fixed moved moved ' '--fixed-where by size, --sql:'

for option in --where --fixed-where --ignore-where; do
    refused 2 "$option \"OGR_GEOM_AREA < 20\": " separate in.gpkg new.gpkg $option 'OGR_GEOM_AREA < 20'
    says err 'a condition on GPKG is in its own SQL, in which the area is ST_Area("geom"); its fields are id'
    refused 2 'in which the area is ST_Area("geom")' separate in.sqlite new.gpkg $option 'ogr_geom_area < 20'
    refused 2 'its geometry is "geom"' separate in.gpkg new.gpkg $option 'ST_Area(geometry) < 20'
    refused 2 'a condition on this format is in OGR SQL, in which the area is OGR_GEOM_AREA; its fields are id' \
        separate in.shp new.gpkg $option 'ST_Area(geom) < 20'
    refused 2 'its fields are id' separate in.gpkg new.gpkg $option "kind = 'a'"
    if grep -q area err; then fail "the message is about areas, although the condition is not"; fi
done
refused 2 'where= "kind = 1"' check in.gpkg --barrier "in.shp,where=kind = 1"
says err 'its fields are id'
# If there are very many fields, only the first ones are listed.
sed 's/$/,/' >many.csv <<X
WKT,$(seq -f 'field_number_%g' -s , 1 99)
"POLYGON((0 0,4 0,4 4,0 4,0 0))",$(seq -s , 1 99)
X
refused 1 'its fields are WKT, field_number_1, field_number_2, ' check many.csv --oo GEOM_POSSIBLE_NAMES=WKT --id-field key
grep -q ', \.\.\.$' err || fail 'a list of fields without end'
finish
