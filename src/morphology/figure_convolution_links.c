/* figure_convolution_links.c: the curve of a figure: its sides, each translated by the corner of the element C that is
 * extreme in its outward direction, and what joins them. The figure, or its complement, is on the left of the sides.
 *
 * If C has a side with the same direction the two are joined; but at a reflex end that part would be traversed back at
 * once, and is omitted. So a side between two such ends is shortened by C's, and if that one is longer the remainder is
 * traversed backwards. After a dilation by -C most sides of the complement are of this kind, and exactly as long as
 * that of C: nothing of them remains then, and the curve of a whole arc is one corner, the centre of the arc. */
#include "morphology/figure_convolution.h"

#include "base/extremes.h"
#include "base/watch.h"

#include <math.h>
#include <stdlib.h>

/* What remains of a translated side: a part of it; a part that is traversed backwards; nothing. */
typedef enum what_is_left { SOME, BACKWARDS, NOTHING } what_is_left;

/* Numbers k of corners are in the order of the curve, ring by ring; those of the figure are reversed for a
 * complement. */
typedef struct mover {
    sunder_i_figure_convolution *curve;
    const sunder_i_figure *figure;
    const sunder_i_structuring_element *c;
    uint32_t m;             /* the number of corners of C */
    size_t begin, end;      /* the current ring */
    sunder_i_point *d;      /* [sides] the direction of the side that leaves each corner */
    double (*xy)[2];        /* [sides] */
    double (*c_xy)[2];      /* [m] */
    bool *reflex;           /* [sides] */
    uint32_t *first, *last; /* [sides] the corners of C that are extreme for that side; they differ if C has a side with
                             * that direction, from first to last */
    uint8_t *left;          /* [sides] a what_is_left */
    bool *left_out;         /* [rings] whether the ring of the figure is omitted */
} mover;

static size_t next_of(const mover *t, size_t k) { return k + 1 < t->end ? k + 1 : t->begin; }
static size_t prev_of(const mover *t, size_t k) { return (k > t->begin ? k : t->end) - 1; }
static uint32_t corner_after(const mover *t, uint32_t j) { return j + 1 < t->m ? j + 1 : 0; }
static uint32_t corner_before(const mover *t, uint32_t j) { return j ? j - 1 : t->m - 1; }

static sunder_i_rational_point corner_of(const mover *t, size_t k)
{
    return t->figure->at[t->figure->ring[t->curve->erode ? t->begin + t->end - 1 - k : k]];
}

static void set_ring(mover *t, size_t ring)
{
    t->begin = ring ? t->figure->ring_end[ring - 1] : 0;
    t->end = t->figure->ring_end[ring];
}

/* ---- Doubles ---- */

static double most_of(double (*xy)[2], size_t n)
{
    double most = 0;
    for (size_t i = 0; i < n; i++) most = sunder_i_max(most, sunder_i_max(fabs(xy[i][0]), fabs(xy[i][1])));
    return most;
}

static void round_corner(const mover *t, sunder_i_rational_point at, double xy[2])
{
    sunder_i_arena *s = &t->curve->scratch;
    const sunder_i_mark mark = sunder_i_arena_mark(s);
    sunder_i_rational_doubles(s, at, t->curve->shift, &xy[0], &xy[1]);
    sunder_i_arena_release(s, mark);
}

/* Sets t->xy and t->c_xy to the corners of the figure and of C as doubles, and the error of the curve. A corner of the
 * curve is the sum of one of each, both rounded, and the sum is rounded once more: an error of 2^-52 of the sum of the
 * two largest coordinates; twice that is used. Returns false if cancelled. */
static bool round_corners(mover *t)
{
    for (size_t r = 0; r < t->figure->rings; r++) {
        set_ring(t, r);
        for (size_t k = t->begin; k < t->end; k++) round_corner(t, corner_of(t, k), t->xy[k]);
        if (!sunder_i_steps(t->end - t->begin)) return false;
    }
    for (uint32_t j = 0; j < t->m; j++) round_corner(t, t->c->corner[j], t->c_xy[j]);
    t->curve->error = (most_of(t->xy, t->figure->sides) + most_of(t->c_xy, t->m)) * 0x1p-51 + 0x1p-900;
    return true;
}

/* ---- Sides ---- */

