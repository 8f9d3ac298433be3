"""Is the plug-in written so that it runs with Qt 5 and with Qt 6, in QGIS 3 and 4? Searches, without QGIS, for what
QGIS's migration script from PyQt5 to PyQt6 reports: enumerators without the name of their enumeration, removed
modules and names. tests/qgis/plugin.py asks QGIS itself which names are enumerators."""
import ast
import configparser
import glob
import os
import unittest

FOLDER = os.path.join(os.environ["SUNDER_SOURCE"], "gis", "qgis", "sunder")
FILES = sorted(glob.glob(os.path.join(FOLDER, "*.py")))
# Members of classes of Qt and QGIS that are not enumerators, or that have the same spelling in both.
PLAIN = {"QgsProcessingContext.LayerDetails", "QgsProcessing.TEMPORARY_OUTPUT"}
GONE = {"QRegExp", "QDesktopWidget", "qApp", "exec_", "desktop", "MidButton", "TextColorRole", "BackgroundColorRole",
        "HighQualityAntialiasing", "resources_rc"}


def parsed(file):
    with open(file, encoding="utf-8") as opened:
        tree = ast.parse(opened.read(), file)
    for node in ast.walk(tree):
        for child in ast.iter_child_nodes(node):
            child.parent = node
    return tree


def is_short_enumerator(node):
    """Q...Class.Name with nothing after it: a method would be followed by a call, an enumeration by a name."""
    if not (isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id.startswith("Q")):
        return False
    name = "%s.%s" % (node.value.id, node.attr)
    return (node.attr[0].isupper() and name not in PLAIN and node.value.id != "QVariant" and
            not isinstance(node.parent, ast.Attribute) and not name.endswith((".Type", ".DataType", ".Flag")))


class Spelling(unittest.TestCase):
    def test_enumerators_name_their_enumeration(self):
        self.assertGreater(len(FILES), 10)
        for file in FILES:
            short = ["%s.%s" % (node.value.id, node.attr) for node in ast.walk(parsed(file)) if is_short_enumerator(node)]
            self.assertEqual(short, [], file)

    def test_modules_and_names_are_in_both(self):
        for file in FILES:
            for node in ast.walk(parsed(file)):
                if isinstance(node, (ast.Import, ast.ImportFrom)):
                    modules = [getattr(node, "module", None) or ""] + [each.name for each in node.names]
                    self.assertFalse([each for each in modules if each.startswith("PyQt")], file)
                    self.assertNotIn("qgis.PyQt.Qt", modules, file)
                    self.assertFalse(GONE & set(modules), file)
                if isinstance(node, ast.Attribute):
                    self.assertNotIn(node.attr, GONE, file)
                if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                    self.assertFalse(node.func.id == "QVariant" and not node.args, "%s: QVariant() is no null" % file)

    def test_the_rule_finds_one(self):
        for text, wrong in (("QgsProcessing.TypeVectorLine", True), ("QgsProcessing.SourceType.TypeVectorLine", False),
                            ("Qt.ISODate", True), ("QVariant.Int", False), ("QgsProcessing.TEMPORARY_OUTPUT", False)):
            tree = ast.parse(text)
            for node in ast.walk(tree):
                for child in ast.iter_child_nodes(node):
                    child.parent = node
            self.assertEqual(any(is_short_enumerator(node) for node in ast.walk(tree)), wrong, text)


class Metadata(unittest.TestCase):
    def setUp(self):
        parser = configparser.ConfigParser()
        parser.read(os.path.join(FOLDER, "metadata.txt"), encoding="utf-8")
        self.general = parser["general"]

    def test_listed_from_3_22_to_4(self):
        self.assertEqual(self.general["qgisMinimumVersion"], "3.22")
        self.assertEqual(self.general["qgisMaximumVersion"], "4.99")

    def test_no_address_is_invented(self):
        """The build inserts them (gis/package/addresses.cmake)."""
        for name in ("email", "homepage", "tracker", "repository"):
            self.assertNotIn(name, self.general)


if __name__ == "__main__":
    unittest.main()
