# shellcheck shell=bash disable=SC1091
# --hide: what is left out, what is written about it, which calls are refused, and what check finds in the result.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }

# Three houses of 10 m between two walls 28 m apart: two of them have room, and one may not be hidden. The fourth house
# stands on a road, which it cannot leave. The fifth is far away.
{
    echo "WKT,class,name"
    echo '"POLYGON((0 0,10 0,10 10,0 10,0 0))",2,left'
    echo '"POLYGON((9 0,19 0,19 10,9 10,9 0))",1,middle'
    echo '"POLYGON((18 0,28 0,28 10,18 10,18 0))",0,right'
    echo '"POLYGON((100 0,110 0,110 10,100 10,100 0))",,road'
    echo '"POLYGON((200 0,210 0,210 10,200 10,200 0))",1,far'
} | layer h.gpkg houses POLYGON
{
    echo "WKT,k"
    echo '"POLYGON((-9 -1,37 -1,37 -0.5,-9 -0.5,-9 -1))",1'
    echo '"POLYGON((-9 10.5,37 10.5,37 11,-9 11,-9 10.5))",2'
    echo '"POLYGON((-1 -1,-0.5 -1,-0.5 11,-1 11,-1 -1))",3'
    echo '"POLYGON((28.5 -1,29 -1,29 11,28.5 11,28.5 -1))",4'
    echo '"LINESTRING(105 -50,105 50)",5'
} | layer walls.gpkg walls GEOMETRY
plain=(--gap 0.5 --max-shift 3 --rows no --no-blocks --barrier walls.gpkg)
words=("${plain[@]}" --crossed hide)

expect 3 separate h.gpkg plain.gpkg "${plain[@]}" --stats plain.json
[ "$(jq .hidden plain.json)" = null ] || fail "figures of hidden features, though none are wanted"
ogrinfo -q plain.gpkg | grep -q hidden && fail "a layer of hidden features, though none are wanted"

# hidden FILE: the names of the hidden features
hidden() { ogr2ogr -f CSV /vsistdout/ "$1" houses -where 'sunder_inv = 1' -select name,sunder_st -lco STRING_QUOTING=IF_NEEDED | tail -n +2 | sort | tr '\n' ' '; }

expect 0 separate h.gpkg o.gpkg "${words[@]}" --hide --hide-weight 1 --stats o.json
same "$(jq -c '.hidden | [.count, .weight, .lower_bound, .forced, .by_class, .components, .components_proved]' o.json)" \
    '[2,2,2,1,{"1":{"count":2,"weight":2,"lower_bound":2}},2,2]' "without classes:"
grep -q '^hidden 2, weight 2, at least 2 is needed; 2 of 2 groups proved$' out || fail "the summary: $(cat out)"
expect 0 separate h.gpkg c.gpkg "${words[@]}" --hide --hide-weight 1 --hierarchy-field class --stats c.json
same "$(hidden c.gpkg)" "left,hidden road,hidden " "with classes:"
same "$(jq -c '.hidden.by_class | map_values(.lower_bound)' c.json)" '{"2":1,"null":1}' "with classes:"
row=$(ogr2ogr -f CSV /vsistdout/ c.gpkg houses_hidden -lco STRING_QUOTING=IF_NEEDED | tail -n +2 | tr '\n' ' ')
case $row in '1,,2,1,0,'*'4,,,1,1,"4,walls:5" ') ;; *) fail "the layer of hidden features: $row" ;; esac
[ "$(ogrinfo -q -sql 'SELECT count(*) AS n FROM layer_styles WHERE f_table_name = "houses_hidden"' c.gpkg | grep -c 'n (Integer) = 1')" = 1 ] ||
    fail "the layer of hidden features has no style"
expect 0 separate h.gpkg area.gpkg "${words[@]}" --hide --stats area.json
same "$(jq -c '.hidden.weight' area.json)" 20 "by the root of the area:"
expect 0 separate h.gpkg d.gpkg "${words[@]}" --hide --hierarchy-field class --drop-hidden
same "$(ogrinfo -q -sql 'SELECT count(*) AS n FROM houses' d.gpkg | grep -o 'n (Integer) = .*')" 'n (Integer) = 3' "dropped:"

