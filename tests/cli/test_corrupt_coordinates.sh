# shellcheck shell=bash disable=SC1091
# One corrupt vertex, from 1e16 to the greatest double: a feature that can only be moved by multiples of its last place is
# tried as fixed first, and its sound neighbours go no farther than beside a fixed one. What is thrown far is warned of.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }
export SUNDER
python3 "$SUNDER_SOURCE/tests/cli/corrupt_coordinates.py" || fail "see above"

# Where the neighbour may not move the conflict is no reason to hold it: it goes, and is told of.
cat >wild.csv <<'X'
id,WKT
1,"POLYGON ((500000 5300000,500010 5300000,500010 5300100,500000 5300100,500000 5300000))"
2,"POLYGON ((500008 5300000,1e20 1e20,500008 5300100,500008 5300000))"
3,"POLYGON ((500000 5300500,500010 5300500,500010 5300600,500000 5300500))"
X
expect 0 separate wild.csv wild.gpkg --fixed-where "id = '1'" --oo GEOM_POSSIBLE_NAMES=WKT
grep -q 'FID 2: it moves by .*are its own coordinates corrupt' err || fail "no warning"
finish
