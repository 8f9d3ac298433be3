/* Keeps a feature inside another one that it lies in and may overlap.
 *
 * Such a pair does not have to keep a gap, but if an edge of the holder cut through the inner feature the two would be
 * in conflict. So the edges of the holder are walls for the inner feature: convex pieces without area that it must not
 * cross. It lies inside at the start, and remains inside as long as no wall crosses it. In the quadratic programs walls
 * are constraints like all others. If an inner feature cannot be kept inside, its inclusion lapses and the pair is
 * separated.
 *
 * Many inner features touch the edge of their holder, and with a tolerance they may overstep it. So a wall never
 * demands more of a pair than held at the start. */
#include "displacement/layer/far_corners.h"

#include "base/extremes.h"
#include "base/invariant.h"
#include "shape/shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static sunder_i_inclusion *find_inclusion(sunder_i_inclusion *list, size_t n, uint32_t f, uint32_t g)
{
    const sunder_i_inclusion key = {.a = f < g ? f : g, .b = f < g ? g : f};
    return n ? bsearch(&key, list, n, sizeof key, sunder_i_by_id_pair) : NULL;
}

sunder_i_inclusion *sunder_i_inclusion_find(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    return find_inclusion(model->inclusion, model->inclusions, f, g);
}

bool sunder_i_is_included(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    const sunder_i_inclusion *pair = sunder_i_inclusion_find(model, f, g);
    return pair && pair->state != SUNDER_I_LAPSED;
}

bool sunder_i_is_inner(const sunder_i_model *model, uint32_t inner, uint32_t holder)
{
    const sunder_i_inclusion *pair = sunder_i_inclusion_find(model, holder, inner);
    if (!pair) pair = find_inclusion(model->nested, model->nested_n, holder, inner);
    return pair && pair->a_inside == (inner < holder);
}

bool sunder_i_keeps_inside(const sunder_i_model *model, uint32_t holder, uint32_t inner,
                           sunder_i_inclusion_state *state)
{
    const sunder_i_inclusion *pair = sunder_i_inclusion_find(model, holder, inner);
    if (!pair || pair->state == SUNDER_I_LAPSED || pair->a_inside != (inner < holder)) return false;
    *state = pair->state;
    return true;
}

sunder_status sunder_i_inclusions_init(sunder_i_model *model, const sunder_i_relations *relations, sunder_error *err)
{
    size_t n = 0;
    for (size_t k = 0; k < relations->n; k++) n += relations->pair[k].kept;
    model->inclusion = sunder_i_alloc(n, sizeof *model->inclusion);
    if (!model->inclusion) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < relations->n; k++) {
        const sunder_i_relation *r = &relations->pair[k];
        if (r->kept) model->inclusion[model->inclusions++] = (sunder_i_inclusion){r->a, r->b, .a_inside = r->a_in_b};
    }
    return SUNDER_OK;
}

sunder_status sunder_i_inclusions_note_nested(sunder_i_model *model, const sunder_i_relations *relations,
                                              sunder_error *err)
{
    size_t n = 0;
    for (size_t k = 0; k < relations->n; k++) n += relations->pair[k].contained;
    model->nested = sunder_i_alloc(n, sizeof *model->nested);
    if (!model->nested) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < relations->n; k++) {
        const sunder_i_relation *r = &relations->pair[k];
        const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
        if (!r->contained || r->duplicate || r->kept || i == j) continue;
        if (!isfinite(sunder_i_limit_of(&model->body[i]) + sunder_i_limit_of(&model->body[j]))) continue;
        model->nested[model->nested_n++] = (sunder_i_inclusion){r->a, r->b, .a_inside = r->a_in_b};
    }
    return SUNDER_OK;
}

sunder_status sunder_i_inclusions_add(sunder_i_model *model, uint32_t a, uint32_t b, bool a_inside, sunder_error *err)
{
    const sunder_i_inclusion pair = {a, b, a_inside, true, SUNDER_I_STRICT};
    size_t at = model->inclusions;
    sunder_i_inclusion *list = sunder_i_realloc(model->inclusion, at + 1, sizeof *list);
    if (!list) return sunder_i_failure_cause(err);
    for (; at > 0 && sunder_i_by_id_pair(&list[at - 1], &pair) > 0; at--) list[at] = list[at - 1];
    list[at] = pair;
    SUNDER_I_ASSERT(a < b && (at == 0 || sunder_i_by_id_pair(&list[at - 1], &pair) < 0));
    model->inclusion = list;
    model->inclusions++;
    return SUNDER_OK;
}

/* ---- Which of two holders ---------------------------------------------------------------------------------------- */

static uint32_t holder_of(const sunder_i_inclusion *pair) { return pair->a_inside ? pair->b : pair->a; }

static uint32_t inner_of(const sunder_i_inclusion *pair) { return pair->a_inside ? pair->a : pair->b; }

