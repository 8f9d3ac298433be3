"""Sums, pairs and routes from Python: forms of input, exact cases, errors, and the examples in docstrings."""
import array
import ast
import doctest
import importlib
import math
import os
import pkgutil
import struct
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction

import sunder
from sunder import _sunder
from support import SHARED, SOURCE, cases, main, module

SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]
TRIANGLE = [(0, 0), (1, 0), (0, 1)]
HOLE = [(1, 1), (1, 2), (2, 2), (2, 1)]


def wkb(rings, order="<", kind=3, extra=(), srid=None):
    """A polygon as well-known binary; `extra` are Z and M of each vertex."""
    out = struct.pack(order + "BI", order == "<", kind)
    if srid is not None:
        out += struct.pack(order + "I", srid)
    out += struct.pack(order + "I", len(rings))
    for ring in rings:
        closed = [*ring, ring[0]]
        out += struct.pack(order + "I", len(closed))
        for vertex in closed:
            out += struct.pack(f"{order}{2 + len(extra)}d", *vertex, *extra)
    return out


class Holder:
    """An object that has only one of the attributes of geometries."""

    def __init__(self, **members):
        self.__dict__.update(members)


class Forms(unittest.TestCase):
    """Each form of a polygon with a hole gives the same shape."""

    def test_forms(self):
        rings = [SQUARE, HOLE]
        mapping = {"type": "Polygon", "coordinates": rings}
        forms = {
            "wkb": wkb(rings), "big-endian": wkb(rings, ">"), "iso z": wkb(rings, kind=1003, extra=(7,)),
            "iso zm": wkb(rings, kind=3003, extra=(7, 8)), "ewkb": wkb(rings, kind=0x20000003, srid=4326),
            "ewkb z": wkb(rings, ">", kind=0x80000003, extra=(float("nan"),)),
            "bytearray": bytearray(wkb(rings)), "memoryview": memoryview(wkb(rings)),
            "mapping": mapping, "feature": {"type": "Feature", "geometry": mapping},
            "collection": {"type": "GeometryCollection", "geometries": [mapping]},
            "multi": {"type": "MultiPolygon", "coordinates": [rings]},
            "interface": Holder(__geo_interface__=mapping), "attribute": Holder(wkb=wkb(rings)),
            "rings": rings, "tuples": tuple(map(tuple, rings)),
            "views": [memoryview(array.array("d", [v for xy in ring for v in xy])).cast("B").cast("d", [len(ring), 2])
                      for ring in rings],
            "geometry": sunder.Geometry(wkb(rings)),
        }
        numpy = module("numpy")
        if numpy:
            forms["numpy"] = [numpy.array(SQUARE, float), numpy.array(HOLE, dtype=">f4")]
            forms["integers"] = [numpy.array(SQUARE), numpy.array(HOLE, dtype="i2")]
            forms["reversed"] = [numpy.array(SQUARE, float)[::-1], numpy.array(HOLE, float)[::-1]]
            forms["columns"] = [numpy.asfortranarray(SQUARE), numpy.array([(*v, 9) for v in HOLE])]
        shapely = module("shapely.geometry")
        if shapely:
            forms["shapely"] = shapely.Polygon(SQUARE, [HOLE])
        for name, form in forms.items():
            with self.subTest(name):
                total = sunder.minkowski_sum(form, TRIANGLE, exact=True)
                self.assertEqual(total.area, sunder.minkowski_sum(mapping, TRIANGLE).area)
                self.assertEqual(total.polygons, sunder.minkowski_sum(mapping, TRIANGLE).polygons)
                self.assertEqual(sunder.least_translation(form, TRIANGLE), sunder.least_translation(mapping, TRIANGLE))

    def test_out(self):
        total = sunder.minkowski_sum(SQUARE, TRIANGLE)
        self.assertEqual(total.geometry, sunder.Geometry(total.wkb))
        self.assertEqual(total.__geo_interface__["coordinates"][0][0], (0, 0))
        shapely = module("shapely.geometry")
        if not shapely:
            self.skipTest("Shapely is not installed")
        made = sunder.minkowski_sum(shapely.Polygon(SQUARE), TRIANGLE).geometry
        self.assertEqual((made.geom_type, made.area, made.is_valid), ("Polygon", 24.5, True))
        self.assertEqual(shapely.shape(total.geometry).area, 24.5)
        self.assertEqual(shapely.shape(total).area, 24.5)


