"""The shortest route of a robot among obstacles."""
from typing import Any, NamedTuple

from sunder import _sunder
from sunder._geometry import fraction, rational, shape, shapes


class Route(NamedTuple):
    """A shortest path of the robot's origin, or the reason that there is none."""

    found: bool
    length: float  #: the nearest double; 0 if there is no path
    path: list  #: (x, y) of each corner, start and goal included; Fractions if `exact` was given
    reason: Any  #: None, "start_in_collision", "goal_in_collision" or "disconnected"
    obstacle: Any  #: the number of the obstacle that the robot meets at start or goal, or None
    rounded_is_free: bool  #: whether the path is also free if its corners are rounded to the nearest doubles


def route(obstacles, robot, start, goal, gap=0, *, exact=False, invalid="repair", progress=None):
    """The shortest path along which `robot` can be moved, without turning, from start to goal.

    Contact is allowed: passages and places that the robot fits exactly are used.

    Args:
        obstacles: polygons, lines and points: a sequence, or a GeoSeries. robot: a polygon, relative to its origin.
        start, goal: (x, y) of the robot's origin; floats, ints or Fractions, taken exactly.
        gap: 0 or more; the robot is grown by a polygon of 64 sides around the disc of this radius.
    Returns: a `Route`. Raises: ValueError.

    >>> wall = [(2, -3), (3, -3), (3, 3), (2, 3)]
    >>> route([wall], square(2), (0, 0), (5, 0)).path
    [(0.0, 0.0), (1.0, -4.0), (4.0, -4.0), (5.0, 0.0)]
    """
    reason, length, path, exact_path, free, obstacle = _sunder.route(
        shapes(obstacles, "obstacle", invalid), shape(robot, "robot", invalid), _place(start, "start"),
        _place(goal, "goal"), gap, progress)
    if exact:
        path = [(fraction(x), fraction(y)) for x, y in exact_path]
    found = reason == "found"
    return Route(found, length, path, None if found else reason, None if obstacle < 0 else obstacle, free)


def _place(place, who):
    try:
        x, y = place
        return rational(x), rational(y)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"{who}: not a pair of finite numbers: {place!r}") from error
