"""What the tests of the Python package share: cases of ../shared, texts of WKT, a plain oracle, the end of a test."""
import glob
import importlib
import os
import re
import sys
import unittest

SOURCE = os.environ["SUNDER_SOURCE"]
SHARED = os.path.join(os.path.dirname(SOURCE), "shared")
SKIPPED = 77


def polygons_of(text):
    """The polygons of a text POLYGON or MULTIPOLYGON: a mapping of GeoJSON; numbers are floats."""
    body = text[text.index("("):]
    rings = re.sub(r"(-?[\d.eE+-]+)\s+(-?[\d.eE+-]+)", r"[\1,\2]", body).replace("(", "[").replace(")", "]")
    coordinates = __import__("json").loads(rings)
    return {"type": "MultiPolygon" if text.upper().startswith("MULTI") else "Polygon", "coordinates": coordinates}


def cases():
    """(name, P, Q, expected) of each exact case of ../shared, if it is there."""
    import json
    for path in sorted(glob.glob(os.path.join(SHARED, "cases", "*.wkt"))):
        with open(path, encoding="ascii") as file:
            first, second = file.read().splitlines()[:2]
        with open(path[:-4] + ".expect.json", encoding="ascii") as file:
            expected = json.load(file)
        yield os.path.basename(path)[:-4], polygons_of(first), polygons_of(second), expected


def module(name):
    """A module, or None if it is not installed."""
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


def main():
    """Runs the tests of the calling file. If all of them were skipped, so is the file."""
    ended = unittest.main(exit=False, verbosity=1)
    if not ended.result.wasSuccessful():
        sys.exit(1)
    if ended.result.testsRun and len(ended.result.skipped) == ended.result.testsRun:
        print("skipped:", "; ".join(sorted({reason for _, reason in ended.result.skipped})))
        sys.exit(SKIPPED)
