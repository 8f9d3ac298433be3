/* From bodies to a bound: what they occupy, a grid that tells them well enough, prices from a coarse grid to a
 * finer one, and what these prove. */
#include "displacement/areas/areas.h"
#include "displacement/areas/tuning.h"
#include "displacement/optimum/optimum.h"

#include "spatial/box.h"

#include <math.h>
#include <string.h>

typedef struct work {
    const sunder_i_model *model;
    const uint32_t *body;
    size_t n;
    sunder_i_outline *outline; /* [n] */
    sunder_i_payer *payer;     /* [n] */
    double box[4];             /* all places that may have a price */
    double size;               /* of a body of mean area */

} work;

static bool has_area(const sunder_i_outline *outline) { return outline->rings && outline->area > 0; }

/* Outlines, and how far away there may be a price: where somebody stands. */
static sunder_status find_outlines(work *w, sunder_error *err)
{
    double area = 0;
    size_t n = 0;
    sunder_i_box_clear(w->box);
    for (size_t k = 0; k < w->n; k++) {
        sunder_i_outline *o = &w->outline[k];
        sunder_status status = sunder_i_outline_make(w->model, w->body[k], o, err);
        if (status) return status;
        if (!has_area(o)) continue;
        const double *t = w->model->move + 2 * (size_t)w->body[k];
        for (int e = 0; e < 4; e++) w->box[e] = (e < 2 ? fmin : fmax)(w->box[e], o->box[e] + fmin(t[e & 1], 0));
        for (int e = 0; e < 4; e++) w->box[e] = (e < 2 ? fmin : fmax)(w->box[e], o->box[e] + fmax(t[e & 1], 0));
        area += o->area;
        n++;
    }
    w->size = n >= FEWEST ? sqrt(area / (double)n) : 0;
    return SUNDER_OK;
}

/* Nodes at multiples of `coarse` squares, so that coarser lattices are among them; two more all about. False: there
 * would be too many. */
static bool lay_grid(const work *w, double side, unsigned coarse, sunder_i_grid *out)
{
    const double step = side * coarse;
    const double x = floor(w->box[0] / step) - SUNDER_I_GRID_BORDER, y = floor(w->box[1] / step) - SUNDER_I_GRID_BORDER;
    const double columns = ceil(w->box[2] / step) + SUNDER_I_GRID_BORDER - x,
                 rows = ceil(w->box[3] / step) + SUNDER_I_GRID_BORDER - y;
    if (!((columns * coarse + 1) * (rows * coarse + 1) <= MOST_NODES && fabs(x) + fabs(y) < 0x1p40)) return false;
    *out = (sunder_i_grid){.side = side,
                           .x = (int64_t)x * coarse,
                           .y = (int64_t)y * coarse,
                           .columns = (size_t)columns * coarse + 1,
                           .rows = (size_t)rows * coarse + 1};
    return true;
}

/* The coarsest, of which the finest is one in 2^LEVELS or less. */
static bool choose_side(const work *w, double *side, unsigned *levels)
{
    sunder_i_grid fine;
    int exponent;
    frexp(w->size / SQUARES_ACROSS, &exponent);
    *levels = LEVELS;
    for (double finest = ldexp(1, exponent); *levels > 0; finest *= 2, (*levels)--)
        if (finest > 0x1p-300 && lay_grid(w, finest, 1u << *levels, &fine)) {
            *side = finest * (1u << *levels);
            return true;
        }
    return false;
}

static bool spans_too_much(const sunder_i_outline *o, double side)
{
    return !(o->box[2] - o->box[0] < (MOST_SPAN - 2) * side && o->box[3] - o->box[1] < (MOST_SPAN - 2) * side);
}

static void free_masses(work *w)
{
    for (size_t k = 0; k < w->n; k++) sunder_i_masses_free(&w->payer[k].masses);
}

/* Payers of this grid; *n: those that have any area. False if memory is out. */
static bool make_payers(work *w, const sunder_i_grid *grid, size_t *n)
{
    free_masses(w);
    *n = 0;
    for (size_t k = 0; k < w->n; k++) {
        if (!has_area(&w->outline[k]) || spans_too_much(&w->outline[k], grid->side)) continue;
        const sunder_i_body *body = &w->model->body[w->body[k]];
        sunder_i_payer *payer = &w->payer[*n];
        payer->weight = sunder_i_weight_below(w->model, body);
        payer->limit = sunder_i_limit_of(body);
        if (!sunder_i_masses_make(&w->outline[k], grid, &payer->masses)) return false;
        ++*n;
    }
    return true;
}

