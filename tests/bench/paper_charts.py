"""paper_charts.py FOLDER: bar charts (figure-5.svg, figure-6.svg, figure-7.svg, by gnuplot) and tables.md from the runs of paper.sh."""
import csv
import math
import os
import subprocess
import sys

BASE = os.environ.get("SUNDER_PAPER_BASE", "angle-bisector")
ROADS = ("convolution", "arrangement", "incremental", "divide")
DECOMPOSITIONS = ("angle-bisector", "vertical", "triangulation", "hertel-mehlhorn", "optimal", "mixed")
COLOURS = ("#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377", "#bbbbbb", "#222222")


def read(file):
    with open(file, newline="") as lines:
        return list(csv.DictReader(lines))


def pick(runs, **wanted):
    """The runs that succeeded and have these values."""
    return [r for r in runs if r["status"] == "ok" and all(r[k] == v for k, v in wanted.items())]


def counted_in(run, column):
    """A number of a run. Operations are those of the union if the algorithm has phases, otherwise all."""
    text = run.get("union_" + column) or run[column]
    return float(text) if text else None


def value(runs, column, **wanted):
    found = pick(runs, **wanted)
    return counted_in(found[0], column) if found else None


def ordered(runs, column):
    return list(dict.fromkeys(r[column] for r in runs))


def kind(algorithm, order, decomposition=BASE):
    if algorithm == "convolution":
        return {"algorithm": algorithm}
    return {"algorithm": algorithm, "order": order, "decomposition": decomposition}


def bars(folder, name, title, what, families, series):
    """A group of bars per family, a bar per series; `series` is a list of (label, function from family to number or
    None)."""
    series = [(label, f) for label, f in series if any(f(family) for family in families)]
    families = [f for f in families if any(of(f) for _, of in series)]
    if not series or not families:
        return False
    data = os.path.join(folder, name + ".dat")
    with open(data, "w") as out:
        for family in families:
            cells = [f(family) for _, f in series]
            print(f'"{family}"', *("NaN" if c is None else f"{c:.9g}" for c in cells), file=out)
    plots = ", ".join(f'"{data}" using {i + 2}:xtic(1) title "{label}" lc rgb "{COLOURS[i % len(COLOURS)]}"'
                      for i, (label, _) in enumerate(series))
    script = f"""set terminal svg size 980,430 font "sans,12" background rgb "white"
set output "{os.path.join(folder, name + '.svg')}"
set title "{title}"
set ylabel "{what}"
set logscale y
set format y "10^{{%L}}"
set style data histograms
set style histogram clustered gap 1.5
set style fill solid 0.9 noborder
set boxwidth 0.95
set key outside right top vertical
set grid ytics lc rgb "#dddddd"
set xtics rotate by -20 scale 0
plot {plots}
"""
    subprocess.run(["gnuplot"], input=script, text=True, check=True)
    os.remove(data)
    return True


def largest_common(runs, families, kinds):
    """The largest size at which most kinds of run have ended on most families."""
    def done(size):
        return sum(1 for f in families for k in kinds if pick(runs, family=f, size=size, **k))
    sizes = sorted(ordered(runs, "size"), key=int)
    best = max((done(s) for s in sizes), default=0)
    return max((s for s in sizes if done(s) >= 0.9 * best), key=int)


def charts(runs, folder):
    families = ordered(runs, "family")
    plain = [f for f in families if f not in ("covered-fork", "fat-grid", "fat-cover")]
    roads = [("convolution", "")] + [(a, "random") for a in ROADS[1:]] + [("incremental", "fat")]
    size = largest_common(runs, plain, [kind(*r) for r in roads])
    bars(folder, "figure-5", f"Roads to the sum, n = {size}, decomposition {BASE}", "seconds", plain,
         [(f"{a} {o}".strip(), lambda f, a=a, o=o: value(runs, "seconds", family=f, size=size, **kind(a, o))) for a, o in roads])
    incremental = [kind("incremental", "random", d) for d in DECOMPOSITIONS]
    size = largest_common(runs, families, incremental)
    bars(folder, "figure-6", f"Decompositions, incremental road, random order, n = {size}", "seconds", families,
         [(d, lambda f, k=k: value(runs, "seconds", family=f, size=size, **k)) for d, k in zip(DECOMPOSITIONS, incremental)])
    special = [f for f in families if f not in plain]
    both = [(a, o) for a in ("incremental", "divide", "arrangement") for o in ("random", "fat")]
    size = largest_common(runs, special, [kind(*b) for b in both]) if special else "0"

    def tests(family, a, o):
        return value(runs, "orientation_tests", family=family, size=size, **kind(a, o))
    bars(folder, "figure-7", f"Orders of insertion, n = {size}, decomposition {BASE}", "orientation tests", special,
         [(f"{a} {o}", lambda f, a=a, o=o: tests(f, a, o)) for a, o in both])


def exponent(points):
    """Slope of the least-squares line through (log n, log v); None below two points."""
    points = [(math.log(n), math.log(v)) for n, v in points if n > 0 and v > 0]
    if len(points) < 2:
        return None
    x, y = (sum(c) / len(points) for c in zip(*points))
    spread = sum((a - x) ** 2 for a, _ in points)
    return sum((a - x) * (b - y) for a, b in points) / spread if spread else None


def all_roads():
    return [("convolution", "")] + [(a, o) for a in ROADS[1:] for o in ("random", "fat")]


def table(out, title, heads, rows):
    print(title + "\n", file=out)
    for cells in (heads, ["---"] * len(heads), *rows):
        print("|", " | ".join(cells), "|", file=out)
    print(file=out)


