"""The table of options of the program, in the words of a dialog. It does not use QGIS.

It is the source of the parameters (parameters.py), command lines (command_line.py), help texts, and of the words for
options in messages. A test compares it with `sunder --options-json`: every option of every command is here or in
LEFT_OUT, with the same choices and defaults. So the plug-in can be loaded without the program, and its texts can be
those of a dialog.
"""
from collections import namedtuple

LENGTH, NUMBER, COUNT, SCALE, FLAG, CHOICE = "length", "number", "count", "scale", "flag", "choice"
FIELD, NUMERIC_FIELD, EXPRESSION, TEXT, POINT = "field", "numeric field", "expression", "text", "point"
BARRIERS, SOURCE, FILE = "barriers", "source", "file"
BARRIER_LAYERS, BARRIER_LENGTH = "layers as barriers", "length of the layers as barriers"

LAYERS = ("separate", "check")
EVERY = ("separate", "check", "buffer", "sum", "pair", "route")


class Option(namedtuple("Option", "flag kind commands label help default choices labels advanced needed key")):
    """An option of the program, as a parameter of the dialog. labels are the texts that the dialog shows for the
    choices. default is a value of the dialog, or None for no value. If one option has several parameters, `key` is
    added to the name of each: the parameters of --barrier are BARRIER, BARRIER_WIDTH and so on."""

    __slots__ = ()

    def __new__(cls, flag, kind, commands, label, text, default=None, choices=(), labels=(), advanced=True,
                needed=False, key=""):
        return super().__new__(cls, flag, kind, commands, label, text, default, choices, labels, advanced, needed, key)

    @property
    def name(self):
        """The name of the parameter, made from the option: MAX_SHIFT for --max-shift."""
        return (self.flag[2:] + self.key).replace("-", "_").upper()


