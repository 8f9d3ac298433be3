/* Eased pairs of a tree: what they lack, and cuts by prices.
 *
 * A pair with the relative move u lacks s(u): the greatest, over its priced pieces, of the radius less the distance of
 * u from K, which is negative inside K; at least 0. Above the plane of u, each priced piece is the set of all (u, s)
 * for which distance and s add up to less than the radius: a convex set, since the distance is a convex function. A
 * piece that forbids u is a cylinder. So the points (u, s) that a pair may take are the complement of a union of convex
 * sets, and the cuts of a plain pair work here, too: a half-space n.u + share s >= d is a cut for a region of moves if
 * the part of the region below it is covered (covered_region.c).
 *
 * A cut is proposed by the lower hull of points (u, s(u)): where the region's sides leave the pieces, corners of the
 * region, reflex corners, and further places that earlier proposals had missed. */
#include "displacement/prove/optimum/body_contact.h"
#include "displacement/prove/optimum/tree.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/extremes.h"

#include <math.h>
#include <string.h>

/* ---- The pairs --------------------------------------------------------------------------------------------------- */

/* Sets `near` to body j. If body j is a part of a barrier, sets it to all parts of that barrier that body i may come
 * near. */
static bool find_parts(const sunder_i_tree *t, uint32_t i, uint32_t j, double reach, sunder_i_list *near)
{
    const sunder_i_model *model = t->task.model;
    const sunder_i_body *p = &model->body[t->body[i]], *q = &model->body[t->body[j]];
    const double home[2] = {0, 0};
    near->n = 0;
    if (!sunder_i_is_barrier_body(model, q)) return sunder_i_list_push(near, t->body[j]);
    if (!sunder_i_bodies_about(model, (uint32_t)(p - model->body), home, reach + model->rules.full_gap, near))
        return false;
    const uint32_t whole = sunder_i_whole_of(model, model->member[q->member]);
    size_t out = 0;
    for (size_t k = 0; k < near->n; k++) {
        const sunder_i_body *b = &model->body[near->item[k]];
        if (sunder_i_is_barrier_body(model, b) && sunder_i_whole_of(model, model->member[b->member]) == whole)
            near->item[out++] = near->item[k];
    }
    near->n = out;
    return true;
}

static double lacking(const sunder_i_tree_eased *e, const double u[2])
{
    double most = 0;
    for (size_t k = 0; k < e->pieces.pieces; k++) {
        const sunder_i_forbidden_piece *p = &e->pieces.piece[k];
        if (!p->priced || u[0] <= p->box[0] || u[0] >= p->box[2] || u[1] <= p->box[1] || u[1] >= p->box[3]) continue;
        const double lacks = p->radius - sunder_i_forbidden_distance(&e->pieces, p, u);
        if (lacks > most) most = lacks;
    }
    return most;
}

static bool is_forbidden(const sunder_i_tree_eased *e, const double u[2])
{
    size_t guess = SIZE_MAX;
    return e->hard.pieces && sunder_i_forbidden_is_deeper(&e->hard, u, FREE_HAIR * e->hard.size, &guess);
}

static void add_place(sunder_i_tree *t, sunder_i_tree_eased *e, const double u[2])
{
    t->steps += e->pieces.pieces;
    if (is_forbidden(e, u)) return;
    if (!sunder_i_reserve(&e->place, &e->capacity, e->places + 1, sizeof *e->place)) {
        t->failed = true;
        return;
    }
    memcpy(e->place[e->places], u, 2 * sizeof *u);
    e->place[e->places++][2] = lacking(e, u);
}

