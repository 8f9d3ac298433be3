/* Most subsums of ragged operands lie deep inside the sum, where a few large ones cover all: these are found without
 * making the others.
 *
 * The box of the whole sum is halved into cells. What may reach into a cell is kept as pairs of groups of pieces
 * (piece_tree.h), one of each operand, which stand for all sums of the one's pieces with the other's and are opened as
 * the cells become small. A cell that lies inside one subsum is done with: that one is needed, and of whatever else
 * reaches into the cell nothing is, here. In a cell that few reach into all of them are needed. Nothing reaches into
 * the rest. So every subsum is covered, cell by cell, by needed ones; and as cells are closed and their holders open,
 * the union is the same set, its degenerate holes included.
 *
 * Floating point with one-sided error bounds: a wrong "don't know" makes one subsum more. */
#include "convex/needed_subsums.h"

#include "base/extremes.h"
#include "base/watch.h"
#include "convex/approx_sum.h"

#include <math.h>
#include <string.h>

/* Numbers that decide how long it takes, never what comes out but for subsums more or less; by measurement on stars,
 * random polygons, forks, covered forks, robots and grids. */

/* A cell that no more reach into is not halved further: the larger, the more subsums are found needed, and it is those
 * that take memory. Nor is a half into which more reach, if together with the other it has nearly twice the cell's:
 * halves of such halves will be no better (copies side by side, far longer than they are apart). */
#define LEAF 32
#define STUBBORN_LEAF 256
#define STUBBORN_GROWTH 1.75
/* A pair of groups is opened where it is so many times as large as the cell. */
#define COARSE 12
/* Pairs of groups looked at in a cell, below each one listed for it, for a subsum that holds it. */
#define LOOKS 64
/* For each subsum so many pairs may be looked at in all, handed down from cell to cell: less than it costs to make one
 * and to find it covered. */
#define CREDIT 32.0
/* A cell that is not halved further, or has no credit left, is lent what it is worth to leave out those of its subsums
 * that are not listed yet. No more is lent than has been saved so, and a share of all looks on trust: along the outline
 * of stars two dozen looks save one subsum. On loan more than that few are a cell to halve. */
#define ON_TRUST 0.1
#define FEW 6
/* Going round a subsum costs so many looks at pairs. */
#define WALK 4
/* Where more than this share of all is needed, or the subsums cover their box less than that many times, and the
 * largest does not have a tenth of it and that share of the others inside, leaving some out gains nothing. */
#define MOST_NEEDED 0.5
#define LEAST_LAYERS 4
#define LARGE_SHARE 0.1
#define LEAST_HELD 0.25
#define SAMPLES 64
/* Halved more often than that, a box is a point in doubles. */
#define DEPTH 96

typedef struct pair {
    uint32_t a, b; /* groups */
} pair;

typedef struct cell {
    double box[4];
    size_t from, to; /* its pairs */
    double subsums;  /* in these */
    double credit;
    int depth;
    bool stubborn; /* its parent was halved in vain */
} cell;

/* The looks that a cell and those below it may take beyond their credit; one at a time. */
typedef struct loan {
    bool on;
    size_t cells;            /* on the stack below it */
    size_t listed, unlisted; /* subsums listed before it, and those that were to be listed for want of it */
    double looks;            /* of the finder, before it */
} loan;

typedef struct finder {
    const sunder_i_piece_tree *p, *q;
    sunder_i_subsum_list *out;
    double whole; /* all subsums */
    double error;
    pair *pair; /* lists of all cells on the stack, one after the other */
    size_t pairs, capacity;
    cell *stack;
    size_t cells, cells_capacity;
    double spent;    /* looks, on the cell at hand */
    double subsums;  /* in the pairs listed for a half */
    uint64_t holder; /* the subsum that holds the window, once `held` */
    double worth;    /* of a subsum that is left out, in looks; 0: nothing is lent */
    double looks;    /* on all cells so far */
    double balance;  /* worth of what was saved on loan, less what it took */
    loan loan;
    bool held, no_memory;
} finder;

static uint64_t subsum_of(const finder *f, uint32_t a, uint32_t b)
{
    return (uint64_t)f->p->group[a].piece << 32 | f->q->group[b].piece;
}

/* Where is the window, seen from the sum of the longest pieces of two groups? */
static sunder_i_window_place place_of(finder *f, uint32_t a, uint32_t b, const sunder_i_cell_window *w)
{
    f->spent += WALK;
    return sunder_i_approx_sum_sees(f->p, f->p->group[a].piece, f->q, f->q->group[b].piece, w);
}

