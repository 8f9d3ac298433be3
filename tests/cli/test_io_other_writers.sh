# shellcheck shell=bash disable=SC1091
# A GeoPackage that other processes have open. --update and --overwrite write into the database itself, in one
# transaction under its lock. A run that cannot get the lock reports that. No other process loses its changes, and the
# journal mode of the database stays.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null && python3 -c 'import sqlite3' 2>/dev/null || { echo "skipped: no Python with SQLite"; exit 77; }

layer in.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,"POLYGON((3 0,7 0,7 4,3 4,3 0))"
X
cat >hold.py <<'X'
import sqlite3, sys
path, how = sys.argv[1:]
held = sqlite3.connect(path, isolation_level=None, timeout=0)
if how == "read":
    held.execute("BEGIN")
if how == "write":
    held.execute("BEGIN IMMEDIATE")
    held.execute("CREATE TABLE held (x)")
if how == "open" and held.execute("PRAGMA journal_mode").fetchone() == ("delete",):
    # in this mode SQLite does not check whether the file still has its name
    held.execute("PRAGMA journal_mode = MEMORY")
held.execute("SELECT count(*) FROM houses").fetchall()
print("held", flush=True)
sys.stdin.readline()
if how == "write":
    held.execute("COMMIT")
if how == "open":
    held.execute("CREATE TABLE IF NOT EXISTS later (x)")
    held.execute("INSERT INTO later VALUES (1)")
held.close()
X
ask() { python3 -c 'import sqlite3, sys; print(*(sqlite3.connect(sys.argv[1]).execute(sys.argv[2]).fetchone()))' "$1" "$2"; }
mkfifo to from

# held DATABASE HOW: another process holds it until `let_go`.
held() {
    python3 hold.py "$1" "$2" <to >from &
    holder=$!
    exec 8>to 9<from
    read -r -u 9 _ || fail "the process that should hold $1 did not start"
}
let_go() {
    echo >&8
    exec 8>&- 9<&-
    wait "$holder"
}

for mode in delete wal; do
    ogr2ogr "$mode.gpkg" in.gpkg
    ask "$mode.gpkg" "PRAGMA journal_mode = $mode" >/dev/null
    for how in read write open; do
        rm -f o.gpkg* && cp "$mode.gpkg" o.gpkg
        held o.gpkg "$how"
        run separate in.gpkg o.gpkg --update --output-layer apart --config SQLITE_BUSY_TIMEOUT 200 -q
        case $mode-$how in
        delete-open | wal-read | wal-open) [ "$status" -eq 0 ] || fail "$mode, $how: status $status" ;;
        *) [ "$status" -eq 1 ] && grep -q 'in use by another program.*within 0.2 s' err || fail "$mode, $how: status $status" ;;
        esac
        let_go
        same "$(ask o.gpkg 'PRAGMA journal_mode')" "$mode" "$how: the mode of the journal"
        same "$(ask o.gpkg 'PRAGMA integrity_check')" ok "$mode, $how"
        [ "$status" -eq 0 ] && same "$(count o.gpkg apart)" 2 "$mode, $how: the layer"
        [ "$status" -eq 0 ] || same "$(ask o.gpkg "SELECT count(*) FROM sqlite_master WHERE name LIKE '%apart%'")" 0 "$mode, $how"
        [ "$how" != write ] || same "$(ask o.gpkg "SELECT count(*) FROM sqlite_master WHERE name = 'held'")" 1 "$mode: the other program's changes"

        # The same holds for replacing: later writes of the other program are kept, together with the journal files that
        # it has open.
        rm -f o.gpkg* && cp "$mode.gpkg" o.gpkg
        held o.gpkg "$how"
        run separate in.gpkg o.gpkg --gap 1 --overwrite --config SQLITE_BUSY_TIMEOUT 200 -q
        case $mode-$how in
        delete-open | wal-read | wal-open) [ "$status" -eq 0 ] || fail "$mode, $how: status $status, --overwrite" ;;
        *) [ "$status" -eq 1 ] && grep -q 'in use by another program.*within 0.2 s' err || fail "$mode, $how: status $status, --overwrite" ;;
        esac
        let_go
        same "$(ask o.gpkg 'PRAGMA journal_mode')" "$mode" "$how, --overwrite: the mode of the journal"
        same "$(ask o.gpkg 'PRAGMA integrity_check')" ok "$mode, $how, --overwrite"
        same "$(ask o.gpkg "SELECT count(*) FROM sqlite_master WHERE name = 'houses_displacement'")" $((status == 0)) "$mode, $how, --overwrite: layers"
        [ "$how" != open ] || same "$(ask o.gpkg 'SELECT count(*) FROM later')" 1 "$mode: what an idle holder wrote after --overwrite"
        expect 0 separate in.gpkg o.gpkg --overwrite -q
        same "$(count o.gpkg houses)" 2 "$mode, $how: written over"
    done
