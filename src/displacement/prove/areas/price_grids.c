/* Prepares the payers and the sequence of grids. On a coarse grid prices spread over long distances in few rounds;
 * finer grids then represent them more precisely. */
#include "displacement/prove/areas/price_grids.h"
#include "displacement/prove/areas/tuning.h"

#include "spatial/box.h"

#include "base/extremes.h"

#include <math.h>

static bool has_area(const sunder_i_outline *outline) { return outline->rings && outline->area > 0; }

/* Builds the outlines of the bodies and l->box, which contains all of them at their original and at their present
 * position and is enlarged by `about` times the size of a body. Sets l->size to the side of a square of mean area, or
 * to 0 if fewer than FEWEST bodies have an area. */
static sunder_status find_outlines(sunder_i_price_grids *l, double about, sunder_error *err)
{
    double area = 0;
    size_t n = 0;
    sunder_i_box_clear(l->box);
    for (size_t k = 0; k < l->n; k++) {
        sunder_i_outline *o = &l->outline[k];
        const sunder_status status = sunder_i_outline_make(l->model, l->body[k], o, err);
        if (status) return status;
        if (!has_area(o)) continue;
        const double *t = l->model->move + 2 * (size_t)l->body[k];
        for (int c = 0; c < 2; c++) {
            l->box[c] = sunder_i_min(l->box[c], o->box[c] + sunder_i_min(t[c], 0));
            l->box[2 + c] = sunder_i_max(l->box[2 + c], o->box[2 + c] + sunder_i_max(t[c], 0));
        }
        area += o->area;
        n++;
    }
    l->size = n >= FEWEST ? sqrt(area / (double)n) : 0;
    if (l->size > 0) sunder_i_box_grow(l->box, about * l->size, l->box);
    return SUNDER_OK;
}

/* Sets *out to a grid of squares of side `side` that covers l->box and a border around it. Its first node and its
 * numbers of squares are multiples of `coarse`, so that the nodes of a grid with squares `coarse` times as large are
 * among its nodes. Returns false if it would have more than MOST_NODES nodes or too large indices. */
static bool lay_grid(const sunder_i_price_grids *l, double side, unsigned coarse, sunder_i_grid *out)
{
    const double step = side * coarse, border = SUNDER_I_GRID_BORDER;
    const double x = floor(l->box[0] / step) - border, y = floor(l->box[1] / step) - border;
    const double columns = ceil(l->box[2] / step) + border - x, rows = ceil(l->box[3] / step) + border - y;
    if (!((columns * coarse + 1) * (rows * coarse + 1) <= MOST_NODES && fabs(x) + fabs(y) < 0x1p40)) return false;
    *out = (sunder_i_grid){.side = side,
                           .x = (int64_t)x * coarse,
                           .y = (int64_t)y * coarse,
                           .columns = (size_t)columns * coarse + 1,
                           .rows = (size_t)rows * coarse + 1};
    return true;
}

/* Chooses the side of the finest grid and the number of coarser grids, each with squares of twice the side. There are
 * LEVELS coarser grids, or fewer if the finest grid would have too many nodes and is therefore replaced by a coarser
 * one; if none would be left, l->left becomes 0 and no grid is used. */
static void choose_sides(sunder_i_price_grids *l)
{
    sunder_i_grid fine;
    int exponent;
    frexp(l->size / SQUARES_ACROSS, &exponent);
    double finest = ldexp(1, exponent);
    unsigned coarser = LEVELS;
    while (coarser > 0 && !(finest > 0x1p-300 && lay_grid(l, finest, 1u << coarser, &fine))) {
        finest *= 2;
        coarser--;
    }
    l->coarser = coarser;
    l->left = coarser > 0 ? coarser + 1 : 0;
    l->side = finest * (1u << coarser);
}

static void free_masses(sunder_i_price_grids *l)
{
    for (size_t k = 0; k < l->payers; k++) sunder_i_masses_free(&l->payer[k].masses);
    l->payers = 0;
}

