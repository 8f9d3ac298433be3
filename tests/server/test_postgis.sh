# shellcheck shell=bash
# PostGIS: layers appear in one transaction, and a refused run leaves the database as it was. Reading from it gives the
# same as reading a file. A server that stops ends the run, and the former layers are still there. The test starts a
# server of its own, without a network port, in a scratch directory.
set -eu
. "$(dirname "${BASH_SOURCE[0]}")/../cli/io_layers.sh"
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
start() {
    "${as[@]}" "$bin/pg_ctl" -D "$work/server/data" -w -l "$work/server/log" \
        -o "-c listen_addresses='' -k $work/server -c fsync=off" start >/dev/null
}
start
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

# PostgreSQL cannot store domains: with --strict the run is refused, leaves no tables, and the old layer stays.
sql 'UPDATE houses SET sunder_st = $$mine$$'
refused 1 'no domain' "$SUNDER" separate --strict --output-layer strict rich.gpkg "$db"
[ "$(sql "SELECT count(*) FROM pg_tables WHERE tablename LIKE 'strict%'")" = 0 ] || fail "a refused run left tables"
refused 1 'no domain' "$SUNDER" separate --strict --update --overwrite-layer --output-layer houses rich.gpkg "$db"
[ "$(sql "SELECT count(*) FROM houses WHERE sunder_st = 'mine'")" = 4 ] || fail "a refused run replaced a layer"
"$SUNDER" separate --quiet --update --overwrite-layer --output-layer houses rich.gpkg "$db" 2>/dev/null
[ "$(sql "SELECT count(*) FROM houses WHERE sunder_st = 'mine'")" = 0 ] || fail "--overwrite-layer did not replace"

# Doubles are the same after writing and reading.
"$SUNDER" separate --quiet --input-layer squares --stats stats.json squares.gpkg "$db"
grep -q '"verified": true' stats.json || fail "the output in PostGIS is not verified, although it keeps doubles"
sql 'SELECT ST_AsText(geom, 17) FROM squares ORDER BY 1' | grep -q 'POLYGON((100 0,110 0,110 10,100 10,100 0))' ||
    fail "a geometry changed"

# The other direction: a table as input gives the same as the file, feature by feature and double by double.
bytes_of() { ogrinfo -ro -q "$1" -dialect SQLite -sql "SELECT hex(ST_AsBinary(geom)) AS g, sunder_st, sunder_dx FROM $2 ORDER BY 1" | grep ' = '; }
"$SUNDER" separate --quiet --gap 3 -l squares squares.gpkg of_file.gpkg --output-layer moved
ogr2ogr -f PostgreSQL "$db" squares.gpkg squares -nln plain -lco GEOMETRY_NAME=geom -preserve_fid
"$SUNDER" separate --quiet --gap 3 -l plain "$db" of_table.gpkg --output-layer moved
bytes_of of_file.gpkg moved >of_file
bytes_of of_table.gpkg moved >of_table
[ -s of_file ] && cmp -s of_file of_table || fail "the result for a table differs from that for a file"
"$SUNDER" separate --quiet --gap 3 -l plain --where 'ST_Area(geom) < 1e9' "$db" "$db" --update --output-layer moved
same_sets=$(sql "SELECT count(*) FROM moved WHERE sunder_st = 'moved'")
[ "$same_sets" = "$(grep -c 'sunder_st (String) = moved' of_file)" ] || fail "table to table: $same_sets moved"
refused 2 'is in its own SQL, in which the area is ST_Area("geom"); its fields are ' \
    "$SUNDER" check -l plain --where 'OGR_GEOM_AREA < 9' "$db"
"$SUNDER" check --quiet --allow-conflicts --gap 3 -l squares squares.gpkg --barrier "$db,layer=moved" >/dev/null

# The connection is lost during writing: when a table of that name is created, its session is terminated.
tables() { sql "SELECT string_agg(tablename, ' ' ORDER BY tablename) FROM pg_tables WHERE schemaname = 'public'"; }
sql "CREATE FUNCTION ended() RETURNS event_trigger LANGUAGE plpgsql AS \$\$ BEGIN
    IF EXISTS (SELECT FROM pg_event_trigger_ddl_commands() WHERE object_identity LIKE '%ended%conflicts') THEN
        PERFORM pg_terminate_backend(pg_backend_pid()); END IF; END \$\$"
sql "CREATE EVENT TRIGGER ended ON ddl_command_end WHEN TAG IN ('CREATE TABLE') EXECUTE FUNCTION ended()"
before=$(tables)
refused 1 'ended' "$SUNDER" separate --quiet --gap 3 -l squares squares.gpkg "$db" --update --output-layer ended
[ "$(tables)" = "$before" ] || fail "a connection that was ended left $(tables)"
sql 'DROP EVENT TRIGGER ended'
"$SUNDER" separate --quiet --gap 3 -l squares squares.gpkg "$db" --update --output-layer ended

# The server stops after the input has been read, while the program waits for the shape, and starts again. On systems
# that do not show what a process waits for, the server stops at some moment; the expected result is the same.
before=$(tables)
mkfifo shape
"$SUNDER" buffer --quiet -l plain "$db" "$db" --update --output-layer grown --shape @- <shape >gone.out 2>gone.err &
run=$!
trap '' PIPE
exec 9>shape
for _ in $(seq 1 100); do # waits for a read() of standard input (0 on x86-64, 63 on others)
    case $(cut -d' ' -f1,2 "/proc/$run/syscall" 2>/dev/null) in '0 0x0' | '63 0x0' | '') break ;; esac
    sleep 0.1
done
stop
echo 'POLYGON ((0 0, 1 0, 1 1, 0 0))' >&9 || true
exec 9>&-
status=0
wait "$run" || status=$?
[ "$status" = 1 ] || { cat gone.err; fail "status $status after the server stopped"; }
[ "$(grep -c '^sunder: error: ' gone.err)" = 1 ] && [ "$(wc -l <gone.err)" = 1 ] || { cat gone.err; fail "not exactly one error line"; }
start
[ "$(tables)" = "$before" ] || fail "after the stop of the server there are other tables: $(tables)"
