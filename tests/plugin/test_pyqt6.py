"""Does the plug-in run on PyQt6? Its modules are imported with PyQt6 as `qgis.PyQt`, and all names that they use from
it, including enumerators, are looked up in PyQt6. The other packages of QGIS are replaced by stand-ins that have
every name."""
import ast
import glob
import importlib
import os
import sys
import types
import unittest

try:
    import PyQt6.QtCore
    import PyQt6.QtGui
    import PyQt6.QtXml
except ImportError as missing:
    print("skipped: PyQt6 is not installed: %s" % missing)
    sys.exit(77)

PARENT = os.path.join(os.environ["SUNDER_SOURCE"], "gis", "qgis")
FILES = sorted(glob.glob(os.path.join(PARENT, "sunder", "*.py")))


class AnyName(type):
    """A class that has every member. Each member is again such a class, so that it can be subclassed and called."""

    def __getattr__(cls, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return AnyName(name, (), {"__init__": lambda self, *given, **named: None})


class StandIn(types.ModuleType):
    __path__ = []

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return getattr(AnyName("Any", (), {}), name)


def parsed(file):
    with open(file, encoding="utf-8") as opened:
        return ast.parse(opened.read(), file)


def stand_in_for_qgis():
    """Finds each imported module of QGIS, and its parent packages."""
    for file in FILES:
        for node in ast.walk(parsed(file)):
            modules = ([node.module or ""] if isinstance(node, ast.ImportFrom) and not node.level else
                       [each.name for each in node.names] if isinstance(node, ast.Import) else [])
            for words in (module.split(".") for module in modules):
                for n in range(1, len(words) + 1 if words[0] in ("qgis", "processing") else 0):
                    name = ".".join(words[:n])
                    sys.modules.setdefault(name, StandIn(name))
    for name in ("QtCore", "QtGui", "QtXml"):
        sys.modules["qgis.PyQt." + name] = sys.modules["PyQt6." + name]
    # The types of QVariant are gone from PyQt6. QGIS puts them back for plug-ins that are written for QGIS 3, too.
    for kind in PyQt6.QtCore.QMetaType.Type:
        setattr(PyQt6.QtCore.QVariant, kind.name[1:] if kind.name[0] == "Q" else kind.name, kind)


def taken_from_qt(tree):
    """For each name that is imported from qgis.PyQt: its module in PyQt6."""
    return {each.asname or each.name: node.module.rpartition(".")[2] for node in ast.walk(tree)
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("qgis.PyQt.") for each in node.names}


def dotted(node):
    names = []
    while isinstance(node, ast.Attribute):
        names.append(node.attr)
        node = node.value
    return [node.id, *reversed(names)] if isinstance(node, ast.Name) else []


class OnPyQt6(unittest.TestCase):
    def setUp(self):
        stand_in_for_qgis()

    def test_all_modules_import(self):
        sys.path.insert(0, PARENT)
        for file in FILES:
            name = os.path.splitext(os.path.basename(file))[0]
            importlib.import_module("sunder" if name == "__init__" else "sunder." + name)
        self.assertGreater(len(FILES), 10)

    def test_all_that_is_taken_from_qt_is_there(self):
        looked_up = 0
        for file in FILES:
            tree = parsed(file)
            modules = taken_from_qt(tree)
            for node in ast.walk(tree):
                names = dotted(node) if isinstance(node, ast.Attribute) else []
                if not names or names[0] not in modules:
                    continue
                found = sys.modules["PyQt6." + modules[names[0]]]
                for name in names:
                    self.assertTrue(hasattr(found, name), "%s:%d: %s" % (file, node.lineno, ".".join(names)))
                    found = getattr(found, name)
                looked_up += 1
        self.assertGreater(looked_up, 5)


if __name__ == "__main__":
    unittest.main()