static void init_eased(sunder_i_tree *t, uint32_t number)
{
    const sunder_i_task_price *price = &t->task.price[number];
    const sunder_i_model *model = t->task.model;
    sunder_i_tree_eased *e = &t->eased[number];
    sunder_i_list parts = {0};
    const sunder_i_tree_pair *p = sunder_i_tree_find_pair(t, price->i, price->j);
    if (!p) return;
    e->pair = (uint32_t)(p - t->pair);
    const double far = fabs(p->centre[0]) + fabs(p->centre[1]) + 2 * p->reach + price->deep;
    const uint32_t i = t->body[price->i], j = t->body[price->j];
    bool ok = find_parts(t, price->i, price->j, p->reach, &parts) &&
              sunder_i_forbidden_priced(&e->pieces, model, t->task.waived, i, parts.item, parts.n, far, true) &&
              sunder_i_forbidden_priced(&e->hard, model, t->task.waived, i, parts.item, parts.n, far, false);
    for (size_t k = 0; k < t->task.joins && ok; k++)
        if (t->task.joined[k].price == number)
            ok = sunder_i_forbidden_add_joined(&e->pieces, model, &t->task.joined[k]);
    ok = ok && sunder_i_forbidden_index(&e->pieces) && sunder_i_forbidden_index(&e->hard);
    sunder_i_free(parts.item);
    t->steps += 8 * (e->pieces.edges + e->hard.edges);
    t->pair_steps += 8 * (e->pieces.edges + e->hard.edges);
    if (!ok) {
        t->failed = true;
        return;
    }
    const double *from = model->move + 2 * (size_t)i, *to = model->move + 2 * (size_t)j,
                 u[2] = {to[0] - from[0], to[1] - from[1]};
    add_place(t, e, u);
}

void sunder_i_tree_add_eased(sunder_i_tree *tree)
{
    const size_t n = tree->task.prices;
    tree->eased = sunder_i_calloc(n, sizeof *tree->eased);
    tree->price = sunder_i_alloc(n, sizeof *tree->price);
    if (!tree->eased || !tree->price ||
        !sunder_i_reserve(&tree->cut, &tree->cut_capacity, tree->cuts + 2 * n, sizeof *tree->cut) ||
        !sunder_i_reserve(&tree->note, &tree->note_capacity, tree->cuts + 2 * n, sizeof *tree->note)) {
        tree->failed = true;
        return;
    }
    tree->program.cut = tree->cut;
    tree->program.price = tree->price;
    for (uint32_t k = 0; k < n; k++) {
        tree->price[k] = tree->task.price[k].price;
        for (int e = 0; e < 2; e++) {
            const sunder_i_move_cut cut = {.i = SUNDER_I_GROUND,
                                           .j = SUNDER_I_GROUND,
                                           .d = e ? -tree->task.price[k].most : 0,
                                           .eased = k,
                                           .share = e ? -1 : 1};
            tree->cut[tree->cuts] = cut;
            tree->note[tree->cuts++] = (sunder_i_cut_note){.kind = SUNDER_I_CUT_LACK, .pair = k};
        }
    }
    for (uint32_t k = 0; k < n && !tree->failed; k++) init_eased(tree, k);
}

void sunder_i_tree_free_eased(sunder_i_tree *tree)
{
    for (size_t k = 0; tree->eased && k < tree->task.prices; k++) {
        sunder_i_tree_eased *e = &tree->eased[k];
        sunder_i_forbidden_free(&e->pieces);
        sunder_i_forbidden_free(&e->hard);
        sunder_i_free_all(e->reflex[0].place, e->reflex[1].place, e->sides[0].place, e->sides[1].place, e->place);
    }
}

void sunder_i_tree_find_lacking(sunder_i_tree *tree)
{
    const double *at = tree->program.t;
    for (uint32_t k = 0; k < tree->task.prices; k++) {
        const sunder_i_tree_eased *e = &tree->eased[k];
        const sunder_i_tree_pair *p = &tree->pair[e->pair];
        const double u[2] = {at[2 * p->j] - at[2 * p->i], at[2 * p->j + 1] - at[2 * p->i + 1]};
        const double depth = lacking(e, u) - sunder_i_max(0, tree->program.lacks[k]);
        tree->steps += e->pieces.pieces;
        if (depth <= IN_CONFLICT * e->pieces.size) continue;
        if (!sunder_i_reserve(&tree->conflict, &tree->conflict_capacity, tree->conflicts + 1, sizeof *tree->conflict)) {
            tree->failed = true;
            return;
        }
        tree->conflict[tree->conflicts++] = (sunder_i_tree_conflict){e->pair, k, depth, {u[0], u[1]}};
    }
}

