# shellcheck shell=bash disable=SC1091
# Compares --hide with --trim with an independent program that tries all choices of houses, whole, cut back or hidden, in
# corridors with roads across them (trim_oracle.py). The checker proves each clause again. SUNDER_LAWS=all: 10,000.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }

seed=${SUNDER_SEED:-1} layers=1 # of 40 corridors each
[ "${SUNDER_LAWS:-}" = all ] && layers=250
echo "seed $seed"
python3 "$SUNDER_SOURCE/tests/cli/trim_oracle.py" "$SUNDER" "$seed" "$layers" || trouble=1
finish
