# shellcheck shell=bash disable=SC2154
# For tests of a layer that is separated in parts, after lib.sh: a town whose houses have blocks, and a comparison of
# the whole layer and the parts.
export SOURCE_DATE_EPOCH=1700000000
mkdir scratch
export TMPDIR=$work/scratch

"$SUNDER_BUILD/sunder-town" --buildings 6000 --seed 5 town.gpkg >/dev/null || fail "no town is made"
# Adds blocks of two houses. In some blocks the two houses are several streets apart.
ogr2ogr -q numbered.gpkg town.gpkg -nln buildings -dialect SQLite \
    -sql "select *, case when fid % 60 < 2 then fid / 60 when fid % 97 = 1 then 1000 + fid / 970 end as blk from buildings" &&
    mv numbered.gpkg town.gpkg || fail "blocks are not numbered"

# alike OUTPUT MEMORY ARGS: compares runs with and without --max-memory
page=() proof=(--proof at/proof.jsonl)
alike() {
    local output=$1 memory=$2 first second
    shift 2
    rm -rf whole parts at
    mkdir at
    run separate town.gpkg "at/$output" -l buildings "$@" --stats whole.json -q "${proof[@]}" "${page[@]}"
    first=$status
    mv at whole
    mkdir at
    run separate town.gpkg "at/$output" -l buildings "$@" --stats parts.json -q "${proof[@]}" \
        "${page[@]}" --max-memory "$memory"
    second=$status
    mv at parts
    same "$second" "$first" "$output in parts: status"
    diff -rq whole parts || fail "$output of $* differs in parts"
    same "$(jq -c 'del(.seconds, .peak_rss_bytes)' parts.json)" "$(jq -c 'del(.seconds, .peak_rss_bytes)' whole.json)" \
        "figures of $output in parts"
    same "$(ls -A scratch)" '' "left in the scratch directory:"
}

# The same with --report, which takes some memory.
drawn() {
    page=(--report at/page.html)
    alike "$@"
    page=()
}
