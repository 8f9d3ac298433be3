# shellcheck shell=bash disable=SC1091
# --trim: a detached house is cut along its own wall if that costs at most a tenth more area; a house in a block is not.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }

# Roads of 6 m that are hardly slanted, and more so, each beside one house; and a hardly slanted one beside two with a
# common wall. Houses lose about 1.5 m of 10 m.
{
    echo "WKT,name"
    echo '"POLYGON((2 0,12 0,12 10,2 10,2 0))",straight'
    echo '"POLYGON((102 0,112 0,112 10,102 10,102 0))",slanted'
    echo '"POLYGON((202 0,212 0,212 5,202 5,202 0))",lower'
    echo '"POLYGON((202 5,212 5,212 10,202 10,202 5))",upper'
} | layer h.gpkg houses POLYGON
{
    echo "WKT,k"
    echo '"LINESTRING(-0.2 -50,0.3 60)",1'
    echo '"LINESTRING(94.5 -50,105.5 60)",2'
    echo '"LINESTRING(199.8 -50,200.3 60)",3'
} | layer road.gpkg road LINESTRING
words=(--gap 0.5 --max-shift 0 --rows no --barrier road.gpkg,width=6 --trim)

# left FILE NAME: how many different x the two corners on the left of a house have
left() {
    ogr2ogr -f CSV /vsistdout/ "$1" houses -where "name = '$2'" -select name -lco GEOMETRY=AS_WKT | tail -n 1 |
        grep -oE '[0-9.]+ [0-9.]+' | sort -u | sort -g | head -n 2 | cut -d' ' -f1 | sort -u | wc -l
}

expect 0 separate h.gpkg o.gpkg "${words[@]}" --stats o.json
same "$(jq -c .shrunk.trimmed o.json)" 4 "houses cut back:"
same "$(left o.gpkg straight) $(left o.gpkg slanted) $(left o.gpkg lower) $(left o.gpkg upper)" "1 2 2 2" "slanted fronts:"
expect 0 check o.gpkg -l houses "${words[@]}" --no-blocks --block-field sunder_blk --before h.gpkg
finish