/* The same prices on a grid of half the side. */
static float *refine(const sunder_i_grid *coarse, const float *price, const sunder_i_grid *fine)
{
    float *out = sunder_i_alloc(sunder_i_grid_nodes(fine), sizeof *out);
    if (!out) return NULL;
    for (size_t j = 0; j < fine->rows; j++)
        for (size_t i = 0; i < fine->columns; i++) {
            /* Of places beyond the border of the coarse one all are 0. */
            const int64_t x = fine->x + (int64_t)i, y = fine->y + (int64_t)j;
            float sum = 0;
            for (int k = 0; k < 4; k++) {
                const int64_t u = ((x + (k & 1)) >> 1) - coarse->x, v = ((y + (k >> 1)) >> 1) - coarse->y;
                if (u >= 0 && v >= 0 && u < (int64_t)coarse->columns && v < (int64_t)coarse->rows)
                    sum += price[(size_t)v * coarse->columns + (size_t)u] / 4;
            }
            out[j * fine->columns + i] = sum;
        }
    return out;
}

/* As whole numbers. False if memory is out. */
static bool round_prices(const float *price, sunder_i_prices *out)
{
    const size_t nodes = sunder_i_grid_nodes(&out->grid);
    double most = 0;
    for (size_t k = 0; k < nodes; k++) most = fmax(most, price[k]);
    int exponent;
    frexp(most / (double)SUNDER_I_MOST_PRICE, &exponent);
    out->unit = ldexp(1, exponent);
    out->price = sunder_i_alloc(nodes, sizeof *out->price);
    for (size_t k = 0; out->price && k < nodes; k++) out->price[k] = (uint32_t)(price[k] / out->unit + 0.5);
    return out->price;
}

/* What the prices of one grid prove; they are kept if it is more. False if memory is out. */
static bool prove(const work *w, size_t payers, const sunder_i_grid *grid, const float *price, sunder_i_prices *best,
                  double *bound)
{
    sunder_i_prices own = {.grid = *grid};
    double proved = 0;
    const bool ok = round_prices(price, &own) && sunder_i_prices_prove(&own, w->payer, payers, &proved);
    if (ok && proved > *bound) {
        sunder_i_free(best->price);
        *best = own;
        *bound = proved;
    } else {
        sunder_i_free(own.price);
    }
    return ok;
}

static bool ask_levels(work *w, sunder_i_prices *best, double *bound)
{
    static const unsigned rounds[LEVELS + 1] = ROUNDS;
    double side;
    float *price = NULL;
    unsigned levels;
    sunder_i_grid before = {0}, grid;
    if (!choose_side(w, &side, &levels)) return true;
    bool ok = true;
    for (unsigned level = 0; ok && level <= levels; level++, side /= 2) {
        size_t payers;
        if (!lay_grid(w, side, 1u << (levels - level), &grid)) break;
        ok = make_payers(w, &grid, &payers);
        float *own = !ok          ? NULL
                     : level == 0 ? sunder_i_calloc(sunder_i_grid_nodes(&grid), sizeof *own)
                                  : refine(&before, price, &grid);
        sunder_i_free(price);
        price = own;
        ok = price && sunder_i_prices_ascend(&grid, w->payer, payers, PATIENCE * pow(w->size / side, 2),
                                             rounds[LEVELS - levels + level], price);
        ok = ok && prove(w, payers, &grid, price, best, bound);
        before = grid;
    }
    sunder_i_free(price);
    return ok;
}

sunder_status sunder_i_areas_bound(const sunder_i_model *model, const uint32_t *body, size_t n, sunder_i_prices *prices,
                                   double *bound, sunder_error *err)
{
    work w = {.model = model, .body = body, .n = n};
    *prices = (sunder_i_prices){0};
    *bound = 0;
    w.outline = sunder_i_calloc(n, sizeof *w.outline);
    w.payer = sunder_i_calloc(n, sizeof *w.payer);
    sunder_status status = w.outline && w.payer ? SUNDER_OK : sunder_i_no_memory(err);
    if (!status) status = find_outlines(&w, err);
    if (!status && w.size > 0 && !ask_levels(&w, prices, bound)) status = sunder_i_no_memory(err);
    for (size_t k = 0; k < n && w.outline; k++) sunder_i_outline_free(&w.outline[k]);
    if (w.payer) free_masses(&w);
    sunder_i_free(w.outline);
    sunder_i_free(w.payer);
    if (status) {
        sunder_i_free(prices->price);
        *prices = (sunder_i_prices){0};
    }
    return status;
}
