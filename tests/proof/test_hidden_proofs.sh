# shellcheck shell=bash disable=SC1091
# --proof with --hide: the checker proves each clause and the bound of what is hidden again, for houses between walls, on
# a road, in a block and in rows; and it refuses every false statement about them (hide_mutations.py).
. "$SUNDER_SOURCE/tests/proof/room_runs.sh" || exit 1

# proved FILE WORDS OPTIONS...: the checker accepts the proof of this run, and says these words
proved() {
    local source=$1 words=$2
    shift 2
    checked "$source" "$@"
    grep -qF "$words" said || fail "$source $*: $(tail -1 said)"
    grep -o 'hidden [^;]*' said
}

make_hidden
kept=(--gap 0.5 --max-shift 3 --no-blocks --block-field k --contained separate --hide --barrier walls.gpkg)
hidden=("${kept[@]}" --crossed hide)
proved hidden.gpkg 'hidden 5, 6 clauses with proofs' "${hidden[@]}" --rows no --ease no --hide-weight area --hierarchy-field class
untrue hidden.gpkg clause "${hidden[@]}" --rows no --ease no --hide-weight area --hierarchy-field class
cut -c 1-70 kinds
[ "$(cut -d ' ' -f 1 kinds)" = 22 ] || fail "kinds of untruth are missing: $(cat kinds)"
proved hidden.gpkg 'hidden 5' "${hidden[@]}" --hide-weight 1

# A house that a line crosses is kept, and so are three that a footway crosses, except the one for which there is no room.
proved hidden.gpkg 'hidden 3, 4 clauses with proofs' "${kept[@]}" --rows no --ease no --hide-weight 1
printf 'WKT,w\n"LINESTRING(-8 3,36 3)",1\n' | layer footway.gpkg footway LINESTRING
proved hidden.gpkg 'hidden 3, 4 clauses with proofs' "${kept[@]}" --rows no --hide-weight 1 --barrier footway.gpkg,width=1,gap=2
python3 "$here/check_proof.py" p.jsonl hidden.gpkg --layer buildings --result o.gpkg "${hidden[@]}" --rows no --hide-weight 1 \
    --barrier footway.gpkg,width=1,gap=2 >said 2>&1
[ $? = 1 ] && grep -q 'may not overlap' said || fail "kept, where that is not allowed: $(cat said)"

# A row of ten houses with room for seven, whose ends are fixed: with the rule of rows, and with prices.
python3 -c '
print("WKT,w")
for k in range(10):
    print(f"\"POLYGON(({10.5 * k} 0,{10.5 * k + 10} 0,{10.5 * k + 10} {10 + k % 3 / 4},{10.5 * k} {10 + k % 3 / 4}))\",{1 + (k in (0, 9))}")' |
    layer street.gpkg buildings POLYGON
proved street.gpkg 'clauses with proofs' --gap 4 --max-shift 12 --fixed-where 'w = 2' --hide
grep -q '"clause".*"row": true' p.jsonl || fail "no clause of the row names its rule"

# The proof of another run, or without --hide, is refused.
for words in '--hide --hide-weight 1' ''; do
    python3 "$here/check_proof.py" p.jsonl street.gpkg --layer buildings --gap 4 --max-shift 12 --fixed-where 'w = 2' $words >said 2>&1
    [ $? = 1 ] && grep -q '^refused: ' said || fail "accepted with '$words': $(cat said)"
done
finish
