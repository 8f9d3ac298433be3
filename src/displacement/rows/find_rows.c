/* The rows of a layer.
 *
 * Seen from a body there are four sides, in the directions of its walls. On each it has at most one neighbour in a row:
 * the nearest one, if it is also the nearest one of that neighbour. A row leaves a body on the side opposite to the one
 * that it arrives at, so that a body at a corner may belong to two rows. */
#include "displacement/rows/row_limits.h"
#include "displacement/rows/row_pairs.h"

#include "base/watch.h"

#include <math.h>

/* What is known while rows are being found. */
typedef struct row_search {
    const sunder_i_model *model;
    sunder_i_walls *walls; /* [features] */
    sunder_i_row_pairs pairs;
    sunder_i_row_edge *edge; /* [edges] */
    double *distance;        /* [edges] of the two members */
    size_t edges;
    uint32_t (*side)[4]; /* [bodies] the edge on each side; NONE */
} row_search;

#define NONE UINT32_MAX

/* ---- Edges ------------------------------------------------------------------------------------------------------- */

/* Returns false if the work is to stop, as the other functions that return a bool do, also if memory is out. */
static bool measure_walls(row_search *s)
{
    for (size_t f = 0; f < s->model->features; f++) {
        if (!sunder_i_step()) return false;
        if (s->model->present[f]) sunder_i_walls_add(sunder_i_thing_shape(s->model, f), &s->walls[f]);
    }
    return true;
}

/* Lists the pairs that stand side by side, with no line of a barrier between them. */
static bool list_edges(row_search *s)
{
    sunder_i_list near = {0};
    bool ok = true;
    s->edge = sunder_i_alloc(s->pairs.n, sizeof *s->edge);
    s->distance = sunder_i_alloc(s->pairs.n, sizeof *s->distance);
    if (!s->edge || !s->distance) return false;
    for (size_t k = 0; k < s->pairs.n && ok; k++) {
        const sunder_i_row_pair *pair = &s->pairs.pair[k];
        bool crossed = false;
        ok = sunder_i_step();
        if (!ok || !sunder_i_row_side_by_side(s->model, s->walls, pair, &s->edge[s->edges])) continue;
        ok = sunder_i_row_link_is_crossed(s->model, pair, &near, &crossed);
        if (!crossed) s->distance[s->edges++] = pair->distance;
    }
    sunder_i_free(near.item);
    return ok;
}

/* ---- Sides ------------------------------------------------------------------------------------------------------- */

/* Returns the side of a body that faces the direction: 0 and 2 are opposite sides, and so are 1 and 3. */
static unsigned side_of(const row_search *s, uint32_t body, const double direction[2])
{
    const sunder_i_body *b = &s->model->body[body];
    sunder_i_walls walls = {{0, 0}, 0};
    double axis[2];
    for (uint32_t m = b->member; m < b->member + b->members; m++) {
        const sunder_i_walls *of = &s->walls[s->model->member[m]];
        walls.direction[0] += of->direction[0];
        walls.direction[1] += of->direction[1];
    }
    if (!(hypot(walls.direction[0], walls.direction[1]) > 0)) walls.direction[0] = 1;
    sunder_i_walls_axis(&walls, axis);
    const double along = direction[0] * axis[0] + direction[1] * axis[1],
                 across = direction[1] * axis[0] - direction[0] * axis[1];
    return fabs(along) >= fabs(across) ? (along > 0 ? 0 : 2) : (across > 0 ? 1 : 3);
}

/* Does edge d come before edge e, of the same body? The shorter one does; of two of one length the one with the lower
 * separation and offset, and then the one with the lower number. */
static bool is_before(const row_search *s, uint32_t d, uint32_t e)
{
    const sunder_i_row_edge *p = &s->edge[d], *q = &s->edge[e];
    if (s->distance[d] != s->distance[e]) return s->distance[d] < s->distance[e];
    if (p->apart != q->apart) return p->apart < q->apart;
    if (fabs(p->offset) != fabs(q->offset)) return fabs(p->offset) < fabs(q->offset);
    return d < e;
}

/* Makes edge e the one on that side of the body, if it comes before the one that is there. */
static void offer_edge(row_search *s, uint32_t body, const double direction[2], uint32_t e)
{
    uint32_t *have = &s->side[body][side_of(s, body, direction)];
    if (*have == NONE || is_before(s, e, *have)) *have = e;
}

static bool has_edge(const row_search *s, uint32_t body, uint32_t e)
{
    for (unsigned k = 0; k < 4; k++)
        if (s->side[body][k] == e) return true;
    return false;
}

