# shellcheck shell=bash disable=SC1091
# The delivery of an output, interrupted at its system calls: the run is killed there, or the call fails, or it writes
# only half of its bytes, or the disk is full from some byte on. Afterwards the old output or the new one is there, byte
# by byte; or the next run that writes there finds the remains, reports them and restores the old output. After status 0
# it is the new one.
#
#   SUNDER_FAULTS=N     places for each kind of fault, spread over the run from SUNDER_SEED on (default 1)
#   SUNDER_FAULTS=all   every call, and a disk that is full at every 4096th byte, at 64 places of a small output
#   SUNDER_FAULTS_SCENARIOS=WORDS, SUNDER_FAULTS_WAYS=WORDS   only these scenarios, only these kinds of faults
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
strike=$SUNDER_BUILD/tests/strike
[ -x "$strike" ] || { echo "skipped: tests/strike is not built"; exit 77; }
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0" # the leak detector does not work under ptrace
export SOURCE_DATE_EPOCH=1700000000
budget=${SUNDER_FAULTS:-1}
seed=${SUNDER_SEED:-$((RANDOM))}
echo "SUNDER_SEED=$seed SUNDER_FAULTS=$budget"

layer in.gpkg houses POLYGON <<'X'
id,name,WKT
1,one,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,two,"POLYGON((3 0,7 0,7 4,3 4,3 0))"
3,three,"POLYGON((13 0,17 0,17 4,13 4,13 0),(14 1,14 2,15 2,15 1,14 1))"
X
"$strike" list 0 true 3>probe 2>message || { echo "skipped: $(cat message)"; exit 77; }
rm -f probe message

# scenario NAME: sets the files that exist before (`old`), and the run with faults (`args`).
scenarios="gpkg-overwrite shp-overwrite fgb-overwrite geojson-overwrite gpkg-update wal-update gpkg-replace-layer shp-new"
# replaced in nearly the same way as with --overwrite
[ "$budget" = all ] && scenarios="$scenarios shp-update fgb-update geojson-update"
scenario() {
    local format=${1%%-*} kind=${1#*-}
    [ "$format" = wal ] && format=gpkg
    output=o.$format
    options=(separate in.gpkg "$output" -q)
    [ "$format" = shp ] && options+=(--lco DBF_DATE_LAST_UPDATE=2024-01-01)
    args=("${options[@]}" --gap 1)
    case $kind in
    overwrite) args+=(--overwrite) ;;
    update)
        args+=(--update)
        if [ "$format" = gpkg ]; then args+=(--output-layer more); else args+=(--overwrite-layer); fi
        ;;
    replace-layer) args+=(--update --overwrite-layer) ;;
    esac
    rm -rf pristine && mkdir pristine && cp in.gpkg pristine
    if [ "$kind" != new ]; then
        (cd pristine && "$SUNDER" "${options[@]}" 2>/dev/null) || fail "$1: no old output"
    fi
    if [ "$1" = wal-update ]; then
        sqlite3 pristine/o.gpkg 'PRAGMA journal_mode = WAL' >/dev/null 2>&1 || return 1
    fi
}

# The state of the output as a reader finds it. When a database is opened, SQLite first rolls back an interrupted
# transaction.
state() {
    if [ -e "dir/$output-journal" ] || [ -e "dir/$output-wal" ]; then
        ogrinfo -q "dir/$output" >/dev/null 2>&1 # opens the database for writing, which rolls back
    fi
    # A journal that is empty, or begins with zeros, was never synced: the database has not been changed, and SQLite
    # ignores the journal.
    case $(head -qc 1 "dir/$output-journal" 2>/dev/null | od -An -tu1 | tr -d ' ') in
    '' | 0) rm -f "dir/$output-journal" ;;
    esac
    (cd dir && find . -name '.sunder-*' -prune -o -type f ! -name '*-shm' -print0 | sort -z |
        xargs -0 cksum)
}

start() {
    chmod -R u+rwx dir 2>/dev/null
    rm -rf dir && cp -a pristine dir
}

# struck WAY PLACE: runs with one fault; sets $calls, $bytes, $status, $call, $writes.
struck() {
    start
    (cd dir && STRIKE_UNDER=. "$strike" "$1" "$2" "$SUNDER" "${args[@]}") 3>report >out 2>err
    read -r calls bytes status call _ writes <report
    runs=$((runs + 1))
}

judge() {
    local name=$1 way=$2 place=$3 now after
    now=$(state)
    if [ "$status" -eq 0 ] && [ "$now" != "$new" ]; then
        fail "$name $way $place ($call): status 0, and the output is not the new one"
    fi
    if [ "$now" = "$new" ]; then
        ended_new=$((ended_new + 1))
        [ "$status" -eq 1 ] && after_all=$((after_all + 1))
        return
    fi
    if [ "$now" = "$old" ]; then
        ended_old=$((ended_old + 1))
        return
    fi
    (cd dir && "$SUNDER" "${options[@]}" --log ../next >/dev/null 2>&1)
    after=$(state)
    if grep -q 'former files have been restored' next && [ "$after" = "$cleared" ] && [ -z "$(ls -d dir/.sunder-* 2>/dev/null)" ]; then
        brought_back=$((brought_back + 1))
    else
        fail "$name $way $place ($call): neither the old nor the new output, and the next run did not restore it"
        { cat next; diff <(echo "$old") <(echo "$now"); } | sed 's/^/  /' | head -20
    fi
}

# The numbers of the calls for one kind of fault: all of 1..N in steps, or $budget of them.
places() {
    local n=$1 step=$2 i
    if [ "$budget" = all ]; then
        seq 1 "$step" "$n"
    else
        for ((i = 0; i < budget; i++)); do echo $((1 + (seed + i * n / budget) % n)); done
    fi
}

for name in ${SUNDER_FAULTS_SCENARIOS:-$scenarios}; do
    scenario "$name" || { echo "not tried: $name (no shell of SQLite)"; continue; }
    runs=0 ended_old=0 ended_new=0 brought_back=0 after_all=0
    start && old=$(state)
    # The outcome of the next run that finds the old state: it is refused if there is an output.
    (cd dir && "$SUNDER" "${options[@]}" >/dev/null 2>&1)
    cleared=$(state)
    struck list 0
    [ "$status" -eq 0 ] || fail "$name: the run fails when it is not struck"
    new=$(state)
    [ "$new" != "$old" ] || fail "$name: the run changes nothing"
    all=$calls length=$bytes halves=$writes runs=0
    for way in ${SUNDER_FAULTS_WAYS:-kill errno:ENOSPC errno:EIO short full}; do
        case $way in
        full) where=$(places "$length" $((length / 64 < 4096 ? length / 64 + 1 : 4096))) ;;
        short) where=$(places "$halves" 1) ;;
        *) where=$(places "$all" 1) ;;
        esac
        for place in $where; do
            struck "$way" "$place"
            judge "$name" "$way" "$place"
        done
    done
    echo "$name: $all calls, $length bytes; $runs runs ended with the old output $ended_old, the new one $ended_new" \
        "(of which with status 1: $after_all), brought back $brought_back"
done
finish
