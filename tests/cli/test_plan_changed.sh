# shellcheck shell=bash disable=SC1091
# Data that determine the moves change between a plan and its merge: each field that an option reads, each result of a
# condition (also through another table), geometries, the set of features. Then merge refuses, and so does a repeated
# call of plan. Changes of other data are allowed. A warning is printed about barriers that changed or are missing.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v sqlite3 >/dev/null || { echo "skipped: no shell of SQLite"; exit 77; }
export SOURCE_DATE_EPOCH=1700000000

layer in.gpkg houses POLYGON <<'X'
id,name,stays,out,block,weight,far,WKT
1,a,1,0,x,1.5,9,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,b,0,0,y,2,9,"POLYGON((3 0,7 0,7 4,3 4,3 0))"
3,c,0,0,z,1,9,"POLYGON((20 0,24 0,24 4,20 4,20 0))"
4,d,0,1,u,3,9,"POLYGON((23 0,27 0,27 4,23 4,23 0))"
X
layer in.gpkg roads LINESTRING <<'X'
broad,WKT
1,"LINESTRING(-5 6,40 6)"
X
sqlite3 in.gpkg "CREATE TABLE listed (id INTEGER); INSERT INTO listed VALUES (9);"
cp in.gpkg pristine.gpkg
options=(--input-layer houses --gap 1 --id-field id --block-field block --weight-field weight --max-shift-field far
    --fixed-where 'stays = 1' --ignore-where 'out = 1 OR id IN (SELECT id FROM listed)'
    --barrier in.gpkg,layer=roads,width-field=broad)
expect 0 plan in.gpkg the.plan "${options[@]}" --shards 2 -q
for k in 1 2; do expect 0 separate --shard $k the.plan -q; done
expect 0 merge the.plan whole.gpkg -q
[ ! -s err ] || fail "warned though nothing changed"

# changed SQL: applies it to a copy of the input; removes the triggers of the GeoPackage first, which need functions
# that sqlite3 does not have.
changed() {
    cp pristine.gpkg in.gpkg
    sqlite3 in.gpkg "SELECT 'DROP TRIGGER \"' || name || '\";' FROM sqlite_master WHERE type = 'trigger'" |
        sqlite3 in.gpkg && sqlite3 in.gpkg "$1" || fail "cannot change: $1"
}
refusals=0
for change in "UPDATE houses SET stays = 0 WHERE id = 1" "UPDATE houses SET stays = 1 WHERE id = 3" \
    "UPDATE houses SET out = 0 WHERE id = 4" "INSERT INTO listed VALUES (2)" "UPDATE houses SET block = 'z' WHERE id = 2" \
    "UPDATE houses SET block = NULL WHERE id = 2" "UPDATE houses SET weight = 1.0000000000000002 WHERE id = 3" \
    "UPDATE houses SET weight = NULL WHERE id = 2" "UPDATE houses SET far = 8 WHERE id = 2" \
    "UPDATE houses SET id = 7 WHERE id = 3" "DELETE FROM houses WHERE id = 3" \
    "UPDATE houses SET geom = (SELECT geom FROM houses WHERE id = 3) WHERE id = 2"; do
    changed "$change"
    expect 1 merge the.plan o.gpkg
    case $change in
    DELETE*) says err 'it has 3 features, and had 4 when it was read before' ;;
    *) says err 'since the layer was read' ;;
    esac
    [ ! -e o.gpkg ] || { fail "written after: $change"; rm o.gpkg; }
    refused 1 'has changed since it was made' plan in.gpkg the.plan "${options[@]}" --shards 2
    refusals=$((refusals + 1))
done
[ "$refusals" -eq 12 ] || fail "$refusals changes were tried"

# Allowed changes: a name, and a value for which the condition gives the same result.
changed "UPDATE houses SET name = 'other' WHERE id = 1; UPDATE houses SET stays = 5 WHERE id = 3; INSERT INTO listed VALUES (8)"
expect 0 merge the.plan o.gpkg -q
same "$(geometry o.gpkg houses 2)" "$(geometry whole.gpkg houses 2)" "moves after a name changed:"
same "$(value o.gpkg houses 1 name)" other "the name that changed:"
rm o.gpkg

# ---- barriers
for change in "UPDATE roads SET broad = 2" "UPDATE roads SET geom = (SELECT geom FROM roads2)" "DELETE FROM roads" "DROP TABLE roads"; do
    [ -e moved.gpkg ] || layer moved.gpkg roads2 LINESTRING <<<$'broad,WKT\n1,"LINESTRING(-5 6.5,40 6)"'
    changed "ATTACH 'moved.gpkg' AS other; ${change/roads2/other.roads2}"
    expect 0 merge the.plan o.gpkg
    case $change in
    DROP*) says err 'it is not known whether barriers have changed since the plan was made' ;;
    *) says err 'barriers have changed since the plan was made' ;;
    esac
    same "$(geometry o.gpkg houses 2)" "$(geometry whole.gpkg houses 2)" "moves after $change:"
    rm -f o.gpkg
done
finish
