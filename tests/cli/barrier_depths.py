"""Features beside lines, points and areas, each pair far from the next: python3 barrier_depths.py SUNDER CASES SEED

The report of `check` on each pair is computed again by brute force in fractions (exact_plane.py): whether the two
meet, whether they are nearer than half the width plus the gap, their distance, and the length of the least
translation that separates them. Then features are shifted, and the pairs that `check --before` reports as worse are
computed again by its rule: it compares stored geometries, without width and gap; disjoint is better than meeting; a
feature that is inside an area before and after is not worse."""
import math
import os
import random
import subprocess
import sys
from fractions import Fraction

from osgeo import gdal, ogr

from exact_plane import Outline, distance_square, interiors_meet, least_square, lies_in

gdal.UseExceptions()
ogr.UseExceptions()
gdal.SetConfigOption("OGR_SQLITE_SYNCHRONOUS", "OFF")
APART = 1000  # distance between cases
GAP = Fraction(1, 2)
WIDTHS = (0, 1, 2, 3.5)
CLOSE = 1e-12  # relative tolerance of a length, which is rounded several times before it is printed
FIGURES = [  # outer ring, courtyard
    ([(0, 0), (8, 0), (8, 4), (0, 4)], []),
    ([(0, 0), (8, 0), (8, 4), (4, 4), (4, 8), (0, 8)], []),
    ([(0, 0), (12, 0), (12, 8), (8, 8), (8, 4), (4, 4), (4, 8), (0, 8)], []),
    ([(0, 4), (4, 0), (12, 6), (3, 10)], []),
    ([(0, 0), (12, 0), (12, 12), (0, 12)], [(4, 4), (4, 8), (8, 8), (8, 4)]),
]


