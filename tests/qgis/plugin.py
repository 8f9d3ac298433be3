"""The plug-in's algorithms in a headless QGIS, compared with the program itself. The name of each test states what
has to hold.

    SUNDER=program SUNDER_SOURCE=sources python3 plugin.py     (plugin.sh sets up the profile)

Geometries are compared as WKB, byte for byte, by FID.
"""
import faulthandler
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path[:0] = ["/usr/share/qgis/python/plugins", os.path.join(os.environ["SUNDER_SOURCE"], "gis", "qgis")]

from osgeo import ogr  # noqa: E402
from qgis.core import (QgsApplication, QgsCategorizedSymbolRenderer, QgsCoordinateReferenceSystem, QgsExpression, QgsFeature, QgsFeatureRenderer,  # noqa: E402
                       QgsFeatureRequest, QgsGeometry, QgsProcessingContext,
                       QgsProcessingException, QgsProcessingFeatureSourceDefinition, QgsProcessingFeedback,
                       QgsProcessingOutputLayerDefinition, QgsProject, QgsRendererCategory, QgsVectorLayer, QgsWkbTypes)
from qgis.PyQt.QtCore import QByteArray, QDate, QDateTime, QTime  # noqa: E402

SUNDER = os.environ["SUNDER"]
# A copy: QGIS may change a GeoPackage by opening it.
TOWN = shutil.copy(os.path.join(os.environ["SUNDER_SOURCE"], "datasets-synthetic", "town.gpkg"), tempfile.mkdtemp())
DATA = os.path.join(os.environ["SUNDER_SOURCE"], "..", "shared", "data")
TEMPORARY = "TEMPORARY_OUTPUT"


class Feedback(QgsProcessingFeedback):
    """A feedback object that records messages, and can cancel at a given percentage."""

    def __init__(self, cancel_at=None):
        super().__init__(False)
        self.told, self.cancel_at = [], cancel_at
        self.progressChanged.connect(self.reached)
        self.percents = []

    def reached(self, percent):
        self.percents.append(percent)
        if self.cancel_at is not None and percent >= self.cancel_at:
            self.cancel()

    def pushWarning(self, text):
        self.told.append("warning: " + text)

    def reportError(self, text, fatal=False):
        self.told.append("error: " + text)

    def pushInfo(self, text):
        self.told.append(text)

    pushCommandInfo = pushConsoleInfo = pushDebugInfo = pushInfo

    def warnings(self):
        return [each for each in self.told if each.startswith("warning: ")]


def rows(dataset, layer=None):
    """For each feature, by FID: geometry as WKB, attributes."""
    opened = ogr.Open(dataset.split("|")[0])
    assert opened, dataset
    name = layer or (dataset.split("layername=")[1] if "layername=" in dataset else None)
    found = opened.GetLayerByName(name) if name else opened.GetLayer(0)
    assert found, (dataset, name)
    return {row.GetFID(): (row.GetGeometryRef() and bytes(row.GetGeometryRef().ExportToIsoWkb()), row.items())
            for row in found}