/* ---- What reaches into a window ---- */

static bool apart(const sunder_i_piece_group *a, const sunder_i_piece_group *b, const sunder_i_cell_window *w)
{
    for (int k = 0; k < SUNDER_I_WAYS; k++)
        if (a->low[k] + b->low[k] > w->high[k] || a->high[k] + b->high[k] < w->low[k]) return true;
    return false;
}

static void push(finder *f, uint32_t a, uint32_t b)
{
    if (f->pairs == f->capacity && !sunder_i_reserve(&f->pair, &f->capacity, f->pairs + 1, sizeof *f->pair)) {
        f->no_memory = true;
        return;
    }
    f->pair[f->pairs++] = (pair){a, b};
    f->subsums += (double)f->p->group[a].pieces * (double)f->q->group[b].pieces;
}

static double size_of(const sunder_i_piece_group *g)
{
    return sunder_i_max(g->high[0] - g->low[0], g->high[1] - g->low[1]);
}

/* Is it the first of two groups that is to be opened? The larger one of those with several pieces is. */
static bool opens_first(const sunder_i_piece_group *a, const sunder_i_piece_group *b)
{
    return b->pieces == 1 || (a->pieces > 1 && size_of(a) >= size_of(b));
}

/* Lists what of a pair reaches into the window, opened until no pair is larger than `size`; until one subsum is found
 * to hold the window. */
static void list_pair(finder *f, uint32_t a, uint32_t b, const sunder_i_cell_window *w, double size)
{
    const sunder_i_piece_group *ga = &f->p->group[a], *gb = &f->q->group[b];
    f->spent++;
    f->no_memory |= !sunder_i_step();
    if (f->held || f->no_memory || apart(ga, gb, w)) return;
    if (ga->pieces == 1 && gb->pieces == 1) {
        const sunder_i_window_place place = place_of(f, a, b, w);
        if (place == SUNDER_I_ACROSS) push(f, a, b);
        f->held = place == SUNDER_I_WITHIN;
        f->holder = subsum_of(f, a, b);
        return;
    }
    if (size_of(ga) + size_of(gb) <= size) {
        push(f, a, b);
        return;
    }
    const bool first = opens_first(ga, gb);
    const uint32_t *part = first ? ga->part : gb->part;
    for (int k = 0; k < 3 && part[k] != SUNDER_I_NO_GROUP; k++)
        list_pair(f, first ? part[k] : a, first ? b : part[k], w, size);
}

/* ---- What holds one ---- */

/* May one subsum of the pair? */
static bool may_hold(const sunder_i_piece_group *a, const sunder_i_piece_group *b, const sunder_i_cell_window *w)
{
    for (int k = 0; k < SUNDER_I_WAYS; k++) {
        if (a->low[k] + b->low[k] > w->low[k] || a->high[k] + b->high[k] < w->high[k]) return false;
        if (a->widest[k] + b->widest[k] < w->high[k] - w->low[k]) return false;
    }
    return true;
}

/* Looks for a subsum of the pair that holds the window, long pieces first. */
static bool find_holder(finder *f, uint32_t a, uint32_t b, const sunder_i_cell_window *w, int *looks)
{
    const sunder_i_piece_group *ga = &f->p->group[a], *gb = &f->q->group[b];
    if (--*looks < 0 || !sunder_i_step()) return false; /* told to stop: whoever lists pairs next says so */
    f->spent++;
    if (!may_hold(ga, gb, w)) return false;
    if (ga->pieces == 1 && gb->pieces == 1) {
        f->holder = subsum_of(f, a, b);
        return place_of(f, a, b, w) == SUNDER_I_WITHIN;
    }
    const bool first = opens_first(ga, gb);
    const uint32_t *part = first ? ga->part : gb->part;
    for (int k = 0; k < 3 && part[k] != SUNDER_I_NO_GROUP; k++)
        if (find_holder(f, first ? part[k] : a, first ? b : part[k], w, looks)) return true;
    return false;
}

static bool is_held(finder *f, const cell *c, const sunder_i_cell_window *w)
{
    for (size_t i = c->from; i < c->to; i++) {
        int looks = LOOKS;
        if (find_holder(f, f->pair[i].a, f->pair[i].b, w, &looks)) return true;
    }
    return false;
}

/* ---- What is needed ---- */