static bool is_small(sunder_i_rational_point u, sunder_i_point *out)
{
    return sunder_i_big_is_one(u.w) && sunder_i_big_fits_i64(u.x, &out->x) && sunder_i_big_fits_i64(u.y, &out->y) &&
           llabs(out->x) < (int64_t)1 << (SUNDER_I_PLAIN_BITS - 1) &&
           llabs(out->y) < (int64_t)1 << (SUNDER_I_PLAIN_BITS - 1);
}

/* Sets *out to the direction of side k. Returns false if it is not plain. */
static bool find_direction(const mover *t, size_t k, sunder_i_point *out)
{
    sunder_i_arena *s = &t->curve->scratch;
    const sunder_i_rational_point a = corner_of(t, k), b = corner_of(t, next_of(t, k));
    sunder_i_point p, q;
    if (is_small(a, &p) && is_small(b, &q)) {
        *out = (sunder_i_point){q.x - p.x, q.y - p.y};
        return true;
    }
    const sunder_i_mark mark = sunder_i_arena_mark(s);
    const bool plain = sunder_i_heading(s, sunder_i_rational_sub(s, b, a), out);
    sunder_i_arena_release(s, mark);
    return plain;
}

/* Returns the sign of the turn from d to the side of C that ends in corner j. */
static int turn_to(const mover *t, sunder_i_point d, uint32_t j)
{
    const sunder_i_i128 turn = sunder_i_plain_cross(d, t->c->along[corner_before(t, j)]);
    return (turn > 0) - (turn < 0);
}

/* Returns the last corner that is extreme for d, searching from corner j, the last one for the previous side: forwards
 * at a left turn, backwards at a right turn. */
static uint32_t walk_to(const mover *t, uint32_t j, sunder_i_point d, bool backwards)
{
    if (backwards)
        while (turn_to(t, d, j) > 0) j = corner_before(t, j);
    else
        while (turn_to(t, d, corner_after(t, j)) <= 0) j = corner_after(t, j);
    return j;
}

/* Returns the last corner of C that is extreme for a side with the direction d, that is, farthest to the right of d. */
static uint32_t find_corner(const mover *t, sunder_i_point d)
{
    uint32_t j = 0;
    while (turn_to(t, d, j) >= 0) j++;
    return walk_to(t, j, d, false);
}

/* Finds the extreme corners for the sides of the current ring. Returns false if it has a straight corner, or a side
 * whose direction is not plain. */
static bool find_corners(mover *t)
{
    for (size_t k = t->begin; k < t->end; k++)
        if (!find_direction(t, k, &t->d[k])) return false;
    sunder_i_point d = t->d[t->end - 1];
    uint32_t j = find_corner(t, d);
    for (size_t k = t->begin; k < t->end; k++) {
        const sunder_i_i128 bend = sunder_i_plain_cross(d, t->d[k]);
        if (bend == 0) return false;
        t->reflex[k] = bend < 0;
        d = t->d[k];
        j = t->last[k] = walk_to(t, j, d, bend < 0);
        t->first[k] = turn_to(t, d, j) == 0 ? corner_before(t, j) : j;
    }
    return sunder_i_steps(t->end - t->begin);
}

/* ---- Holes ---- */

static void size_of(double (*xy)[2], size_t n, double size[2])
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < n; i++)
        for (int a = 0; a < 2; a++) {
            low[a] = sunder_i_min(low[a], xy[i][a]);
            high[a] = sunder_i_max(high[a], xy[i][a]);
        }
    for (int a = 0; a < 2; a++) size[a] = high[a] - low[a];
}

/* Returns whether the ring is clockwise, that is, whether it turns right at its smallest corner. */
static bool is_hole(const mover *t)
{
    size_t least = t->begin;
    for (size_t k = t->begin + 1; k < t->end; k++) {
        const sunder_i_curve_corner a = {corner_of(t, k), {t->xy[k][0], t->xy[k][1]}},
                                    b = {corner_of(t, least), {t->xy[least][0], t->xy[least][1]}};
        if (sunder_i_curve_cmp(t->curve, &a, &b) < 0) least = k;
    }
    return t->reflex[least];
}

