"""The algorithm sunder:buffer, which runs `sunder buffer`."""
from .algorithm import LINES, POINTS, POLYGONS, Algorithm, Input, Output


class Buffer(Algorithm):
    command = "buffer"
    title = "Buffer by a shape"
    text = """Grows, shrinks, opens or closes polygons by a shape, exactly.

With a square right angles stay right angles; round buffers would leave arcs of short segments. Closing with Dissolve
merges buildings that are near each other into blocks. Intermediate results are exact; the final result is rounded once
and is valid."""
    main = "buffered"
    inputs = (Input("INPUT", "Layer", (POLYGONS,), None, None),)
    outputs = (
        Output("OUTPUT", "", "Buffered", POLYGONS, True, None),
        Output("SEGMENTS", "_degenerate_segments", "Degenerate segments", LINES, False, "--degenerate"),
        Output("POINTS", "_degenerate_points", "Degenerate points", POINTS, False, "--degenerate"),
    )
    numbers = (("FEATURES", "Features"), ("EMPTY", "Features of which nothing is left"), ("AREA", "Area"))

    def figures(self, figures):
        return {"FEATURES": figures["features"], "EMPTY": figures["empty"], "AREA": figures["area"]} if figures else {}
