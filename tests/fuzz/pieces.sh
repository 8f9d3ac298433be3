#!/usr/bin/env bash
# Long fuzzing in pieces. Each piece continues with the inputs that earlier pieces found to reach new code, and adds its
# executions and seconds to a tally. So hours of fuzzing can be composed of minutes, on a machine that has other work.
#
#   pieces.sh SECONDS [NAME ...]   runs a piece of this length for each of the targets (by default all), one process at a time, and
#                                  builds them first if needed. A piece begins with all known inputs, so it should be several times
#                                  as long as these take
#   pieces.sh --keep [NAME ...]    writes the inputs that are needed for the same coverage to corpus/NAME.tar.gz. The next pieces begin
#                                  with these only, since each piece runs all of its inputs before anything new
#   pieces.sh --record             writes RECORD.md from the tallies
#
# Several processes may run at the same time, also for one target: each has a log of its own, and new inputs go to a
# common folder. SUNDER_FUZZ_AS_BUILT=yes uses the targets as they were built last; SUNDER_FUZZ_NICE is their nice value
# (19). State is in SUNDER_FUZZ_STATE (<build>/fuzz/pieces): inputs, tallies, and failing inputs in found/. Without
# earlier state it starts from RECORD.md and corpus/. A target that makes more than 2000 executions in a second is done
# at ten million executions, any other target after eight hours of one core. The speed is that of the last quarter of an
# hour of pieces, since causes of slowness get corrected. Other work on the machine slows the pieces; measure a target
# near 2000 on a quiet machine.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
here=$root/tests/fuzz
export SUNDER_SOURCE=$root SUNDER_BUILD=${SUNDER_BUILD:-$root/build/release}
state=${SUNDER_FUZZ_STATE:-$SUNDER_BUILD/fuzz/pieces}
quick=2000 executions_wanted=10000000 hours_wanted=8
# awk: the sums over all pieces passed to take(), and the executions per second of the latest ones
# shellcheck disable=SC2016 # the words are those of awk
tally='function take() { n += $2; s += $3; executions[++pieces] = $2; seconds[pieces] = $3 }
    function pace(  i, e, t) { for (i = pieces; i && t < 900; --i) { e += executions[i]; t += seconds[i] } return t ? e / t : 0 }'
mkdir -p "$state/found"

targets() { for file in "$here"/fuzz_*.c; do basename "$file" .c; done; }
final() { sed -n "s/^stat::$1: *//p" "$2" | tail -n 1; }
covered() { # LOG: prints the number of covered edges and of all edges
    local all run
    all=$(sed -n 's/^INFO: Loaded .* modules *(\([0-9]*\) inline 8-bit counters).*/\1/p' "$1" | head -n 1)
    run=$(sed -n 's/.* cov: \([0-9]*\) .*/\1/p' "$1" | tail -n 1)
    echo "${run:-0} ${all:-0}"
}

build() { # builds, and records of which commit, with "-dirty" if the sources differ from it
    local dirty=
    bash "$here/build.sh" >"$state/build.log" 2>&1 || { tail -n 30 "$state/build.log"; exit 1; }
    git -C "$root" diff --quiet HEAD -- src gis tests/fuzz || dirty=-dirty
    echo "$(git -C "$root" rev-parse --short=7 HEAD)$dirty" >"$SUNDER_BUILD/fuzz/built_of"
}

# without a tally it starts from RECORD.md: the recorded total, with its last quarter of an hour at the recorded speed
begin_tally() {
    [ -f "$state/tally" ] || [ ! -f "$here/RECORD.md" ] || awk -F ' *[|] *' '
        $2 ~ /^`fuzz_/ {
            gsub(/`/, "", $2); gsub(/ of /, " ", $6); gsub(/, /, ",", $8)
            latest = 900 < 3600 * $4 ? 900 : 3600 * $4
            if (latest * $5 > $3) latest = $3 / $5
            made = int(latest * $5)
            print $2, $3 - made, 3600 * $4 - latest, $6, $8
            print $2, made, latest, $6, $8
        }' "$here/RECORD.md" >"$state/tally"
}

