"""The algorithm sunder:sum, which runs `sunder sum`."""
from .algorithm import LINES, POINTS, POLYGONS, Algorithm, Input, Output

SHAPES = "square:6, rectangle:4x3, disc:3 or WKT"


class Sum(Algorithm):
    command = "sum"
    title = "Minkowski sum"
    text = """The Minkowski sum of two polygonal sets, exactly: all points p + q.

Each of P and Q is a layer, whose polygons are one set together, or a shape: square:6, rectangle:4x3, disc:3, or WKT of a
polygon. Segments and points where one exactly fits the other are layers of their own, and so is the planar map
of the sum."""
    main = "sum"
    group_name = "Shapes"
    inputs = (Input("P", "P: a layer", (POLYGONS,), "P_SHAPE", "or P as a shape: " + SHAPES),
              Input("Q", "Q: a layer", (POLYGONS,), "Q_SHAPE", "or Q as a shape: " + SHAPES))
    outputs = (
        Output("OUTPUT", "", "Sum", POLYGONS, True, None),
        Output("SEGMENTS", "_degenerate_segments", "Degenerate segments", LINES, False, None),
        Output("POINTS", "_degenerate_points", "Degenerate points", POINTS, False, None),
        Output("FACES", "_faces", "Planar map: faces", POLYGONS, False, "--planar-map"),
        Output("EDGES", "_edges", "Planar map: edges", LINES, False, "--planar-map"),
        Output("VERTICES", "_vertices", "Planar map: vertices", POINTS, False, "--planar-map"),
    )
    numbers = (("POLYGONS", "Polygons"), ("HOLES", "Holes"), ("CORNERS", "Vertices"))

    def figures(self, figures):
        if not figures:
            return {}
        found = figures["result"]
        return {"POLYGONS": found["polygons"], "HOLES": found["holes"], "CORNERS": found["vertices"]}
