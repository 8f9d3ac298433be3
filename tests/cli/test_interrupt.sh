# shellcheck shell=bash disable=SC1091
# SIGINT and SIGTERM while a run waits or works without end: for a pipe, in a statement of a database that it reads or
# writes, in a statement that cannot be interrupted. Each run stays in that state until the signal arrives, so the test
# does not depend on time. (tests/faults/test_signals.sh sends signals at every system call of ordinary runs;
# tests/watch tests the library.)
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
strike=$SUNDER_BUILD/tests/strike
[ -x "$strike" ] && "$strike" list 0 true 3>report 2>/dev/null || { echo "skipped: no process can be traced here"; exit 77; }
command -v sqlite3 >/dev/null || { echo "skipped: no shell of SQLite"; exit 77; }
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0" SOURCE_DATE_EPOCH=1700000000

layer in.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,"POLYGON((3 0,7 0,7 4,3 4,3 0))"
X
mkfifo pipe
count='(WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c LIMIT 1000000000000) SELECT count(*) FROM c)'
deaf="instr(zeroblob(50000000), CAST(zeroblob(1000000) || x'01' AS BLOB))"

# caught PID: waits until the process has installed its signal handlers, and a little longer, so that it reaches the
# state in which it stays.
caught() {
    local mask
    until mask=$(sed -n 's/^SigCgt:\s*//p' "/proc/$1/status" 2>/dev/null) && [ $((0x${mask:-0} >> 14 & 1)) -eq 1 ]; do
        [ -e "/proc/$1" ] || return
        sleep 0.02
    done
    sleep 0.3
}

# held SIGNALS ARGS: runs the program and sends the signals; sets $status. `strike` withholds SIGALRM, by which the
# program would end a call that does not poll for signals, so that a signal ends only code that polls. (The subshell
# does not ignore SIGINT.)
held() {
    local signals=$1 pid child
    shift
    "$strike" list 0 "$SUNDER" "$@" 3>report >out 2>err 7<>pipe </dev/fd/7 &
    pid=$!
    until child=$(cat "/proc/$pid/task/$pid/children") && [ -n "$child" ]; do sleep 0.02; done
    caught $child
    for signal in $signals; do kill -s "$signal" $child; done
    wait $pid
    read -r _ _ status _ <report
}

# interrupted ARGS: with either signal the run ends with status 1, one line of message, and unchanged files.
turn=0
interrupted() {
    local signals=(INT TERM) signal
    signal=${signals[turn++ % 2]}
    listing >before
    held "$signal" "$@"
    listing >after
    [ "$status" -eq 1 ] || fail "$signal, status $status: sunder $*"
    same "$(cat err)" 'sunder: error: interrupted' "$signal: sunder $*"
    [ ! -s out ] || fail "$signal, something on stdout: sunder $*"
    cmp -s <(grep -v report before) <(grep -v report after) || fail "$signal, files changed: sunder $* $(diff before after)"
}

# ---- waiting: for an operand, a shape, features
interrupted pair @- square:1
interrupted sum @pipe square:1 o.gpkg
interrupted route square:1 o.gpkg --robot @pipe --from 5,5 --to 6,6
interrupted buffer in.gpkg o.fgb --shape @pipe

# ---- within an SQL statement of the input
for command in "separate in.gpkg o.gpkg" "check in.gpkg" "buffer in.gpkg o.shp --shape square:1" \
    "route in.gpkg --robot square:1 --from 20,20 --to 30,30" "sum in.gpkg square:1 o.gpkg" "pair square:1 in.gpkg"; do
    # shellcheck disable=SC2086 # words
    interrupted $command --where "$count > 0"
done
interrupted separate in.gpkg o.gpkg --sql "SELECT * FROM houses WHERE $count > 0"
interrupted check in.gpkg --dialect sqlite --sql "SELECT * FROM houses WHERE $count > 0"
interrupted separate in.gpkg o.gpkg --fixed-where "$count > 0"

# ---- within an SQL statement of the output: the old content stays, and the journal is removed
interrupted_writing() {
    "$SUNDER" separate in.gpkg o.gpkg -q --layers main --no-styles && sqlite3 o.gpkg "$1" >mode
    shift
    interrupted "$@"
    rm -f o.gpkg mode
}
interrupted_writing "CREATE TRIGGER slow AFTER INSERT ON gpkg_contents BEGIN SELECT $count; END" \
    separate in.gpkg o.gpkg --update --output-layer more
interrupted_writing "CREATE TRIGGER slow AFTER DELETE ON gpkg_contents BEGIN SELECT $count; END" \
    buffer in.gpkg o.gpkg --shape square:1 --update --overwrite-layer --output-layer houses
interrupted_writing "CREATE TRIGGER slow AFTER UPDATE ON gpkg_contents BEGIN SELECT $count; END; PRAGMA journal_mode = WAL" \
    check in.gpkg o.gpkg --update --output-layer more

# ---- a statement that cannot be interrupted: a second signal ends the run as by default ...
twice() { # (the system decides which of the two signals arrives first)
    listing >before
    held "TERM INT" "$@"
    listing >after
    [ "$status" -eq 130 ] || [ "$status" -eq 143 ] || fail "two signals, status $status: sunder $*"
    cmp -s <(grep -v report before) <(grep -v report after) || fail "two signals, files changed: sunder $* $(diff before after)"
}
twice separate in.gpkg o.gpkg --where "$deaf = 0"
"$SUNDER" separate in.gpkg o.gpkg -q --layers main --no-styles
sqlite3 o.gpkg "CREATE TRIGGER slow AFTER INSERT ON gpkg_contents BEGIN SELECT $deaf; END"
twice separate in.gpkg o.gpkg --update --output-layer more

# ---- ... and one signal ends it after a second, with exit status 1; the same where GDAL waits in a loop
ended() {
    listing >before
    "$SUNDER" "$@" >out 2>err 7<>pipe </dev/fd/7 &
    caught $!
    kill -TERM $!
    wait $!
    status=$?
    listing >after
    [ "$status" -eq 1 ] || fail "status $status: sunder $*"
    same "$(cat err)" 'sunder: error: interrupted' "sunder $*"
    cmp -s before after || fail "files changed: sunder $* $(diff before after)"
}
ended separate in.gpkg other.gpkg --where "$deaf = 0"
ended check /vsistdin/ other.gpkg
ended separate in.gpkg o.gpkg --update --output-layer more
finish
