/* Arms that a cut left too thin.
 *
 *      ________________     Where a street and a yard both take from a house, an arm of it may be left that is thinner
 *     |      )_________|    than the least size. Discs of this size cover the opening of the shape, and leave its
 *     |      a              corners and its arms: pieces between an arc ab of the opening and the walls from a to b. A
 *     |______b              piece that is much longer than the chord ab is an arm. The chord lies in a disc, and so in
 * the shape. A thin bridge has two chords or more.
 *
 * A piece between walls that the shape as given has, but for an end, was thin before and is none. By this measure a
 * corner below 37 degrees is an arm: it is longer than one and a half of its chord.
 *
 * The opening is exact; where its arcs leave the walls is found in doubles. */
#include "displacement/levels/arms.h"

#include "displacement/levels/edges.h"
#include "sunder_sum.h"

#include <math.h>
#include <stdlib.h>

/* An arm is longer than its width by this factor, and longer than this part of the disc's diameter. */
#define LONGER 1.5
#define LEAST_LENGTH 0.25
/* A point is on a wall if it is not farther from it than this part of the disc's diameter. */
#define ON_WALL 0x1p-12

/* ---- The opening ------------------------------------------------------------------------------------------------- */

static sunder_status take_ring(sunder_i_arms *a, const sunder_sum *sum, size_t polygon, size_t ring, sunder_error *err)
{
    const size_t first = a->rings ? a->end[a->rings - 1] : 0;
    size_t n;
    double deviation = 0;
    const uint32_t *vertex = sunder_sum_ring(sum, polygon, ring, &n);
    if (!sunder_i_reserve(&a->xy, &a->room, 2 * (first + n), sizeof *a->xy) ||
        !sunder_i_reserve(&a->end, &a->end_room, a->rings + 1, sizeof *a->end))
        return sunder_i_failure_cause(err);
    a->end[a->rings++] = first + n;
    return sunder_sum_vertices(sum, vertex, n, a->xy + 2 * first, &deviation, err);
}

static sunder_status open_shape(sunder_i_arms *a, const sunder_shape *disc, sunder_error *err)
{
    sunder_sum *sum = NULL;
    sunder_sum_size size;
    sunder_status status = sunder_morphology(a->shape, disc, SUNDER_OPERATION_OPEN, NULL, &sum, err);
    if (status) return status;
    sunder_sum_get_size(sum, &size);
    for (size_t p = 0; p < size.polygons && !status; p++)
        for (size_t r = 0; r < sunder_sum_rings(sum, p) && !status; r++) status = take_ring(a, sum, p, r, err);
    sunder_sum_free(sum);
    return status;
}

/* ---- Arcs -------------------------------------------------------------------------------------------------------- */

/* Returns the distance from p to the outline, and sets *at to the edge that is nearest. */
static double outline_near(const sunder_shape *shape, const double p[2], uint32_t *at)
{
    double least = INFINITY;
    for (uint32_t v = 0; v < shape->vertices; v++) {
        double edge[4], off[2];
        sunder_i_edge_of(shape, v, edge);
        sunder_i_off_edge(edge, p, off);
        const double distance = hypot(off[0], off[1]);
        if (distance < least) *at = v;
        least = sunder_i_min(least, distance);
    }
    return least;
}

static bool is_on_outline(const sunder_i_arms *a, const sunder_shape *shape, const double p[2])
{
    uint32_t edge;
    return outline_near(shape, p, &edge) <= a->on_wall;
}

/* Is p on the outline? Sets where: at a vertex, or at a point of doubles on an edge or beside it in the shape. */
static bool find_contact(const sunder_i_arms *a, const double p[2], sunder_i_wall_contact *at)
{
    double edge[4];
    *at = (sunder_i_wall_contact){.v = 0};
    if (!(outline_near(a->shape, p, &at->v) <= a->on_wall)) return false;
    sunder_i_edge_of(a->shape, at->v, edge);
    const double u[2] = {edge[2] - edge[0], edge[3] - edge[1]}, length = hypot(u[0], u[1]);
    const double along = ((p[0] - edge[0]) * u[0] + (p[1] - edge[1]) * u[1]) / length;
    if (along > a->on_wall && along < length - a->on_wall) {
        at->t = along / length;
        for (int c = 0; c < 2; c++) at->xy[c] = edge[c] + at->t * u[c];
        return sunder_i_round_inward(edge, edge + 2, at->xy);
    }
    if (along > a->on_wall) at->v = a->shape->form->cleaned.next[at->v];
    memcpy(at->xy, a->shape->xy + 2 * (size_t)at->v, sizeof at->xy);
    return true;
}

