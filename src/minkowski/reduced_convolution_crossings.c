/* reduced_convolution_crossings.c: finds the crossings of the segments: in strips parallel to the x axis, from left to
 * right, pairs that overlap along both axes are tested exactly. */
#include "minkowski/reduced_convolution_inner.h"

#include "base/watch.h"
#include "number/trust.h"

#include <string.h>

/* The largest number of crossings for each segment, on average. If there are more, the outline is a small part of the
 * arrangement, and the general method is faster. */
#define MOST_CROSSINGS 16
/* Bounds for the number of strips. A strip is about as high as a segment: in lower strips segments would be listed more
 * often than this saves tests. */
#define LEAST_STRIP_BITS 3
#define MOST_STRIP_BITS 8
#define MOST_STRIPS (1u << MOST_STRIP_BITS)
/* With more stops than this on one segment, they are sorted by merging. */
#define FEW_STOPS 24
/* Quotients of exact numbers, as doubles, have an error below 2^-51 each (sunder_i_narrow_value()). */
#define CERTAIN SUNDER_I_DOUBT(0x1p-48)

/* ---- Two segments ---- */

typedef enum meeting {
    APART,
    ACROSS,
    PERHAPS
} meeting; /* PERHAPS: an end of one segment is on the line of the
                                                          * other */

/* Returns true if segments a and b, which do not cross in their interiors, meet at most where one continues the other.
 * In that case they are not collinear (reduced_convolution.c), and meet nowhere else. */
static bool may_meet(sunder_i_reduced *r, uint32_t a, uint32_t b)
{
    const sunder_i_reduced_segment *s = &r->segment[a], *t = &r->segment[b];
    if (s->next == b || t->next == a) return true;
    const sunder_i_point s_end = {s->from.x + s->along.x, s->from.y + s->along.y};
    const sunder_i_point t_end = {t->from.x + t->along.x, t->from.y + t->along.y};
    return sunder_i_segments_meet(r->lattice, s->from, s_end, t->from, t_end) == SUNDER_I_APART;
}

/* Classifies two segments with the vectors s and t, where `way` is the vector from the beginning of s to that of t. The
 * signs of s0 and s1 show on which side of the line of s the beginning and the end of t are, those of t0 and t1 the
 * same for the line of t and the ends of s. */
static meeting brief_meeting(sunder_i_point s, sunder_i_point t, sunder_i_point way)
{
    const int64_t d = sunder_i_brief_cross(s, t);
    const int64_t s0 = sunder_i_brief_cross(s, way), t0 = sunder_i_brief_cross(way, t), s1 = s0 + d, t1 = t0 - d;
    if ((s0 == 0) | (s1 == 0) | (t0 == 0) | (t1 == 0)) return PERHAPS;
    return ((s0 ^ s1) & (t0 ^ t1)) < 0 ? ACROSS : APART;
}

static meeting narrow_meeting(sunder_i_point s, sunder_i_point t, sunder_i_point way)
{
    const sunder_i_det d = sunder_i_narrow_cross(s, t);
    const sunder_i_det s0 = sunder_i_narrow_cross(s, way), t0 = sunder_i_narrow_cross(way, t), s1 = s0 + d, t1 = t0 - d;
    if ((s0 == 0) | (s1 == 0) | (t0 == 0) | (t1 == 0)) return PERHAPS;
    return (((s0 < 0) != (s1 < 0)) & ((t0 < 0) != (t1 < 0))) ? ACROSS : APART;
}

/* Adds the crossing of segments a and b, if they cross; the list must have room for it. Returns false if they meet in
 * another way. */
