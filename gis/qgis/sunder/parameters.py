"""Makes a parameter of Processing from a row of the table of options, and reads its value. algorithm.py reads the
values of layers, expressions and barriers."""
from qgis.core import (QgsProcessing, QgsProcessingParameterBoolean, QgsProcessingParameterEnum,
                       QgsProcessingParameterDistance, QgsProcessingParameterExpression,
                       QgsProcessingParameterFeatureSource, QgsProcessingParameterField,
                       QgsProcessingParameterFile, QgsProcessingParameterMatrix,
                       QgsProcessingParameterMultipleLayers, QgsProcessingParameterNumber,
                       QgsProcessingParameterPoint, QgsProcessingParameterScale, QgsProcessingParameterString)

from .command_line import BARRIER_COLUMNS
from .options import (BARRIER_LAYERS, BARRIER_LENGTH, BARRIERS, CHOICE, COUNT, EXPRESSION, FIELD, FILE, FLAG, LENGTH, NUMBER,
                      NUMERIC_FIELD, POINT, SCALE, SOURCE, TEXT)


def parameter(option, layer):
    """Returns the parameter for an option. layer is the name of the layer parameter from which fields are chosen, and
    in whose unit lengths are."""
    name, label, optional = option.name, option.label, not option.needed
    if option.kind in (LENGTH, BARRIER_LENGTH):
        return QgsProcessingParameterDistance(name, label, option.default, layer, optional=option.default is None,
                                              minValue=0)
    if option.kind in (NUMBER, COUNT):
        kinds = QgsProcessingParameterNumber.Type
        return QgsProcessingParameterNumber(name, label, kinds.Integer if option.kind == COUNT else kinds.Double, option.default, optional=option.default is None,
                                            minValue=0)
    if option.kind == SCALE:
        return QgsProcessingParameterScale(name, label, optional=True)
    if option.kind == FLAG:
        return QgsProcessingParameterBoolean(name, label, option.default)
    if option.kind == CHOICE:
        return QgsProcessingParameterEnum(name, label, list(option.labels), defaultValue=option.default)
    if option.kind in (FIELD, NUMERIC_FIELD):
        kinds = QgsProcessingParameterField.DataType
        return QgsProcessingParameterField(name, label, None, layer,
                                           kinds.Numeric if option.kind == NUMERIC_FIELD else kinds.Any, optional=True)
    if option.kind == EXPRESSION:
        return QgsProcessingParameterExpression(name, label, "", layer, optional=True)
    if option.kind == POINT:
        return QgsProcessingParameterPoint(name, label, optional=optional)
    if option.kind == BARRIER_LAYERS:
        return QgsProcessingParameterMultipleLayers(name, label, QgsProcessing.SourceType.TypeVectorAnyGeometry,
                                                    optional=True)
    if option.kind == BARRIERS:
        return QgsProcessingParameterMatrix(name, label, 1, False, list(BARRIER_COLUMNS), optional=True)
    if option.kind == FILE:
        return QgsProcessingParameterFile(name, label, optional=True, fileFilter="Specifications (*.json)")
    if option.kind == SOURCE:
        return QgsProcessingParameterFeatureSource(name, label, [QgsProcessing.SourceType.TypeVectorAnyGeometry],
                                                   optional=True)
    assert option.kind == TEXT, option
    return QgsProcessingParameterString(name, label, option.default, optional=optional)


def value(algorithm, option, parameters, context, layer):
    """Returns the value of an option as command_line.py takes it: a number, an index, a text, a pair of coordinates, or
    None if there is no value. A point is transformed to the CRS of `layer`, unless that is None."""
    name = option.name
    if option.kind == FLAG:
        return algorithm.parameterAsBoolean(parameters, name, context)
    if option.kind == CHOICE:
        return algorithm.parameterAsEnum(parameters, name, context)
    if option.kind in (FIELD, NUMERIC_FIELD):
        return (algorithm.parameterAsFields(parameters, name, context) or [None])[0]
    if option.kind == POINT:
        point = algorithm.parameterAsPoint(parameters, name, context, *([layer.crs] if layer else []))
        return point.x(), point.y()
    if parameters.get(name) in (None, ""):
        return None
    if option.kind == COUNT:
        return algorithm.parameterAsInt(parameters, name, context)
    if option.kind in (LENGTH, BARRIER_LENGTH, NUMBER, SCALE):
        return algorithm.parameterAsDouble(parameters, name, context)
    return algorithm.parameterAsString(parameters, name, context)
