# shellcheck shell=bash disable=SC1091
# A layer on a cluster: gis/cluster/slurm.sh on a private Slurm with two nodes. While shards are processed, one node is
# lost as in a power failure, and one shard is killed: the final output is that of one process, byte by byte, and so are
# its statistics. A second start runs the missing steps and no others.
#
# SUNDER_CLUSTER_BUILDINGS and _SHARDS make it larger (RECORD.md); SUNDER_SEED draws when the shard is killed.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
. "$SUNDER_SOURCE/tests/cluster/slurm_of_own.sh"
slurm_wants >missing || { echo "skipped: $(cat missing)"; exit 77; }
command -v jq >/dev/null || { echo "skipped: jq is not installed"; exit 77; }
trap 'slurm_end; chmod -R u+rwx "$work"; rm -rf "$work"' EXIT
slurm_begin "$work/slurm" >said 2>&1 || { cat said; echo "skipped: Slurm does not start here"; exit 77; }
export SOURCE_DATE_EPOCH=1700000000 SUNDER_POLL=1
shards=${SUNDER_CLUSTER_SHARDS:-16} seed=${SUNDER_SEED:-$RANDOM}
echo "seed $seed: SUNDER_SEED=$seed replays it"

mkdir "a room" "a room/whole" "a room/nodes"
town="a room/a town.gpkg"
"$SUNDER_BUILD/sunder-town" --buildings "${SUNDER_CLUSTER_BUILDINGS:-20000}" --seed 3 "$town" >/dev/null || fail "no town is made"
words=(--input-layer buildings --gap 2m --max-shift 10m --where "height > 1 or name is null" --quiet
    --barrier "$town,layer=roads,width-field=width,gap=1m")
wanted=0
/usr/bin/time -o whole.time -f 'one process: %U + %S s, %M kB' \
    "$SUNDER" separate "${words[@]}" --stats "a room/whole.json" "$town" "a room/whole/o.gpkg" || wanted=$?
cat whole.time 2>/dev/null

# The program as the nodes run it: the third shard is killed in its first run, at a random moment. When a quarter of the
# shards are done, shards that n2 has begun do not end before n2 is lost.
cat >"a room/slow sunder" <<EOF
#!/usr/bin/env bash
if [ "\$1" = separate ]; then
    sleep "\${SLOW:-1}"
    if [ "\$3" = 3 ] && mkdir '$work/killed' 2>/dev/null; then
        '$SUNDER' "\$@" &
        sleep 0.$((seed % 3))$((seed / 3 % 10))
        kill -KILL \$!
        wait \$!
        exit \$?
    fi
    if [ "\$SLURMD_NODENAME" = n2 ] && [ ! -e '$work/dead' ] &&
        [ "\$(ls "\$6" | grep -c '^shard-[0-9]*\$')" -ge $((shards / 4)) ]; then
        touch '$work/dying'
        sleep 300
    fi
fi
exec '$SUNDER' "\$@"
EOF
chmod +x "a room/slow sunder"
on_nodes() {
    SUNDER="a room/slow sunder" bash "$SUNDER_SOURCE/gis/cluster/slurm.sh" --wait "$town" "a room/nodes/o.gpkg" "$shards" \
        -- "${words[@]}" --stats "a room/nodes.json"
}
plan="a room/nodes/o.gpkg.plan"
there() { compgen -G "$plan/shard-*" | grep -c 'shard-[0-9]*$'; }

on_nodes >said 2>&1 &
waits=$!
for _ in $(seq 600); do
    [ ! -e dying ] || break
    kill -0 $waits 2>/dev/null || break
    sleep 0.2
done
before=$(there)
[ "$before" -lt "$shards" ] || fail "there was nothing left to do for a node to die of"
touch dead
slurm_kill_node n2
status=0
wait $waits || status=$?
same "$status" "$wanted" "status of the merge"
[ "$trouble" = 0 ] || { cat said; tail -n 3 "$plan.log"/*.out; }
echo "of $shards shards $before were done when n2 was lost; again: $(grep -lE ', again \(' "$plan.log"/shard-*.out | wc -l);" \
    "killed and done once more: $(grep -l 'once more' "$plan.log"/shard-*.out | wc -l)"
grep -qE ', again \(' "$plan.log"/shard-*.out || fail "no shard of the lost node was run again"
[ -d "$work/killed" ] || fail "no shard was killed"

as_one_process() { # description of the case
    cmp "a room/whole/o.gpkg" "a room/nodes/o.gpkg" || fail "$1: the output differs"
    same "$(jq -c 'del(.seconds, .peak_rss_bytes)' "a room/nodes.json")" \
        "$(jq -c 'del(.seconds, .peak_rss_bytes)' "a room/whole.json")" "$1: figures"
}
as_one_process "a node and a shard killed"

# If a shard fails, the merge does not run, and the message says what to do. Then the same command runs the missing
# steps.
slurm_node n2
rm "a room/nodes/o.gpkg" "$plan/shard-2" "$plan/shard-5"
stamp=$(stat -c %Y.%i "$plan/shard-1")
mkdir "$plan/no" && mv "$plan/features" "$plan/no/"
status=0
SLOW=0 on_nodes >said 2>&1 || status=$?
{ [ "$status" = 1 ] && grep -q "same command" said; } || fail "status $status of what cannot be done: $(tail -n 4 said)"
[ ! -e "a room/nodes/o.gpkg" ] || fail "an output of two shards less"
mv "$plan/no/features" "$plan/" && rmdir "$plan/no"
rm -f "$plan.log"/shard-*.out
status=0
SLOW=0 on_nodes >said 2>&1 || status=$?
same "$status" "$wanted" "status of the second start"
as_one_process "begun again"
same "$(stat -c %Y.%i "$plan/shard-1")" "$stamp" "shard 1 was there:"
same "$(cd "$plan.log" && echo shard-*.out)" "shard-2.out shard-5.out" "worked on the second time:"
same "$(find "$plan" -name '*part*' -o -name '.*' ! -name . | wc -l)" 0 "left in the plan:"
finish
