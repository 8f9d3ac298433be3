# shellcheck shell=bash disable=SC1091
# A barrier area without a corner near the houses, whose edges pass among them: the search takes the part of it that is
# near into account.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }
export SUNDER
python3 "$SUNDER_SOURCE/tests/cli/far_edges.py" || fail "see above"
finish
