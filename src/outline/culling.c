/* culling.c: see culling.h. The hierarchy of cells, from the root down: a cell is divided into halves; each part is
 * tested against each half: the half is outside it, inside it, or sides of it pass through. Each half is closed, kept
 * as a leaf, or pushed on the stack (culling.h). tuning.h contains the numbers that decide when a cell is divided
 * further. */
#include "outline/culling_inner.h"

#include "base/watch.h"
#include "outline/tuning.h"

#include <string.h>

/* With coordinates near 2^500 the directions of sides this short are inexact in doubles. */
#define SHORT_SIDE 0x1p-500

/* Returns whether the half-planes left of the sides f and g together certainly cover the box. Let f and g also stand
 * for the cross products of the sides with the vector to a point, positive inside; if f + r g > 0 in the whole box for
 * some r >= 0, then g > 0 wherever f <= 0. The r is tried for which the slopes cancel if the sides have opposite
 * directions. */
static bool both_hold(const builder *b, const approx_side *f, const approx_side *g, const box *c)
{
    if (f->dx * g->dx + f->dy * g->dy >= 0) return false;
    const double cx = c->low[0] / 2 + c->high[0] / 2, cy = c->low[1] / 2 + c->high[1] / 2;
    const double hx = c->high[0] / 2 - c->low[0] / 2, hy = c->high[1] / 2 - c->low[1] / 2;
    const double fs = fabs(f->dx) + fabs(f->dy), gs = fabs(g->dx) + fabs(g->dy), r = fs / gs;
    if (fs < SHORT_SIDE || gs < SHORT_SIDE) return false;
    const double fc = f->dx * (cy - f->ay) - f->dy * (cx - f->ax), gc = g->dx * (cy - g->ay) - g->dy * (cx - g->ax);
    const double reach = hx * fabs(f->dy + r * g->dy) + hy * fabs(f->dx + r * g->dx);
    /* the errors of both, and those of the additions here, which are relative to terms below (hx + hy) * fs */
    const double error = SUNDER_I_DOUBT(4 * b->error * fs + 0x1p-48 * (hx + hy) * fs + SUNDER_I_APPROX_UNDERFLOW);
    return fc + r * gc - reach > error;
}

/* Returns whether two parts, each with a single side in the box, cover it together, as at seams between neighbouring
 * pieces; two[] becomes these parts. */
static bool find_two(const builder *b, const cell *c, const box *where_to, uint32_t two[2])
{
    uint32_t side[SINGLES], part[SINGLES], n = 0;
    size_t at = c->run_from;
    for (size_t e = c->entry_from; e < c->entry_to && n < SINGLES; at += b->entries[e].runs, e++)
        if (b->entries[e].runs == 1 && b->runs[at] <= b->single_most) {
            side[n] = b->runs[at];
            part[n++] = b->entries[e].part;
        }
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < i; j++)
            if (both_hold(b, &b->side[side[i]], &b->side[side[j]], where_to)) {
                two[0] = part[j];
                two[1] = part[i];
                return true;
            }
    return false;
}

/* Shrinks the cell to the box of its candidates, and chooses the axis across which it is divided. Returns the number of
 * lines of the candidates. */
static size_t shrink_cell(builder *b, cell *c, const box *whole)
{
    size_t lines = 0;
    double span[2] = {0, 0}; /* the sum of the extents of all candidates along each axis */
    box need = nothing;
    b->cells++;
    sunder_i_cells_gather(b, c->run_from, c->run_to, whole);
    for (size_t i = 0; i < b->crossing_n; i++) {
        const crossing *x = &b->crossing[i];
        grow_box(&need, &x->clipped);
        span[0] += x->clipped.high[0] - x->clipped.low[0];
        span[1] += x->clipped.high[1] - x->clipped.low[1];
        lines += b->stamp[x->line] != b->cells;
        b->stamp[x->line] = b->cells;
    }
    c->b = need;
    /* The cell is divided across the axis along which candidates are short in proportion to the cell, so that fewer of
     * them are in both halves; if both axes are nearly equal, across the longer side of the cell, since else the ends
     * of sides along one line would shrink cells to that line. */
    const double w = need.high[0] - need.low[0], h = need.high[1] - need.low[1];
    const double across[2] = {span[0] * h, span[1] * w};
    const bool even = across[0] <= AXES_EVEN * across[1] && across[1] <= AXES_EVEN * across[0];
    c->axis = even ? h > w : across[0] > across[1];
    return lines;
}

