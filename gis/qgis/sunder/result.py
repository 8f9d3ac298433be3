"""Layers of the program's GeoPackage to where the dialog wants them.

What is temporary stays in that GeoPackage, which QGIS deletes at its end, and is loaded from there. All else - files,
tables of GeoPackages (ogr:), of PostGIS (postgres:) - is written by QGIS, feature by feature, with its doubles.
"""
import os

from osgeo import ogr
from qgis.core import (QgsFeatureRequest, QgsFeatureSink, QgsProcessing, QgsProcessingException,
                       QgsProcessingLayerPostProcessorInterface, QgsProcessingOutputLayerDefinition, QgsProcessingUtils,
                       QgsProperty, QgsVectorLayer)
from qgis.PyQt.QtXml import QDomDocument

# Of these a double comes back as it was written. (Shapefiles regroup rings.)
EXACT_ENDINGS = (".gpkg", ".sqlite", ".fgb", ".shp")

# As QGIS itself makes it.
_STYLES = ("CREATE TABLE IF NOT EXISTS layer_styles (id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, "
           "f_table_catalog TEXT(256), f_table_schema TEXT(256), f_table_name TEXT(256), f_geometry_column TEXT(256), "
           "styleName TEXT(30), styleQML TEXT, styleSLD TEXT, useAsDefault BOOLEAN, description TEXT, owner TEXT(30), "
           "ui TEXT(30), update_time DATETIME DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ','now')))")


class Styled(QgsProcessingLayerPostProcessorInterface):
    """Gives a layer that was loaded the looks that the program stored with it."""

    alive = {}  # QGIS owns none of them

    def __init__(self, qml):
        super().__init__()
        self.qml = qml

    def postProcessLayer(self, layer, context, feedback):
        document = QDomDocument()
        document.setContent(self.qml)
        layer.importNamedStyle(document)
        layer.triggerRepaint()


def layers_of(path):
    """Names of the layers in a GeoPackage of the program."""
    dataset = ogr.Open(path)
    return [dataset.GetLayer(i).GetName() for i in range(dataset.GetLayerCount())] if dataset else []


def drop_field(path, layer, name):
    """Takes away a field that the plug-in had added."""
    dataset = ogr.Open(path, 1)
    found = dataset.GetLayerByName(layer)
    index = found.GetLayerDefn().GetFieldIndex(name) if found else -1
    if index >= 0:
        found.DeleteField(index)


def style_of(path, layer):
    """The QML of a layer; empty where the program stored none."""
    dataset = ogr.Open(path)
    if dataset.GetLayerByName("layer_styles") is None:
        return ""
    rows = dataset.ExecuteSQL("SELECT styleQML FROM layer_styles WHERE useAsDefault = 1 AND f_table_name = %s" %
                              _sql(layer))
    row = rows.GetNextFeature() if rows else None
    qml = row.GetFieldAsString(0) if row else ""
    if rows:
        dataset.ReleaseResultSet(rows)
    return qml


def is_temporary(value):
    if isinstance(value, QgsProcessingOutputLayerDefinition):
        value = value.sink
    if isinstance(value, QgsProperty):
        value = value.staticValue()
    return value == QgsProcessing.TEMPORARY_OUTPUT or str(value).startswith("memory:")


def _is_file(destination):
    return not destination.startswith(("ogr:", "postgres:", "postgis:", "spatialite:", "memory:"))


def _write(layer, destination, context, feedback):
    """All features of a layer to a destination. Returns what QGIS loads it by."""
    sink, final = QgsProcessingUtils.createFeatureSink(destination, context, layer.fields(), layer.wkbType(),
                                                       layer.crs())
    if sink is None:
        raise QgsProcessingException("%s could not be written." % destination)
    if not (sink.addFeatures(layer.getFeatures(QgsFeatureRequest()), QgsFeatureSink.Flag.FastInsert) and
            sink.flushBuffer()):
        raise QgsProcessingException("%s could not be written: %s" % (destination, sink.lastError()))
    del sink  # closes it
    return final


def _multi(feature):
    geometry = feature.geometry()
    geometry.convertToMultiType()
    return bytes(geometry.asWkb())


