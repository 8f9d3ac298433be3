"""The algorithm sunder:specification, which writes a specification of a sheet from layers of the project."""
import json
import os

from processing.core.ProcessingConfig import ProcessingConfig
from qgis.core import (QgsProcessing, QgsProcessingException, QgsProcessingParameterFileDestination,
                       QgsProcessingParameterMultipleLayers, QgsProcessingParameterScale, QgsProcessingParameterString,
                       QgsProviderRegistry, QgsUnitTypes, QgsVectorLayer, QgsWkbTypes)

from . import program
from .algorithm import PROGRAM_SETTING, Algorithm, table_of
from .command_line import BadValue

# The roles of layers, with the parameter of each.
ROLES = (("MOVING", "move", "Layers that move: polygons, and points with symbols", False),
         ("BARRIERS", "barrier", "Barriers: layers that never move, and are not crossed", True),
         ("FIXED", "fixed", "Layers that never move, but may be crossed", True),
         ("FOLLOWING", "follow", "Layers that go along with what moves", True))


class Specification(Algorithm):
    command = "specification"
    title = "Write a specification"
    text = """Writes a specification of a sheet from layers of the project: layers that move, barriers, layers that go along, \
their gaps and limits.

Sources, filters and names are those of the layers in the project. The drawn widths of lines, and the sizes of points, \
are those of their styles, if these are in millimetres: of a single symbol, or of the categories of a field. The file \
is meant to be completed by hand; "Separate features" and "Check for overlaps and gaps" take it."""
    files = ()

    def svgIconPath(self):
        return os.path.join(os.path.dirname(__file__), "icons", "sunder.svg")

    def initAlgorithm(self, configuration=None):
        for name, _, label, optional in ROLES:
            self._add(QgsProcessingParameterMultipleLayers(name, label, QgsProcessing.SourceType.TypeVectorAnyGeometry,
                                                           optional=optional))
        self._add(QgsProcessingParameterScale("SCALE", "Scale of the map"))
        for name, label, default, text in (
                ("GAP", "Gap between features", "0.2mm", "With its unit, such as 0.2mm on the sheet, or 3m."),
                ("BARRIER_GAP", "Gap to the drawn edges of layers that never move", "", "Empty: the same."),
                ("MAX_SHIFT", "Longest move", "", "Empty: no limit."),
                ("SYMBOL", "Points: the symbol at each point", "",
                 "Such as square:0.4mm. Empty: a square of the size in the layer's style.")):
            self._add(QgsProcessingParameterString(name, label, default, optional=not default), text)
        self._add(QgsProcessingParameterFileDestination("OUTPUT", "Specification", "Specifications (*.json)"))

    def checkParameterValues(self, parameters, context):
        return super(Algorithm, self).checkParameterValues(parameters, context)

    def prepareAlgorithm(self, parameters, context, feedback):
        try:
            self.sunder = program.find(ProcessingConfig.getSetting(PROGRAM_SETTING))
            self.place = self.parameterAsFileOutput(parameters, "OUTPUT", context)
            self.sheet = self._sheet(parameters, context)
        except (BadValue, program.ProgramMissing) as trouble:
            raise QgsProcessingException(str(trouble))
        return True

    def _sheet(self, parameters, context):
        text = {name: self.parameterAsString(parameters, name, context).strip()
                for name in ("GAP", "BARRIER_GAP", "MAX_SHIFT", "SYMBOL")}
        layers, names = [], set()
        for parameter, role, _, _ in ROLES:
            for layer in self.parameterAsLayerList(parameters, parameter, context) or []:
                layers.append(entry_of(layer, role, text["SYMBOL"], names, os.path.dirname(self.place)))
        gaps = [{"between": ["*", "*"], "gap": text["GAP"]}]
        gaps += [{"between": ["*", each["name"]], "gap": text["BARRIER_GAP"]} for each in layers
                 if text["BARRIER_GAP"] and each["role"] in ("barrier", "fixed")]
        scale = self.parameterAsDouble(parameters, "SCALE", context)
        found = {"title": os.path.splitext(os.path.basename(self.place))[0], "scale": "1:%.15g" % scale}
        if text["MAX_SHIFT"]:
            found["defaults"] = {"max_shift": text["MAX_SHIFT"]}
        return dict(found, layers=layers, gaps=gaps)

    def processAlgorithm(self, parameters, context, feedback):
        os.makedirs(os.path.dirname(os.path.abspath(self.place)), exist_ok=True)
        before = None
        if os.path.exists(self.place):
            with open(self.place, encoding="utf-8") as file:
                before = file.read()
        _write(self.place, json.dumps(self.sheet, indent=2, ensure_ascii=False) + "\n")
        # The program reads it, so that a mistake is found now.
        said = []
        line = [self.sunder, "separate", "--spec=" + self.place, "--print-spec"]
        status, told = program.run(line, lambda percent: None, said.append, feedback.isCanceled)
        if status != program.DONE:
            if before is None:
                os.remove(self.place)
            else:
                _write(self.place, before)
            raise QgsProcessingException("\n".join(program.plain(each, {}) for each in told) or "It was cancelled.")
        return {"OUTPUT": self.place}


