# shellcheck shell=bash disable=SC1091
# A limit on the size of files (ulimit -f, SIGXFSZ) that is reached anywhere in a run: the run ends with 1 and a
# message, and only the old output is there. With a limit above its largest file the run succeeds. And SIGHUP: no files
# are left, unless it is ignored, as under nohup; then the run continues. (test_signals.sh sends signals at all system
# calls.)
#
#   SUNDER_FAULTS=N   limits for each way of writing, spread from SUNDER_SEED on (default 1; all: 60)
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v prlimit >/dev/null || { echo "skipped: prlimit (util-linux) is not installed"; exit 77; }
export SOURCE_DATE_EPOCH=1700000000 ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"
budget=${SUNDER_FAULTS:-1}
[ "$budget" = all ] && budget=60
seed=${SUNDER_SEED:-$((RANDOM))}
echo "SUNDER_SEED=$seed SUNDER_FAULTS=$budget"

mkdir pristine
ogr2ogr pristine/in.gpkg "$SUNDER_SOURCE/datasets-synthetic/town.gpkg" buildings -where 'fid <= 60' || fail "no input"

scenarios='
new       -         separate in.gpkg o.gpkg --gap 3 --stats s.json
replaced  o.gpkg    separate in.gpkg o.gpkg --gap 3 --overwrite --report r.html --proof p.jsonl
added     o.gpkg    separate in.gpkg o.gpkg --gap 3 --update --output-layer more
files     o.shp     separate in.gpkg o.shp --gap 3 --overwrite --lco DBF_DATE_LAST_UPDATE=2024-01-01
text      -         buffer in.gpkg o.geojson --shape disc:2
parts     -         separate in.gpkg o.gpkg --gap 3 --max-memory 200M
plan      -         plan in.gpkg o.plan --gap 3 --shards 2
'

state() { (cd dir && find . ! -name s.json \( -type f -exec cksum {} + -o -print \) | sort); }

# with_limit BYTES: sets $status.
with_limit() {
    rm -rf dir && cp -a before dir
    (cd dir && TMPDIR=$PWD prlimit --fsize="$1" -- "$SUNDER" "${args[@]}") >out 2>err
    status=$?
}

while read -r name former words; do
    [ -n "$name" ] || continue
    read -ra args <<<"$words"
    rm -rf before && cp -a pristine before
    [ "$former" = - ] || (cd before && "$SUNDER" separate in.gpkg "$former" -q --lco DBF_DATE_LAST_UPDATE=2024-01-01 2>/dev/null)
    rm -rf dir && cp -a before dir
    old=$(state)
    with_limit unlimited
    [ "$status" -eq 0 ] || [ "$status" -eq 3 ] || fail "$name: the run fails without a limit"
    new=$(state)
    size=$(find dir -type f ! -name in.gpkg -printf '%s\n' | sort -n | tail -1)
    limited=0
    for ((i = 0; i < budget; i++)); do
        limit=$(((seed + 1 + i) * 104729 % size))
        with_limit $limit
        now=$(state)
        case $status in
        1)
            limited=$((limited + 1))
            [ "$now" = "$old" ] || fail "$name, $limit of $size bytes: left: $(diff <(echo "$old") <(echo "$now"))"
            [ "$(grep -c '^sunder: error: ' err)" -eq 1 ] || fail "$name, $limit of $size bytes: not exactly one error message"
            says err 'ulimit -f'
            ;;
        0 | 3) fail "$name: done with $limit of $size bytes" ;;
        *) fail "$name, $limit of $size bytes: status $status" ;;
        esac
    done
    with_limit $((4 * size + 1000000))
    [ "$status" -eq 0 ] || [ "$status" -eq 3 ] || fail "$name: the run fails with a limit that it does not meet"
    case $name in plan) ;; *) [ "$(state)" = "$new" ] || fail "$name: the result differs under a limit that is not reached" ;; esac
    [ "$limited" -eq "$budget" ] || fail "$name: $limited of $budget runs met the limit"
done <<<"$scenarios"

# ---- SIGHUP ends the run, unless it is ignored when the run begins
cp pristine/in.gpkg .
mkfifo pipe
# hung_up COMMAND...: waits until the process has its signal handlers or ignores SIGHUP, sends it; sets $status
hung_up() {
    local pid
    "$@" >out 2>err 7<>pipe </dev/fd/7 &
    pid=$!
    until [ "$(cat /proc/$pid/comm)" = sunder ] &&
        [ "$((0x$(sed -n 's/^SigCgt:\s*//p' /proc/$pid/status) >> 14 & 1))" -eq 1 ]; do
        [ -e /proc/$pid ] || break
        sleep 0.02
    done
    kill -HUP $pid
    wait $pid
    status=$?
}
listing >before_hup
hung_up "$SUNDER" pair @pipe square:1
same "$status" 1 "SIGHUP"
same "$(cat err)" 'sunder: error: interrupted' "SIGHUP"
listing >after_hup
cmp -s <(grep -v _hup before_hup) <(grep -v _hup after_hup) || fail "SIGHUP: files changed"
printf 'POLYGON ((0 0, 1 0, 0 1, 0 0))' >triangle
(
    trap '' HUP
    exec "$SUNDER" pair @- square:1 <pipe
) >out 2>err &
pid=$!
exec 8>pipe
until [ "$(cat /proc/$pid/comm)" = sunder ] && grep -q '^SigCgt:.*[1-9a-f]' /proc/$pid/status; do sleep 0.02; done
kill -HUP $pid
cat triangle >&8
exec 8>&-
wait $pid
same "$?" 0 "SIGHUP that is ignored"
says out dx
finish
