"""Whole layers from Python: the same bytes as the program, GeoDataFrames, errors, Ctrl-C, the interpreter's lock."""
import json
import math
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings

import sunder
from support import SHARED, SOURCE, main, module

ogr = module("osgeo.ogr")
TOWN = os.path.join(SOURCE, "datasets-synthetic", "town.gpkg")
KREMS = os.path.join(SHARED, "data", "krems_2013.gpkg")
PROGRAM = os.environ.get("SUNDER", "")


def read(path, layer, near=None):
    """The features of a layer, {fid: (wkb, attributes)}; with `near` in the order in which GDAL finds them in a box."""
    ogr.UseExceptions()
    source = ogr.Open(path)
    features = source.GetLayerByName(layer)
    if near:
        left, right, bottom, top = source.GetLayerByName(near).GetExtent()
        features.SetSpatialFilterRect(left - 50, bottom - 50, right + 50, top + 50)
    return {one.GetFID(): (bytes(one.GetGeometryRef().ExportToIsoWkb()), one.items()) for one in features}


def call(folder, *words):
    """Runs the program; returns its statistics."""
    done = subprocess.run([PROGRAM, *words, "--stats", "-", "--quiet"], cwd=folder, capture_output=True, check=False)
    if done.returncode not in (0, 3):
        raise AssertionError(done.stderr.decode())
    return json.loads(done.stdout[done.stdout.index(b"{"):].decode().splitlines()[0]
                      if done.stdout.count(b"\n") == 1 else done.stdout)


