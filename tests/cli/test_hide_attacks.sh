# shellcheck shell=bash disable=SC1091
# --hide where it is hardest: 500 squares at one place, a component of 5,000 houses, a church in the road, a street whose
# houses all depend on each other; and a result, which has nothing more to hide.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }

# houses FILE NUMBER STEP WIDTH: houses of 10 m, this far from one to the next; fixed: the first and the last one
houses() {
    python3 -c '
import sys
n, step, wide = int(sys.argv[1]), float(sys.argv[2]), float(sys.argv[3])
print("WKT,fixed")
for k in range(n):
    x = step * k
    print(f"\"POLYGON(({x} 0,{x + wide} 0,{x + wide} 10,{x} 10))\",{int(k in (0, n - 1))}")' "${@:2}" | layer "$1" houses POLYGON
}

# hides WHAT FIGURES FILE OPTIONS...: count, lower bound, components and proved ones
hides() {
    expect 0 separate "$3" o.gpkg --overwrite -l houses --no-blocks --contained separate --rows no --ease no --hide --hide-weight 1 \
        --stats o.json "${@:4}"
    same "$(jq -c '.hidden | [.count, .lower_bound, .components, .components_proved]' o.json)" "$2" "$1:"
    [ "$(jq .verified o.json)" = true ] || fail "$1: not verified"
}

houses squares.gpkg 500 0 10
hides "500 squares at one place" '[499,499,1,1]' squares.gpkg --gap 3 --max-shift 3 --layers main
houses long.gpkg 5000 9.5 10
hides "a component of 5,000" '[2500,2500,1,1]' long.gpkg --gap 0.5 --max-shift 0.1 --layers main

# A street of 20 houses between two lines and two fixed houses has room for 19, and no smaller set is to blame.
houses street.gpkg 20 11 10
printf 'WKT,k\n"LINESTRING(-50 -0.5,300 -0.5)",1\n"LINESTRING(-50 10.5,300 10.5)",1\n' | layer lines.gpkg lines LINESTRING
street=(--gap 1.1 --max-shift 3 --fixed-where 'fixed = 1' --barrier lines.gpkg,gap=0.5)
hides "one set through a street" '[1,1,1,1]' street.gpkg "${street[@]}"
names=$(ogrinfo -q o.gpkg houses_hidden | sed -n 's/.*because (String) = //p' | tr ',' '\n' | grep -vc :)
[ "$names" -ge 18 ] || fail "a set of $names houses has no layout"
cp o.gpkg result.gpkg
expect 0 separate result.gpkg again.gpkg -l houses --output-layer a --where "sunder_st <> 'hidden'" --no-blocks --contained separate --rows no \
    --ease no --hide "${street[@]}" --stats again.json
same "$(jq .hidden.count again.json)" 0 "the result again:"

# Through a whole town: 80 houses lack 0.1 m each. No house may go farther than 3.05 m, so 32 in a line are too many from
# either end, and in between.
houses town.gpkg 80 11 10
printf 'WKT,k\n"LINESTRING(-50 -0.5,950 -0.5)",1\n"LINESTRING(-50 10.5,950 10.5)",1\n' | layer long_lines.gpkg lines LINESTRING
hides "sets through a whole town" '[2,2,1,1]' town.gpkg --gap 1.1 --max-shift 3.05 --fixed-where 'fixed = 1' --barrier long_lines.gpkg,gap=0.5

# A church of class 0 in the road stays, with its reason; the house between it and a wall goes; an important house that
# stands in the road as well goes, whatever its class.
printf '%s\n' WKT,class '"POLYGON((0 0,20 0,20 30,0 30))",0' '"POLYGON((20.5 0,30.5 0,30.5 10,20.5 10))",1' '"POLYGON((0 50,20 50,20 60,0 60))",1' |
    layer church.gpkg houses POLYGON
printf 'WKT,k\n"LINESTRING(10 -50,10 150)",1\n"LINESTRING(31 -50,31 15)",1\n"LINESTRING(21 -1,35 -1)",1\n"LINESTRING(21 11,35 11)",1\n' |
    layer roads.gpkg roads LINESTRING
expect 3 separate church.gpkg o.gpkg --overwrite --no-blocks --gap 1 --max-shift 2 --fixed-where "class = 0" --hide --crossed hide --hierarchy-field class \
    --barrier roads.gpkg --stats o.json
same "$(jq -c '.hidden | [.count, .components_proved]' o.json)" '[2,2]' "beside the church:"
same "$(ogrinfo -q -sql 'SELECT fid_a, barrier, reason FROM houses_conflicts' o.gpkg | grep -c 'fid_a (Integer64) = 1')" 1 "the church in the road:"
same "$(ogrinfo -q -sql "SELECT count(*) AS n FROM houses WHERE sunder_inv = 1 AND class = 0" o.gpkg | grep -c 'n (Integer) = 0')" 1 "hidden of class 0:"
finish
