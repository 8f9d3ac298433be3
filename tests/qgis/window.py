"""Runs within the window of QGIS (qgis --code): fills and runs the dialog of sunder:separate as a user would, and
takes pictures. window.sh prepares the scene and checks the report: its last line is "done" if all steps succeeded.

    WINDOW_FOLDER: the folder of town.gpkg, of the pictures and of report.txt
"""
import os
import traceback

import processing
from qgis.core import QgsProject, QgsVectorLayer
from qgis.PyQt.QtCore import QTimer
from qgis.PyQt.QtWidgets import QApplication, QTextEdit
from qgis.utils import iface

FOLDER = os.environ["WINDOW_FOLDER"]


def tell(line):
    with open(os.path.join(FOLDER, "report.txt"), "a") as report:
        report.write(line + "\n")


def end():
    os._exit(0)  # otherwise QGIS asks whether to save the project


def guarded(step):
    """A step whose error ends the whole run, since it would go unnoticed otherwise."""

    def run(*arguments):
        try:
            step(*arguments)
        except Exception:
            tell(traceback.format_exc())
            end()

    return run


def picture(widget, name):
    widget.grab().save(os.path.join(FOLDER, name))


@guarded
def begin():
    for name, title in (("buildings", "Houses"), ("roads", "Roads")):
        layer = QgsVectorLayer(os.path.join(FOLDER, "town.gpkg") + "|layername=" + name, title, "ogr")
        QgsProject.instance().addMapLayer(layer)
        if name == "buildings":
            iface.setActiveLayer(layer)
            QgsProject.instance().setCrs(layer.crs())
            iface.zoomToActiveLayer()
    window.dialog = processing.createAlgorithmDialog("sunder:separate", {
        "INPUT": "Houses", "GAP": 3, "UNIT": 1, "MAX_SHIFT": 5, "BARRIER_LAYERS": ["Roads"], "BARRIER_WIDTH": 6,
        "REPORT": os.path.join(FOLDER, "moves.html")})
    window.dialog.resize(900, 760)
    window.dialog.algorithmFinished.connect(finished)
    window.dialog.show()
    QTimer.singleShot(1500, run)


@guarded
def run():
    picture(window.dialog, "dialog.png")
    window.dialog.runButton().click()


@guarded
def finished(successful, results):
    if not successful:
        tell("the algorithm failed: " + window.dialog.messageBar().currentItem().text() if
             window.dialog.messageBar().currentItem() else "the algorithm failed")
    QTimer.singleShot(4000, look)


@guarded
def look():
    picture(window.dialog, "log.png")
    for log in window.dialog.findChildren(QTextEdit):
        for line in log.toPlainText().replace("\u00a0", " ").splitlines():
            tell("log: " + line)
    names = [layer.name() for layer in QgsProject.instance().mapLayers().values()]
    tell("layers: " + ", ".join(sorted(names)))
    for layer in QgsProject.instance().mapLayers().values():
        tell("%s: %d features, %s" % (layer.name(), layer.featureCount(), layer.renderer().type()))
    window.dialog.close()
    QApplication.processEvents()
    for name in ("Houses",):
        node = QgsProject.instance().layerTreeRoot().findLayer(QgsProject.instance().mapLayersByName(name)[0])
        node.setItemVisibilityChecked(False)
    QTimer.singleShot(3000, close)


@guarded
def close():
    picture(iface.mainWindow(), "window.png")
    tell("done")
    end()


class window:
    dialog = None


QTimer.singleShot(3000, begin)