/* Adds an arc from one contact to another. Returns false if memory is out. */
static bool add_arc(sunder_i_arms *a, const sunder_i_wall_contact *from, const sunder_i_wall_contact *to)
{
    const uint32_t arc = (uint32_t)(a->contacts / 2);
    if (!sunder_i_reserve(&a->contact, &a->contact_room, a->contacts + 2, sizeof *a->contact)) return false;
    for (int k = 0; k < 2; k++) {
        sunder_i_wall_contact *at = &a->contact[a->contacts++];
        *at = k ? *to : *from;
        at->arc = arc;
        at->leaves = k == 0;
    }
    return true;
}

/* Lists the arcs of a ring of the opening with n corners. Returns false if memory is out. */
static bool list_arcs(sunder_i_arms *a, const double *xy, size_t n)
{
    sunder_i_wall_contact start = {0}, at;
    bool on = true, ok = true; /* on: the last corner is on a wall */
    size_t first = 0;
    while (first < n && !find_contact(a, xy + 2 * first, &start)) first++;
    for (size_t k = 1; k <= n && first < n && ok; k++) {
        const double *from = xy + 2 * ((first + k - 1) % n), *to = xy + 2 * ((first + k) % n);
        const double middle[2] = {from[0] + (to[0] - from[0]) / 2, from[1] + (to[1] - from[1]) / 2};
        const bool was = on;
        on = find_contact(a, to, &at);
        if (!on) continue;
        const bool same = start.v == at.v && !(start.t < at.t) && !(start.t > at.t);
        if (!same && !(was && is_on_outline(a, a->shape, middle))) ok = add_arc(a, &start, &at);
        start = at;
    }
    return ok;
}

/* Orders contacts along the rings. Where one arc returns to the walls and another leaves them at the same place, the
 * first comes first. */
static int by_place(const void *x, const void *y)
{
    const sunder_i_wall_contact *a = x, *b = y;
    if (a->v != b->v) return a->v < b->v ? -1 : 1;
    if (a->t < b->t || a->t > b->t) return a->t < b->t ? -1 : 1;
    if (a->leaves != b->leaves) return a->leaves ? 1 : -1;
    return (a->arc > b->arc) - (a->arc < b->arc);
}

/* Is a vertex on the ring of another one? */
static bool on_one_ring(const sunder_shape *shape, uint32_t v, uint32_t w)
{
    const uint32_t *end = shape->form->cleaned.ring_end;
    while (*end <= v && *end <= w) end++;
    return v < *end && w < *end;
}

size_t sunder_i_contact_after(const sunder_i_arms *a, size_t k)
{
    if (k + 1 < a->contacts && on_one_ring(a->shape, a->contact[k].v, a->contact[k + 1].v)) return k + 1;
    while (k > 0 && on_one_ring(a->shape, a->contact[k].v, a->contact[k - 1].v)) k--;
    return k;
}

/* Finds how the arcs follow each other. *found is false if there are none, or if they do not. Returns false if memory
 * is out. */
static bool link_arcs(sunder_i_arms *a, bool *found)
{
    a->arcs = a->contacts / 2;
    *found = a->arcs > 0;
    if (!*found) return true;
    a->arc = sunder_i_calloc(a->arcs, sizeof *a->arc);
    if (!a->arc) return false;
    qsort(a->contact, a->contacts, sizeof *a->contact, by_place);
    for (size_t k = 0; k < a->contacts; k++) {
        sunder_i_open_arc *arc = &a->arc[a->contact[k].arc];
        *(a->contact[k].leaves ? &arc->leaves : &arc->returns) = k;
    }
    for (size_t k = 0; k < a->arcs && *found; k++) {
        const sunder_i_wall_contact *to = &a->contact[sunder_i_contact_after(a, a->arc[k].leaves)];
        a->arc[k].next = to->arc;
        *found = !to->leaves;
    }
    return true;
}

/* ---- Pieces beyond arcs ------------------------------------------------------------------------------------------ */

/* What is measured of a piece. */
typedef struct extent {
    double width;  /* the length of the shortest chord */
    double length; /* the greatest distance of its corners, and of the middles of its walls, from the chords */
    double made;   /* the length of the walls that the shape as given does not have */
} extent;

