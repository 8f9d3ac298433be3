# shellcheck shell=bash disable=SC1091
# A layer beside barriers, and a layer of points with symbols, give the same output in parts as a whole.
. "$SUNDER_SOURCE/tests/cli/lib.sh" || exit 1
. "$SUNDER_SOURCE/tests/cli/parts.sh" || exit 1

# Barriers: roads through the whole layer with different widths, meadows, one that is near a feature only at one end,
# and one that is near none.
python3 - <<'PYTHON' || fail "no barriers are made"
import json, random, re, subprocess
random.seed(3)
told = subprocess.run(['ogrinfo', '-so', 'town.gpkg', 'buildings'], capture_output=True, text=True).stdout
x, y, X, Y = map(float, re.search(r'Extent: \((.*), (.*)\) - \((.*), (.*)\)', told).groups())
def write(name, features):
    json.dump({'type': 'FeatureCollection', 'name': name, 'features': features}, open(name + '.geojson', 'w'))
def feature(kind, at, **fields):
    return {'type': 'Feature', 'properties': fields, 'geometry': {'type': kind, 'coordinates': at}}
roads = [feature('LineString', [[x + (X - x) * t / 40, y + (Y - y) * ((t / 40 * k) % 1)] for t in range(41)], w=k * 2.0)
         for k in range(1, 4)]
for k in range(300):
    a, b = random.uniform(x, X), random.uniform(y, Y)
    roads.append(feature('LineString', [[a, b], [a + random.uniform(-30, 30), b + random.uniform(-30, 30)]], w=None if k % 3 else 1.5))
roads.append(feature('LineString', [[x + 50, y + 50], [x - 1e5, y - 1e5]], w=1.0))
roads.append(feature('LineString', [[x - 1e5, y - 2e5], [x - 2e5, y - 2e5]], w=70.0))
write('roads', roads)
meadows = []
for k in range(40):
    a, b, s = random.uniform(x, X), random.uniform(y, Y), random.uniform(5, 60)
    meadows.append(feature('Polygon', [[[a, b], [a + s, b], [a + s, b + s], [a, b + s], [a, b]]]))
write('meadows', meadows)
PYTHON
for name in roads meadows; do
    ogr2ogr -q -nln $name -a_srs EPSG:25832 $name.gpkg $name.geojson || fail "$name.gpkg is not made"
done
alike o.gpkg 99M --gap 1 --effort 0 --max-shift 2 --barrier roads.gpkg,width-field=w
drawn o.gpkg 103M --gap 1 --effort 0 --max-shift 2 --barrier roads.gpkg,width=5,gap=0,side=no \
    --barrier meadows.gpkg,gap=1 --barrier "roads.gpkg,where=w > 3" --id-field id
alike o.gpkg 99M --gap 1 --effort 0 --rows auto --max-shift 2 --barrier roads.gpkg,width-field=w --barrier meadows.gpkg
alike o.gpkg 99M --gap 1 --effort 0 --max-shift 2 --barrier meadows.gpkg,as=boundary,gap=0 --touch-tolerance 0.01
alike o.gpkg 99M --gap 1 --effort 0 --max-shift 2 --barrier "roads.gpkg,where=w > 60"

# Points, whose symbols are written to a layer of their own: squares; symbols with a kind and a size of their own;
# discs.
ogr2ogr -q points.gpkg town.gpkg -nln buildings -nlt POINT -dialect SQLite -sql "select st_centroid(geom) as geom,
        case when fid % 3 then 'square:6' else 'disc:4' end as drawn, 1 + (fid % 4) / 4.0 as larger, fid % 17 as kind
        from buildings" && mv points.gpkg town.gpkg || fail "no points are made"
alike o.gpkg 99M --symbol square:9 --effort 0
drawn o.gpkg 103M --symbol-field drawn --symbol-size-field larger --effort 0 --max-shift 5 \
    --barrier roads.gpkg,width=2,gap=0 --where 'kind < 9' --weight-field larger
alike o.geojson 99M --symbol disc:4 --effort 0 --layers symbols
alike o.shp 99M --symbol disc:4 --effort 0 --layers main,symbols
finish
