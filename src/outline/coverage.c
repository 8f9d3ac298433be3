/* coverage.c: see coverage.h. Coverage is computed for one line after the other. A part is convex, so that its
 * intersection with a line is found by bisection: among its ranks for the corners that are lowest and highest across
 * the line, then in each of the two chains between them for the crossing. Events are sorted by fractions along the line
 * (degree 2, compared in degree 4), and counted.
 *
 * Intervals of cover are open and those of candidates closed, so that each position has three states: just before it,
 * at it, and just after it. */
#include "outline/coverage.h"

#include "base/invariant.h"
#include "base/sort.h"
#include "base/watch.h"
#include "outline/events.h"
#include "predicate/narrow.h"

#include <string.h>

typedef sunder_i_line_state state;

#define NO_CORNER SUNDER_I_NO_CORNER

typedef struct finder {
    const sunder_i_convex_pieces *parts;
    const sunder_i_lines *lines;
    const uint8_t *fate;
    sunder_i_coverage *out;
    sunder_i_supporting_line line; /* the current line */
    sunder_i_events events;        /* the events of the current line */
    bool no_memory;
} finder;

static inline void add_event(finder *f, sunder_i_fraction at, state change, uint32_t corner, uint32_t side)
{
    if (!sunder_i_events_reserve(&f->events, 1))
        f->no_memory = true;
    else
        f->events.event[f->events.n++] = (sunder_i_event){at, change, corner, side};
}

/* ---- One part and one line ---- */

typedef struct polygon {
    const sunder_i_convex_pieces *s;
    uint32_t first, n;
} polygon;

/* Returns corner i, cyclically; i < 2 n. */
static sunder_i_point corner_of(const polygon *p, uint32_t i)
{
    return p->s->corner[p->first + (i < p->n ? i : i - p->n)];
}

/* Returns the first corner whose outgoing side has a rank above r, cyclically; n if the first side is already beyond a
 * full turn. That corner is extreme in the direction normal to r. */