/* Chooses the edge on each side of each body, and drops those that only one of their bodies has chosen. */
static bool choose_sides(row_search *s)
{
    for (size_t b = 0; b < s->model->bodies; b++)
        for (unsigned k = 0; k < 4; k++) s->side[b][k] = NONE;
    for (size_t e = 0; e < s->edges; e++) {
        const double *to = s->edge[e].along, back[2] = {-to[0], -to[1]};
        if (!sunder_i_step()) return false;
        offer_edge(s, s->edge[e].i, to, (uint32_t)e);
        offer_edge(s, s->edge[e].j, back, (uint32_t)e);
    }
    for (size_t b = 0; b < s->model->bodies; b++) {
        for (unsigned k = 0; k < 4; k++) {
            const uint32_t e = s->side[b][k];
            if (e == NONE) continue;
            const uint32_t other = s->edge[e].i == b ? s->edge[e].j : s->edge[e].i;
            if (!has_edge(s, other, e)) s->side[b][k] = NONE;
        }
    }
    return true;
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

/* Turns an edge around. */
static sunder_i_row_edge turned(const sunder_i_row_edge *e)
{
    return (sunder_i_row_edge){.i = e->j,
                               .j = e->i,
                               .f = e->g,
                               .g = e->f,
                               .along = {-e->along[0], -e->along[1]},
                               .apart = e->apart,
                               .offset = e->offset};
}

/* Takes the edge on that side of the body and those that follow it off the sides, and appends them to the row `out`
 * that ends before *n. Returns the number of bodies of the row. */
static size_t take_row(row_search *s, uint32_t body, unsigned side, sunder_i_row_edge *out, size_t *n)
{
    const uint32_t first = body;
    size_t bodies = 1;
    for (uint32_t e; (e = s->side[body][side]) != NONE;) {
        const sunder_i_row_edge edge = s->edge[e].i == body ? s->edge[e] : turned(&s->edge[e]);
        out[(*n)++] = edge;
        s->side[body][side] = NONE;
        body = edge.j;
        for (side = 0; s->side[body][side] != e;) side++;
        s->side[body][side] = NONE;
        side ^= 2;
        bodies += body != first;
    }
    return bodies;
}

/* Appends the row that begins on that side of the body, unless it is too short. */
static void append_row(row_search *s, uint32_t body, unsigned side, sunder_i_rows *rows, size_t *n)
{
    const size_t begin = *n;
    if (s->side[body][side] == NONE) return;
    if (take_row(s, body, side, rows->edge, n) < ROW_LEAST)
        *n = begin;
    else
        rows->row_end[rows->rows++] = *n;
}

/* Lists the rows: first those with two ends, each from the end with the lower number, then rings. */
static bool list_rows(row_search *s, sunder_i_rows *rows)
{
    size_t n = 0;
    rows->edge = sunder_i_alloc(s->edges, sizeof *rows->edge);
    rows->row_end = sunder_i_alloc(s->edges, sizeof *rows->row_end);
    if (!rows->edge || !rows->row_end) return false;
    for (uint32_t b = 0; b < s->model->bodies; b++)
        for (unsigned k = 0; k < 4; k++)
            if (s->side[b][k ^ 2] == NONE) append_row(s, b, k, rows, &n);
    for (uint32_t b = 0; b < s->model->bodies; b++)
        for (unsigned k = 0; k < 4; k++) append_row(s, b, k, rows, &n);
    return true;
}

sunder_status sunder_i_rows_find(const sunder_i_model *model, sunder_i_rows *rows, sunder_error *err)
{
    row_search s = {.model = model};
    *rows = (sunder_i_rows){0};
    s.walls = sunder_i_calloc(model->features, sizeof *s.walls);
    s.side = sunder_i_alloc(model->bodies, sizeof *s.side);
    const bool begun = s.walls && s.side && measure_walls(&s);
    sunder_status status = begun ? sunder_i_row_pairs_find(model, &s.pairs, err) : sunder_i_failure_cause(err);
    if (!status && !(sunder_i_row_pairs_thin_out(&s.pairs, model->bodies) && list_edges(&s) && choose_sides(&s) &&
                     list_rows(&s, rows)))
        status = sunder_i_failure_cause(err);
    sunder_i_free_all(s.walls, s.pairs.pair, s.edge, s.distance, s.side);
    return status;
}

void sunder_i_rows_free(sunder_i_rows *rows)
{
    sunder_i_free_all(rows->edge, rows->row_end);
    *rows = (sunder_i_rows){0};
}
