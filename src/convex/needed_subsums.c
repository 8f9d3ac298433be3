/* needed_subsums.c: most subsums of operands with irregular boundaries are deep inside the sum, where a few large ones
 * cover all the others. These few are found without computing the others.
 *
 * The bounding box of the whole sum is halved recursively into cells. The subsums that may meet a cell are kept as
 * pairs of groups of pieces (piece_tree.h), one group of each operand. A pair represents all sums of a piece of one
 * group and a piece of the other; it is replaced by pairs of subgroups when cells become small. If a cell is inside one
 * subsum, the cell is finished: that subsum is needed, and no other is needed for this cell. If only few subsums meet a
 * cell, all of them are needed. So every subsum is covered, cell by cell, by needed ones; and since cells are closed
 * and the subsums that contain them open, the union is the same set, including degenerate holes.
 *
 * The tests are in floating point with one-sided error bounds: if a test is undecided, one subsum more is kept. */
#include "convex/needed_subsums.h"

#include "base/extremes.h"
#include "base/watch.h"
#include "convex/approx_sum.h"

#include <math.h>
#include <string.h>

/* These constants determine the running time, and how many subsums beyond the needed ones are kept; they were chosen by
 * measurements on stars, random polygons, forks, covered forks, robots and grids. */

/* A cell with at most LEAF subsums is not halved further: the larger this number, the more subsums are taken as needed,
 * and these need memory. A cell with at most STUBBORN_LEAF subsums is not halved further either if the halving of its
 * parent resulted in at least STUBBORN_GROWTH times the parent's subsums: further halving would be no better (copies
 * that are longer than the distance between them). */
#define LEAF 32
#define STUBBORN_LEAF 256
#define STUBBORN_GROWTH 1.75
/* A pair of groups is replaced by pairs of subgroups if it is larger than this many times the cell. */
#define COARSE 12
/* The number of pairs of groups that are tested in a cell, below each listed pair, for a subsum that contains the
 * cell. */
#define LOOKS 64
/* The credit for each subsum: the number of pairs that may be tested in all, divided among the cells. It is less than
 * the cost of computing a subsum and finding it covered. */
#define CREDIT 32.0
/* A cell that is not halved further, or has no credit left, may borrow the amount that leaving out its unlisted subsums
 * would save. The total of loans is limited by what loans have saved so far, plus the fraction ON_TRUST of all tests:
 * along the outline of stars two dozen tests save one subsum. On a loan, a cell with more than FEW subsums is
 * halved. */
#define ON_TRUST 0.1
#define FEW 6
/* The cost of testing a window against a subsum, in tests of pairs. */
#define WALK 4
/* Leaving subsums out is not worth its cost if more than the fraction MOST_NEEDED of all are needed; nor if the subsums
 * cover their bounding box fewer than LEAST_LAYERS times on average, unless the largest sample has the fraction
 * LARGE_SHARE of the box and contains the fraction LEAST_HELD of the other samples. */
#define MOST_NEEDED 0.5
#define LEAST_LAYERS 4
#define LARGE_SHARE 0.1
#define LEAST_HELD 0.25
#define SAMPLES 64
/* A box that was halved more often than this is a point in doubles. */
#define DEPTH 96

typedef struct pair {
    uint32_t a, b; /* group numbers */
} pair;

typedef struct cell {
    double box[4];
    size_t from, to; /* its pairs are finder.pair[from .. to - 1] */
    double subsums;  /* the number of subsums in these pairs */
    double credit;
    int depth;
    bool stubborn; /* halving its parent gained nothing */
} cell;

/* A loan: the tests that a cell and its descendants may use beyond their credit. There is one loan at a time. */
typedef struct loan {
    bool on;
    size_t cells;            /* the number of cells on the stack below the cell with the loan */
    size_t listed, unlisted; /* the number of subsums listed when the loan began, and of those that would have been
                              * listed without it */
    double looks;            /* finder.looks when the loan began */
} loan;

typedef struct finder {
    const sunder_i_piece_tree *p, *q;
    sunder_i_subsum_list *out;
    double whole; /* the number of all subsums */
    double error;
    pair *pair; /* the pairs of all cells on the stack, cell by cell */
    size_t pairs, capacity;
    cell *stack;
    size_t cells, cells_capacity;
    double spent;    /* the tests for the current cell */
    double subsums;  /* the number of subsums in the pairs that are listed for a half */
    uint64_t holder; /* the subsum that contains the window, if `held` */
    double worth;    /* the value of leaving one subsum out, in tests; 0: no loans */
    double looks;    /* the tests for all cells so far */
    double balance;  /* what loans have saved, minus what they have used, in tests */
    loan loan;
    bool held, no_memory;
} finder;

