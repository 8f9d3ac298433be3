/* The rows of a layer.
 *
 * Seen from a body there are four sides, in the directions of its walls. On each it has at most one neighbour in a row:
 * the nearest one, if it is also the nearest one of that neighbour. A row leaves a body on the side opposite to the one
 * that it arrives at, so that a body at a corner may belong to two rows. A row has at least three bodies. All this is
 * local: the last section says what decides on the neighbours of a body. */
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
    double (*about)[4];  /* [bodies] the surroundings of each; NULL unless rows->reach is wanted */
} row_search;

#define NONE UINT32_MAX

/* ---- Edges ------------------------------------------------------------------------------------------------------- */

/* Joins the link of the pair, where a barrier decides, to the surroundings of the two. */
static void join_link(row_search *s, const sunder_i_row_pair *pair, double link[2][2])
{
    for (int k = 0; k < 2 && s->about; k++) {
        const double end[4] = {link[k][0], link[k][1], link[k][0], link[k][1]};
        sunder_i_box_join(s->about[pair->i], end);
        sunder_i_box_join(s->about[pair->j], end);
    }
}

/* Lists the pairs that stand side by side, with no line of a barrier between them. Returns false if the work is to
 * stop, as the other functions that return a bool do, also if memory is out. */
static bool list_edges(row_search *s)
{
    sunder_i_list near = {0};
    bool ok = true;
    s->edge = sunder_i_alloc(s->pairs.n, sizeof *s->edge);
    s->distance = sunder_i_alloc(s->pairs.n, sizeof *s->distance);
    if (!s->edge || !s->distance) return false;
    for (size_t k = 0; k < s->pairs.n && ok; k++) {
        const sunder_i_row_pair *pair = &s->pairs.pair[k];
        double link[2][2];
        bool crossed = false;
        ok = sunder_i_step();
        if (!ok || !sunder_i_row_side_by_side(s->model, s->walls, pair, &s->edge[s->edges], link)) continue;
        join_link(s, pair, link);
        ok = sunder_i_row_link_is_crossed(s->model, link, &near, &crossed);
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

/* Returns the side of the body on which edge e is; 4 if it is on none. */
static uint32_t side_with(const row_search *s, uint32_t body, uint32_t e)
{
    uint32_t side = 0;
    while (side < 4 && s->side[body][side] != e) side++;
    return side;
}

/* Chooses the edge on each side of each body. */
static bool choose_edges(row_search *s)
{
    for (size_t b = 0; b < s->model->bodies; b++)
        for (unsigned k = 0; k < 4; k++) s->side[b][k] = NONE;
    for (size_t e = 0; e < s->edges; e++) {
        const double *to = s->edge[e].along, back[2] = {-to[0], -to[1]};
        if (!sunder_i_step()) return false;
        offer_edge(s, s->edge[e].i, to, (uint32_t)e);
        offer_edge(s, s->edge[e].j, back, (uint32_t)e);
    }
    return true;
}

/* Takes the edges off the sides that only one of their bodies has chosen. */
static void drop_one_sided(row_search *s)
{
    for (uint32_t b = 0; b < s->model->bodies; b++) {
        for (unsigned k = 0; k < 4; k++) {
            const uint32_t e = s->side[b][k];
            if (e != NONE && side_with(s, s->edge[e].i == b ? s->edge[e].j : s->edge[e].i, e) == 4)
                s->side[b][k] = NONE;
        }
    }
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

/* Lists the edges that both of their bodies have chosen. A row has at least three bodies, so it goes on beyond one of
 * the two bodies of each edge. */
static bool list_rows(const row_search *s, sunder_i_rows *rows)
{
    rows->edge = sunder_i_alloc(s->edges, sizeof *rows->edge);
    for (uint32_t e = 0; e < s->edges && rows->edge; e++) {
        sunder_i_row_edge edge = s->edge[e];
        edge.side[0] = side_with(s, edge.i, e);
        edge.side[1] = side_with(s, edge.j, e);
        if (edge.side[0] < 4 &&
            (s->side[edge.i][edge.side[0] ^ 2] != NONE || s->side[edge.j][edge.side[1] ^ 2] != NONE))
            rows->edge[rows->edges++] = edge;
    }
    return rows->edge != NULL;
}

/* ---- What decides on them ---------------------------------------------------------------------------------------- */

/* Sets s->about to the surroundings of each body: its box grown by ROW_REACH gaps, and the bodies that are so near. */
static bool find_surroundings(row_search *s)
{
    double box[4];
    s->about = sunder_i_alloc(s->model->bodies, sizeof *s->about);
    for (uint32_t b = 0; b < s->model->bodies && s->about; b++) {
        sunder_i_body_home_box(s->model, &s->model->body[b], box);
        sunder_i_box_grow(box, ROW_REACH * sunder_i_row_full_gap(s->model), s->about[b]);
    }
    for (size_t k = 0; k < s->pairs.n && s->about; k++) {
        const uint32_t i = s->pairs.pair[k].i, j = s->pairs.pair[k].j;
        sunder_i_body_home_box(s->model, &s->model->body[j], box);
        sunder_i_box_join(s->about[i], box);
        sunder_i_body_home_box(s->model, &s->model->body[i], box);
        sunder_i_box_join(s->about[j], box);
    }
    return s->about != NULL;
}

/* Joins to `reach` the surroundings of a body and of those that it has chosen, and so on for `steps` of them. */
static void join_surroundings(const row_search *s, uint32_t body, int steps, double reach[4])
{
    sunder_i_box_join(reach, s->about[body]);
    for (unsigned k = 0; k < 4 && steps > 0; k++) {
        const uint32_t e = s->side[body][k];
        if (e == NONE) continue;
        join_surroundings(s, s->edge[e].i == body ? s->edge[e].j : s->edge[e].i, steps - 1, reach);
    }
}

/* Sets rows->reach, the box of all that can change the row at a body. The edges that a body chooses depend on its own
 * surroundings. An edge counts only if both of its bodies chose it, so the surroundings of its neighbours matter; the
 * row continues by edges of these, so those of their neighbours do. Called between choose_edges() and
 * drop_one_sided(). */
static bool find_reach(const row_search *s, sunder_i_rows *rows)
{
    if (!s->about) return true;
    rows->reach = sunder_i_alloc(s->model->bodies, sizeof *rows->reach);
    for (uint32_t b = 0; b < s->model->bodies && rows->reach; b++) {
        sunder_i_box_clear(rows->reach[b]);
        join_surroundings(s, b, 2, rows->reach[b]);
    }
    return rows->reach != NULL;
}

static sunder_status find_rows(const sunder_i_model *model, sunder_i_rows *rows, sunder_error *err)
{
    const sunder_i_rows_wanted wanted = {.reach = ROW_REACH * sunder_i_row_full_gap(model)};
    row_search s = {.model = model};
    s.walls = sunder_i_calloc(model->features, sizeof *s.walls);
    s.side = sunder_i_alloc(model->bodies, sizeof *s.side);
    const bool begun = s.walls && s.side && sunder_i_rows_measure_walls(model, s.walls);
    sunder_status status = begun ? sunder_i_row_pairs_find(model, &wanted, &s.pairs, err) : sunder_i_failure_cause(err);
    bool ok = !status && (!model->read || find_surroundings(&s)) &&
              sunder_i_row_pairs_thin_out(&s.pairs, model->bodies) && list_edges(&s) && choose_edges(&s) &&
              find_reach(&s, rows);
    if (ok) drop_one_sided(&s);
    if (!status && !(ok && list_rows(&s, rows))) status = sunder_i_failure_cause(err);
    sunder_i_free_all(s.walls, s.pairs.pair, s.edge, s.distance, s.side, s.about);
    return status;
}

sunder_status sunder_i_rows_find(const sunder_i_model *model, sunder_i_rows *rows, sunder_error *err)
{
    *rows = (sunder_i_rows){0};
    return model->rules.rows == SUNDER_ROWS_GIVEN ? sunder_i_rows_take_given(model, rows, err)
                                                  : find_rows(model, rows, err);
}

sunder_status sunder_i_rows_forget_hidden(sunder_i_rows *rows, const sunder_i_model *model, sunder_error *err)
{
    sunder_i_row_edge *edge = sunder_i_alloc(rows->edges, sizeof *edge);
    if (!edge) return sunder_i_failure_cause(err);
    size_t n = 0;
    for (int hidden = 0; hidden < 2; hidden++) {
        for (size_t k = 0; k < rows->edges; k++)
            if ((model->present[rows->edge[k].f] && model->present[rows->edge[k].g]) != hidden)
                edge[n++] = rows->edge[k];
        if (!hidden) rows->hidden = rows->edges - n;
    }
    rows->edges -= rows->hidden;
    sunder_i_free(rows->edge);
    rows->edge = edge;
    return SUNDER_OK;
}

void sunder_i_rows_free(sunder_i_rows *rows)
{
    sunder_i_free_all(rows->edge, rows->reach);
    *rows = (sunder_i_rows){0};
}