/* One half of a cell while its lists are made. */
typedef struct half {
    box b;
    double cx, cy; /* the centre */
    entry *entries;
    run *runs;
    size_t entries_n, runs_n, sides;
    bool held;
    uint32_t holder; /* the part that contains it, if `held` */
    uint32_t stamp;  /* the stamp used by is_half_plane_known() */
} half;

/* Returns whether a part that is one half-plane in this half, with the given side, need not be listed: a listed part is
 * the same half-plane, with the same candidate on its boundary, or a parallel one that is certainly wider. Then this
 * part adds nothing within the half except its boundary, which in the second case is covered. If this part is the wider
 * one, it replaces the listed one. */
static bool is_half_plane_known(builder *b, half *h, uint32_t part, uint32_t side)
{
    const approx_side *s = &b->side[side];
    const double length = fabs(s->dx) + fabs(s->dy);
    if (length < SHORT_SIDE) return false;
    /* the depth of the centre in it */
    const double depth = (s->dx * (h->cy - s->ay) - s->dy * (h->cx - s->ax)) / length;
    half_plane *known = &b->widest[b->parts->rank[side]];
    if (known->stamp != h->stamp) {
        *known = (half_plane){h->stamp, side, depth, (uint32_t)h->entries_n, (uint32_t)h->runs_n};
        return false;
    }
    const uint32_t line = b->lines->of[side], other = known->side;
    if (line != SUNDER_I_NO_LINE && line == b->lines->of[other]) {
        b->shared[line] = true;
        return true;
    }
    /* each has an error of b->error, and the quotients a smaller one */
    if (known->depth > depth + 4 * b->error) {
        sunder_i_cells_cover(b, side, h->entries[known->entry].part);
        return true;
    }
    if (!(depth > known->depth + 4 * b->error)) return false;
    h->entries[known->entry].part = part;
    h->runs[known->run] = side;
    known->side = side;
    known->depth = depth;
    sunder_i_cells_cover(b, other, part);
    return true;
}

/* Records how a part meets half `h`: n runs with `sides` sides in total pass through the half; they were written after
 * the half's list of runs. */
static void settle_entry(builder *b, half *h, uint32_t part, uint32_t n, uint32_t sides)
{
    if (n == 0) {
        h->held = true;
        h->holder = part;
    } else if (sides > 1 || !is_half_plane_known(b, h, part, h->runs[h->runs_n])) {
        h->entries[h->entries_n++] = (entry){part, n};
        h->runs_n += n;
        h->sides += sides;
    }
}

enum {
    BEYOND,
    WITHIN,
    ACROSS
}; /* the position of a box relative to a side: certainly outside, certainly inside, or
                                  * neither */

/* Returns the position of the half relative to the line through the start of `at` in the direction of s; hx and hy are
 * half the widths of the half. */
static int side_of_half(const builder *b, const half *h, const approx_side *s, const approx_side *at, double hx,
                        double hy)
{
    const double adx = fabs(s->dx), ady = fabs(s->dy), reach = hx * ady + hy * adx;
    const double error = SUNDER_I_DOUBT(b->error * (adx + ady) + SUNDER_I_APPROX_UNDERFLOW);
    const double c = s->dx * (h->cy - at->ay) - s->dy * (h->cx - at->ax);
    return c + reach < -error ? BEYOND : c - reach > error ? WITHIN : ACROSS;
}

/* What pass_run() keeps of a run in a half: n runs, with `sides` sides in total. */
typedef struct passed {
    bool beyond; /* the whole half is outside the part */
    uint32_t n, sides;
} passed;

/* Writes those parts of a run of several sides that pass through the half to `out`.
 *
 * The start of the run is inside all its sides, and their directions are between those of the first and the last one: a
 * region inside the two lines with these directions through the start is inside all sides. */