def geometries(dataset, layer=None):
    return {fid: wkb for fid, (wkb, _) in rows(dataset, layer).items()}


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.feedback = Feedback()

    def file(self, name):
        return os.path.join(self.folder, name)

    def source(self, layer):
        return layer.source() if isinstance(layer, QgsVectorLayer) else layer

    def refused(self, words, name, parameters):
        """The run fails with these words in the exception, or in a message before Processing raises its own
        exception."""
        with self.assertRaises(QgsProcessingException) as error:
            self.run_algorithm(name, parameters)
        said = "\n".join([str(error.exception)] + self.feedback.told)
        self.assertIn(words, said)
        return said

    def sunder(self, *words, status=0):
        done = subprocess.run([SUNDER] + list(words), stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stdout

    def run_algorithm(self, name, parameters, feedback=None):
        import processing
        context = QgsProcessingContext()
        context.setProject(QgsProject.instance())
        self.context = context
        return processing.run("sunder:" + name, parameters, feedback=feedback or self.feedback, context=context)

    def town(self, subset=""):
        layer = QgsVectorLayer(TOWN + "|layername=buildings", "Houses", "ogr")
        self.assertTrue(layer.isValid())
        if subset:
            self.assertTrue(layer.setSubsetString(subset))
        return layer

    def memory_copy(self, layer):
        copied = layer.materialize(QgsFeatureRequest())
        copied.setName("Copied houses")
        return copied

    def by_program(self, *words):
        """The result of the program for the town."""
        written = self.file("program.gpkg")
        self.sunder("separate", "--input-layer=buildings", TOWN, written, "--quiet", "--overwrite", "--allow-conflicts",
                    *words)
        return written


class SheetTest(Case):
    """A specification in place of a layer, and one that is written from layers of the project."""

    def sheet(self):
        self.points = self.file("points.gpkg")
        subprocess.run(["ogr2ogr", self.points, TOWN, "-nln", "points", "-dialect", "SQLite", "-sql",
                        "SELECT fid AS house, ST_PointOnSurface(geom) AS geom FROM buildings WHERE fid < 40"], check=True)
        path = self.file("sheet.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump({"defaults": {"max_shift": 5}, "layers": [
                {"name": "houses", "source": TOWN, "layer": "buildings", "role": "move"},
                {"name": "marks", "source": "points.gpkg", "role": "move", "symbol": "square:2", "max_shift": 20},
                {"name": "roads", "source": TOWN, "layer": "roads", "role": "barrier", "width": 5},
                {"name": "along", "source": "points.gpkg", "role": "follow", "of": "houses"}],
                "gaps": [{"between": ["*", "*"], "gap": 2}]}, file)
        return path

    def test_separate_and_check(self):
        sheet, written, theirs = self.sheet(), self.file("sheet.gpkg"), self.file("theirs.gpkg")
        done = self.run_algorithm("separate", {"SPEC": sheet, "SHEET": written, "OUTPUT": TEMPORARY, "CONFLICTS": TEMPORARY})
        self.sunder("separate", "--spec=" + sheet, theirs, "--quiet", "--allow-conflicts")
        names = [layer.GetName() for layer in ogr.Open(theirs)]
        self.assertEqual([layer.GetName() for layer in ogr.Open(written)], names)
        for name in ("houses", "marks", "along", "marks_symbols", "sheet_conflicts"):
            self.assertIn(name, names)
            self.assertEqual(rows(written, name), rows(theirs, name), name)
        self.assertEqual(done["SHEET"], written)
        self.assertGreater(done["MOVED"], 20)
        loads = self.context.layersToLoadOnCompletion()
        self.assertEqual({each.split("layername=")[1] for each in loads}, set(names) - {"layer_styles"})
        # The check of the result, and of what the sheet names as it stands.
        layer = QgsVectorLayer(written + "|layername=houses", "Moved", "ogr")
        left = self.run_algorithm("check", {"SPEC": sheet, "INPUT": layer, "OUTPUT": TEMPORARY})
        self.assertEqual(left["FEATURES"], 280 + 39)
        self.assertEqual(left["CONFLICTS"], done["CONFLICTS_AFTER"])
        before = self.run_algorithm("check", {"SPEC": sheet, "OUTPUT": TEMPORARY})
        self.assertEqual(before["CONFLICTS"], done["CONFLICTS_BEFORE"])
        listed = [row for _, row in rows(self.source(before["OUTPUT"])).values() if row["reason"] != "same_block"]
        self.assertEqual(len(listed), before["CONFLICTS"])

    def test_the_dialog_goes_before_the_sheet(self):
        sheet, written, theirs = self.sheet(), self.file("sheet.gpkg"), self.file("theirs.gpkg")
        self.run_algorithm("separate", {"SPEC": sheet, "SHEET": written, "MAX_SHIFT": 1, "GAP": 1})
        self.sunder("separate", "--spec=" + sheet, theirs, "--max-shift=1", "--gap=1", "--quiet", "--allow-conflicts")
        self.assertEqual(rows(written, "houses"), rows(theirs, "houses"))

    def test_what_is_refused(self):
        sheet = self.sheet()
        self.refused("leave the layer to separate empty", "separate", {"SPEC": sheet, "INPUT": self.town(), "SHEET": self.file("x.gpkg")})
        self.refused("choose it at the end", "separate", {"SPEC": sheet})
        self.refused("a layer or a specification is needed", "separate", {"GAP": 3})
        self.refused("such a condition stands there", "separate", {"SPEC": sheet, "SHEET": self.file("x.gpkg"), "FIXED_WHERE": "fid = 3"})
        with open(sheet, "w", encoding="utf-8") as file:
            file.write('{"layers": []}')
        self.refused("none has the role move", "separate", {"SPEC": sheet, "SHEET": self.file("x.gpkg")})

    def test_one_is_written_from_the_project(self):
        self.sheet()
        houses, roads = self.town("fid > 5"), QgsVectorLayer(TOWN + "|layername=roads", "Big roads", "ogr")
        marks, along = QgsVectorLayer(self.points, "marks", "ogr"), QgsVectorLayer(self.points, "marks", "ogr")
        symbol, thin = roads.renderer().symbol().clone(), roads.renderer().symbol().clone()
        symbol.setWidth(0.6)
        thin.setWidth(0.4)
        roads.setRenderer(QgsCategorizedSymbolRenderer("kind", [QgsRendererCategory("main_street", symbol, ""),
                                                                QgsRendererCategory("", thin, "")]))
        marks.renderer().symbol().setSize(0.5)
        written = self.file("made.json")
        self.run_algorithm("specification", {
            "MOVING": [houses, marks], "BARRIERS": [roads], "FOLLOWING": [along], "SCALE": 10000, "GAP": "0.2mm",
            "BARRIER_GAP": "0.1mm", "MAX_SHIFT": "0.5mm", "OUTPUT": written})
        with open(written, encoding="utf-8") as file:
            made = json.load(file)
        self.assertEqual(made["scale"], "1:10000")
        self.assertEqual(made["defaults"], {"max_shift": "0.5mm"})
        self.assertEqual(made["layers"], [
            {"name": "Houses", "source": os.path.realpath(TOWN), "layer": "buildings", "role": "move", "where": "fid > 5"},
            {"name": "marks", "source": "points.gpkg", "layer": "points", "role": "move", "symbol": "square:0.5mm"},
            {"name": "Big_roads", "source": os.path.realpath(TOWN), "layer": "roads", "role": "barrier",
             "width": {"by": "kind", "of": {"main_street": "0.6mm"}, "else": "0.4mm"}},
            {"name": "marks_2", "source": "points.gpkg", "layer": "points", "role": "follow"}])
        self.assertEqual(made["gaps"], [{"between": ["*", "*"], "gap": "0.2mm"}, {"between": ["*", "Big_roads"], "gap": "0.1mm"}])
        done = self.run_algorithm("separate", {"SPEC": written, "SHEET": self.file("made.gpkg")})
        self.assertEqual(done["FEATURES"], 275 + 39)
        self.assertEqual(len(rows(self.file("made.gpkg"), "marks_2")), 39)
        # A mistake is found when it is written, and then there is no file.
        self.refused("parsecs", "specification", {"MOVING": [houses], "SCALE": 10000, "GAP": "3 parsecs", "OUTPUT": self.file("no.json")})
        self.assertFalse(os.path.exists(self.file("no.json")))
        self.refused("names files", "specification", {"MOVING": [self.memory_copy(houses)], "SCALE": 10000, "OUTPUT": self.file("no.json")})
        self.refused("lines do not move", "specification", {"MOVING": [roads], "SCALE": 10000, "OUTPUT": self.file("no.json")})


