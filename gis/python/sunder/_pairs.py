"""Two geometries, or many pairs of them: overlaps, distances, least translations. Every decision is exact."""
from typing import Any, NamedTuple

from sunder import _sunder
from sunder._geometry import array, fraction, shape, shapes

#: The words for the numbers in `LeastTranslations.contact`.
CONTACTS = tuple(_sunder.contact_words())


class LeastTranslation(NamedTuple):
    """The least translation of b that takes it off a."""

    dx: Any  #: float, or Fraction if `exact` was given
    dy: Any
    distance: float  #: its length, the nearest double
    contact: str  #: what the moved b touches: one of CONTACTS


class LeastTranslations(NamedTuple):
    """Least translations, one for each pair, as arrays (of NumPy if it is installed, else memoryviews)."""

    moves: Any  #: (n, 2) float64
    distance: Any  #: (n,) float64
    contact: Any  #: (n,) uint8, numbers of CONTACTS


class Distance(NamedTuple):
    """The distance of two sets, and a shortest link between them."""

    distance: float  #: the nearest double; 0 if they meet
    on_a: tuple  #: (x, y)
    on_b: tuple


def least_translation(a, b, gap=0, *, exact=False, invalid="repair"):
    """The least translation of b after which its interior is off that of a and the two are `gap` apart.

    It is the least of all, slides and fits without play included; of several shortest ones the smallest by dx, then dy.

    Args:
        a, b: polygons or multipolygons. gap: finite, 0 or more, in units of the input.
        exact: dx and dy are `fractions.Fraction`; with a gap the optimum may be irrational, and they exceed it by at
            most 1e-9 of its length.
    Returns: a `LeastTranslation`.
    Raises: ValueError.

    >>> least_translation([(0, 0), (4, 0), (4, 4), (0, 4)], [(3, 1), (8, 1), (8, 2), (3, 2)])
    LeastTranslation(dx=1.0, dy=0.0, distance=1.0, contact='edge')
    >>> least_translation([(0, 0), (3, 0), (0, 4)], [(0, 0), (3, 0), (0, 4)], exact=True).dx
    Fraction(-48, 25)
    """
    found = _sunder.least_translation(shape(a, "a", invalid), shape(b, "b", invalid), gap)
    dx, dy, distance_, contact, dx_text, dy_text = found[:6]
    if exact:
        dx, dy = fraction(dx_text), fraction(dy_text)
    return LeastTranslation(dx, dy, distance_, contact)


def least_translations(a, b, gap=0, *, invalid="repair", progress=None):
    """`least_translation` for many pairs in one call: a[i] and b[i] for each i.

    Args:
        a, b: sequences of the same length, GeoSeries, or `Shapes`; one of length 1 is paired with all of the other.
    Returns: `LeastTranslations`; pairs with a missing or empty geometry have the move 0.
    Raises: ValueError, which names the geometry by its position.

    >>> unit = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> found = least_translations([unit], [unit, [(0.5, 0), (2, 0), (2, 1), (0.5, 1)]])
    >>> found.moves.tolist()
    [[-1.0, 0.0], [0.5, 0.0]]
    """
    first, second = shapes(a, "a", invalid), shapes(b, "b", invalid)
    moves, lengths, contacts = _sunder.least_translations(first, second, gap, progress)
    return LeastTranslations(array(moves), array(lengths), array(contacts))


def overlap(a, b, *, invalid="repair"):
    """Whether the interiors of a and b meet.

    >>> overlap([(0, 0), (1, 0), (1, 1)], [(1, 0), (2, 0), (2, 1)])
    False
    """
    return _sunder.overlap(shape(a, "a", invalid), shape(b, "b", invalid))


def apart(a, b, gap=0, *, invalid="repair"):
    """Whether the interiors of a and b are disjoint and no two of their points are nearer than the gap.

    >>> apart([(0, 0), (1, 0), (1, 1)], [(2, 0), (3, 0), (3, 1)], 1)
    True
    """
    return _sunder.apart(shape(a, "a", invalid), shape(b, "b", invalid), gap)


def distance(a, b, *, invalid="repair"):
    """The distance of a and b, and a shortest link.

    >>> distance([(0, 0), (1, 0), (1, 1)], [(4, 4), (5, 4), (5, 5)]).distance
    4.242640687119285
    """
    return Distance(*_sunder.distance(shape(a, "a", invalid), shape(b, "b", invalid)))
