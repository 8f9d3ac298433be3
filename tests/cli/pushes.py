"""Are the forces in LAYER_pushes in equilibrium? python3 pushes.py RESULT.gpkg LAYER SHARE

For each block (or single feature) that no limit and no conflict restrains, the forces add up to twice its weight (one
per member) times its move. This has to hold for at least SHARE of the moved blocks, up to a ten-thousandth of the
greatest force, since a result is optimal up to a millionth of its cost. Directions have length 1, and forces are
positive."""
import collections
import math
import sqlite3
import sys

path, layer, share = sys.argv[1], sys.argv[2], float(sys.argv[3])
base = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
block, members, move = {}, collections.Counter(), {}
for fid, number, dx, dy, status in base.execute(f'SELECT fid, sunder_blk, sunder_dx, sunder_dy, sunder_st FROM "{layer}"'):
    block[fid] = fid if number is None else number
    members[block[fid]] += 1
    move[block[fid]] = None if status in ("fixed", "blocked") or block[fid] in move and move[block[fid]] is None else (dx, dy)
pushed = collections.defaultdict(lambda: [0.0, 0.0])
greatest, rows = 0.0, 0
for a, b, force, nx, ny in base.execute(f'SELECT fid_a, fid_b, force, nx, ny FROM "{layer}_pushes"'):
    rows += 1
    greatest = max(greatest, force)
    if not force > 0 or abs(math.hypot(nx, ny) - 1) > 1e-12:
        raise SystemExit(f"{a}, {b}: a force of {force} along {nx}, {ny}")
    for fid, sign in ((a, -1), (b, 1)):
        if fid is not None:
            pushed[block[fid]][0] += sign * force * nx
            pushed[block[fid]][1] += sign * force * ny
held = right = 0
for name, t in move.items():
    if t is None or t == (0.0, 0.0):
        continue
    held += 1
    g = pushed[name]
    right += max(abs(g[k] - 2 * members[name] * t[k]) for k in (0, 1)) <= 1e-4 * greatest
print(f"{rows} pushes; {right} of {held} that moved are held by them")
sys.exit(held == 0 or right < share * held)
