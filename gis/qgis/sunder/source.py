"""Layers of QGIS to what the program reads.

A plain file that QGIS shows unchanged is read in place. All other layers are copied into a GeoPackage: memory, virtual
and database layers, filtered, edited and joined ones, selections, and layers whose CRS was changed in QGIS. Geometries
and doubles are unchanged. FIDs are kept if QGIS's ids may be FIDs. The id is also copied to a field of its own, since
ids of features that are not saved yet are negative.

Expressions of the dialog are QGIS's and are asked while copying; the ids for which one is true go into a table of their
own, beside the layer, which the SQL of --fixed-where and --ignore-where asks. That holds for selections of any size,
where a list of ids on a command line would not.
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
}  # all others are texts


class Source:
    """What is known of a layer before the work, by the thread that owns it. features(): an iterator, in any thread."""

    def __init__(self, name, fields, wkb_type, crs, features, count, layer, whole):
        self.name, self.fields, self.wkb_type, self.crs = name, fields, wkb_type, crs
        self.features, self.count = features, count
        self.path = _path(layer)                    # of the file that it lies in, or None
        self.file = file_of(layer) if whole else None
        self.keys = _keys(layer)                    # indices of fields that are the FID once more


def file_of(layer):
    """(path, layer's name) where the program may read the layer's own file, else None."""
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
    # One of several types of geometry in one layer is shown by QGIS as a layer of its own.
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
    """A layer as a whole, or those features for which an expression holds."""
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
    """What a parameter of Processing selects; layer: whose it is, or None. whole: that layer, with all its features."""
    # Invalid geometries are the program's business.
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
    """A value of a QGIS attribute as OGR's Python takes it; None for null."""
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
    """A layer of a new GeoPackage that takes features of QGIS."""

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
            unused = _unused(field.name(), used)  # names that differ in case alone are one to a database
            used.add(unused.lower())
            self._add_field(unused, *_TYPES.get(field.type(), (ogr.OFTString, ogr.OFSTNone)))
        self.id_field = _unused(ID_FIELD, used)
        self._add_field(self.id_field, ogr.OFTInteger64, ogr.OFSTNone)
        self.definition = self.layer.GetLayerDefn()
        # Bytes have a setter of their own.
        self.binary = [self.definition.GetFieldDefn(k).GetType() == ogr.OFTBinary for k in range(len(self.kept))]

    def _add_field(self, name, kind, subtype):
        field = ogr.FieldDefn(name, kind)
        field.SetSubType(subtype)
        self.layer.CreateField(field)

    def add(self, feature):
        """The FID that it got."""
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
    """Features for which something is true, as a table that SQL can ask."""

    def __init__(self, table, holds):
        self.table, self.holds = table, holds
        self.sql, self.ids = None, []

    def write(self, dataset, key):
        """After the layer; key: the name of its FIDs."""
        dataset.ExecuteSQL("CREATE TABLE %s (id INTEGER PRIMARY KEY)" % self.table)
        for begin in range(0, len(self.ids), 500):  # SQLite takes some hundred rows at once
            some = ",".join("(%d)" % each for each in self.ids[begin:begin + 500])
            dataset.ExecuteSQL("INSERT INTO %s VALUES %s" % (self.table, some))
        self.sql = '"%s" IN (SELECT id FROM %s)' % (key, self.table)


def expression_of(text, context, label):
    """A function of features: is the expression true of it? Null is no."""
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
    """Copies a source into a new GeoPackage. Returns the name of the field of QGIS's ids, or None if cancelled."""
    target = _Target(path, name, source)
    target.dataset.StartTransaction()
    every = max(1, (source.count or 0) // 100)
    negative = []
    for done, feature in enumerate(source.features()):
        if done % every == 0:
            if feedback.isCanceled():
                return None
            feedback.setProgress(100 * done / source.count if source.count and source.count > 0 else 0)
        # Those without a FID take what the others leave.
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
