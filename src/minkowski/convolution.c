/* A polygon P, with holes or not, plus one convex polygon Q: no decomposition and no arrangement of many subsums, only
 * one walk around P. Most buildings are such.
 *
 * The convolution [GRS83] of P's rings with Q is a closed curve for each ring: every side of P moved by the corner of Q
 * that is extreme in its outward direction, joined at a convex vertex v by the arc of v + Q between the two corners, at
 * a reflex one by that arc run backwards. Its winding number at x is the Euler characteristic of the meet of P and x -
 * Q: how many pieces that has, less the holes of P that lie inside x - Q. Here
 *
 *  - holes of P into which Q does not fit by its box are left out, which changes nothing, and no other has a box that
 *    fits into Q's, so that the number counts pieces: the interiors meet at x exactly where it is positive, and nowhere
 *    is it negative;
 *  - an arc run backwards is replaced by its chord. The number rises by one between arc and chord, which is inside
 *    v + Q, where it was positive already. So what is positive remains the same.
 *
 * The curve is tame if no two links have a point in common but those that follow each other, in their ends, and pairs
 * that cross in their insides, no third one passing there. Then walk along it with the number on the right hand. It
 * changes only where another link crosses, by one, and the pieces of links that have 0 on their right bound the sum,
 * all of them.
 *
 * There are no degenerate holes then. A point that the interiors do not meet in, all around it they do, is on the
 * curve. On a chord, ends included, it is not: x - Q has the reflex vertex v on its boundary or around it, and reaches
 * into P. Beside a moved side or arc the number is positive on both hands, so on the right hand there is a piece other
 * than the one that the link's own contact brings and takes away; that piece is still there on the link, since for it
 * to vanish there another link would have to pass. At a crossing the same holds of the quarter to the right of both
 * links.
 *
 * Rings of the result: as no point has two boundary pieces but a vertex where one goes on in the other, they are simple
 * and have no points in common. P and Q are connected, so there is one outer ring. Collinear vertices cannot arise:
 * sides of P and of Q of one direction are joined. All tests are exact, and on a narrow lattice; elsewhere nothing is
 * tried, and where the curve is not tame the general road is taken. */
#include "minkowski/convolution.h"

#include "minkowski/convolution_inner.h"
#include "sum/canonical.h"

#include <stdalign.h>
#include <string.h>

/* A piece of a link is what lies between two stops, or a stop and an end. Link i has its pieces from
 * stop_begin(i) + i on, one more than it has stops. */
typedef struct walker {
    const sunder_i_convolution *curve;
    int32_t *right; /* [pieces] the winding number on the right hand */
    bool *done;     /* [pieces] */
    bool tame;      /* nothing was found that cannot be */
} walker;

static uint32_t stop_begin(const sunder_i_convolution *c, uint32_t link) { return link ? c->stop_end[link - 1] : 0; }

/* ---- Winding numbers ---- */

static uint32_t smallest_corner(const sunder_i_convolution *c, uint32_t begin, uint32_t end)
{
    uint32_t least = begin;
    for (uint32_t i = begin + 1; i < end; i++) {
        const sunder_i_point a = c->corner[i], b = c->corner[least];
        if (a.x < b.x || (a.x == b.x && a.y < b.y)) least = i;
    }
    return least;
}

/* How often links outside [begin, end) wind around a place that none of them touches: those that cross the ray from
 * there to the left. */
static int32_t winding_of_others(const sunder_i_convolution *c, sunder_i_point at, uint32_t begin, uint32_t end)
{
    int32_t winding = 0;
    for (uint32_t i = 0; i < c->links; i++) {
        if (i == begin) i = end;
        if (i >= c->links) break;
        const sunder_i_point a = c->corner[i], b = c->corner[c->next[i]];
        if ((a.y > at.y) == (b.y > at.y)) continue;
        const bool up = b.y > at.y;
        const sunder_i_det side = sunder_i_narrow_orient(a, b, at);
        if (up ? side < 0 : side > 0) winding += up ? -1 : 1; /* it passes to the left of the place */
    }
    return winding;
}