OPTIONS = (
    # ---- Parameters that are always shown ----
    Option("--gap", LENGTH, ("separate", "check", "pair", "route"), "Gap (least distance between features)",
           "Least distance between features. With 0 only overlaps count.", 0.0, advanced=False),
    Option("--least-gap", LENGTH, LAYERS, "Least gap (pairs may stand between this and the gap, at a price)",
           "A row without enough room shares what it lacks. Only pairs nearer than this are conflicts. Empty: the gap.",
           advanced=False),
    Option("--shape", TEXT, ("buffer",), "Shape to grow or shrink by",
           "square:6m, rectangle:4x3, disc:3m (around the true disc), inside-disc:3m (within it), or WKT of a polygon. "
           "Lengths without a unit are in the layer's.", "disc:1", advanced=False, needed=True),
    Option("--operation", CHOICE, ("buffer",), "Operation",
           "Opening removes parts that are narrower than the shape; closing fills gaps that are narrower.",
           0, ("dilate", "erode", "open", "close"),
           ("Grow (dilate)", "Shrink (erode)", "Open: shrink, then grow", "Close: grow, then shrink"), False),
    Option("--dissolve", FLAG, ("buffer",), "Dissolve (all features as one set)",
           "All features are grown or shrunk as one polygonal set.", False, advanced=False),
    Option("--robot", TEXT, ("route",), "Robot (the shape that moves)",
           "square:2, rectangle:4x3, disc:1.5, or WKT of a polygon around its reference point (0 0). It does not turn.",
           "disc:1", advanced=False, needed=True),
    Option("--from", POINT, ("route",), "Start", "The start of the robot's reference point.", advanced=False,
           needed=True),
    Option("--to", POINT, ("route",), "Goal", "The destination of the robot's reference point.", advanced=False, needed=True),
    Option("--spec", FILE, LAYERS, "Specification of a sheet (JSON), which has layers and rules",
           "A file with the layers of a map, their rules, and the gaps between their classes, such as \"Write a specification\" makes. "
           "What is set in this dialog goes before it.", advanced=False),
    Option("--before", SOURCE, ("check",), "The layer before it was moved",
           "Also lists moves that break a rule: conflicts that got worse, and features that moved too far, crossed a barrier, "
           "jumped, or changed their shape. Features are matched by the key field, otherwise by FID.", advanced=False),
    Option("--reflect", FLAG, ("sum",), "Sum of P and the reflected Q",
           "The sum of P and -Q: the positions in which Q would overlap P.", False, advanced=False),
    Option("--barrier", BARRIER_LAYERS, LAYERS, "Barriers (layers that never move)",
           "Roads, rivers, parcels: features stay clear of them and do not change their side.", advanced=False,
           key="-layers"),
    Option("--barrier", BARRIER_LENGTH, LAYERS, "Barriers: drawn width",
           "The full width that the chosen layers are drawn with. Empty: lines without a width, areas as they are.",
           advanced=False, key="-width"),
    Option("--barrier", BARRIER_LENGTH, LAYERS, "Barriers: gap from the drawn edge",
           "For the chosen layers. Empty: the gap between features.", advanced=False, key="-gap"),
    Option("--barrier", BARRIERS, LAYERS, "Barriers as a table (widths, filters, sides of each)",
           "In addition to the layers chosen above, one row for each layer. Layer: the name of a layer of the project, or a file. "
           "Width or field: the full drawn width, or the field that holds it. Gap: from the drawn edge, the gap "
           "between features where empty. Least gap: of this layer, as the least gap of features. Filter: an expression. Side: no lets features cross it. As: boundary takes a "
           "polygon's rings as lines."),
    Option("--max-shift", LENGTH, LAYERS, "Longest move", "No feature moves farther. Empty: no limit.",
           advanced=False),
    Option("--scale", SCALE, EVERY, "Scale of the map",
           "For lengths in millimetres on the sheet: 25000 for a map at 1:25 000.", advanced=False),
    # ---- Which features move, and how far ----
    Option("--max-shift-field", NUMERIC_FIELD, LAYERS, "Field: longest move of each feature",
           "In the units of the layer. 0: fixed; null: the longest move above."),
    Option("--weight", CHOICE, ("separate",), "Cost of a move",
           "The sum of weight times squared length of the moves is minimised; areas are relative to their median.",
           0, ("1", "area", "sqrt-area"), ("The same for every feature", "By area", "By the square root of the area")),
    Option("--weight-field", NUMERIC_FIELD, ("separate",), "Field: weight of each feature",
           "A factor of the weight, above 0; null: 1."),
    Option("--fixed-where", EXPRESSION, LAYERS, "Features that never move",
           "An expression. Features for which it is true never move; the others keep clear of them."),
    Option("--ignore-where", EXPRESSION, LAYERS, "Features to ignore",
           "An expression. Features for which it is true are written unchanged, and conflict with nothing."),
    # ---- Blocks ----
    Option("--touch-tolerance", LENGTH, LAYERS, "Features at most this far apart are one block",
           "Features that touch, or whose overlap or distance is at most this, move as one. Empty: a tenth of the gap."),
    Option("--block-field", FIELD, LAYERS, "Field: features of equal values are one block",
           "Features with equal values, not null, move as one, in addition to features that touch."),
    Option("--no-blocks", FLAG, LAYERS, "Nothing joins by touch or containment", "Each feature moves by itself.",
           False),
    Option("--contained", CHOICE, LAYERS, "A feature that lies in another",
           "For example a building part in its building. Symbols of points are always separated.",
           0, ("block", "ignore", "separate"), ("Moves with it", "May overlap it", "Is separated from it")),
    Option("--allow-jumps", FLAG, LAYERS, "Features may jump over others, and out of yards", "Points always may.",
           False),
    Option("--list-inside", FLAG, LAYERS, "List conflicts inside blocks, too",
           "Members of one block need no gap; with this option their conflicts are listed nevertheless.", False),
    # ---- Rows ----
    Option("--rows", TEXT, LAYERS, "Rows of houses keep their line",
           "Neighbours in a row keep their order, and stay in line as far as the stiffness outweighs the moves. auto: rows "
           "are found in the layer; a field: equal values, not null, are one row; no: no rows; empty: auto, and none for points.", ""),
    Option("--row-stiffness", TEXT, ("separate",), "Stiffness of rows against kinks, and against uneven spacing",
           "Two factors of the cost of a move. 3,0.3: as usual; 10,1: stiff.", ""),
    Option("--ease", TEXT, ("separate",), "Price of what pairs that remain in conflict lack",
           "A number above 0: they come as near to their distance as it pays for; no: they are not eased; empty: 30.", ""),
    # ---- Preferred places ----
    Option("--prefer-dx", NUMERIC_FIELD, ("separate",), "Field: the move in x that each feature prefers",
           "In the units of the layer; null: 0. The cost counts from there. Limits and sides count from the layer."),
    Option("--prefer-dy", NUMERIC_FIELD, ("separate",), "Field: the move in y that each feature prefers",
           "In the units of the layer; null: 0."),
    Option("--previous", SOURCE, ("separate",), "An earlier result, whose moves are preferred",
           "Features that it has, too, stay where they were moved, as far as nothing near them has changed. They are matched by "
           "the key field, otherwise by FID."),
    Option("--previous-relax", CHOICE, ("separate",), "Features beside a place that is empty now",
           "Otherwise moves would be kept whose reason is gone.", 0, ("yes", "no"), ("May go back", "Stay")),
    Option("--links", SOURCE, ("separate",), "Lines from old to new places, along which features prefer to move",
           "Between the starts of lines the move is interpolated. An earlier result goes before it, and fields go before both."),
    Option("--links-radius", LENGTH, ("separate",), "Distance from the starts of lines up to which they matter",
           "Less from half of it on. Empty: no limit."),
    # ---- No room ----
    Option("--hide", FLAG, ("separate",), "Leave out features that cannot be given room",
           "As few as possible, with a proved lower bound. They stay in the layer, with 1 in sunder_inv.", False),
    Option("--hierarchy-field", NUMERIC_FIELD, LAYERS, "Field: how important features are that may be left out",
           "0: never left out; 1: the most important others; null: the least important of all."),
    Option("--hide-weight", CHOICE, ("separate",), "Weight of what is left out, within its class",
           "As little weight as possible is left out, the most important class first.",
           2, ("1", "area", "sqrt-area"), ("1 for each feature", "Its area", "The square root of its area")),
    Option("--drop-hidden", FLAG, ("separate",), "Features that are left out are not in the result",
           "Otherwise they are, unmoved, with 1 in sunder_inv.", False),
    Option("--trim", FLAG, LAYERS, "Cut features back at barriers where there is no room",
           "As little as possible, and before any is left out. Needs barriers.", False),
    Option("--trim-keep", NUMBER, LAYERS, "Least share of area that a feature keeps",
           "From 0 to 1. A feature that would keep less is not cut.", 0.5),
    Option("--inset", TEXT, LAYERS, "Move outlines in where there is no room",
           "Lengths, the least first, such as 1,2: the outline of a feature, or of its block, may be moved in by them. Empty: none."),
    Option("--min-size", LENGTH, LAYERS, "Least size of what remains of a feature",
           "The diameter of a disc that fits into it; arms and horns that a cut leaves thinner are cut off."),
    Option("--enlarge", FLAG, LAYERS, "First make features larger that are below the least size",
           "Blocks as one. Needs the least size.", False),
    Option("--symbol-size", LENGTH, LAYERS, "Side of a square that a feature may become where there is no room",
           "Before, it may be scaled to 0.8 and 0.6, unless it is in a block."),
    Option("--rigid-where", EXPRESSION, LAYERS, "Features whose shapes never change",
           "They are not cut back; they may move, and be left out."),
    Option("--crossed", CHOICE, LAYERS, "A feature that a barrier's line crosses",
           "It may stay beside that barrier; or, if it has no room, it is cut back to one side or left out.",
           0, ("keep", "trim", "hide"), ("May stay as it stands", "Is cut back to one side", "Is left out")),
    Option("--hidden-field", NUMERIC_FIELD, ("check",), "Field: features that are left out",
           "Those with a value other than 0 owe nothing; in a result of Sunder: sunder_inv."),
    # ---- Symbols ----
    Option("--symbol", TEXT, LAYERS, "Points: the symbol at each point",
           "disc:4m, square:5m, rectangle:8x3, or WKT of a polygon relative to the point."),
    Option("--symbol-field", FIELD, LAYERS, "Points: field with the symbol of each point",
           "As text, written like the symbol above. Null: the symbol above."),
    Option("--symbol-size-field", NUMERIC_FIELD, LAYERS, "Points: field with a factor of the size of each symbol",
           "A factor above 0; null: 1."),
    # ---- Buffers ----
    Option("--dissolve-field", FIELD, ("buffer",), "Field: one set for the features of each value",
           "The result has one feature for each value."),
    Option("--explode", FLAG, ("buffer",), "Write each polygon of the result as a feature of its own",
           "With Dissolve these are the blocks.", False),
    Option("--align", FLAG, ("buffer",), "Turn the shape to the main direction of each feature or block",
           "A square then follows the walls.", False),
    # ---- Sums ----
    Option("--algorithm", CHOICE, ("sum",), "Algorithm", "All give the same result.",
           0, ("auto", "convolution", "arrangement", "incremental", "divide"),
           ("Chosen for these", "Convolution", "Arrangement of convex subsums", "Convex subsums one after another",
            "Convex subsums, halves joined")),
    Option("--decomposition", CHOICE, ("sum",), "Convex pieces", "How operands are cut into convex pieces; the convolution does not use this.",
           0, ("angle-bisector", "vertical", "triangulation", "hertel-mehlhorn", "optimal", "mixed"),
           ("Angle bisectors", "Vertical cuts", "Triangulation", "Hertel and Mehlhorn", "Fewest pieces", "Mixed")),
    Option("--order", CHOICE, ("sum",), "Order of the subsums", "For algorithms that join one subsum after another.",
           0, ("random", "fat", "given"), ("Random", "Fat ones first", "As they come")),
    # ---- All ----
    Option("--id-field", FIELD, ("separate", "check", "buffer"), "Key field, for lists and messages",
           "Copied to the id columns. Empty: the id that QGIS shows, if the layer had to be copied."),
    Option("--effort", NUMBER, ("separate",), "Effort", "A factor of the work spent on better layouts and on proofs. "
           "0: none, 10: ten times the default.", 1.0),
    Option("--seed", COUNT, ("separate", "sum"), "Seed", "Seed of the random choices; the same seed gives the same result.", 0),
    Option("--invalid", CHOICE, EVERY, "Invalid geometries", "Polygons that cross themselves, for example.",
           0, ("repair", "skip", "fail"), ("Repair", "Skip", "Stop with a message")),
    Option("--threads", COUNT, EVERY, "Threads", "Results are the same for every number. 0: all processors.", 0),
)

