#include "minkowski/cells.h"

#include "number/sort.h"
#include "predicate/predicate.h"

#include <math.h>
#include <string.h>

/* Up to so many pairs of a line and a subsum other than its own make a leaf, and always where there are so few subsums: then
 * looking at a pair costs less than sorting it out. Measured on stars, combs, forks and random polygons. */
#define LEAF_PAIRS 48
#define LEAF_SUBSUMS 2
/* After so many splits in a row that thin out less than a tenth a cell is left as it is: a few lines are then bundles of coincident
 * sides, which no split will part and every split doubles; many lines may be a cluster in a corner of the cell (or truly
 * concurrent, and then only one half keeps them). */
#define STUBBORN_SPLITS_FEW 3
#define STUBBORN_SPLITS_MANY 12
#define FEW_LINES 4
#define MANY_SIDES 500

/* A side as doubles, in the units of sunder_i_approx(): where it starts and its vector. */
typedef struct approx_side {
    double ax, ay, dx, dy;
} approx_side;

typedef struct box {
    double low[2], high[2];
} box;

typedef struct entry {
    uint32_t subsum, sides; /* how many entries of the side list are its */
} entry;

typedef struct cell {
    box b;
    size_t entry_from, entry_to, side_from, side_to;
    uint32_t stubborn;
    int axis;     /* to split across */
    double share; /* of the whole work, taking each half as half of its parent's */
} cell;

typedef struct builder {
    const sunder_i_subsums *subsums;
    const sunder_i_lines *lines;
    const sunder_sum_options *options;
    sunder_i_cell_pairs *out;
    approx_side *side;
    box *reach;       /* [subsums] bounding boxes, widened by the error */
    double error;     /* bound on the distance error of a start point, see filter_subsum() */
    entry *entries;   /* lists of all cells on the stack, one after the other */
    size_t entries_n, entries_capacity;
    uint32_t *sides;
    size_t sides_n, sides_capacity;
    cell *stack;
    size_t stack_n, stack_capacity;
    uint32_t *stamp;  /* [lines] the last cell that counted the line */
    uint32_t *single; /* [2 * lines] the last cell with a subsum whose only side is on the line, on either bank */
    uint32_t cells;   /* stamps given out */
    double done;      /* share of the work, for progress */
    bool no_memory;
} builder;

/* fmin and fmax without their care for NaN, which cannot come up here. */
static inline double least(double a, double b) { return a < b ? a : b; }
static inline double most_of(double a, double b) { return a > b ? a : b; }

static int64_t diff(sunder_i_lattice *l, int64_t b, int64_t a) { return l->narrow ? b - a : sunder_i_lattice_sub(l, b, a); }

static const box nothing = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};

static void grow(box *all, const box *part)
{
    for (int k = 0; k < 2; k++) {
        all->low[k] = least(all->low[k], part->low[k]);
        all->high[k] = most_of(all->high[k], part->high[k]);
    }
}

static void widen(box *b, double by)
{
    for (int k = 0; k < 2; k++) {
        b->low[k] -= by;
        b->high[k] += by;
    }
}

static bool apart(const box *a, const box *b)
{
    return a->low[0] > b->high[0] || a->high[0] < b->low[0] || a->low[1] > b->high[1] || a->high[1] < b->low[1];
}

/* Doubles of all sides; false if memory is out. Vectors are taken from exact differences, so that their error is relative to
 * themselves. */
