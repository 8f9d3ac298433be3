/* contour.c: a sweep line moves over the rectangles; a segment tree contains the ranges in which it intersects them
 * [LP80]. If rectangles begin and end on the line, those that end are removed first: then the tree covers what
 * rectangles cover on the line itself, and a free place beside a rectangle that ended, or that is about to begin, is
 * contour.
 *
 * Ranks and the stretches between them alternate as elements of the tree: rank r is element 2 r, and the stretch above
 * it 2 r + 1. An open rectangle covers only the elements between its ends, so that single free places are found like
 * stretches, and common boundaries of rectangles that meet end to end remain free. A free place between covered
 * stretches, below a rectangle that ended and one that begins, is a degenerate point: no other rectangle is near it. */
#include "rectilinear/contour.h"

#include "base/watch.h"
#include "rectilinear/cover_tree.h"

typedef sunder_i_ranked_rectangle rectangle;
typedef sunder_i_element_run range;

typedef struct finder {
    const sunder_i_ranked_rectangles *in;
    int axis;
    sunder_i_cover_tree tree;
    uint32_t *ending, *beginning;    /* the rectangles sorted by their end, and by their beginning; on equal lines along
                                      * the line */
    uint32_t *end_of, *beginning_of; /* [places] the index after the last rectangle of each line */
    range *ended, *begun;            /* the united ranges of the rectangles that end, begin, on the current line */
    sunder_i_element_runs runs;
    sunder_i_contour *out;
    bool no_memory;
} finder;

static range range_of(const finder *f, uint32_t i)
{
    const rectangle *r = &f->in->item[i];
    return (range){2 * r->low[!f->axis] + 1, 2 * r->high[!f->axis]};
}

static uint32_t key_of(const rectangle *r, int axis, bool high) { return high ? r->high[axis] : r->low[axis]; }

/* Stable counting sort of the rectangles in the order `from` (NULL: the order of their numbers); end[p] becomes the
 * index after the last rectangle of place p. */
static void sort_by(const sunder_i_ranked_rectangles *in, const uint32_t *from, int axis, bool high, uint32_t *to,
                    uint32_t *end)
{
    uint32_t sum = 0;
    memset(end, 0, in->places[axis] * sizeof *end);
    for (uint32_t i = 0; i < in->n; i++) end[key_of(&in->item[i], axis, high)]++;
    for (uint32_t p = 0; p < in->places[axis]; p++) {
        const uint32_t n = end[p];
        end[p] = sum;
        sum += n;
    }
    for (uint32_t i = 0; i < in->n; i++) {
        const uint32_t r = from ? from[i] : i;
        to[end[key_of(&in->item[r], axis, high)]++] = r;
    }
}

/* ---- One line ---- */

static void add_stretch(finder *f, sunder_i_contour_stretch s)
{
    sunder_i_contour *o = f->out;
    sunder_i_contour_stretch *last = o->stretches ? &o->stretch[o->stretches - 1] : NULL;
    if (last && last->line == s.line && last->to == s.from && last->sides == s.sides) {
        last->to = s.to;
        return;
    }
    if (!sunder_i_reserve(&o->stretch, &o->stretches_capacity, o->stretches + 1, sizeof *o->stretch)) {
        f->no_memory = true;
        return;
    }
    o->stretch[o->stretches++] = s;
}

static void add_point(finder *f, sunder_i_contour_point p)
{
    sunder_i_contour *o = f->out;
    if (!sunder_i_reserve(&o->point, &o->points_capacity, o->points + 1, sizeof *o->point)) {
        f->no_memory = true;
        return;
    }
    o->point[o->points++] = p;
}

/* Lists the free elements of the range r, which rectangles cover on the given sides of the line. If both sides are
 * covered, the range begins and ends with a stretch, so that a single free place has covered elements beside it. */
static void add_free(finder *f, uint32_t line, range r, uint32_t sides)
{
    f->runs.n = 0;
    f->no_memory |= !sunder_i_cover_tree_free_runs(&f->tree, r.from, r.to, &f->runs);
    for (size_t i = 0; i < f->runs.n && !f->no_memory; i++) {
        const uint32_t from = f->runs.item[i].from / 2, to = f->runs.item[i].to / 2;
        if (from < to)
            add_stretch(f, (sunder_i_contour_stretch){line, from, to, sides});
        else if (sides == (SUNDER_I_COVERED_BEFORE | SUNDER_I_COVERED_AFTER))
            add_point(f, (sunder_i_contour_point){line, from});
    }
}

