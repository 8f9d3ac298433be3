"""The algorithm sunder:route, which runs `sunder route`."""
from .algorithm import ANY, LINES, POINTS, POLYGONS, Algorithm, Input, Output


class Route(Algorithm):
    command = "route"
    title = "Route among obstacles"
    text = """The shortest route of a robot among obstacles. The robot does not turn; contact is allowed.

The robot can go through passages that it exactly fits, but not through one that is narrower by a unit in the last place. Obstacles are
polygons, lines or points. Start and goal are where the robot's reference point, the origin of its shape, is."""
    main = "route"
    group_name = "Shapes"
    inputs = (Input("OBSTACLES", "Obstacles: a layer", (ANY,), "OBSTACLES_SHAPE", "or obstacles as a shape, as WKT"),)
    outputs = (
        Output("OUTPUT", "", "Route", LINES, True, None),
        Output("PLACEMENTS", "_placements", "Robot along the route", POLYGONS, True, None),
        Output("GROWN", "_obstacles", "Where the reference point may not be", POLYGONS, False, "--free-space"),
        Output("FREE_SPACE", "_free_space", "Where it may be", POLYGONS, False, "--free-space"),
        Output("SEGMENTS", "_degenerate_segments", "Passages that fit exactly", LINES, False, "--free-space"),
        Output("POINTS", "_degenerate_points", "Places that fit exactly", POINTS, False, "--free-space"),
    )
    numbers = (("LENGTH", "Length"),)

    def unresolved(self, figures):
        return "There is no route: %s." % (figures.get("reason") or "none was found")

    def figures(self, figures):
        return {"LENGTH": figures["length"]} if figures.get("found") else {}