class Ragged(unittest.TestCase):
    """Coordinates in arrays with offsets, in and out."""

    def test_round(self):
        several = {"type": "MultiPolygon", "coordinates": [[SQUARE, HOLE], [[(9, 9), (10, 9), (9, 10)]]]}
        geometries = [SQUARE, None, several]
        xy, offsets = sunder.to_ragged(geometries)
        self.assertEqual([list(map(int, one)) for one in offsets], [[0, 5, 10, 15, 19], [0, 1, 3, 4], [0, 1, 1, 3]])
        again = sunder.from_ragged(xy, offsets)
        alike = _sunder.read_all(geometries, "a", "fail")
        self.assertEqual([again.wkb(k) for k in range(3)], [alike.wkb(k) for k in range(3)])
        apart = sunder.separate(again, 1)
        self.assertEqual(apart.status, sunder.separate(geometries, 1).status)
        moved = sunder.to_ragged(apart.geometries)[0].tolist()
        self.assertEqual(moved[0], [xy.tolist()[0][0] + apart.dx[0], xy.tolist()[0][1] + apart.dy[0]])
        first = sunder.from_ragged(xy[:5], ([0, 5], [0, 1]))
        self.assertEqual(sunder.least_translations(again, first).distance.tolist(),
                         sunder.least_translations(geometries, [SQUARE]).distance.tolist())
        for message, arguments in [("ring offsets: offset 1 is 99", (xy, ([0, 99], [0, 1]))),
                                   ("offsets: 1 arrays", (xy, [[0]])),
                                   ("begin with 0", (xy, ([1, 5], [0, 1]))), ("not an array", ([], ([0], [0]))),
                                   ("geometry 0: polygon 0", (xy[:2], ([0, 2], [0, 1])))]:
            with self.subTest(message):
                self.assertRaisesRegex(ValueError, message, sunder.from_ragged, *arguments, invalid="fail")
        self.assertRaisesRegex(ValueError, "moves: 2 of them", again.moved, array.array("d", [0] * 4))
        self.assertEqual(len(sunder.separate(sunder.from_ragged(xy[:0], ([0], [0]))).status), 0)

    def test_shapely(self):
        shapely = module("shapely")
        if not shapely or not hasattr(shapely, "to_ragged_array"):
            self.skipTest("there is no Shapely 2")
        _, xy, offsets = shapely.to_ragged_array([shapely.Polygon(SQUARE, [HOLE])])
        self.assertEqual(list(sunder.from_ragged(xy, offsets).areas()), [15.0])


class Without(unittest.TestCase):
    """The package needs neither NumPy nor Shapely."""

    def test_without(self):
        if os.environ.get("SUNDER_WITHOUT"):
            self.skipTest("this is the run without them")
        with tempfile.TemporaryDirectory() as folder:
            for name in ("numpy", "shapely", "geopandas"):
                with open(os.path.join(folder, name + ".py"), "w", encoding="ascii") as file:
                    file.write("raise ImportError('not here')\n")
            done = subprocess.run([sys.executable, __file__], capture_output=True, text=True, check=False, env={
                **os.environ, "SUNDER_WITHOUT": "yes", "PYTHONPATH": folder + ":" + os.environ["PYTHONPATH"]})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, "skipped=[3-9]")


class Cases(unittest.TestCase):
    """The exact cases of ../shared."""

    def test_cases(self):
        found = list(cases())
        if not found:
            self.skipTest(f"{SHARED}/cases is not there")
        self.assertGreaterEqual(len(found), 85)
        for name, p, q, expected in found:
            with self.subTest(name):
                self.check(p, q, expected)

    def test_batch(self):
        """All of them as no-fit polygons in one call, and turned by a right angle and by 3 + 4 i over 5."""
        found = list(cases())
        if not found:
            self.skipTest(f"{SHARED}/cases is not there")
        parts = [part for _, p, q, _ in found for part in (p, minus(q))]
        turns = [(1, 0, 1), (0, 1, 1), (3, 4, 5)]
        pairs = [(2 * k, 2 * k + 1, r, r) for k in range(len(found)) for r in range(3)]
        made = sunder.no_fit_polygons(parts, pairs, turns, exact=True, threads=2)
        for k, (name, _, _, expected) in enumerate(found):
            for r, (c, s, scale) in enumerate(turns):
                with self.subTest(name, rotation=r):
                    one = made[3 * k + r]
                    if one.rounded:  # its coordinates are too long to be turned exactly
                        self.assertEqual(r, 2)
                        continue
                    back = [((c * x + s * y) / scale, (c * y - s * x) / scale) for x, y in one.degenerate_points]
                    self.assertEqual(one.area, Fraction(expected["area"]))
                    self.assertEqual(sorted(back), sorted(pair(point) for point in expected["points"]))
                    self.assertEqual(len(one.degenerate_segments), len(expected["segments"]))

    def check(self, p, q, expected):
        total = sunder.minkowski_sum(p, q, exact=True)
        self.assertEqual(total.area, Fraction(expected["area"]))
        rings = sorted(sorted(ring) for polygon in total.polygons for ring in polygon)
        wanted = sorted(sorted(pair(xy) for xy in ring["pts"]) for ring in expected["result_rings"] or [])
        if expected["touch_vertices"] == 0 and wanted:
            self.assertEqual(rings, wanted)
        self.assertEqual(total.degenerate_points, sorted(pair(point) for point in expected["points"]))
        self.assertEqual(total.degenerate_segments,
                         sorted(tuple(sorted((pair(s["a"]), pair(s["b"])))) for s in expected["segments"]))
        negated = sunder.no_fit_polygon(q, minus(p), exact=True)
        self.assertEqual(negated.area, total.area)
        self.assertEqual(negated.polygons, total.polygons)
        # `mtv` is the least way out of the sum, so that of -q off p.
        least = sunder.least_translation(p, minus(q), exact=True)
        self.assertEqual(least.dx ** 2 + least.dy ** 2, Fraction(expected["mtv2"]))
        self.assertEqual(sunder.overlap(p, minus(q)), expected["origin_inside_open_sum"])


