/* Finds prices that prove a large bound: the dual function of the prices (README.md) is maximised by projected gradient
 * steps.
 *
 * A payer pays the least total over its moves. As a function of the prices that minimum is not smooth: the move that is
 * cheapest by a tiny amount determines the whole gradient, and the next step makes another move the cheapest. It is
 * therefore replaced by a soft minimum, -T log of the sum of exp(-f / T) over the moves, where f is the total of a
 * move; its gradient gives each move that is nearly the cheapest a share of the payer. Step lengths are those of
 * Barzilai and Borwein; a step is shortened if its value is less than the least of the last ten values, a variant of
 * [BMR00]. An error here cannot make a bound wrong, since the bound is computed from the final prices alone
 * (price_proof.c). */
#include "displacement/prove/areas/areas.h"
#include "displacement/prove/areas/tuning.h"
#include "displacement/prove/areas/window.h"

#include "base/extremes.h"
#include "base/parallel.h"
#include "base/watch.h"

#include <math.h>
#include <string.h>

/* One move of a payer, by whole squares, and the share of the payer's mass that takes that move. */
typedef struct part {
    int64_t dx, dy;
    double paid;  /* the cost of the move plus the price of the area occupied after it */
    double share; /* the fraction of the payer, between 0 and 1 */
} part;

/* The moves among which one payer is divided at the present prices, and the soft minimum that it pays. */
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
    float *price, *half; /* [nodes] `price`: the prices after smoothing; `half`: scratch space for the smoothing */
    answer *answer;      /* [AT_ONCE] the answers of the payers that are evaluated together */
} ascent;

/* The evaluation of one payer at given prices. */
typedef struct asking {
    const ascent *ascent;
    const sunder_i_payer *payer;
    const float *price;
    answer *answer;
    double farthest; /* the square of the payer's limit, in squares of the grid */
    double *glance;  /* what the payer pays at the sampled moves, one in GLANCES along either axis */
    size_t glance_capacity;
} asking;

/* Returns the sum of mass[i] * price[i] over i < n. It uses four partial sums, so that one addition need not wait for
 * the one before. */
