# shellcheck shell=bash disable=SC1091
# A larger --row-stiffness never leaves rows more bent (stiffness_law.py).
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }

seed=${SUNDER_SEED:-1} layers=12
[ "${SUNDER_LAWS:-}" = all ] && layers=500
echo "seed $seed"
python3 "$SUNDER_SOURCE/tests/cli/stiffness_law.py" "$SUNDER" "$seed" "$layers" || trouble=1
finish
