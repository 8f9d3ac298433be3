# shellcheck shell=bash disable=SC1091
# No feature leaves a courtyard across its neighbour, unless --allow-jumps is given.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1

# A hut in a courtyard, half a metre from all of its walls, where the gap is a metre; the house around the courtyard is
# fixed.
layer yard.gpkg yards POLYGON <<'X'
id,WKT
1,"POLYGON((0 0,20 0,20 20,0 20,0 0),(5 5,5 15,15 15,15 5,5 5))"
2,"POLYGON((5.5 5.5,14.5 5.5,14.5 14.5,5.5 14.5,5.5 5.5))"
X
expect 3 separate yard.gpkg o.gpkg -q --gap 1 --fixed-where 'id = 1'
same "$(value o.gpkg yards 2 sunder_st)" blocked
# With --contained separate the hut may not go into the wall either: the conflict has a proof, although there is no
# limit.
expect 3 separate yard.gpkg o.gpkg -q --overwrite --gap 1 --fixed-where 'id = 1' --contained separate
same "$(value o.gpkg yards_conflicts 1 reason)" jump
expect 0 separate yard.gpkg o.gpkg -q --overwrite --gap 1 --fixed-where 'id = 1' --allow-jumps
same "$(value o.gpkg yards 2 sunder_st) $(value o.gpkg yards 2 sunder_len | awk '{ print ($1 > 14) }')" 'moved 1'

refused 2 'takes no value' separate yard.gpkg never.gpkg --allow-jumps=yes
refused 2 'is a rule for moves' check yard.gpkg --allow-jumps
finish
