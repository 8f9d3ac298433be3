# shellcheck shell=bash
# A separated layer opens in QGIS with the styles stored in its GeoPackage: every status has its colour, arrows and
# conflicts are drawn over the buildings. Colours are those of gis/gpkg/style_qml.c.
set -eu
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# The modules of QGIS are installed for the system's Python, which may not be the first python3 on the path.
python=/usr/bin/python3
"$python" -c 'import qgis.core' 2>/dev/null || { echo "skipped: QGIS's Python modules (python3-qgis) are not installed"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$1"; exit 1; }

# A temporary profile, no screen.
mkdir -m 700 "$work/home" "$work/run"
export QT_QPA_PLATFORM=offscreen HOME=$work/home XDG_RUNTIME_DIR=$work/run QGIS_CUSTOM_CONFIG_PATH=$work/profile

# Options with which some features stay blocked, some are fixed, and some are ignored.
town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg
"$SUNDER" separate --input-layer buildings --gap 3 --max-shift 1 --fixed-where 'fid % 7 = 0' --ignore-where 'fid % 11 = 0' \
    --allow-conflicts --quiet "$town" "$work/out.gpkg"

"$python" "$here/render_colours.py" "$work/out.gpkg" "$work/picture.png" \
    buildings buildings_displacement buildings_conflicts -- \
    unmoved=190,190,190=50 moved=27,158,119=50 fixed=64,64,64=50 blocked=215,25,28=50 skipped=235,235,230=50 \
    arrows=31,78,200=50 conflicts=231,0,138=50 || fail "the picture lacks a colour"
cp "$work/picture.png" "${SUNDER_BUILD:-$work}/qgis_colours.png" 2>/dev/null || true

# Conflicts have different symbols for different partners, and for proved and unresolved ones: an unresolved one is a
# thin line with a ring. Kind and reason are set in the table of conflicts, so that all combinations occur independently
# of the town.
rows() { # value of kind, value of reason as SQL
    cp "$work/out.gpkg" "$work/rows.gpkg"
    sqlite3 "$work/rows.gpkg" "DELETE FROM layer_styles WHERE f_table_name = 'buildings';
        UPDATE buildings_conflicts SET kind = '$1', reason = $2;" 2>/dev/null ||
        ogrinfo -q -dialect sqlite -sql "UPDATE buildings_conflicts SET kind = '$1', reason = $2" "$work/rows.gpkg"
    shift 2
    "$python" "$here/render_colours.py" "$work/rows.gpkg" "$work/rows.png" buildings_conflicts -- "$@"
}
rows overlap "'no_room'" proved=231,0,138=600 || fail "a proved conflict is not magenta"
proved=$(rows overlap "'no_room'" proved=231,0,138=0 | sed -n 's/^proved.*: \([0-9]*\) pixels.*/\1/p')
unresolved=$(rows overlap "'unresolved'" unresolved=231,0,138=100 | sed -n 's/^unresolved.*: \([0-9]*\) pixels.*/\1/p')
[ "$unresolved" -lt $((proved * 8 / 10)) ] || fail "unresolved conflicts look like proved ones: $unresolved and $proved pixels"
rows barrier "'max_shift'" barrier=106,27,154=600 || fail "a conflict with a barrier is not violet"
rows barrier_near "'unresolved'" barrier=106,27,154=100 || fail "a conflict near a barrier is not violet"
rows barrier_drawn "'max_shift'" barrier=106,27,154=600 || fail "a conflict with what is drawn of a barrier is not violet"
rows contained "'kept'" kept=150,150,150=600 || fail "an allowed conflict is not grey"
rows too_close NULL found=231,0,138=600 || fail "a conflict without a reason is not magenta"

# Pushes are not drawn until their box in the legend is ticked. The greater the force, the wider the line. If all forces
# are equal, all lines have the greatest width; if one force is much greater, the lines of the others are thin.
cp "$work/out.gpkg" "$work/pushes.gpkg"
ogrinfo -q -dialect sqlite -sql "UPDATE buildings_pushes SET force = 1" "$work/pushes.gpkg"
drawn() { # layer, least number of pixels: prints the number of pixels
    "$python" "$here/render_colours.py" "$work/pushes.gpkg" "$work/pushes.png" "$1" -- pushes=106,61,154="$2" |
        sed -n 's/^pushes.*: \([0-9]*\) pixels.*/\1/p'
}
[ "$(drawn buildings_pushes 0)" = 0 ] || fail "pushes are drawn before their box is marked"
wide=$(drawn buildings_pushes! 50)
ogrinfo -q -dialect sqlite -sql "UPDATE buildings_pushes SET force = 0.0001 WHERE fid > 1" "$work/pushes.gpkg"
thin=$(drawn buildings_pushes! 50)
[ "$wide" -gt 50 ] && [ "$thin" -lt $((wide * 7 / 10)) ] || fail "pushes are not drawn by their force: $wide and $thin pixels"

# Features with a smaller or a larger shape are hatched in the colour of their outlines.
"$SUNDER" separate --input-layer buildings --gap 3 --max-shift 1 --inset 0.5,1 --hide --allow-conflicts --quiet "$town" "$work/rungs.gpkg"
hatched() { # rung, share of the area lost: prints the number of pixels in the colour of the outlines of moved features
    ogrinfo -q -dialect sqlite -sql "UPDATE buildings SET sunder_lvl = $1, sunder_cut = $2, sunder_st = 'moved'" "$work/rungs.gpkg" >/dev/null
    "$python" "$here/render_colours.py" "$work/rungs.gpkg" "$work/rungs.png" buildings -- outline=15,95,70=0 |
        sed -n 's/^outline.*: \([0-9]*\) pixels.*/\1/p'
}
given=$(hatched 0 0) smaller=$(hatched 1 0.1) larger=$(hatched 0 -0.5)
[ "$smaller" -gt $((given * 2)) ] || fail "smaller features are not hatched: $given pixels, and $smaller"
[ "$larger" -gt $((given * 2)) ] || fail "larger features are not hatched: $given pixels, and $larger"

# Without stored styles QGIS draws in a random colour of its own: then none of ours may be found, otherwise this test
# could not fail.
"$SUNDER" separate --input-layer buildings --gap 3 --max-shift 1 --allow-conflicts --no-styles --quiet \
    "$town" "$work/plain.gpkg"
if "$python" "$here/render_colours.py" "$work/plain.gpkg" "$work/plain.png" buildings -- \
    moved=27,158,119=50 blocked=215,25,28=50; then
    fail "our colours appear without our styles"
fi