static bool approximate(builder *b, box *all)
{
    const sunder_i_subsums *s = b->subsums;
    sunder_i_lattice *l = s->lattice;
    double most = 0;
    b->side = sunder_i_alloc(s->sides, sizeof *b->side);
    b->reach = sunder_i_alloc(s->n, sizeof *b->reach);
    if (!b->side || !b->reach) return false;
    *all = nothing;
    for (size_t i = 0; i < s->n; i++) {
        const uint32_t first = sunder_i_subsum_first(s, i), end = s->end[i];
        box own = nothing;
        for (uint32_t k = first; k < end; k++) {
            const sunder_i_point from = s->corner[k], to = s->corner[k + 1 < end ? k + 1 : first];
            const double x = sunder_i_approx(l, from.x), y = sunder_i_approx(l, from.y);
            b->side[k] = (approx_side){x, y, sunder_i_approx(l, diff(l, to.x, from.x)),
                                       sunder_i_approx(l, diff(l, to.y, from.y))};
            own.low[0] = least(own.low[0], x);
            own.high[0] = most_of(own.high[0], x);
            own.low[1] = least(own.low[1], y);
            own.high[1] = most_of(own.high[1], y);
            most = most_of(most, most_of(fabs(x), fabs(y)));
        }
        b->reach[i] = own;
        grow(all, &own);
    }
    /* With u = 2^-53 and all coordinates and box corners within `most` (cells lie within the box of all): the start point is off by
     * 2u * most (conversion), differences of coordinates by as much again, products and their difference by 3u of products up to
     * 2 * most * |d|. Together below 16 u * most * (|dx| + |dy|); twice that is used. Subnormals: approx_shift keeps the
     * largest coordinates near 2^500, and the 2^-900 covers what underflows. */
    b->error = 0x1p-48 * most + 0x1p-900;
    b->out->most = most;
    /* A candidate on the very border must not be missed. */
    widen(all, b->error);
    for (size_t i = 0; i < s->n; i++) widen(&b->reach[i], b->error);
    return !l->arena.failed;
}

/* The part of a box that the segment's own box covers; false if there is none. */
static bool clip(const builder *b, const approx_side *s, const box *c, box *part)
{
    const double x2 = s->ax + s->dx, y2 = s->ay + s->dy, e = b->error;
    part->low[0] = most_of(c->low[0], least(s->ax, x2) - e);
    part->high[0] = least(c->high[0], most_of(s->ax, x2) + e);
    part->low[1] = most_of(c->low[1], least(s->ay, y2) - e);
    part->high[1] = least(c->high[1], most_of(s->ay, y2) + e);
    return part->low[0] <= part->high[0] && part->low[1] <= part->high[1];
}

static bool push_pair(builder *b, uint32_t line, uint32_t subsum)
{
    sunder_i_cell_pairs *p = b->out;
    if (p->n == p->capacity && !sunder_i_reserve(&p->pair, &p->capacity, p->n + 1, sizeof *p->pair)) {
        b->no_memory = true;
        return false;
    }
    p->pair[p->n++] = (uint64_t)line << 32 | subsum;
    return true;
}

/* The box is inside `one`, or inside `one` and `other` together: every candidate of the parent's lists that passes through it is
 * covered there. */
static void close_cell(builder *b, const cell *parent, const box *c, uint32_t one, uint32_t other)
{
    box part;
    b->cells++;
    for (size_t i = parent->side_from; i < parent->side_to; i++) {
        const uint32_t k = b->sides[i], line = b->lines->of[k];
        if (line == SUNDER_I_NO_LINE || b->stamp[line] == b->cells || !clip(b, &b->side[k], c, &part)) continue;
        b->stamp[line] = b->cells;
        if (!push_pair(b, line, one) || (other != one && !push_pair(b, line, other))) return;
    }
}

/* All pairs of a leaf, but for subsums that are nowhere near the one candidate of a line. */
static void open_leaf(builder *b, const cell *c)
{
    box part;
    const uint32_t once = ++b->cells, again = ++b->cells; /* stamps of lines met once, and more often */
    for (size_t i = c->side_from; i < c->side_to; i++) {
        const uint32_t k = b->sides[i], line = b->lines->of[k];
        if (line == SUNDER_I_NO_LINE || !clip(b, &b->side[k], &c->b, &part)) continue;
        b->out->live[k] = b->out->live_line[line] = true;
        b->stamp[line] = b->stamp[line] == once || b->stamp[line] == again ? again : once;
    }
    const uint32_t pushed = ++b->cells;
    for (size_t i = c->side_from; i < c->side_to; i++) {
        const uint32_t k = b->sides[i], line = b->lines->of[k];
        if (line == SUNDER_I_NO_LINE || b->stamp[line] == pushed || !clip(b, &b->side[k], &c->b, &part)) continue;
        const bool alone = b->stamp[line] == once;
        b->stamp[line] = pushed;
        for (size_t e = c->entry_from; e < c->entry_to; e++) {
            const uint32_t subsum = b->entries[e].subsum;
            if (alone && apart(&b->reach[subsum], &part)) continue;
            if (!push_pair(b, line, subsum)) return;
        }
    }
}

