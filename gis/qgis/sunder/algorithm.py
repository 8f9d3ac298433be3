"""The base class of all algorithms: it makes the parameters, passes the layers to the program, runs the program, and
delivers its layers.

The module of an algorithm says which layers the program reads (inputs) and writes (outputs), and what its figures mean;
its options are in options.py. The work has the two parts that Processing requires: prepareAlgorithm() examines the
layers in the thread that owns them; processAlgorithm() copies layers, runs the program and writes layers in any thread.
"""
import os
import re
import shutil
from collections import namedtuple

from processing.core.ProcessingConfig import ProcessingConfig
from qgis.core import (QgsProcessing, QgsProcessingAlgorithm, QgsProcessingException,
                       QgsProcessingFeatureSourceDefinition, QgsProcessingMultiStepFeedback, QgsProcessingOutputNumber,
                       QgsProcessingParameterBoolean, QgsProcessingParameterDefinition, QgsProcessingParameterEnum,
                       QgsProcessingParameterFeatureSource, QgsProcessingParameterFileDestination,
                       QgsProcessingParameterString, QgsProcessingParameterVectorDestination, QgsProcessingUtils,
                       QgsVectorLayer)
from qgis.PyQt.QtCore import QUrl
from qgis.PyQt.QtGui import QDesktopServices, QIcon

from . import options, program, result, source
from . import parameters as parameters_of
from .command_line import BARRIER_COLUMNS, BadValue, barrier, row_of_layer, rows_of, unit_of, words
from .options import BARRIER_LAYERS, BARRIERS, EXPRESSION, FIELD, LENGTH, NUMERIC_FIELD, SOURCE, UNIT

PROGRAM_SETTING = "SUNDER_PROGRAM"  # the setting of Processing that has the path of the program

# A layer that the program reads. shape is the parameter that takes a shape as text instead of the layer, or None.
Input = namedtuple("Input", "name label types shape shape_label")
# A layer that the program writes: suffix is added to `main` in its name; flag is an option without which the program
# does not make it, or None; wanted says whether the dialog asks for it by default.
Output = namedtuple("Output", "name suffix label type wanted flag")
# A file that the program writes: flag is the option that takes its path.
File = namedtuple("File", "name flag label filter")

POLYGONS, LINES = QgsProcessing.SourceType.TypeVectorPolygon, QgsProcessing.SourceType.TypeVectorLine
POINTS, ANY = QgsProcessing.SourceType.TypeVectorPoint, QgsProcessing.SourceType.TypeVectorAnyGeometry
LOG = File("LOG", "--log", options.LOG_LABEL, "Log files (*.log)")