static bool cross_segments(sunder_i_reduced *r, uint32_t a, uint32_t b)
{
    const sunder_i_point s = r->segment[a].along, t = r->segment[b].along;
    const sunder_i_point way = sunder_i_narrow_sub(r->segment[b].from, r->segment[a].from);
    const meeting how = r->brief ? brief_meeting(s, t, way) : narrow_meeting(s, t, way);
    if (how == PERHAPS) return may_meet(r, a, b);
    if (how == APART) return true;
    double d, s0, t0;
    if (r->brief) {
        d = (double)sunder_i_brief_cross(s, t);
        s0 = (double)sunder_i_brief_cross(s, way);
        t0 = (double)sunder_i_brief_cross(way, t);
    } else {
        d = sunder_i_det_double(sunder_i_narrow_cross(s, t));
        s0 = sunder_i_det_double(sunder_i_narrow_cross(s, way));
        t0 = sunder_i_det_double(sunder_i_narrow_cross(way, t));
    }
    r->lattice->counts.segment_intersections++;
    r->crossing[r->crossings++] = (sunder_i_reduced_crossing){{a, b}, {t0 / d, -s0 / d}, t0 < 0};
    return true;
}

/* ---- Strips ---- */

/* A segment in a strip. */
typedef struct member {
    sunder_i_steps_along x, y;
    uint32_t segment, first; /* first: 1 if no lower strip contains the segment */
} member;

typedef struct strips {
    int shift; /* the shift that converts steps to strips */
    uint32_t n;
    size_t end[MOST_STRIPS]; /* the index after the last segment of each strip */
    member *member;          /* the segments of each strip, from left to right */
} strips;

static void choose_strips(const sunder_i_reduced *r, strips *s)
{
    double high = 0;
    int bits = LEAST_STRIP_BITS;
    for (uint32_t a = 0; a < r->segments; a++) high += r->y[a].high - r->y[a].low;
    while (bits < MOST_STRIP_BITS && high * (2 << bits) < (double)r->segments * (1 << SUNDER_I_STEP_BITS)) bits++;
    s->shift = SUNDER_I_STEP_BITS - bits;
    s->n = 1u << bits;
}

static bool list_members(sunder_i_reduced *r, strips *s)
{
    size_t all = 0;
    choose_strips(r, s);
    memset(s->end, 0, s->n * sizeof *s->end);
    for (uint32_t a = 0; a < r->segments; a++)
        for (uint32_t k = r->y[a].low >> s->shift; k <= r->y[a].high >> s->shift; k++) s->end[k]++;
    for (uint32_t k = 0; k < s->n; k++) {
        const size_t own = s->end[k];
        s->end[k] = all; /* the index of the next segment of strip k; after the loop below the end of its segments */
        all += own;
    }
    s->member = sunder_i_arena_alloc(&r->memory, all, sizeof *s->member);
    for (uint32_t a = 0; s->member && a < r->segments; a++)
        for (uint32_t first = r->y[a].low >> s->shift, k = first; k <= r->y[a].high >> s->shift; k++)
            s->member[s->end[k]++] = (member){r->x[a], r->y[a], a, k == first};
    return s->member;
}

/* Stores in `near` the segments after the first one of the list that may meet it, and returns their number. A pair with
 * several strips in common is only used in the lowest of them, where one of the two begins. The loop avoids branches,
 * since these would be mispredicted. */
static size_t find_near(const member *list, size_t n, uint32_t *near)
{
    const member own = list[0];
    size_t found = 0;
    for (size_t i = 1; i < n && list[i].x.low <= own.x.high; i++) {
        near[found] = list[i].segment;
        found += (list[i].y.low <= own.y.high) & (list[i].y.high >= own.y.low) & (own.first | list[i].first);
    }
    return found;
}

static bool cross_strip(sunder_i_reduced *r, const member *list, size_t n, uint32_t *near, bool *fits)
{
    const size_t most = MOST_CROSSINGS * (size_t)r->segments;
    for (size_t i = 0; i < n && *fits; i++) {
        const size_t found = find_near(list + i, n - i, near), need = r->crossings + found;
        if (!sunder_i_steps(found + 1) ||
            (need > r->crossings_capacity &&
             !sunder_i_arena_reserve(&r->memory, &r->crossing, &r->crossings_capacity, need, sizeof *r->crossing)))
            return false;
        r->lattice->counts.orientation_tests += 4 * found;
        for (size_t k = 0; k < found && *fits; k++) *fits = cross_segments(r, list[i].segment, near[k]);
        *fits = *fits && r->crossings <= most;
    }
    return true;
}