begin() { # TARGET: its first inputs, from the recorded corpus and the seeds
    local corpus=$state/$1
    [ -d "$corpus" ] && return
    mkdir -p "$corpus"
    [ ! -f "$here/corpus/$1.tar.gz" ] || tar -xzf "$here/corpus/$1.tar.gz" -C "$corpus"
    [ ! -d "$here/seeds/$1" ] || cp "$here/seeds/$1"/* "$corpus"
}

piece() { # NAME SECONDS
    local name=$1 log=$state/$1.$$.log status=0 spent executions inputs
    begin "$name"
    inputs=$(find "$state/$name" -type f | wc -l)
    local TIMEFORMAT='%U %S'
    # Options of libFuzzer. Leaks are looked for at the end of each input; each piece has a seed of its own. Inputs that
    # take little time are drawn up to thirty times as often as slow ones: a hundredth of the inputs took half of the
    # time, and new code is found sooner this way. Entropic scheduling by rare features is nearly off, since for some
    # thousand inputs of some thousand features each it takes more time than the target. The folder is not scanned each
    # second for inputs of other processes. The time limit of an input is in real time, and other work on the machine
    # slows the run. Stacks of allocations are one frame deep; run a finding by itself to see more. Freed memory is
    # quarantined up to 1 MB: with 8 MB the target of a reader makes a third fewer executions. Memory is not returned to
    # the system, and only the first 256 bytes of an allocation are filled with a pattern, not the first four thousand.
    local checks=malloc_context_size=1:quarantine_size_mb=1:thread_local_quarantine_size_kb=64
    checks=$checks:allocator_release_to_os_interval_ms=-1:max_malloc_fill_size=256
    local schedule=(-entropic=1 -entropic_scale_per_exec_time=1
        -entropic_number_of_rarest_features=1 -entropic_feature_frequency_threshold=1 -reload=0)
    spent=$( { time ASAN_OPTIONS=$checks nice -n "${SUNDER_FUZZ_NICE:-19}" "$SUNDER_BUILD/fuzz/$name" "$state/$name" \
        -seed="$(($(date +%s) + $$))" -max_total_time="$2" -max_len=600 "${schedule[@]}" -timeout=600 -rss_limit_mb=4096 \
        -artifact_prefix="$state/found/$name-" -print_final_stats=1 >"$log" 2>&1 || status=$?
        echo "$status" >"$log.status"; } 2>&1 )
    executions=$(final number_of_executed_units "$log")
    status=$(cat "$log.status")
    rm "$log.status"
    if [ "$status" -eq 0 ] && [ "${executions:-0}" -le $((inputs + 1)) ]; then
        echo "$name: the $inputs known inputs took all of the $2 s, and no new one was tried; such a piece does not count, use longer pieces"
        return 0
    fi
    spent=$(awk '{ print $1 + $2 }' <<<"$spent")
    echo "$name ${executions:-0} $spent $(covered "$log") $(cat "$SUNDER_BUILD/fuzz/built_of")" | tee -a "$state/tally"
    [ "$status" -eq 0 ] || { echo "$name failed: see $log"; return 1; }
    rm "$log"
}

done_with() { # NAME: are the executions or the hours reached?
    awk -v name="$1" -v quick=$quick -v most=$executions_wanted -v hours=$hours_wanted "$tally"'
        $1 == name { take() }
        END { exit !(s > 0 && (pace() > quick ? n >= most : s >= 3600 * hours)) }' "$state/tally" 2>/dev/null
}

keep() {
    local name smaller
    mkdir -p "$here/corpus"
    [ $# -gt 0 ] || set -- $(targets)
    for name in "$@"; do
        [ -d "$state/$name" ] || continue
        smaller=$state/$name.smaller
        rm -rf "$smaller"
        mkdir "$smaller"
        nice -n "${SUNDER_FUZZ_NICE:-19}" "$SUNDER_BUILD/fuzz/$name" -merge=1 -max_len=600 -rss_limit_mb=4096 "$smaller" "$state/$name" >"$state/$name.merge" 2>&1
        tar --sort=name --mtime=@0 --owner=0 --group=0 --numeric-owner -C "$smaller" -cf - . | gzip -9n >"$here/corpus/$name.tar.gz"
        echo "$name: $(find "$smaller" -type f | wc -l) of $(find "$state/$name" -type f | wc -l) inputs, $(wc -c <"$here/corpus/$name.tar.gz") bytes"
        rm -rf "${state:?}/$name"
        mv "$smaller" "$state/$name"
    done
}

record() {
    {
        echo "# Fuzzing on record"
        echo
        echo "Written by \`bash tests/fuzz/pieces.sh --record\` on $(date +%F): all pieces of this state, on $(sed -n 's/^model name.*: //p' /proc/cpuinfo | head -n 1), with $(clang --version | head -n 1)."
        echo "Wanted: ten million executions of a target that makes more than $quick of them in a second of a core, eight hours of a core for the others; the speed is that of the latest quarter of an hour of pieces, or a little more."
        echo "Edges are of the code that is built with the sanitizers, which is more than a target can come to: the whole library, of the program the folders of the readers."
        echo
        echo "| target | executions | hours of a core | in a second | edges covered, of | inputs kept | commits | wanted |"
        echo "|---|---|---|---|---|---|---|---|"
        for name in $(targets); do
            awk -v name="$name" -v quick=$quick -v most=$executions_wanted -v hours=$hours_wanted \
                -v inputs="$(tar -tzf "$here/corpus/$name.tar.gz" 2>/dev/null | grep -vc '/$')" "$tally"'
                $1 == name { take(); run = $4; all = $5; of = split($6, commit, ",")
                    for (c = 1; c <= of; ++c) if (!(commit[c] in seen)) { seen[commit[c]]; commits = commits (commits ? ", " : "") commit[c] } }
                END {
                    if (!s) exit
                    if (pace() > quick) wanted = n >= most ? "reached" : sprintf("%.0f %% of the executions", 100 * n / most)
                    else wanted = s >= 3600 * hours ? "reached" : sprintf("%.0f %% of the hours", 100 * s / 3600 / hours)
                    printf "| `%s` | %d | %.3f | %d | %d of %d | %d | %s | %s |\n", name, n, s / 3600, pace(), run, all, inputs, commits, wanted
                }' "$state/tally"
        done
    } >"$here/RECORD.md"
    cat "$here/RECORD.md"
}

begin_tally
case ${1:-} in
--keep)
    shift
    keep "$@"
    ;;
--record) record ;;
[0-9]*)
    seconds=$1
    shift
    [ -n "${SUNDER_FUZZ_AS_BUILT:-}" ] || build
    [ $# -gt 0 ] || set -- $(targets)
    status=0
    for name in "$@"; do
        if done_with "$name"; then echo "$name is done"; else piece "$name" "$seconds" || status=1; fi
    done
    exit $status
    ;;
*)
    sed -n '2,/^set/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
    exit 2
    ;;
esac
