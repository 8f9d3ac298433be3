/* cut.c: a line sweeps over a polygon, along the axis that results in fewer rectangles. The part of the line inside the
 * polygon is a list of spans, between positions where inside and outside change; ends of edges on the line are changes,
 * too, and two changes at one position cancel. A span with the ends of an earlier one continues it; every other earlier
 * span becomes a rectangle. */
#include "base/sort.h"
#include "base/watch.h"
#include "rectilinear/rectangles.h"

/* The largest number of spans that are processed: teeth of n different lengths result in a number quadratic in n. */
#define MOST_LOOKS ((size_t)1 << 24)

typedef struct span {
    int64_t low, high, since; /* since: the beginning of the rectangle that is growing */
} span;

typedef struct cutter {
    const sunder_shape *shape;
    const sunder_i_point *at;
    int axis;       /* the axis along which the line moves */
    uint32_t *edge; /* the edges on the lines, in the order in which the sweep reaches them */
    span *span, *next;
    int64_t *end, *mark; /* end: the ends of the next spans; mark: the ends of the edges on the line */
    size_t spans, looks;
    sunder_i_rectangle_list *out;
    bool no_memory;
} cutter;

static int64_t coordinate_of(const sunder_i_point *p, int axis) { return axis ? p->y : p->x; }

bool sunder_i_is_rectilinear(const sunder_shape *shape, const sunder_i_point *at)
{
    for (uint32_t v = 0; v < shape->vertices; v++) {
        const sunder_i_point a = at[v], b = at[shape->form->cleaned.next[v]];
        if (a.x != b.x && a.y != b.y) return false;
    }
    return true;
}

static int64_t place_of(const cutter *c, uint32_t edge) { return coordinate_of(&c->at[edge], c->axis); }

static int64_t low_of(const cutter *c, uint32_t edge)
{
    const int64_t a = coordinate_of(&c->at[edge], !c->axis),
                  b = coordinate_of(&c->at[c->shape->form->cleaned.next[edge]], !c->axis);
    return a < b ? a : b;
}

static int64_t high_of(const cutter *c, uint32_t edge)
{
    const int64_t a = coordinate_of(&c->at[edge], !c->axis),
                  b = coordinate_of(&c->at[c->shape->form->cleaned.next[edge]], !c->axis);
    return a < b ? b : a;
}

static int compare_edges(void *context, uint32_t e, uint32_t f)
{
    const cutter *c = context;
    const int64_t a = place_of(c, e), b = place_of(c, f);
    if (a != b) return a < b ? -1 : 1;
    const int64_t i = low_of(c, e), j = low_of(c, f);
    return (i > j) - (i < j);
}

static void add_rectangle(cutter *c, const span *s, int64_t until)
{
    sunder_i_rectangle_list *o = c->out;
    if (!sunder_i_reserve(&o->item, &o->capacity, o->n + 1, sizeof *o->item)) {
        c->no_memory = true;
        return;
    }
    sunder_i_rectangle *r = &o->item[o->n++];
    r->low[c->axis] = s->since;
    r->high[c->axis] = until;
    r->low[!c->axis] = s->low;
    r->high[!c->axis] = s->high;
}

/* Stores the ends of the spans beyond the line in c->end: an end of a span before it or of an edge on it, but not of
 * both. Returns their number. */
static size_t find_ends(cutter *c, size_t marks)
{
    size_t n = 0, m = 0;
    for (size_t i = 0; i < 2 * c->spans || m < marks;) {
        const int64_t end = i == 2 * c->spans ? INT64_MAX : i & 1 ? c->span[i / 2].high : c->span[i / 2].low;
        const int64_t mark = m == marks ? INT64_MAX : c->mark[m];
        if (end <= mark) i++;
        if (mark <= end) m++;
        if (end == mark) continue;
        c->end[n++] = end < mark ? end : mark;
    }
    return n;
}