static void need(finder *f, uint64_t subsum)
{
    sunder_i_subsum_list *l = f->out;
    f->no_memory |= !sunder_i_subsum_list_add(l, subsum);
    l->all = (double)l->n > MOST_NEEDED * f->whole;
}

/* Lists the pairs of pieces whose subsums reach into the cell, behind all lists; or one that holds it is needed, and
 * nothing is left to do. */
static bool list_single(finder *f, const cell *c, const sunder_i_cell_window *w)
{
    f->held = false;
    for (size_t i = c->from; i < c->to; i++) list_pair(f, f->pair[i].a, f->pair[i].b, w, -INFINITY);
    if (f->held) need(f, f->holder);
    return !f->held && !f->no_memory;
}

static void need_listed(finder *f, const cell *c)
{
    for (size_t i = c->to; i < f->pairs && !f->no_memory && !f->out->all; i++)
        need(f, subsum_of(f, f->pair[i].a, f->pair[i].b));
}

/* ---- Cells ---- */

/* Puts one half of a cell on the stack, with what of the cell's pairs reaches into it, unless nothing does, or one
 * subsum holds it. */
static void put_half(finder *f, const cell *c, const double box[4])
{
    const sunder_i_cell_window w = sunder_i_cell_window_of(box, f->error);
    const size_t from = f->pairs;
    f->held = false;
    f->subsums = 0;
    for (size_t i = c->from; i < c->to; i++)
        list_pair(f, f->pair[i].a, f->pair[i].b, &w, COARSE * 2 * sunder_i_max(w.hx, w.hy));
    if (f->no_memory) return;
    if (f->held || f->pairs == from) {
        f->pairs = from;
        if (f->held) need(f, f->holder);
        return;
    }
    if (!sunder_i_reserve(&f->stack, &f->cells_capacity, f->cells + 1, sizeof *f->stack)) {
        f->no_memory = true;
        return;
    }
    f->stack[f->cells++] = (cell){{box[0], box[1], box[2], box[3]}, from, f->pairs, f->subsums, 0, c->depth + 1, false};
}

/* Both halves across the longer axis; what credit is left goes to them by what they have to do. */
static void halve(finder *f, const cell *c)
{
    const int axis = c->box[3] - c->box[1] > c->box[2] - c->box[0];
    const size_t first = f->cells;
    double box[2][4], all = 0;
    memcpy(box[0], c->box, sizeof box[0]);
    memcpy(box[1], c->box, sizeof box[1]);
    box[0][axis + 2] = box[1][axis] = c->box[axis] / 2 + c->box[axis + 2] / 2;
    for (int k = 0; k < 2 && !f->no_memory; k++) put_half(f, c, box[k]);
    for (size_t i = first; i < f->cells; i++) all += f->stack[i].subsums;
    for (size_t i = first; i < f->cells; i++) {
        f->stack[i].credit = (c->credit - f->spent) * (f->stack[i].subsums / all);
        f->stack[i].stubborn = all > STUBBORN_GROWTH * c->subsums;
    }
}

/* ---- Loans ---- */

/* Is the cell, whose pieces are listed, worth a closer look on loan? */
static bool borrow(finder *f, cell *c)
{
    size_t unlisted = 0;
    if (f->loan.on || f->balance + ON_TRUST * f->looks <= 0) return false;
    for (size_t i = c->to; i < f->pairs; i++)
        unlisted += !sunder_i_subsum_list_has(f->out, subsum_of(f, f->pair[i].a, f->pair[i].b));
    if (unlisted <= FEW) return false;
    f->loan = (loan){true, f->cells, f->out->n, unlisted, f->looks};
    c->credit = f->worth * (double)unlisted;
    return true;
}

static void pay_back(finder *f)
{
    const loan *l = &f->loan;
    f->balance += f->worth * ((double)l->unlisted - (double)(f->out->n - l->listed)) - (f->looks - l->looks);
    f->loan.on = false;
}

/* ---- The descent ---- */

/* In a cell that is not halved further all that reaches into it is needed, or one that holds it. Else true. */
static bool goes_on(finder *f, cell *c, const sunder_i_cell_window *w)
{
    const double leaf = c->stubborn ? STUBBORN_LEAF : f->loan.on ? FEW : LEAF;
    const bool deep = c->depth > DEPTH;
    if (c->subsums > leaf && c->credit > 0 && !deep) return true;
    if (!list_single(f, c, w)) return false;
    if (f->worth > 0 && c->subsums > FEW && !c->stubborn && !deep && borrow(f, c)) {
        f->pairs = c->to;
        return true;
    }
    need_listed(f, c);
    return false;
}

