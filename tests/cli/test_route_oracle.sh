# shellcheck shell=bash disable=SC1091
# Compares sunder route with brute force in rationals on small random scenes (route_oracle.py).
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }
PYTHONDONTWRITEBYTECODE=1 python3 "$SUNDER_SOURCE/tests/cli/route_oracle.py" "$SUNDER" $((120 * ${SUNDER_TEST_SCALE:-1})) \
    "${SUNDER_SEED:-1}" || fail "routes differ"
finish
