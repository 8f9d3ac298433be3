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

typedef struct ascent {
    const sunder_i_grid *grid;
    const sunder_i_payer *payer;
    size_t n;
    double patience;
    float *price, *half; /* [nodes] what is wished for, blurred; scratch */
    double *paid;        /* [(2 * reach + 1)^2] of one payer, by its move */
    size_t paid_capacity;
} ascent;

/* The price of the payer's area there, in squares. */
static double price_of(const ascent *a, const sunder_i_masses *m, const float *price, int64_t dx, int64_t dy)
{
    const sunder_i_part_on_grid w = sunder_i_part_on(a->grid, m, dx, dy);
    double sum = 0;
    for (size_t j = w.row; j < w.rows; j++) {
        const float *p = price + sunder_i_part_node(a->grid, &w, j);
        const int32_t *mass = m->at + j * m->columns + w.column;
        for (size_t i = 0; i < w.columns - w.column; i++) sum += (double)mass[i] * (double)p[i];
    }
    return sum / (double)SUNDER_I_MASS_OF_SQUARE;
}

/* So much of the payer is there. */
static void occupy(const ascent *a, const sunder_i_masses *m, double share, int64_t dx, int64_t dy, float *slope)
{
    const sunder_i_part_on_grid w = sunder_i_part_on(a->grid, m, dx, dy);
    share /= (double)SUNDER_I_MASS_OF_SQUARE;
    for (size_t j = w.row; j < w.rows; j++) {
        float *s = slope + sunder_i_part_node(a->grid, &w, j);
        const int32_t *mass = m->at + j * m->columns + w.column;
        for (size_t i = 0; i < w.columns - w.column; i++) s[i] += (float)(share * mass[i]);
    }
}

/* How far a payer looks, in squares: where the way costs more than to stay, nothing is cheaper. */
static int64_t reach_of(const ascent *a, const sunder_i_payer *payer, double stays, double heat)
{
    const double reach = sqrt((stays + TOO_DEAR * heat) / payer->weight);
    return (int64_t)fmin(reach, payer->limit / a->grid->side);
}

/* The payer's places, each with its share of it: a->paid, [(2 * reach + 1)^2]. *value: what it pays, softly. False if
 * memory is out. */
static bool find_shares(ascent *a, const sunder_i_payer *payer, const float *price, double stays, int64_t *reach,
                        double *value)
{
    const double heat = a->patience * payer->weight;
    *reach = reach_of(a, payer, stays, heat);
    const size_t across = (size_t)(2 * *reach + 1), places = across * across;
    if (!sunder_i_reserve(&a->paid, &a->paid_capacity, places, sizeof *a->paid)) return false;
    double least = stays, *paid = a->paid, sum = 0;
    for (int64_t dy = -*reach; dy <= *reach; dy++)
        for (int64_t dx = -*reach; dx <= *reach; dx++, paid++) {
            *paid = payer->weight * (double)(dx * dx + dy * dy);
            if (*paid < least + TOO_DEAR * heat) *paid += price_of(a, &payer->masses, price, dx, dy);
            least = fmin(least, *paid);
        }
    for (size_t k = 0; k < places; k++) {
        a->paid[k] = a->paid[k] < least + TOO_DEAR * heat ? exp((least - a->paid[k]) / heat) : 0;
        sum += a->paid[k];
    }
    for (size_t k = 0; k < places; k++) a->paid[k] /= sum;
    *value = least - heat * log(sum);
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
    int64_t reach;
    if (!find_shares(a, payer, price, stays, &reach, value)) return false;
    const double *share = a->paid;
    for (int64_t dy = -reach; dy <= reach; dy++)
        for (int64_t dx = -reach; dx <= reach; dx++, share++)
            if (*share > LITTLE) occupy(a, &payer->masses, *share, dx, dy, slope);
    return true;
}

/* Where it is in the mean. */
static bool find_mean(ascent *a, const sunder_i_payer *payer, const float *price, double move[2])
{
    const double stays = price_of(a, &payer->masses, price, 0, 0);
    move[0] = move[1] = 0;
    if (!(stays > 0)) return true;
    int64_t reach;
    double value;
    if (!find_shares(a, payer, price, stays, &reach, &value)) return false;
    const double *share = a->paid;
    for (int64_t dy = -reach; dy <= reach; dy++)
        for (int64_t dx = -reach; dx <= reach; dx++, share++) {
            move[0] += *share * (double)dx * a->grid->side;
            move[1] += *share * (double)dy * a->grid->side;
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
    sunder_i_free(a.paid);
    sunder_i_free(work);
    return ok;
}

bool sunder_i_prices_places(const sunder_i_grid *grid, const sunder_i_payer *payer, size_t n, double patience,
                            const float *price, double *move)
{
    ascent a = {.grid = grid, .payer = payer, .n = n, .patience = patience};
    bool ok = true;
    for (size_t k = 0; k < n && ok; k++) ok = sunder_i_step() && find_mean(&a, &payer[k], price, move + 2 * k);
    sunder_i_free(a.paid);
    return ok;
}