class SameBytes(unittest.TestCase):
    """`separate` gives the geometries, statuses, blocks, conflicts, cost and bound of the program."""

    def setUp(self):
        if not ogr:
            self.skipTest("GDAL's Python module is not installed")
        if not os.access(PROGRAM, os.X_OK):
            self.skipTest("the program was not built")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def compare(self, path, words, layer="buildings", **arguments):
        """Compares one layer; `words` are the program's options that `arguments` say."""
        features = read(path, layer)
        output = os.path.join(self.folder, "out.gpkg")
        stats = call(self.folder, "separate", path, output, "--input-layer", layer, "--overwrite", *words)
        wanted = read(output, layer)
        arguments = {name: value(features) if callable(value) else value for name, value in arguments.items()}
        fids = list(features)
        result = sunder.separate([wkb for wkb, _ in features.values()], **arguments)
        self.assertEqual(fids, list(wanted))
        self.assertEqual(result.geometries, [wkb for wkb, _ in wanted.values()])
        self.assertEqual(result.status, [row["sunder_st"] for _, row in wanted.values()])
        self.assertEqual([fids[k] if k >= 0 else None for k in result.block.tolist()],
                         [row["sunder_blk"] for _, row in wanted.values()])
        self.assertEqual(result.dx.tolist(), [row["sunder_dx"] for _, row in wanted.values()])
        self.assertEqual(result.dy.tolist(), [row["sunder_dy"] for _, row in wanted.values()])
        self.assertEqual((result.cost, result.bound, result.verified),
                         (stats["displacement"]["cost"], stats["displacement"]["lower_bound"], stats["verified"]))
        listed = read(output, f"{layer}_conflicts")
        for one, (_, row) in zip(result.conflicts, listed.values()):
            names = ("kind", "reason", "distance", "depth", "need_shift", "need_gap")
            self.assertEqual([getattr(one, name) or None for name in names], [row[name] or None for name in names])
            self.assertEqual(fids[one.a], row["fid_a"])
            self.assertEqual(None if one.b is None else fids[one.b], row["fid_b"])
        self.assertEqual(len(result.conflicts), len(listed))
        self.assertGreater(sum(abs(result.dx)), 0)

    def roads(self, path=TOWN, **arguments):
        return sunder.Barrier([wkb for wkb, _ in read(path, "roads", "buildings").values()], **arguments)

    def test_town(self):
        road = f"{TOWN},layer=roads,"
        cases = [
            (["--gap", "3"], {"gap": 3}),
            (["--gap", "3", "--barrier", road + "width=6", "--max-shift", "5"],
             {"gap": 3, "barriers": self.roads(width=6), "max_shift": 5}),
            (["--gap", "2", "--weight", "area", "--rows", "no", "--effort", "0.2", "--seed", "7"],
             {"gap": 2, "weight": "area", "rows": "no", "effort": 0.2, "seed": 7}),
            (["--gap", "3", "--weight", "sqrt-area", "--weight-field", "height", "--no-blocks", "--threads", "1"],
             {"gap": 3, "weight": "sqrt-area", "no_blocks": True, "threads": 1,
              "weights": lambda of: [row["height"] for _, row in of.values()]}),
            (["--gap", "4", "--least-gap", "2", "--ease", "10", "--barrier", road + "gap=5,least=1,side=no"],
             {"gap": 4, "least_gap": 2, "ease": 10, "barriers": self.roads(gap=5, least_gap=1, side=False)}),
            (["--gap", "3", "--fixed-where", "fid % 5 = 0", "--ignore-where", "fid % 11 = 3", "--contained", "separate",
              "--touch-tolerance", "0.01", "--allow-jumps"],
             {"gap": 3, "contained": "separate", "touch_tolerance": 0.01, "allow_jumps": True,
              "fixed": lambda of: [fid % 5 == 0 for fid in of], "ignored": lambda of: [fid % 11 == 3 for fid in of]}),
            (["--gap", "3", "--block-field", "kind", "--max-shift-field", "height", "--row-stiffness", "10,1",
              "--ease", "no"],
             {"gap": 3, "row_stiffness": (10, 1), "ease": None,
              "blocks": lambda of: [row["kind"] for _, row in of.values()],
              "max_shift": lambda of: [row["height"] for _, row in of.values()]}),
            (["--gap", "3", "--rows", "kind", "--no-blocks", "--barrier", road + "width-field=width", "--max-shift",
              "2"],
             {"gap": 3, "max_shift": 2, "no_blocks": True, "rows": lambda of: [row["kind"] for _, row in of.values()],
              "barriers": self.roads(width=[row["width"] for _, row in read(TOWN, "roads").values()])}),
        ]
        for words, arguments in cases:
            if "effort" not in arguments and len(words) != 2:
                words, arguments = [*words, "--effort", "0.05"], {**arguments, "effort": 0.05}
            with self.subTest(" ".join(words)):
                self.compare(TOWN, words, **arguments)

    def test_real(self):
        if not os.path.exists(KREMS):
            self.skipTest(f"{KREMS} is not there")
        self.compare(KREMS, ["--gap", "2", "--barrier", f"{KREMS},layer=roads,width=4", "--max-shift", "4",
                             "--effort", "0.1"], gap=2, barriers=self.roads(KREMS, width=4), max_shift=4, effort=0.1)
        self.compare(KREMS, ["--gap", "10", "--symbol", "disc:6", "--max-shift", "20", "--effort", "0"], "pois", gap=10,
                     symbol=sunder.disc(6), max_shift=20, effort=0)

    def test_check(self):
        features = read(TOWN, "buildings")
        found = sunder.check([wkb for wkb, _ in features.values()], 3, barriers=self.roads(width=6))
        wanted = call(self.folder, "check", TOWN, "--input-layer", "buildings", "--gap", "3", "--barrier",
                      f"{TOWN},layer=roads,width=6", "--output", "found.gpkg")
        self.assertEqual(found.counts, wanted["conflicts"])


