/* The outlines of blocks. Members of a block touch, overlap or gape by up to the touch tolerance, so an outline cannot
 * be read off their exact union: where walls gape, it would follow them into the block.
 *
 *     each edge of a member is divided where edges of other members begin to run along it, or cross it
 *     a part whose middle lies on another member's wall, or inside of another member, is an inner wall
 *     the other parts are sides, unless they are shorter than rounding, without a direction of their own
 *     each side is linked to the one that begins where it ends
 *     linked sides in one line become one side
 *
 * All of this is in doubles. It decides which shapes are offered and never whether these are valid, which is tested
 * exactly. Two members that share a wall are cut by zones of the same sides, so the wall stays shared. */
#include "displacement/levels/block_outline.h"

#include "displacement/levels/edges.h"

#include <math.h>
#include <string.h>

/* Numbers nearer than MARGIN of the largest coordinate count as equal. */
#define MARGIN 0x1p-45

/* Edges run along each other if the cosine between one and the reverse of the other is at least this. */
#define ALONG 0.7

/* Sides that turn by less than this, as a sine, may be in one line. */
#define STRAIGHT 0x1p-20

typedef struct edge {
    double from[2], to[2];
    uint32_t member; /* its number among the body's members */
} edge;

typedef struct finder {
    const sunder_i_model *model;
    const sunder_i_body *body;
    const sunder_shape *const *shape; /* by feature */
    edge *edge;                       /* those of all members */
    size_t edges, room;
    double *box; /* [4 * members] */
    sunder_i_rtree tree;
    sunder_i_list near;
    double *at; /* where an edge is divided, from 0 to 1 */
    size_t divisions, at_room;
    double tolerance;
} finder;

static double cross(const double a[2], const double b[2]) { return a[0] * b[1] - a[1] * b[0]; }
static double dot(const double a[2], const double b[2]) { return a[0] * b[0] + a[1] * b[1]; }

static void vector_of(const double from[2], const double to[2], double out[2])
{
    for (int c = 0; c < 2; c++) out[c] = to[c] - from[c];
}

/* The shape of member m of the body; NULL: none. */
static const sunder_shape *shape_of(const finder *f, uint32_t m)
{
    return f->shape[f->model->member[f->body->member + m]];
}

/* ---- Edges ------------------------------------------------------------------------------------------------------- */

static void edge_of(const sunder_shape *shape, uint32_t v, uint32_t member, edge *out)
{
    memcpy(out->from, shape->xy + 2 * (size_t)v, sizeof out->from);
    memcpy(out->to, shape->xy + 2 * (size_t)shape->form->cleaned.next[v], sizeof out->to);
    out->member = member;
}

static bool take_edges(finder *f)
{
    double *box = f->box;
    for (uint32_t m = 0; m < f->body->members; m++, box += 4) {
        const sunder_shape *shape = shape_of(f, m);
        box[0] = box[1] = INFINITY;
        box[2] = box[3] = -INFINITY;
        if (!shape || sunder_shape_is_empty(shape)) continue;
        sunder_shape_box(shape, box);
        if (!sunder_i_reserve(&f->edge, &f->room, f->edges + shape->vertices, sizeof *f->edge)) return false;
        for (uint32_t v = 0; v < shape->vertices; v++) edge_of(shape, v, m, &f->edge[f->edges++]);
    }
    return true;
}

static void box_of(const edge *e, double by, double box[4])
{
    for (int c = 0; c < 2; c++) {
        box[c] = sunder_i_min(e->from[c], e->to[c]) - by;
        box[c + 2] = sunder_i_max(e->from[c], e->to[c]) + by;
    }
}

static bool index_edges(finder *f, sunder_error *err, sunder_status *status)
{
    double *box = sunder_i_alloc(4 * f->edges, sizeof *box);
    if (!box) return false;
    for (size_t k = 0; k < f->edges; k++) box_of(&f->edge[k], f->tolerance, box + 4 * k);
    *status = sunder_i_rtree_build(box, NULL, f->edges, &f->tree, err);
    sunder_i_free(box);
    return !*status;
}

/* ---- Dividing an edge -------------------------------------------------------------------------------------------- */