/* Returns the squared distance from the middle of feature f's box to the nearest edge of `holder`, in which f lies. */
static double depth_in(const sunder_i_model *model, uint32_t f, uint32_t holder)
{
    const sunder_shape *shape = sunder_i_thing_shape(model, holder);
    const double *box = sunder_i_home_box(model, f), x = (box[0] + box[2]) / 2, y = (box[1] + box[3]) / 2;
    double least = INFINITY;
    for (uint32_t v = 0; v < shape->vertices; v++) {
        const double *p = shape->xy + 2 * (size_t)v, *q = shape->xy + 2 * (size_t)shape->form->cleaned.next[v];
        const double ex = q[0] - p[0], ey = q[1] - p[1], wx = x - p[0], wy = y - p[1];
        const double s = sunder_i_min(1, sunder_i_max(0, (wx * ex + wy * ey) / (ex * ex + ey * ey)));
        const double dx = wx - s * ex, dy = wy - s * ey;
        least = sunder_i_min(least, dx * dx + dy * dy);
    }
    return least;
}

sunder_status sunder_i_inclusions_choose(sunder_i_model *model, const sunder_i_relations *relations,
                                         const bool *conflict, sunder_error *err)
{
    const size_t n = model->inclusions;
    /* Pairs (inner feature, number of the inclusion), sorted, so that the holders of one feature are consecutive. */
    sunder_i_id_pair *by_inner = sunder_i_alloc(n, sizeof *by_inner);
    if (!by_inner) return sunder_i_failure_cause(err);
    for (uint32_t k = 0; k < n; k++) by_inner[k] = (sunder_i_id_pair){inner_of(&model->inclusion[k]), k};
    if (n) qsort(by_inner, n, sizeof *by_inner, sunder_i_by_id_pair);
    for (size_t k = 0; k < n; k++)
        for (size_t m = k + 1; m < n && by_inner[m].a == by_inner[k].a; m++) {
            sunder_i_inclusion *one = &model->inclusion[by_inner[k].b], *other = &model->inclusion[by_inner[m].b];
            const uint32_t f = by_inner[k].a, p = holder_of(one), q = holder_of(other);
            const sunder_i_relation *r = sunder_i_relations_find(relations, p < q ? p : q, p < q ? q : p);
            if (!r || !conflict[r - relations->pair]) continue;
            if (one->state == SUNDER_I_LAPSED || other->state == SUNDER_I_LAPSED) continue;
            (depth_in(model, f, p) <= depth_in(model, f, q) ? one : other)->state = SUNDER_I_LAPSED;
        }
    sunder_i_free(by_inner);
    return SUNDER_OK;
}

/* ---- Walls ------------------------------------------------------------------------------------------------------- */

static void add_walls(sunder_i_model *model, const sunder_i_body *body, uint32_t f)
{
    const sunder_shape *shape = sunder_i_thing_shape(model, f);
    for (uint32_t v = 0; v < shape->vertices; v++) {
        double *p = model->wall_corner + 4 * model->walls;
        sunder_i_body_piece *wall = &model->wall[model->walls++];
        wall->feature = f;
        wall->corner = p;
        wall->corners = 2;
        const uint32_t ends[2] = {v, shape->form->cleaned.next[v]};
        for (size_t e = 0; e < 2; e++) memcpy(p + 2 * e, shape->xy + 2 * (size_t)ends[e], 2 * sizeof *p);
        sunder_i_reckon_from_origin(body, p, 2);
        for (size_t c = 0; c < 2; c++) {
            wall->box[c] = sunder_i_min(p[c], p[c + 2]);
            wall->box[c + 2] = sunder_i_max(p[c], p[c + 2]);
        }
    }
}

sunder_status sunder_i_inclusion_walls(sunder_i_model *model, sunder_error *err)
{
    if (model->inclusions + model->nested_n == 0) return SUNDER_OK;
    bool *holds = sunder_i_calloc(model->features, sizeof *holds);
    if (!holds) return sunder_i_failure_cause(err);
    size_t edges = 0;
    for (size_t k = 0; k < model->inclusions; k++) holds[holder_of(&model->inclusion[k])] = true;
    for (size_t k = 0; k < model->nested_n; k++) holds[holder_of(&model->nested[k])] = true;
    for (size_t f = 0; f < model->features; f++)
        if (holds[f]) edges += sunder_i_thing_shape(model, f)->vertices;
    sunder_status status = SUNDER_OK;
    /* A key of a constraint has 30 bits for the number of the wall. */
    if (edges >= UINT32_C(1) << 30) status = sunder_i_fail(err, SUNDER_ESIZE, "too many corners: %zu", edges);
    if (!status) {
        model->wall = sunder_i_alloc(edges, sizeof *model->wall);
        model->wall_corner = sunder_i_alloc(4 * edges, sizeof *model->wall_corner);
        if (!model->wall || !model->wall_corner) status = sunder_i_failure_cause(err);
    }
    for (size_t b = 0; !status && b < model->bodies; b++) {
        sunder_i_body *body = &model->body[b];
        const size_t first = model->walls;
        for (uint32_t m = 0; m < body->members; m++)
            if (model->member[body->member + m] < model->features && holds[model->member[body->member + m]])
                add_walls(model, body, model->member[body->member + m]);
        if (model->walls == first) continue;
        sunder_i_extras *extras = sunder_i_own_extras(model, body);
        if (extras) {
            extras->wall = (uint32_t)first;
            extras->walls = (uint32_t)(model->walls - first);
        } else {
            status = sunder_i_failure_cause(err);
        }
    }
    sunder_i_free(holds);
    return status;
}
