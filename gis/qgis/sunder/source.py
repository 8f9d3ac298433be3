"""Makes layers of QGIS readable for the program.

A plain file that QGIS shows unchanged is read in place. All other layers are copied into a GeoPackage: memory, virtual
and database layers, filtered, edited and joined ones, selections, and layers whose CRS was changed in QGIS. Geometries
and doubles are unchanged. FIDs are kept if QGIS's ids may be FIDs. The id is also copied to a field of its own, since
ids of features that are not saved yet are negative.

Expressions of the dialog are those of QGIS, and are evaluated while a layer is copied. The FIDs for which an expression
is true are written to a table of the same GeoPackage, which the SQL of --fixed-where and --ignore-where reads. So the
number of FIDs is not limited by the length of a command line.
"""
import os
import re

from osgeo import ogr, osr
from qgis.core import (QgsCoordinateReferenceSystem, QgsExpression, QgsFeatureRequest, QgsFields,
                       QgsProcessingFeatureSource, QgsProviderRegistry, QgsVectorLayerFeatureSource, QgsWkbTypes)
from qgis.PyQt.QtCore import Qt, QVariant

from .command_line import BadValue

ID_FIELD = "qgis_id"

_TYPES = {
    QVariant.Int: (ogr.OFTInteger, ogr.OFSTNone), QVariant.UInt: (ogr.OFTInteger64, ogr.OFSTNone),
    QVariant.LongLong: (ogr.OFTInteger64, ogr.OFSTNone), QVariant.ULongLong: (ogr.OFTInteger64, ogr.OFSTNone),
    QVariant.Bool: (ogr.OFTInteger, ogr.OFSTBoolean), QVariant.Double: (ogr.OFTReal, ogr.OFSTNone),
    QVariant.Date: (ogr.OFTDate, ogr.OFSTNone), QVariant.Time: (ogr.OFTTime, ogr.OFSTNone),
    QVariant.DateTime: (ogr.OFTDateTime, ogr.OFSTNone), QVariant.ByteArray: (ogr.OFTBinary, ogr.OFSTNone),
}  # types of fields in OGR; all types that are not listed become texts


class Source:
    """A layer as the thread that owns it sees it before the work. features() returns an iterator over its features, and
    may be called in any thread. whole: whether all features of the layer are meant."""

    def __init__(self, name, fields, wkb_type, crs, features, count, layer, whole):
        self.name, self.fields, self.wkb_type, self.crs = name, fields, wkb_type, crs
        self.features, self.count = features, count
        self.path = _path(layer)                    # the file that contains the layer, or None
        self.file = file_of(layer) if whole else None
        self.keys = _keys(layer)                    # indices of the fields that repeat the FID


def file_of(layer):
    """Returns the path and the name of a layer that the program can read in place from its file, otherwise None."""
    if not layer or layer.providerType() != "ogr" or layer.subsetString() or layer.isEditable() or layer.vectorJoins():
        return None
    fields = layer.fields()
    if any(fields.fieldOrigin(i) != QgsFields.FieldOrigin.OriginProvider for i in range(fields.count())):
        return None
    if layer.crs() != layer.dataProvider().crs():
        return None
    parts = QgsProviderRegistry.instance().decodeUri("ogr", layer.source())
    path, name = parts.get("path"), parts.get("layerName")
    if not path or not os.path.isfile(path) or any(parts.get(key) for key in parts if key not in ("path", "layerName")):
        return None
    layers = [each.split(layer.dataProvider().sublayerSeparator()) for each in layer.dataProvider().subLayers()]
    if not name and len(layers) == 1 and len(layers[0]) > 1:
        name = layers[0][1]
    # QGIS shows a layer with several types of geometry as several layers, one for each type.
    if not name or [each[1] for each in layers if len(each) > 1].count(name) > 1:
        return None
    return path, name


def _path(layer):
    if not layer or layer.providerType() != "ogr":
        return None
    return QgsProviderRegistry.instance().decodeUri("ogr", layer.source()).get("path")


def _keys(layer):
    return layer.primaryKeyAttributes() if layer and layer.providerType() == "ogr" else ()


