# shellcheck shell=bash disable=SC1091
# --proof with --enlarge: the checker verifies that the features are larger that are below the least size, and as large
# as that (enlarging.py); bounds, verdicts and clauses are about the larger shapes. It refuses false statements about
# them (larger_mutations.py).
. "$SUNDER_SOURCE/tests/proof/room_runs.sh" || exit 1

# proved FILE LARGER OPTIONS...: the checker accepts the proof of this run, which makes LARGER features larger
proved() {
    local source=$1 larger=$2
    shift 2
    checked "$source" "$@"
    [ "$(grep -c '^{"larger"' p.jsonl)" = "$larger" ] || fail "$source $*: $(grep -c '^{"larger"' p.jsonl) larger, and not $larger"
    cat said
}

make_sheds
rules=(--gap 3 --max-shift 3 --enlarge --min-size 10 --barrier lanes_by.gpkg,width-field=w)
proved sheds.gpkg 8 "${rules[@]}"
untrue sheds.gpkg 'feature not larger;member not larger;feature made too large;feature made too small;feature stretched in one direction;larger feature moved;larger feature with a tip;another feature larger;part not larger;larger feature twice;larger shape of nothing;larger shape that crosses itself;larger features unknown' "${rules[@]}"
proved sheds.gpkg 8 "${rules[@]}" --rows no --ease no --no-blocks
proved sheds.gpkg 6 "${rules[@]}" --rigid-where 'fid = 2' --weight area --contained ignore --ignore-where 'class = 2 AND fid > 8'
proved sheds.gpkg 8 "${rules[@]}" --hide --trim --trim-keep 0.3 --inset 0.5 --symbol-size 10 --crossed trim
proved sheds.gpkg 8 "${rules[@]}" --hide --trim --barrier lanes_through.gpkg --rows no
grep -q '"kept"' p.jsonl || fail "no feature is crossed, and kept"

# Small worlds: blocks that overlap, triangles, wings.
for seed in 3 6 12 18 27 33 51 66; do
    mapfile -t words < <(python3 "$here/small_worlds.py" "$seed")
    layer "world$seed.gpkg" buildings POLYGON <"$seed.csv"
    checked "world$seed.gpkg" --rows no --ease no "${words[@]}" --enlarge --min-size $((seed % 7 + 2)) --hide
    grep -c '^{"larger"' p.jsonl >>counts
done
[ "$(awk '{ n += $1 } END { print n }' counts)" -gt 12 ] || fail "few features grow in small worlds: $(cat counts)"
finish
