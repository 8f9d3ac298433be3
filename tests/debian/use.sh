# Runs in a root where the packages are installed, and no sources of Sunder: does each package work?
set -eu
work=$(mktemp -d)
cd "$work"
expect() { # WHAT GOT WANTED
    if [ "$2" != "$3" ]; then
        echo "$1: '$2' instead of '$3'"
        exit 1
    fi
    echo "$1: $3"
}

sunder --version | head -n 3
cat >town.geojson <<'GEOJSON'
{"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32633"}}, "features": [
{"type": "Feature", "properties": {"name": "a"}, "geometry": {"type": "Polygon", "coordinates": [[[0,0],[10,0],[10,10],[0,10],[0,0]]]}},
{"type": "Feature", "properties": {"name": "b"}, "geometry": {"type": "Polygon", "coordinates": [[[8,1],[18,1],[18,9],[8,9],[8,1]]]}}]}
GEOJSON
status=0
sunder check town.geojson --quiet >/dev/null || status=$?
expect "check before: status" $status 3
sunder separate town.geojson apart.gpkg --gap 1m --report apart.html --quiet
sunder check apart.gpkg --input-layer town --gap 1m --quiet >/dev/null
ogrinfo -so apart.gpkg town | grep -q sunder_dx
test -s apart.html
echo "separate: apart"
expect "sum: area" "$(sunder sum 'POLYGON((0 0,4 0,4 4,0 4,0 0))' rectangle:1x2 | grep -o '"area": "[0-9]*' | grep -o '[0-9]*$')" 30
man -w sunder >/dev/null
bash -n /usr/share/bash-completion/completions/sunder
# shellcheck disable=SC2046 # words
gcc -std=c17 -Wall -Werror /tmp/sum.c -o sum $(pkg-config --cflags --libs sunder)
expect "library: area" "$(./sum)" 30
# Debian 12's script qgis_process passes an option that QGIS does not know; the binary is installed next to it.
qgis_process=$(command -v qgis_process.bin || command -v qgis_process)
export XDG_RUNTIME_DIR="$work"
$qgis_process plugins enable sunder >plugins.txt 2>&1 || { cat plugins.txt; exit 1; }
expect "QGIS: algorithms" "$($qgis_process list 2>/dev/null | grep -c 'sunder:')" 6
$qgis_process run sunder:separate --distance_units=meters -- INPUT="$work/town.geojson" GAP=1 OUTPUT="$work/plugin.gpkg" \
    >run.txt 2>&1 || { cat run.txt; exit 1; }
test -s plugin.gpkg || { cat run.txt; exit 1; }
echo "QGIS: separated"
rm -rf "$work" /tmp/sum.c /tmp/use.sh
