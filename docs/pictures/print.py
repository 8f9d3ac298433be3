#!/usr/bin/env python3
"""Prints a separated layer, with the styles that came with it, on a sheet of A5: headless QGIS, the same steps as by hand.

    QT_QPA_PLATFORM=offscreen python3 print.py MAP.gpkg TOWN.gpkg SHEET.png [SHEET.pdf]
"""
import sys

from qgis.core import (QgsApplication, QgsLayoutExporter, QgsLayoutItemLabel, QgsLayoutItemMap, QgsLayoutItemScaleBar,
                       QgsLayoutPoint, QgsLayoutSize, QgsLineSymbol, QgsPrintLayout, QgsProject, QgsRectangle,
                       QgsSingleSymbolRenderer, QgsUnitTypes, QgsVectorLayer)
from qgis.PyQt.QtGui import QFont

result, town, *sheets = sys.argv[1:]
application = QgsApplication([], False)
application.initQgis()
project = QgsProject.instance()


def layer(path, name):
    found = QgsVectorLayer(f"{path}|layername={name}", name, "ogr")
    if not found.isValid():
        sys.exit(f"{path}: no layer {name}")
    project.addMapLayer(found)
    return found


millimetre = QgsUnitTypes.LayoutUnit.LayoutMillimeters
roads = layer(town, "roads")
roads.setRenderer(QgsSingleSymbolRenderer(QgsLineSymbol.createSimple(
    {"line_color": "#d8d2c4", "line_width": "1.5", "line_width_unit": "MM", "capstyle": "round"})))
buildings = layer(result, "buildings")
project.setCrs(buildings.crs())

layout = QgsPrintLayout(project)
layout.initializeDefaults()
layout.pageCollection().page(0).setPageSize(QgsLayoutSize(105, 74, millimetre))
sheet = QgsLayoutItemMap(layout)
layout.addLayoutItem(sheet)
sheet.attemptMove(QgsLayoutPoint(4, 4, millimetre))
sheet.attemptResize(QgsLayoutSize(97, 58, millimetre))
sheet.setLayers([buildings, roads])
sheet.setFrameEnabled(True)
sheet.setCrs(buildings.crs())
sheet.setExtent(QgsRectangle(450966, 5411089.75, 451451, 5411379.75)) # 97 by 58 mm at 1:5 000
label = QgsLayoutItemLabel(layout)
label.setText("The synthetic town, for a map at 1:25 000, drawn at 1:5 000")
label.setFont(QFont("DejaVu Sans", 6))
label.attemptMove(QgsLayoutPoint(4, 65, millimetre))
label.attemptResize(QgsLayoutSize(66, 6, millimetre))
layout.addLayoutItem(label)
bar = QgsLayoutItemScaleBar(layout)
bar.setLinkedMap(sheet)
bar.setUnits(QgsUnitTypes.DistanceUnit.DistanceMeters)
bar.setUnitsPerSegment(50)
bar.setNumberOfSegments(2)
bar.setNumberOfSegmentsLeft(0)
bar.setUnitLabel("m")
bar.setHeight(1)
bar.setFont(QFont("DejaVu Sans", 6))
bar.attemptMove(QgsLayoutPoint(74, 64, millimetre))
layout.addLayoutItem(bar)

exporter = QgsLayoutExporter(layout)
for path in sheets:
    if path.endswith(".pdf"):
        done = exporter.exportToPdf(path, QgsLayoutExporter.PdfExportSettings())
    else:
        settings = QgsLayoutExporter.ImageExportSettings()
        settings.dpi = 200
        done = exporter.exportToImage(path, settings)
    if done != QgsLayoutExporter.ExportResult.Success:
        sys.exit(f"{path}: not written")
