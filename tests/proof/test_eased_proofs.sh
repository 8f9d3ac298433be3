# shellcheck shell=bash disable=SC1091
# Proofs with the prices of eased pairs: those about generated layers are checked, and whatever a file says wrongly of prices is refused
# (eased_proofs.py). Four files with cuts by prices, by seed (SUNDER_SEED); 1,000 of them, made with the default
# effort, with SUNDER_LAWS=all.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
seed=${SUNDER_SEED:-1} proofs=4 effort=0.1
[ "${SUNDER_LAWS:-}" = all ] && proofs=1000 effort=1
python3 "$SUNDER_SOURCE/tests/proof/eased_proofs.py" "$SUNDER" "$seed" "$proofs" "$effort" >said 2>&1 || fail "seed $seed: $(cat said)"
tail -1 said
finish
