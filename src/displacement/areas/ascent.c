/* Prices that prove much: the dual function of prices (README.md), raised by projected gradients.
 *
 * What a payer pays is the least over its places, which has corners: a place that is cheapest by a hair pays for all of
 * its area, and the next step is drawn to another. So the least is taken softly, as -T log of the sum of exp(-f / T)
 * over places, whose gradient has the body a little everywhere that is nearly as cheap. Steps are those of Barzilai and
 * Borwein, shortened where they prove less than the least of the last ten values, a variant of [BMR00]. None of this
 * needs to be right: what the prices prove is worked out of them alone (least.c). */
#include "displacement/areas/areas.h"
#include "displacement/areas/tuning.h"
#include "displacement/areas/window.h"

#include "base/watch.h"

#include <math.h>
#include <string.h>

/* What of a payer is at a move, in squares. */
typedef struct part {
    int64_t dx, dy;
    double paid;  /* there */
    double share; /* of 1; weigh_shares() */
} part;

typedef struct ascent {
    const sunder_i_grid *grid;
    const sunder_i_payer *payer;
    size_t n;
    double patience;
    float *price, *half; /* [nodes] what is wished for, blurred; scratch */
    double *glance;      /* of one payer: what it pays at every GLANCES-th place, either way */
    part *part;          /* [parts] of one payer */
    size_t parts, part_capacity, glance_capacity;
    double farthest; /* the square of how far it may go, in squares */
} ascent;

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

/* So much of the payer is there. */
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

/* How far a payer looks, in squares: where the way costs more than to stay, nothing is cheaper. */
static int64_t reach_of(const ascent *a, const sunder_i_payer *payer, double stays, double heat)
{
    const double reach = sqrt((stays + TOO_DEAR * heat) / payer->weight);
    return (int64_t)fmin(reach, payer->limit / a->grid->side);
}

/* Way and price of one place; the way alone where that is too dear to count. Nothing is beyond its limit. */
static double paid_at(const ascent *a, const sunder_i_payer *payer, const float *price, int64_t dx, int64_t dy,
                      double most)
{
    const double square = (double)(dx * dx + dy * dy), way = payer->weight * square;
    if (square > a->farthest) return INFINITY;
    return way < most ? way + price_of(a, &payer->masses, price, dx, dy) : way;
}

/* Looks at one place in GLANCES^2, `half` of them from the middle: the least that is paid. */
static double glance(const ascent *a, const sunder_i_payer *payer, const float *price, double stays, double doubt,
                     int64_t half)
{
    double least = stays, *seen = a->glance;
    for (int64_t y = -half; y <= half; y++)
        for (int64_t x = -half; x <= half; x++, seen++) {
            *seen = paid_at(a, payer, price, GLANCES * x, GLANCES * y, least + doubt);
            if (*seen < least) least = *seen;
        }
    return least;
}

/* May a place between these four be as cheap as that? What is paid changes little more from there to there than
 * between them. */
static bool may_be_cheap(const double *seen, size_t across, double most)
{
    const double low = fmin(fmin(seen[0], seen[1]), fmin(seen[across], seen[across + 1]));
    const double high = fmax(fmax(seen[0], seen[1]), fmax(seen[across], seen[across + 1]));
    return low - (high - low) < most;
}

/* The places of one cell that may count. False if memory is out. */
static bool list_cell(ascent *a, const sunder_i_payer *payer, const float *price, int64_t x, int64_t y, double doubt,
                      double *least)
{
    if (!sunder_i_reserve(&a->part, &a->part_capacity, a->parts + GLANCES * GLANCES, sizeof *a->part)) return false;
    for (int64_t dy = GLANCES * y; dy < GLANCES * (y + 1); dy++)
        for (int64_t dx = GLANCES * x; dx < GLANCES * (x + 1); dx++) {
            const double paid = paid_at(a, payer, price, dx, dy, *least + doubt);
            if (paid >= *least + doubt) continue;
            if (paid < *least) *least = paid;
            a->part[a->parts++] = (part){dx, dy, paid, 0};
        }
    return true;
}

/* Of places that count each one's share, from what is paid there; *value: what the payer pays, softly. */
static void weigh_shares(ascent *a, double heat, double least, double *value)
{
    double sum = 0;
    size_t n = 0;
    for (size_t k = 0; k < a->parts; k++) {
        if (a->part[k].paid >= least + TOO_DEAR * heat) continue;
        a->part[n] = a->part[k];
        a->part[n].share = exp((least - a->part[k].paid) / heat);
        sum += a->part[n++].share;
    }
    a->parts = n;
    for (size_t k = 0; k < n; k++) a->part[k].share /= sum;
    *value = least - heat * log(sum);
}

/* The payer's places, each with its share of it: a->part. False if memory is out. */
static bool find_shares(ascent *a, const sunder_i_payer *payer, const float *price, double stays, double *value)
{
    const double heat = a->patience * payer->weight, doubt = TOO_DEAR * heat;
    const int64_t half = reach_of(a, payer, stays, heat) / GLANCES + 1;
    const size_t across = (size_t)(2 * half + 1);
    if (!sunder_i_reserve(&a->glance, &a->glance_capacity, across * across, sizeof *a->glance)) return false;
    const double limit = payer->limit / a->grid->side;
    a->farthest = limit * limit;
    double least = glance(a, payer, price, stays, doubt, half);
    a->parts = 0;
    for (int64_t y = -half; y < half; y++)
        for (int64_t x = -half; x < half; x++) {
            const double *seen = a->glance + (size_t)(y + half) * across + (size_t)(x + half);
            if (!may_be_cheap(seen, across, least + doubt)) continue;
            if (!list_cell(a, payer, price, x, y, doubt, &least)) return false;
        }
    weigh_shares(a, heat, least, value);
    return true;
}

