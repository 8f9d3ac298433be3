# shellcheck shell=bash disable=SC1091
# Compares --rows with an independent program that finds rows by the same rule (rows_oracle.py), on random towns.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }

seed=${SUNDER_SEED:-1} layers=8
[ "${SUNDER_LAWS:-}" = all ] && layers=200
echo "seed $seed"
python3 "$SUNDER_SOURCE/tests/cli/rows_oracle.py" "$SUNDER" "$seed" "$layers" || trouble=1
finish
