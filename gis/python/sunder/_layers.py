"""Whole layers: features are moved apart, or checked for overlaps and gaps."""
import math
from collections import Counter
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from sunder import _sunder
from sunder._geometry import Geometry, array, column_of, is_shapely, shape, shapes, warn

#: The words for `Result.status`.
STATUSES = ("unmoved", "moved", "fixed", "blocked", "skipped", "hidden")

_NOTHING, _POLYGONS, _LINES, _POINTS = range(4)
_FIXED, _IGNORED = 1, 2
# Barriers matter within this multiple of the longest limit, and within this multiple of the gap if there are rows; the
# program has the same two.
_LIMITS_KNOWN = _GAPS_OF_ROWS = 4


class Conflict(NamedTuple):
    """A pair that overlaps or is too close: in the result of `separate`, or as it stands in `check`.

    Features and barriers are numbers of their positions. Lengths are in units of the layer.
    """

    a: int
    b: Any  #: a feature; None if the conflict is with a barrier
    barrier: Any  #: (set, geometry): which of `barriers`, and which of its geometries; else None
    kind: str  #: overlap, too_close, barrier, barrier_drawn, barrier_near, contained, duplicate, tight
    reason: str  #: fixed, max_shift, side, jump, no_room, same_block, kept, unresolved, row; "" in a check
    distance: float  #: 0 if the two overlap
    before: float  #: the distance at the start
    depth: float  #: the length of the least translation that takes the interiors apart
    required: float  #: the distance that the two owe
    missing: float  #: how much of it they lack
    line: tuple  #: ((x, y), (x, y)): the shortest link, or the least translation
    blocked_by: tuple  #: features, and (set, geometry) of barriers, that are in the way
    need_shift: Any  #: a limit of moves with which a solution is known, or None
    need_gap: Any  #: a gap, likewise
    need_gone: Any  #: a feature or barrier without which a solution is known, likewise
    inside_block: bool
    by_row: bool


@dataclass(frozen=True)
class Barrier:
    """Geometries that never move, and to which features keep a distance.

    geometries: polygons, lines and points: a sequence, a GeoSeries or a GeoDataFrame.
    width: the drawn width, with round ends: a number, a sequence, or the name of a column; a polygon is drawn larger by
        half of it.
    gap: the distance from the drawn edge; None: the gap of the call. least_gap: see `separate`.
    side: features stay on their side of it. boundary: polygons are taken as their rings.
    """

    geometries: Any
    width: Any = 0
    gap: Any = None
    least_gap: Any = None
    side: bool = True
    boundary: bool = False


@dataclass(frozen=True, repr=False)
class Result:
    """What `separate` found. Arrays have a value for each feature, in order; they are of NumPy if it is installed."""

    #: The moved geometries: a GeoSeries or Shapes if such came in, else a list; unmoved ones are the same objects.
    geometries: Any
    frame: Any  #: the GeoDataFrame with moved geometries and the columns of the program, if one came in; else None
    dx: Any  #: (n,) float64
    dy: Any  #: (n,) float64
    status: list  #: of each feature: unmoved, moved, fixed, blocked, skipped
    block: Any  #: (n,) int64: the first feature of the block that moved as one, -1 for a feature by itself
    conflicts: list  #: of Conflict
    cost: float  #: the sum of weight * length ** 2 of the moves, with what rows and shortfall cost
    bound: float  #: proved: no result that solves every pair that is not listed costs less
    verified: bool  #: proved: all pairs that are not listed keep their distance, exactly
    summary: dict  #: all figures

    @property
    def reasons(self):
        """The number of conflicts for each reason: a Counter."""
        return Counter(conflict.reason for conflict in self.conflicts)

    def __repr__(self):
        return (f"<sunder.Result: {self.summary['moved']} of {len(self.status)} features moved, cost {self.cost:.6g}, "
                f"bound {self.bound:.6g}, {len(self.conflicts)} conflicts, verified: {self.verified}>")


@dataclass(frozen=True)
class Check:
    """What `check` found."""

    conflicts: list  #: of Conflict
    counts: dict  #: the number of conflicts of each kind, and of all conflicts inside blocks
    summary: dict = field(repr=False)  #: all figures


