# shellcheck shell=bash disable=SC1091
# The same bytes for every number of threads; and a run that is stopped leaves its output whole or not at all.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg
export SOURCE_DATE_EPOCH=1700000000
for threads in 1 2 5; do
    run separate "$town" $threads.gpkg -l buildings --gap 3 --max-shift 5 --threads $threads --stats $threads.json -q
    [ $status -eq 0 ] || [ $status -eq 3 ] || fail "$threads threads: status $status"
    run check $threads.gpkg -l buildings --gap 3 --threads $threads --list-inside
    mv out $threads.txt
    jq 'del(.seconds, .peak_rss_bytes)' $threads.json >$threads.same
done
for threads in 2 5; do
    cmp -s 1.gpkg $threads.gpkg || fail "the output differs with $threads threads"
    cmp -s 1.same $threads.same || fail "the figures differ with $threads threads"
    cmp -s 1.txt $threads.txt || fail "check differs with $threads threads"
done
[ "$(wc -l <1.txt)" -gt 10 ] || fail "check printed nothing to compare"

mkdir stopped
for delay in 0 0.005 0.01 0.02 0.03 0.05 0.08 0.12; do
    "$SUNDER" separate "$town" stopped/o.gpkg -l buildings --gap 3 >out 2>err &
    process=$!
    sleep $delay
    kill -TERM $process 2>/dev/null
    status=0
    wait $process || status=$?
    case $status in
    0 | 3) same "$(ls -A stopped)" o.gpkg "finished after $delay s:" ;;
    1) same "$(ls -A stopped)" '' "interrupted after $delay s:" ;;
    143) same "$(ls -A stopped)" '' "ended before it began, after $delay s:" ;;
    *) fail "status $status after $delay s" ;;
    esac
    rm -rf stopped/o.gpkg
done
finish