/* Do two half-planes cover the box? f and g are the cross products of filter_subsum(), positive inside; if f + r g > 0 all over the box
 * for some r >= 0, then g > 0 wherever f <= 0. The r that makes the slopes cancel where the sides run against each other is tried. */
static bool both_hold(const builder *b, const approx_side *f, const approx_side *g, const box *c)
{
    if (f->dx * g->dx + f->dy * g->dy >= 0) return false;
    const double cx = c->low[0] / 2 + c->high[0] / 2, cy = c->low[1] / 2 + c->high[1] / 2;
    const double hx = c->high[0] / 2 - c->low[0] / 2, hy = c->high[1] / 2 - c->low[1] / 2;
    const double fs = fabs(f->dx) + fabs(f->dy), gs = fabs(g->dx) + fabs(g->dy), r = fs / gs;
    const double fc = f->dx * (cy - f->ay) - f->dy * (cx - f->ax), gc = g->dx * (cy - g->ay) - g->dy * (cx - g->ax);
    const double reach = hx * fabs(f->dy + r * g->dy) + hy * fabs(f->dx + r * g->dx);
    /* The errors of both, and those of the additions here, which are relative to terms below (hx + hy) * fs. */
    const double error = 4 * b->error * fs + 0x1p-48 * (hx + hy) * fs + 0x1p-900;
    return fc + r * gc - reach > error;
}

#define SINGLES 8 /* so many subsums with one side in the cell are tried in pairs; more are rare */

/* Two subsums, each with a single side in the box, that cover it together: seams between neighbouring pieces. */
static bool find_two(const builder *b, const cell *c, const box *where_to, uint32_t two[2])
{
    uint32_t side[SINGLES], subsum[SINGLES], n = 0;
    size_t at = c->side_from;
    for (size_t e = c->entry_from; e < c->entry_to && n < SINGLES; at += b->entries[e].sides, e++)
        if (b->entries[e].sides == 1) {
            side[n] = b->sides[at];
            subsum[n++] = b->entries[e].subsum;
        }
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < i; j++)
            if (both_hold(b, &b->side[side[i]], &b->side[side[j]], where_to)) {
                two[0] = subsum[j];
                two[1] = subsum[i];
                return true;
            }
    return false;
}

/* In the box the subsum is one half-plane, and one of the same is there already: within the box they are the same set, with the
 * same candidate along its border. */
static bool known_half_plane(builder *b, uint32_t side, uint32_t stamp)
{
    const uint32_t line = b->lines->of[side];
    if (line == SUNDER_I_NO_LINE) return false;
    uint32_t *seen = &b->single[2 * (size_t)line + (b->subsums->rank[side] >= b->subsums->classes)];
    if (*seen == stamp) return true;
    *seen = stamp;
    return false;
}

/* Shrinks the cell to what its candidates in the box need, and chooses the axis to split across. Returns how many lines they
 * are on. */
static size_t shrink(builder *b, cell *c, const box *whole)
{
    size_t lines = 0;
    double span[2] = {0, 0}; /* of all candidates together, along each axis */
    box need = nothing, part;
    b->cells++;
    for (size_t i = c->side_from; i < c->side_to; i++) {
        const uint32_t line = b->lines->of[b->sides[i]];
        if (line == SUNDER_I_NO_LINE || !clip(b, &b->side[b->sides[i]], whole, &part)) continue;
        grow(&need, &part);
        span[0] += part.high[0] - part.low[0];
        span[1] += part.high[1] - part.low[1];
        lines += b->stamp[line] != b->cells;
        b->stamp[line] = b->cells;
    }
    c->b = need;
    /* Across the axis along which candidates are short beside the cell: fewer of them fall into both halves. */
    c->axis = span[0] * (need.high[1] - need.low[1]) > span[1] * (need.high[0] - need.low[0]);
    return lines;
}