def separate(features, gap=0, *, barriers=(), max_shift=None, weight=1, weights=None, fixed=None, ignored=None,
             blocks=None, touch_tolerance=None, no_blocks=False, contained=None, allow_jumps=False, rows="auto",
             row_stiffness=(3, 0.3), ease=30, least_gap=None, symbol=None, prefer=None, list_inside=False, effort=1,
             seed=0, threads=0, invalid="repair", progress=None):
    """Moves features apart until no two overlap or are nearer than the gap, at low cost, with a proved lower bound.

    The result is that of `sunder separate` with the same options, bit for bit.

    Args:
        features: polygons: a sequence of geometries, a GeoSeries or a GeoDataFrame; or points, with a `symbol`. Other
            geometries stay as they are and conflict with nothing.
        gap: the least distance, in units of the layer, finite, 0 or more.
        barriers: what never moves: a sequence of `Barrier`, or of geometries as `Barrier` takes them.
        max_shift: the longest move: a number, a sequence of numbers (None or nan: no limit), or the name of a column.
        weight: 1, "area" or "sqrt-area", relative to the median. weights: factors for it: a sequence or a column.
        fixed, ignored: booleans: a sequence or a column; fixed features do not move, ignored ones are left out.
        blocks: keys: a sequence or a column; features with equal keys, not None, move as one.
        touch_tolerance, no_blocks, contained, allow_jumps, row_stiffness, list_inside, effort, seed: as in the program.
        rows: "auto", "no", or keys as for blocks: neighbours in a row keep their order.
        ease: the price of what a pair in conflict lacks, or None. least_gap: the distance that pairs have to keep if
            the whole gap does not pay.
        symbol: a polygon about the origin that is drawn at each point.
        prefer: (n, 2): the moves that features prefer.
        threads: 0: one for each processor; the result is the same for every number.
        invalid: "repair" takes invalid polygons by the even-odd rule, "skip" leaves them out, "fail" is an error.
        progress: None, or a callable that gets a float from 0 to 1 and may raise to stop the work.
    Returns: a `Result`.
    Raises: ValueError that names the feature by its position; sunder.Error.

    >>> left, right = [(0, 0), (4, 0), (4, 4), (0, 4)], [(3, 0), (7, 0), (7, 4), (3, 4)]
    >>> result = separate([left, right], gap=1)
    >>> list(map(float, result.dx)), result.status, result.cost
    ([-1.0, 1.0], ['moved', 'moved'], 2.0)
    >>> result.verified, result.conflicts
    (True, [])
    """
    call = _Call(features, gap, barriers, symbol, invalid)
    call.demand(max_shift, weight, weights, fixed, ignored, blocks, prefer)
    call.order(rows, "auto")
    call.decide(gap, least_gap, touch_tolerance, no_blocks, contained, allow_jumps, list_inside, threads)
    call.options.update(row_stiffness=row_stiffness, ease=0 if ease is None else ease, effort=effort, seed=seed)
    call.reach(gap, max_shift)
    return _result(call, call.run(False, progress))


def check(features, gap=0, *, barriers=(), ignored=None, fixed=None, blocks=None, touch_tolerance=None,
          no_blocks=False, contained=None, least_gap=None, symbol=None, list_inside=False, threads=0, invalid="repair",
          progress=None):
    """Lists the pairs that overlap or are nearer than the gap, exactly. Arguments as for `separate`.

    Returns: a `Check`. Raises: ValueError; sunder.Error.

    >>> found = check([[(0, 0), (4, 0), (4, 4), (0, 4)], [(3, 0), (7, 0), (7, 4), (3, 4)]], gap=1)
    >>> [(one.a, one.b, one.kind, one.depth, one.missing) for one in found.conflicts]
    [(0, 1, 'overlap', 1.0, 2.0)]
    """
    call = _Call(features, gap, barriers, symbol, invalid)
    call.demand(None, 1, None, fixed, ignored, blocks, None)
    call.decide(gap, least_gap, touch_tolerance, no_blocks, contained, False, list_inside, threads)
    found = call.run(True, progress)
    summary = found["summary"]
    return Check(_conflicts(call, found), summary["after"], summary)


