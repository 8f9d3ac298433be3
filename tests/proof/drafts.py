"""Building blocks for the cases of false_proofs.py: layers of few features, written without GDAL, and the lines of a
proof about them.

A layer is {FID: feature}; a feature has `polygons` (lists of rings), perhaps `lines`, and attributes.
"""
import os
import sqlite3
import struct

METRES = 'PROJCS["x",GEOGCS["x"],PROJECTION["Transverse_Mercator"],UNIT["metre",1]]'


# ---- Layers

def ring(*corners):
    return {"polygons": [[list(corners)]]}


def box(x0, y0, x1, y1, **attributes):
    return {**ring((x0, y0), (x1, y0), (x1, y1), (x0, y1)), **attributes}


def line(*corners):
    return {"lines": [list(corners)]}


def shifted(feature, x, y):
    def chain(places):
        return [(a + x, b + y) for a, b in places]
    return {**feature, "polygons": [[chain(r) for r in p] for p in feature.get("polygons", ())],
            "lines": [chain(c) for c in feature.get("lines", ())]}


def blob(feature):
    """The geometry of a GeoPackage: a collection of its polygons and lines."""
    def chain(places):
        return struct.pack("<I", len(places)) + b"".join(struct.pack("<2d", *p) for p in places)
    parts = [struct.pack("<BII", 1, 3, len(rings)) + b"".join(chain([*r, r[0]]) for r in rings) for rings in feature.get("polygons", ())]
    parts += [struct.pack("<BI", 1, 2) + chain(places) for places in feature.get("lines", ())]
    return b"GP" + struct.pack("<BBi", 0, 1, 1) + struct.pack("<BII", 1, 7, len(parts)) + b"".join(parts)


def write_layer(path, name, features):
    if os.path.exists(path):
        os.remove(path)
    columns = sorted({key for f in features.values() for key in f} - {"polygons", "lines"})
    base = sqlite3.connect(path)
    base.execute("CREATE TABLE gpkg_spatial_ref_sys (srs_id, organization, organization_coordsys_id, definition)")
    base.execute("INSERT INTO gpkg_spatial_ref_sys VALUES (1, 'EPSG', 25832, ?)", (METRES,))
    base.execute("CREATE TABLE gpkg_geometry_columns (table_name, column_name, srs_id)")
    base.execute("INSERT INTO gpkg_geometry_columns VALUES (?, 'geom', 1)", (name,))
    base.execute(f"CREATE TABLE {name} ({', '.join(['fid INTEGER PRIMARY KEY', 'geom', *columns])})")
    for fid, feature in features.items():
        values = [fid, blob(feature), *map(feature.get, columns)]
        base.execute(f"INSERT INTO {name} VALUES ({', '.join('?' * len(values))})", values)
    base.commit()
    base.close()


# ---- Lines

def proof(problem, conflicts=(), trees=(), bound=None):
    options = problem.options
    bound = sum(t["bound"] for t in trees) if bound is None else bound
    head = {"sunder_proof": 2, "layer": problem.name, "gap": options.gap, "max_shift": options.max_shift, "contained": options.contained,
            "allow_jumps": options.allow_jumps, **({"row_stiffness": options.row_stiffness} if options.row_stiffness else {}),
            **({"least_gap": options.least_gap} if options.least_gap is not None else {}),
            **({"ease": options.ease} if options.ease else {}), "lower_bound": bound, "conflicts": len(conflicts), "trees": len(trees)}
    blocks = [{"block": list(fids)} for fids in dict.fromkeys(problem.blocks.of.values())]
    return [head, *blocks, *({"conflict": k, **c} for k, c in enumerate(conflicts)), *({"group": k, **t} for k, t in enumerate(trees))]


def conflict(a, b, reason="unresolved", kind="overlap", blocked_by=(), **more):
    return {"a": a, "b": b, "kind": kind, "reason": reason, "blocked_by": list(blocked_by), **more}


def body(problem, key, **more):
    """A body: the block of one of its members, or a barrier."""
    if isinstance(key, str):
        return {"barrier": key, "weight": None, "shift": [0, 0], **more}
    members = problem.block(key)
    told = [{"fid": f, "weight": problem.weight(f), "max_shift": problem.own_limit(f)} for f in members]
    weight = None if problem.body_limit(members) == 0 else sum(f["weight"] for f in told)
    return {"features": told, "weight": weight, "shift": [0, 0], **more}


def tree(problem, bodies, bound, pieces, nodes):
    return {"bound": bound, "bodies": [b if isinstance(b, dict) else body(problem, b) for b in bodies], "pieces": pieces, "nodes": nodes}


def piece(i, j, a, b, part_a, part_b, **more):
    return {"i": i, "j": j, "a": a, "b": b, "A": part_a, "B": part_b, **more}


def node(parent, cuts=(), forces=(), **more):
    return {"parent": parent, "cuts": list(cuts), "forces": list(forces), **more}


def cut(kind, n, d, i=0, j=1, **more):
    return {"kind": kind, "i": i, **({} if kind == "limit" else {"j": j}), "n": n, "d": d, **more}


def empty(pieces, i=0, j=1):
    """The only node of a tree, which claims that there is no allowed place."""
    return [node(None, empty={"i": i, "j": j, "pieces": pieces})]


def part(feature, k=0):
    """The outer ring of one of its polygons."""
    return [list(p) for p in feature["polygons"][k][0]]


def question(a, b, part_a, part_b, ways, **more):
    """ways: (n, d, next)."""
    ways = [{"n": list(n), "d": d, "next": to} for n, d, to in ways]
    return {"a": a, "b": b, "A": part_a, "B": part_b, "ways": ways, "forces": [], **more}


def leaf(*forces, **more):
    """A leaf. forces: (node, way), or (node, way, force), or (node, way, force, behind)."""
    told = [(*f, 1, False) if len(f) == 2 else (*f, False) if len(f) == 3 else f for f in forces]
    return {"forces": [dict(zip(("node", "way", "force", "behind"), f)) for f in told], **more}


def chain(questions, last, on=0):
    """A verdict's nodes. Way `on` of each question leads to the next one, and that of the last question to the leaf
    `last`. Each other way leads to a leaf of its own, or to the one that is given with it: (n, d, leaf)."""
    nodes, leaves, first_leaf = [], [last], len(questions)
    for k, told in enumerate(questions):
        ways = []
        for way, (n, d, *own) in enumerate(told["ways"]):
            ways.append({"n": list(n), "d": d, "next": k + 1 if way == on else first_leaf + len(leaves)})
            if way != on:
                leaves.append(own[0] if own else leaf((k, way)))
        nodes.append({**told, "ways": ways})
    return nodes + leaves


def asked(a, b, part_a, part_b, ways, **more):
    """A question for chain()."""
    return {"a": a, "b": b, "A": part_a, "B": part_b, "ways": ways, "forces": [], **more}


def ways_out(left, bottom, right, top):
    """The ways out of a box of relative moves, as normals and distances; the way to the right comes first."""
    return [((1, 0), right), ((-1, 0), -left), ((0, 1), top), ((0, -1), -bottom)]


def first(ways, k):
    """The same ways, with way k first."""
    return [ways[k], *ways[:k], *ways[k + 1:]]
