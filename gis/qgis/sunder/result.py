"""Delivers the layers of the program's GeoPackage to the destinations that the dialog names.

A temporary layer stays in that GeoPackage and is loaded from there; QGIS deletes the file when it ends. For all other
destinations (files, tables of GeoPackages (ogr:) and of PostGIS (postgres:)) QGIS writes the features one by one, with
their doubles.
"""
import os

from osgeo import ogr
from qgis.core import (QgsFeatureRequest, QgsFeatureSink, QgsProcessing, QgsProcessingContext,
                       QgsProcessingException,
                       QgsProcessingLayerPostProcessorInterface, QgsProcessingOutputLayerDefinition, QgsProcessingUtils,
                       QgsProperty, QgsVectorLayer)
from qgis.PyQt.QtXml import QDomDocument

# Formats from which a double is read back as it was written. (A shapefile may group rings in another way.)
EXACT_ENDINGS = (".gpkg", ".sqlite", ".fgb", ".shp")

# The table of styles, as QGIS itself makes it.
_STYLES = ("CREATE TABLE IF NOT EXISTS layer_styles (id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, "
           "f_table_catalog TEXT(256), f_table_schema TEXT(256), f_table_name TEXT(256), f_geometry_column TEXT(256), "
           "styleName TEXT(30), styleQML TEXT, styleSLD TEXT, useAsDefault BOOLEAN, description TEXT, owner TEXT(30), "
           "ui TEXT(30), update_time DATETIME DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ','now')))")


class Styled(QgsProcessingLayerPostProcessorInterface):
    """Gives a loaded layer the style that the program stored with it."""

    alive = {}  # keeps the objects alive, since QGIS does not own them

    def __init__(self, qml):
        super().__init__()
        self.qml = qml

    def postProcessLayer(self, layer, context, feedback):
        document = QDomDocument()
        document.setContent(self.qml)
        layer.importNamedStyle(document)
        layer.triggerRepaint()


def layers_of(path):
    """Returns the names of the layers in a GeoPackage; an empty list if it does not open."""
    dataset = ogr.Open(path)
    return [dataset.GetLayer(i).GetName() for i in range(dataset.GetLayerCount())] if dataset else []


def drop_field(path, layer, name):
    """Removes a field that the plug-in added, if the layer has it."""
    dataset = ogr.Open(path, 1)
    found = dataset.GetLayerByName(layer)
    index = found.GetLayerDefn().GetFieldIndex(name) if found else -1
    if index >= 0:
        found.DeleteField(index)


def style_of(path, layer):
    """Returns the style of a layer as QML; an empty text if the program stored none."""
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
    """Writes all features of a layer to a destination. Returns the source from which QGIS loads the result. Raises
    QgsProcessingException if that fails."""
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
    """Reads the written layer back, and warns if its format changed coordinates."""
    written = QgsVectorLayer(final, name, "ogr")
    pairs = zip(layer.getFeatures(), written.getFeatures())
    changed = sum(_multi(ours) != _multi(theirs) for ours, theirs in pairs)
    if not written.isValid() or written.featureCount() != layer.featureCount() or changed:
        feedback.pushWarning("%s: this format changed %d of %d geometries. What was proved is true of the coordinates "
                             "as the program wrote them; a GeoPackage keeps them." % (name, changed, layer.featureCount()))


def _keep_style(final, destination, qml):
    """Stores the style beside a file or in a GeoPackage, so that the layer has it whenever it is opened. No style is
    written to other databases."""
    if not qml or destination.startswith(("postgres:", "postgis:", "spatialite:")):
        return
    if _is_file(destination) and not destination.lower().endswith(".gpkg"):
        with open(os.path.splitext(destination)[0] + ".qml", "w", encoding="utf-8") as file:
            file.write(qml)
        return
    _store_style(*final.split("|layername=") if "|layername=" in final else (final, None), qml)


def _store_style(path, table, qml):
    """Stores the style in the table layer_styles of a GeoPackage. QGIS is not used for it, since it would ask in a
    window before replacing a style."""
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
    """Delivers one layer of the program's GeoPackage. value is the value of the output parameter, destination the text
    that Processing made from it. Returns the source from which QGIS loads the layer. If the layer is to be loaded, it
    is registered with that source and with its style."""
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


def load_all(path, context):
    """Registers all layers of a GeoPackage of the program to be loaded, each with its style, if there is a project."""
    if context.project() is None:
        return
    for name in reversed(layers_of(path)):
        if name == "layer_styles":
            continue
        final, qml = "%s|layername=%s" % (path, name), style_of(path, name)
        context.addLayerToLoadOnCompletion(final, QgsProcessingContext.LayerDetails(name, context.project(), name))
        if qml:
            Styled.alive[final] = Styled(qml)
            context.layerToLoadOnCompletionDetails(final).setPostProcessor(Styled.alive[final])


def rename(destination, label, title, context):
    """Sets the name with which a layer is loaded to `title`, if it is the label of its parameter. A name that the user
    chose is not changed."""
    loads = context.layersToLoadOnCompletion()
    details = loads.get(destination)
    if details is not None and details.name == label:
        details.name = title
        loads[destination] = details
        context.setLayersToLoadOnCompletion(loads)


def count(path, layer, where):
    """Returns the number of rows for which the SQL condition `where` is true, in a layer of the program's GeoPackage; 0
    if there is no such layer."""
    dataset = ogr.Open(path)
    found = dataset.GetLayerByName(layer) if dataset else None
    if found is None:
        return 0
    found.SetAttributeFilter(where)
    return found.GetFeatureCount()


def forget(destination, context):
    """Removes an output that was not written from the layers that QGIS loads at the end."""
    loads = context.layersToLoadOnCompletion()
    if loads.pop(destination, None):
        context.setLayersToLoadOnCompletion(loads)
