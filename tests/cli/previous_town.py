"""A small town for the test of --previous, the same town a month later, and what may have changed between two results.

    previous_town.py make NOW.csv NEXT.csv     houses in rows; one in ten is gone, moved, cut at a corner or new in NEXT
    previous_town.py odd ODD.csv EDITED.csv    the same with holes and parts, at coordinates of many digits; in EDITED one
                                               coordinate is the next double
    previous_town.py compare NOW.gpkg NEXT.gpkg RESULT_NOW.gpkg RESULT_NEXT.gpkg REACH
                                               prints: unchanged houses; how many of them moved otherwise; how many of
                                               these are in no chain of houses within REACH that has a changed one
"""
import math
import random
import sqlite3
import struct
import sys


def make(now, then):
    rng = random.Random(11)
    houses = []
    for row in range(12):
        x = 300 * (row % 3)
        for _ in range(10):
            w, h, y = rng.randint(16, 28) / 2, rng.randint(16, 24) / 2, 60 * (row // 3) + rng.randint(-8, 8) / 8
            houses.append((len(houses) + 1, x, y, w, h))
            x += w + (rng.randint(0, 12) / 4 if rng.random() < 0.4 else rng.randint(12, 60) / 4)
    later = []
    for k, (key, x, y, w, h) in enumerate(houses):
        if k % 40 == 13:
            continue
        later.append((key, x + 1.5, y - 0.5, w, h) if k % 40 == 26 else (key, x, y, w, h))
    later += [(1000 + k, houses[k][1] + 4, houses[k][2] + 5, 5.5, 6) for k in (35, 75)]
    rng.shuffle(later)  # so FIDs differ
    corner = {houses[k][0] for k in range(0, len(houses), 40)}  # they keep their boxes
    for path, town in ((now, houses), (then, later)):
        with open(path, "w") as out:
            out.write("id,WKT\n")
            for key, x, y, w, h in town:
                cut = 2 if town is later and key in corner else 0
                ring = [(x, y), (x + w, y), (x + w, y + h - cut), (x + w - cut, y + h), (x, y + h), (x, y)]
                out.write('%d,"POLYGON((%s))"\n' % (key, ",".join("%r %r" % v for v in ring[:3] + ring[3 + (not cut):])))


def odd(path, edited):
    rng = random.Random(12)
    for name, nudged in ((path, None), (edited, 17)):
        rng.seed(12)
        with open(name, "w") as out:
            out.write("id,WKT\n")
            for k in range(40):
                x, y = 32500000.1 + 13.7 * (k % 8) + rng.random(), 5300000.3 + 12.9 * (k // 8) + rng.random()
                parts = []
                for u in (x, x + 6) if k % 3 == 0 else (x,):
                    w, h = 5 + rng.random(), 10 + 2 * rng.random()
                    top = math.nextafter(y + h, math.inf) if k == nudged else y + h
                    parts.append([[(u, y), (u + w, y), (u + w, top), (u, y + h), (u, y)]])
                    if k % 2:
                        parts[-1].append([(u + 1, y + 1), (u + 1, y + 2), (u + 2, y + 3), (u + 1, y + 1)])
                text = ",".join("(%s)" % ",".join("(%s)" % ",".join("%r %r" % v for v in ring) for ring in p) for p in parts)
                out.write('%d,"MULTIPOLYGON(%s)"\n' % (k + 1, text))


def read(path, columns):
    with sqlite3.connect(path) as db:
        return {row[0]: row[1:] for row in db.execute("SELECT id, %s FROM town" % columns)}


def compare(now, then, result, next_result, reach):
    before, after = read(now, "geom"), read(then, "geom")
    was, now = (read(path, "geom, sunder_dx, sunder_dy") for path in (result, next_result))
    box = [{key: struct.unpack("<4d", row[0][8:40]) for key, row in layer.items()} for layer in (was, now)]
    changed = {key for key in set(before) | set(after) if before.get(key) != after.get(key)}
    same = set(after) - changed
    moved = {key for key in same if was[key] != now[key]}
    group, todo = set(changed), list(changed)
    while todo:
        key = todo.pop()
        own = [b[key] for b in box if key in b]
        for other in (set(was) | set(now)) - group:
            if any(e[0] - reach <= f[1] and f[0] <= e[1] + reach and e[2] - reach <= f[3] and f[2] <= e[3] + reach
                   for e in own for f in (b[other] for b in box if other in b)):
                group.add(other)
                todo.append(other)
    print(len(same), len(moved), len(moved - group))


if sys.argv[1] == "make":
    make(*sys.argv[2:])
elif sys.argv[1] == "odd":
    odd(*sys.argv[2:])
else:
    compare(*sys.argv[2:6], float(sys.argv[6]))