static void descend(finder *f)
{
    while (f->cells > 0 && !f->no_memory && !f->out->all) {
        if (f->loan.on && f->cells == f->loan.cells) pay_back(f);
        cell c = f->stack[--f->cells];
        const sunder_i_cell_window w = sunder_i_cell_window_of(c.box, f->error);
        f->pairs = c.to; /* lists above are of cells that are done with */
        f->spent = 0;
        if (!goes_on(f, &c, &w)) continue;
        if (is_held(f, &c, &w))
            need(f, f->holder);
        else
            halve(f, &c);
        f->looks += f->spent;
    }
}

/* Samples: spread over all, and those of long pieces. */
static pair sample_of(const finder *f, uint32_t k)
{
    return (pair){(uint32_t)((uint64_t)k * 7919 % f->p->pieces->n), (uint32_t)((uint64_t)k * 104729 % f->q->pieces->n)};
}

static pair long_sample_of(const finder *f, uint32_t k)
{
    return (pair){f->p->group[k % f->p->groups].piece, f->q->group[k * 5 % f->q->groups].piece};
}

/* How many of the samples lie inside that subsum? */
static uint32_t count_held(const finder *f, pair in)
{
    uint32_t held = 0;
    for (uint32_t k = 0; k < SAMPLES; k++) {
        const pair s = sample_of(f, k);
        double a[4], b[4], box[4];
        sunder_i_piece_tree_box(f->p, s.a, a);
        sunder_i_piece_tree_box(f->q, s.b, b);
        for (int i = 0; i < 4; i++) box[i] = a[i] + b[i];
        const sunder_i_cell_window w = sunder_i_cell_window_of(box, f->error);
        held += sunder_i_approx_sum_sees(f->p, in.a, f->q, in.b, &w) == SUNDER_I_WITHIN;
    }
    return held;
}

/* Do the subsums lie in layers, or in one of them? */
static bool is_worth_it(const finder *f, const double box[4])
{
    double sum = 0, most = 0;
    pair largest = {0, 0};
    for (uint32_t k = 0; k < SAMPLES; k++) {
        const pair s = sample_of(f, k), l = long_sample_of(f, k);
        sum += sunder_i_approx_sum_area(f->p, s.a, f->q, s.b);
        const double area = sunder_i_approx_sum_area(f->p, l.a, f->q, l.b);
        if (area > most) {
            most = area;
            largest = l;
        }
    }
    const double area = (box[2] - box[0]) * (box[3] - box[1]);
    if (sum / SAMPLES * f->whole >= LEAST_LAYERS * area) return true;
    return most >= LARGE_SHARE * area && count_held(f, largest) >= LEAST_HELD * SAMPLES;
}

static bool find(finder *f)
{
    const sunder_i_piece_group *a = f->p->group, *b = f->q->group;
    f->whole = (double)a->pieces * (double)b->pieces;
    f->error = sunder_i_approx_sum_error(f->p, f->q);
    cell root = {.from = 0, .to = 1, .subsums = f->whole, .credit = CREDIT * f->whole};
    for (int k = 0; k < 2; k++) {
        root.box[k] = a->low[k] + b->low[k] - f->error;
        root.box[k + 2] = a->high[k] + b->high[k] + f->error;
    }
    f->out->all = !is_worth_it(f, root.box);
    if (f->out->all) return true;
    push(f, 0, 0);
    f->no_memory |= !sunder_i_reserve(&f->stack, &f->cells_capacity, 1, sizeof *f->stack);
    if (!f->no_memory) {
        f->stack[f->cells++] = root;
        descend(f);
    }
    sunder_i_free(f->pair);
    sunder_i_free(f->stack);
    return !f->no_memory && (f->out->all || sunder_i_subsum_list_finish(f->out));
}

bool sunder_i_needed_subsums(const sunder_i_convex_pieces *p, const sunder_i_convex_pieces *q, double worth,
                             sunder_i_subsum_list *out)
{
    sunder_i_piece_tree tp, tq;
    memset(out, 0, sizeof *out);
    if (!sunder_i_piece_tree_build(p, &tp)) return false;
    bool ok = sunder_i_piece_tree_build(q, &tq);
    if (ok) {
        finder f = {.p = &tp, .q = &tq, .worth = worth, .out = out};
        ok = find(&f);
        sunder_i_piece_tree_free(&tq);
    }
    sunder_i_piece_tree_free(&tp);
    if (!ok) sunder_i_subsum_list_free(out);
    return ok;
}
