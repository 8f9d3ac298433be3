/* rectilinear_sum.c: both operands are divided into rectangles, the sum of one of each is a rectangle, and these are
 * united. As with all convex pieces, the sum is the closure of the union of the open ones [AFH00]. */
#include "rectilinear/rectilinear_sum.h"

#include "base/watch.h"
#include "convex/needed_subsums.h"
#include "rectilinear/rectangles.h"
#include "rectilinear/rectilinear_union.h"

#define MOST_RECTANGLES ((size_t)1 << 24) /* with more the general method may need fewer pieces */
#define RECTANGLE_WORTH                                                                                                \
    0 /* tests on credit take longer than uniting (covers sorted by fatness: 1.4
                                           * times in total) */
#define FEW_RECTANGLES                                                                                                 \
    512 /* if there are fewer, all sums are computed: selecting them would take
                                           * longer */

static const sunder_i_point axis_direction[2] = {{1, 0}, {0, 1}};

/* Converts the rectangles to convex pieces, each beginning with the side of direction (1, 0). Returns false if out of
 * memory. */
static bool to_pieces(const sunder_i_rectangle_list *list, sunder_i_lattice *lattice, sunder_i_convex_pieces *out)
{
    if (!sunder_i_convex_pieces_init(out, list->n, 4 * list->n)) return false;
    for (size_t i = 0; i < list->n; i++) {
        const sunder_i_rectangle *r = &list->item[i];
        const sunder_i_point corner[4] = {
            {r->low[0], r->low[1]}, {r->high[0], r->low[1]}, {r->high[0], r->high[1]}, {r->low[0], r->high[1]}};
        for (uint32_t k = 0; k < 4; k++) {
            out->rank[out->corners] = k;
            sunder_i_convex_pieces_add_corner(out, corner[k], true);
        }
        out->end[out->n++] = out->corners;
    }
    out->lattice = lattice;
    out->classes = 2;
    out->direction = axis_direction;
    return true;
}

/* *out becomes the list of the needed sums: all, unless there are many. Returns false if out of memory. */
static bool list_needed(const sunder_i_rectangle_list *a, const sunder_i_rectangle_list *b, sunder_i_lattice *lattice,
                        sunder_i_subsum_list *out)
{
    sunder_i_convex_pieces p = {0}, q = {0};
    memset(out, 0, sizeof *out);
    out->all = a->n * b->n < FEW_RECTANGLES;
    if (out->all) return true;
    const bool ok =
        to_pieces(a, lattice, &p) && to_pieces(b, lattice, &q) && sunder_i_needed_subsums(&p, &q, RECTANGLE_WORTH, out);
    sunder_i_convex_pieces_free(&p);
    sunder_i_convex_pieces_free(&q);
    return ok;
}

static void add_sum(const sunder_i_rectangle *a, const sunder_i_rectangle *b, sunder_i_rectangle_list *out)
{
    sunder_i_rectangle *r = &out->item[out->n++];
    for (int axis = 0; axis < 2; axis++) {
        r->low[axis] = a->low[axis] + b->low[axis];
        r->high[axis] = a->high[axis] + b->high[axis];
    }
}

/* *out becomes the list of the needed sums; an empty list if there are too many. Returns false if out of memory. */
static bool make_sums(const sunder_i_rectangle_list *a, const sunder_i_rectangle_list *b, sunder_i_lattice *lattice,
                      sunder_i_rectangle_list *out)
{
    sunder_i_subsum_list needed;
    memset(out, 0, sizeof *out);
    if (!list_needed(a, b, lattice, &needed)) return false;
    const size_t n = needed.all ? a->n * b->n : needed.n;
    bool ok = true;
    if (n <= MOST_RECTANGLES) {
        ok = sunder_i_reserve(&out->item, &out->capacity, n, sizeof *out->item);
        for (size_t i = 0; ok && needed.all && i < a->n; i++) {
            for (size_t k = 0; k < b->n; k++) add_sum(&a->item[i], &b->item[k], out);
            ok = sunder_i_steps(b->n / 16 + 1);
        }
        for (size_t i = 0; ok && !needed.all && i < n; i++)
            add_sum(&a->item[needed.pair[i] >> 32], &b->item[(uint32_t)needed.pair[i]], out);
    }
    sunder_i_subsum_list_free(&needed);
    return ok;
}

static sunder_status unite_rectangles(sunder_sum *sum, const sunder_i_rectangle_list *rectangles, bool *done,
                                      sunder_error *err)
{
    sunder_i_ranked_rectangles ranked;
    if (rectangles->n == 0) return SUNDER_OK;
    if (!sunder_i_rectangles_rank(rectangles, &ranked)) return sunder_i_failure_cause(err);
    sum->lattice.counts.comparisons += ranked.comparisons;
    const sunder_status status = sunder_i_rectangles_unite(&ranked, sum, err);
    sunder_i_ranked_rectangles_free(&ranked);
    *done = status == SUNDER_OK;
    return status;
}

sunder_status sunder_i_rectilinear_sum(sunder_sum *sum, const sunder_shape *p, const sunder_i_point *at_p,
                                       const sunder_shape *q, const sunder_i_point *at_q, bool *done, sunder_error *err)
{
    sunder_i_rectangle_list a = {0}, b = {0}, sums = {0};
    *done = false;
    if (!sum->lattice.narrow || p->flat || q->flat || !sunder_i_is_rectilinear(p, at_p) ||
        !sunder_i_is_rectilinear(q, at_q))
        return SUNDER_OK;
    const bool ok = sunder_i_rectangles_cut(p, at_p, &a) && sunder_i_rectangles_cut(q, at_q, &b) &&
                    make_sums(&a, &b, &sum->lattice, &sums);
    sunder_i_free_all(a.item, b.item);
    const sunder_status status = ok ? unite_rectangles(sum, &sums, done, err) : sunder_i_failure_cause(err);
    sunder_i_free(sums.item);
    return status;
}
