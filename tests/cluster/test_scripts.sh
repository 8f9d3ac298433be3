# shellcheck shell=bash disable=SC1091
# Tests gis/cluster/parallel.sh and make.sh: the output is that of one process, also with blanks in names; a killed
# shard is run once more, and a second call runs the missing steps; other hosts are called by name. Wrong arguments are
# refused, and shellcheck has no complaints about the scripts.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
export SOURCE_DATE_EPOCH=1700000000
scripts=$SUNDER_SOURCE/gis/cluster
mkdir "a room" whole
town="a room/a town.gpkg"
"$SUNDER_BUILD/sunder-town" --buildings 600 --seed 3 "$town" >/dev/null || fail "no town is made"
words=(--input-layer buildings --gap 2m --max-shift 10m --where "height > 1 or name is null" --quiet)
wanted=0
"$SUNDER" separate "${words[@]}" "$town" whole/o.gpkg 2>err || wanted=$?

with() { # script, its arguments before --
    local script=$1 status=0
    shift
    rm -f "a room/o.gpkg"
    SUNDER=$program bash "$scripts/$script" "$@" "$town" "a room/o.gpkg" 5 -- "${words[@]}" >said 2>&1 || status=$?
    same "$status" "$wanted" "$script $*: status"
    [ "$trouble" = 0 ] || tail -n 5 said
    cmp whole/o.gpkg "a room/o.gpkg" || fail "$script $*: the output differs"
}
anew() { rm -rf "a room/o.gpkg.plan" "a room/o.gpkg.plan.log" killed; }

# Kills shard 2 once, at its start.
cat >"a room/killer" <<EOF
#!/usr/bin/env bash
if [ "\$1 \$3" = "separate 2" ] && mkdir '$work/killed' 2>/dev/null; then kill -KILL \$\$; fi
if [ "\$1" = separate ]; then echo "\$3" >>'$work/asked'; fi
exec '$SUNDER' "\$@"
EOF
chmod +x "a room/killer"

ways=()
if command -v make >/dev/null; then ways+=(make.sh); fi
if command -v parallel >/dev/null; then ways+=(parallel.sh); fi
[ ${#ways[@]} -gt 0 ] || { echo "skipped: neither make nor parallel is installed"; exit 77; }
for way in "${ways[@]}"; do
    anew
    program=$SUNDER
    with "$way" --jobs 2
    rm "a room/o.gpkg.plan/shard-4"
    program="a room/killer"
    : >asked
    with "$way" --jobs 2
    same "$(wc -l <asked)" 1 "$way, shards worked on the second time:"
    # A killed shard: parallel.sh and slurm.sh run it again by themselves; make.sh prints the command to be given again,
    # which is the same.
    anew
    status=0
    SUNDER="a room/killer" bash "$scripts/$way" "$town" "a room/other.gpkg" 5 -- "${words[@]}" >said 2>&1 || status=$?
    if [ "$way" = make.sh ]; then
        { [ "$status" = 1 ] && grep -q 'shards 2 are missing' said && grep -q 'same command' said; } || fail "$way: $(cat said)"
        status=0
        SUNDER="a room/killer" bash "$scripts/$way" "$town" "a room/other.gpkg" 5 -- "${words[@]}" >said 2>&1 || status=$?
    fi
    same "$status" "$wanted" "$way with a killed shard: status"
    [ -d killed ] || fail "nothing was killed"
    [ -e "a room/other.gpkg" ] || fail "$way with a killed shard: no output"
    rm -rf "a room"/other*
done

# Two names of this host, through an ssh that records the name that it was called with. Like sshd it sets SHELL:
# parallel's worker starts its command by $SHELL, and a service that runs tests may not have one.
if command -v parallel >/dev/null; then
    cat >ssh <<EOF
#!/usr/bin/env bash
[ "\$1" != -- ] || shift
echo "\$1" >>'$work/hosts'
shift
[ "\$1" != -- ] || shift
exec env SHELL=/bin/sh bash -c "\$*"
EOF
    chmod +x ssh
    anew
    program=$SUNDER
    PARALLEL_SSH=$work/ssh with parallel.sh --host 1/one --host 1/two
    same "$(sort -u hosts | tr '\n' ' ')" "one two " "hosts that were called"
fi

status=0
for wrong in '--nothing' '--jobs' 'a b' 'a b 0' 'a b x' 'a b 3 --gap 2'; do
    for way in make.sh parallel.sh slurm.sh; do
        status=0
        # shellcheck disable=SC2086 # words
        bash "$scripts/$way" $wrong >said 2>&1 || status=$?
        { [ "$status" = 2 ] || { [ "$status" = 1 ] && ! command -v parallel >/dev/null; }; } || fail "$way $wrong: status $status"
    done
done
status=0
SUNDER="$work/nowhere" bash "$scripts/make.sh" a b 3 >said 2>&1 || status=$?
{ [ "$status" = 1 ] && grep -q 'SUNDER=' said; } || fail "a program that is not there: $(cat said)"
if command -v shellcheck >/dev/null; then
    (cd "$scripts" && shellcheck -x ./*.sh) || fail "shellcheck"
fi
finish