/* Decides about a hole. A hole that is narrower than C in one direction has no effect and is omitted, as in
 * ../minkowski/: if x - C has no point in common with the set it is inside one hole, and does not fit into this one. No
 * other hole has a box that fits into C's, so that winding numbers count pieces; *fits becomes false if doubles do not
 * decide this. */
static void look_at_hole(mover *t, size_t ring, bool *fits)
{
    double size[2], own[2];
    const double doubt = 8 * t->curve->error;
    size_of(t->c_xy, t->m, size);
    size_of(t->xy + t->begin, t->end - t->begin, own);
    t->left_out[ring] = own[0] < size[0] - doubt || own[1] < size[1] - doubt;
    if (!t->left_out[ring] && own[0] <= size[0] + doubt && own[1] <= size[1] + doubt) *fits = false;
}

/* ---- Links ---- */

static uint32_t arc_length(const mover *t, size_t k)
{
    const uint32_t a = t->last[prev_of(t, k)], b = t->first[k];
    return b >= a ? b - a : b + t->m - a;
}

static size_t count_links(const mover *t)
{
    size_t n = t->end - t->begin;
    for (size_t k = t->begin; k < t->end; k++) n += t->reflex[k] ? 1 : arc_length(t, k);
    return n;
}

/* Returns the sum of corner k and corner j of C. */
static sunder_i_curve_corner moved_corner(const mover *t, size_t k, uint32_t j)
{
    sunder_i_arena *s = &t->curve->scratch;
    const sunder_i_mark mark = sunder_i_arena_mark(s);
    const sunder_i_rational_point at = sunder_i_rational_add(s, corner_of(t, k), t->c->corner[j]);
    const sunder_i_curve_corner moved = {sunder_i_rational_copy(&t->curve->memory, at),
                                         {t->xy[k][0] + t->c_xy[j][0], t->xy[k][1] + t->c_xy[j][1]}};
    sunder_i_arena_release(s, mark);
    return moved;
}

static void add_link(mover *t, size_t k, uint32_t j, sunder_i_point along, bool chord)
{
    sunder_i_figure_convolution *c = t->curve;
    c->link[c->links] =
        (sunder_i_curve_link){.from = moved_corner(t, k, j), .along = along, .ring = c->rings, .chord = chord};
    c->links++;
}

/* The joint at corner k of the figure begins and ends at these corners of C. */
static uint32_t joint_begin(const mover *t, size_t k)
{
    const size_t before_k = prev_of(t, k);
    return t->reflex[k] ? t->first[before_k] : t->last[before_k];
}
static uint32_t joint_end(const mover *t, size_t k) { return t->reflex[k] ? t->last[k] : t->first[k]; }

/* Adds the links from the end of the side before corner k to the beginning of the side that leaves it. Returns false if
 * a chord's direction is not plain. */
static bool add_joint(mover *t, size_t k)
{
    const uint32_t from = joint_begin(t, k), to = joint_end(t, k);
    if (from == to) return true;
    if (!t->reflex[k]) {
        for (uint32_t j = from; j != to; j = corner_after(t, j)) add_link(t, k, j, t->c->along[j], false);
        return true;
    }
    sunder_i_arena *s = &t->curve->scratch;
    sunder_i_point along;
    const sunder_i_mark mark = sunder_i_arena_mark(s);
    const bool plain = sunder_i_heading(s, sunder_i_rational_sub(s, t->c->corner[to], t->c->corner[from]), &along);
    sunder_i_arena_release(s, mark);
    if (plain) add_link(t, k, from, along, true);
    return plain;
}

/* Adds what remains of a side between two reflex ends. */
static what_is_left add_shortened(mover *t, size_t k)
{
    const sunder_i_curve_corner from = moved_corner(t, k, t->last[k]), to = moved_corner(t, next_of(t, k), t->first[k]);
    const int way = sunder_i_curve_cmp(t->curve, &to, &from);
    const sunder_i_point d = t->d[k];
    const bool backwards = (way > 0) != (d.x ? d.x > 0 : d.y > 0);
    if (way == 0) return NOTHING;
    add_link(t, k, t->last[k], backwards ? (sunder_i_point){-d.x, -d.y} : d, backwards);
    return backwards ? BACKWARDS : SOME;
}

/* Returns whether the contact at side k can be left. If nothing of side k and the following ones remains, all of them
 * are at one corner, and -C there touches all of them. It can move away from all of them, so that the free set has area
 * there, if all turn right by less than half a turn from the side before to the side after. Else it may be an exact
 * fit. */
