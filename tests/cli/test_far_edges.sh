# shellcheck shell=bash disable=SC1091
# An area of a barrier none of whose corners is near, while its edges pass among the houses: the search sees the part of it that
# is near.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }
export SUNDER
python3 "$SUNDER_SOURCE/tests/cli/far_edges.py" || fail "see above"
finish
