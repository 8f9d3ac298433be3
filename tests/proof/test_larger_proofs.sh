# shellcheck shell=bash disable=SC1091
# --proof with --enlarge: the checker verifies that the features are larger that are below the least size, and as large
# as that (enlarging.py); bounds, verdicts and clauses are about the larger shapes. It refuses false statements about
# them (larger_mutations.py).
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
here=$SUNDER_SOURCE/tests/proof
. "$here/layers.sh"

# proved FILE LARGER OPTIONS...: the checker accepts the proof of this run, which makes so many features larger
proved() {
    local source=$1 larger=$2
    shift 2
    "$SUNDER" separate "$source" o.gpkg --overwrite -q -l buildings --layers main,displacement,conflicts --proof p.jsonl "$@" 2>err
    case $? in 0 | 3) ;; *) fail "$source: status $?: $(cat err)" ;; esac
    [ "$(grep -c '^{"larger"' p.jsonl)" = "$larger" ] || fail "$source $*: $(grep -c '^{"larger"' p.jsonl) larger, and not $larger"
    python3 "$here/check_proof.py" p.jsonl "$source" --layer buildings --result o.gpkg "$@" >said 2>&1 || fail "$source $*: $(tail -1 said)"
    cat said
}

# untrue KINDS OPTIONS...: changes the last run's proof; the checker refuses each change, and the KINDS are among them
untrue() {
    local kind kinds=$1
    shift
    python3 "$here/mutations.py" p.jsonl "$source" --layer buildings --result o.gpkg "$@" >said 2>kinds || fail "$(cat said)"
    while read -r kind; do grep -qF "$kind" kinds || fail "no $kind: $(cat kinds)"; done <<<"${kinds//;/$'\n'}"
}

make_sheds
source=sheds.gpkg
rules=(--gap 3 --max-shift 3 --enlarge --min-size 10 --barrier lanes_by.gpkg,width-field=w)
proved sheds.gpkg 8 "${rules[@]}"
untrue 'feature not larger;member not larger;feature made too large;feature made too small;feature stretched in one direction;larger feature moved;larger feature with a tip;another feature larger;part not larger;larger feature twice;larger shape of nothing;larger shape that crosses itself;larger features unknown' "${rules[@]}"
proved sheds.gpkg 8 "${rules[@]}" --rows no --ease no --no-blocks
proved sheds.gpkg 6 "${rules[@]}" --rigid-where 'fid = 2' --weight area --contained ignore --ignore-where 'class = 2 AND fid > 8'
proved sheds.gpkg 8 "${rules[@]}" --hide --trim --trim-keep 0.3 --inset 0.5 --symbol-size 10 --crossed trim
proved sheds.gpkg 8 "${rules[@]}" --hide --trim --barrier lanes_through.gpkg --rows no
grep -q '"kept"' p.jsonl || fail "no feature is crossed, and kept"

# Small worlds: blocks that overlap, triangles, wings.
for seed in 3 6 12 18 27 33 51 66; do
    mapfile -t words < <(python3 "$here/small_worlds.py" "$seed")
    layer "world$seed.gpkg" buildings POLYGON <"$seed.csv"
    "$SUNDER" separate "world$seed.gpkg" o.gpkg --overwrite -q -l buildings --layers main,displacement,conflicts --proof p.jsonl --rows no --ease no \
        "${words[@]}" --enlarge --min-size $((seed % 7 + 2)) --hide 2>err
    case $? in 0 | 3) ;; *) fail "world $seed: status $?" ;; esac
    python3 "$here/check_proof.py" p.jsonl "world$seed.gpkg" -l buildings --result o.gpkg --rows no --ease no "${words[@]}" \
        --enlarge --min-size $((seed % 7 + 2)) --hide >said 2>&1 || fail "world $seed: $(tail -1 said)"
    grep -c '^{"larger"' p.jsonl
done >counts
[ "$(awk '{ n += $1 } END { print n }' counts)" -gt 12 ] || fail "few features grow in small worlds: $(cat counts)"
finish
