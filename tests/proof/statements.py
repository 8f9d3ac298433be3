"""The kinds of statements that a line of --proof makes: by the members that are there, by the kinds of the things they are about
(a feature, a barrier by a segment, a barrier by an area), and by the sign of a clearance."""

NEEDED = """
cut cone
cut disc
cut hull
cut limit
cut price
eased
leaf jump within
leaf jump within behind
leaf max_shift
leaf no_room
leaf no_room behind
leaf no_room still
leaf row
leaf side
leaf side behind
leaf side within
leaf side within behind
leaf unresolved crowded
leaf unresolved crowded behind
leaf unresolved crowded within
leaf unresolved crowded within behind
node
node by
node by empty
node empty
piece area area
piece area area apart
piece area area in touch
piece area area overlapping
piece area barrier area
piece area barrier area in touch
piece area barrier area overlapping
piece area barrier segment
piece area barrier segment apart
piece area barrier segment in touch
piece area barrier segment overlapping
piece joined
piece priced area area
piece priced area barrier segment
piece row
piece row priced
piece shadow area point
piece shadow point area
piece shadow point barrier segment
prices 3
question jump within area area in touch
question jump within shadow area point
question jump within shadow point area
question max_shift area area apart
question max_shift area area in touch
question max_shift area barrier area apart
question max_shift area barrier area in touch
question max_shift area barrier segment apart
question max_shift area barrier segment in touch
question no_room area area apart
question no_room area area in touch
question no_room area area overlapping
question no_room area barrier area overlapping
question no_room area barrier segment apart
question no_room area barrier segment in touch
question no_room area barrier segment overlapping
question no_room held area barrier segment apart
question no_room row
question no_room shadow area point
question no_room shadow c point barrier segment
question no_room shadow point area
question no_room shadow point barrier segment
question no_room slack area barrier segment overlapping
question no_room slack held area barrier segment overlapping
question row row
question side area area apart
question side area barrier segment apart
question side area barrier segment in touch
question side shadow c point barrier segment
question side shadow point barrier segment
question side within area barrier segment in touch
question side within shadow point barrier segment
question unresolved crowded area area apart
question unresolved crowded area area in touch
question unresolved crowded area barrier area in touch
question unresolved crowded area barrier segment apart
question unresolved crowded area barrier segment in touch
question unresolved crowded within area barrier segment in touch
question unresolved crowded within shadow point barrier segment
springs
tree a body of 1
tree a body of 2
tree a body of 3
tree more bodies
tree more bodies one fixed
tree two bodies
tree two bodies one fixed
verdict barrier fixed
verdict barrier max_shift proof
verdict barrier no_room proof
verdict barrier side proof
verdict barrier side proof within
verdict barrier unresolved
verdict barrier unresolved proof crowded
verdict barrier unresolved proof crowded within
verdict barrier_drawn max_shift proof
verdict barrier_drawn no_room proof
verdict barrier_drawn side proof
verdict barrier_drawn unresolved
verdict barrier_near fixed
verdict barrier_near max_shift proof
verdict barrier_near no_room proof
verdict barrier_near side proof
verdict barrier_near unresolved
verdict barrier_near unresolved proof crowded
verdict contained max_shift proof
verdict overlap fixed
verdict overlap jump proof within
verdict overlap max_shift
verdict overlap max_shift proof
verdict overlap no_room proof
verdict overlap same_block inside_block
verdict overlap side proof
verdict overlap unresolved
verdict tight
verdict too_close fixed
verdict too_close max_shift
verdict too_close max_shift proof
verdict too_close no_room proof
verdict too_close row proof
verdict too_close unresolved
verdict too_close unresolved proof crowded
""".strip().split("\n")


def statements_of(line):
    if "conflict" in line:
        yield words("verdict", line["kind"], line["reason"], *marks(line, "proof", "crowded", "within", "inside_block"))
        for node in line.get("proof", ()):
            yield of_node(line, node)
    if "pieces" in line:
        yield from (words("piece", *marks(p, "row", "shadow", "priced", "joined"), *of_pair(p)) for p in line["pieces"])
        bodies = line["bodies"]
        yield words("tree", "two bodies" if len(bodies) < 3 else "more bodies", "one fixed" if any(b["weight"] is None for b in bodies) else "")
        yield words("tree", "a body of", str(min(3, max(len(b.get("features", "1")) for b in bodies))))
        yield from marks(line, "springs", "eased")
        yield from (words("cut", c["kind"]) for node in line["nodes"] for c in node["cuts"])
        yield from (words("node", *marks(node, "by", "empty")) for node in line["nodes"])
    if "prices" in line:
        yield words("prices", str(min(3, len(line["bodies"]))))


def of_node(line, node):
    told = [line["reason"], *marks(line, "crowded", "within")]
    if "ways" not in node:
        return words("leaf", *told, *marks(node, "still"), "behind" if any(f["behind"] for f in node["forces"]) else "")
    return words("question", *told, *marks(node, "row", "shadow", "slack", "held", "c"), *of_pair(node))


def of_pair(told):
    """Piece or question: the shapes of the two parts, and the clearance. Those of a row have none."""
    if "row" in told or "joined" in told:
        return ()
    shapes = [("barrier " if isinstance(told[key], str) else "") + ("point", "segment", "area")[min(len(told[part]), 3) - 1]
              for key, part in ("aA", "bB")]
    clearance = told.get("clearance")
    return *shapes, "" if clearance is None else "apart" if clearance > 0 else "in touch" if clearance == 0 else "overlapping"


def marks(told, *names):
    return [name for name in names if name in told]


def words(*found):
    return " ".join(w for w in found if w)

