"""Does a disc fit in a part of a block, and how large is the largest one?

In doubles, unlike all other premises: the program itself finds the disc only up to a share of the part's width, so an answer is as good as
the share that the caller allows. The distance from a point inside to the walls changes by no more than the point moves; so no disc with its
centre in a square of half diagonal r is larger than the distance from its middle to the walls plus r. Squares are divided into four, the
most promising one first.
"""
import heapq
import math

from form import demand

MOST_ALONG, MOST_SQUARES, LAST_STEP = 256, 200_000, 2.0 ** -20


def distance(x, y, edges):
    least = math.inf
    for ax, ay, ux, uy, square in edges:
        wx, wy = x - ax, y - ay
        t = min(1.0, max(0.0, (wx * ux + wy * uy) / square))
        wx, wy = wx - t * ux, wy - t * uy
        least = min(least, wx * wx + wy * wy)
    return math.sqrt(least)


def is_within(x, y, edges):
    """By the even-odd rule."""
    inside = False
    for ax, ay, ux, uy, _ in edges:
        if (ay > y) != (ay + uy > y):
            inside ^= x < ax + (y - ay) * ux / uy
    return inside


def prepared(edges):
    """Edges as (start, vector, square of the length), without those of no length in doubles."""
    found = [(ax, ay, bx - ax, by - ay, (bx - ax) ** 2 + (by - ay) ** 2) for (ax, ay), (bx, by) in edges]
    return [e for e in found if e[4] > 0]


class Room:
    """The inside of the members, and the cracks between them, without what is beyond a wall."""

    def __init__(self, walls, members, crack):
        self.walls, self.members, self.crack = prepared(walls), [prepared(edges) for edges in members], crack
        corners = [p for edges in members for e in edges for p in e]
        self.low = [min(p[c] for p in corners) for c in (0, 1)]
        self.sizes = [max(p[c] for p in corners) - self.low[c] for c in (0, 1)]

    def is_in(self, x, y):
        if any(is_within(x, y, edges) for edges in self.members):
            return True
        return len(self.members) > 1 and sum(distance(x, y, edges) <= self.crack for edges in self.members) > 1

    def free(self, x, y):
        """The distance to the walls; below 0 outside of the room."""
        found = distance(x, y, self.walls)
        return found if self.is_in(x, y) else -found

    def fits(self, radius, slack):
        """Is there such a disc? If not, then none that is larger by the slack."""
        return self.search(radius, radius, slack) >= radius

    def largest(self, slack):
        """The radius of a disc; no other one is larger by more than the slack."""
        return self.search(0.0, math.inf, slack)

    def search(self, least, enough, slack):
        """Looks for a disc of radius `enough`, until no disc can be larger by the slack than the one that was found, and than `least`."""
        squares, found, at = [], -math.inf, None
        size = min(self.sizes)
        n = [min(MOST_ALONG, math.ceil(s / size)) for s in self.sizes]
        h = max(s / k for s, k in zip(self.sizes, n)) / 2
        for k in range(n[0] * n[1]):
            x, y = self.low[0] + h * (2 * (k % n[0]) + 1), self.low[1] + h * (2 * (k // n[0]) + 1)
            free = self.free(x, y)
            squares.append((-free - h * math.sqrt(2), x, y, h))
            if free > found:
                found, at = free, (x, y)
        found = self.climb(max(found, 0.0), at, size / 8, enough)
        heapq.heapify(squares)
        for _ in range(MOST_SQUARES):
            if found >= enough or not squares or -squares[0][0] <= max(found, least) + slack:
                return found
            _, x, y, h = heapq.heappop(squares)
            h /= 2
            for dx, dy in ((-h, -h), (h, -h), (-h, h), (h, h)):
                free = self.free(x + dx, y + dy)
                found = max(found, free)
                heapq.heappush(squares, (-free - h * math.sqrt(2), x + dx, y + dy, h))
        demand(False, "a part of a block is too long to find the largest disc in it")

    def climb(self, found, at, step, enough):
        """Improves a disc by small steps."""
        last = step * LAST_STEP
        while step > last and found < enough:
            free, x, y = max((self.free(at[0] + i * step, at[1] + k * step), i, k) for i in (-1, 0, 1) for k in (-1, 0, 1))
            if free > found:
                found, at = free, (at[0] + x * step, at[1] + y * step)
            else:
                step /= 2
        return found
