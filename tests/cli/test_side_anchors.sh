# shellcheck shell=bash disable=SC1091
# Compares the side anchors of features that lines and areas cut with their rule, computed in fractions
# (side_anchor.py). SUNDER_SEED selects the random ones; SUNDER_LAWS=all tests 10,000.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
anchors=$SUNDER_BUILD/tests/anchors
[ -x "$anchors" ] || { echo "skipped: no anchors"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
count=300
[ "${SUNDER_LAWS:-}" != all ] || count=10000
/usr/bin/python3 "$SUNDER_SOURCE/tests/cli/side_anchor_cases.py" "$anchors" $count "${SUNDER_SEED:-1}" >out 2>&1 ||
    { head -20 out; fail "side anchors are not those of the rule"; }
tail -1 out
finish
