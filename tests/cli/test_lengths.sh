# shellcheck shell=bash disable=SC1091
# Lengths with units, on paper (with a map scale), in shapes; layers without CRS, in feet, in degrees, in Mercator.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

houses() { cat <<'X'
id,WKT
1,"POLYGON((0 0,4 0,4 4,0 4,0 0))"
2,"POLYGON((5 0,9 0,9 4,5 4,5 0))"
X
}
houses | layer m.gpkg h POLYGON EPSG:25832
houses | layer ft.gpkg h POLYGON EPSG:2263 # US survey feet
houses | layer ift.gpkg h POLYGON EPSG:2222 # international feet
houses | layer deg.gpkg h POLYGON EPSG:4326
houses | layer none.gpkg h POLYGON none
houses | layer web.gpkg h POLYGON EPSG:3857
# required FILE LENGTH [OPTION...]: the gap in the layer's units, as the conflict's `required`
required() {
    local file=$1 gap=$2
    shift 2
    expect 3 check "$file" --gap "$gap" --touch-tolerance 0 "$@"
    head -1 out | cut -f12
}
same "$(required m.gpkg 1.5)" 1.5
same "$(required m.gpkg 1.5m)" 1.5
same "$(required m.gpkg 0.002km)" 2
same "$(required m.gpkg 10ft)" 3.048
same "$(required m.gpkg 3937us-ft)" 1200
same "$(required m.gpkg 0.2mm --scale 25000)" 5
same "$(required m.gpkg 0.2mm --scale 1:25000)" 5
same "$(required ft.gpkg 10us-ft)" 10
same "$(required ift.gpkg 10ft)" 10
same "$(required ift.gpkg 3.048m)" 10
same "$(required ft.gpkg 1200m)" 3937
same "$(required none.gpkg 1.5)" 1.5
expect 0 check m.gpkg --gap 1 # features exactly the gap apart are not in conflict
[ ! -s err ] || fail "warnings without need"
expect 3 check m.gpkg --gap 1.0000000000000002 --touch-tolerance 0

expect 0 separate ft.gpkg o.gpkg --gap 3ft --stats s.json
same "$(json .unit s.json)" 'US survey foot'
refused 1 'no CRS' check none.gpkg --gap 1m
refused 1 'scale' check m.gpkg --gap 0.2mm
refused 1 'reproject' check deg.gpkg --gap 1
refused 1 'reproject' separate deg.gpkg o2.gpkg --gap 1m
refused 1 'reproject' separate deg.gpkg o2.gpkg --max-shift 1
expect 0 check deg.gpkg
same "$(grep -c '^sunder: warning: h: .*degrees' err)" 1 "warnings about degrees:"
expect 3 check web.gpkg --gap 1.5
says err 'about 1 times'
layer north.gpkg h POLYGON EPSG:3857 <<'X'
id,WKT
1,"POLYGON((0 8399737,4 8399737,4 8399741,0 8399741))"
2,"POLYGON((5 8399737,9 8399737,9 8399741,5 8399741))"
X
expect 3 check north.gpkg --gap 1.5
says err 'about 2 times' # at 60 degrees north
expect 3 check deg.gpkg --input-crs EPSG:25832 --gap 2m
expect 3 check none.gpkg --input-crs EPSG:2263 --gap 2us-ft

layer p.gpkg p POINT EPSG:2263 <<'X'
id,WKT
1,POINT(0 0)
2,POINT(1 0)
X
expect 0 separate p.gpkg po.gpkg --symbol square:1200m -q
same "$(geometry po.gpkg p_symbols 1 | tr '(,' '\n\n' | awk 'NR > 2 { print $2 }' | sort -n | sed -n '1p;$p' | tr '\n' ' ')" '-1968.5 1968.5 '
finish