def draw_barrier(rng):
    """Rings and lines on coordinates of the features, so that they run along walls, through corners and
    courtyards."""
    step = rng.choice((1, 4))

    def point():
        return step * rng.randint(-8 // step, 16 // step), step * rng.randint(-8 // step, 16 // step)
    if rng.random() < 0.25:
        x, y, w, h = rng.randint(-6, 10), rng.randint(-6, 10), rng.choice((1, 4, 6, 30)), rng.choice((1, 4, 6, 30))
        return [[(x, y), (x + w, y), (x + w, y + h), (x, y + h)]], []
    return [], [[point() for _ in range(rng.randint(1, 3))] for _ in range(rng.randint(1, 2))]


def draw(rng):
    ring, yard = rng.choice(FIGURES)
    return {"rings": [ring] + ([yard] if yard else []), "barrier": draw_barrier(rng), "width": rng.choice(WIDTHS),
            "by": (rng.randint(-3, 3), rng.randint(-3, 3))}


def text(chain, x, y, close=False):
    chain = chain + chain[:1] if close else chain
    return "(" + ",".join(f"{p[0] + x} {p[1] + y}" for p in chain) + ")"


def barrier_text(barrier, x):
    rings, lines = barrier
    if rings:
        return f"POLYGON({text(rings[0], x, 0, True)})"
    parts = [f"LINESTRING{text(c, x, 0)}" if len(c) > 1 else f"POINT{text(c, x, 0)}" for c in lines]
    return f"GEOMETRYCOLLECTION({','.join(parts)})"


def write(path, name, texts, widths=None):
    if os.path.exists(path):
        os.remove(path)
    source = ogr.GetDriverByName("GPKG").CreateDataSource(path)
    layer = source.CreateLayer(name, None, ogr.wkbUnknown)
    layer.CreateField(ogr.FieldDefn("w", ogr.OFTReal))
    layer.StartTransaction()
    for k, wkt in enumerate(texts):
        feature = ogr.Feature(layer.GetLayerDefn())
        feature.SetFID(k + 1)
        feature.SetField("w", widths[k] if widths else 0)
        feature.SetGeometryDirectly(ogr.CreateGeometryFromWkt(wkt))
        layer.CreateFeature(feature)
    layer.CommitTransaction()


def listed(words):
    """The lines of `check` about barriers: FID -> fields; the feature and the barrier of a pair have the same
    number."""
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode not in (0, 3):
        raise SystemExit(f"{' '.join(words)}: {done.stderr}")
    found = {}
    for line in done.stdout.splitlines():
        field = line.split("\t")
        if len(field) < 12 or not field[0].isdigit():
            continue
        if field[0] != field[5]:
            raise SystemExit(f"features and barriers of different cases: {line}")
        found.setdefault(int(field[0]), []).append(field)
    return found


def is_length(said, square):
    return abs(float(said) - math.sqrt(square)) <= CLOSE * math.sqrt(square)


class Judge:
    def __init__(self):
        self.trouble, self.met, self.near, self.free, self.worse, self.deep = [], 0, 0, 0, 0, 0

    def expect(self, k, what, said):
        if not what:
            self.trouble.append(f"case {k}: {said}")

    def stands(self, k, a, b, width, fields):
        """The pair as `check` should report it."""
        required = Fraction(width) / 2 + GAP
        kinds = [f[6] for f in fields]
        if interiors_meet(a, b):
            self.met += 1
            if kinds != ["barrier"]:
                self.expect(k, False, f"met, and listed as {kinds}")
                return
            least = least_square(a, b)
            self.deep += least is not None
            self.expect(k, least is None or is_length(fields[0][10], least), f"depth {fields[0][10]}, {least}")
            self.expect(k, float(fields[0][12]) == float(fields[0][11]) + float(fields[0][10]), "missing is not required + depth")
        elif distance_square(a, b) < required * required:
            self.near += 1
            drawn = distance_square(a, b) < Fraction(width) ** 2 / 4
            if kinds != ["barrier_drawn" if drawn else "barrier_near"]:
                self.expect(k, False, f"near, and listed as {kinds}")
                return
            square = distance_square(a, b)
            self.expect(k, is_length(fields[0][8], square), f"distance {fields[0][8]}, {square}")
            self.expect(k, float(fields[0][12]) == float(fields[0][11]) - float(fields[0][8]), "missing is not required - distance")
        else:
            self.free += 1
            self.expect(k, not kinds, f"free, and listed as {kinds}")

    def moved(self, k, was, now, b, width, fields):
        """The conflicts that are worse than at the start."""
        required = Fraction(width) / 2 + GAP
        then, met = interiors_meet(was, b), interiors_meet(now, b)
        if not met and distance_square(now, b) >= required * required:
            worse = False
        elif b.area and lies_in(was, b) and lies_in(now, b):
            worse = False
        elif then != met:
            worse = met
        elif met:
            before, after = least_square(was, b), least_square(now, b)
            if before is None or after is None:
                return
            worse = after > before
        else:
            worse = distance_square(now, b) < distance_square(was, b)
        self.worse += worse
        said = "worse" in [f[6] for f in fields]
        self.expect(k, said == worse, f"said worse: {said}, is: {worse}")


def main():
    sunder, cases, seed = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    print(f"SUNDER_SEED={seed}, {cases} cases")
    rng = random.Random(seed)
    case = [draw(rng) for _ in range(cases)]
    features = [[f"POLYGON({','.join(text(r, APART * k + x, y, True) for r in c['rings'])})" for k, c in enumerate(case)
                 for x, y in [c["by"] if moved else (0, 0)]] for moved in (False, True)]
    write("was.gpkg", "l", features[0])
    write("now.gpkg", "l", features[1])
    write("b.gpkg", "b", [barrier_text(c["barrier"], APART * k) for k, c in enumerate(case)], [c["width"] for c in case])
    words = ["-q", "--gap", "0", "--no-blocks", "--barrier", f"b.gpkg,width-field=w,gap={float(GAP)}"]
    stands = listed([sunder, "check", "was.gpkg", *words])
    moved = listed([sunder, "check", "now.gpkg", "--before", "was.gpkg", *words])
    judge = Judge()
    for k, c in enumerate(case):
        a, b = Outline(c["rings"]), Outline(c["barrier"][0], c["barrier"][1])
        judge.stands(k, a, b, c["width"], stands.get(k + 1, []))
        judge.moved(k, a, a.moved(*c["by"]), b, c["width"], moved.get(k + 1, []))
    print(f"{judge.met} met, {judge.deep} of them with their least translation; {judge.near} near, {judge.free} free; "
          f"{judge.worse} worse")
    for line in judge.trouble[:20]:
        print("WRONG:", line)
    sys.exit(1 if judge.trouble or not min(judge.deep, judge.near, judge.free, judge.worse) else 0)


if __name__ == "__main__":
    main()