sunder_status sunder_i_price_grids_init(sunder_i_price_grids *grids, const sunder_i_model *model, const uint32_t *body,
                                        size_t n, double about, sunder_error *err)
{
    *grids = (sunder_i_price_grids){.model = model, .body = body, .n = n};
    grids->outline = sunder_i_calloc(n, sizeof *grids->outline);
    grids->payer = sunder_i_calloc(n, sizeof *grids->payer);
    sunder_status status = grids->outline && grids->payer ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status) status = find_outlines(grids, about, err);
    if (!status && grids->size > 0) choose_sides(grids);
    return status;
}

void sunder_i_price_grids_free(sunder_i_price_grids *grids)
{
    for (size_t k = 0; k < grids->n && grids->outline; k++) sunder_i_outline_free(&grids->outline[k]);
    free_masses(grids);
    sunder_i_free_all(grids->outline, grids->payer, grids->price);
}

static bool spans_too_much(const sunder_i_outline *o, double side)
{
    return !(o->box[2] - o->box[0] < (MOST_SPAN - 2) * side && o->box[3] - o->box[1] < (MOST_SPAN - 2) * side);
}

/* Makes the payers for `grid`: the bodies that have an area and do not span too many squares. Returns false if memory
 * is out. */
static bool make_payers(sunder_i_price_grids *l, const sunder_i_grid *grid)
{
    free_masses(l);
    for (size_t k = 0; k < l->n; k++) {
        if (!has_area(&l->outline[k]) || spans_too_much(&l->outline[k], grid->side)) continue;
        const sunder_i_body *body = &l->model->body[l->body[k]];
        sunder_i_payer *payer = &l->payer[l->payers++];
        payer->weight = sunder_i_weight_below(l->model, body);
        payer->limit = sunder_i_limit_of(body);
        if (!sunder_i_masses_make(&l->outline[k], grid, &payer->masses)) return false;
    }
    return true;
}

/* Returns the price at the node with global indices (x, y) of the coarse grid, or 0 if the grid has no such node. */
static float price_at(const sunder_i_grid *grid, const float *price, int64_t x, int64_t y)
{
    const int64_t i = x - grid->x, j = y - grid->y;
    const bool inside = i >= 0 && j >= 0 && i < (int64_t)grid->columns && j < (int64_t)grid->rows;
    return inside ? price[(size_t)j * grid->columns + (size_t)i] : 0;
}

/* Returns the prices of the previous grid on a grid of half the side, interpolated bilinearly, or prices of 0 if there
 * is no previous grid. The caller owns the array. Returns NULL if memory is out. */
static float *refine_prices(const sunder_i_price_grids *l, const sunder_i_grid *fine)
{
    float *out = sunder_i_calloc(sunder_i_grid_nodes(fine), sizeof *out);
    if (!out || !l->price) return out;
    for (size_t j = 0; j < fine->rows; j++)
        for (size_t i = 0; i < fine->columns; i++) {
            const int64_t x = fine->x + (int64_t)i, y = fine->y + (int64_t)j;
            float sum = 0;
            for (int k = 0; k < 4; k++) sum += price_at(&l->grid, l->price, (x + (k & 1)) >> 1, (y + (k >> 1)) >> 1);
            out[j * fine->columns + i] = sum / 4;
        }
    return out;
}

bool sunder_i_price_grids_refine(sunder_i_price_grids *grids)
{
    static const unsigned rounds[LEVELS + 1] = ROUNDS;
    sunder_i_grid grid;
    grids->left--;
    if (!lay_grid(grids, grids->side, 1u << grids->left, &grid) || !make_payers(grids, &grid)) return false;
    float *price = refine_prices(grids, &grid);
    sunder_i_free(grids->price);
    grids->price = price;
    grids->grid = grid;
    const double across = grids->size / grids->side;
    grids->patience = PATIENCE * across * across;
    grids->side /= 2;
    return price && sunder_i_prices_ascend(&grid, grids->payer, grids->payers, grids->patience,
                                           rounds[LEVELS - grids->left], grids->model->rules.threads, price);
}
