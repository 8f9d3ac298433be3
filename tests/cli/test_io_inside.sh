# shellcheck shell=bash disable=SC1091
# The output goes into the dataset of the input, under any name; impossible outputs; messages about points and about
# lack of memory.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
layer in.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,"POLYGON((3 0,7 0,7 4,3 4,3 0))"
X

# ---- the output is in the archive that is the input
if command -v python3 >/dev/null; then
    python3 -c 'import zipfile; z = zipfile.ZipFile("z.zip", "w"); z.write("in.gpkg")'
    gzip -k in.gpkg
    export CPL_VSIL_GZIP_WRITE_PROPERTIES=NO
    for format in GPKG 'ESRI Shapefile' GeoJSON FlatGeobuf; do
        refused 1 'are the same' separate /vsizip/z.zip/in.gpkg z.zip --of "$format" --overwrite
    done
    refused 1 'are the same' separate /vsizip/z.zip/in.gpkg "$PWD/./z.zip" --of GPKG --overwrite
    refused 1 'are the same' separate "/vsizip/{$PWD/z.zip}/in.gpkg" z.zip --of GPKG --overwrite
    refused 1 'are the same' separate /vsizip/z.zip/in.gpkg /vsizip/z.zip/out.gpkg
    refused 1 'are the same' separate GPKG:in.gpkg:houses in.gpkg --overwrite
    refused 1 'are the same' separate "GPKG:$PWD/in.gpkg:houses" in.gpkg --overwrite
    refused 1 'are the same' separate /vsigzip/in.gpkg.gz in.gpkg.gz --of GeoJSON --overwrite
    refused 1 'is an input' sum square:1 /vsizip/z.zip/in.gpkg z.zip --of GPKG --overwrite
    refused 1 'is an input' buffer in.gpkg z.zip --shape /vsizip/z.zip/in.gpkg --of GPKG --overwrite
    refused 2 'that is an input' separate /vsizip/z.zip/in.gpkg o.gpkg --stats z.zip
else
    echo "not tried: archives (no Python)"
fi
echo 'POLYGON((0 0,1 0,0 1))' >p.wkt
refused 1 'is an input' sum @p.wkt square:1 p.wkt --of GeoJSON --overwrite
refused 1 'is an input' pair square:1 @./p.wkt p.wkt --of GeoJSON --overwrite
refused 1 'is an input' buffer in.gpkg p.wkt --shape @p.wkt --of GeoJSON --overwrite

# ---- a dangling link is reported before the computation
ln -s nowhere.gpkg link.gpkg
for how in '' --overwrite --update; do
    # shellcheck disable=SC2086 # none is no argument
    refused 1 'link.gpkg is a broken link' separate in.gpkg link.gpkg $how
done
ln -s nowhere o_conflicts.fgb
refused 1 'o_conflicts.fgb is a broken link' separate in.gpkg o.fgb --overwrite
ln -s nowhere s.json
refused 1 's.json is a broken link' separate in.gpkg o.gpkg --stats s.json

# ---- GeoJSON keeps doubles: with 17 digits if they suffice, otherwise with more
doubles() { ogr2ogr -f GPKG back.gpkg "$1" -nln back && sqlite3 back.gpkg 'SELECT quote(geom) FROM back' | cut -c 83-; rm -f back.gpkg; }
layer plain.gpkg houses POLYGON <<'X'
id,r,WKT
1,0.5,"POLYGON((999999.1 0.1,1000003 0.1,1000003 4.7,999999.1 0.1))"
X
layer nines.gpkg houses POLYGON <<'X'
id,r,WKT
1,0.4999999995,"POLYGON((999999.4999999995 0.1,1000003 1e-7,1000003 4.000000000000001,999999.4999999995 0.1))"
2,1e-300,"POLYGON((100 3.0000001e-300,104 1e-300,104 4,100 3.0000001e-300))"
X
expect 0 separate plain.gpkg plain.geojson --layers main --stats plain.json
says plain.json '"verified": true'
grep -q '999999.1,' plain.geojson || fail "GeoJSON has more digits than it needs"
expect 0 separate nines.gpkg nines.geojson --layers main --stats nines.json
says nines.json '"verified": true'
if grep -q 'values\? cannot be held' nines.json; then fail "a real changed in GeoJSON"; fi
if command -v sqlite3 >/dev/null; then
    same "$(doubles nines.geojson)" "$(doubles nines.gpkg)" 'the doubles of nines.geojson'
fi
expect 0 separate nines.gpkg /vsistdout/ --of GeoJSON -q
grep -q '999999.499999999' out || fail "standard output lost a digit: $(cat out)"
for digits in COORDINATE_PRECISION=17 SIGNIFICANT_FIGURES=17; do
    expect 0 separate nines.gpkg lossy.geojson --layers main --stats lossy.json --lco "$digits" --overwrite
    says lossy.json '"verified": false'
    says lossy.json 'the format rounds coordinates: they are off by up to'
done

# ---- for points the message mentions --symbol
layer points.gpkg trees POINT <<'X'
id,WKT
1,"POINT(1 1)"
2,"POINT(2 1)"
X
refused 1 'for points give their --symbol' separate points.gpkg o.gpkg
refused 1 'for points give their --symbol' check points.gpkg
layer lines.gpkg roads LINESTRING <<'X'
id,WKT
1,"LINESTRING(1 1,2 2)"
X
run separate lines.gpkg o.gpkg
if grep -q symbol err; then fail "the message about lines mentions --symbol"; fi
# points without a symbol are not an error in a layer of any type
layer any.gpkg things GEOMETRY <<'X'
id,WKT
1,"POINT(1 1)"
2,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
X
expect 0 check any.gpkg
grep -q '1 features are not polygons.*for points give their --symbol' err || fail "a point passed by without a word: $(cat err)"

# ---- lack of memory is not reported as wrong usage: a large literal, with less and less memory
# (a sanitizer wants more addresses than there is memory)
if (ulimit -v 4000000) 2>/dev/null && ! grep -q '^SUNDER_SANITIZE:STRING=.' "$SUNDER_BUILD/CMakeCache.txt"; then
    literal=$(awk 'BEGIN { printf "POLYGON((0 0"; for (i = 1; i < 3000; i++) printf ",%d %d", i, i % 2 ? i * 7 % 100 : 200 + i % 50;
        print ",3000 -1000))" }')
    starved=0
    starve() { # limit: sets the status of a run with that many KB of address space
        status=0
        (ulimit -c 0; ulimit -v "$1"; exec "$SUNDER" pair "$literal" "$literal" >/dev/null 2>err) || status=$?
    }
    # The libraries alone take part of it: the least limit that is enough is found by bisection, then limits slightly
    # below it are tested.
    few=60000 enough=4000000
    while [ $((enough - few)) -gt 500 ]; do
        starve $(((few + enough) / 2))
        if [ "$status" -eq 0 ]; then enough=$(((few + enough) / 2)); else few=$(((few + enough) / 2)); fi
    done
    for less in 500 1000 2000 3000 5000 8000 12000 20000; do
        starve $((enough - less))
        [ "$status" -ne 2 ] || fail "with $((enough - less)) KB: status 2, $(cat err)"
        [ "$status" -ne 1 ] || starved=$((starved + 1))
    done
    [ "$starved" -gt 1 ] || fail "memory did not run out: the test proves nothing"
fi
finish