class Algorithm(QgsProcessingAlgorithm):
    command = title = text = ""  # the command of the program; the title of the dialog; the text of its help
    main = ""                    # the name of the program's main layer; other layers have it and a suffix
    group_name = "Layers"
    inputs, outputs, files, numbers = (), (), (LOG,), ()  # numbers: name and label of each figure of figures()
    movable = False              # whether the dialog can restrict the moves to selected features
    of_sheet = False             # whether a specification may take the place of the layer

    # ---- What Processing asks ----

    def createInstance(self):
        return type(self)()

    def name(self):
        return self.command

    def displayName(self):
        return self.title

    def group(self):
        return self.group_name

    def groupId(self):
        return self.group_name.lower()

    def svgIconPath(self):
        return os.path.join(os.path.dirname(__file__), "icons", self.command + ".svg")

    def icon(self):
        return QIcon(self.svgIconPath())

    def tags(self):
        return ["sunder", "displacement", "generalisation", "overlap", "gap", "minkowski", "exact"]

    def shortDescription(self):
        return self.text.split("\n")[0]

    def shortHelpString(self):
        parts = ["<p>%s</p>" % part.replace("\n", " ") for part in self.text.split("\n\n")]
        for option in options.of_command(self.command):
            parts.append("<p><b>%s</b><br/>%s</p>" % (option.label, option.help))
        return "".join(parts)

    def canExecute(self):
        try:
            program.find(ProcessingConfig.getSetting(PROGRAM_SETTING))
        except program.ProgramMissing as missing:
            return False, str(missing)
        return True, ""

    # ---- Parameters ----

    def initAlgorithm(self, configuration=None):
        for each in self.inputs:
            self._add(QgsProcessingParameterFeatureSource(each.name, each.label, list(each.types),
                                                          optional=each.shape is not None or self.of_sheet))
            if each.shape:
                self._add(QgsProcessingParameterString(each.shape, each.shape_label, optional=True))
        if self.movable:
            self._add(QgsProcessingParameterBoolean("MOVE_SELECTED", "Move only selected features; the others are "
                                                    "obstacles that stay", False))
        for option in options.of_command(self.command):
            self._add(parameters_of.parameter(option, self.inputs[0].name), option.help, option.advanced)
            if option.kind == LENGTH and self.parameterDefinition(UNIT) is None:
                units = QgsProcessingParameterEnum(UNIT, options.UNIT_LABEL, list(options.UNIT_LABELS), defaultValue=0)
                self._add(units, "A length is in the unit that is shown beside it. Another unit that is chosen here, "
                          "say millimetres on the sheet of the map, holds for all of them instead.")
        for each in self.outputs:
            self._add(QgsProcessingParameterVectorDestination(each.name, each.label, each.type, optional=True,
                                                              createByDefault=each.wanted))
        for each in self.files:
            self._add(QgsProcessingParameterFileDestination(each.name, each.label, each.filter, optional=True,
                                                            createByDefault=False), advanced=each.flag != "--report")
        for name, label in self.numbers:
            self.addOutput(QgsProcessingOutputNumber(name, label))

    def _add(self, parameter, text="", advanced=False):
        if text:
            parameter.setHelp(text)
        if advanced:
            parameter.setFlags(parameter.flags() | QgsProcessingParameterDefinition.Flag.FlagAdvanced)
        self.addParameter(parameter)

    def checkParameterValues(self, parameters, context):
        if options.has_lengths(self.command):
            unit = self.parameterAsEnum(parameters, UNIT, context)
            if unit == options.SHEET and not parameters.get("SCALE"):
                return False, "Lengths in millimetres on the sheet need the scale of the map."
        for each in self.inputs:
            if each.shape and not parameters.get(each.name) and not parameters.get(each.shape):
                return False, "%s: a layer or a shape is needed." % each.label
        first = parameters.get(self.inputs[0].name)
        if self.of_sheet and not first and not parameters.get("SPEC"):
            return False, "%s: a layer or a specification is needed." % self.inputs[0].label
        if self.movable and self.parameterAsBoolean(parameters, "MOVE_SELECTED", context) and \
                isinstance(first, QgsProcessingFeatureSourceDefinition) and first.selectedFeaturesOnly:
            return False, ("Move only selected features: then the layer must be given as a whole; take away the mark "
                           "at \"Selected features only\", which would leave the others out altogether.")
        return super().checkParameterValues(parameters, context)

    # ---- Before the work, in the thread that owns the layers ----

    def prepareAlgorithm(self, parameters, context, feedback):
        try:
            self._prepare(parameters, context)
        except (BadValue, program.ProgramMissing) as trouble:
            raise QgsProcessingException(str(trouble))
        return True

    def _prepare(self, parameters, context):
        self.sunder = program.find(ProcessingConfig.getSetting(PROGRAM_SETTING))
        self.sources = {each.name: self._source(parameters, each.name, context) for each in self.inputs}
        self.shapes = {each.name: self.parameterAsString(parameters, each.shape, context)
                       for each in self.inputs if each.shape}
        self.marks, self.barriers, self.chosen, self.values = {}, [], [], {}
        for option in options.of_command(self.command):
            self._prepare_option(option, parameters, context)
        self._prepare_chosen_barriers()
        self._keep_chosen_key()
        if options.has_lengths(self.command):
            self.values[UNIT] = self.parameterAsEnum(parameters, UNIT, context)
        if self.movable and self.parameterAsBoolean(parameters, "MOVE_SELECTED", context):
            self._fix_unselected(parameters, context)

    def _keep_chosen_key(self):
        """The program does not see a field that repeats the FID. If such a field is chosen in the dialog, the layer is
        copied with that field as an ordinary one."""
        layer = self.sources[self.inputs[0].name]
        chosen = {self.values.get(option.name) for option in options.of_command(self.command)
                  if option.kind in (FIELD, NUMERIC_FIELD)}
        if layer and any(layer.fields[i].name() in chosen for i in layer.keys):
            layer.file, layer.keys = None, ()

    def _source(self, parameters, name, context):
        value = parameters.get(name)
        if value is None or value == "":
            return None
        found = self.parameterAsSource(parameters, name, context)
        if found is None:
            raise QgsProcessingException(self.invalidSourceError(parameters, name))
        whole = not isinstance(value, QgsProcessingFeatureSourceDefinition) or not (
            value.selectedFeaturesOnly or value.featureLimit >= 0 or getattr(value, "filterExpression", ""))
        return source.of_processing(found, self.parameterAsVectorLayer(parameters, name, context), whole)

    def _prepare_option(self, option, parameters, context):
        name = option.name
        if option.kind == BARRIERS:
            self._prepare_barriers(rows_of(self.parameterAsMatrix(parameters, name, context)), context)
        elif option.kind == BARRIER_LAYERS:
            self.chosen = self.parameterAsLayerList(parameters, name, context)
        elif option.kind == SOURCE:
            self.sources[name] = self._source(parameters, name, context)
        elif option.kind == EXPRESSION:
            # parameterAsExpression() drops an expression that has an error.
            text = self.parameterAsString(parameters, name, context)
            if text and self.sources[self.inputs[0].name] is None:
                raise BadValue("%s: with a specification such a condition stands there." % option.label)
            if text:
                asked = self.createExpressionContext(parameters, context)
                asked.setFields(self.sources[self.inputs[0].name].fields)
                self.marks[name] = source.expression_of(text, asked, option.label)
        else:
            layer = self.sources[self.inputs[0].name]
            self.values[name] = parameters_of.value(self, option, parameters, context, layer)

    def _prepare_barriers(self, rows, context):
        for row in rows:
            layer = QgsProcessingUtils.mapLayerFromString(row[0], context)
            if not isinstance(layer, QgsVectorLayer) or not layer.isValid():
                raise BadValue("Barriers: there is no layer %s, neither in the project nor as a file." % row[0])
            self.barriers.append((row, source.of_layer(layer, row[BARRIER_COLUMNS.index("Filter")]), True))

    def _prepare_chosen_barriers(self):
        """Prepares the layers from the list of barriers. They have neither a filter nor a field of widths."""
        for layer in self.chosen:
            if not isinstance(layer, QgsVectorLayer) or not layer.isValid():
                raise BadValue("Barriers: %s is no layer of features." % layer.name())
            self.barriers.append((row_of_layer(layer.name(), self.values), source.of_layer(layer), False))

    def _fix_unselected(self, parameters, context):
        layer = self.parameterAsVectorLayer(parameters, self.inputs[0].name, context)
        selected = set(layer.selectedFeatureIds()) if layer else set()
        if not selected:
            raise BadValue("Move only selected features: no feature of the layer is selected.")
        wished = self.marks.get("FIXED_WHERE")
        self.marks["FIXED_WHERE"] = lambda feature: feature.id() not in selected or bool(wished and wished(feature))

    # ---- The work ----

    def processAlgorithm(self, parameters, context, feedback):
        folder = os.path.dirname(QgsProcessingUtils.generateTempFilename("sunder.gpkg"))
        os.makedirs(folder, exist_ok=True)
        self.stays = False  # whether QGIS loads a layer from the program's GeoPackage, which has to stay then
        # parameterAsOutputLayer() is called once for each output. For a temporary output each call makes another one,
        # which QGIS loads.
        self.wanted = {each: self.parameterAsOutputLayer(parameters, each.name, context)
                       for each in self.outputs if self._is_wanted(parameters, each.name)}
        try:
            self._refuse_own_input()
            return self._run(folder, parameters, context, feedback)
        except BadValue as trouble:
            raise QgsProcessingException(str(trouble))
        finally:
            shutil.rmtree(folder if not self.stays else os.path.join(folder, "read"), ignore_errors=True)

    def _run(self, folder, parameters, context, feedback):
        self.names, self.added = {}, None  # the names of layers by their paths; the field that the plug-in added
        self.report = None
        os.makedirs(os.path.join(folder, "read"), exist_ok=True)
        self.copies = 0
        operands = self._operands(os.path.join(folder, "read"), QgsProcessingMultiStepFeedback(10, feedback))
        if feedback.isCanceled():
            return {}
        sheet = self.values.get("SPEC")
        written, figures = os.path.join(folder, "sunder.gpkg"), os.path.join(folder, "figures.json")
        if sheet:
            written = self._sheet_place(written, parameters, context)
        line = [self.sunder, self.command] + words(self.command, self.values) + operands
        line += self._words_of_sheet(written) if sheet else [written, "--output-layer=" + self.main]
        line += ["--stats=" + figures, "--progress=plain"]
        line += [] if sheet else self._words_of_outputs(self.wanted)
        line += self._words_of_files(parameters, context)
        feedback.pushCommandInfo(" ".join(_quoted(word) for word in line))
        begin = 10 * min(self.copies, 2)
        said = []
        status, told = program.run(line, lambda percent: feedback.setProgress(begin + percent * (100 - begin) / 100),
                                   said.append, feedback.isCanceled)
        self._print(said, feedback)
        if status is None:
            feedback.pushInfo("Cancelled; nothing was written.")
            return {}
        self._tell(told, status, feedback)
        self.look(written)
        results = self._deliver(written, parameters, context, feedback)
        if sheet:
            results.update(self._deliver_sheet(written, context))
        numbers = program.statistics(figures)
        if status == program.UNRESOLVED:
            feedback.pushWarning(self.unresolved(numbers))
        results.update(self.figures(numbers))
        return results

    def _refuse_own_input(self):
        """Raises BadValue if an output is a file that is read. QGIS would replace that file before it is read."""
        read = [layer for layer in self.sources.values() if layer] + [layer for _, layer, _ in self.barriers]
        files = {os.path.realpath(layer.path): layer.name for layer in read if layer.path}
        for each, destination in self.wanted.items():
            if os.path.realpath(destination) in files:
                raise BadValue("%s: %s is the file of the layer %s, which is read; choose another." %
                               (each.label, destination, files[os.path.realpath(destination)]))

    def _operands(self, folder, feedback):
        """Returns the arguments for operands, for layers of options, and for barriers. Layers that the program cannot
        read in place are copied into the folder."""
        found = []
        for each in self.inputs:
            layer = self.sources[each.name]
            if self.values.get("SPEC"):
                found += [_dataset(layer)] if layer else []
            elif layer is None:
                found.append(self.shapes[each.name])
            elif each is self.inputs[0] and len(self.inputs) == 1:
                found += self._first(layer, folder, feedback)
            else:
                path, _ = self._copied(layer, folder, each.name, feedback)
                found.append(path)
        for option in options.of_command(self.command):
            if option.kind == SOURCE and self.sources[option.name] and self.values.get("SPEC"):
                found.append("%s=%s" % (option.flag, _dataset(self.sources[option.name])))
            elif option.kind == SOURCE and self.sources[option.name]:
                path, _ = self._copied(self.sources[option.name], folder, option.name, feedback)
                found.append("%s=%s" % (option.flag, path))
        for row, layer, by_field in self.barriers:
            found.append("--barrier=" + self._barrier(row, layer, by_field, folder, feedback))
        return found

    def _first(self, layer, folder, feedback):
        """Returns the arguments for the only input layer of a command: its path, the name of the layer or the
        expressions for marked features, and the field of ids."""
        if layer.file and not self.marks:
            path, name = layer.file
            self.names[path] = layer.name
            return [path, "--input-layer=" + name]
        marks = [source.Marks("sunder_" + name.lower(), holds) for name, holds in self.marks.items()]
        path, ids = self._copied(layer, folder, self.inputs[0].name, feedback, marks)
        found = [path]
        for name, mark in zip(self.marks, marks):
            option = next(each for each in options.OPTIONS if each.name == name)
            found.append("%s=%s" % (option.flag, mark.sql))
        if "ID_FIELD" in {each.name for each in options.of_command(self.command)} and not self.values.get("ID_FIELD"):
            found.append("--id-field=%s" % ids)
        self.added = ids
        return found

    def _copied(self, layer, folder, name, feedback, marks=()):
        path = os.path.join(folder, name.lower() + ".gpkg")
        # The first copy gets a tenth of the progress, and all other copies together get another tenth.
        feedback.setCurrentStep(min(self.copies, 1))
        self.copies += 1
        feedback.pushInfo("Copying %s ..." % layer.name)
        self.names[path] = layer.name
        ids = source.copy(layer, path, table_of(layer.name), marks, feedback)
        return path, ids

    def _barrier(self, row, layer, by_field, folder, feedback):
        """Returns the value of --barrier for a row. by_field: whether the width of the row may be the name of a
        field."""
        path, name = layer.file or (None, None)
        if path is None:
            path, _ = self._copied(layer, folder, "barrier_%d" % (len(self.names) + 1), feedback)
            name = table_of(layer.name)
        self.names.setdefault(path, layer.name)  # the file may already have the name of another of its layers
        return barrier(row, unit_of(self.values), path, name,
                       [field.name() for field in layer.fields] if by_field else [])

    def _is_wanted(self, parameters, name):
        value = parameters.get(name)
        sink = getattr(value, "sink", value)
        return value is not None and getattr(sink, "staticValue", lambda: sink)() not in (None, "")

    def _words_of_outputs(self, wanted):
        return sorted({each.flag for each in wanted if each.flag})

    def _words_of_files(self, parameters, context):
        found = []
        for each in self.files:
            path = self.parameterAsFileOutput(parameters, each.name, context)
            if path:
                os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
                found.append("%s=%s" % (each.flag, path))
        return found

    def _tell(self, told, status, feedback):
        """Passes the messages of the program on: raises QgsProcessingException if the run failed, and otherwise reports
        them as warnings and notes."""
        errors = [program.plain(line, self.names) for line in told if program.is_error(line)]
        if status not in (program.DONE, program.UNRESOLVED):
            raise QgsProcessingException("\n".join(errors) or "\n".join(told) or
                                         "The program ended unexpectedly (%s)." % status)
        for line in told:
            if program.is_warning(line) or program.is_error(line):
                feedback.pushWarning(program.plain(line, self.names))
            else:
                feedback.pushConsoleInfo(program.plain(line, self.names))

    def _print(self, lines, feedback):
        """Passes the lines that the program printed on, with their columns aligned. In a window the log shows HTML."""
        from qgis.utils import iface
        for line in program.columns(lines):
            feedback.pushConsoleInfo(line if iface is None else program.unbroken(line))

    def _title(self, output):
        """Returns the name with which a result is loaded. It begins with the name of the input layer, if there is
        one."""
        names = [layer.name for layer in self.sources.values() if layer]
        return "%s: %s" % (names[0], output.label) if names else output.label

    def _deliver(self, written, parameters, context, feedback):
        there, results = result.layers_of(written), {}
        for each in self.outputs:
            name = self.main + each.suffix
            if self.added and name in there:
                result.drop_field(written, name, self.added)
        for each, destination in self.wanted.items():
            name = self.main + each.suffix
            if name in there:
                self.stays = self.stays or result.is_temporary(parameters[each.name])
                result.rename(destination, each.label, self._title(each), context)
                results[each.name] = result.deliver(written, name, parameters[each.name], destination, context,
                                                    feedback)
            else:
                feedback.pushInfo("%s: there is none in this run." % each.label)
                result.forget(destination, context)
        for each in self.files:
            path = self.parameterAsFileOutput(parameters, each.name, context)
            if path:
                results[each.name] = path
                if each.flag == "--report":
                    self.report = path
        return results

    def postProcessAlgorithm(self, context, feedback):
        """Opens the report if QGIS has a window. It is opened in the browser, since the page has a script."""
        from qgis.utils import iface
        if iface is not None and self.report:
            QDesktopServices.openUrl(QUrl.fromLocalFile(self.report))
        return {}

    # ---- With a specification: its layers are in one dataset, under their own names ----

    def _sheet_place(self, written, parameters, context):
        """Returns the path of the dataset that the program writes; `written` is the one in the temporary folder."""
        return written

    def _words_of_sheet(self, written):
        return ["--output=" + written, "--output-layer=" + self.main]

    def _deliver_sheet(self, written, context):
        """Delivers what the outputs of the dialog do not have."""
        return {}

    # ---- What an algorithm may say for itself ----

    def look(self, written):
        """Examines the GeoPackage that the program wrote, for what figures() and unresolved() need."""

    def unresolved(self, figures):
        """Returns the warning for exit status 3, from the figures of --stats."""
        return "%d conflicts remain." % program.conflicts_left(figures)

    def figures(self, figures):
        """Returns the numbers that the algorithm outputs, by their names, from the figures of --stats."""
        return {}


def table_of(name):
    """Returns the name of a layer, changed to a name of a table that needs no quotes."""
    return re.sub(r"\W+", "_", name).strip("_") or "layer"


def _dataset(layer):
    """Returns the path of the dataset that has the layer. The layers beside it are read, too, by the names that the
    specification gives them."""
    if not layer.path:
        raise BadValue("%s: with a specification this has to be a layer of a file." % layer.name)
    return layer.path


def _quoted(word):
    return "'%s'" % word.replace("'", "'\\''") if any(c in word for c in " '\"\\$|&;()<>*") else word