static passed pass_run(const builder *b, const half *h, run r, double hx, double hy, run *out)
{
    struct {
        uint32_t from, n;
    } todo[8], at = {run_from(b, r), run_end(b, r) - run_from(b, r)}; /* at most 2^5 sides, divided repeatedly */
    passed p = {false, 0, 0};
    for (uint32_t waiting = 0;;) {
        const approx_side *first = &b->side[at.from], *last = first + at.n - 1, *middle = first + at.n / 2;
        const int where = side_of_half(b, h, first, first, hx, hy);
        if (where == BEYOND) return (passed){true, 0, 0};
        if (where == ACROSS || (at.n > 1 && side_of_half(b, h, last, first, hx, hy) != WITHIN)) {
            if (at.n > 1 && fabs(last->ax - first->ax) + fabs(last->ay - first->ay) > hx + hy) {
                todo[waiting].from = at.from + at.n / 2;
                todo[waiting++].n = at.n - at.n / 2;
                at.n /= 2;
                continue;
            }
            if (at.n > 1 && side_of_half(b, h, middle, middle, hx, hy) == BEYOND) return (passed){true, 0, 0};
            out[p.n++] = (at.n - 1) << RUN_BITS | at.from;
            p.sides += at.n;
        }
        if (waiting == 0) return p;
        at = todo[--waiting];
    }
}

/* Tests one part against one half, from run i on; n of the runs before i pass, with n + `more` sides. */
static void filter_one(builder *b, half *h, const run *runs, const entry *source, uint32_t i, uint32_t n, uint32_t more,
                       double hx, double hy)
{
    if (h->held) return;
    run *out = h->runs + h->runs_n;
    const run single_most = b->single_most;
    for (; i < source->runs; i++) {
        const run r = runs[i];
        if (r > single_most) {
            const passed p = pass_run(b, h, r, hx, hy, out + n);
            if (p.beyond) return;
            n += p.n;
            more += p.sides - p.n;
            continue;
        }
        const approx_side *s = &b->side[r];
        const double adx = fabs(s->dx), ady = fabs(s->dy), reach = hx * ady + hy * adx;
        const double error = SUNDER_I_DOUBT(b->error * (adx + ady) + SUNDER_I_APPROX_UNDERFLOW);
        const double c = s->dx * (h->cy - s->ay) - s->dy * (h->cx - s->ax);
        if (c + reach < -error) return; /* the whole half is outside this side */
        out[n] = r;
        n += !(c - reach > error); /* else the whole half is on the inner side, and the side is not kept */
    }
    settle_entry(b, h, source->part, n, n + more);
}

/* Returns whether the part is completely in one half, and then lists it there with all its sides. This is the case for
 * most parts of the upper cells. */
static bool keep_whole(const builder *b, half h[2], const run *runs, const entry *source)
{
    const box *reach = &b->reach[source->part];
    const int k = boxes_apart(reach, &h[0].b);
    if (h[k].held || !box_within(reach, &h[k].b) || !boxes_apart(reach, &h[1 - k].b)) return false;
    run *out = h[k].runs + h[k].runs_n;
    uint32_t sides = 0;
    for (uint32_t i = 0; i < source->runs; i++) {
        sides += run_end(b, runs[i]) - run_from(b, runs[i]);
        out[i] = runs[i];
    }
    h[k].entries[h[k].entries_n++] = *source;
    h[k].runs_n += source->runs;
    h[k].sides += sides;
    return true;
}

/* Tests one part against both halves at once, as long as it may reach both; hx and hy are half the widths of each
 * half. */