/* At a ring's smallest corner the outside of the ring is to the left of the bend: a left turn has it on the right hand,
 * a right turn on the left, and there the ring itself counts -1 on the right. */
static int32_t number_at(const sunder_i_convolution *c, uint32_t least, uint32_t begin, uint32_t end)
{
    const uint32_t last = least > begin ? least - 1 : end - 1;
    const int32_t others = c->p->rings > 1 ? winding_of_others(c, c->corner[least], begin, end) : 0;
    return others - (sunder_i_narrow_orient(c->corner[last], c->corner[least], c->corner[c->next[least]]) < 0);
}

static void number_ring(walker *w, uint32_t begin, uint32_t end)
{
    const sunder_i_convolution *c = w->curve;
    const uint32_t least = smallest_corner(c, begin, end);
    const int32_t start = number_at(c, least, begin, end);
    int32_t right = start;
    uint32_t i = least;
    do {
        uint32_t piece = stop_begin(c, i) + i;
        for (uint32_t s = stop_begin(c, i); s < c->stop_end[i]; s++) {
            w->right[piece++] = right;
            right += c->stop[s].rises ? 1 : -1;
        }
        w->right[piece] = right;
        if (right < 0 || (right == 0 && c->chord[i])) w->tame = false;
        i = c->next[i];
    } while (i != least);
    if (right != start) w->tame = false;
}

/* ---- Rings ---- */

static bool add_vertex(sunder_sum *sum, size_t *room, sunder_i_hpoint at)
{
    if (sum->vertices == *room && !sunder_i_reserve(&sum->vertex, room, (size_t)sum->vertices + 1, sizeof *sum->vertex))
        return false;
    sum->vertex[sum->vertices++] = at;
    return true;
}

/* Follows the boundary from piece k of link i until it closes: at a crossing it goes on on the link that comes from the
 * left, which has the free side on its right as well. False if memory is out. */
static bool follow(walker *w, uint32_t i, uint32_t k, sunder_sum *sum, size_t *room)
{
    const sunder_i_convolution *c = w->curve;
    for (;;) {
        const uint32_t piece = stop_begin(c, i) + i + k, s = stop_begin(c, i) + k;
        if (w->done[piece]) return true;
        if (w->right[piece] != 0) w->tame = false;
        w->done[piece] = true;
        sunder_i_hpoint at;
        if (s < c->stop_end[i]) {
            const sunder_i_stop *stop = &c->stop[s];
            at = sunder_i_hpoint_at(c->lattice, c->corner[i], c->corner[c->next[i]], &stop->at);
            i = c->stop[stop->partner].link;
            k = stop->partner - stop_begin(c, i) + 1;
        } else {
            i = c->next[i];
            k = 0;
            at = sunder_i_hpoint_of(c->lattice, c->corner[i]);
        }
        if (!add_vertex(sum, room, at)) return false;
    }
}

typedef struct ring_list {
    sunder_i_arena *memory;
    sunder_i_found_ring *ring; /* start and end in the vertices of the sum */
    size_t n, room;
} ring_list;

static bool follow_all(walker *w, sunder_sum *sum, ring_list *rings)
{
    const sunder_i_convolution *c = w->curve;
    size_t room = 0;
    if (!sunder_i_reserve(&sum->vertex, &room, c->links + c->stops / 2, sizeof *sum->vertex)) return false;
    for (uint32_t i = 0; i < c->links; i++)
        for (uint32_t k = 0; k <= c->stop_end[i] - stop_begin(c, i); k++) {
            const uint32_t piece = stop_begin(c, i) + i + k;
            if (w->right[piece] != 0 || w->done[piece]) continue;
            if (rings->n == rings->room &&
                !sunder_i_arena_reserve(rings->memory, &rings->ring, &rings->room, rings->n + 1, sizeof *rings->ring))
                return false;
            sunder_i_found_ring r = {.start = sum->vertices};
            if (!follow(w, i, k, sum, &room)) return false;
            r.end = sum->vertices;
            rings->ring[rings->n++] = r;
        }
    return true;
}