class Nesting(unittest.TestCase):
    """Many no-fit polygons in one call."""

    def test_rotations(self):
        parts = [SQUARE, TRIANGLE, [SQUARE, HOLE], list(SQUARE)]
        turns = [(1, 0, 1), sunder.rotation(90), (3, 4, 5), (-5, 12, 13)]
        pairs = [(a, b, r, s) for a in range(4) for b in range(4) for r in range(4) for s in range(4)]
        found = sunder.no_fit_polygons(parts, pairs, turns, exact=True, threads=2)
        self.assertEqual(len({id(one) for one in found}), 9 * 16)
        for one, (a, b, r, s) in zip(found, pairs):
            self.assertFalse(one.rounded)
            # Turned back by the rotation of the fixed part, in the plane of fractions.
            c, d, scale = turns[r]
            back = [[[((c * x + d * y) / scale, (c * y - d * x) / scale) for x, y in ring] for ring in polygon]
                    for polygon in one.polygons]
            alone = sunder.no_fit_polygons(parts, [(a, b, 0, 4)], [*turns, relative(turns[r], turns[s])], exact=True)[0]
            self.assertEqual(sorted(map(sorted, back[0])), sorted(map(sorted, alone.polygons[0])))
            self.assertEqual(one.area, alone.area)
        plain = sunder.no_fit_polygons(parts, [(2, 1)])[0]
        self.assertEqual(plain.polygons, sunder.no_fit_polygon(parts[2], parts[1]).polygons)
        turned = sunder.no_fit_polygons(parts, [(0, 1, 0, 2)], turns)[0]
        rings = turned.__geo_interface__["coordinates"]
        self.assertLessEqual(abs(sum(map(area, rings)) - turned.area), 1e-9)  # each coordinate is rounded

    def test_angles(self):
        for degrees in (0, 1, 29.5, 45, 90, 133.3, -77, 270, 359.9, 720.25):
            c, s, scale = sunder.rotation(degrees)
            self.assertEqual(c * c + s * s, scale * scale)
            error = (math.degrees(math.atan2(s, c)) - degrees + 180) % 360 - 180
            self.assertLessEqual(abs(math.radians(error)), 1e-6)

    def test_errors(self):
        for message, arguments in [("part 1: a text", ([SQUARE, "x"], [(0, 0)])), ("pair 0", ([SQUARE], [(0, 7)])),
                                   ("pair 1 has 3", ([SQUARE], [(0, 0), (1, 2, 3)])), ("number 0", ([None], [(0, 0)])),
                                   ("rotation 0", ([SQUARE], [(0, 0)], [(1, 0, 0)])),
                                   ("rotation 0 has 2", ([SQUARE], [(0, 0)], [(1, 0)]))]:
            with self.subTest(message):
                self.assertRaisesRegex(ValueError, message, sunder.no_fit_polygons, *arguments)


def relative(first, second):
    """The rotation that leads from one to the other."""
    (a, b, m), (c, d, n) = first, second
    return a * c + b * d, a * d - b * c, m * n


def area(ring):
    return sum(x * v - u * y for (x, y), (u, v) in zip(ring, ring[1:])) / 2


def pair(texts):
    return Fraction(texts[0]), Fraction(texts[1])


def minus(mapping):
    """The reflection of a mapping in the origin."""
    def turn(value):
        return [-v for v in value] if isinstance(value[0], (int, float)) else [turn(v) for v in value]
    return {"type": mapping["type"], "coordinates": turn(mapping["coordinates"])}