static void filter_part(builder *b, half h[2], const run *runs, const entry *source, double hx, double hy)
{
    run *out0 = h[0].runs + h[0].runs_n, *out1 = h[1].runs + h[1].runs_n;
    const run single_most = b->single_most;
    uint32_t i = 0, n0 = 0, n1 = 0, more0 = 0, more1 = 0;
    bool miss0 = h[0].held || boxes_apart(&b->reach[source->part], &h[0].b);
    bool miss1 = h[1].held || boxes_apart(&b->reach[source->part], &h[1].b);
    for (; i < source->runs && !miss0 && !miss1; i++) {
        const run r = runs[i];
        if (r > single_most) {
            const passed p0 = pass_run(b, &h[0], r, hx, hy, out0 + n0), p1 = pass_run(b, &h[1], r, hx, hy, out1 + n1);
            miss0 = p0.beyond;
            miss1 = p1.beyond;
            n0 += p0.n;
            n1 += p1.n;
            more0 += p0.sides - p0.n;
            more1 += p1.sides - p1.n;
            continue;
        }
        const approx_side *s = &b->side[r];
        const double adx = fabs(s->dx), ady = fabs(s->dy), reach = hx * ady + hy * adx;
        const double error = SUNDER_I_DOUBT(b->error * (adx + ady) + SUNDER_I_APPROX_UNDERFLOW);
        const double c0 = s->dx * (h[0].cy - s->ay) - s->dy * (h[0].cx - s->ax);
        const double c1 = s->dx * (h[1].cy - s->ay) - s->dy * (h[1].cx - s->ax);
        out0[n0] = out1[n1] = r;
        n0 += !(c0 - reach > error);
        n1 += !(c1 - reach > error);
        miss0 = c0 + reach < -error;
        miss1 = c1 + reach < -error;
    }
    if (!miss0) filter_one(b, &h[0], runs, source, i, n0, more0, hx, hy);
    if (!miss1) filter_one(b, &h[1], runs, source, i, n1, more1, hx, hy);
}

/* Chooses the longer axis for a cell with many sides that divides well, without examining its candidates. Returns the
 * number of sides, an upper bound of the number of lines of candidates. */
static size_t choose_longer_axis(cell *c, const half *h)
{
    c->axis = h->b.high[1] - h->b.low[1] > h->b.high[0] - h->b.low[0];
    return h->sides;
}

/* Chooses an axis along which a division can still separate sides: no cell becomes smaller than the error of the start
 * points, which matters if details are small compared with their coordinates. Returns false if there is no such
 * axis. */
static bool choose_axis(const builder *b, cell *c)
{
    const double room = 4 * b->error;
    if (c->b.high[c->axis] - c->b.low[c->axis] <= room) c->axis = !c->axis;
    return c->b.high[c->axis] - c->b.low[c->axis] > room;
}

/* Returns the number of pairs of a side and a part other than its own. */
static double pairs_of(size_t sides, size_t entries) { return entries > 1 ? (double)sides * (double)(entries - 1) : 0; }

/* Returns the factor, at least 1, by which the pairs have increased from the ancestor with the fewest pairs to the two
 * halves of the cell. */
static double growth_of(const cell *c, const half h[2])
{
    const double before = pairs_of(c->sides, c->entry_to - c->entry_from);
    double after = 0;
    for (int k = 0; k < 2; k++) after += h[k].held ? 0 : pairs_of(h[k].sides, h[k].entries_n);
    return before > 0 ? sunder_i_greater(1, c->growth * (after / before)) : 1;
}

