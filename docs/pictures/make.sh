#!/usr/bin/env bash
# Makes the pictures of the pages, beside this file: small scenes and a piece of the synthetic town, each separated by the
# program and drawn before and after by datasets-synthetic/draw.sh.
#
#   make.sh [BUILD]     with the programs of that folder (build/release unless said)
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
source=$(cd "$here/../.." && pwd -P)
PATH=$(cd "${1:-$source/build/release}" && pwd -P):$PATH
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# "KIND<tab>WKT" a line on standard input to the layer NAME of scene.gpkg.
layer() { # name, type, width of roads
    awk -F'\t' -v width="${3+,$3}" 'BEGIN { print "WKT,kind" (width == "" ? "" : ",width") }
        { printf "\"%s\",%s%s\n", $2, $1, width }' >"$1.csv"
    ogr2ogr -q -append -f GPKG scene.gpkg "$1.csv" -nln "$1" -nlt "$2" -a_srs EPSG:25832 -oo GEOM_POSSIBLE_NAMES=WKT \
        -oo KEEP_GEOM_COLUMNS=NO -oo AUTODETECT_TYPE=YES
}
box() { # kind, xmin, ymin, xmax, ymax
    printf '%s\tPOLYGON ((%s %s, %s %s, %s %s, %s %s, %s %s))\n' "$1" "$2" "$3" "$4" "$3" "$4" "$5" "$2" "$5" "$2" "$3"
}
scene() { rm -f scene.gpkg out.gpkg && ogr2ogr -q -f GPKG scene.gpkg "$1" -nln roads -sql "SELECT kind, width, geom FROM roads WHERE fid < 0"; }
draw() { # picture, width and height of the piece, options of separate
    local picture=$1 width=$2 height=$3
    shift 3
    sunder separate --quiet --allow-conflicts -l buildings "$@" scene.gpkg out.gpkg
    bash "$source/datasets-synthetic/draw.sh" scene.gpkg 0 0 "$width" "$height" out.gpkg >"$here/$picture.svg"
}
sunder-town --buildings 280 --seed 1 town.gpkg >/dev/null

# Three in a row that overlap: the one in the middle hardly has to move.
scene town.gpkg
{ box house 10 6 24 18; box house 21 8 35 16; box house 32 6 46 18; } | layer buildings POLYGON
draw share 56 24 --gap 2

# A terrace moves as one, and what weighs more moves less.
scene town.gpkg
{ box house 6 6 14 16; box house 14 6 22 16; box house 22 6 30 16; box shed 28 9 36 14; } | layer buildings POLYGON
draw block 48 22 --gap 2 --touch-tolerance 0 --weight area

# Two houses beside a road that is drawn wider than it is: each stays on its side.
scene town.gpkg
{ box house 8 5 18 13; box house 26 14 36 22; box house 27 6 33 11; } | layer buildings POLYGON
printf 'main_street\tLINESTRING (-10 13, 70 13)\n' | layer roads LINESTRING 7
draw side 48 26 --gap 1 --barrier scene.gpkg,layer=roads,width=7

# A shed in a yard that has no room for it: no jump leads out.
scene town.gpkg
{
    printf 'house\tPOLYGON ((8 3, 28 3, 28 19, 8 19, 8 3), (14 8, 14 14, 22 14, 22 8, 14 8))\n'
    box shed 15 9 20 13
    box shed 34 6 42 14
} | layer buildings POLYGON
draw yard 50 22 --gap 2 --contained separate --touch-tolerance 0

# Seven houses in a row with too little room between them: to alternating sides, or as a row.
scene town.gpkg
for k in 0 1 2 3 4 5 6; do
    box house $((26 + 9 * k)) 11 $((34 + 9 * k)) 19
done | layer buildings POLYGON
draw zigzag 118 30 --gap 4 --touch-tolerance 0 --rows no
rm out.gpkg
draw row 118 30 --gap 4 --touch-tolerance 0

# A street front whose houses have to leave the drawn road, some of them by 0.1 to 0.3 more than they may move: those
# stay, or come as near as they may, in line with the others.
scene town.gpkg
for house in "6 15" "19 16" "32 14" "45 17" "58 13" "71 16"; do
    read -r x tenths <<<"$house"
    y=$(awk -v t="$tenths" 'BEGIN { print 8 + t / 10 }')
    box house "$x" "$y" $((x + 10)) "$(awk -v y="$y" 'BEGIN { print y + 8 }')"
done | layer buildings POLYGON
printf 'main_street\tLINESTRING (-10 8, 100 8)\n' | layer roads LINESTRING 7
draw front_plain 87 26 --gap 1 --max-shift 3 --barrier scene.gpkg,layer=roads,width=7 --rows no --ease no
rm out.gpkg
draw front 87 26 --gap 1 --max-shift 3 --barrier scene.gpkg,layer=roads,width=7

# A terrace on a drawn road is cut back, a house that keeps too little is left out, and one makes room.
scene town.gpkg
{
    for k in 0 1 2 3 4; do box house $((8 + 8 * k)) $((9 + k % 2)) $((16 + 8 * k)) 20; done
    box house 52 5 60 10
    box house 56 10.5 66 20
} | layer buildings POLYGON
printf 'main_street\tLINESTRING (-10 6, 100 6)\n' | layer roads LINESTRING 8
rm -f out.gpkg
draw cut 74 26 --gap 1 --max-shift 0.6 --hide --trim --crossed hide --barrier scene.gpkg,layer=roads,width=8

# A quarter of an old town at 1:25 000, with the options of the page of the guide.
sunder-town --buildings 280 --seed 7 old.gpkg >/dev/null
sunder separate --quiet --allow-conflicts -l buildings --scale 25000 --gap 0.1mm --max-shift 0.3mm --crossed trim \
    --barrier old.gpkg,layer=roads,width=0.5mm --hide --trim --trim-keep 0.3 --inset 0.05mm,0.1mm --enlarge \
    --min-size 0.3mm --symbol-size 0.3mm --overwrite old.gpkg out.gpkg
ogrinfo -q old.gpkg -sql "UPDATE roads SET width = 12.5" >/dev/null
bash "$source/datasets-synthetic/draw.sh" old.gpkg 451255 5411160 451385 5411262 out.gpkg >"$here/old_town.svg"

# A piece of the town for a map at 1:25 000: roads 0.3 mm wide, 0.1 mm of paper between.
sunder separate --quiet --allow-conflicts -l buildings --scale 25000 --gap 0.1mm --max-shift 0.4mm \
    --barrier town.gpkg,layer=roads,width=0.3mm --overwrite town.gpkg out.gpkg
ogrinfo -q town.gpkg -sql "UPDATE roads SET width = 7.5" >/dev/null
bash "$source/datasets-synthetic/draw.sh" town.gpkg 451222 5411190 451385 5411300 out.gpkg >"$here/roads.svg"
