# shellcheck shell=bash disable=SC1091
# What was hidden, or became smaller or larger, is not so once more: separate on its own result, with the same blocks,
# hides nothing more and alters no shape again.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }

# A terrace beside two roads, a house on a road and one between the two, two houses that overlap, and sheds.
{
    echo "WKT,class"
    printf '%s\n' '"POLYGON((0 0,8 0,8 10,0 10))",2' '"POLYGON((8 0,17 0,17 9,8 9))",2' '"POLYGON((17 0,25 0,25 10,17 10))",1' \
        '"POLYGON((25 0,32 1,32 11,25 10))",3' '"POLYGON((102 0,112 0,112 10,102 10))",1' '"POLYGON((88 0,98 0,98 10,88 10))",1' \
        '"POLYGON((97 30,104 30,104 40,97 40))",1' '"POLYGON((202 0,212 0,212 10,202 10))",1' '"POLYGON((206 3,216 3,216 13,206 13))",2' \
        '"POLYGON((120 60,122 60,122 62,120 62))",3' '"POLYGON((123 60,125 60,125 64,123 64))",2' '"POLYGON((120 64,122 64,122 67,120 67))",1'
} | layer town.gpkg buildings POLYGON
printf 'WKT,w\n"LINESTRING(-20 -2,50 -2)",5\n"LINESTRING(100 -50,100 180)",6\n"LINESTRING(200 -50,200 80)",6\n"LINESTRING(-20 12.5,50 12.5)",0.5\n"LINESTRING(216.5 -50,216.5 50)",0.5\n' |
    layer roads.gpkg roads LINESTRING

# again OPTIONS...: the second run leaves what the first one made
again() {
    expect 0 separate town.gpkg one.gpkg --overwrite "${rules[@]}" "$@" --stats one.json
    [ "$(jq '.hidden.count + .shrunk.trimmed + .shrunk.inset + .shrunk.scaled + .shrunk.symbols + .enlarged' one.json)" -gt 0 ] || fail "$*: nothing changes"
    rm -f visible.gpkg
    ogr2ogr visible.gpkg one.gpkg buildings -where 'sunder_inv = 0' || fail "ogr2ogr"
    expect 0 separate visible.gpkg two.gpkg --overwrite "${rules[@]}" --no-blocks --block-field sunder_blk "$@" --stats two.json
    same "$(jq -c '[.hidden.count, .shrunk.trimmed, .shrunk.inset, .shrunk.scaled, .shrunk.symbols, .enlarged]' two.json)" '[0,0,0,0,0,0]' "$* again:"
    echo "$*: $(jq -c '[.hidden.count, .shrunk.trimmed, .shrunk.inset, .shrunk.scaled, .shrunk.symbols, .enlarged]' one.json two.json | tr '\n' ' ')"
}
rules=(--gap 0.5 --max-shift 0.5 --rows no --crossed hide --barrier roads.gpkg,width-field=w --hide --hide-weight 1)
again
again --trim --trim-keep 0.3
again --inset 0.5,1,2
again --symbol-size 3
again --trim --inset 0.5,1 --symbol-size 3 --hierarchy-field class
again --enlarge --min-size 5
again --enlarge --min-size 5 --trim --inset 0.5,1 --symbol-size 5
finish