static uint32_t first_above(const polygon *p, uint32_t r)
{
    const uint32_t *rank = p->s->rank + p->first;
    uint32_t low = 0, high = p->n;
    while (low < high) {
        const uint32_t middle = (low + high) / 2;
        if (rank[middle] > r)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

/* The position of a corner relative to a line: its side, and on a narrow lattice its height: the cross product of the
 * line's direction with the vector from line->a to the corner. */
typedef struct stand {
    int side;
    sunder_i_det height;
} stand;

static stand stand_of(const polygon *p, const sunder_i_supporting_line *line, uint32_t i)
{
    sunder_i_lattice *l = p->s->lattice;
    if (!l->narrow) return (stand){sunder_i_orient(l, line->a, line->b, corner_of(p, i)), 0};
    l->counts.orientation_tests++;
    const sunder_i_det height =
        sunder_i_narrow_cross(p->s->direction[line->class], sunder_i_narrow_sub(corner_of(p, i), line->a));
    return (stand){sunder_i_det_sign(height), height};
}

/* Returns the crossing of the line with the side between two corners of different heights. */
static sunder_i_fraction crossing_of_side(const polygon *p, const sunder_i_supporting_line *line, uint32_t i,
                                          stand at_i, uint32_t j, stand at_j)
{
    sunder_i_lattice *l = p->s->lattice;
    if (!l->narrow) return sunder_i_crossing(l, line->a, line->b, corner_of(p, i), corner_of(p, j));
    l->counts.segment_intersections++;
    const sunder_i_point c = sunder_i_narrow_sub(corner_of(p, i), line->a),
                         d = sunder_i_narrow_sub(corner_of(p, j), line->a);
    return sunder_i_narrow_fraction(sunder_i_narrow_cross(c, d), at_j.height - at_i.height);
}

/* Adds the event with the cover `change` where the chain of corners from .. to crosses the line. Its first corner is
 * strictly on one side of the line, and its last one is not on that side. */
static void cross_chain(finder *f, const polygon *p, const sunder_i_supporting_line *line, uint32_t from, stand at_from,
                        uint32_t to, stand at_to, int32_t change)
{
    uint32_t low = from, high = to; /* corner low is strictly on the side of the first corner; corner high is not */
    stand at_low = at_from, at_high = at_to;
    while (high - low > 1) {
        const uint32_t middle = (low + high) / 2;
        const stand at = stand_of(p, line, middle);
        if (at.side == at_from.side)
            low = middle, at_low = at;
        else
            high = middle, at_high = at;
    }
    add_event(f, crossing_of_side(p, line, low, at_low, high, at_high), (state){change, 0, 0, 0}, NO_CORNER,
              p->first + (low < p->n ? low : low - p->n));
}

static uint32_t side_before(const polygon *p, uint32_t k) { return k > p->first ? k - 1 : p->first + p->n - 1; }

/* Adds the events of a side of a part that lies on the line: between the ends of this side the part covers the left
 * (with `left`) or the right side of the line. */
static void rest_side(finder *f, const polygon *p, const sunder_i_supporting_line *line, uint32_t side, bool left)
{
    sunder_i_lattice *l = p->s->lattice;
    const uint32_t before = side_before(p, side), next = side + 1 < p->first + p->n ? side + 1 : p->first;
    const sunder_i_fraction from = sunder_i_along(l, line->a, line->b, p->s->corner[side]);
    const sunder_i_fraction to = sunder_i_along(l, line->a, line->b, p->s->corner[next]);
    const int32_t live = f->fate[side] == SUNDER_I_OPEN;
    if (left) {
        add_event(f, from, (state){0, 1, 0, live}, side, before);
        add_event(f, to, (state){0, -1, 0, -live}, next, next);
    } else {
        add_event(f, to, (state){0, 0, 1, live}, next, next);
        add_event(f, from, (state){0, 0, -1, -live}, side, before);
    }
}

/* Adds the events of a part that rests on the line: sides with the rank of the line end in corner i (several if a piece
 * has straight corners); or the part touches the line there. */
static void rest_on(finder *f, const polygon *p, const sunder_i_supporting_line *line, uint32_t i, uint32_t rank,
                    bool left)
{
    const uint32_t end = p->first + (i < p->n ? i : 0);
    uint32_t side = p->first + (i ? i : p->n) - 1;
    if (p->s->rank[side] != rank) {
        add_event(f, sunder_i_along(p->s->lattice, line->a, line->b, p->s->corner[end]), (state){0, 0, 0, 0}, end,
                  side);
        return;
    }
    for (; p->s->rank[side] == rank; side = side_before(p, side)) rest_side(f, p, line, side, left);
}

static void meet_part(finder *f, const sunder_i_supporting_line *line, uint32_t part)
{
    const sunder_i_convex_pieces *s = f->parts;
    const uint32_t first = sunder_i_convex_pieces_first(s, part), forward = line->class, back = forward + s->classes;
    const polygon p = {s, first, s->end[part] - first};
    /* sides with ranks between forward and back rise to the left of the line, the others fall */
    const uint32_t lowest = first_above(&p, forward), highest = first_above(&p, back);
    const stand low = stand_of(&p, line, lowest), high = stand_of(&p, line, highest);
    if (low.side < 0 && high.side > 0) {
        const uint32_t up_to = highest >= lowest ? highest : highest + p.n;
        const uint32_t down_to = lowest > highest ? lowest : lowest + p.n;
        cross_chain(f, &p, line, highest, high, down_to, low, 1);
        cross_chain(f, &p, line, lowest, low, up_to, high, -1);
    } else if (low.side == 0)
        rest_on(f, &p, line, lowest, forward, true);
    else if (high.side == 0)
        rest_on(f, &p, line, highest, back, false);
}

/* ---- Along one line ---- */

static bool is_uncovered(const state *s) { return s->domain > 0 && s->cover == 0; }

static uint8_t covered_banks(const state *s)
{
    return (uint8_t)((s->left > 0 ? SUNDER_I_BANK_LEFT : 0) | (s->right > 0 ? SUNDER_I_BANK_RIGHT : 0));
}

/* Adds the line of a side to `lines`, unless it is parallel to the current line or known. */
static void note_side(const finder *f, uint32_t side, sunder_i_vertex_lines *lines)
{
    if (side == SUNDER_I_NO_SIDE || lines->others == 2) return;
    const uint32_t other = f->lines->of[side];
    if (other == SUNDER_I_NO_LINE || (lines->others && lines->other[0] == other) ||
        sunder_i_lines_class(f->lines, other) == f->line.class)
        return;
    lines->other[lines->others++] = other;
}

/* Returns the vertex of the result at `at`, adding it if it is new. Most are identified by the lines that meet there; a
 * known corner of a part is a lattice point, which is cheaper to compare. */
static uint32_t add_vertex(finder *f, const sunder_i_fraction *at, uint32_t corner, const sunder_i_vertex_lines *lines)
{
    sunder_i_lattice *l = f->parts->lattice;
    const sunder_i_supporting_line *line = &f->line;
    bool is_new = false;
    if (l->narrow && lines->others > 0) {
        const sunder_i_point u = sunder_i_narrow_sub(line->b, line->a);
        const uint32_t known =
            sunder_i_vertex_table_find(&f->out->vertices, (double)line->a.x + at->value * (double)u.x,
                                       (double)line->a.y + at->value * (double)u.y, lines, &is_new);
        if (known != SUNDER_I_NO_VERTEX) return known;
    }
    const sunder_i_hpoint p = corner == NO_CORNER ? sunder_i_hpoint_at(l, line->a, line->b, at)
                                                  : sunder_i_hpoint_of(l, f->parts->corner[corner]);
    const uint32_t vertex = sunder_i_vertex_table_add(&f->out->vertices, &p, lines, is_new);
    if (vertex == SUNDER_I_NO_VERTEX) f->no_memory = true;
    return vertex;
}

static void add_stretch(finder *f, sunder_i_outline_stretch stretch)
{
    sunder_i_coverage *o = f->out;
    if (o->stretches == o->stretches_capacity &&
        !sunder_i_reserve(&o->stretch, &o->stretches_capacity, o->stretches + 1, sizeof *o->stretch)) {
        f->no_memory = true;
        return;
    }
    o->stretch[o->stretches++] = stretch;
}

/* What happens at one position of the line. */
typedef struct place {
    size_t end; /* the end of its events in the sorted list */
    int32_t cover_ends, domain_starts;
    uint32_t corner; /* a corner of a part there, or NO_CORNER */
    sunder_i_vertex_lines lines;
} place;

/* Reads the events of one position and updates the state. */
static place pass_place(const finder *f, uint32_t line, size_t from, state *s)
{
    const sunder_i_valued *order = f->events.order;
    place p = {from, 0, 0, NO_CORNER, {line, {0, 0}, 0}};
    do {
        const sunder_i_event *e = &f->events.event[order[p.end].item];
        p.cover_ends += e->change.cover < 0;
        p.domain_starts += e->change.domain > 0;
        if (e->corner != NO_CORNER) p.corner = e->corner;
        note_side(f, e->side, &p.lines);
        s->cover += e->change.cover;
        s->left += e->change.left;
        s->right += e->change.right;
        s->domain += e->change.domain;
    } while (++p.end < f->events.n && !order[p.end].mark);
    return p;
}

/* Processes the events of one line, position by position. */
static void sweep_over_line(finder *f, uint32_t number)
{
    state s = {0, 0, 0, 0};
    uint32_t last = 0; /* the vertex at which the open stretch begins, while uncovered(&s) */
    for (size_t i = 0; i < f->events.n;) {
        const sunder_i_event *here = &f->events.event[f->events.order[i].item];
        const state before = s;
        const place p = pass_place(f, number, i, &s);
        /* at the position itself intervals of cover are open, and candidates closed */
        SUNDER_I_ASSERT(s.cover >= 0 && s.left >= 0 && s.right >= 0 && s.domain >= 0);
        const bool point_free = before.cover == p.cover_ends && before.domain + p.domain_starts > 0;
        if (point_free) {
            const uint32_t vertex = add_vertex(f, &here->at, p.corner, &p.lines);
            if (f->no_memory) return;
            if (is_uncovered(&before))
                add_stretch(f, (sunder_i_outline_stretch){number, last, vertex, covered_banks(&before)});
            last = vertex;
        }
        i = p.end;
    }
    SUNDER_I_ASSERT(s.cover == 0 && s.left == 0 && s.right == 0 && s.domain == 0); /* every interval has ended */
}

static void sweep_line(finder *f, uint32_t number, const uint32_t *part, size_t n)
{
    f->events.n = 0;
    f->line = sunder_i_lines_get(f->lines, number);
    for (size_t i = 0; i < n && !f->no_memory; i++) {
        if (!sunder_i_step()) f->no_memory = true;
        if (i == 0 || part[i] != part[i - 1]) meet_part(f, &f->line, part[i]);
    }
    if (!f->no_memory && !sunder_i_events_sort(&f->events, f->parts->lattice)) f->no_memory = true;
    if (f->parts->lattice->arena.failed) f->no_memory = true; /* the order of the events is then undefined */
    if (!f->no_memory) sweep_over_line(f, number);
}

/* ---- Sides that are boundary completely ---- */

/* Returns the vertex at a corner of a part. between: the sides that arrive at the corner and leave it are both
 * SUNDER_I_WHOLE, so that no other part meets the corner and the vertex is new. */
static uint32_t corner_vertex(finder *f, uint32_t corner, bool between)
{
    const sunder_i_hpoint p = sunder_i_hpoint_of(f->parts->lattice, f->parts->corner[corner]);
    const uint32_t vertex = between ? sunder_i_vertex_table_append(&f->out->vertices, &p)
                                    : sunder_i_vertex_table_add(&f->out->vertices, &p, NULL, false);
    if (vertex == SUNDER_I_NO_VERTEX) f->no_memory = true;
    return vertex;
}

static void take_whole_sides(finder *f, uint32_t first, uint32_t end)
{
    const sunder_i_convex_pieces *s = f->parts;
    bool before = f->fate[end - 1] == SUNDER_I_WHOLE; /* whether the side before k is whole */
    uint32_t first_vertex = SUNDER_I_NO_VERTEX, to = SUNDER_I_NO_VERTEX;
    for (uint32_t k = first; k < end; k++) {
        const bool whole = f->fate[k] == SUNDER_I_WHOLE;
        if (whole) {
            const uint32_t next = k + 1 < end ? k + 1 : first;
            const uint32_t from = before && k > first ? to : corner_vertex(f, k, before);
            if (k == first) first_vertex = from;
            to = next == first && first_vertex != SUNDER_I_NO_VERTEX
                     ? first_vertex
                     : corner_vertex(f, next, f->fate[next] == SUNDER_I_WHOLE);
            if (f->no_memory) return;
            const uint32_t line = f->lines->of[k];
            add_stretch(f, s->rank[k] < s->classes ? (sunder_i_outline_stretch){line, from, to, SUNDER_I_BANK_LEFT}
                                                   : (sunder_i_outline_stretch){line, to, from, SUNDER_I_BANK_RIGHT});
        }
        before = whole;
    }
}

/* Reserves memory for what most lines need, a stretch and one new vertex: growing step by step would need several times
 * that. Returns false if out of memory. */
static bool reserve_usual(finder *f, const sunder_i_culled *culled)
{
    sunder_i_coverage *o = f->out;
    size_t live = 0;
    for (uint32_t i = 0; i < f->lines->n; i++) live += culled->live_line[i];
    const size_t usual = live + live / 8;
    return sunder_i_vertex_table_init(&o->vertices, f->parts->lattice, culled->most, usual, culled->whole) &&
           sunder_i_reserve(&o->stretch, &o->stretches_capacity, usual + culled->whole + 1, sizeof *o->stretch);
}

/* Processes the lines that pass through an open leaf; all others are covered completely. */
static bool sweep_lines(finder *f, const sunder_i_line_parts *by_line)
{
    size_t first = 0;
    for (uint32_t number = 0; number < f->lines->n; number++) {
        const size_t end = by_line->end[number];
        if (end > first) sweep_line(f, number, by_line->part + first, end - first);
        if (f->no_memory || !sunder_i_step()) return false;
        first = end;
    }
    return true;
}

static bool find_all(finder *f, sunder_i_culled *culled)
{
    sunder_i_line_parts by_line = {0};
    bool ok = reserve_usual(f, culled) &&
              sunder_i_pairs_by_line(&culled->pairs, culled->live_line, f->lines->n, (uint32_t)f->parts->n, &by_line);
    sunder_i_pairs_free(&culled->pairs);
    ok = ok && sweep_lines(f, &by_line);
    sunder_i_line_parts_free(&by_line);
    for (size_t i = 0; ok && culled->whole && i < f->parts->n; i++) {
        take_whole_sides(f, sunder_i_convex_pieces_first(f->parts, i), f->parts->end[i]);
        ok = !f->no_memory;
    }
    return ok && !f->parts->lattice->arena.failed;
}

sunder_status sunder_i_coverage_find(const sunder_i_convex_pieces *parts, const sunder_i_lines *lines,
                                     sunder_i_culled *culled, sunder_i_coverage *out, sunder_error *err)
{
    memset(out, 0, sizeof *out);
    finder f = {.parts = parts, .lines = lines, .fate = culled->fate, .out = out};
    const bool ok = find_all(&f, culled);
    sunder_i_events_free(&f.events);
    if (ok) return SUNDER_OK;
    sunder_i_coverage_free(out);
    return sunder_i_failure_cause(err);
}

void sunder_i_coverage_free(sunder_i_coverage *coverage)
{
    sunder_i_vertex_table_free(&coverage->vertices);
    sunder_i_free(coverage->stretch);
    memset(coverage, 0, sizeof *coverage);
}
