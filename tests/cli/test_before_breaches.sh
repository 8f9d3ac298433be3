# shellcheck shell=bash disable=SC1091
# check --before finds no violation in the output of separate, and finds each of ten constructed violations of each rule
# (before_breaches.py): for a town, and for maps if they are beside the repository. SUNDER_LAWS=all tests all maps.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
/usr/bin/python3 -c 'import osgeo.ogr' 2>/dev/null || { echo "skipped: GDAL's Python module is not installed"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1

# asked NAME SOURCE LAYER
asked() {
    /usr/bin/python3 "$SUNDER_SOURCE/tests/cli/before_breaches.py" "$SUNDER" "$2" "$3" "$2,layer=roads,width=5" 3 10 >said ||
        fail "$1: $(cat said)"
    echo "$1: $(tail -n 1 said)"
}

asked town "$SUNDER_SOURCE/datasets-synthetic/town.gpkg" buildings
data=$SUNDER_SOURCE/../shared/data
if [ ! -d "$data" ]; then
    echo "without $data: the town alone"
else
    asked saint-jean "$data/saint_jean_la_poterie.gpkg" buildings
    if [ "${SUNDER_LAWS:-}" = all ]; then
        asked krems "$data/krems_2013.gpkg" buildings
        asked neuss "$data/neuss_2026.gpkg" buildings
        asked liechtenstein "$data/liechtenstein_2015.gpkg" buildings
        asked baltimore "/vsizip/$data/baltimore_2015_shp.zip" buildings
        asked jakarta "/vsizip/$data/jakarta_2012_shp.zip" structures
        asked paris "$data/paris_cite_2014.gpkg" buildings
    fi
fi
finish
