"""Moves of several bodies that satisfy linear constraints: proposed in doubles by projections, decided in fractions.

A constraint (a side) is (terms, d): the sum of x t_x + y t_y over its terms (body, x, y) is at least d.
"""
import math
from fractions import Fraction

SWEEPS, ROUNDS, HAIR = 40, 8, 1e-9


def cheapest(weights, shifts, sides, bound, springs=(), prices=()):
    """Are there moves that satisfy all constraints and cost less than `bound`? The cost is the sum of w |t - a|^2, and of
    stiff v^2 over springs (terms, stiff), where v is what the sum over the terms is less than 0. Prices are ((linear, square),
    constraints with a share): they cost linear s + square s^2, where share times s is enough for each of these. A body
    without a weight is fixed."""
    every = [*sides, *((terms, 0) for terms, _ in springs)]
    floats = [([(k, float(x), float(y)) for k, x, y in terms if weights[k] is not None], float(d)) for terms, d in every]
    give = [0.0] * len(sides) + [0.5 / float(stiff) if stiff > 1e-300 else 1e300 for _, stiff in springs]
    w = [0.0 if v is None else float(v) for v in weights]
    a = [[float(v) for v in s] for s in shifts]
    active, forces = list(range(len(sides), len(every))), [0.0] * len(springs)
    t = [list(s) for s in a]
    for _ in range(ROUNDS + len(sides)):
        worst = max(range(len(sides)), key=lambda k: missing(floats[k], t), default=None)
        if worst is None or missing(floats[worst], t) <= 0 or worst in active:
            break
        active.append(worst)
        forces.append(0.0)
        for _ in range(SWEEPS):
            for m, k in enumerate(active):
                terms, d = floats[k]
                ease = sum((x * x + y * y) / (2 * w[b]) for b, x, y in terms) + give[k]
                step = max((missing(floats[k], t) - forces[m] * give[k]) / ease if ease else 0.0, -forces[m])
                forces[m] += step
                for b, x, y in terms:
                    t[b][0] += step * x / (2 * w[b])
                    t[b][1] += step * y / (2 * w[b])
    if not all(math.isfinite(v) for p in t for v in p):
        return False
    exact = [tuple(map(Fraction, p)) for p in t]
    cost = sum(v * ((p[0] - s[0]) ** 2 + (p[1] - s[1]) ** 2) for v, p, s in zip(weights, exact, shifts) if v is not None)
    cost += sum(Fraction(stiff) * min(Fraction(0), sum(Fraction(x) * exact[b][0] + Fraction(y) * exact[b][1] for b, x, y in terms)) ** 2
                for terms, stiff in springs)
    for (linear, square), asked in prices:
        s = max([(Fraction(d) - sum(Fraction(x) * exact[b][0] + Fraction(y) * exact[b][1] for b, x, y in terms)) / Fraction(share)
                 for terms, d, share in asked], default=Fraction(0))
        cost += max(Fraction(0), s) * (linear + square * max(Fraction(0), s))
    return cost < bound and keep_all(sides, dict(enumerate(exact)))


def missing(side, t):
    """The amount that is missing to the double of d, plus a small margin."""
    terms, d = side
    return d + HAIR * (abs(d) + 1e-3) - sum(x * t[b][0] + y * t[b][1] for b, x, y in terms)


def meeting(sides, limit):
    """Are there moves within the limits (by body; None: unlimited) that satisfy all constraints?"""
    t = {body: [0.0, 0.0] for terms, _ in sides for body, _, _ in terms}
    floats = [([(b, float(x), float(y)) for b, x, y in terms], float(d)) for terms, d in sides]
    most = {body: limit(body) for body in t}
    for _ in range(2 * SWEEPS):
        moved = False
        for terms, d in floats:
            lacks = missing((terms, d), t)
            ease = sum(x * x + y * y for b, x, y in terms if most[b] != 0)
            if lacks > 0 and ease:
                moved = True
                for b, x, y in terms:
                    if most[b] != 0:
                        t[b][0] += 1.2 * lacks * x / ease
                        t[b][1] += 1.2 * lacks * y / ease
        for b, p in t.items():
            size = (p[0] ** 2 + p[1] ** 2) ** 0.5
            if most[b] is not None and size > most[b] * (1 - HAIR):
                p[0], p[1] = (v / size * most[b] * (1 - 2 * HAIR) for v in p)
        if not moved:
            break
    if not all(math.isfinite(v) for p in t.values() for v in p):
        return False
    exact = {b: tuple(map(Fraction, p)) for b, p in t.items()}
    if any(most[b] is not None and p[0] ** 2 + p[1] ** 2 > Fraction(most[b]) ** 2 for b, p in exact.items()):
        return False
    return keep_all(sides, exact)


def keep_all(sides, moves):
    return all(sum(Fraction(x) * moves[b][0] + Fraction(y) * moves[b][1] for b, x, y in terms) >= Fraction(d) for terms, d in sides)