/* Has an earlier piece the same two things? */
static bool is_again(const sunder_i_model *model, const sunder_i_forbidden *f, size_t k)
{
    const uint32_t a = sunder_i_whole_of(model, f->piece[k].a->feature),
                   b = sunder_i_whole_of(model, f->piece[k].b->feature);
    for (size_t m = 0; m < k; m++)
        if (f->piece[m].priced && !f->piece[m].row && sunder_i_whole_of(model, f->piece[m].a->feature) == a &&
            sunder_i_whole_of(model, f->piece[m].b->feature) == b)
            return true;
    return false;
}

bool sunder_i_tree_join_pieces(sunder_i_tree *tree, bool now, sunder_i_joined **list, size_t *n, size_t *capacity)
{
    const sunder_i_model *model = tree->task.model;
    for (uint32_t k = 0; k < tree->task.prices; k++) {
        const sunder_i_forbidden *f = &tree->eased[k].pieces;
        const sunder_i_tree_pair *p = &tree->pair[tree->eased[k].pair];
        const double *to = now ? model->move + 2 * (size_t)tree->body[p->j] : tree->program.t + 2 * p->j,
                     *from = now ? model->move + 2 * (size_t)tree->body[p->i] : tree->program.t + 2 * p->i;
        const double u[2] = {to[0] - from[0], to[1] - from[1]},
                     lacks = sunder_i_max(lacking(&tree->eased[k], u), now ? 0 : tree->program.lacks[k]);
        for (size_t m = 0; m < f->pieces; m++) {
            if (!f->piece[m].priced || f->piece[m].row || is_again(model, f, m)) continue;
            const double more = lacks - f->piece[m].radius;
            bool any;
            if (!sunder_i_reserve(list, capacity, *n + 1, sizeof **list)) return false;
            sunder_i_joined *joined = *list + *n;
            if (!sunder_i_join_pieces(model, f, sunder_i_whole_of(model, f->piece[m].a->feature),
                                      sunder_i_whole_of(model, f->piece[m].b->feature), u,
                                      sunder_i_max(0, more) + DEEPER * f->size, joined, &any, &tree->steps))
                return false;
            joined->price = k;
            *n += any;
        }
    }
    return true;
}

/* ---- The lower hull ---------------------------------------------------------------------------------------------- */

/* The points (u, s) of an eased pair in a region. */
typedef struct gathered {
    double (*at)[3];
    size_t n;
} gathered;

static bool is_in_region(const sunder_i_region *r, const double u[2], double hair)
{
    for (uint32_t k = 0; k < r->n; k++) {
        const double *p = r->xy + 2 * k, *q = r->xy + 2 * (k + 1 < r->n ? k + 1 : 0);
        const double ex = q[0] - p[0], ey = q[1] - p[1];
        if ((u[0] - p[0]) * ey - (u[1] - p[1]) * ex > hair * (fabs(ex) + fabs(ey))) return false;
    }
    return true;
}

static void gather(gathered *g, size_t most, const double u[2], double s)
{
    if (g->n == most) return;
    memcpy(g->at[g->n], u, 2 * sizeof *u);
    g->at[g->n++][2] = s;
}