/* Decides about a half whose lists are made: it becomes a cell to divide further, a leaf, or is closed. */
static void settle_half(builder *b, const cell *parent, const half *h, double growth)
{
    if (h->held) {
        sunder_i_cells_close(b, parent, &h->b, h->holder, h->holder);
        b->done += parent->share / 2;
        return;
    }
    cell c = {h->b,
              b->entries_n,
              b->entries_n + h->entries_n,
              b->runs_n,
              b->runs_n + h->runs_n,
              h->sides,
              0,
              0,
              parent->share / 2,
              growth,
              0};
    memmove(b->entries + c.entry_from, h->entries, h->entries_n * sizeof *h->entries);
    memmove(b->runs + c.run_from, h->runs, h->runs_n * sizeof *h->runs);
    if (h->entries_n == 1) {
        sunder_i_cells_lone_leaf(b, &c);
        b->done += c.share;
        return;
    }
    uint32_t two[2];
    if (find_two(b, &c, &h->b, two)) {
        sunder_i_cells_close(b, parent, &h->b, two[0], two[1]);
        b->done += c.share;
        return;
    }
    c.stubborn = KEPT(h->sides, parent->sides) ? parent->stubborn + 1 : 0;
    const bool grown = growth > MOST_GROWTH && !b->trial.on;
    const bool stubborn = c.stubborn >= STUBBORN_SPLITS + h->entries_n / STUBBORN_SHARE;
    const bool at_once = h->sides > MANY_SIDES && c.stubborn == 0 && !grown && !stubborn && choose_axis(b, &c);
    const size_t lines = at_once ? choose_longer_axis(&c, h) : shrink_cell(b, &c, &h->b);
    c.trial = grown && pairs_of(lines, h->entries_n) >= TRIAL_PAIRS ? pairs_of(lines, h->entries_n) : 0;
    const bool enough = stubborn || (grown && !(c.trial > 0));
    const size_t few = h->entries_n == 2 ? LEAF_PAIRS_OF_TWO : LEAF_PAIRS;
    const bool leaf = enough || lines * (h->entries_n - 1) <= few || (lines > 0 && !choose_axis(b, &c));
    if (lines > 0 && !leaf) {
        b->entries_n = c.entry_to;
        b->runs_n = c.run_to;
        b->stack[b->stack_n++] = c;
        return;
    }
    if (lines > 0) sunder_i_cells_open_leaf(b, &c);
    b->done += c.share;
}

/* Makes room on the stack for the lists of both halves, the second after the longest possible list of the first; one
 * more side is written than kept. Sets b->no_memory and returns false if out of memory. */
static bool reserve_halves(builder *b, const cell *c)
{
    const size_t e = c->entry_to - c->entry_from, s = c->sides + 1;
    if (sunder_i_reserve(&b->entries, &b->entries_capacity, b->entries_n + 2 * e, sizeof *b->entries) &&
        sunder_i_reserve(&b->runs, &b->runs_capacity, b->runs_n + 2 * s, sizeof *b->runs) &&
        sunder_i_reserve(&b->stack, &b->stack_capacity, b->stack_n + 2, sizeof *b->stack))
        return true;
    b->no_memory = true;
    return false;
}

/* Moves the halves on the stack over their cell's lists, which are needed again only if the cell is divided on trial.
 * So all lists together are hardly longer than those of the root. */
static void take_place(builder *b, const cell *c, size_t waiting)
{
    const size_t entries = c->entry_to - c->entry_from, runs = c->run_to - c->run_from;
    memmove(b->entries + c->entry_from, b->entries + c->entry_to, (b->entries_n - c->entry_to) * sizeof *b->entries);
    memmove(b->runs + c->run_from, b->runs + c->run_to, (b->runs_n - c->run_to) * sizeof *b->runs);
    b->entries_n -= entries;
    b->runs_n -= runs;
    for (size_t i = waiting; i < b->stack_n; i++) {
        cell *of = &b->stack[i];
        of->entry_from -= entries;
        of->entry_to -= entries;
        of->run_from -= runs;
        of->run_to -= runs;
    }
}

static void split_cell(builder *b, const cell *c)
{
    if (!reserve_halves(b, c)) return;
    b->trial.spent += (double)c->sides;
    const size_t e = c->entry_to - c->entry_from, s = c->sides + 1;
    half h[2];
    memset(h, 0, sizeof h);
    h[0].b = h[1].b = c->b;
    h[0].b.high[c->axis] = h[1].b.low[c->axis] = c->b.low[c->axis] / 2 + c->b.high[c->axis] / 2;
    for (int k = 0; k < 2; k++) {
        h[k].cx = h[k].b.low[0] / 2 + h[k].b.high[0] / 2;
        h[k].cy = h[k].b.low[1] / 2 + h[k].b.high[1] / 2;
        h[k].entries = b->entries + b->entries_n + (size_t)k * e;
        h[k].runs = b->runs + b->runs_n + (size_t)k * s;
        h[k].stamp = ++b->cells;
    }
    /* the halves are equal up to rounding; the larger one is used for both */
    const double hx = sunder_i_greater(h[0].b.high[0] - h[0].b.low[0], h[1].b.high[0] - h[1].b.low[0]) / 2;
    const double hy = sunder_i_greater(h[0].b.high[1] - h[0].b.low[1], h[1].b.high[1] - h[1].b.low[1]) / 2;
    size_t from = c->run_from;
    for (size_t i = c->entry_from; i < c->entry_to && !(h[0].held && h[1].held); i++) {
        if ((i & 31) == 0 && !sunder_i_steps(32)) {
            b->no_memory = true;
            return;
        }
        if (!keep_whole(b, h, b->runs + from, &b->entries[i]))
            filter_part(b, h, b->runs + from, &b->entries[i], hx, hy);
        from += b->entries[i].runs;
    }
    const double growth = growth_of(c, h);
    const size_t waiting = b->stack_n;
    settle_half(b, c, &h[0], growth);
    if (!b->no_memory) settle_half(b, c, &h[1], growth);
    if (!(b->trial.on && c->trial > 0)) take_place(b, c, waiting);
}

