/* Computes the bound that prices prove, in integers.
 *
 * Let g(t) be the price of the area that the payer occupies after the move t, in squares, and k a move by whole
 * squares. For k <= t <= k + 1 (in both coordinates) g is determined by its values at the four corners up to the kinks
 * of the prices. Along one axis the price at a point of the body is linear in t except for one kink, at a node. If the
 * kink is convex and the slope changes by d, the chord lies above the function by at most d / 4. So g(t) is at least
 * the bilinear interpolation of the corners minus E / 4, where E is the sum over the body's squares of their mass times
 * the greatest such d that the square may meet, for x plus the same for y. Also, |t|^2 is less than its own bilinear
 * interpolation over a square of side s by at most s^2 / 2; to keep that small, squares are subdivided, which needs
 * only the interpolation. */
#include "displacement/prove/areas/areas.h"
#include "displacement/prove/areas/window.h"

#include "base/extremes.h"
#include "base/parallel.h"
#include "base/watch.h"
#include "sunder_parts.h"

#include <math.h>

/* Each square is divided into PARTS parts along either axis. Totals are counted in units of 1 / PARTS_SQUARE of the
 * unit of masses times prices. */
#define PARTS 8
#define PARTS_SQUARE (PARTS * PARTS)

typedef struct field {
    const sunder_i_prices *prices;
    uint32_t *kink;   /* [nodes] four times the amount by which prices may be below their interpolation in the squares
                       * around the node, for one unit of mass */
    int64_t sharpest; /* the largest entry of kink[] */
} field;

/* The evaluation of one payer. */
typedef struct asking {
    const field *field;
    const sunder_i_payer *payer;
    int64_t weight; /* the cost of a move by one square */
    int64_t reach;  /* the largest move along either axis for which `price` has room, in squares */
    int64_t *price; /* [(2 * reach + 1)^2] the prices of the payer's area after each move by whole squares */
    int64_t least;  /* the least total found so far, in units of 1 / PARTS_SQUARE */
    int64_t doubt;  /* the largest amount by which kinks may lower the total in any square, in units of 1 /
                     * PARTS_SQUARE */
} asking;

static int64_t price_at(const sunder_i_prices *p, int64_t i, int64_t j)
{
    const sunder_i_grid *l = &p->grid;
    return i < 0 || j < 0 || i >= (int64_t)l->columns || j >= (int64_t)l->rows
               ? 0
               : p->price[(size_t)j * l->columns + (size_t)i];
}

/* Returns the largest second difference of the prices in direction (di, dj), or 0 if none is positive. It is taken over
 * three neighbouring lines of three nodes each, of which (i, j) is the first node of the first. */
static int64_t turn_of(const sunder_i_prices *p, int64_t i, int64_t j, int64_t di, int64_t dj)
{
    int64_t most = 0;
    for (int64_t k = 0; k < 3; k++) {
        const int64_t x = i + k * dj, y = j + k * di;
        const int64_t turn = price_at(p, x, y) - 2 * price_at(p, x + di, y + dj) + price_at(p, x + 2 * di, y + 2 * dj);
        if (turn > most) most = turn;
    }
    return most;
}

/* Returns a bound on the kinks, in x plus in y, that a mass in square (i, j) may meet when it moves by less than a
 * square: it meets prices from the nodes of its own square to those of the next square but one. */
static int64_t kink_of_square(const sunder_i_prices *p, int64_t i, int64_t j)
{
    return turn_of(p, i, j, 1, 0) + turn_of(p, i, j, 0, 1);
}

static void find_kinks(field *f)
{
    const sunder_i_grid *l = &f->prices->grid;
    f->sharpest = 0;
    for (size_t j = 0; j < l->rows; j++)
        for (size_t i = 0; i < l->columns; i++) {
            int64_t most = 0;
            for (int64_t k = 0; k < 4; k++) {
                const int64_t own = kink_of_square(f->prices, (int64_t)i - (k & 1), (int64_t)j - (k >> 1));
                if (own > most) most = own;
            }
            f->kink[j * l->columns + i] = (uint32_t)most;
            if (most > f->sharpest) f->sharpest = most;
        }
}

/* Returns the sum over the payer's nodes, after a move by (dx, dy) squares, of (the mass of the node + more) *
 * what[node of the grid at that place]. Both factors are below 2^32, which are_small() ensures. */
static int64_t sum_at(const asking *a, const uint32_t *what, int64_t more, int64_t dx, int64_t dy)
{
    const sunder_i_masses *m = &a->payer->masses;
    const sunder_i_grid *grid = &a->field->prices->grid;
    const sunder_i_grid_window w = sunder_i_grid_window_of(grid, m, dx, dy);
    const uint32_t each = (uint32_t)more;
    uint64_t sum = 0;
    for (size_t j = w.row; j < w.rows; j++) {
        const uint32_t *row = what + sunder_i_grid_window_node(grid, &w, j);
        const int32_t *mass = m->at + j * m->columns + w.column;
        for (size_t i = 0; i < w.columns - w.column; i++) sum += (uint64_t)((uint32_t)mass[i] + each) * row[i];
    }
    return (int64_t)sum;
}