/* Gathers the points of a region: places where the pair lacks nothing, and places where it lacks most. */
static bool gather_points(sunder_i_tree *t, sunder_i_tree_eased *e, const sunder_i_region *region, bool own,
                          double (*at)[3], size_t most, size_t *n)
{
    gathered g = {at, 0};
    const sunder_i_forbidden *of[2] = {&e->pieces, &e->hard};
    for (int k = 0; k < 2 && !e->has_reflex; k++)
        if (!sunder_i_forbidden_is_many(of[k]) && !sunder_i_reflex_find(&e->reflex[k], of[k], &t->steps)) return false;
    e->has_reflex = true;
    for (int k = 0; k < 2; k++) {
        const double hair = FREE_HAIR * of[k]->size;
        sunder_i_free_sides *sides = own ? &e->sides[k] : &t->tried;
        if (!own) sides->any = false;
        if (!sunder_i_free_sides_find(sides, &e->sides[k], region, of[k], &t->steps)) return false;
        for (size_t m = 0; m < sides->n; m++) gather(&g, most, sides->place[m], k ? lacking(e, sides->place[m]) : 0);
        for (size_t m = 0; m < e->reflex[k].n; m++)
            if (is_in_region(region, e->reflex[k].place[m], hair))
                gather(&g, most, e->reflex[k].place[m], k ? lacking(e, e->reflex[k].place[m]) : 0);
        t->steps += (k ? e->pieces.pieces : 1) * (sides->n + e->reflex[k].n);
    }
    for (size_t m = e->places; m-- > 0;)
        if (is_in_region(region, e->place[m], FREE_HAIR * e->pieces.size))
            gather(&g, most, e->place[m], e->place[m][2]);
    *n = g.n;
    return true;
}

/* A facet of the lower hull of points with a place and a height: three corners, and the barycentric coordinates of u in
 * the triangle of their places. */
typedef struct facet {
    double at[3][3], share[3];
    bool far[3]; /* the corner is not a point, but one of the large triangle with which the search begins */
} facet;

/* Sets x to the barycentric coordinates of u in the triangle of the facet. Returns false if that has no area. */
static bool shares_of(const facet *f, const double u[2], double x[3])
{
    const double *a = f->at[0], *b = f->at[1], *c = f->at[2];
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    x[1] = ((u[0] - a[0]) * (c[1] - a[1]) - (u[1] - a[1]) * (c[0] - a[0])) / area;
    x[2] = ((b[0] - a[0]) * (u[1] - a[1]) - (b[1] - a[1]) * (u[0] - a[0])) / area;
    x[0] = 1 - x[1] - x[2];
    return area != 0 && isfinite(x[1] + x[2]);
}

/* Sets g to the gradient of the plane through the corners, *height to its height at 0. False as for shares_of(). */
static bool plane_of(const facet *f, double g[2], double *height)
{
    const double *a = f->at[0], *b = f->at[1], *c = f->at[2];
    const double bx = b[0] - a[0], by = b[1] - a[1], bs = b[2] - a[2], cx = c[0] - a[0], cy = c[1] - a[1],
                 cs = c[2] - a[2], area = bx * cy - by * cx;
    g[0] = (bs * cy - cs * by) / area;
    g[1] = (bx * cs - cx * bs) / area;
    *height = a[2] - g[0] * a[0] - g[1] * a[1];
    return area != 0 && isfinite(g[0] + g[1] + *height);
}

/* Makes the point a corner in place of one of the three, so that u stays in the triangle: the one whose share becomes
 * zero first as the share of the point grows. Returns false if there is none. */
static bool exchange(facet *f, const double point[3])
{
    double x[3], least = INFINITY;
    int leaves = -1;
    if (!shares_of(f, point, x)) return false;
    for (int k = 0; k < 3; k++) {
        if (!(x[k] > 1e-12) || !(f->share[k] / x[k] < least)) continue;
        least = f->share[k] / x[k];
        leaves = k;
    }
    if (leaves < 0) return false;
    for (int k = 0; k < 3; k++) f->share[k] = sunder_i_max(0, f->share[k] - least * x[k]);
    f->share[leaves] = least;
    memcpy(f->at[leaves], point, sizeof f->at[leaves]);
    f->far[leaves] = false;
    return true;
}

/* Exchanges corners until no point is below the plane of the facet; a corner that is not a point has the height `far`.
 * Returns false if such a corner keeps a share, since u is then outside the convex hull of the places. */
