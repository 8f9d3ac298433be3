/* Rows that the caller gives: the bodies of one row are ordered along the path through their neighbours.
 *
 * The two nearest bodies of a row are joined, then the next two, and so on, except where one of them has two neighbours
 * already, or both are in one path. In the end each row is one path through all its bodies. Pairs are looked for within
 * a distance that grows until no row has two paths: first all near pairs are found, and later only those between the
 * ends of paths. */
#include "displacement/rows/row_limits.h"
#include "displacement/rows/row_pairs.h"

#include "base/extremes.h"
#include "base/union_find.h"
#include "base/watch.h"

#include <math.h>
#include <stdlib.h>

typedef struct joining {
    const sunder_i_model *model;
    sunder_i_walls *walls;      /* [features] */
    sunder_i_rows_wanted among; /* the row of each body, its path, and the number of its neighbours */
    sunder_i_row_edge *edge;    /* [bodies] */
    size_t edges, most;         /* most: the number of edges when each row is one path */
    uint32_t (*at)[2];          /* [bodies] the edges of each body; NONE */
} joining;

#define NONE UINT32_MAX

/* ---- The row of each body ---------------------------------------------------------------------------------------- */

/* Takes the row of each body from its features. Fails if two features of one block are in different rows. */
static sunder_status take_rows(joining *s, sunder_error *err)
{
    const sunder_i_model *model = s->model;
    const int64_t *row = model->layer->given->row;
    for (uint32_t b = 0; b < model->bodies; b++) s->among.row[b] = -1;
    for (uint32_t f = 0; f < model->features && row; f++) {
        const size_t number = model->layer->number[f];
        int64_t *of_body = &s->among.row[model->body_of[f]];
        if (!model->present[f] || row[number] < 0) continue;
        if (*of_body >= 0 && *of_body != row[number])
            return sunder_i_fail_at(err, SUNDER_EINVALID, number, SIZE_MAX, SIZE_MAX,
                                    "its row is not that of another feature of its block");
        *of_body = row[number];
    }
    return SUNDER_OK;
}

static int by_value(const void *x, const void *y)
{
    const int64_t *p = x, *q = y;
    return *p < *q ? -1 : *p > *q;
}

/* Sets s->most. Returns false if memory is out. */
static bool count_edges(joining *s)
{
    int64_t *row = sunder_i_alloc(s->model->bodies, sizeof *row);
    size_t n = 0;
    for (size_t b = 0; row && b < s->model->bodies; b++)
        if (s->among.row[b] >= 0) row[n++] = s->among.row[b];
    if (row && n) qsort(row, n, sizeof *row, by_value);
    for (size_t k = 1; row && k < n; k++) s->most += row[k] == row[k - 1];
    sunder_i_free(row);
    return row != NULL;
}

/* ---- Paths ------------------------------------------------------------------------------------------------------- */

/* Orders pairs by distance; those at one distance by their links, and then by their bodies. */
static int by_distance(const void *x, const void *y)
{
    const int order = sunder_i_row_pair_compare(x, y);
    return order ? order : sunder_i_by_id_pair(x, y);
}

/* Joins the two bodies of the pair, unless one has two neighbours or both are in one path. Returns false if the work is
 * to stop. */
static bool join_pair(joining *s, const sunder_i_row_pair *pair, sunder_i_list *near)
{
    sunder_i_rows_wanted *w = &s->among;
    double link[2][2];
    bool crossed;
    if (w->joined[pair->i] == 2 || w->joined[pair->j] == 2 ||
        sunder_i_union_find(w->path, pair->i) == sunder_i_union_find(w->path, pair->j))
        return sunder_i_step();
    sunder_i_row_edge *edge = &s->edge[s->edges];
    sunder_i_row_join(s->model, s->walls, pair, edge, link);
    if (!sunder_i_row_link_is_crossed(s->model, link, near, &crossed)) return false;
    /* A barrier's line between two bodies keeps them in order; they have springs, and no rule. */
    if (crossed) edge->apart = sunder_i_min(edge->apart, 0);
    s->at[pair->i][w->joined[pair->i]++] = (uint32_t)s->edges;
    s->at[pair->j][w->joined[pair->j]++] = (uint32_t)s->edges++;
    sunder_i_union_join(w->path, pair->i, pair->j);
    return sunder_i_step();
}

/* Joins all pairs within s->among.reach, the nearest first. */
static sunder_status join_within_reach(joining *s, sunder_error *err)
{
    sunder_i_row_pairs pairs = {0};
    sunder_i_list near = {0};
    for (uint32_t b = 0; b < s->model->bodies; b++) s->among.path[b] = sunder_i_union_find(s->among.path, b);
    sunder_status status = sunder_i_row_pairs_find(s->model, &s->among, &pairs, err);
    if (!status && pairs.n) qsort(pairs.pair, pairs.n, sizeof *pairs.pair, by_distance);
    for (size_t k = 0; k < pairs.n && !status; k++)
        if (!join_pair(s, &pairs.pair[k], &near)) status = sunder_i_failure_cause(err);
    sunder_i_free_all(near.item, pairs.pair);
    return status;
}

/* The greatest extent of the bodies in rows: of one of them, and of all. */
static void measure_extents(const joining *s, double *one, double *all)
{
    double whole[4];
    sunder_i_box_clear(whole);
    *one = 0;
    for (size_t b = 0; b < s->model->bodies; b++) {
        double box[4];
        if (s->among.row[b] < 0) continue;
        sunder_i_body_home_box(s->model, &s->model->body[b], box);
        sunder_i_box_join(whole, box);
        *one = sunder_i_max(*one, sunder_i_max(box[2] - box[0], box[3] - box[1]));
    }
    *all = sunder_i_max(0, whole[2] - whole[0]) + sunder_i_max(0, whole[3] - whole[1]);
}