static bool runs_along(const edge *e, const edge *other)
{
    double u[2], v[2];
    vector_of(e->from, e->to, u);
    vector_of(other->from, other->to, v);
    return -dot(u, v) >= ALONG * sqrt(dot(u, u) * dot(v, v));
}

static bool divide_at(finder *f, double t)
{
    if (!(t > 0 && t < 1)) return true;
    if (!sunder_i_reserve(&f->at, &f->at_room, f->divisions + 2, sizeof *f->at)) return false;
    f->at[f->divisions++] = t;
    return true;
}

/* Divides e where another edge that runs along it begins and ends, or where one crosses it. */
static bool divide_by(finder *f, const edge *e, const edge *other)
{
    double u[2], v[2], w[2], z[2];
    vector_of(e->from, e->to, u);
    vector_of(other->from, other->to, v);
    vector_of(e->from, other->from, w);
    vector_of(e->from, other->to, z);
    if (runs_along(e, other)) return divide_at(f, dot(w, u) / dot(u, u)) && divide_at(f, dot(z, u) / dot(u, u));
    const double turn = cross(u, v);
    if (turn == 0) return true;
    const double s = cross(w, u) / turn;
    return !(s >= 0 && s <= 1) || divide_at(f, cross(w, v) / turn);
}

/* The distance from p to an edge. *beside is whether the point of it that is nearest to p is not beyond one of its
 * ends. */
static double distance_to(const double p[2], const edge *e, bool *beside)
{
    double u[2], w[2];
    vector_of(e->from, e->to, u);
    vector_of(e->from, p, w);
    const double at = dot(w, u) / dot(u, u), t = sunder_i_max(0, sunder_i_min(1, at));
    *beside = at == t;
    return hypot(w[0] - t * u[0], w[1] - t * u[1]);
}

/* Is p inside of the shape, by the even-odd rule? */
static bool is_inside(const sunder_shape *shape, const double p[2])
{
    bool inside = false;
    for (uint32_t v = 0; v < shape->vertices; v++) {
        double e[4];
        sunder_i_edge_of(shape, v, e);
        inside ^= sunder_i_ray_crosses(p, e);
    }
    return inside;
}

/* Does p lie inside of another member than `own`, farther from its edges than the tolerance? */
static bool lies_inside(const finder *f, const double p[2], uint32_t own)
{
    for (uint32_t m = 0; m < f->body->members; m++) {
        const double *box = f->box + 4 * (size_t)m;
        if (m == own || !(p[0] > box[0] && p[0] < box[2] && p[1] > box[1] && p[1] < box[3]) ||
            !is_inside(shape_of(f, m), p))
            continue;
        bool near = false, beside;
        for (size_t k = 0; k < f->near.n && !near; k++) {
            const edge *e = &f->edge[f->near.item[k]];
            near = e->member == m && distance_to(p, e, &beside) <= f->tolerance;
        }
        if (!near) return true;
    }
    return false;
}

/* Is the middle of a part of edge e on an inner wall? f->near lists the edges near e. */
static bool is_inner(const finder *f, const edge *e, const double p[2])
{
    for (size_t k = 0; k < f->near.n; k++) {
        const edge *other = &f->edge[f->near.item[k]];
        bool beside;
        if (other->member != e->member && runs_along(e, other) && distance_to(p, other, &beside) <= f->tolerance &&
            beside)
            return true;
    }
    return lies_inside(f, p, e->member);
}

static void point_at(const edge *e, double t, double out[2])
{
    for (int c = 0; c < 2; c++) out[c] = t >= 1 ? e->to[c] : e->from[c] + t * (e->to[c] - e->from[c]);
}

static sunder_i_block_side *add_side(sunder_i_block_outline *out)
{
    if (!sunder_i_reserve(&out->side, &out->room, out->n + 1, sizeof *out->side)) return NULL;
    out->side[out->n] = (sunder_i_block_side){.next = SUNDER_I_NO_SIDE, .last = SUNDER_I_NO_SIDE};
    return &out->side[out->n++];
}

static int by_value(const void *a, const void *b)
{
    const double p = *(const double *)a, q = *(const double *)b;
    return p < q ? -1 : p > q;
}

