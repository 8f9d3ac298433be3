/* Where segments of the reduced convolution cross: in strips along x, from left to right, those that overlap along both
 * axes, exactly. */
#include "minkowski/reduced_convolution_inner.h"

#include "base/watch.h"
#include "number/trust.h"

#include <string.h>

/* Where segments cross more often, on the average, the outline is a small part of the arrangement. */
#define MOST_CROSSINGS 16
/* Strips are about as high as segments: in lower ones these would be listed more often than it helps. */
#define LEAST_STRIP_BITS 3
#define MOST_STRIP_BITS 8
#define MOST_STRIPS (1u << MOST_STRIP_BITS)
/* More stops of one segment are sorted by merging. */
#define FEW_STOPS 24
/* Quotients of exact numbers as doubles are off by less than 2^-51 each (sunder_i_narrow_value()). */
#define CERTAIN SUNDER_I_DOUBT(0x1p-48)

/* ---- Two segments ---- */

typedef enum meeting { APART, ACROSS, PERHAPS } meeting; /* perhaps: an end of one is on the line of the other */

/* Two segments do not cross in their insides, and may meet for all that is known: they may do so only where one goes on
 * in the other. They are not collinear then (reduced_convolution.c), and meet nowhere else. */
static bool may_meet(sunder_i_reduced *r, uint32_t a, uint32_t b)
{
    const sunder_i_reduced_segment *s = &r->segment[a], *t = &r->segment[b];
    if (s->next == b || t->next == a) return true;
    const sunder_i_point s_end = {s->from.x + s->along.x, s->from.y + s->along.y};
    const sunder_i_point t_end = {t->from.x + t->along.x, t->from.y + t->along.y};
    return sunder_i_segments_meet(r->lattice, s->from, s_end, t->from, t_end) == SUNDER_I_APART;
}

/* For segments s and t: s0 and s1 tell on which side of the line of s the start and the end of t lie, t0 and t1 the
 * same for the line of t and s; from the vector between the two starts. */
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

/* Takes the crossing of two segments, if they cross; there is room for it. False where they meet otherwise. */
static bool cross(sunder_i_reduced *r, uint32_t a, uint32_t b)
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
    uint32_t segment, first; /* first: 1 where no strip below has it */
} member;

typedef struct strips {
    int shift; /* from steps to strips */
    uint32_t n;
    size_t end[MOST_STRIPS]; /* past the last member of each */
    member *member;          /* from left to right in each */
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
        s->end[k] = all; /* where the next goes; in the end the end */
        all += own;
    }
    s->member = sunder_i_arena_alloc(&r->memory, all, sizeof *s->member);
    for (uint32_t a = 0; s->member && a < r->segments; a++)
        for (uint32_t first = r->y[a].low >> s->shift, k = first; k <= r->y[a].high >> s->shift; k++)
            s->member[s->end[k]++] = (member){r->x[a], r->y[a], a, k == first};
    return s->member;
}

/* Collects those behind the first of a list that may meet it. A pair with several strips in common is taken in the
 * lowest of them, where one of the two begins. Without branches, since these would be mispredicted. */
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
        for (size_t k = 0; k < found && *fits; k++) *fits = cross(r, list[i].segment, near[k]);
        *fits = *fits && r->crossings <= most;
    }
    return true;
}

/* ---- Stops in the order of their segments ---- */

/* Puts the stops of one segment in order. False if the work is to stop. */
static bool order(sunder_i_valued *stop, uint32_t n, sunder_i_valued *scratch)
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

/* Lists the stops segment by segment; returns how many one has at most. */
static uint32_t list_stops(sunder_i_reduced *r)
{
    const uint32_t n = r->segments;
    uint32_t before = 0, most = 0;
    memset(r->stop_end, 0, n * sizeof *r->stop_end);
    for (size_t i = 0; i < r->crossings; i++)
        for (int k = 0; k < 2; k++) r->stop_end[r->crossing[i].segment[k]]++;
    for (uint32_t a = 0; a < n; a++) {
        const uint32_t own = r->stop_end[a];
        r->stop_end[a] = before; /* where the next goes; in the end the end */
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

/* *fits is false where doubles do not tell the order, as where three segments meet in one point. */
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
        if (!order(r->stop + begin, r->stop_end[a] - begin, scratch)) return false;
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