/* What it pays, softly; slope: where it is then. False if memory is out. */
static bool ask_payer(ascent *a, const sunder_i_payer *payer, const float *price, float *slope, double *value)
{
    const double stays = price_of(a, &payer->masses, price, 0, 0);
    *value = 0;
    if (!(stays > 0)) {
        occupy(a, &payer->masses, 1, 0, 0, slope);
        return true;
    }
    if (!find_shares(a, payer, price, stays, value)) return false;
    for (const part *s = a->part; s < a->part + a->parts; s++)
        if (s->share > LITTLE) occupy(a, &payer->masses, s->share, s->dx, s->dy, slope);
    return true;
}

/* Where it is in the mean. */
static bool find_mean(ascent *a, const sunder_i_payer *payer, const float *price, double move[2])
{
    const double stays = price_of(a, &payer->masses, price, 0, 0);
    move[0] = move[1] = 0;
    if (!(stays > 0)) return true;
    double value;
    if (!find_shares(a, payer, price, stays, &value)) return false;
    for (const part *s = a->part; s < a->part + a->parts; s++) {
        move[0] += s->share * (double)s->dx * a->grid->side;
        move[1] += s->share * (double)s->dy * a->grid->side;
    }
    return true;
}

/* Each node's mean with its neighbours, 1 : 2 : 1 along one axis: from in[] to out[], [nodes]; beyond the border all
 * are 0. */
static void blur_along(const sunder_i_grid *l, size_t stride, const float *in, float *out)
{
    const size_t nodes = sunder_i_grid_nodes(l);
    for (size_t k = 0; k < nodes; k++) {
        const float before = k >= stride ? in[k - stride] : 0, after = k + stride < nodes ? in[k + stride] : 0;
        out[k] = (before + 2 * in[k] + after) / 4;
    }
}

/* The same along both, BLURRED times. It is its own transpose; what is asked for has room about it for what it
 * spreads. */
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
    for (size_t k = 0; k < a->n; k++) {
        double own;
        if (!sunder_i_step() || !ask_payer(a, &a->payer[k], a->price, slope, &own)) return false;
        *value += own;
    }
    blur(a, slope);
    return true;
}

/* Nodes at the border have no price: two rows and columns on each side, and what blurring spreads. */
static bool is_inner(const sunder_i_grid *l, size_t node)
{
    const size_t i = node % l->columns, j = node / l->columns, border = SUNDER_I_GRID_BORDER;
    return i >= border && j >= border && i + border < l->columns && j + border < l->rows;
}

/* What a coarser grid's prices, which are blurred, ask for beyond inner nodes is nothing that this grid may ask for: a
 * step that is shortened would leave some of it, level after level nearer to the border. */
static void keep_inner(const sunder_i_grid *l, float *price)
{
    for (size_t k = 0; k < sunder_i_grid_nodes(l); k++)
        if (!is_inner(l, k)) price[k] = 0;
}

typedef struct place {
    float *price, *slope;
    double value;
} place;

/* The step from `at`, so long, as far as prices stay at 0 or more; *gain: what it promises at first. */
static void propose(const sunder_i_grid *l, const place *at, double length, float *step, double *gain)
{
    *gain = 0;
    for (size_t k = 0; k < sunder_i_grid_nodes(l); k++) {
        const double to = is_inner(l, k) ? fmax((double)at->price[k] + length * (double)at->slope[k], 0) : 0;
        step[k] = (float)to - at->price[k];
        *gain += (double)step[k] * (double)at->slope[k];
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
    return turns > 0 ? fmin(fmax(ways / turns, STEP_LEAST), STEP_MOST) : STEP_BLIND;
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
        for (int k = 0; k < REMEMBERED; k++) least = fmin(least, last[k]);
        if (!go(a, at, other, step, gain, least)) return false;
        length = next_length(a->grid, at, other);
        const place swap = *at;
        *at = *other;
        *other = swap;
        last[round % REMEMBERED] = at->value;
    }
    return true;
}

bool sunder_i_prices_ascend(const sunder_i_grid *grid, const sunder_i_payer *payer, size_t n, double patience,
                            unsigned rounds, float *price)
{
    const size_t nodes = sunder_i_grid_nodes(grid);
    ascent a = {.grid = grid, .payer = payer, .n = n, .patience = patience};
    float *work = sunder_i_alloc(7 * nodes, sizeof *work);
    bool ok = work;
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
    sunder_i_free(a.glance);
    sunder_i_free(a.part);
    sunder_i_free(work);
    return ok;
}

bool sunder_i_prices_places(const sunder_i_grid *grid, const sunder_i_payer *payer, size_t n, double patience,
                            const float *price, double *move)
{
    ascent a = {.grid = grid, .payer = payer, .n = n, .patience = patience};
    bool ok = true;
    for (size_t k = 0; k < n && ok; k++) ok = sunder_i_step() && find_mean(&a, &payer[k], price, move + 2 * k);
    sunder_i_free(a.glance);
    sunder_i_free(a.part);
    return ok;
}