static sunder_status join_all(joining *s, sunder_error *err)
{
    double one, all;
    measure_extents(s, &one, &all);
    const double gap = sunder_i_row_full_gap(s->model);
    sunder_status status = SUNDER_OK;
    double reach = gap > 0 ? ROW_REACH * gap : one;
    bool more = true;
    while (s->edges < s->most && more && !status) {
        s->among.reach = reach;
        status = join_within_reach(s, err);
        more = reach <= 2 * all && reach < INFINITY;
        reach *= 2;
    }
    return status;
}

/* ---- Their order ------------------------------------------------------------------------------------------------- */

/* The least of the caller's numbers of the body's features. */
static uint32_t least_number(const sunder_i_model *model, uint32_t body)
{
    const sunder_i_body *b = &model->body[body];
    uint32_t least = NONE;
    for (uint32_t m = b->member; m < b->member + b->members; m++)
        least = model->layer->number[model->member[m]] < least ? model->layer->number[model->member[m]] : least;
    return least;
}

/* Numbers the sides of the edges of the path that begins at this end: a row leaves a body at side 0, and arrives at
 * side 2. */
static void follow_path(joining *s, uint32_t end)
{
    for (uint32_t body = end, e = s->at[end][0]; e != NONE;) {
        sunder_i_row_edge *edge = &s->edge[e];
        const bool turned = edge->j == body;
        edge->side[turned] = 0;
        edge->side[!turned] = 2;
        body = turned ? edge->i : edge->j;
        e = s->at[body][s->at[body][0] == e];
    }
}

/* Each path begins at the end with the lower number. other[]: [bodies] scratch */
static void order_paths(joining *s, uint32_t *other)
{
    const sunder_i_model *model = s->model;
    for (uint32_t b = 0; b < model->bodies; b++) other[b] = NONE;
    for (uint32_t b = 0; b < model->bodies; b++) {
        if (s->among.joined[b] != 1) continue;
        uint32_t *first = &other[sunder_i_union_find(s->among.path, b)];
        if (*first == NONE)
            *first = b;
        else
            follow_path(s, least_number(model, b) < least_number(model, *first) ? b : *first);
    }
}

static int by_bodies_of_edges(const void *x, const void *y)
{
    const sunder_i_row_edge *p = x, *q = y;
    return p->i != q->i ? (p->i < q->i ? -1 : 1) : p->j < q->j ? -1 : p->j > q->j;
}

/* What decides on the neighbours of a body is its row. other[]: as in order_paths() */
static bool find_reach(joining *s, sunder_i_rows *rows, double (*whole)[4])
{
    const sunder_i_model *model = s->model;
    if (!model->read) return true;
    rows->reach = sunder_i_alloc(model->bodies, sizeof *rows->reach);
    if (!rows->reach || !whole) return false;
    for (uint32_t b = 0; b < model->bodies; b++) sunder_i_box_clear(whole[b]);
    for (uint32_t b = 0; b < model->bodies; b++) {
        sunder_i_body_home_box(model, &model->body[b], rows->reach[b]);
        sunder_i_box_join(whole[sunder_i_union_find(s->among.path, b)], rows->reach[b]);
    }
    for (uint32_t b = 0; b < model->bodies; b++)
        sunder_i_box_join(rows->reach[b], whole[sunder_i_union_find(s->among.path, b)]);
    return true;
}

static sunder_status order_rows(joining *s, sunder_i_rows *rows, sunder_error *err)
{
    const size_t n = s->model->bodies;
    uint32_t *other = sunder_i_alloc(n, sizeof *other);
    double(*whole)[4] = s->model->read ? sunder_i_alloc(n, sizeof *whole) : NULL;
    const bool ok = other && find_reach(s, rows, whole);
    if (ok) order_paths(s, other);
    if (ok && s->edges) qsort(s->edge, s->edges, sizeof *s->edge, by_bodies_of_edges);
    sunder_i_free_all(other, whole);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

sunder_status sunder_i_rows_take_given(const sunder_i_model *model, sunder_i_rows *rows, sunder_error *err)
{
    const size_t n = model->bodies;
    joining s = {.model = model,
                 .walls = sunder_i_calloc(model->features, sizeof *s.walls),
                 .among = {.row = sunder_i_alloc(n, sizeof *s.among.row),
                           .path = sunder_i_alloc(n, sizeof *s.among.path),
                           .joined = sunder_i_calloc(n, sizeof *s.among.joined)},
                 .edge = sunder_i_alloc(n, sizeof *s.edge),
                 .at = sunder_i_alloc(n, sizeof *s.at)};
    const bool begun = s.walls && s.among.row && s.among.path && s.among.joined && s.edge && s.at &&
                       sunder_i_rows_measure_walls(model, s.walls);
    sunder_status status = begun ? take_rows(&s, err) : sunder_i_failure_cause(err);
    if (!status && !count_edges(&s)) status = sunder_i_failure_cause(err);
    if (!status) sunder_i_union_init(s.among.path, n);
    for (size_t b = 0; b < n && !status; b++) s.at[b][0] = s.at[b][1] = NONE;
    if (!status) status = join_all(&s, err);
    if (!status) status = order_rows(&s, rows, err);
    rows->edge = s.edge;
    rows->edges = status ? 0 : s.edges;
    sunder_i_free_all(s.walls, s.among.row, s.among.path, s.among.joined, s.at);
    return status;
}
