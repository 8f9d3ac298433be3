"""sunder:separate"""
from . import program
from .algorithm import ANY, LINES, LOG, POINTS, POLYGONS, Algorithm, File, Input, Output


class Separate(Algorithm):
    command = "separate"
    title = "Separate features"
    text = """Moves overlapping features apart by the least amount, so that they are a gap apart.

Buildings, or symbols of points, keep their shape and are only moved. Roads and other barriers never move. Every
result is checked exactly on the coordinates as written, and a proved lower bound stands beside the cost.

Layers: the features, moved, with their attributes; the moves as lines; the conflicts that remain, each with its
reason; what presses on what; for points their symbols. The report is a page for the browser: the map before and
after."""
    main = "separated"
    movable = True
    inputs = (Input("INPUT", "Layer to separate", (POLYGONS, POINTS), None, None),)
    outputs = (
        Output("OUTPUT", "", "Separated", ANY, True, None),
        Output("DISPLACEMENT", "_displacement", "Moves", LINES, True, None),
        Output("CONFLICTS", "_conflicts", "Conflicts that remain", LINES, True, None),
        Output("PUSHES", "_pushes", "Pushes", LINES, False, None),
        Output("SYMBOLS", "_symbols", "Symbols (of points)", POLYGONS, False, None),
    )
    files = (
        File("REPORT", "--report", "Report (a page for the browser)", "HTML files (*.html)"),
        File("PROOF", "--proof", "Proof, for a checker", "JSON lines (*.jsonl)"),
        LOG,
    )
    numbers = (("FEATURES", "Features"), ("MOVED", "Features moved"), ("CONFLICTS_BEFORE", "Conflicts before"),
               ("CONFLICTS_AFTER", "Conflicts that remain"), ("TOTAL", "Sum of moves"), ("LONGEST", "Longest move"),
               ("COST", "Cost"), ("LOWER_BOUND", "Proved lower bound of the cost"))

    def _words_of_outputs(self, wanted):
        # Something must be written: the main layer is what the file is checked by.
        layers = [each.suffix[1:] for each in wanted if each.suffix]
        if layers == ["displacement", "conflicts", "pushes", "symbols"]:
            return []
        return ["--layers=" + ",".join(["main"] + layers)]

    def unresolved(self, figures):
        left = program.conflicts_left(figures)
        return ("%d conflict%s could not be solved; each is listed, with its reason, in the layer of conflicts." %
                (left, "" if left == 1 else "s"))

    def figures(self, figures):
        if not figures:
            return {}
        moves = figures["displacement"]
        return {"FEATURES": figures["features"], "MOVED": figures["moved"],
                "CONFLICTS_BEFORE": program.conflicts_left({"conflicts": figures["conflicts"]["before"]}),
                "CONFLICTS_AFTER": program.conflicts_left(figures), "TOTAL": moves["total"], "LONGEST": moves["max"],
                "COST": moves["cost"], "LOWER_BOUND": moves["lower_bound"]}