static uint64_t subsum_of(const finder *f, uint32_t a, uint32_t b)
{
    return (uint64_t)f->p->group[a].piece << 32 | f->q->group[b].piece;
}

/* Returns the position of the window relative to the sum of the longest pieces of groups a and b. */
static sunder_i_window_place place_of(finder *f, uint32_t a, uint32_t b, const sunder_i_cell_window *w)
{
    f->spent += WALK;
    return sunder_i_approx_sum_sees(f->p, f->p->group[a].piece, f->q, f->q->group[b].piece, w);
}

/* ---- Pairs that meet a window ---- */

static bool is_apart(const sunder_i_piece_group *a, const sunder_i_piece_group *b, const sunder_i_cell_window *w)
{
    for (int k = 0; k < SUNDER_I_WAYS; k++)
        if (a->low[k] + b->low[k] > w->high[k] || a->high[k] + b->high[k] < w->low[k]) return true;
    return false;
}

static void push_pair(finder *f, uint32_t a, uint32_t b)
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

/* Returns true if the first group of a pair is the one to replace by its subgroups: of the groups with several pieces
 * the larger one is replaced. */
static bool opens_first(const sunder_i_piece_group *a, const sunder_i_piece_group *b)
{
    return b->pieces == 1 || (a->pieces > 1 && size_of(a) >= size_of(b));
}

/* Lists the pairs below the pair (a, b) that may meet the window; a pair larger than `size` is replaced by pairs of
 * subgroups. Stops when a subsum is found that contains the window. */
static void list_pair(finder *f, uint32_t a, uint32_t b, const sunder_i_cell_window *w, double size)
{
    const sunder_i_piece_group *ga = &f->p->group[a], *gb = &f->q->group[b];
    f->spent++;
    f->no_memory |= !sunder_i_step();
    if (f->held || f->no_memory || is_apart(ga, gb, w)) return;
    if (ga->pieces == 1 && gb->pieces == 1) {
        const sunder_i_window_place place = place_of(f, a, b, w);
        if (place == SUNDER_I_ACROSS) push_pair(f, a, b);
        f->held = place == SUNDER_I_WITHIN;
        f->holder = subsum_of(f, a, b);
        return;
    }
    if (size_of(ga) + size_of(gb) <= size) {
        push_pair(f, a, b);
        return;
    }
    const bool first = opens_first(ga, gb);
    const uint32_t *part = first ? ga->part : gb->part;
    for (int k = 0; k < 3 && part[k] != SUNDER_I_NO_GROUP; k++)
        list_pair(f, first ? part[k] : a, first ? b : part[k], w, size);
}

/* ---- A subsum that contains a window ---- */

/* Returns false if certainly no subsum of the pair (a, b) contains the window. */
static bool may_hold(const sunder_i_piece_group *a, const sunder_i_piece_group *b, const sunder_i_cell_window *w)
{
    for (int k = 0; k < SUNDER_I_WAYS; k++) {
        if (a->low[k] + b->low[k] > w->low[k] || a->high[k] + b->high[k] < w->high[k]) return false;
        if (a->widest[k] + b->widest[k] < w->high[k] - w->low[k]) return false;
    }
    return true;
}

/* Searches for a subsum of the pair (a, b) that contains the window, long pieces first. *looks limits the number of
 * pairs tested. Returns true if one is found; f->holder is the subsum. */