/* Adds the parts of an edge that are no inner walls. Parts that follow each other are one side. */
static bool add_parts(finder *f, const edge *e, sunder_i_block_outline *out)
{
    double box[4], middle[2], t = 0;
    bool ok = true, goes_on = false;
    box_of(e, f->tolerance, box);
    f->near.n = f->divisions = 0;
    if (!sunder_i_rtree_query(&f->tree, box, &f->near)) return false;
    for (size_t k = 0; k < f->near.n && ok; k++) {
        const edge *other = &f->edge[f->near.item[k]];
        if (other->member != e->member) ok = divide_by(f, e, other);
    }
    if (!ok || !sunder_i_reserve(&f->at, &f->at_room, f->divisions + 1, sizeof *f->at)) return false;
    f->at[f->divisions++] = 1;
    qsort(f->at, f->divisions, sizeof *f->at, by_value);
    for (size_t k = 0; k < f->divisions; t = f->at[k++]) {
        if (f->at[k] == t) continue;
        point_at(e, (t + f->at[k]) / 2, middle);
        if (is_inner(f, e, middle)) {
            goes_on = false;
            continue;
        }
        sunder_i_block_side *side = goes_on ? &out->side[out->n - 1] : add_side(out);
        if (!side) return false;
        if (!goes_on) point_at(e, t, side->from);
        point_at(e, f->at[k], side->to);
        goes_on = true;
    }
    return true;
}

static void drop_short_sides(sunder_i_block_outline *out)
{
    uint32_t n = 0;
    for (uint32_t k = 0; k < out->n; k++) {
        const sunder_i_block_side *side = &out->side[k];
        if (hypot(side->to[0] - side->from[0], side->to[1] - side->from[1]) > out->margin) out->side[n++] = *side;
    }
    out->n = n;
}

/* ---- Links ------------------------------------------------------------------------------------------------------- */

/* Links each side to the one that begins nearest to its end, within the tolerance; the first of several. */
static bool link_sides(const finder *f, sunder_i_block_outline *out, sunder_error *err, sunder_status *status)
{
    sunder_i_rtree tree = {0};
    sunder_i_list hits = {0};
    double *box = sunder_i_alloc(4 * out->n, sizeof *box);
    if (!box) return false;
    for (size_t k = 0; k < out->n; k++) {
        const edge start = {.from = {out->side[k].from[0], out->side[k].from[1]},
                            .to = {out->side[k].from[0], out->side[k].from[1]}};
        box_of(&start, f->tolerance, box + 4 * k);
    }
    *status = sunder_i_rtree_build(box, NULL, out->n, &tree, err);
    bool ok = !*status;
    for (uint32_t k = 0; k < out->n && ok; k++) {
        sunder_i_block_side *side = &out->side[k];
        const double at[4] = {side->to[0], side->to[1], side->to[0], side->to[1]};
        double best = f->tolerance;
        hits.n = 0;
        ok = sunder_i_rtree_query(&tree, at, &hits);
        if (ok && hits.n) qsort(hits.item, hits.n, sizeof *hits.item, sunder_i_by_number);
        for (size_t i = 0; i < hits.n; i++) {
            const sunder_i_block_side *next = &out->side[hits.item[i]];
            const double off = hypot(next->from[0] - at[0], next->from[1] - at[1]);
            if (hits.item[i] == k || next->last != SUNDER_I_NO_SIDE || off > best ||
                (off == best && side->next != SUNDER_I_NO_SIDE))
                continue;
            best = off;
            side->next = hits.item[i];
        }
        if (side->next != SUNDER_I_NO_SIDE) out->side[side->next].last = k;
    }
    sunder_i_rtree_free(&tree);
    sunder_i_free_all(hits.item, box);
    return ok;
}

/* Do the side and the one after it lie in one line? */
static bool goes_straight_on(const sunder_i_block_outline *out, const sunder_i_block_side *side)
{
    const sunder_i_block_side *next = &out->side[side->next];
    double u[2], v[2], w[2];
    vector_of(side->from, side->to, u);
    vector_of(next->from, next->to, v);
    vector_of(side->from, next->to, w);
    return hypot(next->from[0] - side->to[0], next->from[1] - side->to[1]) <= out->margin && dot(u, v) > 0 &&
           fabs(cross(u, v)) <= STRAIGHT * dot(u, v) && fabs(cross(u, w)) <= out->margin * hypot(w[0], w[1]);
}

