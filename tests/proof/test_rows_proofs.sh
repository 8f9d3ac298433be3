# shellcheck shell=bash disable=SC1091
# Proofs with --rows auto and --rows FIELD: those about generated layers are checked, and whatever a file says wrongly of rows, of their
# rule or their springs is refused (rows_proofs.py). Five files that name rows, by seed (SUNDER_SEED); 1,000 of them with SUNDER_LAWS=all.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
seed=${SUNDER_SEED:-1} proofs=5
[ "${SUNDER_LAWS:-}" = all ] && proofs=1000
python3 "$SUNDER_SOURCE/tests/proof/rows_proofs.py" "$SUNDER" "$seed" "$proofs" >said 2>&1 || fail "seed $seed: $(cat said)"
tail -1 said

# A corner that is off a neighbour's wall by less than the margin of the rule.
printf 'WKT,w\n"POLYGON((0 0,10 0,0 10))",1\n"POLYGON((5.0000000001 5,9.5 0.6,15 15))",1\n"POLYGON((21 0,31 0,31 10,21 10))",1\n' |
    layer nearly.gpkg buildings POLYGON
expect 0 separate nearly.gpkg nearly.o.gpkg -q --gap 3 --no-blocks --rows auto --proof nearly.jsonl
python3 "$SUNDER_SOURCE/tests/proof/check_proof.py" nearly.jsonl nearly.gpkg --layer buildings --gap 3 --no-blocks --rows auto --result nearly.o.gpkg >said 2>&1 ||
    fail "a corner nearly on a wall: $(tail -n 1 said)"
finish
