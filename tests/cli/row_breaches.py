"""Moves that break the rule of rows by a little, for before_breaches.py. The rows are those of rows_rule.py."""
from fractions import Fraction

import rows_rule as rule
from rules_layers import polygons_and_lines

LITTLE = Fraction(1, 1 << 20)  # the direction of a row is a unit vector in doubles: the rule is not known to the last unit
DECIDES = 80.0  # what lies farther from a feature, in units of the layer, does not decide on its neighbours in rows


def house_of(geometry, origin):
    polygons, _ = polygons_and_lines(geometry)
    return rule.House([[[(x - origin[0], y - origin[1]) for x, y in ring] for ring in rings] for rings in polygons])


def neighbours(town, fid):
    """(the other body, direction towards it, separation along it, a way across it that leads beside it) of each neighbour in a row of the
    body of the feature, if they stand apart along the row. Empty if this is undecided."""
    near = town.near(town.layer, fid, DECIDES)
    near = {f: town.geometry(f) for g in near for f in town.body(g)}
    if not all(town.valid(f) for f in near):
        return
    origin = near[fid].GetEnvelope()[::2]
    house = {f: house_of(g, origin) for f, g in near.items()}
    bodies = sorted({town.body(f) for f in near})
    lines = [[tuple(float(v - Fraction(o)) for v, o in zip(p, origin)) for p in e] for e in town.road_edges(fid, DECIDES)]
    own = bodies.index(town.body(fid))
    for row, _ in rule.tried(rule.rows_of, bodies, house, lines, float(town.gap)) or []:
        for edge in (e for _, e in row if own in (e.i, e.j)):
            axis, other = edge.towards(edge.other(own)), bodies[edge.other(own)]
            pair = [rule.Block([house[f] for f in body]) for body in (bodies[own], other)]
            along, across = ([rule.extent(block, a) for block in pair] for a in (axis, (-axis[1], axis[0])))
            if along[1][0] > along[0][1]:
                yield other, tuple(map(Fraction, axis)), Fraction(along[1][0] - along[0][1]), Fraction(across[1][1] - across[0][0])


def moves_beyond(town, fid):
    """(the other body, a move): with the other one at its old place, the move is a little farther along the row than the rule allows. If the
    two were too near, there is also one beside the other body, where they are no longer too near."""
    for other, (x, y), apart, beside in neighbours(town, fid):
        far = max(Fraction(0), apart - town.gap) + LITTLE
        yield other, (far * x, far * y)
        if apart < town.gap and any(town.are_too_near(f, g) for f in town.body(fid) for g in other):
            far, beside = apart - town.gap + LITTLE, beside + town.gap + 1
            yield other, (far * x - beside * y, far * y + beside * x)
