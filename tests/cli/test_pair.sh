# shellcheck shell=bash disable=SC1091
# sunder pair: keys and their order, exact answers, ties, the gap, exact fits, a layer of the translation.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

expect 0 pair square:2 'POLYGON ((0 0, 3 0, 3 3, 0 3))'
same "$(json keys_unsorted out | tr -d ' \n')" '["command","overlap","dx","dy","distance_squared","distance","contact","attained","rounded_is_free"]'
# (0, 1) and (1, 0) are equally short: the lexicographically smallest is given.
same "$(jq -c 'del(.command)' out)" '{"overlap":true,"dx":"0","dy":"1","distance_squared":"1","distance":1,"contact":"edge","attained":true,"rounded_is_free":true}'
mv out plain
expect 0 pair square:2 'POLYGON ((0 0, 3 0, 3 3, 0 3))' --exact
cmp -s plain out || fail "--exact prints something else"
expect 0 pair square:2 'POLYGON ((5 5, 6 5, 6 6, 5 6))'
same "$(jq -c '[.overlap,.dx,.dy,.distance,.contact]' out)" '[false,"0","0",0,"none"]'
expect 0 pair square:2 'POLYGON ((1 -1, 3 -1, 3 1, 1 1))' # touching is separate, unless a gap is required
same "$(jq -c '[.overlap,.dx]' out)" '[false,"0"]'
expect 0 pair square:2 'POLYGON ((1 -1, 3 -1, 3 1, 1 1))' --gap 0.5
same "$(jq -c '[.overlap,.dx,.dy,.contact]' out)" '[true,"1/2","0","edge"]'
# corner to corner: the solution is on a circle about the corner, and irrational
expect 0 pair square:2 'POLYGON ((2 2, 3 2, 3 3, 2 3))' --gap 2
jq -e '.overlap and .contact == "arc" and .attained and .rounded_is_free and .distance >= 0.5857864376269049 and .distance < 0.585786438213' \
    out >/dev/null || fail "round a corner: $(cat out)"
# A peg in a pocket that it fits exactly: the nearest free place is an isolated point.
expect 0 pair 'POLYGON ((0 0, 10 0, 10 10, 0 10), (3 3, 7 3, 7 7, 3 7))' 'POLYGON ((3.5 3.25, 7.5 3.25, 7.5 7.25, 3.5 7.25))'
same "$(jq -c '[.dx,.dy,.contact]' out)" '["-1/2","-1/4","degenerate_point"]'

expect 0 pair square:2 square:1 o.gpkg --stats s.json
[ ! -s out ] || fail "something on stdout besides the layer"
same "$(json .contact s.json) $(value o.gpkg pair 1 contact) $(value o.gpkg pair 1 len)" 'edge edge 1.5'
expect 0 pair square:2 square:1 --stats -
same "$(json .dx out)" '-3/2'
# Options of `sum` that `pair` does not have, since it computes no sum.
for option in '--algorithm convolution' '--seed 1' '--decomposition vertical' '--order given'; do
    # shellcheck disable=SC2086 # an option and its value
    refused 2 "unknown option ${option%% *}" pair square:2 square:1 $option
done
refused 2 'negative' pair square:2 square:1 --gap -1
refused 2 '--gap' pair square:2 square:1 --gap inf
refused 1 'the layer has no CRS' pair square:2 square:1 --gap 1m
finish