# The page has the sums by class, a row with the reason for each hidden feature, and close-ups before and after.
expect 0 separate h.gpkg p.gpkg "${words[@]}" --hide --hide-weight 1 --hierarchy-field class --report h.html
for said in 'What is left out, and why' '<th scope="row">2</th><td class="number">1</td><td class="number">1</td><td class="number">1</td>' \
    '<td>proved</td><td><bdi>FID 2</bdi>, ' '<td>proved</td><td><bdi>walls:5</bdi></td>' '<span class="what">hidden</span>'; do
    grep -qF "$said" h.html || fail "the page lacks $said"
done
expect 3 separate h.gpkg p.gpkg --overwrite "${plain[@]}" --report plain.html
grep -q 'id="hidden"' plain.html && fail "a section about hidden features, though none are wanted"

# Six turned houses in a pen that holds four: without effort there is no proof for all, and the layer says so.
{
    echo "WKT,k"
    for ring in '10.8 5.3,17.3 8.0,15.4 12.8,8.8 10.1' '12.8 2.7,18.4 7.5,14.0 12.6,8.4 7.8' '10.6 3.0,13.8 9.8,9.5 11.8,6.3 5.0' \
        '15.7 10.9,18.7 19.0,14.1 20.7,11.1 12.6' '12.8 10.7,16.4 16.6,12.7 18.8,9.1 13.0' '11.0 6.4,12.8 15.1,7.4 16.2,5.7 7.5'; do
        echo "\"POLYGON(($ring))\",1"
    done
} | layer turned.gpkg houses POLYGON
printf 'WKT,k\n"POLYGON((-9 -9,29 -9,29 29,-9 29),(0 0,0 20,20 20,20 0))",1\n' | layer pen.gpkg pen POLYGON
expect 0 separate turned.gpkg turned.o.gpkg --gap 0.5 --max-shift 14 --rows no --effort 0 --no-blocks --contained separate --allow-jumps \
    --barrier pen.gpkg,side=no --hide --hide-weight 1 --stats turned.json --report turned.html
ogrinfo -q turned.o.gpkg houses_hidden | grep -q 'because (String) = tentative: [0-9]' || fail "no set is said to be tentative"
[ "$(jq '.hidden.lower_bound < .hidden.weight' turned.json)" = true ] || fail "a tentative set counts in the bound"
grep -q '<td>assumed</td>' turned.html || fail "the page does not say what is assumed"

# A result has nothing more to hide, for any number of threads the bytes are the same, and the check agrees.
expect 0 separate d.gpkg again.gpkg -l houses --output-layer a "${words[@]}" --hide --hierarchy-field class --stats again.json
same "$(jq -c .hidden.count again.json)" 0 "the result again:"
expect 0 separate h.gpkg t.csv "${words[@]}" --hide --threads 1 --lco GEOMETRY=AS_WKT --layers main
expect 0 separate h.gpkg t4.csv "${words[@]}" --hide --threads 4 --lco GEOMETRY=AS_WKT --layers main
cmp -s t.csv t4.csv || fail "other threads, another result"
checks=("${words[@]}" --hidden-field sunder_inv --hierarchy-field class --before h.gpkg)
expect 0 check c.gpkg -l houses "${checks[@]}" --stats check.json
same "$(jq -c '[.moves.needless, .skipped]' check.json)" '[0,2]' "the check:"
# A feature that fits is needless if it is hidden; one of class 0 counts as visible.
ogr2ogr -q planted.gpkg c.gpkg houses -sql "SELECT * FROM houses" -nln houses
ogrinfo -q planted.gpkg -sql "UPDATE houses SET sunder_inv = 1 WHERE name IN ('far', 'right')" >/dev/null
expect 3 check planted.gpkg -l houses "${checks[@]}" --stats planted.json
same "$(jq -c '[.moves.needless, .skipped]' planted.json)" '[1,3]' "planted:"
expect 3 check c.gpkg -l houses "${plain[@]}" --before h.gpkg

# Wrong classes.
for value in -1 1.5 important; do
    printf 'WKT,class\n"POLYGON((0 0,1 0,1 1,0 0))",%s\n' "$value" | layer "wrong$value.gpkg" wrong POLYGON
    expect 1 separate "wrong$value.gpkg" x.gpkg --hide --hierarchy-field class
    grep -q "FID 1: the class in class is $value; it must be a whole number" err || fail "class $value: $(cat err)"
done
finish
