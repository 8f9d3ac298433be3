#!/usr/bin/env bash
# Real layers, if they are beside the repository: no conflict remains, an independent script confirms the guarantees for
# the written file, and check gives the counts of separate.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
data=$SUNDER_SOURCE/../shared/data
look=$SUNDER_SOURCE/tests/cli/separated.py
[ -d "$data" ] || { echo "skipped: no layers in ../shared/data"; exit 77; }
command -v jq >/dev/null || { echo "skipped: jq is not installed"; exit 77; }
/usr/bin/python3 -c 'import osgeo.ogr' 2>/dev/null || { echo "skipped: GDAL's Python module is not installed"; exit 77; }

one() { # name source layer gap
    expect 0 separate --quiet --overwrite --gap "$4" --input-layer "$3" --stats stats.json "$2" out.gpkg
    [ "$status" -eq 0 ] || return
    same "$(jq -c '.conflicts.after | [.overlap, .too_close, .barrier, .contained, .duplicate]' stats.json)" "[0,0,0,0,0]" "$1:"
    same "$(jq -c '[.verified, .rounded, .blocked, .features]' stats.json)" \
        "[true,0,0,$(ogrinfo -ro -so "$2" "$3" | sed -n 's/^Feature Count: //p')]" "$1:"
    /usr/bin/python3 "$look" "$2" "$3" out.gpkg "$4" >looked || { cat looked; fail "$1 at gap $4"; }
    run check --quiet --gap "$4" --input-layer "$3" --no-blocks --block-field sunder_blk --stats check.json out.gpkg
    same "$(jq -c .conflicts check.json)" "$(jq -c .conflicts.after stats.json)" "$1, check:"
}

one krems "$data/krems_2013.gpkg" buildings 0
one jakarta "/vsizip/$data/jakarta_2012_shp.zip" structures 0
gaps=3
[[ ${SUNDER_LAWS:-} != all ]] || gaps="0 3"
for gap in $gaps; do
    one krems "$data/krems_2013.gpkg" buildings $gap
    one neuss "$data/neuss_2026.gpkg" buildings $gap
    one saint_jean "$data/saint_jean_la_poterie.gpkg" buildings $gap
    one baltimore "/vsizip/$data/baltimore_2015_shp.zip" buildings $gap
    one liechtenstein "$data/liechtenstein_2015.gpkg" buildings $gap
    one jakarta "/vsizip/$data/jakarta_2012_shp.zip" structures $gap
done
finish