static bool lower_facet(facet *f, double (*at)[3], size_t n, double size, double far, double g[2], double *height,
                        uint64_t *steps)
{
    for (int k = 0; k < 3; k++)
        if (f->far[k]) f->at[k][2] = far;
    for (size_t round = 0; round < MOST_EXCHANGED; round++) {
        if (!plane_of(f, g, height)) return false;
        size_t lowest = n;
        double least = -HULL_HAIR * size * (1 + fabs(g[0]) + fabs(g[1]));
        for (size_t k = 0; k < n; k++) {
            const double above = at[k][2] - (*height + g[0] * at[k][0] + g[1] * at[k][1]);
            if (!(above < least)) continue;
            least = above;
            lowest = k;
        }
        *steps += n / 4;
        if (lowest == n || !exchange(f, at[lowest])) break;
    }
    for (int k = 0; k < 3; k++)
        if (f->far[k] && f->share[k] > HULL_HAIR) return false;
    return true;
}

/* Finds the facet of the lower hull of n points above u, by the simplex method, from a large triangle. Its corners are
 * so high that they have no share if u is between the points. If u is a corner of the hull, the facet may still contain
 * some of them; then one that is less steep is tried, too. Returns false if u is not between the points. */
static bool find_facet(double (*at)[3], size_t n, const double u[2], double size, sunder_i_slope *slope,
                       uint64_t *steps)
{
    static const double corner[3][2] = {{1, 0}, {-0.5, 0.8660254037844386}, {-0.5, -0.8660254037844386}};
    facet f = {.share = {1. / 3, 1. / 3, 1. / 3}, .far = {true, true, true}};
    double g[2] = {0, 0}, height = 0, highest = 0, less[2], as_high;
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 2; c++) f.at[k][c] = 8 * size * corner[k][c];
    for (size_t k = 0; k < n; k++) {
        for (int c = 0; c < 2; c++) at[k][c] -= u[c];
        if (fabs(at[k][0]) + fabs(at[k][1]) <= SAME_PLACE * size) at[k][0] = at[k][1] = 0;
        highest = sunder_i_max(highest, at[k][2]);
    }
    if (!lower_facet(&f, at, n, size, FAR_HEIGHT * size, g, &height, steps)) return false;
    if ((f.far[0] || f.far[1] || f.far[2]) && lower_facet(&f, at, n, size, highest + 8 * size, less, &as_high, steps)) {
        memcpy(g, less, sizeof less);
        height = as_high;
    }
    *slope = (sunder_i_slope){{-g[0], -g[1]}, height - g[0] * u[0] - g[1] * u[1], 1};
    return true;
}

bool sunder_i_tree_propose_price(sunder_i_tree *tree, uint32_t eased, const sunder_i_region *region, const double u[2],
                                 sunder_i_slope *slope)
{
    double at[MOST_POINTS][3];
    sunder_i_tree_eased *e = &tree->eased[eased];
    size_t n;
    const bool own = region == sunder_i_tree_region(tree, e->pair);
    if (!gather_points(tree, e, region, own, at, MOST_POINTS - 1, &n)) {
        tree->failed = true;
        return false;
    }
    memcpy(at[n], u, 2 * sizeof *u);
    at[n++][2] = lacking(e, u);
    if (!find_facet(at, n, u, e->pieces.size, slope, &tree->steps)) return false;
    const double lacks = sunder_i_max(0, tree->program.lacks[eased]);
    return sunder_i_slope_at(slope, u) > lacks + IN_CONFLICT * e->pieces.size;
}

/* ---- Proofs ------------------------------------------------------------------------------------------------------ */

/* Is it proved that every move of the region lacks more than the slope? If proofs are recorded, the pieces that this
 * one uses are listed in t->named from *named on, *names of them. */
static bool is_proved(sunder_i_tree *t, const sunder_i_tree_eased *e, const sunder_i_region *region,
                      const sunder_i_slope *slope, double gap[2], uint32_t *named, uint32_t *names)
{
    const sunder_i_forbidden *f = &e->pieces;
    if (!t->task.keep) return sunder_i_region_lacks(region, f, slope, NULL, gap, &t->steps);
    if (!sunder_i_reserve(&t->used, &t->used_capacity, f->pieces, sizeof *t->used)) {
        t->failed = true;
        return false;
    }
    if (f->pieces) memset(t->used, 0, f->pieces * sizeof *t->used);
    if (!sunder_i_region_lacks(region, f, slope, t->used, gap, &t->steps)) return false;
    *named = (uint32_t)t->named.n;
    for (uint32_t k = 0; k < f->pieces; k++)
        if (t->used[k] && !sunder_i_list_push(&t->named, k)) t->failed = true;
    *names = (uint32_t)t->named.n - *named;
    return true;
}

