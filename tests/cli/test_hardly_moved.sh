# shellcheck shell=bash disable=SC1091
# A feature that gains nothing by a move does not move, not even by a margin for rounding (hardly_moved.py).
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }
export SUNDER PYTHONDONTWRITEBYTECODE=1
python3 "$SUNDER_SOURCE/tests/cli/hardly_moved.py" >said || fail "$(cat said)"
tail -n 1 said
finish
