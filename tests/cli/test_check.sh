# shellcheck shell=bash disable=SC1091
# sunder check: one line per conflict, kinds, blocks, the layer of conflicts, JSON; its counts agree with those of
# separate.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

layer in.gpkg houses POLYGON <<'X'
id,WKT
a,"POLYGON((0 0,10 0,10 10,0 10,0 0))"
b,"POLYGON((8 0,18 0,18 10,8 10,8 0))"
c,"POLYGON((20 0,30 0,30 10,20 10,20 0))"
d,"POLYGON((30 0,40 0,40 10,30 10,30 0))"
e,"POLYGON((100 0,110 0,110 10,100 10,100 0))"
f,"POLYGON((101 1,102 1,102 2,101 2,101 1))"
g,"POLYGON((200 0,210 0,210 10,200 10,200 0))"
h,"POLYGON((200 0,210 0,210 10,200 10,200 0))"
X
expect 3 check in.gpkg --id-field id
same "$(cut -f1-7 out | head -1)" "$(printf '1\ta\t2\tb\t\t\toverlap')"
same "$(head -1 out | tr '\t' '\n' | grep -c '')" 17 columns
same "$(head -1 out | cut -f9-13)" "$(printf '0\t0\t2\t0\t2')"
same "$(tail -1 out | tr '\t' '#')" 'houses: 8 features (skipped 0, invalid 0, null 0), 4 pairs tested; overlap 1, too close 0, barrier 0, barrier drawn 0, barrier near 0, contained 0, duplicate 0, inside blocks 2 (2 of them listed: they overlap)'
expect 3 check in.gpkg --contained separate --no-blocks --stats s.json --gap 3
same "$(jq -c . s.json | sed 's/"pairs_tested":[0-9]*/"pairs_tested":N/')" \
    '{"command":"check","features":8,"skipped":0,"invalid":0,"null":0,"pairs_tested":N,"conflicts":{"overlap":1,"too_close":2,"barrier":0,"barrier_drawn":0,"barrier_near":0,"contained":1,"duplicate":1,"inside_blocks":0}}'
same "$(cut -f7 out | grep -v features | tr '\n' ' ')" 'overlap too_close too_close contained duplicate '
expect 3 check in.gpkg --stats -
same "$(jq -r .command out)" check "--stats - alone on stdout:"
expect 0 check in.gpkg --allow-conflicts --quiet
same "$(grep -c features out)" 0 "--quiet and the summary:"
expect 0 check in.gpkg --ignore-where "id = 'a'"
expect 0 check in.gpkg --where "id = 'a'"

expect 3 check in.gpkg c.gpkg --id-field id
same "$(count c.gpkg houses_conflicts) $(value c.gpkg houses_conflicts 1 id_b)" "$(grep -vc features out) b"
expect 3 check in.gpkg --output c2.gpkg -nln list
same "$(count c2.gpkg list)" "$(count c.gpkg houses_conflicts)"
expect 3 check in.gpkg -o c3.shp
[ -s c3.shp ] || fail "no c3.shp"
refused 1 'c.gpkg' check in.gpkg c.gpkg
refused 1 'in.gpkg' check in.gpkg in.gpkg
expect 3 check in.gpkg in.gpkg --update
same "$(count in.gpkg houses_conflicts) $(count in.gpkg houses)" "$(count c.gpkg houses_conflicts) 8"

# For a written result the counts are those that separate gave as `after`.
town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg
for options in '--gap 3' '--gap 3 --max-shift 2' '--gap 2 --contained separate'; do
    # shellcheck disable=SC2086 # words
    {
        run separate "$town" t.gpkg -l buildings $options --stats t.json --overwrite
        [ $status -eq 0 ] || [ $status -eq 3 ] || fail "separate $options: status $status"
        was=$status
        run check t.gpkg -l buildings ${options% --max-shift*} --no-blocks --block-field sunder_blk --stats c.json
        same "$status" "$was" "check $options: exit status"
        same "$(jq -c '.conflicts' c.json)" "$(jq -c '.conflicts.after' t.json)" "check $options:"
    }
done
finish