static bool can_leave(const mover *t, size_t k)
{
    const size_t before_k = prev_of(t, k);
    if (t->left[k] != NOTHING || t->left[before_k] == NOTHING) return true;
    if (t->left[before_k] == BACKWARDS) return false;
    for (;; k = next_of(t, k)) {
        if (k == before_k || joint_begin(t, k) != joint_end(t, k) || sunder_i_plain_cross(t->d[before_k], t->d[k]) >= 0)
            return false;
        if (t->left[k] != NOTHING) return t->left[k] == SOME;
    }
}

static bool add_ring(mover *t)
{
    sunder_i_figure_convolution *c = t->curve;
    const uint32_t begin = c->links;
    bool fits = true;
    for (size_t k = t->begin; k < t->end; k++) {
        if (!add_joint(t, k)) return false;
        t->left[k] = SOME;
        if (t->first[k] != t->last[k] && t->reflex[k] && t->reflex[next_of(t, k)])
            t->left[k] = (uint8_t)add_shortened(t, k);
        else
            add_link(t, k, joint_end(t, k), t->d[k], false);
    }
    for (uint32_t i = begin; i < c->links; i++) c->link[i].next = i + 1 < c->links ? i + 1 : begin;
    c->ring_end[c->rings++] = c->links;
    for (size_t k = t->begin; k < t->end && fits; k++) fits = can_leave(t, k);
    return fits && c->links >= begin + 3 && sunder_i_steps(t->end - t->begin);
}

/* ---- All of it ---- */

static bool make_room(mover *t)
{
    sunder_i_arena *a = &t->curve->memory;
    const size_t sides = t->figure->sides;
    t->d = sunder_i_arena_alloc(a, sides, sizeof *t->d);
    t->xy = sunder_i_arena_alloc(a, sides, sizeof *t->xy);
    t->c_xy = sunder_i_arena_alloc(a, t->m, sizeof *t->c_xy);
    t->reflex = sunder_i_arena_alloc(a, sides, sizeof *t->reflex);
    t->first = sunder_i_arena_alloc(a, sides, sizeof *t->first);
    t->last = sunder_i_arena_alloc(a, sides, sizeof *t->last);
    t->left = sunder_i_arena_alloc(a, sides, sizeof *t->left);
    t->left_out = sunder_i_arena_alloc(a, t->figure->rings, sizeof *t->left_out);
    t->curve->ring_end = sunder_i_arena_alloc(a, t->figure->rings, sizeof *t->curve->ring_end);
    return !a->failed;
}

/* Decides which rings take part, and returns an upper bound of the number of links. */
static size_t survey_rings(mover *t, bool *fits)
{
    size_t links = 0;
    for (size_t r = 0; *fits && r < t->figure->rings; r++) {
        set_ring(t, r);
        t->left_out[r] = false;
        *fits = find_corners(t);
        if (*fits && is_hole(t)) look_at_hole(t, r, fits);
        if (*fits && !t->left_out[r]) links += count_links(t);
    }
    return links;
}

static bool add_rings(mover *t, size_t links, bool *fits)
{
    sunder_i_figure_convolution *c = t->curve;
    c->link = sunder_i_arena_alloc(&c->memory, links, sizeof *c->link);
    if (!c->link) return false;
    for (size_t r = 0; *fits && r < t->figure->rings; r++) {
        set_ring(t, r);
        if (!t->left_out[r]) *fits = add_ring(t);
    }
    return true;
}

sunder_status sunder_i_figure_convolution_build(sunder_i_figure_convolution *curve, bool *fits, sunder_error *err)
{
    mover t = {.curve = curve, .figure = curve->figure, .c = curve->element, .m = (uint32_t)curve->element->end[0]};
    if (!make_room(&t) || !round_corners(&t)) return sunder_i_failure_cause(err);
    *fits = true;
    const size_t links = survey_rings(&t, fits);
    *fits = *fits && links < UINT32_MAX / 4;
    if (*fits && !add_rings(&t, links, fits)) return sunder_i_failure_cause(err);
    if (curve->memory.failed || curve->scratch.failed || sunder_i_stopped()) return sunder_i_failure_cause(err);
    return SUNDER_OK;
}
