"""A small town for the test of --previous, the same town a month later, and what may have changed between two results.

    previous_town.py make NOW.csv NEXT.csv     houses in rows; one in a dozen is gone, moved or new in NEXT
    previous_town.py compare NOW.gpkg NEXT.gpkg RESULT_NOW.gpkg RESULT_NEXT.gpkg REACH
                                               prints: unchanged houses; how many of them moved otherwise; how many of
                                               these are in no chain of houses within REACH that has a changed one
"""
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
    for path, town in ((now, houses), (then, later)):
        with open(path, "w") as out:
            out.write("id,WKT\n")
            for key, x, y, w, h in town:
                out.write('%d,"POLYGON((%r %r,%r %r,%r %r,%r %r,%r %r))"\n' % (key, x, y, x + w, y, x + w, y + h, x, y + h, x, y))


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
else:
    compare(*sys.argv[2:6], float(sys.argv[6]))
