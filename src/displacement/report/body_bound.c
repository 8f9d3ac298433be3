/* What a body costs at least, by itself among barriers: its move, and the prices of its pairs.
 *
 * Squares cover the disc of its moves. The square with the least bound is cut into four, again and again. In a square
 * with centre c and half diagonal r the move is at least as long as that to the nearest point of the square. A piece of
 * a barrier that lacks s of its distance from a piece of the body at c lacks at least s - r anywhere in the square, and
 * a barrier lacks no less than any of its pieces. If s - r > 0 for a barrier that the body is not in conflict with, the
 * square holds no move of a solution. Other bodies are left out, which only makes the bound smaller. */
#include "displacement/geometry/obstacle.h"
#include "displacement/layer/reads.h"
#include "displacement/report/report.h"
#include "displacement/report/tuning.h"

#include "base/extremes.h"
#include "base/watch.h"

#include <math.h>
#include <string.h>

/* The obstacle of two pieces: edge[first ... first + edges - 1], the distance to keep, and the pair, or NOT_PRICED. */
typedef struct obstacle_of_pieces {
    size_t first, edges, pair;
    double owed;
} obstacle_of_pieces;

#define NOT_PRICED SIZE_MAX

typedef struct square {
    double centre[2], half, least;
} square;

typedef struct bounding {
    const sunder_i_model *model;
    const sunder_i_body *body;
    const sunder_i_priced_barrier *priced;
    double *missing; /* [n] scratch */
    size_t n;
    obstacle_of_pieces *obstacle;
    size_t obstacles, obstacle_capacity;
    sunder_i_obstacle_edge *edge;
    size_t edges, edge_capacity;
    sunder_i_scratch scratch;
    double hair; /* a distance that is larger than all rounding errors */
} bounding;

static size_t find_priced(const bounding *b, uint32_t part)
{
    const uint32_t whole = sunder_i_whole_of(b->model, part);
    size_t k = 0;
    while (k < b->n && b->priced[k].whole != whole) k++;
    return k < b->n ? k : NOT_PRICED;
}

static bool add_obstacle(bounding *b, const sunder_i_body *other, const sunder_i_body_piece *of_barrier,
                         const sunder_i_body_piece *own)
{
    const double offset[2] = {b->body->origin[0] - other->origin[0], b->body->origin[1] - other->origin[1]};
    const uint32_t part = b->model->member[other->member];
    const size_t n = sunder_i_obstacle_corners(of_barrier->corner, of_barrier->corners, own->corner, own->corners,
                                               offset, &b->scratch);
    if (n == 0 || !sunder_i_reserve(&b->edge, &b->edge_capacity, b->edges + n, sizeof *b->edge) ||
        !sunder_i_reserve(&b->obstacle, &b->obstacle_capacity, b->obstacles + 1, sizeof *b->obstacle))
        return false;
    const size_t edges = sunder_i_obstacle_edges(b->scratch.xy, n, b->edge + b->edges);
    const size_t pair = find_priced(b, part);
    const double owed = pair == NOT_PRICED ? sunder_i_owed_below(b->model, own->feature, part)
                                           : sunder_i_full_below(b->model, own->feature, part);
    b->obstacle[b->obstacles++] = (obstacle_of_pieces){b->edges, edges, pair, owed};
    b->edges += edges;
    return true;
}

/* Adds the obstacles of the pieces of one part of a barrier. */
static bool add_part(bounding *b, const sunder_i_body *other)
{
    const sunder_i_body_pieces *own = sunder_i_pieces_of(b->model, b->body), *of = sunder_i_pieces_of(b->model, other);
    const double far = b->body->limit + b->model->rules.full_gap;
    bool ok = own && of;
    for (uint32_t k = 0; k < other->pieces && ok; k++)
        for (uint32_t l = 0; l < b->body->pieces && ok; l++) {
            double box[4];
            for (int c = 0; c < 4; c++)
                box[c] = of->piece[k].box[c] + other->origin[c & 1] - b->body->origin[c & 1] + (c < 2 ? -far : far);
            if (of->piece[k].corners && sunder_i_box_meet(box, own->piece[l].box))
                ok = add_obstacle(b, other, &of->piece[k], &own->piece[l]);
        }
    return ok;
}