def number(v, digits=3):
    return "-" if v is None or v == "" else f"{float(v):.{digits}g}"


def growth(runs):
    columns = ("vertices", "segment_intersections", "orientation_tests", "comparisons", "seconds", "peak_rss_bytes")
    for family in ordered(runs, "family"):
        for road in all_roads():
            found = [r for r in pick(runs, family=family, **kind(*road)) if int(r["size"]) >= 20]
            if len(found) > 1:
                slopes = [exponent([(float(r["p_vertices"]), counted_in(r, c) or 0) for r in found]) for c in columns]
                cells = ["-" if s is None else f"{s:.1f}" for s in slopes]
                yield [family, " ".join(road).strip(), f'{found[0]["size"]}-{found[-1]["size"]}', *cells]


def largest(runs, family, road):
    found = pick(runs, family=family, **kind(*road))
    return max(found, key=lambda r: int(r["size"])) if found else None


def phases(runs):
    for family in ordered(runs, "family"):
        for road in all_roads():
            r = largest(runs, family, road)
            if r:
                yield [family, " ".join(road).strip(), r["size"], r["vertices"], r["holes"],
                       *(number(r["seconds" + s]) for s in ("", "_decompose", "_subsums", "_union")),
                       number(float(r["peak_rss_bytes"]) / 2**20),
                       *(f"{counted_in(r, c):.0f}" for c in ("segment_intersections", "comparisons", "orientation_tests", "exact_fallbacks"))]


def orders(runs):
    """The cost of the fat order, as a ratio to that of the random order."""
    for family in ordered(runs, "family"):
        for road in ROADS[1:]:
            for size in ordered(runs, "size"):
                pair = [pick(runs, family=family, size=size, **kind(road, o)) for o in ("random", "fat")]
                if all(pair) and int(size) >= 20:
                    ratios = [counted_in(pair[1][0], c) / (counted_in(pair[0][0], c) or 1)
                              for c in ("segment_intersections", "orientation_tests", "seconds")]
                    yield [family, road, size, *(f"{r:.2f}" for r in ratios)]


def decompositions(runs):
    for family in ordered(runs, "family"):
        for road in ROADS[1:]:
            sizes = [r["size"] for r in pick(runs, family=family, algorithm=road, order="random") if r["decomposition"] != BASE]
            if sizes:
                size = max(sizes, key=int)
                found = [pick(runs, family=family, size=size, **kind(road, "random", d)) for d in DECOMPOSITIONS]
                yield [family, road, size, *(f'{number(f[0]["seconds_decompose"], 2)} / {number(f[0]["seconds"], 2)}' if f else "-"
                                             for f in found)]


def pieces(counted):
    """Pieces of P x pieces of Q, sides of all subsums, microseconds to decompose, at the largest size of each family."""
    for family in ordered(counted, "family"):
        size = max((r["size"] for r in counted if r["family"] == family), key=int)
        cells = []
        for d in DECOMPOSITIONS:
            r = next((r for r in counted if (r["family"], r["size"], r["decomposition"]) == (family, size, d)), None)
            used = "" if not r or r["used"] == d else f' ({r["used"]})'
            cells.append(f'{r["pieces_p"]} x {r["pieces_q"]}, {r["sides"]}, {1e6 * float(r["seconds_decompose"]):.0f}{used}' if r else "-")
        yield [family, size, *cells]


MEASURES = ("random", "given", "area", "breadth", "round")


def measures(ordering):
    """Crossings / comparisons and orientation tests of the incremental union, by order of insertion."""
    for family in ordered(ordering, "family"):
        for size in ordered(ordering, "size"):
            of = {r["order"]: r for r in ordering if (r["family"], r["size"]) == (family, size)}
            if len(of) == len(MEASURES) and int(size) >= 20:
                cells = (f'{of[m]["segment_intersections"]} / {int(of[m]["comparisons"]) + int(of[m]["orientation_tests"])}'
                         for m in MEASURES)
                yield [family, size, of["random"]["subsums"], of["random"]["edges"], *cells]


def tables(runs, counted, ordering, folder):
    with open(os.path.join(folder, "tables.md"), "w") as out:
        table(out, "Exponents in n (vertices of P): least squares in logarithms over the sizes from 20 on. Operations are those of the "
              "union.",
              ["family", "road", "sizes", "output", "crossings", "orientation tests", "comparisons", "seconds", "memory"], growth(runs))
        table(out, f"The largest input that each road finished, decomposition {BASE}.",
              ["family", "road", "n", "vertices", "holes", "seconds", "decompose", "subsums", "union", "MiB", "crossings",
               "comparisons", "orientation tests", "left open by the filter"], phases(runs))
        table(out, "The order by fatness: its cost in parts of that of the random order.",
              ["family", "road", "n", "crossings", "orientation tests", "seconds"], orders(runs))
        table(out, "Orders of the incremental union: crossings / comparisons and orientation tests (area, breadth = area by perimeter, "
              "round = area by its square: measures of fatness, largest first).",
              ["family", "n", "subsums", "edges out", *MEASURES], measures(ordering))
        table(out, "What the decompositions make: pieces of P x pieces of Q, sides of all subsums, microseconds to decompose both.",
              ["family", "n", *DECOMPOSITIONS], pieces(counted))
        table(out, "Decompositions: seconds to decompose / in all, random order.", ["family", "road", "n", *DECOMPOSITIONS],
              decompositions(runs))


def main():
    folder = sys.argv[1]
    runs, counted, ordering = (read(os.path.join(folder, name + ".csv")) for name in ("paper", "pieces", "orders"))
    charts(runs, folder)
    tables(runs, counted, ordering, folder)


main()
