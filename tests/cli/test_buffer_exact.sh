# shellcheck shell=bash disable=SC1091
# Compares sunder buffer with brute force in exact arithmetic (buffer_exact.py).
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }
PYTHONDONTWRITEBYTECODE=1 python3 "$SUNDER_SOURCE/tests/cli/buffer_exact.py" "$SUNDER" $((24 * ${SUNDER_TEST_SCALE:-1})) \
    "${SUNDER_SEED:-1}" || fail "buffers differ"
finish
