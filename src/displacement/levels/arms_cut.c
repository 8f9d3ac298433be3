/* Shapes without their arms: each is cut off along the chords between its ends.
 *
 * The discs at the inner corner of an L end at a slanted chord. A cut at right angles to a wall, from that corner to
 * the other wall of the arm, is shorter and takes less. */
#include "displacement/levels/arms.h"

#include "displacement/levels/edges.h"

#include <math.h>

/* Without a disc at its end, what remains may have another arm, which is cut off by a further pass. */
enum { MOST_PASSES = 4 };

/* ---- Right angles ------------------------------------------------------------------------------------------------ */

/* Sets `moved` to the point nearest to p on the wall of the arm that begins or ends at a contact, if that point is
 * inside of this wall. limit: the contact at the other end of the walls. Returns whether there is one. */
static bool find_foot(const sunder_i_arms *a, const sunder_i_wall_contact *at, const double p[2],
                      const sunder_i_wall_contact *limit, sunder_i_wall_contact *moved)
{
    const uint32_t v = at->leaves || at->t > 0 ? at->v : a->shape->form->cleaned.prev[at->v];
    double edge[4], along = 0, square = 0;
    sunder_i_edge_of(a->shape, v, edge);
    for (int c = 0; c < 2; c++) {
        const double u = edge[2 + c] - edge[c];
        along += u * (p[c] - edge[c]);
        square += u * u;
    }
    double from = at->leaves ? at->t : 0, to = at->leaves || !(at->t > 0) ? 1 : at->t;
    if (limit->v == v && limit->t > from && limit->t < to) *(at->leaves ? &to : &from) = limit->t;
    *moved = *at;
    moved->v = v;
    moved->t = along / square;
    for (int c = 0; c < 2; c++) moved->xy[c] = edge[c] + moved->t * (edge[2 + c] - edge[c]);
    return moved->t > from && moved->t < to && sunder_i_round_inward(edge, edge + 2, moved->xy);
}

static double distance_between(const sunder_i_wall_contact *a, const sunder_i_wall_contact *b)
{
    return hypot(a->xy[0] - b->xy[0], a->xy[1] - b->xy[1]);
}

/* Are all vertices of the walls that begin at an arc beyond a line, or on it? */
static bool is_beyond(const sunder_i_arms *a, size_t arc, const double from[2], const double to[2])
{
    const sunder_i_wall_contact *begin = &a->contact[a->arc[arc].leaves];
    const sunder_i_wall_contact *end = &a->contact[a->arc[a->arc[arc].next].returns];
    const sunder_point p = {from[0], from[1]}, q = {to[0], to[1]};
    for (uint32_t v = sunder_i_vertex_after(a, begin, end); v != SUNDER_I_NO_VERTEX;
         v = sunder_i_next_vertex(a, end, v)) {
        const sunder_point at = {a->shape->xy[2 * (size_t)v], a->shape->xy[2 * (size_t)v + 1]};
        if (sunder_orient(&p, &q, &at) > 0) return false;
    }
    return true;
}

/* Moves one end of the chord of an arc along the arm, to where the chord is shortest, if walls do not bend inwards
 * across it. */
static void square_off(sunder_i_arms *a, size_t arc)
{
    size_t last = arc; /* the arc before it in its cycle */
    while (a->arc[last].next != arc) last = a->arc[last].next;
    sunder_i_wall_contact *from = &a->contact[a->arc[arc].leaves], *to = &a->contact[a->arc[arc].returns];
    sunder_i_wall_contact first, second;
    const bool one = find_foot(a, from, to->xy, &a->contact[a->arc[a->arc[arc].next].returns], &first) &&
                     is_beyond(a, arc, first.xy, to->xy) && is_beyond(a, last, first.xy, to->xy);
    const bool other = find_foot(a, to, from->xy, &a->contact[a->arc[last].leaves], &second) &&
                       is_beyond(a, arc, from->xy, second.xy) && is_beyond(a, last, from->xy, second.xy);
    const double now = distance_between(from, to), by_first = one ? distance_between(&first, to) : now,
                 by_second = other ? distance_between(from, &second) : now;
    if (by_first < now && by_first <= by_second) *from = first;
    if (by_second < now && by_second < by_first) *to = second;
}

/* ---- Rings ------------------------------------------------------------------------------------------------------- */

/* Rings of what remains. */
typedef struct remains {
    double *xy;
    size_t corners, room;
    size_t *end, rings, end_room;
} remains;

static bool add_corner(remains *r, const double xy[2])
{
    if (!sunder_i_reserve(&r->xy, &r->room, 2 * (r->corners + 1), sizeof *r->xy)) return false;
    memcpy(r->xy + 2 * r->corners++, xy, 2 * sizeof *xy);
    return true;
}

static bool end_ring(remains *r)
{
    if (!sunder_i_reserve(&r->end, &r->end_room, r->rings + 1, sizeof *r->end)) return false;
    r->end[r->rings++] = r->corners;
    return true;
}

/* Adds the ring that has the chord of this arc: the chord, the walls from its end to the next arm, the chord there, and
 * so on. On each ring of the shape the contacts of arms leave and return in turn, so this comes back. */