/* No two rings have a vertex in common; the outer one has the smallest of all. */
static bool put_rings(ring_list *rings, sunder_sum *sum)
{
    uint32_t *vertex = sunder_i_arena_alloc(rings->memory, sum->vertices, sizeof *vertex);
    size_t outer = 0, at = 0;
    for (size_t r = 0; vertex && r < rings->n; r++) {
        const uint32_t start = (uint32_t)rings->ring[r].start, end = (uint32_t)rings->ring[r].end;
        uint32_t least = start;
        for (uint32_t v = start + 1; v < end; v++)
            if (sunder_i_hpoint_cmp(&sum->lattice, &sum->vertex[v], &sum->vertex[least]) < 0) least = v;
        for (uint32_t v = least; v < end; v++) vertex[at++] = v;
        for (uint32_t v = start; v < least; v++) vertex[at++] = v;
        if (sunder_i_sum_vertex_cmp(sum, least, vertex[rings->ring[outer].start]) < 0) outer = r;
    }
    rings->ring[outer].outer = true;
    sunder_i_found found = {.vertex = vertex,
                            .ring = rings->ring,
                            .rings = rings->n,
                            .components = 1,
                            .compare = sunder_i_sum_vertex_cmp,
                            .context = sum};
    return vertex && sunder_i_canonical(&found, sum);
}

/* ---- All of it ---- */

static void forget(sunder_sum *sum)
{
    sunder_i_free(sum->vertex);
    sum->vertex = NULL;
    sum->vertices = 0;
}

static bool walk(sunder_i_convolution *c, sunder_sum *sum, bool *done)
{
    const size_t pieces = c->links + c->stops;
    walker w = {c, sunder_i_arena_alloc(&c->memory, pieces, sizeof *w.right),
                sunder_i_arena_alloc(&c->memory, pieces, sizeof *w.done), true};
    ring_list rings = {.memory = &c->memory};
    bool ok = w.right && w.done;
    if (ok) memset(w.done, 0, pieces * sizeof *w.done);
    for (uint32_t r = 0; ok && r < c->p->rings; r++)
        if (!c->left_out[r]) number_ring(&w, sunder_i_convolution_first(c, r), c->ring_end[r]);
    ok = ok && (!w.tame || follow_all(&w, sum, &rings));
    *done = ok && w.tame;
    if (*done)
        ok = put_rings(&rings, sum);
    else
        forget(sum);
    return ok;
}

static sunder_status build(sunder_i_convolution *c, sunder_sum *sum, const sunder_i_point *at_p, const sunder_shape *q,
                           const sunder_i_point *at_q, bool *done, sunder_error *err)
{
    bool fits;
    sunder_status status = sunder_i_convolution_build(c, at_p, q, at_q, &fits, err);
    if (status == SUNDER_OK && fits) status = sunder_i_convolution_cross(c, &fits, err);
    if (status != SUNDER_OK || !fits) return status;
    return walk(c, sum, done) ? SUNDER_OK : sunder_i_no_memory(err);
}

/* For each ring all links are gone through to locate it. What is needed for a building and a disc takes so much. */
enum { MOST_RINGS = 64, LENT = 16384 };

sunder_status sunder_i_convolution_sum(sunder_sum *sum, const sunder_shape *p, const sunder_i_point *at_p,
                                       const sunder_shape *q, const sunder_i_point *at_q, bool *done, sunder_error *err)
{
    *done = false;
    if (!sum->lattice.narrow || p->polygons != 1 || p->touches || p->rings > MOST_RINGS || q->pieces != 1)
        return SUNDER_OK;
    sunder_i_convolution c = {.lattice = &sum->lattice, .p = p};
    alignas(16) char lent[LENT];
    sunder_i_arena_init_on(&c.memory, lent, sizeof lent);
    const sunder_status status = build(&c, sum, at_p, q, at_q, done, err);
    sunder_i_arena_free(&c.memory);
    return status;
}
