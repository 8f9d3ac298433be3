# shellcheck shell=bash disable=SC1091
# SIGTERM, SIGHUP, SIGXFSZ and SIGXCPU in turn at system calls throughout a run, for every command: reading, computing,
# writing, reading back, putting in place. Before the output is decided the run ends with status 1 and a message about
# the signal; later it completes. A second signal, at once or some calls later, ends it as by default. In every case
# only the old output or the new one is left, complete. strike withholds the alarm that would end a run that does not
# poll for signals: so the test shows that all these places poll.
#
#   SUNDER_FAULTS=N     places for each way and command, spread over the run from SUNDER_SEED on (default 2)
#   SUNDER_FAULTS=all   200 of them
#   SUNDER_FAULTS_SCENARIOS=WORDS   some of the commands only
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
strike=$SUNDER_BUILD/tests/strike
[ -x "$strike" ] || { echo "skipped: tests/strike is not built"; exit 77; }
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0" # the leak detector does not work under ptrace
export SOURCE_DATE_EPOCH=1700000000
budget=${SUNDER_FAULTS:-2}
[ "$budget" = all ] && budget=200
seed=${SUNDER_SEED:-$((RANDOM))}
echo "SUNDER_SEED=$seed SUNDER_FAULTS=$budget"
"$strike" list 0 true 3>report 2>message || { echo "skipped: $(cat message)"; exit 77; }

mkdir pristine
ogr2ogr pristine/in.gpkg "$SUNDER_SOURCE/datasets-synthetic/town.gpkg" buildings -where 'fid <= 60' || fail "no input"
for name in p q; do
    python3 - $name >pristine/$name.wkt <<'X'
import math, random, sys
R = random.Random(sys.argv[1])
p = [(r * math.cos(i / 20), r * math.sin(i / 20)) for i, r in enumerate(R.uniform(5, 9) for _ in range(125))]
print("POLYGON((" + ",".join("%.3f %.3f" % q for q in p + p[:1]) + "))")
X
done

# name, files that exist before, command
scenarios='
pair-text       -         pair @p.wkt @q.wkt --gap 1
pair            -         pair @p.wkt @q.wkt o.gpkg
sum-text        -         sum @p.wkt @q.wkt
sum             -         sum @p.wkt @q.wkt o.gpkg --stats s.json
route           -         route in.gpkg o.gpkg --robot disc:1 --from 0,0 --to 100,100 --free-space
buffer          -         buffer in.gpkg o.fgb --shape disc:2 --dissolve
check           -         check in.gpkg o.geojson --gap 3
separate        o.gpkg    separate in.gpkg o.gpkg --gap 3 --progress=plain --overwrite --stats s.json
separate-files  o.shp     separate in.gpkg o.shp --gap 3 --progress=plain --overwrite --lco DBF_DATE_LAST_UPDATE=2024-01-01 --report r.html --proof r.jsonl
separate-update o.gpkg    separate in.gpkg o.gpkg --gap 3 --update --output-layer more
'

# The content of every file except the statistics, which contain times.
state() {
    (cd dir && find . -type f ! -name s.json -print0 | sort -z | xargs -0 cksum
    ls -Ad .sunder-* s.json 2>/dev/null)
}

# struck WAY PLACE; sets $calls, $status, $call, $shown, and $said, the expected message about the signal.
turn=0
said='sunder: error: interrupted'
struck() {
    local way=$1
    rm -rf dir && cp -a before dir
    if [ "$way" = signal ]; then
        said='sunder: error: interrupted'
        case $((turn++ % 4)) in
        1) way=signal:HUP ;;
        2) way=signal:XFSZ said+=': a file would exceed the size limit of this process (ulimit -f)' ;;
        3) way=signal:XCPU said+=': the time limit of this process is reached (ulimit -t)' ;;
        esac
    fi
    (cd dir && STRIKE_UNDER=. "$strike" "$way" "$2" "$SUNDER" "${args[@]}") 3>report >out 2>err
    read -r calls _ status call shown _ <report
}

# SQLite rolls back the transaction of a run that its second signal ended.
settle() {
    [ ! -s dir/o.gpkg-journal ] || ogrinfo -q dir/o.gpkg >/dev/null 2>&1
    rm -f dir/o.gpkg-journal
}

judge() {
    local way=$1 place=$2 now
    [ "$way" = signal ] || settle
    now=$(state)
    case $way-$status in
    signal-1)
        [ "$now" = "$old" ] || fail "$name $way $place ($call): interrupted, and the output is not the old one: $now"
        [ "$(grep -v '^[0-9]*$' err)" = "$said" ] || fail "$name $way $place ($call): $(cat err)"
        interrupted=$((interrupted + 1))
        ;;
    signal-[03])
        [ "$now" = "$new" ] || fail "$name $way $place ($call): done, and the output is not the new one: $now"
        # There are some calls between the decision and the first visible change.
        [ "$place" -gt $((first - 40)) ] || fail "$name $way $place of $first ($call): the signal was ignored"
        completed=$((completed + 1))
        ;;
    signals*-130 | signals*-143 | signals*-[013])
        # During a commit the result may be either output, and the statistics, the proof or the report may belong to
        # either.
        case $now in "$new" | "$old" | "${new%?s.json}" | "$(grep -v ' \./r\.html$' <<<"$new")" | \
            "$(grep -v ' \./r\.\(html\|jsonl\)$' <<<"$new")") ;; *) false ;; esac || fail "$name $way $place ($call): status $status, left: $now"
        ended=$((ended + (status > 100)))
        ;;
    *) fail "$name $way $place ($call): status $status" ;;
    esac
}

# places FROM TO: $budget numbers between the two.
places() { for ((i = 0; i < budget; i++)); do echo $(($1 + (seed + i * ($2 - $1) / budget) % ($2 - $1))); done; }

while read -r name former words; do
    [ -n "$name" ] || continue
    case " ${SUNDER_FAULTS_SCENARIOS:-$name} " in *" $name "*) ;; *) continue ;; esac
    read -ra args <<<"$words"
    interrupted=0 completed=0 ended=0 again=0
    rm -rf before && cp -a pristine before
    if [ "$former" != - ]; then
        (cd before && "$SUNDER" separate in.gpkg "$former" -q --lco DBF_DATE_LAST_UPDATE=2024-01-01 2>/dev/null)
    fi
    rm -rf dir && cp -a before dir
    old=$(state)
    struck calls 0
    [ "$status" -eq 0 ] || [ "$status" -eq 3 ] || fail "$name: the run fails when it is not struck: $(cat err)"
    new=$(state)
    all=$calls first=$((shown ? shown : calls))
    for place in $(places 1 "$first"); do
        struck signal "$place"
        judge signal "$place"
        again=$(((again + 7) % 30))
        struck signals:$again "$place"
        judge signals:$again "$place"
    done
    # Also near the end, while the output is put in place.
    for place in $(places $((first - 20)) $((all + 1))); do
        struck signal "$place"
        judge signal "$place"
        struck signals:0 "$place"
        judge signals:0 "$place"
    done
    [ $((interrupted * ended)) -gt 0 ] || fail "$name: interrupted $interrupted, ended $ended times: too few for the test"
    echo "$name: $all calls, the output shows from call $first on; interrupted $interrupted, completed after the signal" \
        "$completed, ended by the second signal $ended"
done <<<"$scenarios"
finish
