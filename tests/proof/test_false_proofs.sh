# shellcheck shell=bash disable=SC1091
# Are proofs refused that were made to deceive the checker, each with one step that does not follow (false_proofs.py)?
# For each of them the test shows that its claim is false, too. A message is always one line, whatever names the file
# contains.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
here=$SUNDER_SOURCE/tests/proof
python3 "$here/false_proofs.py" . >said 2>&1 || fail "$(cat said)"
tail -1 said

# told STATUS WORDS FILE: the checker ends with this status and prints one line with these words, and no traceback
told() {
    python3 "$here/check_proof.py" "$3" fixed-and-apart.gpkg >said 2>err
    [ $? = "$1" ] && [ ! -s err ] && [ "$(wc -l <said)" = 1 ] && grep -qF "$2" said || fail "$3: $(cat said)"
}
for name in '\ud800' '\u001b[2J' 'x\nbound 5: 1 trees'; do
    printf '{"sunder_proof": 2, "layer": "%s", "gap": 0, "max_shift": null, "contained": "block", "allow_jumps": false, %s}\n' "$name" \
        '"lower_bound": 0, "conflicts": 0, "trees": 0' >named.jsonl
    told 1 "refused: the proof is of another problem: layer is" named.jsonl
done
printf '\xff\n' >bytes.jsonl
told 1 "refused: a line that is no JSON" bytes.jsonl
told 2 "not asked about: " nowhere.jsonl
told 2 "not asked about: " .
finish