def _write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def entry_of(layer, role, symbol, names, folder):
    """Returns the object of a layer in the specification. names: the names of the layers so far. Raises BadValue if the
    program cannot read the layer from its file."""
    if not isinstance(layer, QgsVectorLayer) or not layer.isValid():
        raise BadValue("%s is no layer of features." % layer.name())
    parts = QgsProviderRegistry.instance().decodeUri("ogr", layer.source()) if layer.providerType() == "ogr" else {}
    path = parts.get("path")
    if not path or not os.path.isfile(path) or layer.isEditable() or layer.vectorJoins():
        raise BadValue("%s: a specification names files. Save the layer to a file, without edits and joins, and take "
                       "that." % layer.name())
    entry = {"name": _new_name(layer.name(), names), "source": _relative(path, folder)}
    name = parts.get("layerName") or _only_layer(layer)
    if name:
        entry["layer"] = name
    entry["role"] = role
    if layer.subsetString():
        if role in ("barrier", "fixed", "move", "follow"):
            entry["where"] = layer.subsetString()
    kind = layer.geometryType()
    points, lines = QgsWkbTypes.GeometryType.PointGeometry, QgsWkbTypes.GeometryType.LineGeometry
    if role == "move" and kind == lines:
        raise BadValue("%s: lines do not move; polygons do, and points with symbols." % layer.name())
    if role == "move" and kind == points:
        entry["symbol"] = symbol or _symbol_of(layer)
    if role in ("barrier", "fixed") and kind in (points, lines):
        width = _width_of(layer)
        if width:
            entry["width"] = width
    return entry


def _new_name(name, names):
    base = table_of(name)
    found, k = base, 2
    while found.lower() in names:
        found, k = "%s_%d" % (base, k), k + 1
    names.add(found.lower())
    return found


def _relative(path, folder):
    """Returns the path as it is seen from the folder of the specification, if it lies in it."""
    path, folder = os.path.realpath(path), os.path.realpath(folder or ".")
    return os.path.relpath(path, folder) if os.path.commonpath([path, folder]) == folder else path


def _only_layer(layer):
    layers = [each.split(layer.dataProvider().sublayerSeparator()) for each in layer.dataProvider().subLayers()]
    return layers[0][1] if len(layers) == 1 and len(layers[0]) > 1 else None


# ---- Sizes in the styles ---------------------------------------------------------------------------------------------


def _millimetres(symbol):
    """Returns the width of a line, or the size of a point, as a length; None if it is not in millimetres."""
    size = symbol.width() if hasattr(symbol, "width") else symbol.size() if hasattr(symbol, "size") else None
    if size is None or symbol.outputUnit() != QgsUnitTypes.RenderUnit.RenderMillimeters or not size > 0:
        return None
    return "%.15gmm" % size


def _width_of(layer):
    """Returns the width of the lines or points as a specification has it; None if the style does not say it."""
    renderer = layer.renderer()
    if renderer is None:
        return None
    if renderer.type() == "singleSymbol":
        return _millimetres(renderer.symbol())
    if renderer.type() != "categorizedSymbol" or layer.fields().lookupField(renderer.classAttribute()) < 0:
        return None
    of, other = {}, None
    for category in renderer.categories():
        values = category.value() if isinstance(category.value(), list) else [category.value()]
        width = _millimetres(category.symbol())
        for value in values:
            if width and value in (None, ""):
                other = width
            elif width:
                of[str(value)] = width
    return dict({"by": renderer.classAttribute(), "of": of}, **({"else": other} if other else {})) if of else other


def _symbol_of(layer):
    renderer = layer.renderer()
    size = _millimetres(renderer.symbol()) if renderer is not None and renderer.type() == "singleSymbol" else None
    if size is None:
        raise BadValue("%s: its style has no size in millimetres; give the symbol of points." % layer.name())
    return "square:" + size