static float price_of_row(const int32_t *mass, const float *price, size_t n)
{
    float sum[4] = {0, 0, 0, 0};
    size_t i = 0;
    for (; i + 4 <= n; i += 4)
        for (size_t k = 0; k < 4; k++) sum[k] += (float)mass[i + k] * price[i + k];
    for (; i < n; i++) sum[0] += (float)mass[i] * price[i];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* Returns the price of the area that payer mass `m` occupies after a move by (dx, dy) squares; the area is counted in
 * squares. */
static double price_of(const ascent *a, const sunder_i_masses *m, const float *price, int64_t dx, int64_t dy)
{
    const sunder_i_grid_window w = sunder_i_grid_window_of(a->grid, m, dx, dy);
    double sum = 0;
    for (size_t j = w.row; j < w.rows; j++)
        sum += (double)price_of_row(m->at + j * m->columns + w.column,
                                    price + sunder_i_grid_window_node(a->grid, &w, j), w.columns - w.column);
    return sum / (double)SUNDER_I_MASS_OF_SQUARE;
}

/* Adds `share` times the mass `m`, moved by (dx, dy) squares, to the demand slope[] at the nodes. */
static void occupy_place(const ascent *a, const sunder_i_masses *m, double share, int64_t dx, int64_t dy, float *slope)
{
    const sunder_i_grid_window w = sunder_i_grid_window_of(a->grid, m, dx, dy);
    const float each = (float)(share / (double)SUNDER_I_MASS_OF_SQUARE);
    for (size_t j = w.row; j < w.rows; j++) {
        float *restrict s = slope + sunder_i_grid_window_node(a->grid, &w, j);
        const int32_t *restrict mass = m->at + j * m->columns + w.column;
        for (size_t i = 0; i < w.columns - w.column; i++) s[i] += each * (float)mass[i];
    }
}

/* Adds the payer's mass to the demand slope[], divided among the moves of the answer `s` according to their shares.
 * Shares of at most LITTLE are left out. */
static void occupy_all(const ascent *a, const sunder_i_masses *m, const answer *s, float *slope)
{
    for (const part *p = s->part; p < s->part + s->parts; p++)
        if (p->share > LITTLE) occupy_place(a, m, p->share, p->dx, p->dy, slope);
}

/* Returns how far from its original position the payer has to be evaluated, in squares. `stays` is the price of
 * staying, `heat` the temperature T. Farther moves cost more than staying by themselves, exceed the limit, or go so far
 * outside the grid that moving on changes no price. */
static int64_t reach_of(const asking *a, double stays, double heat)
{
    const double reach = sqrt((stays + TOO_DEAR * heat) / a->payer->weight),
                 beyond = (double)sunder_i_beyond_grid(a->ascent->grid, &a->payer->masses);
    return (int64_t)sunder_i_min(sunder_i_min(reach, beyond), a->payer->limit / a->ascent->grid->side);
}

/* Returns the cost of the move by (dx, dy) squares plus the price of the area occupied after it. If the cost of the
 * move alone is >= `most`, that cost is returned without the price. Returns INFINITY if the move exceeds the limit. */
static double paid_at(const asking *a, int64_t dx, int64_t dy, double most)
{
    const double square = (double)(dx * dx + dy * dy), way = a->payer->weight * square;
    if (square > a->farthest) return INFINITY;
    return way < most ? way + price_of(a->ascent, &a->payer->masses, a->price, dx, dy) : way;
}

/* Evaluates the moves by multiples of GLANCES squares, up to `half` multiples along either axis, and stores what is
 * paid in a->glance. Returns the least of these values and `stays`. Moves that by themselves cost more than that least
 * plus `doubt` are stored without their price. */
static double sample_places(const asking *a, double stays, double doubt, int64_t half)
{
    double least = stays, *seen = a->glance;
    for (int64_t y = -half; y <= half; y++)
        for (int64_t x = -half; x <= half; x++, seen++) {
            *seen = paid_at(a, GLANCES * x, GLANCES * y, least + doubt);
            if (*seen < least) least = *seen;
        }
    return least;
}

/* Returns whether a move between four sampled ones may cost less than `most`. seen[0], seen[1], seen[across] and
 * seen[across + 1] are what is paid at the samples; it is assumed that between them the value falls below the least by
 * no more than the four values differ. */
static bool may_be_cheap(const double *seen, size_t across, double most)
{
    const double low = sunder_i_min(sunder_i_min(seen[0], seen[1]), sunder_i_min(seen[across], seen[across + 1]));
    const double high = sunder_i_max(sunder_i_max(seen[0], seen[1]), sunder_i_max(seen[across], seen[across + 1]));
    return low - (high - low) < most;
}

/* Adds the moves of the sampling cell (x, y), GLANCES x GLANCES of them, to the answer if they cost less than *least +
 * doubt; *least is lowered to the least found. Returns false if memory is out. */
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

/* Computes the share of each listed move from what is paid there, at temperature `heat`, and the payer's soft minimum.
 * `least` is the least that is paid. Moves that are dearer than it by TOO_DEAR temperatures are removed. */
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

/* Finds the moves among which the payer is divided, with their shares. `stays` is what the payer pays without a move.
 * Returns false if memory is out. */
static bool find_shares(asking *a, double stays)
{
    const sunder_i_payer *payer = a->payer;
    const double heat = a->ascent->patience * payer->weight, doubt = TOO_DEAR * heat;
    const int64_t half = reach_of(a, stays, heat) / GLANCES + 1;
    const size_t across = (size_t)(2 * half + 1);
    if (!sunder_i_reserve(&a->glance, &a->glance_capacity, across * across, sizeof *a->glance)) return false;
    const double limit = payer->limit / a->ascent->grid->side;
    a->farthest = limit * limit;
    double least = sample_places(a, stays, doubt, half);
    for (int64_t y = -half; y < half; y++)
        for (int64_t x = -half; x < half; x++) {
            const double *seen = a->glance + (size_t)(y + half) * across + (size_t)(x + half);
            if (!may_be_cheap(seen, across, least + doubt)) continue;
            if (!list_cell(a, x, y, doubt, &least)) return false;
        }
    weigh_shares(a->answer, heat, least);
    return true;
}

/* Computes the answer of the payer a->payer. If staying costs nothing, the payer stays with all of its mass; otherwise
 * its shares are found. Returns false if memory is out. */
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

/* Payers that are evaluated at once: those from index `first` on. */
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
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

/* Evaluates the payers from index `first` on, at most AT_ONCE of them. Returns how many were evaluated, or 0 if memory
 * is out. */
static size_t ask_at_once(const ascent *a, const float *price, size_t first)
{
    batch b = {a, price, first};
    const size_t n = a->n - first < AT_ONCE ? a->n - first : AT_ONCE;
    return sunder_i_parallel(a->threads, n, SUNDER_I_GRAIN_PAIRS, ask_some, &b, NULL) ? 0 : n;
}

/* Smooths a field along one axis: out[k] becomes the mean of in[k] and its two neighbours at distance `stride`, with
 * weights 2, 1 and 1. Both arrays have one entry for each node; entries outside the grid count as 0. */
static void blur_along(const sunder_i_grid *l, size_t stride, const float *restrict in, float *restrict out)
{
    /* a grid has more rows than its two borders, so nodes > stride */
    const size_t nodes = sunder_i_grid_nodes(l), last = nodes - stride;
    for (size_t k = 0; k < stride; k++) out[k] = (2 * in[k] + in[k + stride]) / 4;
    for (size_t k = stride; k < last; k++) out[k] = (in[k - stride] + 2 * in[k] + in[k + stride]) / 4;
    for (size_t k = last; k < nodes; k++) out[k] = (in[k - stride] + 2 * in[k]) / 4;
}

/* Smooths `field` along both axes, BLURRED times. The operator equals its transpose, so it also turns the gradient by
 * smoothed prices into the gradient by the unsmoothed ones. The border without prices is wide enough for what the
 * smoothing spreads. */
static void blur_field(const ascent *a, float *field)
{
    for (int k = 0; k < BLURRED; k++) {
        blur_along(a->grid, 1, field, a->half);
        blur_along(a->grid, a->grid->columns, a->half, field);
    }
}

/* Computes the dual function at the unsmoothed prices `wish`: sets *value to the (soft) bound and slope[] to its
 * gradient. Returns false if memory is out. */
static bool ask_all(ascent *a, const float *wish, float *slope, double *value)
{
    const size_t nodes = sunder_i_grid_nodes(a->grid);
    memcpy(a->price, wish, nodes * sizeof *wish);
    blur_field(a, a->price);
    *value = 0;
    for (size_t k = 0; k < nodes; k++) {
        *value -= a->price[k];
        slope[k] = -1;
    }
    /* Answers are added in the order of the payers, so the sum does not depend on which thread computed them. */
    for (size_t first = 0, n; first < a->n; first += n) {
        n = ask_at_once(a, a->price, first);
        if (!n) return false;
        for (size_t k = 0; k < n; k++) {
            *value += a->answer[k].value;
            occupy_all(a, &a->payer[first + k].masses, &a->answer[k], slope);
        }
    }
    blur_field(a, slope);
    return true;
}

/* Sets *first and *end to the range of nodes of row j that may have a price, the inner nodes; the range is empty for
 * the rows of the border. The border has two rows and columns on each side that keep the price 0, and those over which
 * smoothing spreads. */
static void inner_nodes(const sunder_i_grid *l, size_t j, size_t *first, size_t *end)
{
    const size_t border = SUNDER_I_GRID_BORDER, row = j * l->columns;
    const bool any = j >= border && j + border < l->rows && l->columns > 2 * border;
    *first = any ? row + border : row + l->columns;
    *end = any ? row + l->columns - border : *first;
}

/* Sets the prices outside the inner nodes to 0. Smoothed prices of a coarser grid may be positive there. Steps that are
 * shortened would remove them only in part, and with each finer grid they would come nearer to the border. */
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

/* Sets step[k] to the change that brings the price of node k to `to`, and adds the change of value that the gradient
 * predicts for it to *gain. */
static inline void propose_node(const place *at, size_t k, double to, float *step, double *gain)
{
    step[k] = (float)to - at->price[k];
    *gain += (double)step[k] * (double)at->slope[k];
}

/* Computes the step from `at` along the gradient with step length `length`, cut off where a price would become
 * negative. *gain is the increase of the value that the gradient predicts. */
static void propose_step(const sunder_i_grid *l, const place *at, double length, float *step, double *gain)
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

/* Returns the length of the next step, by the formula of Barzilai and Borwein from the last two points. If the gradient
 * did not turn against the step, the length is STEP_BLIND. */
static double next_length(const sunder_i_grid *l, const place *from, const place *to)
{
    double squared_steps = 0, turned_steps = 0;
    for (size_t k = 0; k < sunder_i_grid_nodes(l); k++) {
        const double way = (double)to->price[k] - (double)from->price[k];
        squared_steps += way * way;
        turned_steps += way * ((double)from->slope[k] - (double)to->slope[k]);
    }
    return turned_steps > 0 ? sunder_i_min(sunder_i_max(squared_steps / turned_steps, STEP_LEAST), STEP_MOST)
                            : STEP_BLIND;
}

/* Sets `other` to the prices after the step, or after a share of it. At most SHORTENED shares are tried, from 1 on,
 * each shorter than the one before by the factor SHORTER, until the value is at least `least` plus the share ENOUGH of
 * the increase that the gradient predicts for that share (`gain` is the one for the whole step); the last one is taken
 * in any case. Returns false if memory is out. */
static bool take_step(ascent *a, const place *at, place *other, const float *step, double gain, double least)
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

static bool climb_prices(ascent *a, place *at, place *other, float *step, unsigned rounds)
{
    double length = FIRST_STEP, gain, last[REMEMBERED];
    if (!ask_all(a, at->price, at->slope, &at->value)) return false;
    for (int k = 0; k < REMEMBERED; k++) last[k] = at->value;
    for (unsigned round = 0; round < rounds; round++) {
        propose_step(a->grid, at, length, step, &gain);
        double least = at->value;
        for (int k = 0; k < REMEMBERED; k++) least = sunder_i_min(least, last[k]);
        if (!take_step(a, at, other, step, gain, least)) return false;
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
        ok = climb_prices(&a, &at, &other, work + 4 * nodes, rounds);
        if (ok) memcpy(price, at.price, nodes * sizeof *price);
        if (ok) blur_field(&a, price);
    }
    end_answers(&a);
    sunder_i_free(work);
    return ok;
}

/* Sets move[] to the mean of the moves in the answer, weighted by their shares. */
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