/* One half of a cell while its lists are made. */
typedef struct half {
    box b;
    double cx, cy;     /* centre */
    entry *entries;
    uint32_t *sides;
    size_t entries_n, sides_n;
    bool held;
    uint32_t holder;   /* the subsum that holds it */
    uint32_t stamp;    /* of known_half_plane() */
} half;

/* Takes note of what one subsum is in one half: its sides that pass are behind the half's list, `sides` of them. */
static void settle_entry(builder *b, half *h, uint32_t subsum, uint32_t sides)
{
    if (sides == 0) {
        h->held = true;
        h->holder = subsum;
    } else if (sides > 1 || !known_half_plane(b, h->sides[h->sides_n], h->stamp)) {
        h->entries[h->entries_n++] = (entry){subsum, sides};
        h->sides_n += sides;
    }
}

/* One subsum against one half, from its side i on; n of the sides before that pass. */
static void filter_one(builder *b, half *h, const uint32_t *side, const entry *source, uint32_t i, uint32_t n, double hx,
                       double hy)
{
    if (h->held) return;
    uint32_t *out = h->sides + h->sides_n;
    for (; i < source->sides; i++) {
        const approx_side *s = &b->side[side[i]];
        const double adx = fabs(s->dx), ady = fabs(s->dy), reach = hx * ady + hy * adx;
        const double error = b->error * (adx + ady) + 0x1p-900;
        const double c = s->dx * (h->cy - s->ay) - s->dy * (h->cx - s->ax);
        if (c + reach < -error) return; /* all of the half is beyond this side */
        out[n] = side[i];
        n += !(c - reach > error); /* else all of it is on the inner side, and the side need not be kept */
    }
    settle_entry(b, h, source->subsum, n);
}

/* One subsum against both halves at once, for as long as it may reach into both; hx, hy: half the extent of each half. */
static void filter_subsum(builder *b, half h[2], const uint32_t *side, const entry *source, double hx, double hy)
{
    uint32_t *out0 = h[0].sides + h[0].sides_n, *out1 = h[1].sides + h[1].sides_n;
    uint32_t i = 0, n0 = 0, n1 = 0;
    bool miss0 = h[0].held || apart(&b->reach[source->subsum], &h[0].b);
    bool miss1 = h[1].held || apart(&b->reach[source->subsum], &h[1].b);
    for (; i < source->sides && !miss0 && !miss1; i++) {
        const approx_side *s = &b->side[side[i]];
        const double adx = fabs(s->dx), ady = fabs(s->dy), reach = hx * ady + hy * adx;
        const double error = b->error * (adx + ady) + 0x1p-900;
        const double c0 = s->dx * (h[0].cy - s->ay) - s->dy * (h[0].cx - s->ax);
        const double c1 = s->dx * (h[1].cy - s->ay) - s->dy * (h[1].cx - s->ax);
        out0[n0] = out1[n1] = side[i];
        n0 += !(c0 - reach > error);
        n1 += !(c1 - reach > error);
        miss0 = c0 + reach < -error;
        miss1 = c1 + reach < -error;
    }
    if (!miss0) filter_one(b, &h[0], side, source, i, n0, hx, hy);
    if (!miss1) filter_one(b, &h[1], side, source, i, n1, hx, hy);
}

/* A cell with many sides that splits well is split on, across its longer axis, without a closer look. */
static size_t halve(cell *c, const half *h)
{
    c->axis = h->b.high[1] - h->b.low[1] > h->b.high[0] - h->b.low[0];
    return h->sides_n;
}