class SeparateTest(Case):
    def test_a_file_is_read_where_it_lies(self):
        done = self.run_algorithm("separate", {"INPUT": self.town(), "GAP": 3, "MAX_SHIFT": 1, "OUTPUT": TEMPORARY,
                                               "DISPLACEMENT": TEMPORARY, "CONFLICTS": TEMPORARY, "PUSHES": TEMPORARY})
        theirs = self.by_program("--gap=3", "--max-shift=1")
        # Processing returns layers; their sources are the files.
        for name, layer in (("OUTPUT", "buildings"), ("DISPLACEMENT", "buildings_displacement"),
                            ("CONFLICTS", "buildings_conflicts"), ("PUSHES", "buildings_pushes")):
            self.assertEqual(rows(self.source(done[name])), rows(theirs, layer), name)
        self.assertFalse([line for line in self.feedback.told if line.startswith("Copying")])
        left = [row for _, row in rows(theirs, "buildings_conflicts").values() if row["reason"] != "same_block"]
        self.assertEqual(done["CONFLICTS_AFTER"], len(left))
        self.assertEqual(len(self.feedback.warnings()), 1)
        self.assertIn("%d conflicts could not be solved" % done["CONFLICTS_AFTER"], self.feedback.warnings()[0])
        self.assertEqual(self.feedback.percents[-1], 100)
        self.assertGreater(len(self.feedback.percents), 20)

    def test_memory_layer_keeps_ids(self):
        layer = self.memory_copy(self.town())
        done = self.run_algorithm("separate", {"INPUT": layer, "GAP": 3, "OUTPUT": TEMPORARY, "DISPLACEMENT": TEMPORARY})
        theirs = self.by_program("--gap=3")
        self.assertEqual(geometries(self.source(done["OUTPUT"])), geometries(theirs, "buildings"))
        self.assertNotIn("qgis_id", next(iter(rows(self.source(done["OUTPUT"])).values()))[1])
        for _, (_, row) in rows(self.source(done["DISPLACEMENT"])).items():
            self.assertEqual(str(row["id"]), str(row["fid"]) if "fid" in row else row["id"])

    def test_filtered_layer_is_the_filtered_one(self):
        done = self.run_algorithm("separate", {"INPUT": self.town("fid % 3 > 0"), "GAP": 3, "OUTPUT": TEMPORARY})
        theirs = self.by_program("--gap=3", "--where=fid % 3 > 0")
        self.assertEqual(geometries(self.source(done["OUTPUT"])), geometries(theirs, "buildings"))

    def test_edited_layer_as_it_is_shown(self):
        layer = self.memory_copy(self.town())
        self.assertTrue(layer.startEditing())
        new = QgsFeature(layer.fields())
        new.setGeometry(QgsGeometry(next(layer.getFeatures()).geometry()))
        self.assertTrue(layer.addFeature(new))
        gone = min(layer.allFeatureIds()) + 5
        self.assertTrue(layer.deleteFeature(gone))
        ids = set(layer.allFeatureIds())
        self.assertTrue(min(ids) < 0)
        done = self.run_algorithm("separate", {"INPUT": layer, "CONTAINED": 2, "OUTPUT": TEMPORARY, "DISPLACEMENT": TEMPORARY})
        found = rows(self.source(done["OUTPUT"]))
        self.assertEqual(len(found), len(ids))
        self.assertNotIn(gone, found)
        named = {str(row["id"]) for _, row in rows(self.source(done["DISPLACEMENT"])).values()}
        self.assertTrue(named <= {str(each) for each in ids}, named - {str(each) for each in ids})
        layer.rollBack()

    def test_selected_only_leaves_out_the_others(self):
        layer = self.town()
        layer.selectByExpression('"fid" % 3 > 0')
        done = self.run_algorithm("separate", {"INPUT": QgsProcessingFeatureSourceDefinition(layer.id(), True)
                                               if QgsProject.instance().addMapLayer(layer, False) else None,
                                               "GAP": 3, "OUTPUT": TEMPORARY})
        theirs = self.by_program("--gap=3", "--where=fid % 3 > 0")
        self.assertEqual(geometries(self.source(done["OUTPUT"])), geometries(theirs, "buildings"))

    def test_move_selected_keeps_the_others_as_obstacles(self):
        layer = self.town()
        layer.selectByExpression('"fid" % 2 = 0')
        done = self.run_algorithm("separate", {"INPUT": layer, "MOVE_SELECTED": True, "GAP": 3, "OUTPUT": TEMPORARY})
        theirs = self.by_program("--gap=3", "--fixed-where=fid % 2 <> 0")
        self.assertEqual(geometries(self.source(done["OUTPUT"])), geometries(theirs, "buildings"))
        states = {(fid % 2, row["sunder_st"]) for fid, (_, row) in rows(self.source(done["OUTPUT"])).items()}
        self.assertIn((1, "fixed"), states)
        self.assertNotIn((1, "moved"), states)

    def test_conflicts_between_features_that_stay_are_counted(self):
        layer = self.town()
        layer.selectByExpression('"fid" % 10 = 0')
        # Also if the layer of conflicts is not among the outputs.
        done = self.run_algorithm("separate", {"INPUT": layer, "MOVE_SELECTED": True, "GAP": 3, "OUTPUT": TEMPORARY})
        theirs = self.by_program("--gap=3", "--fixed-where=fid % 10 <> 0")
        staying = [row for _, row in rows(theirs, "buildings_conflicts").values() if row["reason"] == "fixed"]
        self.assertGreater(len(staying), 10)
        self.assertEqual(done["CONFLICTS_STAYING"], len(staying))
        self.assertIn("%d of them are between features that never move" % len(staying), self.feedback.warnings()[-1])
        done = self.run_algorithm("separate", {"INPUT": layer, "GAP": 3, "MAX_SHIFT": 1, "OUTPUT": TEMPORARY})
        self.assertEqual(done["CONFLICTS_STAYING"], 0)
        self.assertNotIn("never move", self.feedback.warnings()[-1])

    def test_move_selected_with_nothing_selected_is_told(self):
        self.refused("no feature of the layer is selected", "separate",
                     {"INPUT": self.town(), "MOVE_SELECTED": True, "GAP": 3, "OUTPUT": TEMPORARY})

    def test_expressions_are_of_qgis(self):
        done = self.run_algorithm("separate", {"INPUT": self.town(), "GAP": 3, "FIXED_WHERE": "$area > 200",
                                               "IGNORE_WHERE": "\"kind\" = 'shed'", "OUTPUT": TEMPORARY})
        layer = self.town()
        large = {f.id() for f in layer.getFeatures("$area > 200")}
        sheds = {f.id() for f in layer.getFeatures("\"kind\" = 'shed'")}
        self.assertTrue(large)
        theirs = self.by_program("--gap=3", "--fixed-where=fid IN (%s)" % ",".join(map(str, large)),
                                 "--ignore-where=kind = 'shed'")
        self.assertEqual(geometries(self.source(done["OUTPUT"])), geometries(theirs, "buildings"))
        for fid, (_, row) in rows(self.source(done["OUTPUT"])).items():
            self.assertTrue(row["sunder_st"] == "skipped" if fid in sheds else fid not in large or row["sunder_st"] != "moved")

    def test_wrong_expression_is_told(self):
        self.refused("Features that never move", "separate",
                     {"INPUT": self.town(), "FIXED_WHERE": "area >", "OUTPUT": TEMPORARY})

    def test_barriers(self):
        roads = QgsVectorLayer(TOWN + "|layername=roads", "Roads of the town", "ogr")
        QgsProject.instance().addMapLayer(roads, False)
        theirs = geometries(self.by_program("--gap=1", "--max-shift=8", "--barrier=%s,layer=roads,width=5m,gap=0.5m,least=0.2m" % TOWN,
                                            ), "buildings")
        for row in (["Roads of the town", "5", "0.5", "0.2", "", "", ""],
                    [TOWN + "|layername=roads", "5m", "0.5", "0.2m", "", "yes", "area"]):
            done = self.run_algorithm("separate", {"INPUT": self.town(), "GAP": 1, "MAX_SHIFT": 8, "UNIT": 1, "BARRIER": row,
                                                   "OUTPUT": TEMPORARY})
            self.assertEqual(geometries(self.source(done["OUTPUT"])), theirs)
        # A filter in the table of barriers is an expression of QGIS, also for layers in memory.
        copied = roads.materialize(QgsFeatureRequest())
        copied.setName("Copied roads")
        QgsProject.instance().addMapLayer(copied, False)
        theirs = geometries(self.by_program("--gap=1", "--max-shift=8", "--barrier=%s,layer=roads,width=5,where=fid > 4" % TOWN,
                                            ), "buildings")
        for name in ("Roads of the town", "Copied roads"):
            done = self.run_algorithm("separate", {"INPUT": self.town(), "GAP": 1, "MAX_SHIFT": 8, "OUTPUT": TEMPORARY,
                                                   "BARRIER": [name, "5", "", "", "$id > 4", "", ""]})
            self.assertEqual(geometries(self.source(done["OUTPUT"])), theirs, name)

    def test_barriers_chosen_as_layers(self):
        roads = QgsVectorLayer(TOWN + "|layername=roads", "Roads of the town", "ogr")
        copied = roads.materialize(QgsFeatureRequest(QgsExpression("$id <= 4")))
        for layer, name in ((roads, "Roads, chosen"), (copied, "Some roads, chosen")):
            layer.setName(name)
            QgsProject.instance().addMapLayer(layer, False)
        theirs = geometries(self.by_program("--gap=1", "--max-shift=8", "--barrier=%s,layer=roads,width=5,gap=0.5" % TOWN,
                                            "--barrier=%s,layer=roads,width=5,gap=0.5,where=fid <= 4" % TOWN), "buildings")
        values = {"INPUT": self.town(), "GAP": 1, "MAX_SHIFT": 8, "BARRIER_WIDTH": 5, "BARRIER_GAP": 0.5, "OUTPUT": TEMPORARY}
        done = self.run_algorithm("separate", dict(values, BARRIER_LAYERS=[roads, copied]))
        self.assertEqual(geometries(self.source(done["OUTPUT"])), theirs)
        # Barriers given by id, together with the table.
        table = [copied.name(), "5", "0.5", "", "", "", ""]
        done = self.run_algorithm("separate", dict(values, BARRIER_LAYERS=[roads.id()], BARRIER=table))
        self.assertEqual(geometries(self.source(done["OUTPUT"])), theirs)

    def test_lengths_have_the_unit_of_the_layer(self):
        for name in ("separate", "check"):
            algorithm = QgsApplication.processingRegistry().algorithmById("sunder:" + name)
            kinds = {each.name(): each.type() for each in algorithm.parameterDefinitions()}
            for length in ("GAP", "MAX_SHIFT", "TOUCH_TOLERANCE", "BARRIER_WIDTH", "BARRIER_GAP"):
                self.assertEqual(kinds[length], "distance", length)
                self.assertEqual(algorithm.parameterDefinition(length).parentParameterName(), "INPUT", length)

    def test_barriers_that_mean_nothing_are_told(self):
        for row, said in ((["nowhere", "", "", "", "", "", ""], "no layer nowhere"),
                          ([TOWN + "|layername=roads", "broad", "", "", "", "", ""], "neither a width nor a field"),
                          ([TOWN + "|layername=roads", "", "", "", "a >", "", ""], "filter")):
            self.refused(said, "separate", {"INPUT": self.town(), "BARRIER": row, "OUTPUT": TEMPORARY})

    def test_millimetres_on_the_sheet(self):
        done = self.run_algorithm("separate", {"INPUT": self.town(), "GAP": 0.2, "UNIT": 5, "SCALE": 15000, "OUTPUT": TEMPORARY})
        theirs = self.by_program("--gap=0.2mm", "--scale=15000")
        self.assertEqual(geometries(self.source(done["OUTPUT"])), geometries(theirs, "buildings"))
        self.refused("scale", "separate", {"INPUT": self.town(), "GAP": 0.2, "UNIT": 5, "OUTPUT": TEMPORARY})

    def test_points_with_symbols(self):
        points = self.file("points.gpkg")
        subprocess.run(["ogr2ogr", points, TOWN, "-nln", "wells", "-dialect", "sqlite", "-sql",
                        "SELECT fid, ST_Centroid(geom) FROM buildings"], check=True)
        done = self.run_algorithm("separate", {"INPUT": points, "SYMBOL": "disc:3", "EFFORT": 0, "OUTPUT": TEMPORARY,
                                               "SYMBOLS": TEMPORARY})
        self.sunder("separate", points, self.file("theirs.gpkg"), "--symbol=disc:3", "--effort=0", "--quiet")
        self.assertEqual(geometries(self.source(done["OUTPUT"])), geometries(self.file("theirs.gpkg"), "wells"))
        self.assertEqual(geometries(self.source(done["SYMBOLS"])), geometries(self.file("theirs.gpkg"), "wells_symbols"))

    def test_cancel_ends_the_program_and_leaves_nothing(self):
        for cancel_at in (0, 40):
            feedback = Feedback(cancel_at)
            target = self.file("cancelled.gpkg")
            self.run_algorithm("separate", {"INPUT": self.town(), "GAP": 3, "EFFORT": 1, "OUTPUT": target}, feedback)
            self.assertFalse(os.path.exists(target))
            self.assertTrue(any("Cancelled" in line for line in feedback.told) or cancel_at == 0, feedback.told)


    def test_virtual_layer(self):
        QgsProject.instance().addMapLayer(self.town(), False)
        virtual = QgsVectorLayer("?query=SELECT * FROM Houses WHERE fid % 3 > 0", "Two thirds", "virtual")
        self.assertTrue(virtual.isValid())
        done = self.run_algorithm("separate", {"INPUT": virtual, "GAP": 3, "OUTPUT": TEMPORARY})
        theirs = self.by_program("--gap=3", "--where=fid % 3 > 0")
        self.assertEqual(sorted(geometries(self.source(done["OUTPUT"])).values()),
                         sorted(geometries(theirs, "buildings").values()))

    def test_cancelled_while_copying(self):
        feedback = Feedback(1)
        layer = self.memory_copy(self.town())
        self.run_algorithm("separate", {"INPUT": layer, "GAP": 3, "OUTPUT": self.file("x.gpkg")}, feedback)
        self.assertFalse(os.path.exists(self.file("x.gpkg")))
        self.assertFalse([line for line in feedback.told if " separate " in line], "the program was run")

    def test_attributes_of_all_kinds_survive(self):
        layer = QgsVectorLayer("Polygon?crs=EPSG:25832&field=fid:integer&field=n:int8&field=x:double&field=t:string&"
                               "field=d:date&field=m:datetime&field=b:bool&field=y:binary", "Kinds", "memory")
        values = [7, 2 ** 40, 1 / 3, "Straße, 'quoted'", QDate(2020, 2, 29), QDateTime(QDate(2020, 2, 29), QTime(1, 2, 3)),
                  True, QByteArray(b"\x00\xff")]
        for k, row in enumerate((values, [None] * len(values))):
            feature = QgsFeature(layer.fields())
            feature.setAttributes(row)
            feature.setGeometry(QgsGeometry.fromWkt("POLYGON ((%d 0, %d 0, %d 1, %d 0))" % (k, k + 1, k + 1, k)))
            self.assertTrue(layer.dataProvider().addFeature(feature))
        done = self.run_algorithm("separate", {"INPUT": layer, "OUTPUT": TEMPORARY})
        found = [row for _, row in rows(self.source(done["OUTPUT"])).values()]
        self.assertEqual([found[0][name] for name in ("fid", "n", "x", "t")], values[:4])
        self.assertEqual((found[0]["d"], found[0]["m"][:19], found[0]["b"]), ("2020/02/29", "2020/02/29 01:02:03", True))
        self.assertEqual(found[0]["y"], "00FF")  # binary values as OGR prints them
        self.assertEqual({found[1][name] for name in ("fid", "n", "x", "t", "d", "m", "b", "y")}, {None})

    def test_the_key_that_qgis_shows_may_be_chosen(self):
        done = self.run_algorithm("separate", {"INPUT": self.town(), "GAP": 3, "WEIGHT_FIELD": "fid", "OUTPUT": TEMPORARY})
        copied = self.file("keyed.gpkg")
        subprocess.run(["ogr2ogr", copied, TOWN, "-nln", "buildings", "-dialect", "sqlite", "-preserve_fid", "-sql",
                        "SELECT fid, fid AS number, geom FROM buildings"], check=True)
        self.sunder("separate", copied, self.file("theirs.gpkg"), "--gap=3", "--weight-field=number", "--quiet",
                    "--allow-conflicts")
        self.assertEqual(geometries(self.source(done["OUTPUT"])), geometries(self.file("theirs.gpkg"), "buildings"))

    def test_names_that_a_database_would_confuse(self):
        layer = QgsVectorLayer("Polygon?crs=EPSG:25832&field=Name:string&field=name:string&field=geom:string&"
                               "field=qgis_id:integer&field=sunder_dx:double", "A layer, with \"quotes\" & all", "memory")
        feature = QgsFeature(layer.fields())
        feature.setAttributes(["a", "b", "c", 4, 5.0])
        feature.setGeometry(QgsGeometry.fromWkt("POLYGON ((0 0, 1 0, 1 1, 0 0))"))
        layer.dataProvider().addFeature(feature)
        done = self.run_algorithm("separate", {"INPUT": layer, "OUTPUT": TEMPORARY})
        (_, row), = rows(self.source(done["OUTPUT"])).values()
        self.assertEqual([row[name] for name in ("Name", "name_", "geom", "qgis_id", "sunder_dx")],
                         ["a", "b", "c", 4, 0.0])

    def test_three_dimensions_nulls_and_nothing(self):
        layer = QgsVectorLayer("PolygonZ?crs=EPSG:25832", "Tall", "memory")
        texts = ["PolygonZ ((0 0 0.1, 4 0 0.2, 4 4 0.3, 0 0 0.1))", "PolygonZ ((3 0 7, 7 0 8, 7 4 9, 3 0 7))", None]
        for text in texts:
            feature = QgsFeature(layer.fields())
            if text:
                feature.setGeometry(QgsGeometry.fromWkt(text))
            layer.dataProvider().addFeature(feature)
        copied = self.file("copied.gpkg")
        import processing
        processing.run("native:savefeatures", {"INPUT": layer, "OUTPUT": copied})
        for given in (layer, copied):
            done = self.run_algorithm("separate", {"INPUT": given, "GAP": 1, "OUTPUT": TEMPORARY})
            found = geometries(self.source(done["OUTPUT"]))
            self.sunder("separate", copied, self.file("theirs.gpkg"), "--gap=1", "--quiet", "--overwrite")
            theirs = geometries(self.file("theirs.gpkg"), "copied")
            if given is layer:
                theirs[3] = None  # QGIS wrote the null geometry into the copy as an empty one
            self.assertEqual(found, theirs)
            self.assertEqual(QgsVectorLayer(self.source(done["OUTPUT"]), "x", "ogr").wkbType(), layer.wkbType())
        empty = QgsVectorLayer("Polygon?crs=EPSG:25832", "Empty", "memory")
        done = self.run_algorithm("separate", {"INPUT": empty, "GAP": 1, "OUTPUT": TEMPORARY})
        self.assertEqual(geometries(self.source(done["OUTPUT"])), {})

    def test_arcs_and_measures(self):
        arc = "CurvePolygon (CompoundCurve (CircularString (%d 0, %d 4, %d 0), (%d 0, %d 0)))"
        square = "((%d 0 1.5, %d 0 2.5, %d 4 3.5, %d 0 1.5))"
        for kind, texts in (("CurvePolygon", [arc % (x, x + 4, x + 8, x + 8, x) for x in (0, 6)]),
                            ("PolygonM", ["PolygonM " + square % (x, x + 4, x + 4, x) for x in (0, 3)]),
                            ("MultiPolygonZM", ["MultiPolygonZM (((%d 0 1 5, %d 0 2 6, %d 4 3 7, %d 0 1 5)))"
                                                % (x, x + 4, x + 4, x) for x in (0, 3)])):
            layer = QgsVectorLayer(kind + "?crs=EPSG:25832", kind, "memory")
            for text in texts:
                feature = QgsFeature(layer.fields())
                feature.setGeometry(QgsGeometry.fromWkt(text))
                self.assertFalse(feature.geometry().isNull(), text)
                layer.dataProvider().addFeature(feature)
            copied = self.file(kind + ".gpkg")
            import processing
            processing.run("native:savefeatures", {"INPUT": layer, "OUTPUT": copied})
            self.sunder("separate", copied, self.file("theirs.gpkg"), "--gap=1", "--quiet", "--overwrite")
            theirs = geometries(self.file("theirs.gpkg"), kind)
            self.assertEqual(len(theirs), 2)
            self.assertNotEqual(theirs, geometries(copied))
            for given in (layer, copied):
                done = self.run_algorithm("separate", {"INPUT": given, "GAP": 1, "OUTPUT": TEMPORARY})
                self.assertEqual(geometries(self.source(done["OUTPUT"])), theirs, kind)
                self.assertEqual(QgsVectorLayer(self.source(done["OUTPUT"]), "x", "ogr").wkbType(), layer.wkbType())

    def test_nothing_is_left_lying_about(self):
        from qgis.core import QgsProcessingUtils
        def lying():
            return [path for path, _, files in os.walk(QgsProcessingUtils.tempFolder()) for each in files
                    if each in ("sunder.gpkg", "figures.json", "input.gpkg")]
        before = lying()
        layer = self.memory_copy(self.town())
        self.run_algorithm("separate", {"INPUT": layer, "GAP": 3, "OUTPUT": self.file("x.gpkg")})
        self.run_algorithm("separate", {"INPUT": layer, "GAP": 3, "OUTPUT": TEMPORARY}, Feedback(60))
        self.refused("", "separate", {"INPUT": layer, "GAP": 3, "TOUCH_TOLERANCE": 4, "OUTPUT": TEMPORARY})
        self.assertEqual(lying(), before)

    def test_crs_changed_in_qgis(self):
        layer = self.town()
        layer.setCrs(QgsCoordinateReferenceSystem("EPSG:32632"))
        done = self.run_algorithm("separate", {"INPUT": layer, "GAP": 3, "OUTPUT": TEMPORARY})
        self.assertEqual(QgsVectorLayer(self.source(done["OUTPUT"]), "x", "ogr").crs().authid(), "EPSG:32632")