static int64_t *price_slot(const asking *a, int64_t dx, int64_t dy)
{
    return &a->price[(dy + a->reach) * (2 * a->reach + 1) + dx + a->reach];
}

/* Computes the prices of all moves for which the larger of |dx| and |dy| is exactly r. */
static void price_ring(const asking *a, int64_t r)
{
    for (int64_t dy = -r; dy <= r; dy++) {
        const int64_t stride = dy == -r || dy == r || r == 0 ? 1 : 2 * r;
        for (int64_t dx = -r; dx <= r; dx += stride)
            *price_slot(a, dx, dy) = sum_at(a, a->field->prices->price, 0, dx, dy);
    }
}

/* Returns the least total over the corners of the parts of square (x, y), in units of 1 / PARTS_SQUARE. */
static int64_t least_corner(const asking *a, int64_t x, int64_t y)
{
    const int64_t p00 = *price_slot(a, x, y), p10 = *price_slot(a, x + 1, y), p01 = *price_slot(a, x, y + 1),
                  p11 = *price_slot(a, x + 1, y + 1);
    int64_t least = INT64_MAX;
    for (int64_t v = 0; v <= PARTS; v++)
        for (int64_t u = 0; u <= PARTS; u++) {
            const int64_t across = PARTS * x + u, up = PARTS * y + v;
            const int64_t paid = (PARTS - v) * ((PARTS - u) * p00 + u * p10) + v * ((PARTS - u) * p01 + u * p11) +
                                 a->weight * (across * across + up * up);
            if (paid < least) least = paid;
        }
    return least;
}

static int64_t least4(int64_t a, int64_t b, int64_t c, int64_t d)
{
    const int64_t p = a < b ? a : b, q = c < d ? c : d;
    return p < q ? p : q;
}

/* Lowers a->least to a lower bound on what the payer pays for any move in the square from (x, y) to (x + 1, y + 1), if
 * that is less. */
static void ask_square(asking *a, int64_t x, int64_t y)
{
    const int64_t dx = x < 0 ? -x - 1 : x, dy = y < 0 ? -y - 1 : y, square = dx * dx + dy * dy;
    const double side = a->field->prices->grid.side, limit = a->payer->limit;
    if ((double)square * (side * side) > limit * limit * (1 + 0x1p-48)) return;
    int64_t low = PARTS_SQUARE * a->weight * square; /* the cost of the move alone */
    if (low >= a->least) return;
    const int64_t corner =
        least4(*price_slot(a, x, y), *price_slot(a, x + 1, y), *price_slot(a, x, y + 1), *price_slot(a, x + 1, y + 1));
    /* true of most squares, for which the sum over the kinks is not needed */
    if (low + PARTS_SQUARE * corner - a->doubt >= a->least) return;
    const int64_t less = PARTS_SQUARE / 4 * sum_at(a, a->field->kink, a->payer->masses.slack, x, y);
    const int64_t roughly = low + PARTS_SQUARE * corner - less;
    if (roughly >= a->least) return;
    const int64_t paid = least_corner(a, x, y) - (a->weight + 1) / 2 - less;
    if (roughly > low) low = roughly;
    if (paid > low) low = paid;
    if (low < a->least) a->least = low;
}

/* Examines all squares in rings from the middle outwards, until the cost of the move alone is at least a->least. */
static void ask_rings(asking *a)
{
    price_ring(a, 0);
    for (int64_t r = 0; r < a->reach && PARTS_SQUARE * a->weight * r * r < a->least; r++) {
        price_ring(a, r + 1);
        for (int64_t y = -r - 1; y <= r; y++) {
            const int64_t stride = y == -r - 1 || y == r ? 1 : 2 * r + 1;
            for (int64_t x = -r - 1; x <= r; x += stride) ask_square(a, x, y);
        }
    }
}

/* Returns how far the payer has to be examined, in squares: up to where the move alone costs as much as the price of
 * staying, `stays`, or to the payer's limit, or to `beyond`, from where on the payer lies outside the grid; whichever
 * is nearest. Two squares are added. */
static int64_t reach_of(const asking *a, int64_t stays, int64_t beyond)
{
    const double reach = sunder_i_min(sqrt((double)stays / (double)a->weight), (double)beyond);
    return (int64_t)sunder_i_min(reach, a->payer->limit / a->field->prices->grid.side) + 2;
}

/* Sets *paid to a lower bound on what the payer pays for any move, in units of 1 / PARTS_SQUARE. Returns false if
 * memory is out. */
