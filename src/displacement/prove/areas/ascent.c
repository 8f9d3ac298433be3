/* Prices that prove much: the dual function of prices (README.md), raised by projected gradients.
 *
 * What a payer pays is the least over its places, which has corners: a place that is cheapest by a hair pays for all of
 * its area, and the next step is drawn to another. So the least is taken softly, as -T log of the sum of exp(-f / T)
 * over places, whose gradient has the body a little everywhere that is nearly as cheap. Steps are those of Barzilai and
 * Borwein, shortened where they prove less than the least of the last ten values, a variant of [BMR00]. None of this
 * needs to be right: what the prices prove is worked out of them alone (price_proof.c). */
#include "displacement/prove/areas/areas.h"
#include "displacement/prove/areas/tuning.h"
#include "displacement/prove/areas/window.h"

#include "base/extremes.h"
#include "base/parallel.h"
#include "base/watch.h"

#include <math.h>
#include <string.h>

/* The part of a payer's mass that is at a move, in squares. */
typedef struct part {
    int64_t dx, dy;
    double paid;  /* there */
    double share; /* of 1 */
} part;

/* Where one payer is, and what it pays. */
typedef struct answer {
    part *part; /* [parts] */
    size_t parts, capacity;
    double value;
} answer;

typedef struct ascent {
    const sunder_i_grid *grid;
    const sunder_i_payer *payer;
    size_t n;
    double patience;
    unsigned threads;
    float *price, *half; /* [nodes] excess demand, blurred; scratch */
    answer *answer;      /* [AT_ONCE] for payers that are evaluated together */
} ascent;

/* Asking one payer. */
typedef struct asking {
    const ascent *ascent;
    const sunder_i_payer *payer;
    const float *price;
    answer *answer;
    double farthest; /* the square of how far it may go, in squares */
    double *glance;  /* what it pays at every GLANCES-th place, either way */
    size_t glance_capacity;
} asking;