/* ---- Stops in the order of their segments ---- */

/* Sorts the stops of one segment. Returns false if cancelled. */
static bool sort_stops(sunder_i_valued *stop, uint32_t n, sunder_i_valued *scratch)
{
    if (n > FEW_STOPS) {
        memcpy(scratch, stop, n * sizeof *stop);
        if (!sunder_i_sort_valued(scratch, n)) return false;
        memcpy(stop, scratch, n * sizeof *stop);
        return true;
    }
    for (uint32_t i = 1; i < n; i++) {
        const sunder_i_valued own = stop[i];
        uint32_t k = i;
        for (; k > 0 && stop[k - 1].value > own.value; k--) stop[k] = stop[k - 1];
        stop[k] = own;
    }
    return true;
}

/* Lists the stops, segment by segment. Returns the largest number of stops on a segment. */
static uint32_t list_stops(sunder_i_reduced *r)
{
    const uint32_t n = r->segments;
    uint32_t before = 0, most = 0;
    memset(r->stop_end, 0, n * sizeof *r->stop_end);
    for (size_t i = 0; i < r->crossings; i++)
        for (int k = 0; k < 2; k++) r->stop_end[r->crossing[i].segment[k]]++;
    for (uint32_t a = 0; a < n; a++) {
        const uint32_t own = r->stop_end[a];
        r->stop_end[a] = before; /* the index of the next stop of segment a; after the loop below the end of its
                                  * stops */
        before += own;
        most = own > most ? own : most;
    }
    for (uint32_t i = 0; i < r->crossings; i++)
        for (uint32_t k = 0; k < 2; k++) {
            const sunder_i_reduced_crossing *x = &r->crossing[i];
            r->stop[r->stop_end[x->segment[k]]++] = (sunder_i_valued){x->at[k], 2 * i + k, 0};
        }
    return most;
}

/* Sorts the stops along their segments. *fits becomes false if doubles do not decide the order, for example if three
 * segments meet in one point. Returns false if out of memory. */
static bool order_stops(sunder_i_reduced *r, bool *fits)
{
    const size_t stops = 2 * r->crossings;
    r->stop_end = sunder_i_arena_alloc(&r->memory, r->segments, sizeof *r->stop_end);
    r->stop = sunder_i_arena_alloc(&r->memory, stops, sizeof *r->stop);
    r->place = sunder_i_arena_alloc(&r->memory, stops, sizeof *r->place);
    if (r->memory.failed) return false;
    const uint32_t most = list_stops(r);
    sunder_i_valued *scratch = sunder_i_arena_alloc(&r->memory, 2 * (size_t)most, sizeof *scratch);
    if (!scratch) return false;
    bool certain = true;
    for (uint32_t a = 0, begin = 0; a < r->segments; begin = r->stop_end[a++]) {
        if (!sort_stops(r->stop + begin, r->stop_end[a] - begin, scratch)) return false;
        for (uint32_t i = begin + 1; i < r->stop_end[a]; i++)
            certain &= r->stop[i].value - r->stop[i - 1].value > CERTAIN;
    }
    for (uint32_t i = 0; i < stops; i++) r->place[r->stop[i].item] = i;
    *fits = certain;
    return true;
}

bool sunder_i_reduced_cross(sunder_i_reduced *r, bool *fits)
{
    strips s;
    uint32_t *near = sunder_i_arena_alloc(&r->memory, r->segments, sizeof *near);
    if (!near || !list_members(r, &s)) return false;
    for (uint32_t k = 0; k < s.n && *fits; k++) {
        const size_t from = k ? s.end[k - 1] : 0;
        if (!cross_strip(r, s.member + from, s.end[k] - from, near, fits)) return false;
    }
    return !*fits || order_stops(r, fits);
}
