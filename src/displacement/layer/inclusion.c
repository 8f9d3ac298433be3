/* What lies in another feature and may overlap it: how it is kept inside.
 *
 * Such a pair owes no gap, but if the holder's edge came to cut through the inner feature the two would be in conflict.
 * So the edges of the holder are walls to it: convex pieces without area, which it must not cross. As long as no wall
 * crosses it, it is where it was, inside. In the programs walls are constraints like all others; a pair that cannot be
 * kept in the end is let go (lapses), and is parted.
 *
 * Many inner features touch their holder's edge, and with a tolerance they may overstep it: what a wall asks of a pair
 * is never more than it had at the start. */
#include "displacement/layer/inclusion.h"

#include "shape/shape.h"

#include <math.h>
#include <stdlib.h>

size_t sunder_i_kept_at(const sunder_i_town *town, uint32_t f, uint32_t g)
{
    return sunder_i_couple_at(town->kept, town->kept_n, f, g);
}

bool sunder_i_is_kept(const sunder_i_town *town, uint32_t f, uint32_t g)
{
    const size_t at = sunder_i_kept_at(town, f, g);
    return at < town->kept_n && town->keeping[at] != SUNDER_I_LAPSED;
}

bool sunder_i_is_inner(const sunder_i_town *town, uint32_t inner, uint32_t holder)
{
    const size_t at = sunder_i_kept_at(town, holder, inner);
    if (at < town->kept_n) return town->a_in_b[at] == (inner < holder);
    const size_t lying = sunder_i_couple_at(town->lying, town->lying_n, holder, inner);
    return lying < town->lying_n && town->lying_a[lying] == (inner < holder);
}

bool sunder_i_holds(const sunder_i_town *town, uint32_t holder, uint32_t inner, sunder_i_keeping *keeping)
{
    const size_t at = sunder_i_kept_at(town, holder, inner);
    if (at == town->kept_n || town->keeping[at] == SUNDER_I_LAPSED || !sunder_i_is_inner(town, inner, holder))
        return false;
    *keeping = (sunder_i_keeping)town->keeping[at];
    return true;
}

sunder_status sunder_i_keep_init(sunder_i_town *town, const sunder_i_relations *relations, sunder_error *err)
{
    size_t kept = 0;
    for (size_t k = 0; k < relations->n; k++) kept += relations->pair[k].kept;
    town->kept = sunder_i_alloc(kept, sizeof *town->kept);
    town->a_in_b = sunder_i_alloc(kept, sizeof *town->a_in_b);
    town->enters = sunder_i_calloc(kept, sizeof *town->enters);
    town->keeping = sunder_i_calloc(kept, sizeof *town->keeping);
    if (!town->kept || !town->a_in_b || !town->enters || !town->keeping) return sunder_i_no_memory(err);
    for (size_t k = 0; k < relations->n; k++) {
        const sunder_i_relation *r = &relations->pair[k];
        if (!r->kept) continue;
        town->kept[town->kept_n] = (sunder_i_couple){r->a, r->b};
        town->a_in_b[town->kept_n++] = r->a_in_b;
    }
    return SUNDER_OK;
}

sunder_status sunder_i_keep_note(sunder_i_town *town, const sunder_i_relations *relations, sunder_error *err)
{
    size_t n = 0;
    for (size_t k = 0; k < relations->n; k++) n += relations->pair[k].contained;
    town->lying = sunder_i_alloc(n, sizeof *town->lying);
    town->lying_a = sunder_i_alloc(n, sizeof *town->lying_a);
    if (!town->lying || !town->lying_a) return sunder_i_no_memory(err);
    for (size_t k = 0; k < relations->n; k++) {
        const sunder_i_relation *r = &relations->pair[k];
        const uint32_t i = town->body_of[r->a], j = town->body_of[r->b];
        if (!r->contained || r->duplicate || r->kept || i == j) continue;
        if (!isfinite(sunder_i_limit_of(&town->body[i]) + sunder_i_limit_of(&town->body[j]))) continue;
        town->lying[town->lying_n] = (sunder_i_couple){r->a, r->b};
        town->lying_a[town->lying_n++] = r->a_in_b;
    }
    return SUNDER_OK;
}

sunder_status sunder_i_keep_add(sunder_i_town *town, uint32_t a, uint32_t b, bool a_in_b, sunder_error *err)
{
    const size_t n = town->kept_n, more = n + 1;
    sunder_i_couple *kept = sunder_i_realloc(town->kept, more, sizeof *kept);
    if (kept) town->kept = kept;
    bool *which = sunder_i_realloc(town->a_in_b, more, sizeof *which);
    if (which) town->a_in_b = which;
    bool *enters = sunder_i_realloc(town->enters, more, sizeof *enters);
    if (enters) town->enters = enters;
    unsigned char *keeping = sunder_i_realloc(town->keeping, more, sizeof *keeping);
    if (keeping) town->keeping = keeping;
    if (!kept || !which || !enters || !keeping) return sunder_i_no_memory(err);
    const sunder_i_couple pair = {a, b};
    size_t at = n;
    for (; at > 0 && sunder_i_by_couple(&kept[at - 1], &pair) > 0; at--) {
        kept[at] = kept[at - 1];
        which[at] = which[at - 1];
        enters[at] = enters[at - 1];
        keeping[at] = keeping[at - 1];
    }
    kept[at] = pair;
    which[at] = a_in_b;
    enters[at] = true;
    keeping[at] = SUNDER_I_STRICT;
    town->kept_n = more;
    return SUNDER_OK;
}

/* ---- Which holder ------------------------------------------------------------------------------------------------ */

static uint32_t holder_of(const sunder_i_town *town, size_t k)
{
    return town->a_in_b[k] ? town->kept[k].b : town->kept[k].a;
}