static double distance_from_chords(const sunder_i_arms *a, size_t first, const double p[2])
{
    double least = INFINITY;
    size_t k = first;
    do {
        const double *from = a->contact[a->arc[k].leaves].xy, *to = a->contact[a->arc[k].returns].xy;
        const double edge[4] = {from[0], from[1], to[0], to[1]};
        double off[2];
        sunder_i_off_edge(edge, p, off);
        least = sunder_i_min(least, hypot(off[0], off[1]));
        k = a->arc[k].next;
    } while (k != first);
    return least;
}

/* Adds a part of a wall to what is measured. */
static void measure_wall(const sunder_i_arms *a, size_t arc, const double from[2], const double to[2], extent *piece)
{
    const double middle[2] = {from[0] + (to[0] - from[0]) / 2, from[1] + (to[1] - from[1]) / 2};
    piece->length = sunder_i_max(piece->length, distance_from_chords(a, arc, from));
    piece->length = sunder_i_max(piece->length, distance_from_chords(a, arc, middle));
    if (!is_on_outline(a, a->given, middle)) piece->made += hypot(to[0] - from[0], to[1] - from[1]);
}

uint32_t sunder_i_vertex_after(const sunder_i_arms *a, const sunder_i_wall_contact *from,
                               const sunder_i_wall_contact *to)
{
    if (from->v == to->v && from->t < to->t) return SUNDER_I_NO_VERTEX;
    const uint32_t next = a->shape->form->cleaned.next[from->v];
    return next == to->v && !(to->t > 0) ? SUNDER_I_NO_VERTEX : next;
}

uint32_t sunder_i_next_vertex(const sunder_i_arms *a, const sunder_i_wall_contact *to, uint32_t v)
{
    const uint32_t next = a->shape->form->cleaned.next[v];
    return v == to->v || (next == to->v && !(to->t > 0)) ? SUNDER_I_NO_VERTEX : next;
}

/* Adds the chord of an arc, and the walls from where the arc leaves them to the next contact. */
static void measure_arc(const sunder_i_arms *a, size_t arc, extent *piece)
{
    const sunder_i_wall_contact *from = &a->contact[a->arc[arc].leaves], *back = &a->contact[a->arc[arc].returns];
    const sunder_i_wall_contact *to = &a->contact[a->arc[a->arc[arc].next].returns];
    const double *last = from->xy;
    piece->width = sunder_i_min(piece->width, hypot(back->xy[0] - from->xy[0], back->xy[1] - from->xy[1]));
    for (uint32_t v = sunder_i_vertex_after(a, from, to); v != SUNDER_I_NO_VERTEX; v = sunder_i_next_vertex(a, to, v)) {
        measure_wall(a, arc, last, a->shape->xy + 2 * (size_t)v, piece);
        last = a->shape->xy + 2 * (size_t)v;
    }
    measure_wall(a, arc, last, to->xy, piece);
}

/* Marks the arcs of arms. Returns whether there are some. */
static bool mark_arms(sunder_i_arms *a)
{
    bool any = false;
    for (size_t first = 0; first < a->arcs; first++) {
        extent piece = {.width = INFINITY};
        size_t k = first;
        if (a->arc[first].seen) continue;
        for (; !a->arc[k].seen; k = a->arc[k].next) {
            a->arc[k].seen = true;
            measure_arc(a, k, &piece);
        }
        if (piece.length <= sunder_i_max(LONGER * piece.width, a->least_length) || piece.made <= piece.width) continue;
        for (; !a->arc[k].off; k = a->arc[k].next) a->arc[k].off = true;
        any = true;
    }
    return any;
}

sunder_status sunder_i_arms_find(const sunder_shape *given, const sunder_shape *shape, const sunder_shape *disc,
                                 double diameter, sunder_i_arms *out, bool *found, sunder_error *err)
{
    *out = (sunder_i_arms){
        .given = given, .shape = shape, .on_wall = ON_WALL * diameter, .least_length = LEAST_LENGTH * diameter};
    *found = false;
    sunder_status status = open_shape(out, disc, err);
    bool ok = true;
    for (size_t r = 0, first = 0; r < out->rings && !status && ok; first = out->end[r++])
        ok = list_arcs(out, out->xy + 2 * first, out->end[r] - first);
    ok = ok && (status || link_arcs(out, found));
    if (!status && !ok) status = sunder_i_failure_cause(err);
    *found = !status && *found && mark_arms(out);
    return status;
}

void sunder_i_arms_free(sunder_i_arms *arms)
{
    sunder_i_free_all(arms->xy, arms->end, arms->contact, arms->arc);
    *arms = (sunder_i_arms){0};
}
