# shellcheck shell=bash
# The output appears completely or not at all: existing data are replaced only on request, and a run that fails leaves
# the directory unchanged.
set -eu
. "$(dirname "${BASH_SOURCE[0]}")/io_layers.sh"
make_squares
separate() { "$SUNDER" separate --quiet --input-layer squares "$@"; }
layers() { ogrinfo -ro -q "$1" | sed -n 's/^[0-9]*: \(.*\) (.*/\1/p' | sort | tr '\n' ' '; }
sum() { cat "$@" | cksum; }
refused_squares() { refused "$1" "$2" separate "${@:3}"; }

# ---- one file
separate squares.gpkg out.gpkg
[ "$(layers out.gpkg)" = 'layer_styles squares squares_conflicts squares_displacement squares_pushes squares_rows ' ] || fail "layers: $(layers out.gpkg)"
before=$(sum out.gpkg)
refused_squares 1 'exists already' squares.gpkg out.gpkg
[ "$(sum out.gpkg)" = "$before" ] || fail "a refused run changed the output"
separate --overwrite squares.gpkg out.gpkg
separate --overwrite --layers main squares.gpkg out.gpkg
[ "$(layers out.gpkg)" = 'layer_styles squares ' ] || fail "--overwrite kept old layers"

# ---- --update
refused_squares 1 'has a layer squares already' --update squares.gpkg out.gpkg
separate --update --output-layer apart squares.gpkg out.gpkg
[ "$(layers out.gpkg)" = 'apart apart_conflicts apart_displacement apart_pushes apart_rows layer_styles squares ' ] || fail "layers: $(layers out.gpkg)"
ogrinfo -q -ro out.gpkg -sql 'SELECT f_table_name FROM layer_styles' >styles
[ "$(grep -c 'f_table_name (String) = ' styles)" = 6 ] || fail "not every layer has a style"
refused_squares 2 'no_such' --update --output-layer apart --overwrite-layer --where 'no_such = 1' squares.gpkg out.gpkg
separate --update --overwrite-layer --output-layer apart --where "name <> 'two'" squares.gpkg out.gpkg
[ "$(ogrinfo -ro -so out.gpkg apart | sed -n 's/^Feature Count: //p')" = 2 ] || fail "--overwrite-layer kept the old layer"
[ "$(ogrinfo -ro -so out.gpkg squares | sed -n 's/^Feature Count: //p')" = 3 ] || fail "--overwrite-layer touched another"
ogrinfo -q -ro out.gpkg -sql 'SELECT f_table_name FROM layer_styles' >styles
[ "$(grep -c 'f_table_name (String) = ' styles)" = 6 ] || fail "styles of a replaced layer stay"

# ---- input and output
before=$(sum squares.gpkg)
refused_squares 1 'the same' squares.gpkg squares.gpkg
refused_squares 1 'the same' --overwrite squares.gpkg squares.gpkg
ln -s squares.gpkg alias.gpkg
refused_squares 1 'the same' --overwrite squares.gpkg alias.gpkg
refused_squares 1 'input itself' --update --overwrite-layer squares.gpkg squares.gpkg
[ "$(sum squares.gpkg)" = "$before" ] || fail "a refused run changed the input"
separate --update --output-layer apart squares.gpkg squares.gpkg
[ "$(layers squares.gpkg)" = 'apart apart_conflicts apart_displacement apart_pushes apart_rows layer_styles lines squares ' ] ||
    fail "layers: $(layers squares.gpkg)"

# ---- several files: Shapefile
separate squares.gpkg out.shp
[ -e out.dbf ] && [ -e out_displacement.shp ] && [ -e out_conflicts.dbf ] || fail "files of the Shapefile are missing"
before=$(sum out*.shp out*.dbf)
refused_squares 1 'exists already' squares.gpkg out.shp
rm out.shp # only one file of the set exists already
refused_squares 1 'exists already' squares.gpkg out.shp
separate --overwrite squares.gpkg out.shp
[ "$(sum out*.shp out*.dbf)" = "$before" ] || fail "--overwrite did not make the same files again"
refused 1 'are the same' "$SUNDER" separate --overwrite out.shp out.shp
echo keep >aside.dbf
refused_squares 1 'aside.dbf.*exists already' squares.gpkg aside.shp
[ "$(ls aside*)" = aside.dbf ] && [ "$(cat aside.dbf)" = keep ] || fail "undoing left: $(ls aside*)"

mkdir out_displacement.sbn && rm out_displacement.dbf && mkdir out_displacement.dbf && echo keep >out_displacement.dbf/file
before=$(sum out*.shp out*.shx out.dbf out_displacement.dbf/file)
refused_squares 1 'out_displacement.dbf is a directory' --overwrite --gap 5 squares.gpkg out.shp
[ "$(sum out*.shp out*.shx out.dbf out_displacement.dbf/file)" = "$before" ] || fail "a refused run changed the output"

# ---- an output that is not a dataset; a directory
mkdir precious && echo keep >precious/file
refused_squares 1 'not replaced' --of 'ESRI Shapefile' --overwrite squares.gpkg precious
[ "$(cat precious/file)" = keep ] || fail "a directory was replaced"
separate --of 'ESRI Shapefile' squares.gpkg shapes
[ -e shapes/squares.shp ] && [ -e shapes/squares_displacement.shp ] || fail "a directory of Shapefiles was not made"
separate --of 'ESRI Shapefile' --update --output-layer more squares.gpkg shapes
[ -e shapes/squares.shp ] && [ -e shapes/more.shp ] || fail "a directory of Shapefiles was not added to"

# ---- directories that cannot be written
refused_squares 1 'cannot write in' squares.gpkg missing/out.gpkg
mkdir closed && chmod 555 closed
if [ ! -w closed ]; then # root may write to every directory
    refused_squares 1 'cannot write in' squares.gpkg closed/out.gpkg
fi
refused_squares 1 'cannot write in' squares.gpkg /proc/out.gpkg
refused_squares 2 'the format is not known from the name' squares.gpkg out
refused_squares 2 'no such format' --of Nonsense squares.gpkg other.gpkg

# ---- a full disk: every format must notice. A limit on the size of files gives the same errors without a device.
"$SUNDER_BUILD/sunder-town" --buildings 3000 --seed 1 town.gpkg >/dev/null
full() { (trap '' XFSZ; ulimit -f 300; exec "$SUNDER" separate --quiet --input-layer buildings "$@"); }
for each in gpkg shp geojson fgb sqlite csv; do
    refused 1 "full.$each" full town.gpkg "full.$each"
    [ -z "$(ls full* 2>/dev/null)" ] || fail "a full disk left $(ls full*)"
done
before=$(sum out.gpkg)
refused 1 out.gpkg full --overwrite town.gpkg out.gpkg
refused 1 out.gpkg full --update --output-layer town town.gpkg out.gpkg
[ "$(sum out.gpkg)" = "$before" ] || fail "a full disk changed an existing file"
if [ -e /dev/full ]; then
    status=0
    separate --of GeoJSON squares.gpkg /vsistdout/ >/dev/full 2>message || status=$?
    [ "$status" = 1 ] && grep -q 'cannot be written' message || fail "a full standard output was not noticed"
fi
[ -z "$(ls -d .sunder-* 2>/dev/null)" ] || fail "staging directories are left"