@unittest.skipUnless(os.path.isdir(DATA), "there is no ../shared/data beside the sources")
class RealLayers(Case):
    """Layers of OpenStreetMap, read from their folder: zipped, filtered and from memory."""

    def compare(self, layer, words, values, name="buildings"):
        done = self.run_algorithm("separate", dict(values, INPUT=layer, EFFORT=0, OUTPUT=TEMPORARY, CONFLICTS=TEMPORARY))
        written = self.file("theirs.gpkg")
        self.sunder("separate", *words, written, "--effort=0", "--quiet", "--overwrite", "--allow-conflicts")
        ours, theirs = geometries(self.source(done["OUTPUT"])), geometries(written, name)
        self.assertEqual(ours, theirs)
        self.assertEqual(geometries(self.source(done["CONFLICTS"])), geometries(written, name + "_conflicts"))
        return len(ours)

    def layer(self, file, name="buildings"):
        layer = QgsVectorLayer(os.path.join(DATA, file) + "|layername=" + name, name, "ogr")
        self.assertTrue(layer.isValid(), file)
        return layer

    def test_beside_all_roads(self):
        path = os.path.join(DATA, "krems_2013.gpkg")
        words = [path, "-l", "buildings", "--gap=1", "--max-shift=8", "--barrier=%s,layer=roads,width=4" % path,
                 "--barrier=%s,layer=waterways,width=2,gap=3,where=waterway = 'river'" % path]
        barriers = [path + "|layername=roads", "4", "", "", "", "", "",
                    path + "|layername=waterways", "2", "3", "", "\"waterway\" = 'river'", "", ""]
        values = {"GAP": 1, "MAX_SHIFT": 8, "BARRIER": barriers}
        self.assertGreater(self.compare(self.layer("krems_2013.gpkg"), words, values), 1000)
        self.compare(self.memory_copy(self.layer("krems_2013.gpkg")), words, values)

    def test_filtered(self):
        path = os.path.join(DATA, "saint_jean_la_poterie.gpkg")
        layer = self.layer("saint_jean_la_poterie.gpkg")
        layer.setSubsetString("fid % 4 > 0")
        self.compare(layer, [path, "-l", "buildings", "--where=fid % 4 > 0", "--gap=3"], {"GAP": 3})

    def test_zipped_shapefile(self):
        path = "/vsizip/" + os.path.join(DATA, "baltimore_2015_shp.zip")
        layer = QgsVectorLayer(path + "/buildings.shp", "Baltimore", "ogr")
        self.assertTrue(layer.isValid())
        # QGIS reads all polygons of a Shapefile as multipolygons, and so does the program here.
        copied = self.file("copied.gpkg")
        subprocess.run(["ogr2ogr", copied, path, "buildings", "-nlt", "PROMOTE_TO_MULTI", "-lco", "FID=ogr_fid",
                        "-preserve_fid"], check=True)
        self.compare(layer, [copied, "-l", "buildings", "--gap=2"], {"GAP": 2})


