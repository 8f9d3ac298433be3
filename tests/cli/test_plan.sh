# shellcheck shell=bash disable=SC1091
# A layer that is cut into shards and merged gives the same bytes and statistics as one process. This holds for every
# number of shards, in any order, if shards are repeated, and if steps are killed before they end.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
export SOURCE_DATE_EPOCH=1700000000

"$SUNDER_BUILD/sunder-town" --buildings 2000 --seed 5 town.gpkg >/dev/null || fail "no town is made"
call=(-l buildings --gap 3 --effort 0.02 --max-shift 6 --fixed-where 'fid % 50 = 0' --weight area --id-field id)
run separate town.gpkg whole.gpkg "${call[@]}" --stats whole.json -q
whole=$status
figures() { jq -c 'del(.seconds, .peak_rss_bytes)' "$1"; }

# merged PLAN: merges it and compares the result with that of one process.
merged() {
    rm -f merged.*
    run merge "$1" merged.gpkg --stats merged.json -q
    same "$status" "$whole" "$1: status of merge"
    cmp -s whole.gpkg merged.gpkg || fail "$1: the merged output differs"
    same "$(figures merged.json)" "$(figures whole.json)" "$1: figures"
}
shards() { # PLAN K...: runs these shards
    local plan=$1 k
    shift
    for k in "$@"; do expect 0 separate --shard "$k" "$plan" -q; done
}

# ---- Numbers of shards, and their order ----
for n in 1 2 7 64; do
    expect 0 plan town.gpkg "plan$n" "${call[@]}" --shards $n
    says out 'next: sunder separate --shard K'
    same "$(jq -c '[.shard_count, (.shards | length), .features, .version, ([.shards[].features] | add)]' "plan$n/plan.json")" \
        "[$n,$n,2000,\"$("$SUNDER" --version | sed -n 's/^sunder //p')\",2000]" "plan.json of $n shards"
    mapfile -t order < <(seq $n | sort -R --random-source=town.gpkg)
    shards "plan$n" "${order[@]}"
    merged "plan$n"
done
cp -r plan7 done7

# A shard has the same bytes if it is run twice, by two processes at the same time, or by a temporary path.
cksum plan7/shard-3 >before3
expect 0 separate --shard 3 plan7
says out 'was done already'
cksum plan7/shard-3 | cmp -s - before3 || fail "a shard that was done was done again"
rm plan7/shard-2
"$SUNDER" separate --shard 2 plan7 -q &
first=$!
"$SUNDER" separate --shard 2 plan7 -q &
wait $! || fail "the second of two at once: status $?"
wait $first || fail "the first of two at once: status $?"
merged plan7
expect 0 plan town.gpkg plan7 "${call[@]}" --shards 7
says out 'done already'
merged plan7

# ---- Killed processes ----
for delay in 0.03 0.1; do
    rm -rf killed
    "$SUNDER" plan town.gpkg killed "${call[@]}" --shards 3 -q 2>err &
    process=$!
    sleep $delay
    kill -9 $process 2>/dev/null
    wait $process 2>/dev/null
    expect 0 plan town.gpkg killed "${call[@]}" --shards 3 -q
    same "$(find . -maxdepth 1 -name '.killed.*')" '' "left of a plan that was killed after $delay s, when it was made again:"
    for k in 1 2 3; do
        "$SUNDER" separate --shard $k killed -q 2>err &
        process=$!
        sleep $delay
        kill -9 $process 2>/dev/null
        wait $process 2>/dev/null
    done
    shards killed 1 2 3
    rm -f merged.*
    "$SUNDER" merge killed merged.gpkg -q 2>err &
    process=$!
    sleep $delay
    kill -9 $process 2>/dev/null
    wait $process 2>/dev/null
    merged killed
    same "$(find killed -name '*.sunder-*')" '' "left in a plan whose steps were killed after $delay s, when all was done:"
