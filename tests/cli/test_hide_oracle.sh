# shellcheck shell=bash disable=SC1091
# Compares --hide with an independent program that tries all choices of houses in corridors (hide_oracle.py), and what it
# proves with layouts that another one finds (hide_worlds.py). The checker proves each clause again, and these programs
# look for a layout of its members alone. SUNDER_LAWS=all: 10,000 of each.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }

seed=${SUNDER_SEED:-1} layers=1 worlds=1 # of 40 corridors, or worlds, each
[ "${SUNDER_LAWS:-}" = all ] && layers=250 worlds=250
echo "seed $seed"
python3 "$SUNDER_SOURCE/tests/cli/hide_oracle.py" "$SUNDER" "$seed" "$layers" || trouble=1
python3 "$SUNDER_SOURCE/tests/cli/hide_worlds.py" "$SUNDER" "$seed" "$worlds" || trouble=1
finish