# ---- What a call passes to the core --------------------------------------------------------------------------------


class _Call:
    """Features, demands, barriers and options as the extension takes them."""

    def __init__(self, features, gap, barriers, symbol, invalid):
        self.features = features
        self.frame = features if hasattr(features, "columns") and hasattr(features, "geometry") else None
        self.series = features.geometry if hasattr(features, "crs") and hasattr(features, "geometry") else None
        self.crs = getattr(features, "crs", None)
        if gap and self.crs is not None and getattr(self.crs, "is_geographic", False):
            raise ValueError("gap: the layer is in degrees; reproject it to a projected CRS")
        self.items = list(self.series.values) if self.series is not None else (
            features if isinstance(features, _sunder.Shapes) else list(features))
        self.shapes = shapes(column_of(features) if self.series is not None else self.items, "geometry", invalid)
        self.points = symbol is not None
        self.anchors = None
        self._tell_others()
        self.n = len(self.shapes)
        if self.points:
            self._place(shape(symbol, "symbol", invalid), invalid)
        self.barriers = [self._barrier(one, k, invalid) for k, one in enumerate(_list_of_barriers(barriers))]
        self.options = {}
        self.demands = {}

    def _tell_others(self):
        wanted = _POINTS if self.points else _POLYGONS
        others = sum(content not in (_NOTHING, wanted) for content in self.shapes.contents())
        if others:
            warn(f"{others} features are not {'points' if self.points else 'polygons'}; they stay as they are and "
                 "conflict with nothing")

    def _place(self, symbol, invalid):
        """Puts the symbol at each point; the point is the anchor for sides of barriers."""
        at = [self.shapes.point(i) for i in range(self.n)]
        drawn = [None if xy is None else _sunder.move_wkb(symbol.wkb(0), *xy) for xy in at]
        self.anchors = [v for xy in at for v in (xy or (math.nan, math.nan))]
        self.shapes = shapes(drawn, "symbol of geometry", invalid)

    def values(self, what, value):
        """The values of a column, or of a sequence, as a list; None stays None."""
        if value is None:
            return None
        if isinstance(value, str):
            if self.frame is None or value not in self.frame.columns:
                raise ValueError(f"{what}: there is no column {value}")
            value = self.frame[value]
        value = value.tolist() if hasattr(value, "tolist") else list(value)
        if len(value) != self.n:
            raise ValueError(f"{what}: {len(value)} values for {self.n} features")
        return value

    def demand(self, max_shift, weight, weights, fixed, ignored, blocks, prefer):
        """Sets the demands of each feature."""
        flags = [0] * self.n
        for flag, what, given in (_FIXED, "fixed", fixed), (_IGNORED, "ignored", ignored):
            for i, marked in enumerate(self.values(what, given) or ()):
                if not _is_missing(marked) and marked:
                    flags[i] |= flag
        here = self.shapes.areas()
        self.still = [bool(flag) or not area > 0 for flag, area in zip(flags, here)]
        self.demands.update(flags=flags, weight=self._weights(weight, weights, flags, here),
                            max_shift=self._limits(max_shift), blocks=_ranks(self.values("blocks", blocks)),
                            anchors=self.anchors if self.barriers else None)
        if prefer is not None:
            self.demands["prefer"] = [float(v) for pair in prefer for v in pair]

    def _limits(self, max_shift):
        if max_shift is None:
            return None
        if isinstance(max_shift, (int, float)):
            return [max_shift] * self.n
        limits = [math.inf if _is_missing(one) else one for one in self.values("max_shift", max_shift)]
        for i, limit in enumerate(limits):
            if limit < 0:
                raise ValueError(f"max_shift: that of geometry {i} is {limit}; it must be 0 or more")
        return limits

    def _weights(self, weight, weights, flags, areas):
        if weight not in (1, "1", "area", "sqrt-area"):
            raise ValueError(f"weight: {weight!r} is none of 1, 'area', 'sqrt-area'; factors are given as weights")
        factors = self.values("weights", weights)
        out = [1.0] * self.n
        if weight in ("area", "sqrt-area"):
            counted = sorted(a for a, flag in zip(areas, flags) if a > 0 and not flag & _IGNORED)
            middle = len(counted) // 2
            median = 1.0 if not counted else counted[middle] if len(counted) % 2 else (
                counted[middle - 1] / 2 + counted[middle] / 2)
            out = [math.sqrt(a / median) if weight == "sqrt-area" else a / median for a in areas]
        if factors:
            out = [w if _is_missing(f) else w * f for w, f in zip(out, factors)]
        return out

    def order(self, rows, usual):
        """Sets the rows."""
        if self.points and (isinstance(rows, str) and rows == usual):
            rows = "no"
        if isinstance(rows, str) and rows in ("auto", "no"):
            self.options["rows"] = 1 if rows == "auto" else 0
            return
        keys = {}
        self.demands["rows"] = [-1 if _is_missing(key) else keys.setdefault(key, len(keys))
                                for key in self.values("rows", rows)]
        self.options["rows"] = 2

    def decide(self, gap, least_gap, tolerance, no_blocks, contained, allow_jumps, list_inside, threads):
        """Sets the options of the core."""
        if least_gap is not None and least_gap > gap:
            raise ValueError(f"least_gap: {least_gap} is greater than the gap, {gap}")
        if contained is None:
            contained = "separate" if self.points else "block"
        self.options.update(
            gap=gap if least_gap is None else least_gap, full_gap=0 if least_gap is None else gap, kink=gap / 10,
            touch_tolerance=-1 if tolerance is None else tolerance, no_touch=self.points and tolerance is None,
            no_blocks=no_blocks, contained=contained, allow_jumps=self.points or allow_jumps, list_inside=list_inside,
            threads=threads)
        if tolerance is not None and tolerance < 0:
            raise ValueError(f"touch_tolerance: {tolerance} is negative")
        self._complete_barriers(gap, least_gap)

    def _complete_barriers(self, gap, least_gap):
        done = []
        for k, (made, widths, own, least, side, boundary) in enumerate(self.barriers):
            if own is None and least is None:
                done.append((made, widths, -1, 0, gap, side, boundary))
                continue
            full = gap if own is None else own
            lower = least_gap if least is None else least
            if lower is not None and lower > full:
                if least is not None:
                    raise ValueError(f"barrier {k}: its least_gap, {lower}, is greater than its gap, {full}")
                lower = full
            done.append((made, widths, full if lower is None else lower, 0 if lower is None else full, full, side,
                         boundary))
        self.barriers = done

    def reach(self, gap, max_shift):
        """Sets the distance within which barriers are known, as the program does, which changes what is reported."""
        if not self.barriers:
            return
        limits = self.demands["max_shift"] or [math.inf] * self.n
        longest = max((limit for limit, still in zip(limits, self.still) if not still), default=0)
        self.options["barrier_reach"] = max(_LIMITS_KNOWN * longest, _GAPS_OF_ROWS * gap if self.options["rows"] else 0)

    def _barrier(self, given, k, invalid):
        if not isinstance(given, Barrier):
            given = Barrier(given)
        crs = getattr(given.geometries, "crs", None)
        if crs is not None and self.crs is not None and crs != self.crs:
            raise ValueError(f"barrier {k}: its CRS is not that of the features; reproject it")
        who = f"barrier {k}: geometry"
        geometries = given.geometries
        if is_shapely(geometries) or isinstance(geometries, (Geometry, bytes, dict)):
            geometries = [geometries]
        made = shapes(geometries, who, invalid)
        width = given.width
        if isinstance(width, str):
            width = list(geometries[width])
        widths = [width] * len(made) if isinstance(width, (int, float)) else list(width)
        widths = [0.0 if _is_missing(one) or not one > 0 else float(one) for one in widths]
        if len(widths) != len(made):
            raise ValueError(f"barrier {k}: {len(widths)} widths for {len(made)} geometries")
        return made, widths, given.gap, given.least_gap, given.side, given.boundary

    def run(self, checks, progress):
        """Calls the core."""
        return _sunder.layer(self.shapes, self.demands, self.barriers, self.options, checks, progress)


