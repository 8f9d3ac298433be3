# shellcheck shell=bash
# A separated layer opens in QGIS with the looks that its GeoPackage carries: every status has its colour, arrows and
# conflicts are drawn over the buildings. Colours are those of gis/write/style_qml.c.
set -eu
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
python=/usr/bin/python3 # QGIS's modules belong to the system's Python, whatever python3 is first on the path
"$python" -c 'import qgis.core' 2>/dev/null || { echo "skipped: QGIS's Python modules (python3-qgis) are not installed"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$1"; exit 1; }

# A throw-away profile, no screen.
mkdir -m 700 "$work/home" "$work/run"
export QT_QPA_PLATFORM=offscreen HOME=$work/home XDG_RUNTIME_DIR=$work/run QGIS_CUSTOM_CONFIG_PATH=$work/profile

# A cap so short that some stay blocked, some houses that stand fast, some that are left aside.
town=$SUNDER_SOURCE/datasets-synthetic/town.gpkg
"$SUNDER" separate --input-layer buildings --gap 3 --max-shift 1 --fixed-where 'fid % 7 = 0' --ignore-where 'fid % 11 = 0' \
    --allow-conflicts --quiet "$town" "$work/out.gpkg"

"$python" "$here/render_colours.py" "$work/out.gpkg" "$work/picture.png" \
    buildings buildings_displacement buildings_conflicts -- \
    unmoved=190,190,190=50 moved=27,158,119=50 fixed=64,64,64=50 blocked=215,25,28=50 skipped=235,235,230=50 \
    arrows=31,78,200=50 conflicts=231,0,138=50 || fail "the picture lacks a colour"
cp "$work/picture.png" "${SUNDER_BUILD:-$work}/qgis_colours.png" 2>/dev/null || true

# Without styles QGIS draws one colour of its own choice: then none of ours may be there, or the test proves nothing.
"$SUNDER" separate --input-layer buildings --gap 3 --max-shift 1 --allow-conflicts --no-styles --quiet \
    "$town" "$work/plain.gpkg"
if "$python" "$here/render_colours.py" "$work/plain.gpkg" "$work/plain.png" buildings -- \
    moved=27,158,119=50 blocked=215,25,28=50; then
    fail "our colours appear without our styles"
fi