class Errors(unittest.TestCase):
    """Errors name the geometry and the cause."""

    def test_messages(self):
        bow = [(0, 0), (2, 2), (2, 0), (0, 2)]
        for geometry, what in [
                (b"\x01\x03\x00", "a: its well-known binary ends too early"),
                (b"\x07" + b"\x00" * 20, "byte order is 7"), ("POINT", "a: a text"), (7, "a: not a geometry"),
                ({"type": "Nothing"}, "a: a mapping of the type Nothing"), ({}, "a: a mapping without a type"),
                ([[(0, 0), (1, "x"), (1, 1)]], "a: a coordinate is not a number"), ([], "a: an empty sequence"),
                ([(0, 0), (float("nan"), 1), (1, 1)], "a: polygon 0, ring 0, vertex 1"), (None, "a: no polygons"),
                ({"type": "Point", "coordinates": (1, 2)}, "a: no polygons")]:
            with self.subTest(what):
                self.assertRaisesRegex(ValueError, what, sunder.minkowski_sum, geometry, SQUARE)
        self.assertRaisesRegex(ValueError, "a: polygon 0, ring 0.*crosses", sunder.minkowski_sum, bow, SQUARE,
                               invalid="fail")
        with self.assertWarnsRegex(sunder.InvalidGeometryWarning, "^a: polygon 0.*even-odd") as told:
            repaired = sunder.minkowski_sum(bow, TRIANGLE)
        self.assertEqual(told.filename, __file__)
        with self.assertWarns(sunder.InvalidGeometryWarning) as told:
            sunder.separate([bow])
        self.assertEqual(told.filename, __file__)
        self.assertEqual(repaired.polygons, sunder.minkowski_sum(
            {"type": "MultiPolygon", "coordinates": [[[(0, 0), (1, 1), (0, 2)]], [[(2, 0), (2, 2), (1, 1)]]]},
            TRIANGLE).polygons)
        self.assertRaisesRegex(ValueError, "b 1: polygon 0", sunder.least_translations, [SQUARE], [SQUARE, [(0, 0)]],
                               invalid="fail")
        self.assertRaisesRegex(ValueError, "gap", sunder.least_translation, SQUARE, SQUARE, -1)
        self.assertRaisesRegex(ValueError, "invalid", sunder.minkowski_sum, SQUARE, SQUARE, invalid="mend")
        self.assertRaisesRegex(ValueError, "start", sunder.route, [SQUARE], TRIANGLE, (0,), (9, 9))
        self.assertRaisesRegex(sunder.Error, "range of doubles",
                               lambda: sunder.minkowski_sum([(0, 0), (1.7e308, 0), (0, 1.7e308)],
                                                            [(0, 0), (1.7e308, 0), (0, 1.7e308)]).geometry)

    def test_callback(self):
        big = sunder.disc(3, 4000)
        star = [(x * (2 if k % 2 else 1), y * (2 if k % 2 else 1)) for k, (x, y) in enumerate(
            sunder.Geometry(sunder.disc(3, 600).wkb(0)).__geo_interface__["coordinates"][0][:-1])]

        def stop(_):
            raise LookupError("enough")
        self.assertRaisesRegex(LookupError, "enough", sunder.erode, big, star, threads=2, progress=stop)
        self.assertRaisesRegex(ValueError, "progress", sunder.minkowski_sum, SQUARE, SQUARE, progress=3)


class Examples(unittest.TestCase):
    """The examples in docstrings."""

    def test_docstrings(self):
        tried = 0
        for one in pkgutil.iter_modules(sunder.__path__):
            if one.name == "_sunder":
                continue
            result = doctest.testmod(importlib.import_module(f"sunder.{one.name}"), extraglobs=vars(sunder))
            self.assertEqual(result.failed, 0)
            tried += result.attempted
        self.assertGreater(tried, 20)
        # The stub names what the extension has.
        with open(os.path.join(SOURCE, "gis", "python", "sunder", "_sunder.pyi"), encoding="utf-8") as file:
            stub = {node.name: node for node in ast.parse(file.read()).body if hasattr(node, "name")}
        self.assertEqual(sorted(stub), sorted(n for n in dir(_sunder) if not n.startswith("_") and n != "version"))
        for kind in ("Shapes", "Sum"):
            self.assertEqual(sorted(one.name for one in stub[kind].body if not one.name.startswith("_")),
                             sorted(n for n in dir(getattr(_sunder, kind)) if not n.startswith("_")))
        for name in sunder.__all__:
            self.assertTrue(getattr(sunder, name).__doc__, name)


if __name__ == "__main__":
    main()
