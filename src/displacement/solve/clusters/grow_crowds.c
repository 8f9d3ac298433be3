/* Crowds absorb the bodies that they will run into before any of them is solved.
 *
 * Thousands of bodies on top of each other spread over the ground of hundreds more, which a crowd finds out when it is
 * solved: then all of it starts again with them, and the work so far was wasted. Prices of area, on a coarse grid, tell
 * the same in a fraction of the time: a body of another cluster, or a single one, near a crowd body's approximate place
 * is absorbed. Of Italy's 10,000 symbols one crowd of 1,750 was solved, then 3,032, and then 4,323; now 4,400 are at
 * once.
 *
 * Boxes decide, and nothing is exact: a body absorbed without need is solved with the crowd as it would be without it,
 * and a body that is missed joins in the next round, as always. Only bodies that may go anywhere are absorbed, with all
 * of their clusters: a crowd with limited bodies does not start where prices put it. */
#include "displacement/prove/areas/areas.h"
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/tuning.h"

#include "base/extremes.h"
#include "base/union_find.h"
#include "spatial/rtree.h"

#include <math.h>
#include <string.h>

typedef struct growth {
    sunder_i_solver *solver;
    bool *placed;        /* [bodies] does it have an approximate position? */
    double *box;         /* [4 * bodies] its box there */
    sunder_i_rtree tree; /* of these boxes */
    bool *unabsorbable;  /* [bodies] it has a limit or is fixed, or is in a cluster with such a body */
    sunder_i_list near;  /* scratch */
} growth;

/* Is it a crowd of more than LARGE_GROWN_CROWD bodies that is due? Smaller crowds start anew whenever they grow, which
 * takes little time. */
static bool is_large_crowd(const sunder_i_solver *s, const sunder_i_cluster *c)
{
    return c->starts_from_areas && c->n > LARGE_GROWN_CROWD &&
           sunder_i_solver_any_of(s, c->body, c->n, sunder_i_is_due);
}

/* Computes the approximate positions of the bodies of a large crowd, and their boxes there. */
static sunder_status place_crowd(const sunder_i_solver *s, sunder_i_cluster *c, double *move, void *context,
                                 sunder_error *err)
{
    growth *g = context;
    bool found = false;
    const sunder_status status = sunder_i_areas_places(&s->model, c->body, c->n, true, move, &found, err);
    for (size_t m = 0; m < c->n && found && !status; m++) {
        const uint32_t b = c->body[m];
        g->placed[b] = true;
        const sunder_i_body *body = &s->model.body[b];
        const double size = sunder_i_max(body->box[2] - body->box[0], body->box[3] - body->box[1]);
        sunder_i_body_box(body, move + 2 * m, s->model.rules.gap / 2 + CROWD_GROWN_BY * size, g->box + 4 * (size_t)b);
    }
    return status;
}

static void find_unabsorbable(growth *g)
{
    const sunder_i_solver *s = g->solver;
    for (uint32_t b = 0; b < s->model.bodies; b++) {
        const sunder_i_body *body = &s->model.body[b];
        g->unabsorbable[b] =
            !sunder_i_may_move(body) || body->pinned || body->limit < INFINITY || sunder_i_is_aside(s, b);
    }
    for (size_t k = 0; k < s->clusters; k++)
        for (size_t m = 0; m < s->cluster[k].n && s->cluster[k].limited; m++)
            g->unabsorbable[s->cluster[k].body[m]] = true;
}

static bool may_join(const growth *g, uint32_t b, uint32_t other)
{
    return !g->unabsorbable[other] &&
           sunder_i_union_find(g->solver->parent, b) != sunder_i_union_find(g->solver->parent, other);
}

/* Joins body b with all bodies that it runs into at its approximate position: bodies of crowds at theirs, others at
 * their present ones. False if memory is out. */
static bool join_met_bodies(growth *g, uint32_t b)
{
    sunder_i_solver *s = g->solver;
    const double *box = g->box + 4 * (size_t)b;
    double about[4];
    g->near.n = 0;
    if (!sunder_i_rtree_query(&g->tree, box, &g->near)) return false;
    for (size_t k = 0; k < g->near.n; k++)
        if (may_join(g, b, g->near.item[k]) && !sunder_i_solver_add_edge(s, b, g->near.item[k])) return false;
    sunder_i_box_grow(box, s->model.rules.gap / 2, about);
    g->near.n = 0;
    if (!sunder_i_look_about(&s->model, &s->placement.tree, about, &g->near)) return false;
    for (size_t k = 0; k < g->near.n; k++) {
        const uint32_t j = s->model.body_of[g->near.item[k]];
        if (g->placed[j] || !may_join(g, b, j)) continue;
        if (!sunder_i_solver_add_edge(s, b, j)) return false;
    }
    return true;
}

static bool join_all_met_bodies(growth *g)
{
    const sunder_i_solver *s = g->solver;
    bool ok = true;
    for (size_t k = 0; k < s->clusters && ok; k++) {
        const sunder_i_cluster *c = &s->cluster[k];
        if (!is_large_crowd(s, c)) continue;
        sunder_i_reading reading;
        sunder_i_reads_begin(&reading, &s->model, sunder_i_reader_for(s, c));
        for (size_t m = 0; m < c->n && ok; m++)
            if (g->placed[c->body[m]]) ok = join_met_bodies(g, c->body[m]);
        sunder_i_reads_end(&reading);
    }
    return ok;
}

/* One round of growth; *any if a crowd absorbed a body. */
static sunder_status grow_once(growth *g, bool *any, sunder_error *err)
{
    sunder_i_solver *s = g->solver;
    const size_t edges = s->edges;
    memset(g->placed, 0, s->model.bodies * sizeof *g->placed);
    sunder_status status = sunder_i_solver_for_clusters(s, is_large_crowd, place_crowd, g, err);
    if (!status) status = sunder_i_rtree_build(g->box, g->placed, s->model.bodies, &g->tree, err);
    if (status) return status;
    find_unabsorbable(g);
    if (!join_all_met_bodies(g)) status = sunder_i_failure_cause(err);
    sunder_i_rtree_free(&g->tree);
    *any = s->edges > edges;
    if (!status && *any) status = sunder_i_solver_gather(s, err);
    if (!status && *any) status = sunder_i_solver_unite_blocks(s, err);
    return status;
}

static bool any_large_crowd(const sunder_i_solver *s)
{
    for (size_t k = 0; k < s->clusters; k++)
        if (is_large_crowd(s, &s->cluster[k])) return true;
    return false;
}

sunder_status sunder_i_solver_grow_crowds(sunder_i_solver *solver, sunder_error *err)
{
    if (!any_large_crowd(solver)) return SUNDER_OK;
    growth g = {.solver = solver,
                .placed = sunder_i_alloc(solver->model.bodies, sizeof *g.placed),
                .box = sunder_i_alloc(4 * solver->model.bodies, sizeof *g.box),
                .unabsorbable = sunder_i_alloc(solver->model.bodies, sizeof *g.unabsorbable)};
    sunder_status status = g.placed && g.box && g.unabsorbable ? SUNDER_OK : sunder_i_failure_cause(err);
    bool any = true;
    for (int k = 0; k < CROWDS_GROWN && any && !status; k++) status = grow_once(&g, &any, err);
    sunder_i_free_all(g.placed, g.box, g.unabsorbable, g.near.item);
    return status;
}