def of_layer(layer, expression=""):
    """Returns the Source of a layer: of all its features, or of those for which an expression is true. Raises BadValue
    for an expression that has an error."""
    request = QgsFeatureRequest()
    if expression:
        if QgsExpression(expression).hasParserError():
            trouble = QgsExpression(expression).parserErrorString()
            raise BadValue("%s: the filter %s: %s" % (layer.name(), expression, trouble))
        request.setFilterExpression(expression)
    features = QgsVectorLayerFeatureSource(layer)
    return Source(layer.name(), layer.fields(), layer.wkbType(), layer.crs(), lambda: features.getFeatures(request),
                  layer.featureCount(), layer, whole=not expression)


def of_processing(source, layer, whole):
    """Returns the Source of what a parameter of Processing selects. layer is the layer that contains the features, or
    None; whole says whether all of its features are selected."""
    # QGIS does not check geometries, since the program treats invalid ones itself.
    as_they_are = QgsProcessingFeatureSource.Flag.FlagSkipGeometryValidityChecks
    return Source(source.sourceName(), source.fields(), source.wkbType(), source.sourceCrs(),
                  lambda: source.getFeatures(QgsFeatureRequest(), as_they_are),
                  source.featureCount(), layer, whole)


# ---- Copying ---------------------------------------------------------------------------------------------------------


def _ogr_type(wkb_type):
    flat = QgsWkbTypes.flatType(wkb_type)
    if flat == QgsWkbTypes.Type.Unknown:
        return ogr.wkbUnknown
    if flat == QgsWkbTypes.Type.NoGeometry:
        return ogr.wkbNone
    number = int(getattr(flat, "value", flat))  # with Qt 6 an enumerator need not be a number
    return ogr.GT_SetModifier(number, QgsWkbTypes.hasZ(wkb_type), QgsWkbTypes.hasM(wkb_type))


def _unused(name, used):
    while name.lower() in used:
        name += "_"
    return name


def _value(value):
    """Returns the value of a QGIS attribute as the Python functions of OGR take it; None for null."""
    if value is None or (isinstance(value, QVariant) and value.isNull()):
        return None
    if isinstance(value, QVariant):
        value = value.value()
    if hasattr(value, "toString") and hasattr(value, "isValid"):
        return value.toString(Qt.DateFormat.ISODateWithMs)
    if hasattr(value, "data") and not isinstance(value, memoryview):
        return bytes(value)
    return value


def _reference(crs):
    if not crs.isValid():
        return None
    reference = osr.SpatialReference()
    reference.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
    if re.fullmatch(r"(EPSG|ESRI|IGNF):\w+", crs.authid() or "") and reference.SetFromUserInput(crs.authid()) == 0:
        return reference
    reference.ImportFromWkt(crs.toWkt(QgsCoordinateReferenceSystem.WktVariant.WKT2_2018))
    return reference


