# shellcheck shell=bash disable=SC1091
# Weights of any size, from the least double to the greatest, as a field, as areas, as both, of blocks: the result has a
# cost that is a finite number, or an error names the feature and its weight.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }
export SUNDER
python3 "$SUNDER_SOURCE/tests/cli/weights.py" || fail "see above"

# The smallest layer for which an earlier version reported "out of memory".
cat >four.csv <<'X'
w,WKT
1e-300,"POLYGON ((0 0,4 0,4 4,0 4,0 0))"
1e300,"POLYGON ((3 0,7 0,7 4,3 4,3 0))"
5e-324,"POLYGON ((6 0,10 0,10 4,6 4,6 0))"
1.7e308,"POLYGON ((9 0,13 0,13 4,9 4,9 0))"
X
refused 1 'FID 1: the weight in w is 1e-300; it must be a number from 1e-100 to 1e100' separate four.csv never.gpkg \
    --gap 1 --no-blocks --weight-field w --oo GEOM_POSSIBLE_NAMES=WKT --oo AUTODETECT_TYPE=YES
finish