/* Adds the cut n.u + share s >= d - room if it is proved that what it removes lacks more. */
static bool try_cut(sunder_i_tree *t, uint32_t eased, const sunder_i_slope *slope, double room, double gap[2])
{
    const sunder_i_tree_eased *e = &t->eased[eased];
    const sunder_i_slope lower = {{slope->n[0], slope->n[1]}, slope->d - room, slope->share};
    const double length = hypot(lower.n[0], lower.n[1]), grain = t->pair[e->pair].forbidden.grain;
    uint32_t named = 0, names = 0;
    sunder_i_region below = *sunder_i_tree_region(t, e->pair);
    if (length > LEVEL) {
        const double back[2] = {-lower.n[0] / length, -lower.n[1] / length};
        sunder_i_region_clip(&below, back, -lower.d / length - 4 * grain, SUNDER_I_NO_CUT, grain);
    }
    if (!is_proved(t, e, &below, &lower, gap, &named, &names)) return false;
    const uint32_t cut = sunder_i_tree_add_price_cut(t, eased, &lower);
    if (t->failed) return false;
    t->note[cut].named = named;
    t->note[cut].names = names;
    return true;
}

static bool try_rooms(sunder_i_tree *t, uint32_t eased, const sunder_i_slope *slope, double far, double gap[2])
{
    const double size = t->eased[eased].pieces.size;
    return try_cut(t, eased, slope, CUT_ROOM * size, gap) || try_cut(t, eased, slope, CUT_MORE_ROOM * size, gap) ||
           try_cut(t, eased, slope, CUT_FAR_ROOM * far, gap);
}

/* Descends from a place of the region to a lower one, as seen from the slope, and notes that place. */
static void note_lower(sunder_i_tree *t, sunder_i_tree_eased *e, const sunder_i_region *region,
                       const sunder_i_slope *slope, const double from[2])
{
    double u[2] = {from[0], from[1]}, best = lacking(e, u) - sunder_i_slope_at(slope, u);
    for (double step = e->pieces.size / 64; step > WALL_HAIR * e->pieces.size; step /= 2)
        for (int k = 0; k < SUNDER_I_TREE_RAYS; k += 4) {
            const double v[2] = {u[0] + step * t->ray[k][0], u[1] + step * t->ray[k][1]};
            if (!is_in_region(region, v, 0) || is_forbidden(e, v)) continue;
            const double height = lacking(e, v) - sunder_i_slope_at(slope, v);
            if (!(height < best)) continue;
            best = height;
            memcpy(u, v, sizeof u);
        }
    t->steps += 240 * e->pieces.pieces;
    add_place(t, e, u);
}

bool sunder_i_tree_cut_price(sunder_i_tree *tree, uint32_t eased, const double u[2])
{
    for (int tries = 0; tries < MOST_LOWER && !tree->failed; tries++) {
        sunder_i_tree_eased *e = &tree->eased[eased];
        const sunder_i_region *region = sunder_i_tree_region(tree, e->pair);
        const size_t known = e->places;
        sunder_i_slope slope;
        double gap[2];
        if (!sunder_i_tree_propose_price(tree, eased, region, u, &slope)) return false;
        const double far = sunder_i_slope_at(&slope, u) - sunder_i_max(0, tree->program.lacks[eased]),
                     unit = 1 / sunder_i_max(1, hypot(slope.n[0], slope.n[1]));
        const sunder_i_slope scaled = {{slope.n[0] * unit, slope.n[1] * unit}, slope.d * unit, unit};
        if (try_rooms(tree, eased, &scaled, far * unit, gap)) return true;
        if (tree->failed || !(fabs(gap[0]) < INFINITY)) return false;
        note_lower(tree, e, region, &scaled, gap);
        if (e->places == known) return false;
    }
    return false;
}
