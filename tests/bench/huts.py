"""Houses of an informal settlement, one WKT per line: rectangles at all angles that overlap and are near each other,
with corners on a grid of 1/16. Half of their total area is the area of the square in which they stand.

  huts.py COUNT [SEED]"""
import math
import random
import sys

count = int(sys.argv[1])
random.seed(int(sys.argv[2]) if len(sys.argv) > 2 else 1)
side = 19.4 * math.sqrt(count)
for _ in range(count):
    x, y, angle = random.uniform(0, side), random.uniform(0, side), random.uniform(0, math.pi)
    w, h = random.uniform(6, 18) / 2, random.uniform(5, 14) / 2
    c, s = math.cos(angle), math.sin(angle)
    corners = [(x + u * c - v * s, y + u * s + v * c) for u, v in ((-w, -h), (w, -h), (w, h), (-w, h), (-w, -h))]
    print("POLYGON ((%s))" % ", ".join("%r %r" % tuple(round(z * 16) / 16 for z in corner) for corner in corners))