/* What is left of a half when its lists are made: a cell to split further, or settled. */
static void settle_half(builder *b, const cell *parent, const half *h)
{
    if (h->held) {
        close_cell(b, parent, &h->b, h->holder, h->holder);
        b->done += parent->share / 2;
        return;
    }
    cell c = {h->b, b->entries_n, b->entries_n + h->entries_n, b->sides_n, b->sides_n + h->sides_n, 0, 0,
              parent->share / 2};
    memmove(b->entries + c.entry_from, h->entries, h->entries_n * sizeof *h->entries);
    memmove(b->sides + c.side_from, h->sides, h->sides_n * sizeof *h->sides);
    uint32_t two[2];
    if (find_two(b, &c, &h->b, two)) {
        close_cell(b, parent, &h->b, two[0], two[1]);
        b->done += c.share;
        return;
    }
    c.stubborn = 10 * h->sides_n < 9 * (parent->side_to - parent->side_from) ? 0 : parent->stubborn + 1;
    const size_t lines = h->sides_n > MANY_SIDES && c.stubborn == 0 ? halve(&c, h) : shrink(b, &c, &h->b);
    const uint32_t patience = lines <= FEW_LINES ? STUBBORN_SPLITS_FEW : STUBBORN_SPLITS_MANY;
    const bool leaf =
        h->entries_n <= LEAF_SUBSUMS || lines * (h->entries_n - 1) <= LEAF_PAIRS || c.stubborn >= patience;
    if (lines > 0 && !leaf) {
        b->entries_n = c.entry_to;
        b->sides_n = c.side_to;
        b->stack[b->stack_n++] = c;
        return;
    }
    if (lines > 0) open_leaf(b, &c);
    b->done += c.share;
}

/* Room on the stack for the lists of both halves, the second behind the longest that the first can be; one more side is written
 * than kept. */
static bool reserve_halves(builder *b, const cell *c)
{
    const size_t e = c->entry_to - c->entry_from, s = c->side_to - c->side_from + 1;
    if (sunder_i_reserve(&b->entries, &b->entries_capacity, b->entries_n + 2 * e, sizeof *b->entries) &&
        sunder_i_reserve(&b->sides, &b->sides_capacity, b->sides_n + 2 * s, sizeof *b->sides) &&
        sunder_i_reserve(&b->stack, &b->stack_capacity, b->stack_n + 2, sizeof *b->stack))
        return true;
    b->no_memory = true;
    return false;
}

static void split(builder *b, const cell *c)
{
    if (!reserve_halves(b, c)) return;
    const size_t e = c->entry_to - c->entry_from, s = c->side_to - c->side_from + 1;
    half h[2];
    memset(h, 0, sizeof h);
    h[0].b = h[1].b = c->b;
    h[0].b.high[c->axis] = h[1].b.low[c->axis] = c->b.low[c->axis] / 2 + c->b.high[c->axis] / 2;
    for (int k = 0; k < 2; k++) {
        h[k].cx = h[k].b.low[0] / 2 + h[k].b.high[0] / 2;
        h[k].cy = h[k].b.low[1] / 2 + h[k].b.high[1] / 2;
        h[k].entries = b->entries + b->entries_n + (size_t)k * e;
        h[k].sides = b->sides + b->sides_n + (size_t)k * s;
        h[k].stamp = ++b->cells;
    }
    /* The halves are of one size up to rounding; the larger stands for both. */
    const double hx = most_of(h[0].b.high[0] - h[0].b.low[0], h[1].b.high[0] - h[1].b.low[0]) / 2;
    const double hy = most_of(h[0].b.high[1] - h[0].b.low[1], h[1].b.high[1] - h[1].b.low[1]) / 2;
    size_t from = c->side_from;
    for (size_t i = c->entry_from; i < c->entry_to && !(h[0].held && h[1].held); i++) {
        filter_subsum(b, h, b->sides + from, &b->entries[i], hx, hy);
        from += b->entries[i].sides;
    }
    settle_half(b, c, &h[0]);
    if (!b->no_memory) settle_half(b, c, &h[1]);
}

/* Twice the area of a subsum, nearly. */
static double extent_of(const builder *b, size_t subsum)
{
    const uint32_t first = sunder_i_subsum_first(b->subsums, subsum);
    const approx_side *o = &b->side[first];
    double area = 0;
    for (uint32_t k = first; k < b->subsums->end[subsum]; k++) {
        const approx_side *s = &b->side[k];
        area += (s->ax - o->ax) * s->dy - (s->ay - o->ay) * s->dx;
    }
    return area;
}