/* Joins linked sides in one line, and drops those that were joined to others. */
static bool join_straight(sunder_i_block_outline *out)
{
    uint32_t *now = sunder_i_alloc(out->n, sizeof *now);
    uint32_t n = 0;
    if (!now) return false;
    for (uint32_t k = 0; k < out->n; k++) now[k] = 0;
    for (uint32_t k = 0; k < out->n; k++) {
        sunder_i_block_side *side = &out->side[k];
        while (now[k] != SUNDER_I_NO_SIDE && side->next != SUNDER_I_NO_SIDE && side->next != k &&
               goes_straight_on(out, side)) {
            const uint32_t gone = side->next;
            memcpy(side->to, out->side[gone].to, sizeof side->to);
            now[gone] = SUNDER_I_NO_SIDE;
            side->next = out->side[gone].next;
            if (side->next != SUNDER_I_NO_SIDE) out->side[side->next].last = k;
        }
    }
    for (uint32_t k = 0; k < out->n; k++)
        if (now[k] != SUNDER_I_NO_SIDE) {
            out->side[n] = out->side[k];
            now[k] = n++;
        }
    out->n = n;
    for (uint32_t k = 0; k < n; k++) {
        sunder_i_block_side *side = &out->side[k];
        if (side->next != SUNDER_I_NO_SIDE) side->next = now[side->next];
        if (side->last != SUNDER_I_NO_SIDE) side->last = now[side->last];
    }
    sunder_i_free(now);
    return true;
}

/* ---- One body ---------------------------------------------------------------------------------------------------- */

/* The sides of a body of one member: its edges. */
static bool add_edges(const sunder_shape *shape, sunder_i_block_outline *out)
{
    for (uint32_t v = 0; v < shape->vertices; v++) {
        sunder_i_block_side *side = add_side(out);
        edge e;
        if (!side) return false;
        edge_of(shape, v, 0, &e);
        memcpy(side->from, e.from, sizeof side->from);
        memcpy(side->to, e.to, sizeof side->to);
        side->next = shape->form->cleaned.next[v];
        side->last = shape->form->cleaned.prev[v];
    }
    return true;
}

static bool find_among_members(finder *f, sunder_i_block_outline *out, sunder_error *err, sunder_status *status)
{
    f->box = sunder_i_alloc(4 * (size_t)f->body->members, sizeof *f->box);
    if (!f->box || !take_edges(f) || !index_edges(f, err, status)) return false;
    for (uint32_t m = 0; m < f->body->members; m++) {
        const sunder_shape *own = shape_of(f, m);
        for (uint32_t v = 0; own && v < own->vertices; v++) {
            edge e;
            edge_of(own, v, m, &e);
            if (!add_parts(f, &e, out)) return false;
        }
    }
    drop_short_sides(out);
    return link_sides(f, out, err, status) && join_straight(out);
}

sunder_status sunder_i_block_outline_find(const sunder_i_model *model, const sunder_i_body *body,
                                          const sunder_shape *const *shape, sunder_i_block_outline *out,
                                          sunder_error *err)
{
    finder f = {.model = model, .body = body, .shape = shape};
    sunder_status status = SUNDER_OK;
    double most = 0;
    out->n = 0;
    for (uint32_t m = 0; m < body->members; m++) {
        const sunder_shape *one = shape_of(&f, m);
        for (int c = 0; one && c < 4; c++) most = sunder_i_max(most, fabs(one->box[c]));
    }
    out->margin = most * MARGIN;
    f.tolerance = sunder_i_max(model->rules.tolerance, 2 * out->margin);
    const sunder_shape *first = shape_of(&f, 0);
    const bool ok = body->members > 1 ? find_among_members(&f, out, err, &status) : !first || add_edges(first, out);
    sunder_i_rtree_free(&f.tree);
    sunder_i_free_all(f.edge, f.box, f.near.item, f.at);
    return ok ? SUNDER_OK : status ? status : sunder_i_failure_cause(err);
}

void sunder_i_block_outline_free(sunder_i_block_outline *outline)
{
    sunder_i_free(outline->side);
    *outline = (sunder_i_block_outline){0};
}
