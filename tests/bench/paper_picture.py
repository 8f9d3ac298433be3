"""paper_picture.py TITLE P Q SUM [FACES]: P, Q and their sum side by side at the same scale, as SVG.

P, Q: files of one WKT each, without holes. SUM: the JSON of `sunder sum`. FACES: the layer sum_faces of
`--planar-map` as GeoJSON; the cells of the sum are then shaded by the number of subsums that cover them. Degenerate
segments and points are drawn in red, with a width that does not scale.
"""
import json
import re
import sys
from xml.sax.saxutils import escape

PANEL, MARGIN, HEAD = 420, 16, 44
STYLE = """
.p{fill:#cfd8e3;stroke:#3b4a5a}.q{fill:#f0d9b5;stroke:#7d5a1e}.sum{fill:#d5e8d4;stroke:#2f5f2f}
.p,.q{fill-opacity:.7}.p,.q,.sum{stroke-width:.8;fill-rule:evenodd;stroke-linejoin:round}
.face{fill:#1f5f55;stroke:#1f5f55;stroke-width:.2;fill-rule:evenodd}
.segment{stroke:#d0006f;stroke-width:2.4;stroke-linecap:round}.point{fill:#d0006f}
text{font:14px sans-serif;fill:#222}.label{font-size:12px;fill:#555}
"""


def rings_of_wkt(text):
    numbers = re.findall(r"\(([^()]+)\)", text)
    return [[tuple(map(float, pair.split())) for pair in ring.split(",")] for ring in numbers]


def polygon_rings(polygon):
    return [polygon["outer"]] + polygon["holes"]


def extent(rings):
    xs = [x for ring in rings for x, _ in ring] or [0, 1]
    ys = [y for ring in rings for _, y in ring] or [0, 1]
    return min(xs), min(ys), max(xs), max(ys)


def width(rings):
    x0, y0, x1, y1 = extent(rings)
    return max(x1 - x0, y1 - y0)


class Panel:
    """A square of the picture, centred on the rings."""

    def __init__(self, number, rings, scale):
        x0, y0, x1, y1 = extent(rings)
        self.left, self.top, self.scale = MARGIN + number * (PANEL + MARGIN), HEAD, scale
        self.x0 = (x0 + x1 - PANEL / scale) / 2
        self.y1 = (y0 + y1 + PANEL / scale) / 2

    def at(self, point):
        return (f"{self.left + (point[0] - self.x0) * self.scale:.2f}",
                f"{self.top + (self.y1 - point[1]) * self.scale:.2f}")

    def path(self, rings, style, extra=""):
        steps = "".join("M" + "L".join(",".join(self.at(v)) for v in ring) + "Z" for ring in rings)
        return f'<path class="{style}" d="{steps}"{extra}/>'


def faces(panel, file):
    """Cells by the number of covering subsums: the opacity grows with the root of the number, so that small and large
    numbers can both be distinguished."""
    features = json.load(open(file))["features"]
    most = max((f["properties"]["covered_by"] or 0 for f in features), default=1)
    for feature in features:
        count = feature["properties"]["covered_by"]
        geometry = feature["geometry"]
        if not count or not geometry:
            continue
        parts = geometry["coordinates"] if geometry["type"] == "MultiPolygon" else [geometry["coordinates"]]
        opacity = 0.1 + 0.8 * (count / most) ** 0.5
        for rings in parts:
            yield panel.path(rings, "face", f' fill-opacity="{opacity:.2f}"')


def main():
    title, p_file, q_file, sum_file = sys.argv[1:5]
    p, q = (rings_of_wkt(open(file).read()) for file in (p_file, q_file))
    whole = json.load(open(sum_file))
    result, polygons = whole["result"], whole["polygons"]
    rings = [ring for polygon in polygons for ring in polygon_rings(polygon)]
    w, h = 3 * (PANEL + MARGIN) + MARGIN, PANEL + HEAD + MARGIN
    print(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {w} {h}" width="{w}" height="{h}">')
    print(f"<title>{escape(title)}</title><style>{STYLE}</style>")
    print(f'<rect width="{w}" height="{h}" fill="#fff"/><text x="{MARGIN}" y="18">{escape(title)}</text>')
    labels = (f'P: {whole["p"]["vertices"]} vertices', f'Q: {whole["q"]["vertices"]} vertices',
              f'sum: {result["vertices"]} vertices, {result["holes"]} holes, {result["degenerate_segments"]} degenerate segments, '
              f'{result["degenerate_points"]} points')
    scale = PANEL / (max(width(p), width(q), width(rings)) or 1)
    panels = [Panel(number, of, scale) for number, of in enumerate((p, q, rings))]
    for panel, label in zip(panels, labels):
        print(f'<text class="label" x="{panel.left}" y="36">{escape(label)}</text>')
    for panel, operand, style in zip(panels, (p, q), "pq"):
        for ring in operand:
            print(panel.path([ring], style))
    for polygon in polygons:
        print(panels[2].path(polygon_rings(polygon), "sum"))
    if len(sys.argv) > 5:
        print("\n".join(faces(panels[2], sys.argv[5])))
    for a, b in whole["degenerate_segments"]:
        (x1, y1), (x2, y2) = panels[2].at(a), panels[2].at(b)
        print(f'<line class="segment" x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}"/>')
    for point in whole["degenerate_points"]:
        x, y = panels[2].at(point)
        print(f'<circle class="point" cx="{x}" cy="{y}" r="3.2"/>')
    print("</svg>")


main()