class DestinationTest(Case):
    def separated(self, **outputs):
        return self.run_algorithm("separate", dict({"INPUT": self.town(), "GAP": 3, "MAX_SHIFT": 1}, **outputs))

    def setUp(self):
        super().setUp()
        self.theirs = self.by_program("--gap=3", "--max-shift=1")

    def test_files(self):
        for ending in ("gpkg", "fgb", "shp", "geojson"):
            target = self.file("moved." + ending)
            self.assertEqual(self.separated(OUTPUT=target)["OUTPUT"], target)
            written = QgsVectorLayer(target, "x", "ogr")
            self.assertTrue(written.isValid(), ending)
            # Formats regroup rings, sort features and make multipolygons: the vertices are the same.
            def corners(geometry):
                return sorted({(vertex.x(), vertex.y()) for vertex in geometry.vertices()})
            ours = sorted(corners(f.geometry()) for f in written.getFeatures())
            theirs = sorted(corners(f.geometry())
                            for f in QgsVectorLayer(self.theirs + "|layername=buildings", "x", "ogr").getFeatures())
            self.assertEqual(ours, theirs, ending)
        self.assertEqual(rows(self.file("moved.gpkg"), "moved"), rows(self.theirs, "buildings"))
        self.assertFalse([line for line in self.feedback.warnings() if "this format" in line])

    def test_a_format_that_rounds_is_told(self):
        self.separated(OUTPUT=self.file("moved.kml"))
        self.assertTrue([line for line in self.feedback.warnings() if "this format changed" in line], self.feedback.told)

    def test_tables_of_one_geopackage(self):
        target = self.file("all.gpkg")
        named = {"OUTPUT": "houses", "CONFLICTS": "left", "DISPLACEMENT": "moves"}
        for _ in range(2):  # the second run replaces the tables
            self.separated(**{name: "ogr:dbname='%s' table=\"%s\" (geom)" % (target, table) for name, table in named.items()})
        for table, theirs in (("houses", "buildings"), ("left", "buildings_conflicts"), ("moves", "buildings_displacement")):
            self.assertEqual(geometries(target, table), geometries(self.theirs, theirs), table)

    def test_skipped_ones_are_not_there(self):
        done = self.separated(CONFLICTS=TEMPORARY)
        self.assertNotIn("OUTPUT", done)
        self.assertNotIn("DISPLACEMENT", done)
        self.assertEqual(len(geometries(self.source(done["CONFLICTS"]))), len(geometries(self.theirs, "buildings_conflicts")))

    def test_styles_go_with_them(self):
        from sunder import result
        done = self.separated(OUTPUT=self.file("moved.gpkg"), CONFLICTS=self.file("left.fgb"))
        for path in (done["OUTPUT"], done["CONFLICTS"]):
            layer = QgsVectorLayer(path, "x", "ogr")
            self.assertEqual(layer.renderer().type(), "categorizedSymbol" if path.endswith("gpkg") else "RuleRenderer", path)
        # As QGIS loads them: the post-processor sets their styles.
        context = QgsProcessingContext()
        project = QgsProject()
        context.setProject(project)
        definition = QgsProcessingOutputLayerDefinition(TEMPORARY, project)
        algorithm = QgsApplication.processingRegistry().createAlgorithmById("sunder:separate")
        results, ok = algorithm.run({"INPUT": self.town(), "GAP": 3, "OUTPUT": definition}, context, self.feedback)
        self.assertTrue(ok)
        loads = context.layersToLoadOnCompletion()
        self.assertEqual(list(loads), [results["OUTPUT"]])
        layer = QgsVectorLayer(results["OUTPUT"], "x", "ogr")
        layer.setRenderer(QgsFeatureRenderer.defaultRenderer(QgsWkbTypes.GeometryType.PolygonGeometry))
        loads[results["OUTPUT"]].postProcessor().postProcessLayer(layer, context, self.feedback)
        self.assertEqual(layer.renderer().type(), "categorizedSymbol")
        self.assertTrue(result.Styled.alive)

    def test_the_input_is_not_written_over(self):
        own = self.file("own.gpkg")
        subprocess.run(["ogr2ogr", own, TOWN, "buildings"], check=True)
        before = geometries(own)
        self.refused("which is read", "separate", {"INPUT": own, "GAP": 3, "OUTPUT": own})
        self.assertEqual(geometries(own), before)

    def test_report_and_proof(self):
        self.separated(OUTPUT=TEMPORARY, REPORT=self.file("r.html"), PROOF=self.file("p.jsonl"))
        with open(self.file("r.html"), encoding="utf-8") as page:
            self.assertIn("<html", page.read(2000))
        with open(self.file("p.jsonl"), encoding="utf-8") as proof:
            json.loads(proof.readline())


