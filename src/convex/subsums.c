/* subsums.c: computes the subsums: the operands' pieces are made and ranked, the needed pairs are merged, and each side
 * is tested whether it can contain boundary. */
#include "convex/subsums.h"

#include "base/watch.h"
#include "convex/hertel_mehlhorn.h"
#include "convex/merge.h"
#include "convex/needed_subsums.h"
#include "predicate/predicate.h"

#include <string.h>

typedef struct operand {
    const sunder_shape *shape;
    sunder_i_convex_pieces pieces;
    uint32_t *edge_rank; /* [vertices] the rank of the boundary edge (v, next[v]) */
} operand;

static void operand_free(operand *o)
{
    sunder_i_convex_pieces_free(&o->pieces);
    sunder_i_free(o->edge_rank);
}

static bool operand_init(operand *o, sunder_i_lattice *l, const sunder_shape *shape, const sunder_i_point *vertex)
{
    o->shape = shape;
    o->edge_rank = sunder_i_alloc(shape->vertices, sizeof *o->edge_rank);
    return o->edge_rank && sunder_i_hertel_mehlhorn(l, shape, vertex, &o->pieces);
}

static void take_edge_ranks(operand *o)
{
    for (uint32_t k = 0; k < o->pieces.corners; k++)
        if (o->pieces.candidate[k]) o->edge_rank[o->pieces.vertex[k]] = o->pieces.rank[k];
}

/* Returns true if the exterior angle at vertex v contains rank r. Then the vertex is convex, a left turn. If several
 * vertices have one position, each has a sector of its own (shape.h), and the union of their results is correct. */
static bool angle_holds(const operand *o, uint32_t v, uint32_t r, uint32_t classes)
{
    const sunder_shape *s = o->shape;
    const uint32_t full = 2 * classes, in = o->edge_rank[s->form->cleaned.prev[v]], out = o->edge_rank[v];
    const uint32_t turn = out >= in ? out - in : out + full - in;
    const uint32_t step = r >= in ? r - in : r + full - in;
    return turn < classes && step <= turn;
}

/* Returns true if side k of a is an edge whose direction is in the exterior angle of the vertex `vertex` of b. */
static bool is_candidate(const operand *a, uint32_t k, const operand *b, uint32_t vertex, uint32_t classes)
{
    return a->pieces.candidate[k] && angle_holds(b, vertex, a->pieces.rank[k], classes);
}

static void add_subsum(const operand *p, uint32_t i, const operand *q, uint32_t j, sunder_i_convex_pieces *out)
{
    const sunder_i_convex_pieces *a = &p->pieces, *b = &q->pieces;
    const uint32_t af = sunder_i_convex_pieces_first(a, i), bf = sunder_i_convex_pieces_first(b, j);
    const uint32_t classes = out->classes;
    const bool narrow = out->lattice->narrow;
    uint32_t at = out->corners;
    sunder_i_merge m = sunder_i_merge_of(a->end[i] - af, b->end[j] - bf);
    for (; SUNDER_I_MERGE_NEXT(&m, sunder_i_rank_cmp(a->rank[af + m.next_a], b->rank[bf + m.next_b])); at++) {
        const uint32_t k = af + m.a, l = bf + m.b;
        const sunder_i_point u = a->corner[k], v = b->corner[l];
        out->corner[at] = narrow ? (sunder_i_point){u.x + v.x, u.y + v.y} : sunder_i_point_add(out->lattice, u, v);
        out->rank[at] = m.of_a ? a->rank[k] : b->rank[l];
        if (m.of_a && m.of_b)
            out->candidate[at] = a->candidate[k] || b->candidate[l];
        else
            out->candidate[at] =
                m.of_a ? is_candidate(p, k, q, b->vertex[l], classes) : is_candidate(q, l, p, a->vertex[k], classes);
    }
    out->end[out->n++] = out->corners = at;
}

static uint32_t corners_of(const sunder_i_convex_pieces *list, uint32_t piece)
{
    return list->end[piece] - sunder_i_convex_pieces_first(list, piece);
}

/* Adds the subsums of an incomplete list. */
static bool add_listed(const operand *p, const operand *q, const sunder_i_subsum_list *list,
                       sunder_i_convex_pieces *out)
{
    size_t corners = 0;
    for (size_t k = 0; k < list->n; k++)
        corners +=
            corners_of(&p->pieces, (uint32_t)(list->pair[k] >> 32)) + corners_of(&q->pieces, (uint32_t)list->pair[k]);
    if (!sunder_i_convex_pieces_init(out, list->n, corners)) return false;
    out->lattice = p->pieces.lattice;
    out->classes = p->pieces.classes;
    out->direction = p->pieces.direction;
    for (size_t k = 0; k < list->n; k++) {
        if (!sunder_i_step()) return false;
        add_subsum(p, (uint32_t)(list->pair[k] >> 32), q, (uint32_t)list->pair[k], out);
    }
    return true;
}

static bool add_all(const operand *p, const operand *q, sunder_i_convex_pieces *out)
{
    const uint32_t m = p->pieces.n, n = q->pieces.n;
    if (!sunder_i_convex_pieces_init_sum(&p->pieces, &q->pieces, out)) return false;
    for (uint32_t i = 0; i < m; i++) {
        if (!sunder_i_steps(n)) return false;
        for (uint32_t j = 0; j < n; j++) add_subsum(p, i, q, j, out);
    }
    return true;
}

/* If there are fewer subsums than this, all are computed. */
#define FEW_SUBSUMS 256
/* The work of computing a subsum that turns out to be covered, as the number of pairs that are examined in that time:
 * about ten thousand instructions (stars, random polygons). */
#define SUBSUM_WORTH 128.0

static bool add_needed(const operand *p, const operand *q, sunder_i_convex_pieces *out)
{
    sunder_i_subsum_list list = {.all = (size_t)p->pieces.n * q->pieces.n < FEW_SUBSUMS};
    if (!list.all && !sunder_i_needed_subsums(&p->pieces, &q->pieces, SUBSUM_WORTH, &list)) return false;
    const bool ok = list.all ? add_all(p, q, out) : add_listed(p, q, &list, out);
    sunder_i_subsum_list_free(&list);
    return ok && !out->lattice->arena.failed;
}

sunder_status sunder_i_subsums_build(sunder_i_lattice *lattice, const sunder_shape *p, const sunder_i_point *vp,
                                     const sunder_shape *q, const sunder_i_point *vq, sunder_i_directions *directions,
                                     sunder_i_convex_pieces *out, sunder_error *err)
{
    operand a = {0}, b = {0};
    sunder_i_convex_pieces *const list[2] = {&a.pieces, &b.pieces};
    memset(directions, 0, sizeof *directions);
    memset(out, 0, sizeof *out);
    bool ok = operand_init(&a, lattice, p, vp) && operand_init(&b, lattice, q, vq) &&
              sunder_i_convex_pieces_rank(lattice, list, 2, directions);
    if (ok) {
        take_edge_ranks(&a);
        take_edge_ranks(&b);
        ok = add_needed(&a, &b, out);
    }
    operand_free(&a);
    operand_free(&b);
    if (ok) return SUNDER_OK;
    sunder_i_directions_free(directions);
    sunder_i_convex_pieces_free(out);
    return sunder_i_failure_cause(err);
}
