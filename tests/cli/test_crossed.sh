# shellcheck shell=bash disable=SC1091
# --crossed: houses above a footway are kept as they stand, unless they are to be cut back or left out for it.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
command -v jq >/dev/null || { echo "skipped: no jq"; exit 77; }

# Three houses of 10 m between two walls 28 m apart, above a footway: two of them have room. A house above another footway
# that a road covers by 1 m; a house above a well, which is a point; a house that an area covers.
{
    echo "WKT,name"
    echo '"POLYGON((0 0,10 0,10 10,0 10,0 0))",left'
    echo '"POLYGON((9 0,19 0,19 10,9 10,9 0))",middle'
    echo '"POLYGON((18 0,28 0,28 10,18 10,18 0))",right'
    echo '"POLYGON((102 0,112 0,112 10,102 10,102 0))",road'
    echo '"POLYGON((200 0,210 0,210 10,200 10,200 0))",well'
    echo '"POLYGON((300 0,310 0,310 10,300 10,300 0))",area'
} | layer h.gpkg houses POLYGON
{
    echo "WKT,k"
    echo '"POLYGON((-9 -1,37 -1,37 -0.5,-9 -0.5,-9 -1))",1'
    echo '"POLYGON((-9 10.5,37 10.5,37 11,-9 11,-9 10.5))",2'
    echo '"POLYGON((-1 -1,-0.5 -1,-0.5 11,-1 11,-1 -1))",3'
    echo '"POLYGON((28.5 -1,29 -1,29 11,28.5 11,28.5 -1))",4'
    echo '"POLYGON((290 -10,320 -10,320 20,290 20,290 -10))",5'
} | layer walls.gpkg walls POLYGON
printf 'WKT,w\n"LINESTRING(-8 3,36 3)",1\n"LINESTRING(95 8,120 8)",1\n"LINESTRING(100 -50,100 80)",5\n"POINT(203 4)",1\n' |
    layer ways.gpkg ways GEOMETRY
limit=3
words=(--gap 0.5 --rows no --no-blocks --barrier walls.gpkg --barrier ways.gpkg,width-field=w)

# hides FIGURES FILE OPTIONS...: hidden, their bound, trimmed
hides() {
    expect 3 separate h.gpkg "$2" --overwrite "${words[@]}" --max-shift $limit --hide --hide-weight 1 --stats o.json "${@:3}"
    same "$(jq -c '[.hidden.count, .hidden.lower_bound, .shrunk.trimmed]' o.json)" "$1" "${*:3}:"
    [ "$(jq .verified o.json)" = true ] || fail "${*:3}: not verified"
}
kept() { ogr2ogr -f CSV /vsistdout/ "$1" houses_conflicts -select fid_a,barr_fid,kind,reason,missing -lco STRING_QUOTING=IF_NEEDED | tail -n +2 | sort | tr '\n' ' '; }

# One of the three, and the house in the area, have no room. All others may stay above the ways.
hides '[2,2,0]' o.gpkg
same "$(house o.gpkg area sunder_st),$(house o.gpkg well sunder_st),$(house o.gpkg road sunder_st)" "hidden,unmoved,moved" "the states:"
case $(kept o.gpkg) in *'4,2,barrier,kept, 5,4,barrier,kept, '*) ;; *) fail "the list: $(kept o.gpkg)" ;; esac
kept o.gpkg | tr ' ' '\n' | grep -qv 'kept,$\|^$' && fail "another reason: $(kept o.gpkg)"
checks=("${words[@]}" --max-shift 3 --hidden-field sunder_inv --before h.gpkg)
expect 3 check o.gpkg -l houses "${checks[@]}" --stats c.json
same "$(jq -c '[.moves.worse, .moves.side, .moves.needless]' c.json)" '[0,0,0]' "the check:"
same "$(jq -c .conflicts c.json)" "$(jq -c .conflicts.after o.json)" "the counts:"

# The same with proofs for the other demands: a price is not paid for what is kept.
hides '[2,2,0]' e.gpkg --ease no
same "$(jq -c '.displacement.cost_shortfall // 0' o.json)" 0 "the price:"
hides '[2,2,0]' e.gpkg --ease 30
same "$(jq -c '[.displacement.cost_shortfall, .displacement.cost == .displacement.cost_moves]' o.json)" '[0,true]' "the price:"

# Cut back at the road, and only there; or also at the footway; or left out.
limit=0.5
hides '[2,2,1]' t.gpkg --trim --trim-keep 0.05
case $(house t.gpkg road sunder_cut) in 0.1* | 0.09*) ;; *) fail "the share lost is $(house t.gpkg road sunder_cut)" ;; esac
expect 0 separate h.gpkg t.gpkg --overwrite "${words[@]}" --hide --hide-weight 1 --trim --trim-keep 0.05 --crossed trim --max-shift $limit --stats o.json
same "$(jq -c '.shrunk.trimmed > 3' o.json)" true "--crossed trim:"
expect 0 separate h.gpkg x.gpkg "${words[@]}" --max-shift 3 --hide --hide-weight 1 --crossed hide --stats o.json
same "$(jq -c '[.hidden.count, .hidden.lower_bound]' o.json)" '[6,6]' "--crossed hide:"

# A house that is hidden for a way alone is hidden in vain, unless it may not stay there.
ogr2ogr -q planted.gpkg o.gpkg houses -nln houses
ogrinfo -q planted.gpkg -sql "UPDATE houses SET sunder_inv = 1 WHERE name = 'well'" >/dev/null
expect 3 check planted.gpkg -l houses "${checks[@]}" --stats c.json
same "$(jq -c .moves.needless c.json)" 1 "hidden in vain:"
expect 3 check planted.gpkg -l houses "${checks[@]}" --crossed hide --stats c.json
same "$(jq -c .moves.needless c.json)" 0 "hidden for the well:"

# The same bytes for any number of threads.
expect 3 separate h.gpkg t.csv "${words[@]}" --max-shift 3 --hide --threads 1 --lco GEOMETRY=AS_WKT --layers main
expect 3 separate h.gpkg t4.csv "${words[@]}" --max-shift 3 --hide --threads 4 --lco GEOMETRY=AS_WKT --layers main
cmp -s t.csv t4.csv || fail "other threads, another result"
finish