@unittest.skipUnless(os.environ.get("SUNDER_POSTGIS"), "postgis.sh starts a server for these")
class PostGIS(Case):
    def table(self, name, key="fid"):
        layer = QgsVectorLayer("%s key='%s' table=\"public\".\"%s\" (geom)" % (os.environ["SUNDER_POSTGIS"], key, name),
                               name, "postgres")
        self.assertTrue(layer.isValid(), name)
        return layer

    def test_from_table_to_table(self):
        database = "PG:" + os.environ["SUNDER_POSTGIS"]
        subprocess.run(["ogr2ogr", "-f", "PostgreSQL", database, TOWN, "buildings", "-nln", "houses", "-overwrite",
                        "-preserve_fid", "-lco", "FID=fid", "-lco", "GEOMETRY_NAME=geom"], check=True)
        target = "postgres:%s table=\"public\".\"%%s\" (geom)" % os.environ["SUNDER_POSTGIS"]
        theirs = self.by_program("--gap=3", "--max-shift=1")
        for _ in range(2):  # the second run replaces the files
            self.run_algorithm("separate", {"INPUT": self.table("houses"), "GAP": 3, "MAX_SHIFT": 1,
                                            "OUTPUT": target % "moved", "CONFLICTS": target % "left"})
        for name, layer in (("moved", "buildings"), ("left", "buildings_conflicts")):
            ours = sorted(bytes(row.geometry().asWkb()) for row in self.table(name).getFeatures())
            self.assertEqual(ours, sorted(geometries(theirs, layer).values()), name)
        self.assertEqual({row["fid"]: row["sunder_st"] for row in self.table("moved").getFeatures()},
                         {fid: row["sunder_st"] for fid, (_, row) in rows(theirs, "buildings").items()})


