# shellcheck shell=bash disable=SC1091
# A larger --row-stiffness never leaves rows more bent, and a larger --ease never leaves pairs more short (price_laws.py).
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }

seed=${SUNDER_SEED:-1} layers=6
[ "${SUNDER_LAWS:-}" = all ] && layers=500
echo "seed $seed"
python3 "$SUNDER_SOURCE/tests/cli/price_laws.py" "$SUNDER" "$seed" "$layers" || trouble=1
finish