# The parameter for the unit of all lengths, and its choices. The first choice is the unit of the layer.
UNIT = "UNIT"
UNIT_LABEL = "Unit of all lengths, where it is not the one beside them"
UNITS = ("", "m", "km", "ft", "us-ft", "mm")
UNIT_LABELS = ("As shown beside each length", "Metres", "Kilometres", "Feet", "US survey feet",
               "Millimetres on the sheet of the map")
SHEET = UNITS.index("mm")

LOG_LABEL = "Log of all errors and warnings"

# The noun that replaces an option in a sentence of a message, before the label in parentheses (program.py). So "give
# another --id-field" becomes: give another key field ("Key field, for lists and messages").
NOUNS = {
    "--gap": "gap", "--least-gap": "least gap", "--shape": "shape", "--operation": "operation",
    "--dissolve": "dissolving", "--robot": "robot",
    "--from": "start", "--to": "goal", "--before": "layer before the moves", "--spec": "specification", "--reflect": "reflection",
    "--barrier": "barrier", "--max-shift": "longest move", "--scale": "scale", "--max-shift-field": "field of the longest moves",
    "--weight": "cost of a move", "--weight-field": "field of the weights",
    "--fixed-where": "expression for features that never move", "--ignore-where": "expression for ignored features",
    "--touch-tolerance": "distance up to which features are one block", "--block-field": "field of the blocks",
    "--no-blocks": "checkbox to form no blocks", "--contained": "treatment of contained features",
    "--allow-jumps": "checkbox to allow jumps", "--list-inside": "checkbox to list conflicts inside blocks",
    "--rows": "choice of rows", "--row-stiffness": "stiffness of rows",
    "--ease": "price of what pairs lack",
    "--prefer-dx": "field of the preferred moves in x", "--prefer-dy": "field of the preferred moves in y",
    "--previous": "earlier result", "--previous-relax": "choice for features beside empty places",
    "--links": "lines to new places", "--links-radius": "radius of the lines",
    "--hide": "checkbox to leave features out", "--hierarchy-field": "field of the classes",
    "--hide-weight": "weight of what is left out", "--drop-hidden": "checkbox to drop what is left out",
    "--hidden-field": "field of what is left out", "--trim": "checkbox to cut features back",
    "--inset": "lengths to move outlines in",
    "--trim-keep": "least share kept", "--min-size": "least size of what remains",
    "--enlarge": "checkbox to make features larger",
    "--symbol-size": "side of a square in place of a feature",
    "--rigid-where": "expression for features whose shapes never change",
    "--crossed": "choice for features that a barrier's line crosses",
    "--symbol": "symbol", "--symbol-field": "field of the symbols",
    "--symbol-size-field": "field of the symbols' sizes",
    "--dissolve-field": "field to dissolve by", "--explode": "checkbox for single polygons", "--align": "checkbox to turn the shape",
    "--algorithm": "algorithm of the sum", "--decomposition": "kind of convex pieces", "--order": "order of the subsums",
    "--id-field": "key field", "--effort": "effort", "--seed": "seed", "--invalid": "treatment of invalid geometries",
    "--threads": "number of threads", "--log": "log", "--report": "report", "--proof": "proof",
    "--input-crs": "CRS of the layer in QGIS",
}