/* Unites the ranges of n rectangles that are sorted along the line. Returns the number of ranges. */
static size_t unite_ranges(const finder *f, const uint32_t *item, size_t n, range *out)
{
    size_t ranges = 0;
    for (size_t i = 0; i < n; i++) {
        const range r = range_of(f, item[i]);
        if (ranges == 0 || r.from >= out[ranges - 1].to)
            out[ranges++] = r;
        else if (r.to > out[ranges - 1].to)
            out[ranges - 1].to = r.to;
    }
    return ranges;
}

/* Processes the line from one beginning or end of a range to the next. */
static void go_along(finder *f, uint32_t line, size_t ended, size_t begun)
{
    const range none = {UINT32_MAX, UINT32_MAX};
    uint32_t at = 0;
    for (size_t i = 0, j = 0; (i < ended || j < begun) && !f->no_memory;) {
        const range e = i < ended ? f->ended[i] : none, b = j < begun ? f->begun[j] : none;
        const uint32_t first = e.from < b.from ? e.from : b.from;
        if (at < first) at = first;
        const uint32_t e_next = at < e.from ? e.from : e.to, b_next = at < b.from ? b.from : b.to;
        const uint32_t next = e_next < b_next ? e_next : b_next;
        const uint32_t before = at >= e.from ? SUNDER_I_COVERED_BEFORE : 0,
                       after = at >= b.from ? SUNDER_I_COVERED_AFTER : 0;
        add_free(f, line, (range){at, next}, before | after);
        at = next;
        i += at >= e.to;
        j += at >= b.to;
    }
}

static void stand_on(finder *f, uint32_t line)
{
    const uint32_t e = line ? f->end_of[line - 1] : 0, b = line ? f->beginning_of[line - 1] : 0;
    const uint32_t *ending = f->ending + e, *beginning = f->beginning + b;
    const size_t ends = f->end_of[line] - e, begins = f->beginning_of[line] - b;
    for (size_t i = 0; i < ends; i++) {
        const range r = range_of(f, ending[i]);
        sunder_i_cover_tree_remove(&f->tree, r.from, r.to);
    }
    go_along(f, line, unite_ranges(f, ending, ends, f->ended), unite_ranges(f, beginning, begins, f->begun));
    for (size_t i = 0; i < begins; i++) {
        const range r = range_of(f, beginning[i]);
        sunder_i_cover_tree_add(&f->tree, r.from, r.to);
    }
    f->no_memory |= !sunder_i_steps((ends + begins) / 8 + 1);
}

bool sunder_i_contour_find(const sunder_i_ranked_rectangles *rectangles, int axis, sunder_i_contour *out)
{
    sunder_i_arena arena = {0};
    const size_t n = rectangles->n, lines = rectangles->places[axis], places = rectangles->places[!axis];
    finder f = {.in = rectangles,
                .axis = axis,
                .ending = sunder_i_arena_alloc(&arena, n, sizeof *f.ending),
                .beginning = sunder_i_arena_alloc(&arena, n, sizeof *f.beginning),
                .end_of = sunder_i_arena_alloc(&arena, lines, sizeof *f.end_of),
                .beginning_of = sunder_i_arena_alloc(&arena, lines, sizeof *f.beginning_of),
                .ended = sunder_i_arena_alloc(&arena, n, sizeof *f.ended),
                .begun = sunder_i_arena_alloc(&arena, n, sizeof *f.begun),
                .out = out};
    uint32_t *along = sunder_i_arena_alloc(&arena, n, sizeof *along);
    uint32_t *place_end = sunder_i_arena_alloc(&arena, places, sizeof *place_end);
    memset(out, 0, sizeof *out);
    f.no_memory = arena.failed || !sunder_i_cover_tree_init(&f.tree, 2 * (uint32_t)places);
    if (!f.no_memory) {
        sort_by(rectangles, NULL, !axis, false, along, place_end);
        sort_by(rectangles, along, axis, true, f.ending, f.end_of);
        sort_by(rectangles, along, axis, false, f.beginning, f.beginning_of);
    }
    for (uint32_t line = 0; line < lines && !f.no_memory; line++) stand_on(&f, line);
    sunder_i_cover_tree_free(&f.tree);
    sunder_i_free(f.runs.item);
    sunder_i_arena_free(&arena);
    if (f.no_memory) sunder_i_contour_free(out);
    return !f.no_memory;
}

void sunder_i_contour_free(sunder_i_contour *contour)
{
    sunder_i_free_all(contour->stretch, contour->point);
    memset(contour, 0, sizeof *contour);
}