static uint32_t inner_of(const sunder_i_town *town, size_t k)
{
    return town->a_in_b[k] ? town->kept[k].a : town->kept[k].b;
}

/* The squared distance of the middle of feature f's box from the nearest edge of a feature that it lies in. */
static double depth_in(const sunder_i_town *town, uint32_t f, uint32_t holder)
{
    const sunder_shape *shape = town->layer->feature[holder].shape;
    const double *box = town->box + 4 * (size_t)f, x = (box[0] + box[2]) / 2, y = (box[1] + box[3]) / 2;
    double least = INFINITY;
    for (uint32_t v = 0; v < shape->vertices; v++) {
        const double *p = shape->xy + 2 * (size_t)v, *q = shape->xy + 2 * (size_t)shape->next[v];
        const double ex = q[0] - p[0], ey = q[1] - p[1], wx = x - p[0], wy = y - p[1];
        const double s = fmin(1, fmax(0, (wx * ex + wy * ey) / (ex * ex + ey * ey)));
        const double dx = wx - s * ex, dy = wy - s * ey;
        least = fmin(least, dx * dx + dy * dy);
    }
    return least;
}

sunder_status sunder_i_keep_choose(sunder_i_town *town, const sunder_i_relations *relations, const bool *conflict,
                                   sunder_error *err)
{
    /* Inner feature and number of the pair, sorted: what one feature lies in stands together. */
    sunder_i_couple *by_inner = sunder_i_alloc(town->kept_n, sizeof *by_inner);
    if (!by_inner) return sunder_i_no_memory(err);
    for (size_t k = 0; k < town->kept_n; k++) by_inner[k] = (sunder_i_couple){inner_of(town, k), (uint32_t)k};
    if (town->kept_n) qsort(by_inner, town->kept_n, sizeof *by_inner, sunder_i_by_couple);
    for (size_t k = 0; k < town->kept_n; k++)
        for (size_t m = k + 1; m < town->kept_n && by_inner[m].a == by_inner[k].a; m++) {
            const uint32_t f = by_inner[k].a, p = holder_of(town, by_inner[k].b), q = holder_of(town, by_inner[m].b);
            const sunder_i_relation *r = sunder_i_relations_find(relations, p < q ? p : q, p < q ? q : p);
            if (!r || !conflict[r - relations->pair]) continue;
            if (town->keeping[by_inner[k].b] == SUNDER_I_LAPSED || town->keeping[by_inner[m].b] == SUNDER_I_LAPSED)
                continue;
            const size_t loose = depth_in(town, f, p) <= depth_in(town, f, q) ? k : m;
            town->keeping[by_inner[loose].b] = SUNDER_I_LAPSED;
        }
    sunder_i_free(by_inner);
    return SUNDER_OK;
}

/* ---- Walls ------------------------------------------------------------------------------------------------------- */

static void add_walls(sunder_i_town *town, sunder_i_body *body, uint32_t f, double *corner, size_t *corners)
{
    const sunder_shape *shape = town->layer->feature[f].shape;
    for (uint32_t v = 0; v < shape->vertices; v++) {
        sunder_i_piece *wall = &town->wall[town->walls++];
        wall->feature = f;
        wall->corner = (uint32_t)*corners;
        wall->corners = 2;
        const uint32_t ends[2] = {v, shape->next[v]};
        for (int e = 0; e < 2; e++, ++*corners)
            for (size_t c = 0; c < 2; c++) corner[2 * *corners + c] = shape->xy[2 * ends[e] + c] - body->origin[c];
        const double *p = corner + 2 * (size_t)wall->corner;
        for (size_t c = 0; c < 2; c++) {
            wall->box[c] = fmin(p[c], p[c + 2]);
            wall->box[c + 2] = fmax(p[c], p[c + 2]);
        }
        body->walls++;
    }
}

sunder_status sunder_i_keep_walls(sunder_i_town *town, sunder_error *err)
{
    if (town->kept_n + town->lying_n == 0) return SUNDER_OK;
    bool *holds = sunder_i_calloc(town->features, sizeof *holds);
    if (!holds) return sunder_i_no_memory(err);
    size_t edges = 0;
    for (size_t k = 0; k < town->kept_n; k++) holds[holder_of(town, k)] = true;
    for (size_t k = 0; k < town->lying_n; k++) holds[town->lying_a[k] ? town->lying[k].b : town->lying[k].a] = true;
    for (size_t f = 0; f < town->features; f++)
        if (holds[f]) edges += town->layer->feature[f].shape->vertices;
    sunder_status status = SUNDER_OK;
    double *corner = NULL;
    /* Corners are numbered in 32 bits, and walls are told apart in the keys of constraints by 30. */
    if (!status && (town->corners + 2 * edges >= UINT32_MAX || edges >= UINT32_C(1) << 30))
        status = sunder_i_fail(err, SUNDER_ESIZE, "too many corners: %zu", town->corners + 2 * edges);
    if (!status) {
        corner = sunder_i_realloc(town->corner, 2 * (town->corners + 2 * edges), sizeof *corner);
        if (corner) town->corner = corner;
        town->wall = sunder_i_alloc(edges, sizeof *town->wall);
        if (!corner || !town->wall) status = sunder_i_no_memory(err);
    }
    for (size_t b = 0; !status && b < town->bodies; b++) {
        sunder_i_body *body = &town->body[b];
        body->wall = (uint32_t)town->walls;
        for (uint32_t m = 0; m < body->members; m++)
            if (holds[town->member[body->member + m]])
                add_walls(town, body, town->member[body->member + m], town->corner, &town->corners);
    }
    sunder_i_free(holds);
    return status;
}
