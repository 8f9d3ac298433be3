"""Barriers with broken geometry, as other programs write it: rings that are not closed, rings and lines of one to
three vertices, empty members, coordinates that are not numbers. Each stands near two houses, or around them with no
vertex within reach, as a polygon, as a member, as a hole, or within a collection. Cases are 10 km apart.

    broken_barriers.py       writes houses.csv, and as copies of empty.gpkg
        open.gpkg            barriers with open rings, equivalent to the valid ones in closed.gpkg
        one_K.gpkg           single ones of these, drawn by SUNDER_SEED, and closed_K.gpkg
        short.gpkg           rings that enclose nothing, at most ten
        nan_K.gpkg           single ones with a coordinate that is not a number, drawn by SUNDER_SEED
"""
import os
import random
import shutil
import sqlite3
import struct

NAN = float("nan")


def points(list_of):
    return struct.pack("<I", len(list_of)) + b"".join(struct.pack("<dd", *p) for p in list_of)


def polygon(*rings):
    return struct.pack("<BII", 1, 3, len(rings)) + b"".join(points(ring) for ring in rings)


def line(list_of):
    return struct.pack("<BI", 1, 2) + points(list_of)


def many(kind, *members):
    return struct.pack("<BII", 1, kind, len(members)) + b"".join(members)


def square(r, x, half):
    x, y = x + r.randint(-3, 3), r.randint(-3, 3)
    ring = [(x - half, y - half), (x + half, y - half), (x + half, y + half), (x - half, y + half)]
    if r.random() < 0.5:
        ring.reverse()
    k = r.randint(0, 3)
    return ring[k:] + ring[:k]


def forms(r, x, half):
    """For each form a function that makes a geometry of an open ring; and that ring."""
    far = [(x + 5000, 5000), (x + 5010, 5000), (x + 5000, 5010), (x + 5000, 5000)]
    outer = square(r, x, 4 * half)
    return [polygon,
            lambda ring: many(6, polygon(far), polygon(ring)),
            lambda ring: polygon(outer + outer[:1], ring),
            lambda ring: many(7, polygon(ring), line(far))], square(r, x, half)


def broken_rings(ring):
    """The same ring, closed, with a coordinate that is not a number in one vertex."""
    for k, (x, y) in enumerate(ring):
        at = ring[:k] + [(x, NAN) if k % 2 else (NAN, y)] + ring[k + 1:]
        yield at + at[:1]


def cases(r):
    """Lists of barriers: broken rings and the valid equivalents, short rings, and rings with coordinates that are not
    finite; each entry with its x."""
    broken, sound, short, nans, x = [], [], [], [], 0
    for half in (6, 900):
        for form in range(4):
            for n in (4, 3):
                made, ring = forms(r, x, half)
                broken.append(made[form](ring[:n]))
                sound.append(made[form](ring[:n] + ring[:1]))
                x += 10000
            made, ring = forms(r, 0, half)
            short.extend(made[form](at) for at in (ring[:1], ring[:2], [ring[0], ring[2], ring[0]]))
            nans.extend(made[form](at) for at in broken_rings(ring))
        ring = square(r, x, half)
        broken.append(many(6, polygon(), polygon(ring)))
        sound.append(polygon(ring + ring[:1]))
        ring = square(r, x + 10000, half)
        broken.append(many(6, polygon([]), polygon(ring + ring[:1])))
        sound.append(polygon(ring + ring[:1]))
        ring = square(r, x + 20000, half)
        broken.append(many(5, line([]), line(ring[:1]), line(ring[1:3])))
        sound.append(many(5, line(ring[:1] * 2), line(ring[1:3])))
        nans.append(line(ring[:2] + [(x + 20000, NAN)]))
        nans.append(line([(NAN, 5), ring[0]]))
        x += 30000
    return broken, sound, short, nans


def write(name, geometries):
    shutil.copy("empty.gpkg", name + ".gpkg")
    base = sqlite3.connect(name + ".gpkg")
    head = b"GP\0\1" + struct.pack("<i", 25832)
    base.executemany("INSERT INTO b(geom) VALUES (?)", [(head + geometry,) for geometry in geometries])
    base.commit()


def main():
    r = random.Random(int(os.environ.get("SUNDER_SEED", "1")))
    broken, sound, short, nans = cases(r)
    with open("houses.csv", "w", encoding="ascii") as f:
        print("id,WKT", file=f)
        for k in range(len(broken)):
            for x, y in ((10000 * k, 3), (10000 * k + 40, 20)):
                print(f'{k},"POLYGON(({x} {y},{x + 10} {y},{x + 10} {y + 10},{x} {y + 10},{x} {y}))"', file=f)
    write("open", broken)
    write("closed", sound)
    for k, one in enumerate(r.sample(range(len(broken)), 2)):
        write(f"one_{k}", [broken[one]])
        write(f"closed_{k}", [sound[one]])
    write("short", r.sample(short, 10))
    for k, one in enumerate(r.sample(nans, 2)):
        write(f"nan_{k}", [one])


main()