/* The sum of mass times price over n nodes of a row; in four sums that do not wait for each other. */
static float price_of_row(const int32_t *mass, const float *price, size_t n)
{
    float sum[4] = {0, 0, 0, 0};
    size_t i = 0;
    for (; i + 4 <= n; i += 4)
        for (size_t k = 0; k < 4; k++) sum[k] += (float)mass[i + k] * price[i + k];
    for (; i < n; i++) sum[0] += (float)mass[i] * price[i];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* The price of the payer's area there, in squares. */
static double price_of(const ascent *a, const sunder_i_masses *m, const float *price, int64_t dx, int64_t dy)
{
    const sunder_i_part_on_grid w = sunder_i_part_on(a->grid, m, dx, dy);
    double sum = 0;
    for (size_t j = w.row; j < w.rows; j++)
        sum += (double)price_of_row(m->at + j * m->columns + w.column, price + sunder_i_part_node(a->grid, &w, j),
                                    w.columns - w.column);
    return sum / (double)SUNDER_I_MASS_OF_SQUARE;
}

/* Adds this share of the payer's mass there. */
static void occupy(const ascent *a, const sunder_i_masses *m, double share, int64_t dx, int64_t dy, float *slope)
{
    const sunder_i_part_on_grid w = sunder_i_part_on(a->grid, m, dx, dy);
    const float each = (float)(share / (double)SUNDER_I_MASS_OF_SQUARE);
    for (size_t j = w.row; j < w.rows; j++) {
        float *restrict s = slope + sunder_i_part_node(a->grid, &w, j);
        const int32_t *restrict mass = m->at + j * m->columns + w.column;
        for (size_t i = 0; i < w.columns - w.column; i++) s[i] += each * (float)mass[i];
    }
}

/* It is where it answered; slope: what is asked for there. */
static void occupy_all(const ascent *a, const sunder_i_masses *m, const answer *s, float *slope)
{
    for (const part *p = s->part; p < s->part + s->parts; p++)
        if (p->share > LITTLE) occupy(a, m, p->share, p->dx, p->dy, slope);
}

/* How far the payer looks, in squares: where the way costs more than to stay, nothing is cheaper; nor farther out than
 * just beyond the grid. */
static int64_t reach_of(const asking *a, double stays, double heat)
{
    const double reach = sqrt((stays + TOO_DEAR * heat) / a->payer->weight),
                 beyond = (double)sunder_i_beyond_grid(a->ascent->grid, &a->payer->masses);
    return (int64_t)sunder_i_min(sunder_i_min(reach, beyond), a->payer->limit / a->ascent->grid->side);
}

/* Returns the cost of the way to place (dx, dy) plus its price, or the cost of the way alone if this is >= `most`.
 * Beyond the limit: INFINITY. */
static double paid_at(const asking *a, int64_t dx, int64_t dy, double most)
{
    const double square = (double)(dx * dx + dy * dy), way = a->payer->weight * square;
    if (square > a->farthest) return INFINITY;
    return way < most ? way + price_of(a->ascent, &a->payer->masses, a->price, dx, dy) : way;
}

/* Looks at one place in GLANCES^2, `half` of them from the middle: the least that is paid. */
static double glance(const asking *a, double stays, double doubt, int64_t half)
{
    double least = stays, *seen = a->glance;
    for (int64_t y = -half; y <= half; y++)
        for (int64_t x = -half; x <= half; x++, seen++) {
            *seen = paid_at(a, GLANCES * x, GLANCES * y, least + doubt);
            if (*seen < least) least = *seen;
        }
    return least;
}

/* May a place between these four be as cheap as that? What is paid changes little more from there to there than
 * between them. */
static bool may_be_cheap(const double *seen, size_t across, double most)
{
    const double low = sunder_i_min(sunder_i_min(seen[0], seen[1]), sunder_i_min(seen[across], seen[across + 1]));
    const double high = sunder_i_max(sunder_i_max(seen[0], seen[1]), sunder_i_max(seen[across], seen[across + 1]));
    return low - (high - low) < most;
}

/* The places of one cell that may count. False if memory is out. */
static bool list_cell(asking *a, int64_t x, int64_t y, double doubt, double *least)
{
    answer *s = a->answer;
    if (!sunder_i_reserve(&s->part, &s->capacity, s->parts + GLANCES * GLANCES, sizeof *s->part)) return false;
    for (int64_t dy = GLANCES * y; dy < GLANCES * (y + 1); dy++)
        for (int64_t dx = GLANCES * x; dx < GLANCES * (x + 1); dx++) {
            const double paid = paid_at(a, dx, dy, *least + doubt);
            if (paid >= *least + doubt) continue;
            if (paid < *least) *least = paid;
            s->part[s->parts++] = (part){dx, dy, paid, 0};
        }
    return true;
}

/* Turns what is paid at each place into its share of the payer, and computes the payer's soft minimum. */
static void weigh_shares(answer *s, double heat, double least)
{
    double sum = 0;
    size_t n = 0;
    for (size_t k = 0; k < s->parts; k++) {
        if (s->part[k].paid >= least + TOO_DEAR * heat) continue;
        s->part[n] = s->part[k];
        s->part[n].share = exp((least - s->part[k].paid) / heat);
        sum += s->part[n++].share;
    }
    s->parts = n;
    for (size_t k = 0; k < n; k++) s->part[k].share /= sum;
    s->value = least - heat * log(sum);
}

/* The payer's places, each with its share of it. False if memory is out. */
static bool find_shares(asking *a, double stays)
{
    const sunder_i_payer *payer = a->payer;
    const double heat = a->ascent->patience * payer->weight, doubt = TOO_DEAR * heat;
    const int64_t half = reach_of(a, stays, heat) / GLANCES + 1;
    const size_t across = (size_t)(2 * half + 1);
    if (!sunder_i_reserve(&a->glance, &a->glance_capacity, across * across, sizeof *a->glance)) return false;
    const double limit = payer->limit / a->ascent->grid->side;
    a->farthest = limit * limit;
    double least = glance(a, stays, doubt, half);
    for (int64_t y = -half; y < half; y++)
        for (int64_t x = -half; x < half; x++) {
            const double *seen = a->glance + (size_t)(y + half) * across + (size_t)(x + half);
            if (!may_be_cheap(seen, across, least + doubt)) continue;
            if (!list_cell(a, x, y, doubt, &least)) return false;
        }
    weigh_shares(a->answer, heat, least);
    return true;
}

/* Finds the payer's parts: one whole part if staying costs nothing. False if memory is out. */
static bool ask_payer(asking *a)
{
    answer *s = a->answer;
    const double stays = price_of(a->ascent, &a->payer->masses, a->price, 0, 0);
    s->parts = 0;
    if (stays > 0) return find_shares(a, stays);
    if (!sunder_i_reserve(&s->part, &s->capacity, 1, sizeof *s->part)) return false;
    s->part[s->parts++] = (part){.share = 1};
    s->value = 0;
    return true;
}

/* Payers that are evaluated at once, from the first of them. */
typedef struct batch {
    const ascent *ascent;
    const float *price;
    size_t first;
} batch;

static sunder_status ask_some(void *context, size_t begin, size_t end, sunder_error *err)
{
    const batch *b = context;
    asking a = {.ascent = b->ascent, .price = b->price};
    bool ok = true;
    for (size_t k = begin; k < end && ok; k++) {
        a.payer = &b->ascent->payer[b->first + k];
        a.answer = &b->ascent->answer[k];
        ok = sunder_i_step() && ask_payer(&a);
    }
    sunder_i_free(a.glance);
    return ok ? SUNDER_OK : sunder_i_no_memory(err);
}

/* Evaluates payers from the first on, as many at once as there is room for their answers: their number; 0 if memory is
 * out. */
static size_t ask_at_once(const ascent *a, const float *price, size_t first)
{
    batch b = {a, price, first};
    const size_t n = a->n - first < AT_ONCE ? a->n - first : AT_ONCE;
    return sunder_i_parallel(a->threads, n, SUNDER_I_GRAIN_PAIRS, ask_some, &b, NULL) ? 0 : n;
}

/* Each node's mean with its neighbours, 1 : 2 : 1 along one axis: from in[] to out[], [nodes]; beyond the border all
 * are 0. */
static void blur_along(const sunder_i_grid *l, size_t stride, const float *restrict in, float *restrict out)
{
    const size_t nodes = sunder_i_grid_nodes(l), last = nodes - stride; /* a grid is wider than its borders */
    for (size_t k = 0; k < stride; k++) out[k] = (2 * in[k] + in[k + stride]) / 4;
    for (size_t k = stride; k < last; k++) out[k] = (in[k - stride] + 2 * in[k] + in[k + stride]) / 4;
    for (size_t k = last; k < nodes; k++) out[k] = (in[k - stride] + 2 * in[k]) / 4;
}

/* The same along both axes, BLURRED times. The operator is its own transpose; demand has a margin for the spread. */
static void blur(const ascent *a, float *field)
{
    for (int k = 0; k < BLURRED; k++) {
        blur_along(a->grid, 1, field, a->half);
        blur_along(a->grid, a->grid->columns, a->half, field);
    }
}

/* What prices promise that are `wish`, blurred, and the direction in which that grows. False if memory is out. */
static bool ask_all(ascent *a, const float *wish, float *slope, double *value)
{
    const size_t nodes = sunder_i_grid_nodes(a->grid);
    memcpy(a->price, wish, nodes * sizeof *wish);
    blur(a, a->price);
    *value = 0;
    for (size_t k = 0; k < nodes; k++) {
        *value -= a->price[k];
        slope[k] = -1;
    }
    /* Sums are taken in the order of payers, whichever thread asked them. */
    for (size_t first = 0, n; first < a->n; first += n) {
        n = ask_at_once(a, a->price, first);
        if (!n) return false;
        for (size_t k = 0; k < n; k++) {
            *value += a->answer[k].value;
            occupy_all(a, &a->payer[first + k].masses, &a->answer[k], slope);
        }
    }
    blur(a, slope);
    return true;
}

/* Nodes at the border have no price: two rows and columns on each side, and what blurring spreads. Of row j the first
 * inner node and the end of them; none of some rows. */
static void inner_nodes(const sunder_i_grid *l, size_t j, size_t *first, size_t *end)
{
    const size_t border = SUNDER_I_GRID_BORDER, row = j * l->columns;
    const bool any = j >= border && j + border < l->rows && l->columns > 2 * border;
    *first = any ? row + border : row + l->columns;
    *end = any ? row + l->columns - border : *first;
}

/* Prices of a coarser grid, being blurred, may lie beyond the inner nodes that this grid allows to have a price: these
 * are removed. A shortened step would keep part of them, nearer to the border with each level. */
static void keep_inner(const sunder_i_grid *l, float *price)
{
    for (size_t j = 0; j < l->rows; j++) {
        size_t first, end;
        inner_nodes(l, j, &first, &end);
        for (size_t k = j * l->columns; k < first; k++) price[k] = 0;
        for (size_t k = end; k < (j + 1) * l->columns; k++) price[k] = 0;
    }
}

typedef struct place {
    float *price, *slope;
    double value;
} place;

/* To `to` of one node. */
static inline void propose_node(const place *at, size_t k, double to, float *step, double *gain)
{
    step[k] = (float)to - at->price[k];
    *gain += (double)step[k] * (double)at->slope[k];
}

/* The step from `at`, so long, as far as prices stay at 0 or more; *gain: what it promises at first. */
static void propose(const sunder_i_grid *l, const place *at, double length, float *step, double *gain)
{
    *gain = 0;
    for (size_t j = 0; j < l->rows; j++) {
        size_t first, end, k = j * l->columns;
        inner_nodes(l, j, &first, &end);
        for (; k < first; k++) propose_node(at, k, 0, step, gain);
        for (; k < end; k++) {
            const double to = (double)at->price[k] + length * (double)at->slope[k];
            propose_node(at, k, to > 0 ? to : 0, step, gain);
        }
        for (; k < (j + 1) * l->columns; k++) propose_node(at, k, 0, step, gain);
    }
}

/* The length of the next step, from what the last did to the slope. */
static double next_length(const sunder_i_grid *l, const place *from, const place *to)
{
    double ways = 0, turns = 0;
    for (size_t k = 0; k < sunder_i_grid_nodes(l); k++) {
        const double way = (double)to->price[k] - (double)from->price[k];
        ways += way * way;
        turns += way * ((double)from->slope[k] - (double)to->slope[k]);
    }
    return turns > 0 ? sunder_i_min(sunder_i_max(ways / turns, STEP_LEAST), STEP_MOST) : STEP_BLIND;
}

/* As much of the step as promises something beyond `least`; `other` is where that leads. */
static bool go(ascent *a, const place *at, place *other, const float *step, double gain, double least)
{
    double share = 1;
    for (int k = 0; k < SHORTENED; k++, share *= SHORTER) {
        for (size_t m = 0; m < sunder_i_grid_nodes(a->grid); m++)
            other->price[m] = at->price[m] + (float)share * step[m];
        if (!ask_all(a, other->price, other->slope, &other->value)) return false;
        if (other->value >= least + ENOUGH * share * gain) break;
    }
    return true;
}

static bool climb(ascent *a, place *at, place *other, float *step, unsigned rounds)
{
    double length = FIRST_STEP, gain, last[REMEMBERED];
    if (!ask_all(a, at->price, at->slope, &at->value)) return false;
    for (int k = 0; k < REMEMBERED; k++) last[k] = at->value;
    for (unsigned round = 0; round < rounds; round++) {
        propose(a->grid, at, length, step, &gain);
        double least = at->value;
        for (int k = 0; k < REMEMBERED; k++) least = sunder_i_min(least, last[k]);
        if (!go(a, at, other, step, gain, least)) return false;
        length = next_length(a->grid, at, other);
        const place swap = *at;
        *at = *other;
        *other = swap;
        last[round % REMEMBERED] = at->value;
    }
    return true;
}

static bool begin_answers(ascent *a)
{
    a->answer = sunder_i_calloc(AT_ONCE, sizeof *a->answer);
    return a->answer;
}

static void end_answers(ascent *a)
{
    for (size_t k = 0; k < AT_ONCE && a->answer; k++) sunder_i_free(a->answer[k].part);
    sunder_i_free(a->answer);
}

bool sunder_i_prices_ascend(const sunder_i_grid *grid, const sunder_i_payer *payer, size_t n, double patience,
                            unsigned rounds, unsigned threads, float *price)
{
    const size_t nodes = sunder_i_grid_nodes(grid);
    ascent a = {.grid = grid, .payer = payer, .n = n, .patience = patience, .threads = threads};
    float *work = sunder_i_alloc(7 * nodes, sizeof *work);
    bool ok = work && begin_answers(&a);
    if (ok) {
        a.price = work + 5 * nodes;
        a.half = work + 6 * nodes;
        place at = {work, work + nodes, 0}, other = {work + 2 * nodes, work + 3 * nodes, 0};
        memcpy(at.price, price, nodes * sizeof *price);
        keep_inner(grid, at.price);
        ok = climb(&a, &at, &other, work + 4 * nodes, rounds);
        if (ok) memcpy(price, at.price, nodes * sizeof *price);
        if (ok) blur(&a, price);
    }
    end_answers(&a);
    sunder_i_free(work);
    return ok;
}

/* Weighted mean of the places that the payer chose. */
static void find_mean(const ascent *a, const answer *s, double move[2])
{
    move[0] = move[1] = 0;
    for (const part *p = s->part; p < s->part + s->parts; p++) {
        move[0] += p->share * (double)p->dx * a->grid->side;
        move[1] += p->share * (double)p->dy * a->grid->side;
    }
}

bool sunder_i_prices_places(const sunder_i_grid *grid, const sunder_i_payer *payer, size_t n, double patience,
                            unsigned threads, const float *price, double *move)
{
    ascent a = {.grid = grid, .payer = payer, .n = n, .patience = patience, .threads = threads};
    bool ok = begin_answers(&a);
    for (size_t first = 0, asked; first < n && ok; first += asked) {
        asked = ask_at_once(&a, price, first);
        ok = asked;
        for (size_t k = 0; k < asked; k++) find_mean(&a, &a.answer[k], move + 2 * (first + k));
    }
    end_answers(&a);
    return ok;
}
