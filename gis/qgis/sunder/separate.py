"""The algorithm sunder:separate, which runs `sunder separate`."""
from qgis.core import QgsProcessingParameterFileDestination

from . import program, result
from .algorithm import ANY, LINES, LOG, POINTS, POLYGONS, Algorithm, File, Input, Output


class Separate(Algorithm):
    command = "separate"
    title = "Separate features"
    text = """Moves overlapping features apart by the least amount, so that they are a gap apart.

Buildings, or symbols of points, keep their shape and are only moved. Roads and other barriers never move. Every
result is checked exactly on the coordinates as written, and comes with a proved lower bound of the cost.

Layers: the features, moved, with their attributes; the moves as lines; the conflicts that remain, each with its
reason; the contact forces; rows of houses that were found; for points their symbols; features that are left out, and
why. The report is a page for the browser: the map before and after.

A specification has layers that move together, layers that go along, barriers, and gaps between their classes. Then all
layers are written to one GeoPackage, under their own names."""
    main = "separated"
    movable = True
    of_sheet = True
    inputs = (Input("INPUT", "Layer to separate", (POLYGONS, POINTS), None, None),)
    outputs = (
        Output("OUTPUT", "", "Separated", ANY, True, None),
        Output("DISPLACEMENT", "_displacement", "Moves", LINES, True, None),
        Output("CONFLICTS", "_conflicts", "Conflicts that remain", LINES, True, None),
        Output("PUSHES", "_pushes", "Pushes", LINES, False, None),
        Output("ROWS", "_rows", "Rows of houses", LINES, False, None),
        Output("SYMBOLS", "_symbols", "Symbols (of points)", POLYGONS, False, None),
        Output("HIDDEN", "_hidden", "Features that are left out", ANY, False, None),
    )
    files = (
        File("REPORT", "--report", "Report (a page for the browser)", "HTML files (*.html)"),
        File("PROOF", "--proof", "Proof, for a checker", "JSON lines (*.jsonl)"),
        LOG,
    )
    numbers = (("FEATURES", "Features"), ("MOVED", "Features moved"), ("CONFLICTS_BEFORE", "Conflicts before"),
               ("CONFLICTS_AFTER", "Conflicts that remain"),
               ("CONFLICTS_STAYING", "Conflicts that remain between features that may not move"),
               ("TOTAL", "Sum of moves"), ("LONGEST", "Longest move"),
               ("COST", "Cost"), ("LOWER_BOUND", "Proved lower bound of the cost"))

    def initAlgorithm(self, configuration=None):
        super().initAlgorithm(configuration)
        self._add(QgsProcessingParameterFileDestination("SHEET", "With a specification: all layers of the sheet",
                                                        "GeoPackages (*.gpkg)", optional=True, createByDefault=False))

    def checkParameterValues(self, parameters, context):
        if parameters.get("SPEC") and parameters.get(self.inputs[0].name):
            return False, "The specification names the layers: leave the layer to separate empty."
        if parameters.get("SPEC") and not self._is_wanted(parameters, "SHEET"):
            return False, "With a specification all layers are written to one GeoPackage: choose it at the end."
        return super().checkParameterValues(parameters, context)

    def _sheet_place(self, written, parameters, context):
        return self.parameterAsFileOutput(parameters, "SHEET", context)

    def _words_of_sheet(self, written):
        return [written, "--overwrite"]

    def _deliver_sheet(self, written, context):
        result.load_all(written, context)
        return {"SHEET": written}

    def _words_of_outputs(self, wanted):
        # The main layer is always written, since the program checks its result as written there.
        layers = [each.suffix[1:] for each in self.outputs if each.suffix and (each in wanted or self._counts(each))]
        if layers == [each.suffix[1:] for each in self.outputs if each.suffix]:
            return []
        return ["--layers=" + ",".join(["main"] + layers)]

    def _counts(self, output):
        """Returns whether look() needs the layer even if the user does not want it. look() counts the conflicts between
        fixed features in the layer of conflicts."""
        return output.name == "CONFLICTS" and "FIXED_WHERE" in self.marks

    def look(self, written):
        self.staying = result.count(written, self.main + "_conflicts", "reason = 'fixed'")

    def unresolved(self, figures):
        left = program.conflicts_left(figures)
        text = ("%d conflict%s could not be solved; each is listed, with its reason, in the layer of conflicts." %
                (left, "" if left == 1 else "s"))
        if self.staying:
            text += (" %d of them %s between features that never move, or between these and barriers." %
                     (self.staying, "is" if self.staying == 1 else "are"))
        return text

    def figures(self, figures):
        if not figures:
            return {}
        moves = figures["displacement"]
        return {"FEATURES": figures["features"], "MOVED": figures["moved"],
                "CONFLICTS_BEFORE": program.conflicts_left({"conflicts": figures["conflicts"]["before"]}),
                "CONFLICTS_AFTER": program.conflicts_left(figures), "CONFLICTS_STAYING": self.staying,
                "TOTAL": moves["total"], "LONGEST": moves["max"],
                "COST": moves["cost"], "LOWER_BOUND": moves["lower_bound"]}