done
# Temporary files of a killed process are removed. Those that a process still locks are kept, and so are files of other
# users.
mkdir -m 700 killed/parts.sunder-abcdef .held.sunder-abcdef
touch {killed/parts,.held}.sunder-abcdef/being-made~ killed/parts.sunder-abcdef/rows killed/shard-2.sunder-abcdef killed/shard-3.sunder-held12 killed/shard-3.backup .held.config
(flock -x 9 && exec sleep 60) 9<killed/shard-3.sunder-held12 &
holder=$!
(flock -x 9 && exec sleep 60) 9<.held.sunder-abcdef &
other=$!
while flock -n killed/shard-3.sunder-held12 true || flock -n .held.sunder-abcdef true; do sleep 0.01; done
merged killed
expect 0 plan town.gpkg held "${call[@]}" --shards 3 -q
same "$(find killed -name '*.*' ! -name plan.json | sort | tr '\n' ' ')" 'killed/shard-3.backup killed/shard-3.sunder-held12 ' \
    "who holds and who does not:"
[ -d .held.sunder-abcdef ] || fail "a plan that another process is making was removed"
[ -e .held.config ] || fail "a file of another user was removed"
kill $holder $other
wait $holder $other 2>/dev/null
rm -rf killed held .held.*
# A run that is ended by a signal leaves no files.
for delay in 0.02 0.06; do
    rm -rf asked
    "$SUNDER" plan town.gpkg asked "${call[@]}" --shards 3 -q 2>err &
    process=$!
    sleep $delay
    kill -TERM $process 2>/dev/null
    wait $process
    same "$(find . -maxdepth 1 -name '.asked*')" '' "left by a plan that was ended after $delay s:"
done

# ---- Shards that are missing, changed, or of another plan ----
rm plan7/shard-2 plan7/shard-4 plan7/shard-5
refused 1 'it has 7 shards, and these are missing: 2, 4-5' merge plan7 none.gpkg
shards plan7 2 4 5
merged plan7

