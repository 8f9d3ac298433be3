"""Malformed input does not crash: it is taken, or refused by ValueError. Nothing leaks.

SUNDER_SEED replays a run; SUNDER_TEST_SCALE makes more of it. With arguments the file is a worker of its own tests:
`leaks N`, `counts N` and `calls N` call everything N times.
"""
import array
import gc
import glob
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import tracemalloc
import unittest
import warnings

import sunder
from sunder import _sunder
from support import SOURCE, main, module

SEED = int(os.environ.get("SUNDER_SEED", "20"))
SCALE = int(os.environ.get("SUNDER_TEST_SCALE", "1"))
FINE = (ValueError, sunder.Error, MemoryError)
SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]
NUMBERS = [0, 1, -1, 0.5, 3, 1e-300, 1e300, -1e308, float("nan"), float("inf"), -0.0, 2 ** 53 + 1, 10 ** 400, "x",
           None, [], b"1", 1j]
TYPES = ["f4", "f2", "i1", "u8", "i8", "?", "c16", "O", "U3", "M8[s]", ">f8", ">i4", "g", "V8"]


def mutate(rng, data):
    """Bytes with some of them changed, cut or doubled."""
    data = bytearray(data)
    for _ in range(rng.randrange(1, 4)):
        at = rng.randrange(len(data) + 1)
        kind = rng.randrange(4)
        if kind == 0 and at < len(data):
            data[at] = rng.randrange(256)
        elif kind == 1:
            del data[at:at + rng.randrange(9)]
        elif kind == 2:
            data[at:at] = data[at // 2:at]
        else:
            data[at:at + 4] = rng.choice([b"\xff\xff\xff\xff", b"\0\0\0\0", b"\x07\0\0\0", b"\x03\0\0\x80"])
    return bytes(data)


def nest(rng, depth):
    """A tree of lists, tuples and odd values in place of coordinates."""
    if depth == 0 or rng.random() < 0.15:
        return rng.choice(NUMBERS)
    return rng.choice([list, tuple])(nest(rng, depth - 1) for _ in range(rng.choice([0, 1, 2, 2, 2, 3, 5])))


def mapping(rng):
    kinds = ["Polygon", "MultiPolygon", "Point", "LineString", "GeometryCollection", "Feature", "FeatureCollection", 3]
    made = {"type": rng.choice(kinds)}
    made[rng.choice(["coordinates", "geometries", "geometry", "features"])] = rng.choice(
        [nest(rng, 4), None, SQUARE, [SQUARE], [made], {}, made])
    return made


def odd_array(rng, numpy):
    """An array of another type, shape, order or stride than (n, 2) float64, or with odd values."""
    good = numpy.array(SQUARE, float)
    kind = rng.randrange(14)
    if kind == 0:
        return good[::rng.choice([-1, -2, 2])]
    if kind == 1:
        return good.astype(rng.choice(TYPES))
    if kind == 2:
        good[rng.randrange(4), rng.randrange(2)] = rng.choice([numpy.nan, numpy.inf, 1e308, -0.0, 5e-324])
        return good
    if kind == 3:
        return good[:rng.randrange(3)]
    if kind == 4:
        good.flags.writeable = False
        return good
    if kind == 5:
        return numpy.broadcast_to(good[0], (2 ** rng.choice([2, 44, 58]), 2))
    if kind == 6:
        return good.T if rng.random() < 0.5 else good.reshape(rng.choice([(8,), (2, 2, 2), (1, 8), (8, 1), (2, 4)]))
    if kind == 7:
        return numpy.empty(rng.choice([(0, 2), (0,), (2, 0), (0, 0), ()]))
    if kind == 8:
        return numpy.asfortranarray(numpy.repeat(good, rng.randrange(1, 4), rng.randrange(2)))
    if kind == 9:
        return numpy.ma.masked_array(good, mask=good > 2)
    if kind == 10:
        return good.astype(rng.choice(["i8", "u8"])) * 2 ** 60
    if kind == 11:
        return numpy.array([(1, 2.0), (3, 4.0)], dtype=[("x", "i4"), ("y", "f8")])
    if kind == 12:
        return memoryview(good.tobytes()).cast("d", rng.choice([[4, 2], [8], [2, 2, 2]]))
    return numpy.array([rng.choice(NUMBERS[:9]) for _ in range(2 * rng.randrange(9))], float).reshape(-1, 2)


def odd_ragged(rng):
    """Coordinates and offsets for the reader of arrays, most of them wrong."""
    def offsets(most):
        kind = rng.randrange(6)
        made = [0, *sorted(rng.randrange(most + 2) for _ in range(rng.randrange(5)))]
        if kind == 0:
            rng.shuffle(made)
        if kind == 1:
            made = [-1, *made]
        if kind == 2:
            return rng.choice([None, [], "abc", 3, array.array("d", [0, 1]), [0, 2 ** 63], [0, 2 ** 70],
                               array.array("b", [0])])
        return array.array(rng.choice("hilqLQ"), [abs(one) for one in made]) if kind > 3 else made
    points = array.array("d", [rng.choice([0, 1, 2, 3, 4]) for _ in range(2 * rng.randrange(12))])
    return (points if rng.random() < 0.8 else rng.choice([None, points[:1], array.array("f", points), b"x" * 16]),
            offsets(len(points) // 2), offsets(3), rng.choice([None, offsets(3)]))


class Hostile(unittest.TestCase):
    """Ten thousand malformed geometries, and malformed arguments."""

    def attempt(self, what, function, *arguments, **named):
        try:
            return function(*arguments, **named)
        except FINE as error:
            self.assertTrue(str(error) or isinstance(error, MemoryError), what)
        return None

    def test_geometries(self):
        rng, numpy = random.Random(SEED), module("numpy")
        print("seed", SEED)
        wkb = sunder.Geometry.from_coordinates([SQUARE, [(1, 1), (1, 2), (2, 2)]]).wkb
        collection = b"\x01\x07\0\0\0\x02\0\0\0" + wkb + b"\x01\x01\0\0\0" + bytes(16)
        sources = [lambda: mutate(rng, wkb), lambda: mutate(rng, collection), lambda: nest(rng, 4),
                   lambda: mapping(rng), lambda: rng.choice(NUMBERS)]
        if numpy:
            sources += [lambda: odd_array(rng, numpy)] * 3
            sources.append(lambda: [odd_array(rng, numpy) for _ in range(rng.randrange(3))])
        else:
            print("NumPy is not installed: no arrays of odd types")
        taken = 0
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for k in range(10000 * SCALE):
                made = rng.choice(sources)()
                invalid = rng.choice(["repair", "skip", "fail"])
                shapes = self.attempt(k, _sunder.read, made, "a", invalid)
                taken += shapes is not None
                if k % 4 == 0:
                    self.attempt(k, sunder.least_translation, made, SQUARE, invalid=invalid)
                if k % 8 == 0:
                    self.attempt(k, sunder.separate, [made, SQUARE], 1, effort=0, invalid=invalid)
                if k % 8 == 4:
                    self.attempt(k, lambda one=made: sunder.minkowski_sum(one, SQUARE).geometry)
        self.assertGreater(taken, 500)

    def test_ragged(self):
        rng = random.Random(SEED)
        taken = sum(self.attempt(k, _sunder.read_ragged, *odd_ragged(rng), "a", "repair") is not None
                    for k in range(10000 * SCALE))
        self.assertGreater(taken, 300)

    def test_arguments(self):
        """Numbers and arrays of demands of odd kinds."""
        rng = random.Random(SEED)
        names = ["gap", "max_shift", "weight", "weights", "fixed", "ignored", "blocks", "touch_tolerance", "rows",
                 "ease", "row_stiffness", "least_gap", "effort", "seed", "threads", "barriers", "prefer",
                 "symbol", "contained"]
        odd = [0, -1, 1e308, float("nan"), float("inf"), 2 ** 70, "x", None, [], [1], [1, 2], [1, "x"], ["a", None],
               b"1", {}, [(1, 2), (3, 4)], [[SQUARE]], SQUARE, [None, None], (0.5, 0.5), [1e-101, 1]]
        for k in range(2000 * SCALE):
            named = {rng.choice(names): rng.choice(odd) for _ in range(rng.randrange(1, 4))}
            named["effort"] = min(named["effort"], 1) if isinstance(named.get("effort"), (int, float)) else 0
            try:
                sunder.separate([SQUARE, [(3, 0), (7, 0), (7, 4)]], **named)
            except (*FINE, TypeError, OverflowError, KeyError, AttributeError):
                pass

    def test_lying_objects(self):
        """Objects that change, or raise, while they are read."""
        class Shrinking(list):
            def __len__(self):
                return 9

        class Raising:
            @property
            def __geo_interface__(self):
                raise LookupError("no interface")

        class Looping(dict):
            def __getitem__(self, key):
                return "GeometryCollection" if key == "type" else [self]
        for one in (Shrinking(SQUARE), [Shrinking([(0, 0)])], Raising(), Looping(type="x"), Looping):
            self.assertRaises((ValueError, LookupError, AttributeError), sunder.minkowski_sum, one, SQUARE)


# ---- Leaks -----------------------------------------------------------------------------------------------------------


def call_everything(k):
    """One round of all calls, failures included."""
    unit = [(0, 0), (1, 0), (1, 1), (0, 1 + k % 3)]
    total = sunder.minkowski_sum(unit, SQUARE, exact=True)
    for name in ("geometry", "polygons", "degenerate_points", "area", "__geo_interface__"):
        getattr(total, name)
    sunder.no_fit_polygon(SQUARE, unit).degenerate_segments  # pylint: disable=W0106
    sunder.least_translation(unit, SQUARE)
    sunder.least_translations([unit, SQUARE], [SQUARE])
    sunder.from_ragged(*sunder.to_ragged([unit, SQUARE])).moved(sunder.least_translations([unit] * 2, [SQUARE]).moves)
    sunder.no_fit_polygons([unit, SQUARE], [(0, 1), (1, 0)])
    sunder.overlap(unit, SQUARE), sunder.apart(unit, SQUARE), sunder.distance(unit, SQUARE)
    if k % 10 == 0:
        sunder.route([[(2, -3), (3, -3), (3, 3), (2, 3)]], sunder.square(2), (0, 0), (5, 0), progress=lambda _: None)
        sunder.erode(SQUARE, sunder.disc(0.5, 8))
        sunder.separate([SQUARE, [(3, 0), (7, 0), (7, 4)], None], 0.5, barriers=[[[(0, 5), (9, 5), (9, 6)]]], effort=0,
                        max_shift=1, blocks=["a", "b", None])
        sunder.check([SQUARE, SQUARE], 1)
    for wrong in (b"\x01\x03\0", [(0, 0), (1, "x"), (2, 2)], {"type": "Polygon"}, 3):
        try:
            sunder.minkowski_sum(wrong, unit)
        except ValueError:
            pass
    try:
        sunder.least_translations([unit] * 2, [SQUARE] * 3)
    except ValueError:
        pass


def resident():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def watch_leaks(rounds):
    """Prints by how much Python's memory, its blocks and the resident memory grew in the second half of the rounds."""
    tracemalloc.start()
    for k in range(rounds):
        if k == rounds // 2:
            gc.collect()
            before = tracemalloc.get_traced_memory()[0], sys.getallocatedblocks(), resident()
        call_everything(k)
    gc.collect()
    print("grown", tracemalloc.get_traced_memory()[0] - before[0], sys.getallocatedblocks() - before[1],
          resident() - before[2])


def watch_counts(rounds):
    """Under a debug Python: prints by how many references the rounds grew. NumPy, if it is there, does not count."""
    sys.modules["numpy"] = None
    for k in range(60):
        call_everything(k)
    gc.collect()
    before = sys.gettotalrefcount()
    for k in range(rounds):
        call_everything(k)
    gc.collect()
    print("grown", sys.gettotalrefcount() - before)


class Leaks(unittest.TestCase):
    """Memory and references do not grow with the number of calls."""

    def worker(self, *command, **environment):
        done = subprocess.run([*command], capture_output=True, text=True, check=False,
                              env={**os.environ, **environment})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done

    def test_memory(self):
        """Ten thousand calls, twice: the second half leaves nothing. (Tables of Python itself grow a little.)"""
        rounds = 1000 * SCALE
        done = self.worker(sys.executable, __file__, "leaks", str(2 * rounds))
        traced, blocks, held = map(int, re.search(r"grown (-?\d+) (-?\d+) (-?\d+)", done.stdout).groups())
        print("grown by", traced, "bytes in", blocks, "blocks; resident:", held, "bytes")
        self.assertLess(blocks, rounds // 3)
        self.assertLess(traced, 2 ** 20)
        self.assertLess(held, 2 ** 21)

    def test_references(self):
        """The extension is compiled for the debug Python, which counts all references."""
        python, build = shutil.which("python3-dbg", path="/usr/bin"), os.environ["SUNDER_BUILD"]
        include = "/usr/include/python%d.%dd" % sys.version_info[:2]
        if not python or not os.path.exists(include + "/Python.h"):
            self.skipTest("python3-dbg and its headers are not installed")
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(os.path.join(build, "python", "sunder"), os.path.join(folder, "sunder"))
            for name in glob.glob(os.path.join(folder, "sunder", "_sunder*.so")):
                os.remove(name)
            gis = os.path.join(SOURCE, "gis")
            with open(os.path.join(gis, "python", "CMakeLists.txt"), encoding="utf-8") as file:
                listed = re.search(r"set\(python_shared (.*?)\)", file.read(), re.S).group(1)
            shared = re.findall(r"[a-z_/]+[.]c", listed)
            self.worker("cc", "-shared", "-fPIC", "-O1", "-D_XOPEN_SOURCE=700", "-std=c17", "-I" + include, "-I" + gis,
                        "-I" + os.path.join(SOURCE, "src"), *glob.glob(os.path.join(gis, "python", "*.c")),
                        *(os.path.join(gis, name) for name in shared), os.path.join(build, "src", "libsunder.a"),
                        "-lgmp", "-o", os.path.join(folder, "sunder", "_sunder.abi3.so"))
            done = self.worker(python, __file__, "counts", str(200 * SCALE),
                               PYTHONPATH=folder + ":" + os.path.dirname(os.path.abspath(__file__)))
        references = int(re.search(r"grown (-?\d+)", done.stdout).group(1))
        print("grown by", references, "references")
        self.assertLess(abs(references), 50 * SCALE)

    def test_valgrind(self):
        valgrind = shutil.which("valgrind")
        if not valgrind:
            self.skipTest("valgrind is not installed")
        with tempfile.NamedTemporaryFile() as log:
            self.worker(valgrind, "--leak-check=full", "--show-leak-kinds=definite", "--num-callers=30",
                        "--log-file=" + log.name, os.path.realpath(sys.executable), __file__, "calls", str(10 * SCALE),
                        PYTHONMALLOC="malloc")
            told = log.read().decode()
        self.assertIn("LEAK SUMMARY", told)
        self.assertEqual([one for one in re.split(r"==\d+== \n", told) if "_sunder" in one], [])


MODES = {"leaks": watch_leaks, "counts": watch_counts, "calls": lambda n: [call_everything(k) for k in range(n)]}

if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] in MODES:
        MODES[sys.argv[1]](int(sys.argv[2]))
    else:
        main()
