/* board.c: see board.h. The board is divided into halves repeatedly, as in outline/culling.c: a part that one subsum
 * covers is closed completely, and only subsums near a part are passed on to its halves. Squares that stay open keep
 * lists of the subsums near them.
 *
 * All tests are in doubles and one-sided: a closed square is certainly covered, with an allowance for the error of a
 * point that is looked up; the lists have all subsums within that error. */
#include "separation/obstacle/board.h"

#include "base/invariant.h"
#include "base/watch.h"

#include <math.h>
#include <string.h>

#define TRIES 24 /* the number of the largest subsums tried of those whose boxes cover a part; others rarely cover it */
/* The board has between LEAST and MOST squares in each direction, a power of two, and at most SUBSUMS_EACH subsums for
 * each square if MOST allows. A finer board covers more of the plane but takes longer to build. */
#define LEAST 16
#define MOST 256
#define SUBSUMS_EACH 16

/* columns x0 .. x1 - 1, rows y0 .. y1 - 1; near[from .. to - 1] are the subsums near it */
typedef struct part {
    uint32_t x0, y0, x1, y1;
    size_t from, to;
} part;

typedef struct board {
    sunder_i_operands *g;
    sunder_i_board *h;
    uint32_t *near; /* the lists of the parts on the stack, one after the other */
    size_t near_n, near_capacity;
    part stack[64]; /* two for each halving: at most 2 * 2 * 9 */
    uint32_t stack_n;
} board;

static void part_box(const sunder_i_board *h, const part *p, double box[4])
{
    const double step = 2 * h->reach / h->n;
    box[0] = p->x0 * step - h->reach;
    box[1] = p->y0 * step - h->reach;
    box[2] = p->x1 * step - h->reach;
    box[3] = p->y1 * step - h->reach;
}

/* Returns whether the interior of the subsum contains the box, enlarged by the error. */
static bool holds_box(sunder_i_operands *g, sunder_i_subsum *s, const double box[4])
{
    const double e = 4 * g->error;
    for (int k = 0; k < 2; k++)
        if (box[k] - e <= s->box[k] || box[k + 2] + e >= s->box[k + 2]) return false;
    if (!s->sides && !sunder_i_subsum_make(g, s)) return false;
    const double cx = box[0] / 2 + box[2] / 2, cy = box[1] / 2 + box[3] / 2;
    const double hx = box[2] / 2 - box[0] / 2 + e, hy = box[3] / 2 - box[1] / 2 + e;
    for (uint32_t k = 0; k < s->sides; k++) {
        const double v = s->sx[k] * (cy - s->cy[k]) - s->sy[k] * (cx - s->cx[k]);
        if (!(v - (fabs(s->sx[k]) * hy + fabs(s->sy[k]) * hx) > 2 * s->bound[k])) return false;
    }
    return true;
}

static void close_part(sunder_i_board *h, const part *p, uint32_t holder)
{
    for (uint32_t y = p->y0; y < p->y1; y++)
        for (uint32_t x = p->x0; x < p->x1; x++) h->holder[(size_t)y * h->n + x] = holder + 1;
}

/* Appends the list of an open square. Lists have the order in which squares are processed;
 * arrange_lists() sorts them. */
static bool keep_list(board *b, const part *p, uint32_t *start)
{
    sunder_i_board *h = b->h;
    const size_t n = p->to - p->from, square = (size_t)p->y0 * h->n + p->x0;
    if (h->list_n + n > UINT32_MAX) return sunder_i_too_many();
    if (!sunder_i_reserve(&h->list, &h->list_capacity, h->list_n + n, sizeof *h->list)) return false;
    if (n) memcpy(h->list + h->list_n, b->near + p->from, n * sizeof *h->list);
    start[square] = (uint32_t)h->list_n;
    h->list_n += n;
    h->list_end[square] = (uint32_t)h->list_n;
    return true;
}

/* Examines one part with the list of its parent: closes it, stores its list if it is one square, or pushes it on the
 * stack. */
static bool settle_part(board *b, const part *parent, part p, uint32_t *start)
{
    double box[4];
    part_box(b->h, &p, box);
    const size_t most = b->near_n + (parent->to - parent->from);
    if (!sunder_i_reserve(&b->near, &b->near_capacity, most, sizeof *b->near)) return false;
    if (!sunder_i_steps((parent->to - parent->from) / 8 + 1)) return false;
    p.from = b->near_n;
    uint32_t tries = 0;
    for (size_t i = parent->from; i < parent->to; i++) {
        const uint32_t number = b->near[i];
        sunder_i_subsum *s = b->g->subsum + number;
        if (!sunder_i_box_near(s->box, box, 4 * b->g->error)) continue;
        if (tries < TRIES && s->box[0] < box[0] && s->box[1] < box[1] && s->box[2] > box[2] && s->box[3] > box[3]) {
            tries++;
            if (holds_box(b->g, s, box)) {
                close_part(b->h, &p, number);
                b->near_n = p.from;
                return true;
            }
        }
        b->near[b->near_n++] = number;
    }
    p.to = b->near_n;
    if (p.x1 - p.x0 > 1 || p.y1 - p.y0 > 1) {
        b->stack[b->stack_n++] = p;
        return true;
    }
    const bool ok = keep_list(b, &p, start);
    b->near_n = p.from;
    return ok;
}

