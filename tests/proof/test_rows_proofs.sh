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
finish
