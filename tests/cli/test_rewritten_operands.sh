# shellcheck shell=bash disable=SC1091
# sunder sum, pair, route and buffer give the same bytes however the rings of their operands are written.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
python3 "$SUNDER_SOURCE/tests/cli/rewritten_operands.py" "$SUNDER" 1 "${SUNDER_SEED:-1}" >wrong 2>asked || fail "$(cat wrong asked)"
[ "$(cat asked)" -eq 48 ] || fail "$(cat asked) questions were compared, not 48"
finish
