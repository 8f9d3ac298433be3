# shellcheck shell=bash
# PostGIS: layers appear in one transaction, and a refused run leaves the database as it was. Starts a server of its own,
# without a network port, in a scratch directory.
set -eu
. "$(dirname "${BASH_SOURCE[0]}")/io_layers.sh"
bin=$(ls -d /usr/lib/postgresql/*/bin 2>/dev/null | tail -1)
skip() { echo "skipped: $1"; exit 77; }
[ -n "$bin" ] && [ -x "$bin/initdb" ] || skip "PostgreSQL's server is not installed"
ls "$bin"/../lib/postgis-3.so "$bin"/../../lib/postgis-3.so >/dev/null 2>&1 ||
    [ -n "$(find "$bin/.." -name 'postgis-3.so' 2>/dev/null)" ] || skip "PostGIS is not installed"
ogrinfo --formats | grep -q PostgreSQL || skip "GDAL has no PostgreSQL driver"

# The server refuses to run as root.
as=()
if [ "$(id -u)" = 0 ]; then
    id postgres >/dev/null 2>&1 && command -v runuser >/dev/null || skip "no user that may run a server"
    as=(runuser -u postgres --)
    chmod 755 "$work"
fi
mkdir -m 777 server
"${as[@]}" "$bin/initdb" -D "$work/server/data" -A trust -U postgres --no-sync -E UTF8 --locale=C.UTF-8 >/dev/null
stop() { "${as[@]}" "$bin/pg_ctl" -D "$work/server/data" -m immediate stop >/dev/null 2>&1 || true; }
trap 'stop; rm -rf "$work"' EXIT
"${as[@]}" "$bin/pg_ctl" -D "$work/server/data" -w -l "$work/server/log" \
    -o "-c listen_addresses='' -k $work/server -c fsync=off" start >/dev/null
export PGHOST=$work/server PGUSER=postgres
"$bin/createdb" probe
sql() { "$bin/psql" -qAt -d probe -c "$1"; }
sql 'CREATE EXTENSION postgis'
db="PG:dbname=probe host=$work/server user=postgres"

make_rich
make_squares
"$SUNDER" separate --quiet --output-layer houses rich.gpkg "$db" 2>message || { cat message; fail "no output"; }
[ "$(sql 'SELECT count(*) FROM houses')" = 4 ] || fail "features are missing"
[ "$(sql 'SELECT string_agg(nr::text, chr(32) ORDER BY nr) FROM houses')" = '7 12 13 1000000007' ] || fail "FIDs changed"
[ "$(sql "SELECT key FROM houses WHERE nr = 7")" = 1152921504606846977 ] || fail "a 64-bit integer changed"
refused 1 'has a layer houses already' "$SUNDER" separate --output-layer houses rich.gpkg "$db"
refused 2 'overwrite-layer' "$SUNDER" separate --overwrite --output-layer houses rich.gpkg "$db"

# Domains are lost in PostgreSQL: with --strict nothing of this run may stay, and the old layer stands.
sql 'UPDATE houses SET sunder_st = $$mine$$'
refused 1 'no domain' "$SUNDER" separate --strict --output-layer strict rich.gpkg "$db"
[ "$(sql "SELECT count(*) FROM pg_tables WHERE tablename LIKE 'strict%'")" = 0 ] || fail "a refused run left tables"
refused 1 'no domain' "$SUNDER" separate --strict --update --overwrite-layer --output-layer houses rich.gpkg "$db"
[ "$(sql "SELECT count(*) FROM houses WHERE sunder_st = 'mine'")" = 4 ] || fail "a refused run replaced a layer"
"$SUNDER" separate --quiet --update --overwrite-layer --output-layer houses rich.gpkg "$db" 2>/dev/null
[ "$(sql "SELECT count(*) FROM houses WHERE sunder_st = 'mine'")" = 0 ] || fail "--overwrite-layer did not replace"

# The doubles are the same there and back.
"$SUNDER" separate --quiet --input-layer squares --stats stats.json squares.gpkg "$db"
grep -q '"verified": true' stats.json || fail "PostGIS keeps doubles, and is not verified"
sql 'SELECT ST_AsText(geom, 17) FROM squares ORDER BY 1' | grep -q 'POLYGON((100 0,110 0,110 10,100 10,100 0))' ||
    fail "a geometry changed"