static bool divide_board(board *b, uint32_t *start)
{
    const uint32_t n = b->h->n;
    const size_t subsums = b->g->subsums;
    if (!sunder_i_reserve(&b->near, &b->near_capacity, subsums, sizeof *b->near)) return false;
    for (size_t k = 0; k < subsums; k++) b->near[k] = (uint32_t)k;
    b->near_n = subsums;
    b->stack[b->stack_n++] = (part){0, 0, n, n, 0, subsums};
    while (b->stack_n) {
        const part p = b->stack[--b->stack_n];
        part low = p, high = p;
        if (p.x1 - p.x0 > p.y1 - p.y0)
            low.x1 = high.x0 = p.x0 + (p.x1 - p.x0) / 2;
        else
            low.y1 = high.y0 = p.y0 + (p.y1 - p.y0) / 2;
        b->near_n = p.to; /* lists beyond this belong to parts that are done */
        if (!settle_part(b, &p, low, start) || !settle_part(b, &p, high, start)) return false;
    }
    return !b->g->placed.lattice.arena.failed;
}

/* Sorts the lists by square, so that list_end suffices, and sums up the numbers of open squares. */
static bool arrange_lists(sunder_i_board *h, const uint32_t *start)
{
    const size_t n = h->n;
    uint32_t *list = sunder_i_alloc(h->list_n, sizeof *list);
    if (!list) return false;
    size_t at = 0;
    for (size_t q = 0; q < n * n; q++) {
        const size_t length = h->holder[q] ? 0 : h->list_end[q] - start[q];
        if (length) memcpy(list + at, h->list + start[q], length * sizeof *list);
        at += length;
        h->list_end[q] = (uint32_t)at;
    }
    SUNDER_I_ASSERT(at == h->list_n);
    sunder_i_free(h->list);
    h->list = list;
    for (size_t y = 0; y <= n; y++)
        for (size_t x = 0; x <= n; x++) {
            uint32_t *sum = h->open_below + y * (n + 1) + x;
            *sum = x == 0 || y == 0 ? 0
                                    : sum[-1] + sum[-(ptrdiff_t)n - 1] - sum[-(ptrdiff_t)n - 2] +
                                          (h->holder[(y - 1) * n + x - 1] == 0);
        }
    return true;
}

bool sunder_i_board_build(sunder_i_operands *operands, double reach)
{
    uint32_t n = LEAST;
    while (n < MOST && (size_t)n * n * SUBSUMS_EACH < operands->subsums) n *= 2;
    sunder_i_board *h = sunder_i_calloc(1, sizeof *h);
    if (!h) return false;
    operands->board = h;
    *h = (sunder_i_board){.reach = reach, .per_unit = n / (2 * reach), .n = n};
    const size_t squares = (size_t)n * n;
    h->holder = sunder_i_calloc(squares, sizeof *h->holder);
    h->open_below = sunder_i_alloc((size_t)(n + 1) * (n + 1), sizeof *h->open_below);
    h->list_end = sunder_i_calloc(squares, sizeof *h->list_end);
    uint32_t *start = sunder_i_calloc(squares, sizeof *start);
    board b = {.g = operands, .h = h};
    const bool ok =
        h->holder && h->open_below && h->list_end && start && divide_board(&b, start) && arrange_lists(h, start);
    sunder_i_free_all(b.near, start);
    if (!ok) sunder_i_board_free(operands);
    return ok;
}

void sunder_i_board_free(sunder_i_operands *operands)
{
    sunder_i_board *h = operands->board;
    if (!h) return;
    sunder_i_free_all(h->holder, h->open_below, h->list_end, h->list, h);
    operands->board = NULL;
}

/* Returns the column or row of a coordinate; coordinates beyond the board get its first or last one. */
static uint32_t clamped_cell(const sunder_i_board *h, double v)
{
    const double at = (v + h->reach) * h->per_unit;
    return at > 0 ? at < h->n ? (uint32_t)at : h->n - 1 : 0;
}

bool sunder_i_board_segment(const sunder_i_board *held, double error, double ax, double ay, double dx, double dy)
{
    const double e = 2 * error, bx = ax + dx, by = ay + dy;
    const uint32_t x0 = clamped_cell(held, (ax < bx ? ax : bx) - e),
                   x1 = clamped_cell(held, (ax < bx ? bx : ax) + e) + 1;
    const uint32_t y0 = clamped_cell(held, (ay < by ? ay : by) - e),
                   y1 = clamped_cell(held, (ay < by ? by : ay) + e) + 1;
    const size_t row = (size_t)held->n + 1;
    const uint32_t *s = held->open_below;
    return s[y1 * row + x1] - s[y0 * row + x1] - s[y1 * row + x0] + s[y0 * row + x0] == 0;
}
