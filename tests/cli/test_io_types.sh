# shellcheck shell=bash
# Layers of every declared type: curves, surfaces, collections, unknown; names with quotes; FIDs that are 0, negative or
# huge; CRSs with other axes and units, compound, without authority, none. All of it is kept, and features that are not
# polygons are copied unchanged.
set -eu
. "$(dirname "${BASH_SOURCE[0]}")/io_layers.sh"
look=$SUNDER_SOURCE/tests/cli/io_types.py
/usr/bin/python3 -c 'import osgeo.ogr' 2>/dev/null || { echo "skipped: GDAL's Python module is not installed"; exit 77; }

/usr/bin/python3 "$look" make in.gpkg >names
[ "$(wc -l <names)" -ge 9 ] || fail "the layers were not made"
cp in.gpkg both.gpkg
while IFS= read -r name; do
    rm -f out.gpkg
    "$SUNDER" separate --quiet --strict --gap 1 --no-blocks --contained separate --input-layer "$name" in.gpkg out.gpkg \
        2>warnings || { cat warnings; fail "layer $name"; }
    /usr/bin/python3 "$look" compare in.gpkg "$name" out.gpkg >looked || { cat looked; fail "layer $name"; }
    "$SUNDER" separate --quiet --gap 1 --no-blocks --contained separate --input-layer "$name" --update \
        --output-layer "$name 2" both.gpkg both.gpkg 2>warnings || { cat warnings; fail "update with layer $name"; }
    /usr/bin/python3 "$look" compare in.gpkg "$name" both.gpkg "$name 2" >looked || { cat looked; fail "update, layer $name"; }
done <names
# Existing layers are unchanged.
while IFS= read -r name; do
    [ "$(dump in.gpkg "$name" | cksum)" = "$(dump both.gpkg "$name" | cksum)" ] || fail "an update changed layer $name"
done <names
