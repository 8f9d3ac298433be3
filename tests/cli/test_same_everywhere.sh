# shellcheck shell=bash disable=SC1091
# The output has the same bytes for every number of threads, and a run that is stopped leaves a complete output or none.
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

# A layer that is large enough to be read by two threads, with a few invalid features: the warnings are the same, in the
# same order, and so is the first feature that fails.
awk 'BEGIN {
    print "id,WKT"
    for (i = 1; i <= 12000; i++) {
        x = 20 * (i % 110); y = 20 * int(i / 110); r = i % 1501 ? 8 : 10
        crossed = i == 1000 || i == 5999 || i == 6001 || i == 11000
        printf "%d,\"POLYGON((%g %g,%g %g,%g %g,%g %g,%g %g))\"\n", i, x - r, y - r, x + r, crossed ? y + r : y - r,
            x + r, crossed ? y - r : y + r, x - r, y + r, x - r, y - r
    }
}' | layer large.gpkg large Polygon
ogr2ogr -q -sql "SELECT * FROM large UNION ALL SELECT 20000, NULL, NULL" null.gpkg large.gpkg -nln large -nlt Polygon 2>/dev/null
for input in large null; do
    for invalid in repair skip fail; do
        for threads in 1 2; do
            run separate $input.gpkg $threads.gpkg --gap 1 --effort 0 --invalid $invalid --threads $threads --overwrite
            printf '%s\n' "$status" >>err
            sed -E "s/ in [0-9.]+ m?s.*//; s/$threads\\.gpkg/OUT/g" err >$threads.err
            sed -E "s/$threads\\.gpkg/OUT/g; /[0-9] s/d" out >$threads.out
        done
        cmp -s 1.err 2.err || fail "$input, --invalid $invalid: two threads say something else"
        cmp -s 1.out 2.out || fail "$input, --invalid $invalid: two threads sum up something else"
        cmp -s 1.gpkg 2.gpkg || fail "$input, --invalid $invalid: the output differs"
    done
    grep -q 'FID 1000' 1.err || fail "$input: the first feature that fails is not named"
done

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