done

# A damaged file that begins like a database is replaced by a rename.
head -c 5000 delete.gpkg >o.gpkg && dd if=/dev/zero of=o.gpkg bs=1 seek=16 count=4984 conv=notrunc 2>/dev/null
expect 0 separate in.gpkg o.gpkg --overwrite -q
same "$(ask o.gpkg 'PRAGMA integrity_check')" ok 'over a damaged file'

# ---- runs at the same time: the layer of each run with status 0 is complete
for mode in delete wal; do
    rm -f o.gpkg* && cp "$mode.gpkg" o.gpkg
    for i in 1 2 3 4; do
        (status=0; "$SUNDER" separate in.gpkg o.gpkg --update --output-layer "apart$i" -q 2>"err$i" || status=$?; echo $status >"status$i") &
    done
    wait
    for i in 1 2 3 4; do
        if [ "$(cat "status$i")" -eq 0 ]; then
            same "$(count o.gpkg "apart$i")" 2 "$mode: layer $i of four runs at once"
        else
            grep -q '^sunder: error' "err$i" || fail "run $i of four at once says nothing"
        fi
    done
    same "$(ask o.gpkg 'PRAGMA integrity_check')" ok "$mode, four runs at once"
done
# Several runs write to the same new path at once: one succeeds, the others must not replace its file.
rm -f o.gpkg*
for i in 1 2 3 4; do
    (status=0; "$SUNDER" separate in.gpkg o.gpkg --update --output-layer "apart$i" -q 2>"err$i" || status=$?; echo $status >"status$i") &
done
wait
for i in 1 2 3 4; do
    [ "$(cat "status$i")" -ne 0 ] || same "$(count o.gpkg "apart$i")" 2 "layer $i of four runs at once into a new file"
done

# ---- a journal that another program left is reported and rolled back; one of another database is refused
interrupted() { # an update of o.gpkg that is killed after its journal is synced
    rm -f o.gpkg* && cp delete.gpkg o.gpkg
    python3 - <<'X'
import os, sqlite3
c = sqlite3.connect("o.gpkg", isolation_level=None)
c.execute("PRAGMA cache_size = 1")
c.execute("PRAGMA cache_spill = 1")
c.execute("BEGIN IMMEDIATE")
c.execute("CREATE TABLE half (x)")
c.executemany("INSERT INTO half VALUES (?)", [("x" * 3000,)] * 500)
os._exit(1)
X
    [ -s o.gpkg-journal ] || fail "the test's own journal is missing"
}
interrupted
refused 1 'o.gpkg-journal was left by an interrupted transaction' separate o.gpkg other.gpkg
run separate in.gpkg o.gpkg --update --output-layer apart
[ "$status" -eq 0 ] || fail "a database with a journal is not added to"
says err 'o.gpkg-journal was left by an interrupted transaction'
same "$(ask o.gpkg "SELECT count(*) FROM sqlite_master WHERE name = 'half'")" 0 'what was interrupted'
same "$(count o.gpkg apart)" 2 'the layer added'
interrupted
run separate in.gpkg o.gpkg --overwrite -q
[ "$status" -eq 0 ] && [ ! -e o.gpkg-journal ] || fail "the old journal was left beside the new file"
interrupted
rm o.gpkg
refused 1 'o.gpkg-journal belongs to a former database' separate in.gpkg o.gpkg
finish