class _Target:
    """A layer in a new GeoPackage, to which features of QGIS are copied."""

    def __init__(self, path, name, source):
        self.dataset = ogr.GetDriverByName("GPKG").CreateDataSource(path)
        self.kept = [i for i in range(source.fields.count()) if i not in source.keys]
        used = {source.fields[i].name().lower() for i in self.kept}
        geometry = _unused("geom", used)
        self.fid = _unused("fid", used | {geometry})
        self.layer = self.dataset.CreateLayer(name, _reference(source.crs), _ogr_type(source.wkb_type),
                                              ["FID=" + self.fid, "GEOMETRY_NAME=" + geometry, "SPATIAL_INDEX=NO"])
        used = {geometry, self.fid}
        for i in self.kept:
            field = source.fields[i]
            unused = _unused(field.name(), used)  # a database treats names that differ only in case as equal
            used.add(unused.lower())
            self._add_field(unused, *_TYPES.get(field.type(), (ogr.OFTString, ogr.OFSTNone)))
        self.id_field = _unused(ID_FIELD, used)
        self._add_field(self.id_field, ogr.OFTInteger64, ogr.OFSTNone)
        self.definition = self.layer.GetLayerDefn()
        # Binary fields need another function that sets their values.
        self.binary = [self.definition.GetFieldDefn(k).GetType() == ogr.OFTBinary for k in range(len(self.kept))]

    def _add_field(self, name, kind, subtype):
        field = ogr.FieldDefn(name, kind)
        field.SetSubType(subtype)
        self.layer.CreateField(field)

    def add(self, feature):
        """Copies a feature, and returns the FID of the copy. Raises BadValue if that fails."""
        row = ogr.Feature(self.definition)
        attributes = feature.attributes()
        for k, i in enumerate(self.kept):
            value = _value(attributes[i])
            if value is None:
                row.SetFieldNull(k)
            elif self.binary[k]:
                row.SetFieldBinaryFromHexString(k, bytes(value).hex())
            elif isinstance(value, (int, float, str)):
                row.SetField(k, int(value) if isinstance(value, bool) else value)
            else:
                row.SetField(k, str(value))
        row.SetField(len(self.kept), feature.id())
        if feature.id() >= 0:
            row.SetFID(feature.id())
        if feature.hasGeometry():
            row.SetGeometryDirectly(ogr.CreateGeometryFromWkb(bytes(feature.geometry().asWkb())))
        if self.layer.CreateFeature(row) != 0:
            raise BadValue("Feature %d could not be copied: %s" % (feature.id(), _last_error()))
        return row.GetFID()


def _last_error():
    from osgeo import gdal
    return gdal.GetLastErrorMsg()


class Marks:
    """The features for which holds(feature) is true, as a table of FIDs that SQL can read."""

    def __init__(self, table, holds):
        self.table, self.holds = table, holds
        self.sql, self.ids = None, []

    def write(self, dataset, key):
        """Writes the table, after all features were copied, and sets sql to the condition that selects them. key is the
        name of the column of FIDs of the layer."""
        dataset.ExecuteSQL("CREATE TABLE %s (id INTEGER PRIMARY KEY)" % self.table)
        for begin in range(0, len(self.ids), 500):  # SQLite takes some hundred rows in one statement
            some = ",".join("(%d)" % each for each in self.ids[begin:begin + 500])
            dataset.ExecuteSQL("INSERT INTO %s VALUES %s" % (self.table, some))
        self.sql = '"%s" IN (SELECT id FROM %s)' % (key, self.table)


def expression_of(text, context, label):
    """Returns a function that says whether the expression is true for a feature; null counts as false. Raises BadValue
    for an expression that has an error, and so does the function."""
    expression = QgsExpression(text)
    if expression.hasParserError() or not expression.prepare(context):
        raise BadValue("%s: %s" % (label, expression.parserErrorString() or expression.evalErrorString()))

    def holds(feature):
        context.setFeature(feature)
        value = expression.evaluate(context)
        if expression.hasEvalError():
            raise BadValue("%s, feature %d: %s" % (label, feature.id(), expression.evalErrorString()))
        return _value(value) not in (None, False, 0, "")

    return holds


def copy(source, path, name, marks, feedback):
    """Copies a Source into the layer `name` of a new GeoPackage, and writes the tables of the marks. Returns the name
    of the field that has the ids of QGIS, or None if the user cancelled."""
    target = _Target(path, name, source)
    target.dataset.StartTransaction()
    every = max(1, (source.count or 0) // 100)
    negative = []
    for done, feature in enumerate(source.features()):
        if done % every == 0:
            if feedback.isCanceled():
                return None
            feedback.setProgress(100 * done / source.count if source.count and source.count > 0 else 0)
        # Features without a FID are copied last, so that they get FIDs that no other feature has.
        if feature.id() < 0:
            negative.append(feature)
        else:
            _add(target, feature, marks)
    for feature in negative:
        _add(target, feature, marks)
    for mark in marks:
        mark.write(target.dataset, target.fid)
    target.dataset.CommitTransaction()
    return target.id_field


def _add(target, feature, marks):
    fid = target.add(feature)
    for mark in marks:
        if mark.holds(feature):
            mark.ids.append(fid)