/* Adds the obstacles of all barriers that the body may reach. */
static bool add_barriers(bounding *b)
{
    const double none[2] = {0, 0};
    sunder_i_list hits = {0};
    double box[4], most = 0;
    sunder_i_body_box(b->body, none, b->body->limit + b->model->rules.full_gap, box);
    bool ok = sunder_i_look_about(b->model, b->model->standing, box, &hits);
    sunder_i_things_to_bodies(b->model, &hits);
    for (size_t k = 0; k < hits.n && ok; k++) {
        const sunder_i_body *other = &b->model->body[hits.item[k]];
        if (sunder_i_is_barrier_body(b->model, other) && !other->far) ok = add_part(b, other);
    }
    for (int c = 0; c < 4; c++) most = sunder_i_max(most, fabs(box[c]));
    b->hair = 0x1p-26 * (sunder_i_max(box[2] - box[0], box[3] - box[1])) + 0x1p-44 * most;
    sunder_i_free(hits.item);
    return ok;
}

/* A lower bound of the cost for any place in the square. */
static double least_in(bounding *b, const square *s)
{
    const double reach = s->half * 1.4142136 + b->hair;
    double move = 0, cost;
    for (int c = 0; c < 2; c++) {
        const double far = sunder_i_max(0, fabs(s->centre[c]) - s->half);
        move += far * far;
    }
    if (move * (1 - 0x1p-40) > b->body->limit * b->body->limit) return INFINITY;
    memset(b->missing, 0, b->n * sizeof *b->missing);
    for (size_t k = 0; k < b->obstacles; k++) {
        const obstacle_of_pieces *o = &b->obstacle[k];
        const double lacks = o->owed - sunder_i_support_at(b->edge + o->first, o->edges, s->centre).distance - reach;
        if (!(lacks > 0)) continue;
        if (o->pair == NOT_PRICED) return INFINITY;
        b->missing[o->pair] = sunder_i_max(b->missing[o->pair], lacks);
    }
    cost = b->body->weight * move;
    for (size_t k = 0; k < b->n; k++) cost += sunder_i_price_at(&b->priced[k].price, b->missing[k]);
    return cost;
}

/* Cuts squares until the least bound reaches `enough`, or there are too many. Returns the least bound. */
static double cut_squares(bounding *b, double enough)
{
    square list[MOST_SQUARES] = {{{0, 0}, b->body->limit, 0}};
    for (size_t n = 1;;) {
        size_t at = 0;
        for (size_t k = 1; k < n; k++)
            if (list[k].least < list[at].least) at = k;
        if (n + 3 > MOST_SQUARES || list[at].least >= enough * (1 - NEARLY_ENOUGH) || !sunder_i_steps(b->obstacles))
            return list[at].least;
        const square s = list[at];
        for (int k = 0; k < 4; k++) {
            const double half = s.half / 2;
            square *child = k ? &list[n++] : &list[at];
            *child = (square){{s.centre[0] + (k & 1 ? half : -half), s.centre[1] + (k & 2 ? half : -half)}, half, 0};
            child->least = sunder_i_max(s.least, least_in(b, child));
        }
    }
}

bool sunder_i_body_bound(const sunder_i_model *model, uint32_t body, const sunder_i_priced_barrier *priced, size_t n,
                         double enough, double *bound)
{
    bounding b = {.model = model, .body = &model->body[body], .priced = priced, .n = n};
    *bound = 0;
    if (b.body->limit == INFINITY || b.body->far) return true;
    b.missing = sunder_i_alloc(n, sizeof *b.missing);
    const bool ok = b.missing && add_barriers(&b);
    if (ok && b.obstacles) *bound = cut_squares(&b, enough);
    if (*bound == INFINITY) *bound = 0;
    sunder_i_free_all(b.missing, b.obstacle, b.edge, b.scratch.xy);
    return ok;
}
