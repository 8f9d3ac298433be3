# shellcheck shell=bash disable=SC1091
# For each test of the checker: would a forgery be noticed if the checker did not have this test (checks_off.py)? On the
# generated runs of test_forgeries.sh.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
. "$SUNDER_SOURCE/tests/proof/forged_runs.sh"

forge_generated
write_runs runs.json
python3 "$here/checks_off.py" runs.json . >said 2>&1 || fail "$(grep -v '^seen\|^others\|^UNSEEN' said)"
cut -c 1-6 said | sort | uniq -c
finish