class OtherCommands(Case):
    def test_check(self):
        done = self.run_algorithm("check", {"INPUT": self.town(), "GAP": 3, "OUTPUT": TEMPORARY})
        self.sunder("check", "--input-layer=buildings", TOWN, self.file("c.gpkg"), "--gap=3", "--quiet", status=3)
        self.assertEqual(rows(self.source(done["OUTPUT"])), rows(self.file("c.gpkg")))
        self.assertEqual(done["CONFLICTS"],
                         sum(row["reason"] != "same_block" for _, row in rows(self.file("c.gpkg")).values()))
        self.assertIn("%d conflicts were found" % done["CONFLICTS"], self.feedback.warnings()[0])

    def test_check_before(self):
        moved = self.by_program("--gap=3", "--max-shift=2", "--effort=0")
        done = self.run_algorithm("check", {"INPUT": moved + "|layername=buildings", "BEFORE": self.town(), "GAP": 3,
                                            "MAX_SHIFT": 0.5, "OUTPUT": TEMPORARY})
        kinds = {row["kind"] for _, row in rows(self.source(done["OUTPUT"])).values()}
        self.assertIn("limit", kinds)

    def test_buffer(self):
        for words, values in ((["--shape=square:2"], {"SHAPE": "square:2"}),
                              (["--shape=square:6", "--operation=close", "--dissolve", "--align", "--explode"],
                               {"SHAPE": "square:6", "OPERATION": 3, "DISSOLVE": True, "ALIGN": True, "EXPLODE": True})):
            done = self.run_algorithm("buffer", dict(values, INPUT=self.town(), OUTPUT=TEMPORARY, SEGMENTS=TEMPORARY))
            written = self.file("%d.gpkg" % len(words))
            self.sunder("buffer", "--input-layer=buildings", TOWN, written, "--degenerate", "--quiet", *words)
            self.assertEqual(geometries(self.source(done["OUTPUT"])), geometries(written, "buildings"))
            self.assertEqual(geometries(self.source(done["SEGMENTS"])), geometries(written, "buildings_degenerate_segments"))

    def test_sum(self):
        done = self.run_algorithm("sum", {"P": self.town("fid < 20"), "Q_SHAPE": "disc:3", "REFLECT": True, "OUTPUT": TEMPORARY,
                                          "FACES": TEMPORARY})
        self.sunder("sum", TOWN, "disc:3", self.file("s.gpkg"), "--input-layer=buildings", "--where=fid < 20", "--reflect",
                    "--planar-map")
        self.assertEqual(geometries(self.source(done["OUTPUT"])), geometries(self.file("s.gpkg"), "sum"))
        self.assertEqual(geometries(self.source(done["FACES"])), geometries(self.file("s.gpkg"), "sum_faces"))

    def test_pair(self):
        done = self.run_algorithm("pair", {"P_SHAPE": "square:4", "Q_SHAPE": "POLYGON ((1 1, 5 1, 5 2))", "GAP": 0.5,
                                           "OUTPUT": TEMPORARY})
        theirs = json.loads(self.sunder("pair", "square:4", "POLYGON ((1 1, 5 1, 5 2))", "--gap=0.5"))
        self.assertEqual(done["DISTANCE"], theirs["distance"])
        self.refused("a layer or a shape", "pair", {"P_SHAPE": "square:4", "OUTPUT": TEMPORARY})

    def test_route(self):
        block = "POLYGON ((2 -9, 4 -9, 4 3, 2 3))"
        done = self.run_algorithm("route", {"OBSTACLES_SHAPE": block, "ROBOT": "square:2", "FROM": "0,0", "TO": "6,0",
                                            "OUTPUT": TEMPORARY, "FREE_SPACE": TEMPORARY})
        self.sunder("route", block, self.file("r.gpkg"), "--robot=square:2", "--from=0,0", "--to=6,0", "--free-space")
        self.assertEqual(geometries(self.source(done["OUTPUT"])), geometries(self.file("r.gpkg"), "route"))
        self.assertEqual(geometries(self.source(done["FREE_SPACE"])), geometries(self.file("r.gpkg"), "route_free_space"))
        # If there is no route, the run succeeds with a warning.
        done = self.run_algorithm("route", {"OBSTACLES_SHAPE": block, "ROBOT": "square:2", "FROM": "0,0", "TO": "3,0",
                                            "OUTPUT": TEMPORARY})
        self.assertIn("There is no route", self.feedback.warnings()[0])

    def test_errors_are_in_the_words_of_the_dialog(self):
        degrees = QgsVectorLayer("Polygon?crs=EPSG:4326", "In degrees", "memory")
        row = QgsFeature(degrees.fields())
        row.setGeometry(QgsGeometry.fromWkt("POLYGON ((0 0, 1 0, 1 1, 0 0))"))
        degrees.dataProvider().addFeatures([row])
        with self.assertRaises(QgsProcessingException) as refused:
            self.run_algorithm("separate", {"INPUT": degrees, "GAP": 3, "OUTPUT": TEMPORARY})
        self.assertNotIn("--", str(refused.exception))
        self.assertNotIn("/tmp", str(refused.exception))
        self.assertNotIn("sunder:", str(refused.exception))
        self.assertNotIn("ogr2ogr", str(refused.exception))

    def test_log(self):
        broken = QgsVectorLayer("Polygon?crs=EPSG:25832", "Broken", "memory")
        for k in range(12):
            row = QgsFeature(broken.fields())
            row.setGeometry(QgsGeometry.fromWkt("POLYGON ((%d 0, %d 2, %d 0, %d 2, %d 0))" % (9 * k, 9 * k + 2, 9 * k + 2, 9 * k,
                                                                                          9 * k)))
            broken.dataProvider().addFeature(row)
        self.run_algorithm("separate", {"INPUT": broken, "OUTPUT": TEMPORARY, "LOG": self.file("all.log")})
        with open(self.file("all.log"), encoding="utf-8") as log:
            self.assertGreaterEqual(len(log.readlines()), 12)
        self.assertTrue(self.feedback.warnings())
        self.assertNotIn("--", "".join(self.feedback.warnings()))


