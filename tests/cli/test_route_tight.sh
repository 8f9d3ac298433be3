# shellcheck shell=bash disable=SC1091
# sunder route through passages that the robot fits exactly, and with the robot wider or narrower by one unit in the
# last place (route_tight.py).
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }
families=$(find "$SUNDER_BUILD" -name sunder-families -type f | head -n 1)
[ -n "$families" ] || { echo "skipped: sunder-families is not built"; exit 77; }
PYTHONDONTWRITEBYTECODE=1 python3 "$SUNDER_SOURCE/tests/cli/route_tight.py" "$SUNDER" "$families" || fail "tight passages"
finish
