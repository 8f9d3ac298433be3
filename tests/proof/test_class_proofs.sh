# shellcheck shell=bash disable=SC1091
# Proofs with gaps by classes: those about generated layers and sheets are checked, and whatever a file says wrongly of classes and their
# gaps is refused (class_proofs.py). Eight layers or more, by seed (SUNDER_SEED); 1,000 of them, made with more effort, with SUNDER_LAWS=all.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
seed=${SUNDER_SEED:-1} layers=8 effort=0.1
[ "${SUNDER_LAWS:-}" = all ] && layers=1000 effort=1
python3 "$SUNDER_SOURCE/tests/proof/class_proofs.py" "$SUNDER" "$seed" "$layers" "$effort" >said 2>&1 || fail "seed $seed: $(cat said)"
tail -1 said
finish