class Frames(unittest.TestCase):
    """GeoPandas and Shapely in, and out."""

    def setUp(self):
        self.geopandas, self.shapely = module("geopandas"), module("shapely.geometry")
        if not self.geopandas:
            self.skipTest("GeoPandas is not installed")

    def test_frame(self):
        box = self.shapely.box
        frame = self.geopandas.GeoDataFrame(
            {"name": ["a", "b", "c", "d"], "limit": [None, 0.2, 5, 5], "street": ["x", None, None, "x"]},
            geometry=[box(0, 0, 4, 4), box(3.5, 0, 7, 4), None, box(20, 0, 21, 1)], crs=25832, index=[10, 20, 30, 40])
        result = sunder.separate(frame, 1, max_shift="limit", blocks="street")
        self.assertEqual(result.status, ["moved", "moved", "skipped", "moved"])
        self.assertEqual(list(result.frame.columns), [
            *frame.columns, "sunder_dx", "sunder_dy", "sunder_len", "sunder_st", "sunder_blk"])
        self.assertEqual((list(result.frame.index), result.frame.crs), ([10, 20, 30, 40], frame.crs))
        self.assertEqual(result.frame.sunder_blk.tolist()[0], 10)
        self.assertTrue(result.frame.sunder_blk.isna()[20])
        self.assertIs(frame.geometry[20], frame.geometry.values[1])
        self.assertGreaterEqual(result.geometries.values[0].distance(result.geometries.values[1]), 1 - 1e-12)
        series = sunder.separate(frame.geometry, 1)
        self.assertEqual(type(series.geometries), self.geopandas.GeoSeries)
        self.assertIsNone(series.frame)
        alone = sunder.separate(list(frame.geometry), 1)
        self.assertEqual([getattr(one, "wkb", None) for one in alone.geometries],
                         [getattr(one, "wkb", None) for one in series.geometries.values])
        self.assertIs(alone.geometries[3], frame.geometry.values[3])
        with_z = sunder.separate([self.shapely.Polygon([(0, 0, 9), (1, 0, 9), (1, 1, 8)]), box(0.5, 0, 2, 1)], 1)
        self.assertEqual([z for _, _, z in with_z.geometries[0].exterior.coords], [9, 9, 8, 9])

    def test_crs(self):
        frame = self.geopandas.GeoSeries([self.shapely.box(0, 0, 1, 1)], crs=4326)
        self.assertRaisesRegex(ValueError, "degrees", sunder.separate, frame, 1)
        metres = frame.set_crs(25832, allow_override=True)
        self.assertRaisesRegex(ValueError, "barrier 0: its CRS", sunder.separate, metres, 1, barriers=frame)


class Errors(unittest.TestCase):
    """Errors name the feature and the cause."""

    SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]

    def test_messages(self):
        two = [self.SQUARE, [(0.5, 0), (2, 0), (2, 1)]]
        bow = [(0, 0), (2, 2), (2, 0), (0, 2)]
        nan, wrong = math.nan, [(0, 0), (math.nan, 1), (1, 1)]
        for what, features, arguments in [
                ("gap", two, {"gap": -1}), ("gap", two, {"gap": nan}),
                ("max_shift: that of geometry 1 is -3", two, {"max_shift": [1, -3]}),
                ("max_shift: 3 values for 2", two, {"max_shift": [1, 2, 3]}),
                ("geometry 1: polygon 0", [bow, wrong], {}),
                ("weight: that of geometry 1", two, {"weights": [1, 0]}), ("weight: 7", two, {"weight": 7}),
                ("no column size", two, {"weights": "size"}),
                ("geometry 0: polygon 0.*crosses", [bow], {"invalid": "fail"}),
                ("none of block, ignore, separate", two, {"contained": "keep"}),
                ("least_gap", two, {"gap": 1, "least_gap": 2}),
                ("touch", two, {"gap": 1, "touch_tolerance": 1}), ("threads", two, {"threads": -1}),
                ("threads", two, {"threads": 10 ** 30}), ("seed", two, {"seed": "x"}), ("effort", two, {"effort": nan}),
                ("barrier 0: geometry 0: a text", two, {"barriers": [["x"]]}),
                ("barrier 0: 2 widths for 1", two, {"barriers": [sunder.Barrier([self.SQUARE], width=[1, 2])]}),
                ("barrier 0: its least_gap", two, {"barriers": [sunder.Barrier([self.SQUARE], gap=1, least_gap=2)]}),
                ("row_stiffness", two, {"row_stiffness": (1,)}), ("not a sequence", 7, {})]:
            with self.subTest(what), warnings.catch_warnings():
                warnings.simplefilter("ignore", sunder.InvalidGeometryWarning)
                self.assertRaisesRegex((ValueError, TypeError), what if features != 7 else "iterable", sunder.separate,
                                       features, **arguments)

    def test_others(self):
        with self.assertWarnsRegex(UserWarning, "1 features are not polygons"):
            result = sunder.separate([self.SQUARE, {"type": "Point", "coordinates": (0, 0)}, None])
        self.assertEqual(result.status, ["unmoved", "skipped", "skipped"])
        self.assertEqual(sunder.separate([]).status, [])
        bow = [(0, 0), (2, 2), (2, 0), (0, 2)]
        with self.assertWarnsRegex(sunder.InvalidGeometryWarning, "geometry 1: .*skipped"):
            self.assertEqual(sunder.separate([self.SQUARE, bow], invalid="skip").status[1], "skipped")