static bool ask_payer(const field *f, const sunder_i_payer *payer, int64_t *paid)
{
    asking a = {.field = f,
                .payer = payer,
                .weight = (int64_t)(payer->weight * (double)SUNDER_I_MASS_OF_SQUARE / f->prices->unit)};
    /* Staying is one of the payer's moves. */
    const int64_t stays = sum_at(&a, f->prices->price, 0, 0, 0);
    a.least = *paid = PARTS_SQUARE * stays;
    if (stays == 0) return true;
    const sunder_i_masses *m = &payer->masses;
    a.doubt = PARTS_SQUARE / 4 * f->sharpest * (m->total + m->slack * (int64_t)(m->columns * m->rows));
    const int64_t beyond = sunder_i_beyond_grid(&f->prices->grid, m);
    a.reach = reach_of(&a, stays, beyond);
    const size_t across = (size_t)(2 * a.reach + 1);
    a.price = sunder_i_alloc(across * across, sizeof *a.price);
    if (!a.price) return false;
    ask_rings(&a);
    sunder_i_free(a.price);
    /* Moves beyond the grid were not examined. There the payer pays for its move only, which is at least the move to
     * the border of the grid. */
    if (a.reach > beyond && PARTS_SQUARE * a.weight * beyond * beyond < a.least)
        a.least = PARTS_SQUARE * a.weight * beyond * beyond;
    *paid = a.least;
    return true;
}

/* Returns whether all numbers that can occur stay below 2^61, and masses with their slack below 2^32. Moves that alone
 * cost more than staying need not be considered for this, since they are not examined. */
static bool are_small(const sunder_i_prices *prices, const sunder_i_payer *payer, size_t n)
{
    for (size_t k = 0; k < n; k++) {
        const sunder_i_masses *m = &payer[k].masses;
        const double mass = (double)m->total + (double)m->slack * (double)(m->columns * m->rows);
        const double weight = payer[k].weight * (double)SUNDER_I_MASS_OF_SQUARE / prices->unit;
        if (!(weight >= 1 && weight < 0x1p48 && m->slack < INT64_C(1) << 31)) return false;
        if (!(mass * 8 * (double)SUNDER_I_MOST_PRICE < 0x1p52)) return false;
    }
    return true;
}

/* Returns whether the two outermost rows and columns have no price. Kinks are stored for nodes of the grid only; a
 * price at the border would cause kinks outside, which would be missed. */
static bool is_free_at_border(const sunder_i_prices *p)
{
    const size_t columns = p->grid.columns, rows = p->grid.rows;
    for (size_t k = 0; k < columns * rows; k++) {
        const size_t i = k % columns, j = k / columns;
        if (p->price[k] && (i < 2 || j < 2 || i + 2 >= columns || j + 2 >= rows)) return false;
    }
    return true;
}

/* Adds `value` to the total without rounding, in two halves of 32 bits. */
static void add_exactly(sunder_total *total, int64_t value)
{
    sunder_total_add(total, (double)(value >> 32) * 0x1p32);
    sunder_total_add(total, (double)(value & INT64_C(0xffffffff)));
}

typedef struct questions {
    const field *field;
    const sunder_i_payer *payer;
    int64_t *paid; /* [payers] what each payer pays at least */
} questions;

static sunder_status ask_some(void *context, size_t begin, size_t end, sunder_error *err)
{
    const questions *q = context;
    for (size_t k = begin; k < end; k++)
        if (!sunder_i_step() || !ask_payer(q->field, &q->payer[k], &q->paid[k])) return sunder_i_failure_cause(err);
    return SUNDER_OK;
}

/* Adds to *total, for each of the n payers, the lower bound on what it pays for a move and for the area that it then
 * occupies. Returns false if memory is out. */
static bool ask_all(const field *f, const sunder_i_payer *payer, size_t n, unsigned threads, sunder_total *total)
{
    questions q = {f, payer, sunder_i_alloc(n, sizeof *q.paid)};
    const bool ok = q.paid && !sunder_i_parallel(threads, n, SUNDER_I_GRAIN_PAIRS, ask_some, &q, NULL);
    for (size_t k = 0; k < n && ok; k++) add_exactly(total, q.paid[k]);
    sunder_i_free(q.paid);
    return ok;
}

bool sunder_i_prices_prove(const sunder_i_prices *prices, const sunder_i_payer *payer, size_t n, unsigned threads,
                           double *bound)
{
    const size_t nodes = sunder_i_grid_nodes(&prices->grid);
    *bound = 0;
    if (!is_free_at_border(prices) || !are_small(prices, payer, n)) return true;
    field f = {.prices = prices, .kink = sunder_i_alloc(nodes, sizeof *f.kink)};
    sunder_total total = {0};
    bool ok = f.kink;
    if (ok) find_kinks(&f);
    for (size_t k = 0; k < nodes; k++)
        sunder_total_add(&total, -(double)prices->price[k] * (double)SUNDER_I_MASS_OF_SQUARE * PARTS_SQUARE);
    ok = ok && ask_all(&f, payer, n, threads, &total);
    sunder_i_free(f.kink);
    if (!ok) return false;
    const double part = prices->grid.side * prices->grid.side * prices->unit / (double)SUNDER_I_MASS_OF_SQUARE;
    const double value = sunder_total_below(&total) * part / PARTS_SQUARE;
    if (value > 0 && isfinite(value) && value > 0x1p-900) *bound = value;
    return true;
}