static bool find_holder(finder *f, uint32_t a, uint32_t b, const sunder_i_cell_window *w, int *looks)
{
    const sunder_i_piece_group *ga = &f->p->group[a], *gb = &f->q->group[b];
    if (--*looks < 0 || !sunder_i_step()) return false; /* cancelled; the next call of list_pair() reports it */
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

static void need_subsum(finder *f, uint64_t subsum)
{
    sunder_i_subsum_list *l = f->out;
    f->no_memory |= !sunder_i_subsum_list_add(l, subsum);
    l->all = (double)l->n > MOST_NEEDED * f->whole;
}

/* Appends the pairs of pieces whose subsums meet the cell to the lists. If one of them contains the cell, that one
 * becomes needed, and the cell is finished. Returns false if the cell is finished or if out of memory. */
static bool list_single(finder *f, const cell *c, const sunder_i_cell_window *w)
{
    f->held = false;
    for (size_t i = c->from; i < c->to; i++) list_pair(f, f->pair[i].a, f->pair[i].b, w, -INFINITY);
    if (f->held) need_subsum(f, f->holder);
    return !f->held && !f->no_memory;
}

static void need_listed(finder *f, const cell *c)
{
    for (size_t i = c->to; i < f->pairs && !f->no_memory && !f->out->all; i++)
        need_subsum(f, subsum_of(f, f->pair[i].a, f->pair[i].b));
}

/* ---- Cells ---- */

/* Pushes one half of a cell, with those of the cell's pairs that meet it. A half that no pair meets is not pushed, nor
 * one that a subsum contains: this subsum becomes needed. */
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
        if (f->held) need_subsum(f, f->holder);
        return;
    }
    if (!sunder_i_reserve(&f->stack, &f->cells_capacity, f->cells + 1, sizeof *f->stack)) {
        f->no_memory = true;
        return;
    }
    f->stack[f->cells++] = (cell){{box[0], box[1], box[2], box[3]}, from, f->pairs, f->subsums, 0, c->depth + 1, false};
}

/* Halves the cell across its longer axis; the remaining credit is divided between the halves in proportion to the
 * subsums in their pairs. */
static void halve_cell(finder *f, const cell *c)
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

/* Grants the cell, whose pieces are listed, a loan if the rules at ON_TRUST allow it. Returns true if it did. */
static bool borrow_looks(finder *f, cell *c)
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

/* ---- Depth-first search ---- */

/* Returns true if the cell is to be halved further. Otherwise the subsums that meet it become needed, or the one that
 * contains it. */
static bool goes_on(finder *f, cell *c, const sunder_i_cell_window *w)
{
    const double leaf = c->stubborn ? STUBBORN_LEAF : f->loan.on ? FEW : LEAF;
    const bool deep = c->depth > DEPTH;
    if (c->subsums > leaf && c->credit > 0 && !deep) return true;
    if (!list_single(f, c, w)) return false;
    if (f->worth > 0 && c->subsums > FEW && !c->stubborn && !deep && borrow_looks(f, c)) {
        f->pairs = c->to;
        return true;
    }
    need_listed(f, c);
    return false;
}

static void descend_cells(finder *f)
{
    while (f->cells > 0 && !f->no_memory && !f->out->all) {
        if (f->loan.on && f->cells == f->loan.cells) pay_back(f);
        cell c = f->stack[--f->cells];
        const sunder_i_cell_window w = sunder_i_cell_window_of(c.box, f->error);
        f->pairs = c.to; /* the lists above belong to finished cells */
        f->spent = 0;
        if (!goes_on(f, &c, &w)) continue;
        if (is_held(f, &c, &w))
            need_subsum(f, f->holder);
        else
            halve_cell(f, &c);
        f->looks += f->spent;
    }
}

/* Two sequences of sample pairs: pieces spread evenly over the operands, and long pieces. */
static pair sample_of(const finder *f, uint32_t k)
{
    return (pair){(uint32_t)((uint64_t)k * 7919 % f->p->pieces->n), (uint32_t)((uint64_t)k * 104729 % f->q->pieces->n)};
}

static pair long_sample_of(const finder *f, uint32_t k)
{
    return (pair){f->p->group[k % f->p->groups].piece, f->q->group[k * 5 % f->q->groups].piece};
}

/* Returns the number of samples whose bounding boxes are inside the subsum `in`. */
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

/* Returns true if leaving subsums out is worth its cost: the subsums cover the box several times, or are mostly inside
 * one of them. */
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

static bool find_needed(finder *f)
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
    push_pair(f, 0, 0);
    f->no_memory |= !sunder_i_reserve(&f->stack, &f->cells_capacity, 1, sizeof *f->stack);
    if (!f->no_memory) {
        f->stack[f->cells++] = root;
        descend_cells(f);
    }
    sunder_i_free_all(f->pair, f->stack);
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
        ok = find_needed(&f);
        sunder_i_piece_tree_free(&tq);
    }
    sunder_i_piece_tree_free(&tp);
    if (!ok) sunder_i_subsum_list_free(out);
    return ok;
}
