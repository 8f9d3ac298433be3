"""Opens layers of a GeoPackage in QGIS as a user would (their stored default styles apply), draws them and counts
pixels.

    render_colours.py FILE PICTURE LAYER... -- NAME=R,G,B=PIXELS...

Layers are drawn in the order given, the first at the bottom. After a name, ! ticks all boxes of its legend first.
Each colour has to have at least PIXELS pixels; without antialiasing a symbol's colour is drawn exactly. Exit status 1
if a layer does not open, if the file has no style for it, or if a colour is missing.
"""
import sys

from qgis.core import Qgis, QgsApplication, QgsMapRendererParallelJob, QgsMapSettings, QgsVectorLayer
from qgis.PyQt.QtCore import QSize
from qgis.PyQt.QtGui import QColor


def count_colours(image):
    counts = {}
    for y in range(image.height()):
        for x in range(image.width()):
            rgb = image.pixel(x, y) & 0xFFFFFF
            counts[rgb] = counts.get(rgb, 0) + 1
    return counts


def open_layers(path, names):
    layers = []
    for name, marked in ((each.rstrip("!"), each.endswith("!")) for each in names):
        layer = QgsVectorLayer("%s|layername=%s" % (path, name), name, "ogr")
        if not layer.isValid():
            print("layer %s does not open" % name)
            return None
        print("layer %s: %d features, renderer %s" % (name, layer.featureCount(), layer.renderer().type()))
        for item in layer.renderer().legendSymbolItems() if marked else []:
            layer.renderer().checkLegendSymbolItem(item.ruleKey(), True)
        layers.append(layer)
    return layers


def draw(layers, picture):
    settings = QgsMapSettings()
    settings.setLayers(list(reversed(layers)))  # QGIS wants the topmost layer first
    extent = layers[0].extent()
    extent.scale(1.05)
    settings.setExtent(extent)
    settings.setOutputSize(QSize(1000, 1000))
    settings.setBackgroundColor(QColor("white"))
    settings.setDestinationCrs(layers[0].crs())
    settings.setFlag(QgsMapSettings.Flag.Antialiasing, False)
    job = QgsMapRendererParallelJob(settings)
    job.start()
    job.waitForFinished()
    for error in job.errors():
        print("drawing %s: %s" % (error.layerID, error.message))
    image = job.renderedImage()
    image.save(picture)
    return image if not job.errors() else None


def main(arguments):
    split = arguments.index("--")
    path, picture, names, wanted = arguments[0], arguments[1], arguments[2:split], arguments[split + 1:]
    layers = open_layers(path, names)
    image = layers and draw(layers, picture)
    if not image:
        return 1
    counts = count_colours(image)
    missing = 0
    for each in wanted:
        name, colour, least = each.split("=")
        red, green, blue = (int(part) for part in colour.split(","))
        found = counts.get(red << 16 | green << 8 | blue, 0)
        print("%s (%s): %d pixels, at least %s wanted" % (name, colour, found, least))
        missing += found < int(least)
    return 1 if missing else 0


def run():
    # All objects of QGIS are destroyed within main(), before exitQgis(): otherwise the interpreter crashes at its end.
    QgsApplication.setPrefixPath("/usr", True)
    application = QgsApplication([], False)
    application.initQgis()
    print("QGIS", Qgis.QGIS_VERSION)
    status = main(sys.argv[1:])
    application.exitQgis()
    return status


sys.exit(run())
