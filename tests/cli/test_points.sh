# shellcheck shell=bash disable=SC1091
# Points with symbols: one symbol for all, a symbol for each, coincident points, several points in one feature; curves.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

layer p.gpkg trees POINT <<'X'
id,sym,WKT
1,,POINT(451005 5411005)
2,disc:3:12,POINT(451005 5411005)
3,"POLYGON((0 0,4 0,0 4,0 0))",POINT(451006 5411006)
4,square:1m,POINT(451050 5411050)
5,,POINT EMPTY
X
expect 0 separate p.gpkg o.gpkg --symbol disc:2m:8 --symbol-field sym --gap 1 --stats s.json
same "$(jq -c '[.conflicts.before.overlap + .conflicts.before.contained, .conflicts.after, .moved, .skipped, .null, .verified]' s.json)" \
    '[3,{"overlap":0,"too_close":0,"barrier":0,"barrier_drawn":0,"barrier_near":0,"contained":0,"duplicate":0,"inside_blocks":0},3,1,1,true]'
same "$(count o.gpkg trees) $(count o.gpkg trees_symbols) $(count o.gpkg trees_displacement)" '5 5 3'
same "$(value o.gpkg trees_symbols 2 sym)" 'disc:3:12' "attributes of the symbols"
# The symbols in the written layer are separate when checked as polygons, and have the same moves as their points.
expect 0 check o.gpkg -l trees_symbols --gap 1 --no-blocks
expect 0 check o.gpkg -l trees --symbol disc:2:8 --symbol-field sym --gap 1 --no-blocks
expect 3 check p.gpkg --symbol disc:2:8 --symbol-field sym --gap 1
same "$(geometry o.gpkg trees_symbols 4)" '  POLYGON ((451049.5 5411049.5,451050.5 5411049.5,451050.5 5411050.5,451049.5 5411050.5,451049.5 5411049.5))'

layer same.gpkg same POINT <<'X'
id,WKT
1,POINT(451005.3 5411005.7)
2,POINT(451005.3 5411005.7)
3,POINT(451005.3 5411005.7)
X
expect 0 separate same.gpkg s.gpkg --symbol square:4 --stats s.json # coincident symbols become separate, too
same "$(jq -c '[.conflicts.before.duplicate,.conflicts.after.duplicate,.conflicts.after.overlap]' s.json)" '[3,0,0]'
expect 0 separate same.gpkg b.gpkg --symbol square:4 --contained block --stats s.json
same "$(jq -c '[.blocks,.moved]' s.json)" '[1,0]'

layer multi.gpkg m MULTIPOINT <<'X'
id,WKT
1,"MULTIPOINT((0 0),(10 0))"
2,"MULTIPOINT((1 0),(30 0))"
X
expect 0 separate multi.gpkg mo.gpkg --symbol inside-disc:2 -q
same "$(geometry mo.gpkg m_symbols 1 | cut -c1-16)" '  MULTIPOLYGON ('
expect 0 check mo.gpkg -l m_symbols --no-blocks

refused 1 'polygon' separate p.gpkg never.gpkg # points need a symbol
refused 1 'FID 1' separate p.gpkg never.gpkg --symbol-field sym # its symbol is null, and there is no default
refused 1 'no field nothing' separate p.gpkg never.gpkg --symbol-field nothing
refused 2 '--symbol' separate p.gpkg never.gpkg --symbol disc:0
refused 2 '--symbol' separate p.gpkg never.gpkg --symbol circle
refused 2 '--symbol' separate p.gpkg never.gpkg --symbol 'POINT (0 0)'
for empty in 'MULTIPOLYGON EMPTY' 'POLYGON EMPTY'; do
    refused 2 "$empty" separate p.gpkg never.gpkg --symbol "$empty"
    refused 2 "$empty" check p.gpkg --symbol "$empty"
done
says err 'must have an area'
layer hollow.gpkg hollow POINT <<'X'
id,sym,WKT
1,disc:1,POINT(0 0)
2,POLYGON EMPTY,POINT(9 0)
X
refused 1 'FID 2 (POLYGON EMPTY): the symbol is empty' separate hollow.gpkg never.gpkg --symbol-field sym
layer wrong.gpkg wrong POINT <<'X'
id,sym,WKT
1,disc:1,POINT(0 0)
2,disc:-1,POINT(9 0)
X
refused 1 'FID 2' separate wrong.gpkg never.gpkg --symbol-field sym

# Arcs: the computation uses polylines that are dilated by their distance from the arcs; the control points are moved.
layer arcs.gpkg arcs CURVEPOLYGON <<'X'
id,WKT
1,"CURVEPOLYGON(CIRCULARSTRING(0 0,5 5,10 0,5 -5,0 0))"
2,"CURVEPOLYGON(CIRCULARSTRING(9 0,14 5,19 0,14 -5,9 0))"
X
expect 0 separate arcs.gpkg ao.gpkg --stats s.json
same "$(geometry ao.gpkg arcs 1 | cut -c1-29)" '  CURVEPOLYGON (CIRCULARSTRIN'
jq -e '.displacement.total > 1 and .displacement.total < 1.05' s.json >/dev/null || fail "arcs: $(jq -c .displacement s.json)"
finish