class SpellingTest(unittest.TestCase):
    def test_enumerators_name_their_enumeration(self):
        """With Qt 6 an enumerator is a member of its enumeration only. QGIS itself lists the enumerators here."""
        import ast
        import glob
        import qgis.core
        from qgis.PyQt import QtCore, QtGui
        found = 0
        source = os.environ["SUNDER_SOURCE"]
        for file in (file for folder in ("gis/qgis/sunder", "tests/qgis", "docs/pictures")
                     for file in glob.glob(os.path.join(source, folder, "*.py"))):
            with open(file, encoding="utf-8") as opened:
                nodes = [node for node in ast.walk(ast.parse(opened.read())) if isinstance(node, ast.Attribute)]
            for node in (each for each in nodes if isinstance(each.value, ast.Name)):
                holder = next((getattr(module, node.value.id) for module in (qgis.core, QtCore, QtGui)
                               if hasattr(module, node.value.id)), None)
                kind = type(type(getattr(holder, node.attr, None))).__name__
                found += holder is not None
                self.assertFalse(kind in ("enumtype", "EnumMeta", "EnumType") and node.value.id != "QVariant",
                                 "%s:%d: %s.%s" % (file, node.lineno, node.value.id, node.attr))
        self.assertGreater(found, 20)


def main():
    faulthandler.enable()
    QgsApplication.setPrefixPath("/usr", True)
    application = QgsApplication([], False)
    application.initQgis()
    from processing.core.Processing import Processing
    Processing.initialize()
    from sunder.provider import SunderProvider
    provider = SunderProvider()
    application.processingRegistry().addProvider(provider)
    done = unittest.main(exit=False, verbosity=2).result
    QgsProject.instance().clear()
    sys.stdout.flush()
    sys.stderr.flush()
    # QGIS's own shutdown sometimes crashes while Python still holds its objects
    os._exit(0 if done.wasSuccessful() else 1)


if __name__ == "__main__":
    main()