static bool add_cut_ring(sunder_i_arms *a, size_t first, remains *r)
{
    size_t k = first;
    bool ok = true;
    do {
        const sunder_i_wall_contact *back = &a->contact[a->arc[k].returns], *to;
        size_t on = a->arc[k].returns;
        do {
            on = sunder_i_contact_after(a, on);
            to = &a->contact[on];
        } while (!to->leaves || !(a->arc[to->arc].off || to->arc == first));
        a->arc[k].off = false;
        ok = add_corner(r, a->contact[a->arc[k].leaves].xy) && add_corner(r, back->xy);
        for (uint32_t v = sunder_i_vertex_after(a, back, to); ok && v != SUNDER_I_NO_VERTEX;
             v = sunder_i_next_vertex(a, to, v))
            ok = add_corner(r, a->shape->xy + 2 * (size_t)v);
        k = to->arc;
    } while (ok && k != first);
    return ok && end_ring(r);
}

/* Has a ring of the shape, from vertex `first` to `end` - 1, a contact of an arm? */
static bool has_arm(const sunder_i_arms *a, uint32_t first, uint32_t end)
{
    for (size_t k = 0; k < a->contacts; k++)
        if (a->arc[a->contact[k].arc].off && a->contact[k].v >= first && a->contact[k].v < end) return true;
    return false;
}

static bool collect_rings(sunder_i_arms *a, remains *r)
{
    const sunder_i_cleaned *c = &a->shape->form->cleaned;
    bool ok = true;
    for (uint32_t k = 0, first = 0; k < c->rings && ok; first = c->ring_end[k++]) {
        if (has_arm(a, first, c->ring_end[k])) continue;
        for (uint32_t v = first; v < c->ring_end[k] && ok; v++) ok = add_corner(r, a->shape->xy + 2 * (size_t)v);
        ok = ok && end_ring(r);
    }
    for (size_t k = 0; k < a->arcs; k++)
        if (a->arc[k].off) square_off(a, k);
    for (size_t k = 0; k < a->arcs && ok; k++)
        if (a->arc[k].off) ok = add_cut_ring(a, k, r);
    return ok;
}

static size_t ring_begin(const remains *r, size_t ring) { return ring ? r->end[ring - 1] : 0; }

/* Returns twice the area of a ring. */
static double area_of(const remains *r, size_t ring)
{
    const double *from = r->xy + 2 * ring_begin(r, ring);
    double area = 0;
    for (size_t k = ring_begin(r, ring); k + 1 < r->end[ring]; k++) {
        const double *p = r->xy + 2 * k, *q = p + 2;
        area += (p[0] - from[0]) * (q[1] - from[1]) - (p[1] - from[1]) * (q[0] - from[0]);
    }
    return area;
}

static bool is_inside(const remains *r, const double p[2], size_t ring)
{
    const size_t first = ring_begin(r, ring);
    bool inside = false;
    for (size_t k = first; k < r->end[ring]; k++) {
        const double *from = r->xy + 2 * k, *to = r->xy + 2 * (k + 1 < r->end[ring] ? k + 1 : first);
        inside ^= sunder_i_ray_crosses(p, (double[4]){from[0], from[1], to[0], to[1]});
    }
    return inside;
}

/* Makes a shape of the ring with the largest area and of the holes in it; NULL if it is not valid. */
static sunder_status make_largest(const remains *r, sunder_shape **out, sunder_error *err)
{
    remains one = {0};
    size_t largest = 0;
    bool ok = true;
    for (size_t k = 1; k < r->rings; k++)
        if (area_of(r, k) > area_of(r, largest)) largest = k;
    for (size_t k = 0; k <= r->rings && ok; k++) {
        const size_t ring = k ? k - 1 : largest;
        if (k && (area_of(r, ring) >= 0 || !is_inside(r, r->xy + 2 * ring_begin(r, ring), largest))) continue;
        for (size_t i = ring_begin(r, ring); i < r->end[ring] && ok; i++) ok = add_corner(&one, r->xy + 2 * i);
        ok = ok && end_ring(&one);
    }
    sunder_error invalid;
    sunder_status status = ok ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status) {
        status = sunder_shape_from_rings(one.xy, one.end, &one.rings, 1, SUNDER_VALIDITY_STRICT, out, &invalid);
        status = status == SUNDER_EINVALID ? SUNDER_OK : status ? sunder_i_failure_cause(err) : SUNDER_OK;
    }
    sunder_i_free_all(one.xy, one.end);
    return status;
}

/* Cuts off the arms that one pass finds. *found: there are some; *out is then what remains, or NULL. */
static sunder_status cut_once(const sunder_shape *given, const sunder_shape *shape, const sunder_shape *disc,
                              double diameter, bool *found, sunder_shape **out, sunder_error *err)
{
    sunder_i_arms arms;
    remains rest = {0};
    *out = NULL;
    sunder_status status = sunder_i_arms_find(given, shape, disc, diameter, &arms, found, err);
    if (!status && *found && !collect_rings(&arms, &rest)) status = sunder_i_failure_cause(err);
    if (!status && *found) status = make_largest(&rest, out, err);
    sunder_i_arms_free(&arms);
    sunder_i_free_all(rest.xy, rest.end);
    return status;
}

sunder_status sunder_i_cut_arms(const sunder_shape *given, const sunder_shape *disc, double diameter,
                                sunder_shape **shape, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    bool found = disc && !(*shape)->rational;
    for (int pass = 0; pass < MOST_PASSES && found && *shape && !status; pass++) {
        sunder_shape *cut;
        status = cut_once(given, *shape, disc, diameter, &found, &cut, err);
        if (status || !found) break;
        sunder_shape_free(*shape);
        *shape = cut;
    }
    return status;
}
