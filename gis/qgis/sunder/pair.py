"""The algorithm sunder:pair, which runs `sunder pair`."""
from .algorithm import LINES, POLYGONS, Algorithm, Input, Output
from .sum import SHAPES


class Pair(Algorithm):
    command = "pair"
    title = "Least move that separates two shapes"
    text = """The shortest translation of Q that separates its interior from P, exactly.

Each of P and Q is a layer, whose polygons are one set together, or a shape: square:6, rectangle:4x3, disc:3, or WKT of a
polygon. The result is a layer with this translation as a line."""
    main = "pair"
    group_name = "Shapes"
    inputs = (Input("P", "P: a layer, which stays", (POLYGONS,), "P_SHAPE", "or P as a shape: " + SHAPES),
              Input("Q", "Q: a layer, which is moved", (POLYGONS,), "Q_SHAPE", "or Q as a shape: " + SHAPES))
    outputs = (Output("OUTPUT", "", "Least move", LINES, True, None),)
    numbers = (("DX", "To the east"), ("DY", "To the north"), ("DISTANCE", "Length"))

    def figures(self, figures):
        if not figures:
            return {}
        return {"DX": _decimal(figures["dx"]), "DY": _decimal(figures["dy"]), "DISTANCE": figures["distance"]}


def _decimal(rational):
    """Returns the double nearest to a rational, which is the text num/den or num."""
    over, _, under = str(rational).partition("/")
    return int(over) / int(under or 1)
