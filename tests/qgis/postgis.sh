# shellcheck shell=bash
# The plug-in and PostGIS: a table is separated, results become tables. The test starts a server of its own, on a socket
# in the scratch directory, so that it meets no other server; skipped if PostgreSQL with PostGIS is not installed.
set -eu
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
python=/usr/bin/python3
"$python" -c 'import qgis.core' 2>/dev/null || { echo "skipped: QGIS's Python modules (python3-qgis) are not installed"; exit 77; }
bin=$(dirname "$(readlink -f "$(command -v initdb || ls /usr/lib/postgresql/*/bin/initdb 2>/dev/null | tail -1)")")
[ -x "$bin/initdb" ] || { echo "skipped: PostgreSQL is not installed"; exit 77; }
ls "$("$bin/pg_config" --sharedir 2>/dev/null || echo "/usr/share/postgresql/$(basename "$(dirname "$bin")")")"/extension/postgis.control \
    >/dev/null 2>&1 || { echo "skipped: PostGIS is not installed"; exit 77; }

work=$(mktemp -d)
chmod 755 "$work"
as_server() { "$@"; } # the server refuses to run as root
if [ "$(id -u)" -eq 0 ]; then
    id postgres >/dev/null 2>&1 || { echo "skipped: there is no user postgres for the server"; exit 77; }
    as_server() { setpriv --reuid=postgres --regid=postgres --clear-groups "$@"; }
fi
mkdir "$work/server"
[ "$(id -u)" -ne 0 ] || chown postgres "$work/server"
end() {
    as_server "$bin/pg_ctl" -D "$work/server/data" -m immediate stop >/dev/null 2>&1 || true
    rm -rf "$work"
}
trap end EXIT
fail() { echo "$1"; cat "$work/log" 2>/dev/null; exit 1; }

cd "$work/server"
as_server "$bin/initdb" -D "$work/server/data" -A trust -U sunder >"$work/log" 2>&1 || fail "no cluster"
as_server "$bin/pg_ctl" -D "$work/server/data" -w -l "$work/server/server.log" \
    -o "-k $work/server -c listen_addresses='' -c fsync=off" start >"$work/log" 2>&1 || fail "the server does not start"
export PGHOST=$work/server PGUSER=sunder
psql -q -d postgres -c 'CREATE DATABASE maps' >"$work/log" 2>&1 || fail "no database"
psql -q -d maps -c 'CREATE EXTENSION postgis' >"$work/log" 2>&1 || fail "no PostGIS"

mkdir -m 700 "$work/home" "$work/run" "$work/tmp"
export QT_QPA_PLATFORM=offscreen HOME=$work/home XDG_RUNTIME_DIR=$work/run QGIS_CUSTOM_CONFIG_PATH=$work/profile TMPDIR=$work/tmp
export SUNDER_POSTGIS="dbname='maps' host='$work/server' user='sunder'" PYTHONDONTWRITEBYTECODE=1
PATH=$(dirname "$SUNDER"):$PATH
timeout 250 "$python" "$here/plugin.py" PostGIS >"$work/log" 2>&1 || fail "plugin.py failed"
grep -E '^(Ran|OK)' "$work/log"
