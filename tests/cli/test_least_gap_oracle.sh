# shellcheck shell=bash disable=SC1091
# Compares --least-gap with an independent program that solves fronts of houses between roads (least_gap_oracle.py).
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }

seed=${SUNDER_SEED:-1} layers=2
[ "${SUNDER_LAWS:-}" = all ] && layers=100
echo "seed $seed"
python3 "$SUNDER_SOURCE/tests/cli/least_gap_oracle.py" "$SUNDER" "$seed" "$layers" || trouble=1
finish