def _list_of_barriers(barriers):
    """One barrier stands for a list of one."""
    if isinstance(barriers, Barrier) or hasattr(barriers, "crs") or is_shapely(barriers):
        return [barriers]
    return barriers


def _is_missing(value):
    """Whether a value is None or one of the missing values of NumPy and pandas, which do not equal themselves."""
    try:
        return value is None or bool(value != value)  # pylint: disable=comparison-with-itself
    except TypeError:  # pandas.NA
        return True


def _ranks(keys):
    """Numbers of keys in the order of their texts, as the program numbers blocks; -1 for what is missing."""
    if keys is None:
        return None
    texts = [None if _is_missing(key) else str(key) for key in keys]
    rank = {text: k for k, text in enumerate(sorted({t for t in texts if t is not None}, key=str.encode))}
    return [-1 if text is None else rank[text] for text in texts]


# ---- What comes back -----------------------------------------------------------------------------------------------


def _conflicts(call, report):
    n, all_places = call.n, [(k, i) for k, (made, *_) in enumerate(call.barriers) for i in range(len(made))]
    places = [all_places[number] for number in report["barriers"]]

    def thing(number):
        return number if number is None or number < n else places[number - n]

    def known(value):
        return None if math.isnan(value) else value

    out = []
    for (a, b, kind, reason, distance, before, depth, required, missing, start, end, blocked_by, need_shift, need_gap,
         need_gone, inside_block, by_row) in report["conflicts"]:
        with_barrier = b is not None and b >= n
        out.append(Conflict(a, None if with_barrier else b, places[b - n] if with_barrier else None, kind, reason,
                            distance, before, depth, required, missing, (start, end), tuple(map(thing, blocked_by)),
                            known(need_shift), known(need_gap), thing(need_gone), inside_block, by_row))
    return out


