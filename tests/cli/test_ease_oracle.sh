# shellcheck shell=bash disable=SC1091
# Compares --ease with an independent program that solves fronts of houses between roads (ease_oracle.py), and its lower
# bound with layouts that another one finds (ease_bounds.py).
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }

# bounds: layers, worlds in each, steps of descent, --effort
seed=${SUNDER_SEED:-1} layers=2 bounds=(3 34 20 0.1)
[ "${SUNDER_LAWS:-}" = all ] && layers=100 bounds=(50 200 25 0.1)
echo "seed $seed"
python3 "$SUNDER_SOURCE/tests/cli/ease_oracle.py" "$SUNDER" "$seed" "$layers" || trouble=1
python3 "$SUNDER_SOURCE/tests/cli/ease_bounds.py" "$SUNDER" "$seed" "${bounds[@]}" || trouble=1
finish
