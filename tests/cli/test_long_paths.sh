# shellcheck shell=bash disable=SC1091
# Paths of 200 to 5,000 bytes for every option and operand that takes one (long_paths.py): each call uses exactly that
# file, or is refused with an error message. GDAL's functions for paths return "" beyond 2,047 bytes; then a file in the
# current directory would be read or replaced. Also texts beyond the 8,000 bytes at which CPLSPrintf() cuts them.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }
[ -x "$SUNDER_BUILD/tests/calls" ] || { echo "skipped: tests/calls is not built"; exit 77; }

mkdir paths
layer paths/in.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,"POLYGON((3 0,7 0,7 4,3 4,3 0))"
X
ogr2ogr paths/in.fgb paths/in.gpkg || fail "no FlatGeobuf"
echo 'POLYGON ((0 0, 1 0, 0 1, 0 0))' >paths/wkt
python3 "$SUNDER_SOURCE/tests/cli/long_paths.py" "$SUNDER_BUILD/tests/calls" "$PWD/paths" >wrong 2>figures || fail "$(cat figures)"
cat figures
[ ! -s wrong ] || fail "$(head -20 wrong)"
grep -q '^238 calls' figures || fail "not 238 calls: $(cat figures)"

# A condition of 12,000 bytes, by itself, together with --where, and in a plan.
condition="id = 1 OR id IN ($(seq -s, 1000000 1001500))"
[ ${#condition} -gt 12000 ] || fail "the condition is too short"
cp paths/in.gpkg .
expect 0 separate in.gpkg short.gpkg --gap 1 --where "id < 9" --fixed-where "id = 1" --no-blocks
expect 0 separate in.gpkg long.gpkg --gap 1 --where "id < 9" --fixed-where "$condition" --no-blocks
same "$(geometry long.gpkg houses 2)" "$(geometry short.gpkg houses 2)" "a long condition:"
expect 0 plan in.gpkg long.plan --gap 1 --where "id < 9" --fixed-where "$condition" --no-blocks --shards 1
expect 0 separate --shard 1 long.plan
expect 0 merge long.plan merged.gpkg
same "$(geometry merged.gpkg houses 2)" "$(geometry short.gpkg houses 2)" "a long condition in a plan:"
finish