static sunder_status descend_cells(builder *b, sunder_error *err)
{
    cell root;
    if (!sunder_i_cells_root(b, &root)) return sunder_i_failure_cause(err);
    split_cell(b, &root);
    unsigned tick = 0;
    while (b->stack_n > 0 && !b->no_memory) {
        if (b->stack_n == b->trial.stack_n) b->trial.on = false; /* the trial was successful */
        const cell c = b->stack[--b->stack_n];
        b->entries_n = c.entry_to; /* lists beyond these belong to cells that are done */
        b->runs_n = c.run_to;
        if (b->options && b->options->progress && (++tick & 63) == 0 &&
            !b->options->progress(b->done, b->options->progress_user))
            return sunder_i_cancelled(err);
        if (c.trial > 0) b->trial = (trial){true, c, b->stack_n, sunder_i_pairs_mark_here(&b->out->pairs), b->done, 0};
        split_cell(b, &c);
        if (b->trial.on) sunder_i_cells_end_trial(b);
    }
    return b->no_memory ? sunder_i_failure_cause(err) : SUNDER_OK;
}

sunder_status sunder_i_cull(const sunder_i_convex_pieces *parts, const sunder_i_lines *lines,
                            const sunder_sum_options *options, sunder_i_culled *out, sunder_error *err)
{
    memset(out, 0, sizeof *out);
    if (parts->corners == 0) return SUNDER_OK;
    const bool runs = parts->corners < (size_t)1 << RUN_BITS;
    builder b = {.single_most = runs ? (1u << RUN_BITS) - 1 : UINT32_MAX,
                 .run_shift = runs ? RUN_BITS : 32,
                 .parts = parts,
                 .lines = lines,
                 .options = options,
                 .out = out};
    out->fate = sunder_i_calloc(parts->corners, sizeof *out->fate);
    out->live_line = sunder_i_calloc(lines->n, sizeof *out->live_line);
    b.stamp = sunder_i_calloc(lines->n, sizeof *b.stamp);
    b.widest = sunder_i_calloc(2 * (size_t)parts->classes, sizeof *b.widest);
    b.shared = sunder_i_calloc(lines->n, sizeof *b.shared);
    b.recent_bits = RECENT_BITS_LEAST;
    while (b.recent_bits < RECENT_BITS_MOST && lines->n >> b.recent_bits) b.recent_bits++;
    b.recent = sunder_i_alloc((size_t)1 << b.recent_bits, sizeof *b.recent);
    const bool ok = out->fate && out->live_line && b.stamp && b.widest && b.shared && b.recent;
    if (ok) sunder_i_cells_forget_pairs(&b);
    sunder_status status = ok ? descend_cells(&b, err) : sunder_i_failure_cause(err);
    if (status == SUNDER_OK && !sunder_i_cells_fates(&b)) status = sunder_i_failure_cause(err);
    sunder_i_free_all(b.side, b.before, b.entries, b.runs, b.stack, b.stamp, b.widest, b.shared, b.recent);
    if (status != SUNDER_OK) sunder_i_culled_free(out);
    return status;
}

void sunder_i_culled_free(sunder_i_culled *culled)
{
    sunder_i_pairs_free(&culled->pairs);
    sunder_i_free_all(culled->fate, culled->live_line);
    memset(culled, 0, sizeof *culled);
}
