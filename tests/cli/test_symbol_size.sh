# shellcheck shell=bash disable=SC1091
# --symbol-size: features that are scaled, and at last a square; the size that is written; refused calls; the check.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }

# Houses of 10 m beside others that keep their shapes, 1 m and 0.5 m apart where the gap is 3 m; none can move.
{
    echo "WKT,name"
    echo '"POLYGON((0 0,10 0,10 10,0 10,0 0))",scaled'
    echo '"POLYGON((11 0,21 0,21 10,11 10,11 0))",rigid1'
    echo '"POLYGON((100 0,110 0,110 10,100 10,100 0))",square'
    echo '"POLYGON((110.5 0,120.5 0,120.5 10,110.5 10,110.5 0))",rigid2'
    echo '"POLYGON((200 0,210 0,210 10,200 10,200 0))",far'
} | layer h.gpkg houses POLYGON
words=(--gap 3 --max-shift 0 --rows no --rigid-where "name LIKE 'rigid%'")

expect 0 separate h.gpkg o.gpkg "${words[@]}" --symbol-size 4 --stats o.json
same "$(jq -c '[.shrunk.trimmed, .shrunk.inset, .shrunk.scaled, .shrunk.symbols]' o.json)" '[0,0,1,1]' "the figures:"
same "$(house o.gpkg scaled sunder_lvl),$(house o.gpkg square sunder_lvl),$(house o.gpkg far sunder_lvl)" "2,3,0" "the rungs:"
grep -q '^scaled 1, symbols 1, weight' out || fail "the summary: $(cat out)"
case $(house_wkt o.gpkg square) in *"103 3"*"107 7"* | *"107 7"*"103 3"*) ;; *) fail "the square: $(house_wkt o.gpkg square)" ;; esac
# The sizes that are written are not above the true ones, and hardly below them.
for name in scaled:6 square:4 far:10 rigid1:10; do
    size=$(house o.gpkg "${name%:*}" sunder_siz)
    awk -v is="$size" -v of="${name#*:}" 'BEGIN { exit !(is <= of * (1 + 1e-9) && is >= of * 0.995) }' ||
        fail "the size of ${name%:*} is $size"
done

# A least size: the disc does not fit into the scaled shape of 6 m; a square of 7 m is too large for either.
expect 3 separate h.gpkg m.gpkg "${words[@]}" --symbol-size 7 --min-size 6.5 --stats m.json
same "$(jq -c '.shrunk.scaled' m.json)" 0 "a least size:"
expect 0 separate h.gpkg m.gpkg --overwrite "${words[@]}" --symbol-size 4.5 --min-size 4.5 --stats m.json
same "$(jq -c '[.shrunk.scaled, .shrunk.symbols]' m.json)" '[1,1]' "the least size is that of the square:"

# Insets come first; then the scaled shape has to lie in the smallest of them.
expect 0 separate h.gpkg i.gpkg "${words[@]}" --inset 0.5,2 --symbol-size 4 --stats i.json
same "$(jq -c '[.shrunk.inset, .shrunk.symbols]' i.json)" '[1,1]' "with insets:"

checks=("${words[@]}" --no-blocks --block-field sunder_blk --before h.gpkg)
expect 0 check o.gpkg -l houses "${checks[@]}" --symbol-size 4 --stats c.json
same "$(jq -c '.moves.altered' c.json)" 0 "the check:"
expect 3 check o.gpkg -l houses "${checks[@]}" --symbol-size 5 --stats c.json
same "$(jq -c '.moves.altered' c.json)" 1 "the check with another square:"

expect 2 separate h.gpkg x.gpkg "${words[@]}" --symbol-size 0
expect 2 separate h.gpkg x.gpkg "${words[@]}" --symbol-size 2 --min-size 3
grep -q -- '--symbol-size 2: must be above 0, and not below --min-size' err || fail "the message: $(cat err)"
expect 2 check h.gpkg --symbol-size 1
finish