static int compare_extents(void *context, uint32_t a, uint32_t b)
{
    const double *extent = context;
    return (extent[a] < extent[b]) - (extent[a] > extent[b]);
}

/* The root holds every side of every subsum, the largest subsums first: those are the ones that close cells. */
static bool make_root(builder *b, const box *all, cell *root)
{
    const sunder_i_subsums *s = b->subsums;
    double *extent = sunder_i_alloc(s->n, sizeof *extent);
    uint32_t *order = sunder_i_alloc(s->n, sizeof *order);
    bool ok = extent && order && sunder_i_reserve(&b->entries, &b->entries_capacity, s->n, sizeof *b->entries) &&
              sunder_i_reserve(&b->sides, &b->sides_capacity, s->sides, sizeof *b->sides);
    for (uint32_t i = 0; ok && i < s->n; i++) {
        order[i] = i;
        extent[i] = extent_of(b, i);
    }
    ok = ok && sunder_i_sort_indices(order, s->n, compare_extents, extent);
    for (size_t i = 0; ok && i < s->n; i++) {
        const uint32_t first = sunder_i_subsum_first(s, order[i]), end = s->end[order[i]];
        b->entries[b->entries_n++] = (entry){order[i], end - first};
        for (uint32_t k = first; k < end; k++) b->sides[b->sides_n++] = k;
    }
    *root = (cell){*all, 0, b->entries_n, 0, b->sides_n, 0, 0, 1};
    root->axis = all->high[1] - all->low[1] > all->high[0] - all->low[0];
    sunder_i_free(extent);
    sunder_i_free(order);
    return ok;
}

static sunder_status descend(builder *b, sunder_error *err)
{
    box all;
    cell root;
    if (!approximate(b, &all) || !make_root(b, &all, &root)) return sunder_i_no_memory(err);
    split(b, &root);
    unsigned tick = 0;
    while (b->stack_n > 0 && !b->no_memory) {
        const cell c = b->stack[--b->stack_n];
        b->entries_n = c.entry_to; /* lists above belong to cells already done */
        b->sides_n = c.side_to;
        if (b->options && b->options->progress && (++tick & 63) == 0 &&
            !b->options->progress(b->done, b->options->progress_user))
            return sunder_i_fail(err, SUNDER_ECANCEL, "%s", sunder_status_string(SUNDER_ECANCEL));
        split(b, &c);
    }
    return b->no_memory ? sunder_i_no_memory(err) : SUNDER_OK;
}

sunder_status sunder_i_cells_pair(const sunder_i_subsums *subsums, const sunder_i_lines *lines,
                                  const sunder_sum_options *options, sunder_i_cell_pairs *out, sunder_error *err)
{
    memset(out, 0, sizeof *out);
    if (subsums->sides == 0) return SUNDER_OK;
    builder b = {.subsums = subsums, .lines = lines, .options = options, .out = out};
    out->live = sunder_i_calloc(subsums->sides, sizeof *out->live);
    out->live_line = sunder_i_calloc(lines->n, sizeof *out->live_line);
    b.stamp = sunder_i_calloc(lines->n, sizeof *b.stamp);
    b.single = sunder_i_calloc(2 * (size_t)lines->n, sizeof *b.single);
    const bool ok = out->live && out->live_line && b.stamp && b.single;
    const sunder_status status = ok ? descend(&b, err) : sunder_i_no_memory(err);
    sunder_i_free(b.side);
    sunder_i_free(b.reach);
    sunder_i_free(b.entries);
    sunder_i_free(b.sides);
    sunder_i_free(b.stack);
    sunder_i_free(b.stamp);
    sunder_i_free(b.single);
    if (status != SUNDER_OK) sunder_i_cell_pairs_free(out);
    return status;
}

void sunder_i_cell_pairs_free(sunder_i_cell_pairs *pairing)
{
    sunder_i_free(pairing->pair);
    sunder_i_free(pairing->live);
    sunder_i_free(pairing->live_line);
    memset(pairing, 0, sizeof *pairing);
}