/* Moves past the line at `here`; the edges on the line have `marks` ends. */
static void pass_line(cutter *c, int64_t here, size_t marks)
{
    const size_t n = find_ends(c, marks) / 2;
    size_t old = 0;
    for (size_t i = 0; i < n; i++) {
        span s = {c->end[2 * i], c->end[2 * i + 1], here};
        for (; old < c->spans && c->span[old].low < s.low; old++) add_rectangle(c, &c->span[old], here);
        if (old < c->spans && c->span[old].low == s.low && c->span[old].high == s.high) s.since = c->span[old++].since;
        c->next[i] = s;
    }
    for (; old < c->spans; old++) add_rectangle(c, &c->span[old], here);
    span *swap = c->span;
    c->span = c->next;
    c->next = swap;
    c->looks += c->spans + n;
    c->spans = n;
}

/* Adds the end `at` of an edge. If rings touch, an edge on the line may continue another one; then both ends at the
 * common position cancel. Returns the number of marks. */
static size_t add_mark(cutter *c, size_t marks, int64_t at)
{
    if (marks > 0 && c->mark[marks - 1] == at) return marks - 1;
    c->mark[marks] = at;
    return marks + 1;
}

static void cut_polygon(cutter *c, uint32_t first, uint32_t end)
{
    size_t n = 0;
    for (uint32_t v = first; v < end; v++)
        if (place_of(c, v) == place_of(c, c->shape->form->cleaned.next[v])) c->edge[n++] = v;
    c->no_memory |= !sunder_i_sort_indices(c->edge, n, compare_edges, c);
    c->spans = 0;
    for (size_t i = 0; i < n && !c->no_memory && c->looks < MOST_LOOKS;) {
        const int64_t here = place_of(c, c->edge[i]);
        size_t marks = 0;
        for (; i < n && place_of(c, c->edge[i]) == here; i++) {
            marks = add_mark(c, marks, low_of(c, c->edge[i]));
            marks = add_mark(c, marks, high_of(c, c->edge[i]));
        }
        pass_line(c, here, marks);
        c->no_memory |= !sunder_i_steps(c->spans / 16 + 1);
    }
}

static bool cut_along(const sunder_shape *shape, const sunder_i_point *at, int axis, sunder_i_rectangle_list *out)
{
    sunder_i_arena arena = {0};
    const size_t n = shape->vertices;
    cutter c = {.shape = shape,
                .at = at,
                .axis = axis,
                .edge = sunder_i_arena_alloc(&arena, n, sizeof *c.edge),
                .span = sunder_i_arena_alloc(&arena, n, sizeof *c.span),
                .next = sunder_i_arena_alloc(&arena, n, sizeof *c.next),
                .end = sunder_i_arena_alloc(&arena, 2 * n, sizeof *c.end),
                .mark = sunder_i_arena_alloc(&arena, 2 * n, sizeof *c.mark),
                .out = out,
                .no_memory = arena.failed};
    memset(out, 0, sizeof *out);
    uint32_t first = 0;
    for (uint32_t p = 0; p < shape->form->cleaned.polygons && !c.no_memory; p++) {
        const uint32_t end = shape->form->cleaned.ring_end[shape->form->cleaned.poly_end[p] - 1];
        cut_polygon(&c, first, end);
        first = end;
    }
    if (c.looks >= MOST_LOOKS) out->n = 0;
    sunder_i_arena_free(&arena);
    if (!c.no_memory) return true;
    sunder_i_free(out->item);
    memset(out, 0, sizeof *out);
    return false;
}

bool sunder_i_rectangles_cut(const sunder_shape *shape, const sunder_i_point *at, sunder_i_rectangle_list *out)
{
    sunder_i_rectangle_list other;
    if (!cut_along(shape, at, 0, out)) return false;
    if (!cut_along(shape, at, 1, &other)) {
        sunder_i_free(out->item);
        memset(out, 0, sizeof *out);
        return false;
    }
    if (other.n == 0 || (out->n > 0 && out->n <= other.n)) {
        sunder_i_free(other.item);
    } else {
        sunder_i_free(out->item);
        *out = other;
    }
    return true;
}
