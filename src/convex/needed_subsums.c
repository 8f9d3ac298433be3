/* Most subsums of ragged operands lie deep inside the sum, where a few large ones cover all the others. These few are
 * found without making the others.
 *
 * The box of the whole sum is halved into cells. The subsums that may reach into a cell are kept as pairs of groups of
 * pieces (piece_tree.h), one group of each operand. A pair stands for all sums of pieces of the two, and is opened as
 * cells become small. A cell that lies inside one subsum is finished: that subsum is needed, and no other is needed for
 * this cell. In a cell that few subsums reach into, all of them are needed. So every subsum is covered, cell by cell,
 * by needed ones; and since cells are closed and their holders open, the union is the same set, degenerate holes
 * included.
 *
 * Floating point with one-sided error bounds: a wrong "don't know" costs one subsum more. */
#include "convex/needed_subsums.h"

#include "base/extremes.h"
#include "base/watch.h"
#include "convex/approx_sum.h"

#include <math.h>
#include <string.h>

/* Numbers that decide how long it takes, and how many subsums beyond the needed ones are kept; measured on stars,
 * random polygons, forks, covered forks, robots and grids. */

/* A cell with at most this many subsums is not halved further: the larger the number, the more subsums are taken as
 * needed, and these take memory. Nor is a half with more, if the two halves together have nearly twice the cell's:
 * halves of such halves will be no better (copies side by side, far longer than they are apart). */
#define LEAF 32
#define STUBBORN_LEAF 256
#define STUBBORN_GROWTH 1.75
/* A pair of groups is opened where it is this many times as large as the cell. */
#define COARSE 12
/* Pairs of groups tried in a cell, below each listed pair, for a subsum that holds the cell. */
#define LOOKS 64
/* Credit for each subsum: how many pairs may be looked at in all, handed down from cell to cell. Less than the cost of
 * making one and finding it covered. */
#define CREDIT 32.0
/* A cell that is not halved further, or has no credit left, may borrow what leaving out its unlisted subsums would
 * save. The total lent is limited by what loans have saved so far, plus a share of all looks as an advance: along the
 * outline of stars two dozen looks save one subsum. On a loan, a cell with more than this many subsums is halved. */
#define ON_TRUST 0.1
#define FEW 6
/* The cost of walking round a subsum, in looks at pairs. */
#define WALK 4
/* Leaving subsums out does not pay where more than MOST_NEEDED of all are needed; nor where the subsums cover their box
 * fewer than LEAST_LAYERS times on average, unless the largest sample has LARGE_SHARE of the box and holds LEAST_HELD
 * of the other samples. */
#define MOST_NEEDED 0.5
#define LEAST_LAYERS 4
#define LARGE_SHARE 0.1
#define LEAST_HELD 0.25
#define SAMPLES 64
/* A box halved more often than this is a point in doubles. */
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
    bool stubborn; /* halving its parent gained nothing */
} cell;

/* A loan: the looks that a cell and those below it may take beyond their credit; one loan at a time. */
typedef struct loan {
    bool on;
    size_t cells;            /* on the stack below it */
    size_t listed, unlisted; /* subsums listed when it began, and those that would have been listed without it */
    double looks;            /* the finder's looks when it began */
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
    double spent;    /* looks at the current cell */
    double subsums;  /* in the pairs listed for a half */
    uint64_t holder; /* the subsum that holds the window, once `held` */
    double worth;    /* the worth of leaving a subsum out, in looks; 0: no loans */
    double looks;    /* looks at all cells so far */
    double balance;  /* what loans have saved, less what they took, in looks */
    loan loan;
    bool held, no_memory;
} finder;

static uint64_t subsum_of(const finder *f, uint32_t a, uint32_t b)
{
    return (uint64_t)f->p->group[a].piece << 32 | f->q->group[b].piece;
}

/* Where does the window lie, relative to the sum of the longest pieces of two groups? */
static sunder_i_window_place place_of(finder *f, uint32_t a, uint32_t b, const sunder_i_cell_window *w)
{
    f->spent += WALK;
    return sunder_i_approx_sum_sees(f->p, f->p->group[a].piece, f->q, f->q->group[b].piece, w);
}

/* ---- Pairs that reach into a window ---- */

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

/* Which of two groups is opened: the larger of those with several pieces. True for the first. */
static bool opens_first(const sunder_i_piece_group *a, const sunder_i_piece_group *b)
{
    return b->pieces == 1 || (a->pieces > 1 && size_of(a) >= size_of(b));
}

/* Lists the parts of a pair that reach into the window, opened until none is larger than `size`; stops when one subsum
 * is found to hold the window. */
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

/* ---- A subsum that holds a window ---- */

/* May a subsum of the pair hold the window? */
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
    if (--*looks < 0 || !sunder_i_step()) return false; /* told to stop; the next listing of pairs reports it */
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

/* ---- Needed subsums ---- */

static void need(finder *f, uint64_t subsum)
{
    sunder_i_subsum_list *l = f->out;
    f->no_memory |= !sunder_i_subsum_list_add(l, subsum);
    l->all = (double)l->n > MOST_NEEDED * f->whole;
}

/* Appends the pairs of pieces whose subsums reach into the cell to the lists; if one of them holds the cell it becomes
 * needed, and the cell is finished. */
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

/* Pushes one half of a cell, with those of the cell's pairs that reach into it, unless none does, or one subsum holds
 * it. */
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

/* Halves the cell across its longer axis; the remaining credit is divided in proportion to the halves' pairs. */
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

/* Is the cell to be halved further? If not, the subsums that reach into it are taken as needed, or the one that holds
 * it. */
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
        f->pairs = c.to; /* lists above belong to finished cells */
        f->spent = 0;
        if (!goes_on(f, &c, &w)) continue;
        if (is_held(f, &c, &w))
            need(f, f->holder);
        else
            halve(f, &c);
        f->looks += f->spent;
    }
}

/* Samples: spread evenly, and those of long pieces. */
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

/* Do the subsums overlap in several layers, or lie mostly inside one of them? */
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
