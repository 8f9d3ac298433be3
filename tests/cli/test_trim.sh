# shellcheck shell=bash disable=SC1091
# --trim: what is cut back, what is written about it, which calls are refused, and what check finds in the result.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }

# Two houses beside a road of 6 m that covers 1 m of each, and a third on it; none can move far enough.
{
    echo "WKT,class,name"
    echo '"POLYGON((2 0,12 0,12 10,2 10,2 0))",1,right'
    echo '"POLYGON((-12 0,-2 0,-2 10,-12 10,-12 0))",0,left'
    echo '"POLYGON((-3 30,4 30,4 40,-3 40,-3 30))",1,on'
    echo '"POLYGON((50 0,60 0,60 10,50 10,50 0))",1,far'
} | layer h.gpkg houses POLYGON
{ echo "WKT,k"; echo '"LINESTRING(0 -50,0 80)",1'; } | layer road.gpkg road LINESTRING
words=(--gap 0.5 --max-shift 0.25 --rows no --barrier road.gpkg,width=6)

expect 0 separate h.gpkg o.gpkg "${words[@]}" --hide --hide-weight 1 --trim --crossed hide --stats o.json
same "$(jq -c '[.hidden.count, .hidden.lower_bound, .shrunk.trimmed]' o.json)" '[1,1,2]' "two can be cut:"
same "$(jq -c '.shrunk.lower_bound == .shrunk.area_lost' o.json)" true "the bound of what is lost:"
same "$(house o.gpkg on sunder_st),$(house o.gpkg on sunder_lvl)" "hidden,0" "the house on the road:"
same "$(house o.gpkg right sunder_lvl),$(house o.gpkg left sunder_lvl),$(house o.gpkg far sunder_lvl)" "1,1,0" "the levels:"
grep -q '^trimmed 2, ' out || fail "the summary: $(cat out)"
# A share of 0.15 is lost: the house loses 1.5 m of its 10 m.
case $(house o.gpkg right sunder_cut) in 0.15*) ;; *) fail "the share lost is $(house o.gpkg right sunder_cut)" ;; esac

# The house that the road crosses is cut only if that is asked for and it keeps enough; then nothing is hidden. --trim
# alone hides nothing, ever.
expect 0 separate h.gpkg k.gpkg "${words[@]}" --hide --hide-weight 1 --trim --crossed hide --trim-keep 0.05 --stats k.json
same "$(jq -c '[.hidden.count, .shrunk.trimmed]' k.json)" '[1,2]' "a smaller share:"
expect 0 separate h.gpkg k.gpkg --overwrite "${words[@]}" --hide --hide-weight 1 --trim --trim-keep 0.05 --crossed trim --stats k.json
same "$(jq -c '[.hidden.count, .shrunk.trimmed]' k.json)" '[0,3]' "the house that the road crosses:"
expect 0 separate h.gpkg k.gpkg --overwrite "${words[@]}" --hide --hide-weight 1 --trim --crossed trim --stats k.json
same "$(jq -c '[.hidden.count, .shrunk.trimmed]' k.json)" '[1,2]' "a house that keeps too little:"
expect 3 separate h.gpkg alone.gpkg "${words[@]}" --trim --stats alone.json
same "$(jq -c '[.hidden.count, .shrunk.trimmed]' alone.json)" '[0,2]' "without --hide:"
expect 0 separate h.gpkg m.gpkg "${words[@]}" --hide --hide-weight 1 --trim --crossed hide --min-size 9 --stats m.json
same "$(jq -c '[.hidden.count, .shrunk.trimmed]' m.json)" '[3,0]' "a least size:"
expect 0 separate h.gpkg r.gpkg "${words[@]}" --hide --hide-weight 1 --trim --crossed hide --rigid-where "name = 'right'" --stats r.json
same "$(house r.gpkg right sunder_st),$(house r.gpkg left sunder_lvl)" "hidden,1" "a rigid house:"
expect 0 separate h.gpkg c.gpkg "${words[@]}" --hide --hierarchy-field class --trim --crossed hide
same "$(house c.gpkg left sunder_st),$(house c.gpkg left sunder_lvl)" "unmoved,1" "a house that is never hidden is cut:"

# The check makes the smaller shapes again. A feature with another shape is altered.
checks=("${words[@]}" --no-blocks --block-field sunder_blk --hidden-field sunder_inv --before h.gpkg)
expect 0 check o.gpkg -l houses "${checks[@]}" --crossed hide --trim --stats check.json
same "$(jq -c '[.moves.altered, .moves.not_a_translate, .moves.needless]' check.json)" '[0,0,0]' "the check:"
expect 3 check o.gpkg -l houses "${checks[@]}" --crossed hide --stats check.json
same "$(jq -c '[.moves.altered, .moves.not_a_translate]' check.json)" '[null,2]' "the check without --trim:"
ogr2ogr -q planted.gpkg o.gpkg houses -nln houses
ogrinfo -q planted.gpkg -sql "UPDATE houses SET geom = ST_GeomFromText('POLYGON((4 0,12 0,12 10,4 10,4 0))') WHERE name = 'right'" \
    -dialect SQLite >/dev/null 2>&1
expect 3 check planted.gpkg -l houses "${checks[@]}" --crossed hide --trim --stats check.json
same "$(jq -c '[.moves.altered, .moves.too_small]' check.json)" '[1,0]' "a house that is cut otherwise:"
# Both houses keep 0.85 of their areas, and have room for a disc of 8.5 m.
for least in "--trim-keep 0.9" "--min-size 8.6"; do
    # shellcheck disable=SC2086
    expect 3 check o.gpkg -l houses "${checks[@]}" --crossed hide --trim $least --stats check.json
    same "$(jq -c '[.moves.altered, .moves.too_small]' check.json)" '[0,2]' "houses that are too small by $least:"
done

# The same bytes for any number of threads, and formats without fast rows.
expect 0 separate h.gpkg t.csv "${words[@]}" --hide --trim --crossed hide --threads 1 --lco GEOMETRY=AS_WKT --layers main
expect 0 separate h.gpkg t4.csv "${words[@]}" --hide --trim --crossed hide --threads 4 --lco GEOMETRY=AS_WKT --layers main
cmp -s t.csv t4.csv || fail "other threads, another result"

expect 2 separate h.gpkg x.gpkg --gap 0.5 --trim
grep -q -- '--trim: features are cut back at barriers; give --barrier' err || fail "the message: $(cat err)"
expect 2 separate h.gpkg x.gpkg "${words[@]}" --trim --crossed hide --trim-keep 1.5

# Many towns with slanted walls.
/usr/bin/python3 -c 'from osgeo import ogr' 2>/dev/null || { echo "without GDAL's Python module: no towns"; finish; exit 0; }
/usr/bin/python3 "$SUNDER_SOURCE/tests/cli/trim_worlds.py" "$SUNDER" "${SUNDER_SEED:-3}" 40 || fail "the towns"
finish
