/* Tight passages: rooms that Q, turned by half a turn, can enter only along a straight line.
 *
 * P is a block with rooms in a row. A passage leads in from the left and from each room to the next; every passage is
 * as wide as Q is high, exactly, so that the mover's placements in it are one segment. The last room has a blind
 * passage besides, whose segment hangs off a hole of the sum. The rooms are holes of the sum, and without the
 * degenerate segments nothing would tell that one can go in and come out again. Q is any convex polygon: a passage
 * longer than Q is wide leaves a segment.
 *
 *      +-------------------------------+
 *      |       +-----+     +-------+   |
 *      |       |     +-----+       |   |
 *      +-------+                   +-+ |
 *                    +-----+       +-+ |
 *      +-------+     |     |       |   |
 *      |       +-----+     +-------+   |
 *      +-------------------------------+ */
#include "family.h"

#include <stdlib.h>

typedef struct tight_room {
    int64_t left, right, floor, ceiling, passage; /* passage: the lower side of the one that leads in */
} tight_room;

static void extent(const family_set *set, int axis, int64_t *low, int64_t *high)
{
    *low = *high = set->xy[axis];
    for (size_t i = 1; i < set->vertices; i++) {
        const int64_t v = set->xy[2 * i + (size_t)axis];
        if (v < *low) *low = v;
        if (v > *high) *high = v;
    }
}

static void draw_rooms(tight_room *room, size_t rooms, town_random *random, int64_t width, int64_t height)
{
    for (size_t i = 0; i < rooms; i++) {
        room[i].left = (i ? room[i - 1].right : 0) + family_integer(random, 2 * width, 3 * width);
        room[i].right = room[i].left + family_integer(random, 3 * width / 2, 4 * width);
        room[i].passage = family_integer(random, -height, height);
        room[i].floor = family_integer(random, -4 * height, -2 * height);
        room[i].ceiling = family_integer(random, 3 * height, 5 * height);
    }
}

static void walls(family_set *p, const tight_room *room, size_t rooms, int64_t width, int64_t height)
{
    const tight_room *last = &room[rooms - 1];
    const int64_t blind = last->passage / 2, wall = last->right + 4 * width;
    family_vertex(p, 0, room->passage);
    family_vertex(p, 0, -5 * height);
    family_vertex(p, wall, -5 * height);
    family_vertex(p, wall, 6 * height);
    family_vertex(p, 0, 6 * height);
    family_vertex(p, 0, room->passage + height);
    for (size_t i = 0; i < rooms; i++) { /* in, along the ceilings */
        family_vertex(p, room[i].left, room[i].passage + height);
        family_vertex(p, room[i].left, room[i].ceiling);
        family_vertex(p, room[i].right, room[i].ceiling);
        if (i + 1 < rooms) family_vertex(p, room[i].right, room[i + 1].passage + height);
    }
    family_vertex(p, last->right, blind + height);
    family_vertex(p, last->right + 2 * width, blind + height);
    family_vertex(p, last->right + 2 * width, blind);
    family_vertex(p, last->right, blind);
    for (size_t i = rooms; i-- > 0;) { /* and out, along the floors */
        if (i + 1 < rooms) family_vertex(p, room[i].right, room[i + 1].passage);
        family_vertex(p, room[i].right, room[i].floor);
        family_vertex(p, room[i].left, room[i].floor);
        family_vertex(p, room[i].left, room[i].passage);
    }
    family_end_member(p);
}

void family_tight(family_set *p, family_set *q, size_t m, size_t n, family_streams *streams)
{
    int64_t low, high;
    family_convex_member(q, &streams->q, n, 0, 0, 100);
    extent(q, 1, &low, &high);
    const int64_t height = high - low;
    extent(q, 0, &low, &high);
    const size_t rooms = m < 24 ? 1 : m / 8 - 1;
    tight_room *room = family_room(NULL, rooms, sizeof *room);
    draw_rooms(room, rooms, &streams->p, high - low, height);
    walls(p, room, rooms, high - low, height);
    free(room);
}