def _compare(layer, final, name, feedback):
    """What a text format made of the coordinates, by reading it back."""
    written = QgsVectorLayer(final, name, "ogr")
    pairs = zip(layer.getFeatures(), written.getFeatures())
    changed = sum(_multi(ours) != _multi(theirs) for ours, theirs in pairs)
    if not written.isValid() or written.featureCount() != layer.featureCount() or changed:
        feedback.pushWarning("%s: this format changed %d of %d geometries. What was proved is true of the coordinates "
                             "as the program wrote them; a GeoPackage keeps them." % (name, changed, layer.featureCount()))


def _keep_style(final, destination, qml):
    """Beside or in what was written, so that it looks so whenever it is opened. A database of others is left alone."""
    if not qml or destination.startswith(("postgres:", "postgis:", "spatialite:")):
        return
    if _is_file(destination) and not destination.lower().endswith(".gpkg"):
        with open(os.path.splitext(destination)[0] + ".qml", "w", encoding="utf-8") as file:
            file.write(qml)
        return
    _store_style(*final.split("|layername=") if "|layername=" in final else (final, None), qml)


def _store_style(path, table, qml):
    """In layer_styles of a GeoPackage. Not by QGIS, which would ask in a window about one that is there."""
    dataset = ogr.Open(path, 1)
    if dataset is None:
        return
    table = table or dataset.GetLayer(0).GetName()
    column = dataset.GetLayerByName(table).GetGeometryColumn()
    dataset.ExecuteSQL(_STYLES)
    dataset.ExecuteSQL("DELETE FROM layer_styles WHERE f_table_name = %s" % _sql(table))
    dataset.ExecuteSQL("INSERT INTO layer_styles (f_table_catalog, f_table_schema, f_table_name, f_geometry_column, "
                       "styleName, styleQML, styleSLD, useAsDefault, description, owner) VALUES ('', '', %s, %s, "
                       "'sunder', %s, '', 1, 'drawn for the results of sunder', 'sunder')" %
                       (_sql(table), _sql(column), _sql(qml)))


def _sql(text):
    return "'%s'" % text.replace("'", "''")


def deliver(path, name, value, destination, context, feedback):
    """Puts one layer of the program's GeoPackage where the dialog wants it: value is the parameter's, destination what
    Processing made of it. Returns what QGIS loads it by, and sees that it is loaded so, where it is to be loaded."""
    ours, qml = "%s|layername=%s" % (path, name), style_of(path, name)
    if is_temporary(value):
        final = ours
    else:
        layer = QgsVectorLayer(ours, name, "ogr")
        if not layer.isValid():
            raise QgsProcessingException("The layer %s of the results does not open." % name)
        final = _write(layer, destination, context, feedback)
        _keep_style(final, destination, qml)
        if _is_file(destination) and not destination.lower().endswith(EXACT_ENDINGS):
            _compare(layer, final, os.path.basename(destination), feedback)
    loads = context.layersToLoadOnCompletion()
    if destination in loads:
        details = loads.pop(destination)
        loads[final] = details
        context.setLayersToLoadOnCompletion(loads)
        if qml:
            Styled.alive[final] = Styled(qml)
            context.layerToLoadOnCompletionDetails(final).setPostProcessor(Styled.alive[final])
    return final


def rename(destination, label, title, context):
    """A layer that would be loaded under the label of its parameter gets a title; a name that was chosen stays."""
    loads = context.layersToLoadOnCompletion()
    details = loads.get(destination)
    if details is not None and details.name == label:
        details.name = title
        loads[destination] = details
        context.setLayersToLoadOnCompletion(loads)


def count(path, layer, where):
    """How many rows of a layer of the program's GeoPackage a condition holds for."""
    dataset = ogr.Open(path)
    found = dataset.GetLayerByName(layer) if dataset else None
    if found is None:
        return 0
    found.SetAttributeFilter(where)
    return found.GetFeatureCount()


def forget(destination, context):
    """An output that there is none of is not loaded."""
    loads = context.layersToLoadOnCompletion()
    if loads.pop(destination, None):
        context.setLayersToLoadOnCompletion(loads)
