"""The algorithm sunder:check, which runs `sunder check`."""
from . import program
from .algorithm import LINES, POINTS, POLYGONS, Algorithm, Input, Output


class Check(Algorithm):
    command = "check"
    title = "Check for overlaps and gaps"
    text = """Lists pairs of features that overlap or are nearer than a gap, exactly.

It works on any layer. If the layer before the moves is given, too, moves that break a rule are also listed.

With a specification the layers are those that it names, as they stand; with a layer, too, those of the same names in
its file."""
    main = "conflicts"
    of_sheet = True
    inputs = (Input("INPUT", "Layer to check", (POLYGONS, POINTS), None, None),)
    outputs = (Output("OUTPUT", "", "Conflicts", LINES, True, None),)
    numbers = (("FEATURES", "Features"), ("PAIRS", "Pairs tested"), ("CONFLICTS", "Conflicts"))

    def unresolved(self, figures):
        found = program.conflicts_left(figures)
        return "%d conflict%s found." % (found, " was" if found == 1 else "s were")

    def figures(self, figures):
        if not figures:
            return {}
        return {"FEATURES": figures["features"], "PAIRS": figures["pairs_tested"],
                "CONFLICTS": program.conflicts_left(figures)}