# wrong N WORDS: shard N was damaged; merge reports it, and the shard can be made again.
wrong() {
    run merge plan7 none.gpkg
    same "$status" 1 "merge with $2"
    says err "it has 7 shards, and these are missing: $1;"
    says err "shard-$1"
    [ ! -e none.gpkg ] || fail "merged with $2"
    expect 0 separate --shard "$1" plan7
    says err 'it is made again'
    merged plan7
}
truncate -s -9 plan7/shard-1
wrong 1 'a shard that is cut off'
python3 - plan7/shard-6 <<'X'
import sys
bytes_of = bytearray(open(sys.argv[1], "rb").read())
bytes_of[len(bytes_of) // 2] ^= 1
open(sys.argv[1], "wb").write(bytes_of)
X
wrong 6 'a shard that was altered'
cp plan7/shard-1 plan7/shard-2
wrong 2 'a shard in the place of another'
cp plan64/shard-3 plan7/shard-3
wrong 3 'a shard of another plan'
expect 0 plan town.gpkg other7 "${call[@]/3/4}" --shards 7 -q
shards other7 5
cp other7/shard-5 plan7/shard-5
wrong 5 'a shard of other options'
: >plan7/shard-7
wrong 7 'a shard that is empty'

refused 1 'a plan of another command line' plan town.gpkg plan7 "${call[@]/3/4}" --shards 7
refused 1 'a plan of another command line' plan town.gpkg plan7 "${call[@]}" --shards 8
cp -r done7 old
python3 - old/plan <<'X'
import sys
bytes_of = bytearray(open(sys.argv[1], "rb").read())
bytes_of[8:12] = b"0.0."
open(sys.argv[1], "wb").write(bytes_of)
X
for words in 'separate --shard 1 old' 'merge old none.gpkg'; do
    # shellcheck disable=SC2086
    refused 1 'was made by sunder 0.0.' $words
done
cp -r done7 spoilt
printf 'X' | dd of=spoilt/plan bs=1 seek=60 conv=notrunc 2>/dev/null
refused 1 'spoilt/plan: it was altered' separate --shard 1 spoilt
rm -r spoilt
cp -r done7 spoilt
printf '\7' | dd of=spoilt/status bs=1 seek=60 conv=notrunc 2>/dev/null
refused 1 'spoilt/status: it was altered' merge spoilt none.gpkg
cp plan64/features plan64/cells spoilt
refused 1 'assigned to other shards' separate --shard 1 spoilt
mkdir empty
refused 1 'there is no plan in it' merge empty none.gpkg
refused 1 'there is no plan in it' plan town.gpkg empty "${call[@]}" --shards 2
refused 1 'no such directory' separate --shard 1 nowhere
refused 2 '1 to 7' separate --shard 8 plan7
refused 2 '1 to 7' separate --shard 0 plan7
refused 2 'takes one operand' separate --shard 1 plan7 out.gpkg
refused 2 'cannot be given with --shard' separate --shard 1 plan7 --gap 3
refused 2 'unknown option --gap' merge plan7 none.gpkg --gap 3
refused 2 '--shards N is missing' plan town.gpkg none "${call[@]}"
refused 2 '1 to' plan town.gpkg none "${call[@]}" --shards 0
refused 2 'unknown option --report' merge plan7 none.gpkg --report r.html
refused 2 'is none of main' plan town.gpkg none "${call[@]}" --shards 2 --layers mein

# ---- A changed input ----
cp town.gpkg changed.gpkg
expect 0 plan changed.gpkg changed "${call[@]}" --shards 2 -q
shards changed 1 2
cp town.gpkg changed.gpkg
ogrinfo -q changed.gpkg -sql 'update buildings set geom = (select geom from buildings where fid = 78) where fid = 77' >/dev/null
refused 1 'changed.gpkg: since the layer was read, features were changed' merge changed none.gpkg
ogrinfo -q changed.gpkg -sql 'delete from buildings where fid = 77' >/dev/null
refused 1 'it has 1999 features, and had 2000' merge changed none.gpkg
refused 1 'has changed since it was made' plan changed.gpkg changed "${call[@]}" --shards 2
refused 1 'no such file' plan nothing.gpkg none "${call[@]}" --shards 2
rm -rf changed changed.gpkg

# ---- From another directory; few features; none ----
mkdir elsewhere
expect 0 plan town.gpkg here "${call[@]}" --shards 2 -q
(cd elsewhere && for k in 2 1; do "$SUNDER" separate --shard $k ../here -q || exit; done) || fail "shards from elsewhere"
mv here elsewhere/there
(cd elsewhere && "$SUNDER" merge there merged.gpkg -q)
same $? "$whole" 'merge from elsewhere'
cmp -s whole.gpkg elsewhere/merged.gpkg || fail 'the output merged in another directory differs'

# ---- Barriers, which are read by the plan alone, from wherever it was called ----
cp town.gpkg roads.gpkg
call=(-l buildings --gap 2 --effort 0 --max-shift 5 --barrier roads.gpkg,layer=roads,width=5)
rm whole.*
run separate town.gpkg whole.gpkg "${call[@]}" --stats whole.json -q
whole=$status
expect 0 plan town.gpkg barred "${call[@]}" --shards 3 -q
rm roads.gpkg
shards barred 3 1 2
merged barred

layer few.gpkg houses POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,"POLYGON((3 0,7 0,7 4,3 4,3 0))"
X
layer none_at_all.gpkg houses POLYGON <<'X'
id,WKT
X
for name in few none_at_all; do
    call=(--gap 1)
    rm whole.*
    run separate $name.gpkg whole.gpkg "${call[@]}" --stats whole.json -q
    whole=$status
    rm -rf plan5
    expect 0 plan $name.gpkg plan5 "${call[@]}" --shards 5 -q
    shards plan5 5 4 3 2 1
    merged plan5
done
finish