def crowd(n):
    """Squares that overlap in rows, for a run of some seconds."""
    return [[(x * 0.9, y * 0.9), (x * 0.9 + 1, y * 0.9), (x * 0.9 + 1, y * 0.9 + 1), (x * 0.9, y * 0.9 + 1)]
            for x in range(n) for y in range(n)]


class Running(unittest.TestCase):
    """Threads, progress, interruption."""

    def test_lock(self):
        count, stop = [0], threading.Event()

        def beside():
            while not stop.is_set():
                count[0] += 1
                time.sleep(0.001)
        thread = threading.Thread(target=beside)
        thread.start()
        told = []
        result = sunder.separate(crowd(8), 0.5, no_blocks=True, effort=0.1, progress=told.append)
        stop.set()
        thread.join()
        self.assertGreater(count[0], 3)
        self.assertEqual(told, sorted(told))
        self.assertTrue(all(0 <= one <= 1 for one in told))
        again = [None, None]

        def separate(k):
            again[k] = sunder.separate(crowd(8), 0.5, no_blocks=True, effort=0.1, threads=k + 1)
        threads = [threading.Thread(target=separate, args=(k,)) for k in range(2)]
        for one in threads:
            one.start()
        for one in threads:
            one.join()
        self.assertEqual([list(one.dx) for one in again], [list(result.dx)] * 2)

    def test_stop(self):
        def stop(fraction):
            if fraction > 0.01:
                raise LookupError("enough")
        self.assertRaisesRegex(LookupError, "enough", sunder.separate, crowd(20), 0.5, no_blocks=True, progress=stop)

    def test_interrupt(self):
        """A signal ends a long call with KeyboardInterrupt, in each way that work runs."""
        for work in ("sunder.separate(crowd(60), 0.5, no_blocks=True, effort=1e6)",
                     "sunder.least_translations([star] * 500, [star])",
                     "sunder.minkowski_sum(star, star)", "sunder.erode(star, star, threads=2)"):
            script = f"""
import math, sys, time, sunder
from test_layers import crowd
star = [(math.cos(k) * (9 + k * k % 7), math.sin(k) * (9 + k * k % 7)) for k in
        (2 * math.pi * i / 3001 for i in range(3001))]
star = [(r * x, r * y) for r, (x, y) in zip([1, 3, 2] * 1001, star)]
print("begun", flush=True)
try:
    {work}
    print("ended")
except KeyboardInterrupt:
    print("stopped")
"""
            with self.subTest(work), subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE) as run:
                self.assertEqual(run.stdout.readline(), b"begun\n")
                time.sleep(1)
                run.send_signal(signal.SIGINT)
                asked = time.monotonic()
                self.assertEqual(run.stdout.readline(), b"stopped\n")
                print(f"{work}: stopped after {time.monotonic() - asked:.3f} s", file=sys.stderr)


if __name__ == "__main__":
    main()
