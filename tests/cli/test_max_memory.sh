# shellcheck shell=bash disable=SC1091
# A layer separated in parts, for want of memory, is written as one that is held whole: the same bytes in every format,
# the same figures. What it puts on the disk goes, whatever becomes of the run.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
export SOURCE_DATE_EPOCH=1700000000
mkdir scratch
export TMPDIR=$work/scratch

"$SUNDER_BUILD/sunder-town" --buildings 6000 --seed 5 town.gpkg >/dev/null || fail "no town is made"
# Blocks of two whose houses are streets apart, too.
ogr2ogr -q numbered.gpkg town.gpkg -nln buildings -dialect SQLite \
    -sql "select *, case when fid % 60 < 2 then fid / 60 when fid % 97 = 1 then 1000 + fid / 970 end as blk from buildings" &&
    mv numbered.gpkg town.gpkg || fail "blocks are not numbered"

# alike OUTPUT MEMORY ARGS: with and without --max-memory
alike() {
    local output=$1 memory=$2 first second
    shift 2
    rm -rf whole parts
    mkdir whole parts
    run separate town.gpkg "whole/$output" -l buildings "$@" --stats whole.json -q
    first=$status
    run separate town.gpkg "parts/$output" -l buildings "$@" --stats parts.json -q --max-memory "$memory"
    second=$status
    same "$second" "$first" "$output in parts: status"
    diff -rq whole parts || fail "$output of $* in parts is another"
    same "$(jq -c 'del(.seconds, .peak_rss_bytes)' parts.json)" "$(jq -c 'del(.seconds, .peak_rss_bytes)' whole.json)" \
        "figures of $output in parts"
    same "$(ls -A scratch)" '' "left in the scratch directory:"
}

alike o.gpkg 99M --gap 3 --effort 0 --max-shift 2
alike o.gpkg 98.5M --gap 3 --effort 0.05
alike o.gpkg 98M --gap 4 --effort 0 --no-blocks --allow-jumps --id-field id
alike o.gpkg 98.5M --gap 0.5 --effort 0 --weight sqrt-area --fixed-where 'fid % 9 = 0' --ignore-where 'fid % 11 = 0'
alike o.shp 99M --gap 3 --effort 0
alike o.gpkg 98.5M --gap 3 --effort 0 --block-field blk
alike o.geojson 99M --gap 3 --effort 0 --layers main,conflicts
alike o.fgb 2G --gap 3 --effort 0

# What is not done in parts, and too little memory.
for words in '--barrier town.gpkg,layer=buildings' '--report r.html' '--proof p.txt'; do
    # shellcheck disable=SC2086
    refused 2 "in parts with ${words%% *}" separate town.gpkg o.gpkg -l buildings --max-memory 1G $words
done
refused 1 'need' separate town.gpkg o.gpkg -l buildings --gap 3 --max-memory 20M
same "$(ls -A scratch)" '' "left of what was refused:"
TMPDIR=$work/nowhere refused 1 'cannot be made' separate town.gpkg o.gpkg -l buildings --max-memory 1G

for delay in 0.02 0.05 0.1 0.2; do
    "$SUNDER" separate town.gpkg o.gpkg -l buildings --gap 3 --effort 0 --max-memory 98.5M >out 2>err &
    process=$!
    sleep $delay
    kill -TERM $process 2>/dev/null
    wait $process
    same "$(ls -A scratch)" '' "left by a run that was ended after $delay s:"
    rm -f o.gpkg
done
finish