def _moved(call, moves):
    """The items with their moves; what does not move stays the same object."""
    load = None
    out = []
    for item, (dx, dy) in zip(call.items, moves):
        if dx == 0 and dy == 0:
            out.append(item)
        elif is_shapely(item):
            if load is None:
                from shapely.wkb import loads as load  # a feature came from it, so it is there
            out.append(load(_sunder.move_wkb(item.wkb, dx, dy)))
        elif isinstance(item, (bytes, bytearray, memoryview)):
            out.append(_sunder.move_wkb(bytes(item), dx, dy))
        else:
            out.append(Geometry(_sunder.move_wkb(_sunder.read(item, "geometry", "repair").wkb(0), dx, dy)))
    return out


def _result(call, found):
    moves, summary = found["moves"], found["summary"]
    status = [STATUSES[code] for code in found["statuses"]]
    pairs = moves.tolist()
    if isinstance(call.items, _sunder.Shapes):
        geometries = call.items.moved(moves)
    else:
        geometries = _moved(call, pairs)
    frame = None
    view = array(moves)
    if hasattr(view, "dtype"):
        view = view.reshape(-1, 2)
    dx, dy = (view[:, 0], view[:, 1]) if hasattr(view, "dtype") else ([x for x, _ in pairs], [y for _, y in pairs])
    block = array(found["blocks"])
    if call.series is not None:
        geometries = type(call.series)(geometries, index=call.series.index, crs=call.crs)
    if call.frame is not None:
        frame = call.frame.copy()
        frame[frame.geometry.name] = geometries
        frame["sunder_dx"], frame["sunder_dy"] = dx, dy
        frame["sunder_len"] = [math.hypot(x, y) for x, y in pairs]
        frame["sunder_st"] = status
        frame["sunder_blk"] = _block_column(block, frame)
    return Result(geometries, frame, dx, dy, status, block, _conflicts(call, found), summary["cost"],
                  summary["lower_bound"], summary["verified"], summary)


def _block_column(block, frame):
    """The index of the first feature of each block; missing for a feature by itself."""
    labels = list(frame.index)
    import pandas  # there is a GeoDataFrame, so it is there
    column = pandas.Series([pandas.NA if k < 0 else labels[k] for k in block], index=frame.index)
    return column.astype("Int64") if all(isinstance(label, int) for label in labels) else column