# The options that no dialog has, with the reasons: LEFT_OUT. These are reasons of several options.
_QGIS_CHOOSES = "which features is chosen in QGIS: by the layer's filter, its selection, or a layer made before"
_QGIS_WRITES = "the program writes a GeoPackage of the plug-in's; QGIS writes it where the dialog says"
_OURS = "set by the plug-in"
_SHARDS = "a layer in shards is for clusters, which have no dialogs"
# The commands that no dialog runs, with the reasons.
LEFT_OUT_COMMANDS = {"plan": _SHARDS, "merge": _SHARDS, "follow": "run in the shell, on the layers that QGIS wrote"}
LEFT_OUT = {
    "--input-layer": _OURS, "--where": _QGIS_CHOOSES, "--sql": _QGIS_CHOOSES, "--dialect": _QGIS_CHOOSES,
    "--bbox": _QGIS_CHOOSES, "--if": _QGIS_CHOOSES, "--oo": _QGIS_CHOOSES, "--config": _QGIS_CHOOSES,
    "--input-crs": "QGIS's own CRS of the layer is handed over with it",
    "--output": _QGIS_WRITES, "--of": _QGIS_WRITES, "--nlt": _QGIS_WRITES, "--lco": _QGIS_WRITES, "--co": _QGIS_WRITES,
    "--overwrite": _QGIS_WRITES, "--update": _QGIS_WRITES, "--overwrite-layer": _QGIS_WRITES,
    "-overwrite": _QGIS_WRITES,
    "--output-layer": _OURS, "--layers": "by the outputs that are not skipped",
    "--planar-map": "by the outputs that are not skipped", "--free-space": "by the outputs that are not skipped",
    "--degenerate": "by the outputs that are not skipped",
    "--no-styles": "the styles are what QGIS loads", "--strict": _QGIS_WRITES, "--allow-inexact-output": _QGIS_WRITES,
    "--exact": "a layer holds doubles; rationals are for the shell",
    "--allow-conflicts": "what remains is told as a warning, not as a failure",
    "--shard": _SHARDS,
    "--print-spec": "the page of the report has the specification",
    "--progress": _OURS, "--max-memory": "layers that memory does not hold are for the shell", "--quiet": _OURS, "--stats": _OURS, "--report": "an output", "--proof": "an output",
    "--trace": "for developers, in a shell", "--log": "an output", "--messages": _OURS, "--help": "the panel beside the dialog",
}


def of_command(command):
    """Returns the options that the dialog of a command has, in the order of the dialog."""
    return [option for option in OPTIONS if command in option.commands]


def has_lengths(command):
    """Returns whether the dialog of a command has lengths, and so a parameter for their unit."""
    return any(option.kind in (LENGTH, BARRIER_LENGTH, BARRIERS) for option in of_command(command))
