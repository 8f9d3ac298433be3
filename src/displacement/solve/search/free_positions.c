/* Where is room in a cluster as it stands: for one body of a pair beside the other, or for a body among all? */
#include "displacement/geometry/free_places.h"
#include "displacement/layer/reads.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"
#include "base/watch.h"
#include "separation/separation.h"

#include <math.h>
#include <string.h>

/* ---- Where there is room ----------------------------------------------------------------------------------------- */

/* The number of shapes that stand for a body: its pieces, or, if coarse, the outlines of its members. */
static uint32_t count_shapes(const sunder_i_body *body, bool coarse) { return coarse ? body->members : body->pieces; }

static const sunder_i_body_piece *find_shapes(sunder_i_search *s, const sunder_i_body *body, bool coarse)
{
    const sunder_i_body_pieces *fine = coarse ? NULL : sunder_i_pieces_of(s->model, body);
    const sunder_i_body_piece *shape = coarse ? sunder_i_outlines_of(s->model, body) : fine ? fine->piece : NULL;
    if (!shape) s->failed = true;
    return shape;
}

static void add_wall(sunder_i_search *s, const sunder_i_piece_pair *pair, void *context)
{
    sunder_i_obstacles *o = context;
    double gap;
    const size_t n = sunder_i_search_obstacle(s, pair, &gap);
    if (n) sunder_i_obstacles_add(o, s->scratch.xy, n, sunder_i_max(gap, 0) + 2 * s->tolerance);
}

/* Adds the walls of either body that keep the other inside. */
static void add_walls(sunder_i_search *s, sunder_i_obstacles *o, const sunder_i_body *p, const sunder_i_body *q,
                      const double offset[2], const double v[2], double reach, bool relaxed)
{
    sunder_i_piece_pair pair = {.offset = {offset[0], offset[1]}, .relaxed = relaxed};
    const double back[2] = {-v[0], -v[1]};
    if (p->has->walls) sunder_i_search_walls(s, p, q, v, reach, &pair, false, add_wall, o);
    if (q->has->walls) sunder_i_search_walls(s, q, p, back, reach, &pair, true, add_wall, o);
}

static bool are_relaxed(const sunder_i_search *s, const sunder_i_body *p, const sunder_i_body *q)
{
    double reach;
    return sunder_i_search_is_relaxed(s, (uint32_t)(p - s->model->body), (uint32_t)(q - s->model->body), &reach);
}

/* Adds shadows as obstacles, translated by `shift`, and cut off at distance `far`. */
typedef struct shading {
    sunder_i_obstacles *obstacles;
    double shift[2], far;
} shading;

static void add_shadow(sunder_i_search *s, const sunder_i_piece_pair *pair, void *context)
{
    shading *shade = context;
    double gap;
    size_t n;
    const sunder_i_obstacle_edge *edge = sunder_i_search_edges(s, pair, &n, &gap);
    if (!edge) return;
    double *corner = sunder_i_scratch_reserve(&s->scratch, n + 3);
    if (!corner) {
        s->failed = true;
        return;
    }
    n = pair->row ? sunder_i_half_plane_corners(edge, shade->far, corner)
                  : sunder_i_shadow_corners(edge, n, shade->far, corner);
    for (size_t k = 0; k < 2 * n; k++) corner[k] += shade->shift[k & 1];
    s->steps += OBSTACLE_WORK;
    sunder_i_obstacles_add(shade->obstacles, corner, n, sunder_i_max(gap, 0) + 2 * s->tolerance);
}

/* Adds the shadows between p at move t and q, for moves of q within `reach` of `at`. */
static void add_shadows(sunder_i_search *s, sunder_i_obstacles *o, const sunder_i_body *p, const double t[2],
                        const sunder_i_body *q, const double at[2], double reach)
{
    const double u[2] = {at[0] - t[0], at[1] - t[1]};
    shading shade = {o, {t[0], t[1]}, hypot(u[0], u[1]) + reach};
    sunder_i_search_body_shadows(s, p, q, u, reach + s->gap - s->model->rules.gap, add_shadow, &shade);
    sunder_i_search_visit_row(s, p, q, are_relaxed(s, p, q), add_shadow, &shade);
}

typedef struct shade {
    const double *u;
    bool deep;
} shade;

static void take_shade(sunder_i_search *s, const sunder_i_piece_pair *pair, void *context)
{
    shade *at = context;
    double gap;
    size_t n;
    const sunder_i_obstacle_edge *edge = sunder_i_search_edges(s, pair, &n, &gap);
    at->deep = at->deep || (edge && sunder_i_search_support(pair, edge, n, at->u).distance < gap);
}

/* Is the move `at` of q in a shadow between p, at move t, and q? */
static bool is_shaded(sunder_i_search *s, const sunder_i_body *p, const double t[2], const sunder_i_body *q,
                      const double at[2])
{
    const double u[2] = {at[0] - t[0], at[1] - t[1]};
    shade found = {u, false};
    sunder_i_search_body_shadows(s, p, q, u, s->gap - s->model->rules.gap, take_shade, &found);
    sunder_i_search_visit_row(s, p, q, are_relaxed(s, p, q), take_shade, &found);
    return found.deep;
}

static double box_extent(const double box[4]) { return sunder_i_max(box[2] - box[0], box[3] - box[1]); }

/* Can bodies p and q, q at v relative to p, be within r of each other, perhaps after their obstacle was shifted by a
 * relaxation? The shift is a least translation, and so at most the sum of the box sizes. */
static bool are_near(const sunder_i_body *p, const sunder_i_body *q, const double v[2], double r)
{
    const double far = r + box_extent(p->box) + box_extent(q->box);
    const double box[4] = {p->box[0] - v[0] - far, p->box[1] - v[1] - far, p->box[2] - v[0] + far,
                           p->box[3] - v[1] + far};
    return sunder_i_box_meet(box, q->box);
}

/* Adds the obstacle of two shapes. pieces: they are pieces, whose obstacle is kept; otherwise outlines. */
static void add_obstacle(sunder_i_search *s, sunder_i_obstacles *o, const sunder_i_body_piece *a,
                         const sunder_i_body_piece *b, const sunder_i_relaxation *relaxation, bool pieces,
                         const sunder_i_grown_key *key)
{
    const bool kept = pieces && !relaxation;
    if (kept && sunder_i_grown_cache_add(&s->grown, key, o)) return;
    const size_t n = sunder_i_obstacle_corners(a->corner, a->corners, b->corner, b->corners, key->offset, &s->scratch);
    double gap = key->gap;
    if (n == 0) {
        s->failed = true;
        return;
    }
    if (relaxation)
        gap = sunder_i_min(gap, sunder_i_search_shift(relaxation, b->feature, s->scratch.xy, n) + 2 * s->tolerance);
    const size_t before = o->n;
    sunder_i_obstacles_add(o, s->scratch.xy, n, gap);
    if (kept && o->n > before && !sunder_i_grown_cache_keep(&s->grown, key, o)) s->failed = true;
}

/* Adds the obstacles of the shapes of p for the shapes of q, which is at u, within `reach`. */
static void add_obstacles(sunder_i_search *s, sunder_i_obstacles *o, const sunder_i_body *p, bool coarse_p,
                          const sunder_i_body *q, bool coarse_q, const double offset[2], const double u[2],
                          double reach)
{
    const sunder_i_model *model = s->model;
    double shift;
    const double v[2] = {offset[0] + u[0], offset[1] + u[1]};
    if (!are_near(p, q, v, reach + s->gap)) return;
    const bool relaxed =
        sunder_i_search_is_relaxed(s, (uint32_t)(p - model->body), (uint32_t)(q - model->body), &shift);
    const double r = reach + s->gap + shift;
    const uint32_t np = count_shapes(p, coarse_p), nq = count_shapes(q, coarse_q);
    const sunder_i_body_piece *of_p = find_shapes(s, p, coarse_p), *of_q = find_shapes(s, q, coarse_q);
    if (!of_p || !of_q) return;
    if ((p->has->walls || q->has->walls) && (relaxed || model->inclusions))
        add_walls(s, o, p, q, offset, v, r, relaxed);
    for (uint32_t k = 0; k < np; k++) {
        const sunder_i_body_piece *a = &of_p[k];
        const double box[4] = {a->box[0] - v[0] - r, a->box[1] - v[1] - r, a->box[2] - v[0] + r, a->box[3] - v[1] + r};
        if (a->corners == 0 || !sunder_i_box_meet(box, q->box)) continue;
        for (uint32_t l = 0; l < nq; l++) {
            const sunder_i_body_piece *b = &of_q[l];
            if (b->corners == 0 || !sunder_i_box_meet(box, b->box) ||
                sunder_i_is_included(model, a->feature, b->feature))
                continue;
            const sunder_i_relaxation *relaxation = relaxed ? sunder_i_search_relaxation(s, a, b) : NULL;
            if (relaxation && relaxation->inside) continue;
            /* A little more than the full distance, so that rounding does not cause a clash. */
            const sunder_i_grown_key key = {(uint64_t)(p->piece + k) << 32 | (q->piece + l),
                                            {offset[0], offset[1]},
                                            sunder_i_search_owed(s, a, b) + 2 * s->tolerance};
            s->steps += OBSTACLE_WORK;
            add_obstacle(s, o, a, b, relaxation, !coarse_p && !coarse_q, &key);
            if (s->failed) return;
        }
    }
}

/* The nearest point outside the box of all obstacles in one of the four directions, if it is within `limit`. It is free
 * even if all else is full. */
static bool outside_all(const sunder_i_obstacles *o, const double target[2], double limit, double place[2])
{
    double all[4], best = INFINITY;
    sunder_i_box_clear(all);
    for (size_t k = 0; k < o->n; k++) sunder_i_box_join(all, o->obstacle[k].box);
    for (int c = 0; c < 4; c++) {
        const double d = fabs(all[c] - target[c & 1]);
        if (!(d < best) || d > limit) continue;
        best = d;
        place[c & 1] = all[c];
        place[1 - (c & 1)] = target[1 - (c & 1)];
    }
    return best < INFINITY;
}

/* A free position by the exact search for two shapes, which is faster if there are many pieces. The start vector is
 * rounded to few bits. The search without the gap suffices, since it only decides the side, and is much faster. */
static bool free_pair_exactly(sunder_i_search *s, const sunder_shape *p, const sunder_shape *q, const double target[2],
                              double limit, double place[2])
{
    const double none[2] = {0, 0};
    double from[2];
    for (int c = 0; c < 2; c++) {
        int exponent;
        frexp(sunder_i_max(fabs(p->box[c]), fabs(p->box[c + 2])), &exponent);
        const double unit = ldexp(1, exponent - 44);
        from[c] = unit > 0 ? unit * rint(target[c] / unit) : target[c];
    }
    sunder_separation least;
    bool beyond = false, overlap = true;
    sunder_status status = SUNDER_OK;
    /* Most pairs that are too near do not overlap, and that test is faster. */
    if (s->model->rules.gap > 0) status = sunder_i_overlap(p, none, q, from, &overlap, NULL);
    if (!status && !overlap) {
        memcpy(place, from, sizeof from);
        return true;
    }
    if (!status) status = sunder_i_separate(p, none, q, from, 0, limit, &least, &beyond, NULL);
    if (status == SUNDER_ENOMEM || status == SUNDER_ECANCEL) s->failed = true;
    if (status) return false;
    place[0] = from[0] + least.dx;
    place[1] = from[1] + least.dy;
    sunder_separation_clear(&least);
    return !beyond && isfinite(place[0]) && isfinite(place[1]);
}

/* Free positions of q within `reach` of `target`, while p does not move. Most are in no shadow, so shadows are only
 * added if one of the positions found is in one. outside: if there is none, a position outside all obstacles is
 * returned. */
static size_t find_beside(sunder_i_search *s, const sunder_i_body *p, const sunder_i_body *q, bool many,
                          const double target[2], double reach, double spread, bool outside, size_t most,
                          double (*places)[2])
{
    const double offset[2] = {q->origin[0] - p->origin[0], q->origin[1] - p->origin[1]}, none[2] = {0, 0};
    const bool coarse_p = many && !sunder_i_is_barrier_body(s->model, p),
               coarse_q = many && !sunder_i_is_barrier_body(s->model, q);
    sunder_i_obstacles *o = &s->obstacles;
    sunder_i_obstacles_clear(o);
    add_obstacles(s, o, p, coarse_p, q, coarse_q, offset, target, reach);
    size_t n = sunder_i_free_places(o, target, reach, spread, most, places, &s->steps, &s->failed);
    if (n == 0 && outside && outside_all(o, target, INFINITY, places[0])) n = 1;
    bool shaded = false;
    for (size_t k = 0; k < n && !shaded && !s->failed; k++) shaded = is_shaded(s, p, none, q, places[k]);
    if (shaded) {
        add_shadows(s, o, p, none, q, target, reach);
        n = sunder_i_free_places(o, target, reach, spread, most, places, &s->steps, &s->failed);
    }
    s->failed = s->failed || o->failed;
    return n;
}

/* Are there too many pairs of pieces for obstacles piece by piece? */
static bool are_many(uint32_t pieces, uint32_t others) { return (uint64_t)pieces * others > MANY_PAIRS; }

bool sunder_i_cluster_may_want_shape(const sunder_i_model *model, uint32_t body)
{
    return are_many(model->body[body].pieces, model->most_pieces);
}

size_t sunder_i_search_free_pair(sunder_i_search *search, uint32_t i, uint32_t j, const double target[2], double spread,
                                 size_t most, double (*places)[2])
{
    const sunder_i_model *model = search->model;
    const sunder_i_body *p = &model->body[search->body[i]], *q = &model->body[search->body[j]];
    const double none[2] = {0, 0};
    const bool many = are_many(p->pieces, q->pieces);
    const sunder_shape *ps = sunder_i_model_shape(model, search->body[i]),
                       *qs = sunder_i_model_shape(model, search->body[j]);
    double shift;
    const bool relaxed = sunder_i_search_is_relaxed(search, search->body[i], search->body[j], &shift);
    /* The cost of the exact search grows with the depth, so blocks that lie deep in each other are separated by their
     * outlines. */
    const double shallow =
        sunder_i_max(2 * search->gap, SHALLOW * sunder_i_min(box_extent(p->box), box_extent(q->box)));
    if (many && most == 1 && model->inclusions == 0 && !relaxed && ps && qs && !ps->flat && !qs->flat &&
        free_pair_exactly(search, ps, qs, target, shallow, places[0]) && !is_shaded(search, p, none, q, places[0]))
        return 1;
    double all = BEYOND_ALL * (box_extent(p->box) + box_extent(q->box) + search->gap);
    const bool confined = sunder_i_search_is_confined(search, i, j, target, &all);
    double reach = sunder_i_max(2 * search->gap, PAIR_REACH * sunder_i_min(box_extent(p->box), box_extent(q->box)));
    /* A point without a gap has size 0, so the search begins with the size of the other body. */
    if (!(reach > 0)) reach = PAIR_REACH * sunder_i_max(box_extent(p->box), box_extent(q->box));
    for (;; reach *= PAIR_GROWTH) {
        if (confined) reach = sunder_i_min(reach, all);
        const size_t n = find_beside(search, p, q, many, target, reach, spread, !confined && reach > all, most, places);
        if (n || search->failed) return n;
        if (reach > all || (confined && reach == all) || !(reach > 0)) return 0;
    }
}

/* Appends to `hits`, once each, the bodies of the model near a box (relative to the origin of p) that are not in this
 * search. */
static bool find_others(sunder_i_search *s, const sunder_i_body *p, const double box[4], sunder_i_list *hits)
{
    const sunder_i_model *model = s->model;
    double where[4];
    for (int c = 0; c < 4; c++) where[c] = box[c] + p->origin[c & 1];
    if (!sunder_i_look_about(model, model->standing, where, hits)) return false;
    sunder_i_things_to_bodies(model, hits);
    size_t out = 0;
    for (size_t k = 0; k < hits->n; k++) {
        const uint32_t b = hits->item[k];
        if (sunder_i_set_has(s->body, s->own, b) || sunder_i_set_has(s->body + s->own, s->n - s->own, b)) continue;
        hits->item[out++] = b;
    }
    hits->n = out;
    return true;
}

/* An upper bound of the number of shadows between two bodies. */
static uint64_t count_shadows(const sunder_i_body *p, const sunder_i_body *q)
{
    return (uint64_t)p->members * (q->pieces + q->has->sides) + (uint64_t)q->members * (p->pieces + p->has->sides);
}

/* The bodies around body i: bodies of the search, listed in `about`, and bodies outside it. */
typedef struct others {
    sunder_i_search *search;
    uint32_t i;
    sunder_i_list foreign;
    bool coarse; /* outlines stand for bodies */
} others;

/* The k-th body around body i, and its move *t; NULL: it is ignored. */
static const sunder_i_body *other_at(const others *all, size_t k, const double **t)
{
    const sunder_i_search *s = all->search;
    const sunder_i_model *model = s->model;
    const bool own = k < s->about.n;
    const uint32_t at = own ? s->about.item[k] : all->foreign.item[k - s->about.n], body = own ? s->body[at] : at;
    if (own && (at == all->i || s->away[at])) return NULL;
    *t = own ? s->t + 2 * (size_t)at : model->move + 2 * (size_t)body;
    return model->body[body].pieces ? &model->body[body] : NULL;
}

static size_t count_others(const others *all) { return all->search->about.n + all->foreign.n; }

/* The number of pieces of other bodies whose boxes are within the gap plus `reach` of the box of body i at the move
 * `at`. */
static uint64_t count_around(const others *all, const double at[2], double reach)
{
    sunder_i_search *s = all->search;
    const sunder_i_model *model = s->model;
    const sunder_i_body *p = &model->body[s->body[all->i]];
    uint64_t n = 0;
    for (size_t k = 0; k < count_others(all); k++) {
        const double *t;
        const sunder_i_body *q = other_at(all, k, &t);
        double box[4];
        if (!q) continue;
        for (int c = 0; c < 4; c++)
            box[c] = p->box[c] + p->origin[c & 1] + at[c & 1] - q->origin[c & 1] - t[c & 1] +
                     (c < 2 ? -1 : 1) * (reach + s->gap);
        if (!sunder_i_box_meet(box, q->box)) continue;
        const sunder_i_body_piece *piece = find_shapes(s, q, false);
        for (uint32_t l = 0; piece && l < q->pieces; l++) n += sunder_i_box_meet(box, piece[l].box);
    }
    return n;
}

/* Adds the obstacles of all other bodies for body i, within `reach` of the move `at`. */
static void add_surroundings(others *all, sunder_i_obstacles *o, const double at[2], double reach)
{
    sunder_i_search *s = all->search;
    const sunder_i_model *model = s->model;
    const sunder_i_body *p = &model->body[s->body[all->i]];
    all->coarse = (uint64_t)p->pieces * count_around(all, at, reach) > MANY_AROUND;
    for (size_t k = 0; k < count_others(all) && !s->failed; k++) {
        const double *t;
        const sunder_i_body *q = other_at(all, k, &t);
        if (!q) continue;
        /* Body q does not move, so the obstacle for the move of body i is Q + t_q - P. */
        const double offset[2] = {p->origin[0] - q->origin[0] - t[0], p->origin[1] - q->origin[1] - t[1]};
        add_obstacles(s, o, q, all->coarse && q->pieces > q->members && !sunder_i_is_barrier_body(model, q), p,
                      all->coarse, offset, at, reach);
    }
}

/* If there are very many pieces, the shadows of large blocks are left out. A body that is put into one will clash
 * there. */
static bool has_shadows(const others *all, const sunder_i_body *p, const sunder_i_body *q)
{
    return !all->coarse || count_shadows(p, q) <= MANY_SHADOWS;
}

static bool is_shaded_by_others(const others *all, const double at[2])
{
    sunder_i_search *s = all->search;
    const sunder_i_body *p = &s->model->body[s->body[all->i]];
    for (size_t k = 0; k < count_others(all) && !s->failed; k++) {
        const double *t;
        const sunder_i_body *q = other_at(all, k, &t);
        if (q && has_shadows(all, p, q) && is_shaded(s, q, t, p, at)) return true;
    }
    return false;
}

static void add_shadows_of_others(const others *all, sunder_i_obstacles *o, const double at[2], double reach)
{
    sunder_i_search *s = all->search;
    const sunder_i_body *p = &s->model->body[s->body[all->i]];
    for (size_t k = 0; k < count_others(all) && !s->failed; k++) {
        const double *t;
        const sunder_i_body *q = other_at(all, k, &t);
        if (q && has_shadows(all, p, q)) add_shadows(s, o, q, t, p, at, reach);
    }
}

/* Is the whole search free of clashes if body i has the move `place`? user: the `others` around body i. */
static bool is_clear_at(void *user, const double place[2])
{
    const others *all = user;
    sunder_i_search *s = all->search;
    double *t = s->t + 2 * (size_t)all->i;
    const double stood[2] = {t[0], t[1]};
    memcpy(t, place, sizeof stood);
    const bool clear = sunder_i_search_find_clashes(s, s->t) <= s->tolerance;
    memcpy(t, stood, sizeof stood);
    return clear;
}

/* Is the place within the limit of body i, which is not about the place that it prefers? */
static bool is_within_limit(void *user, const double place[2])
{
    const others *all = user;
    return hypot(place[0], place[1]) <= sunder_i_search_limit(all->search, all->i);
}

/* Finds free positions of body i within `reach` of `home`, at most `most` of them, the nearest first. Shadows are only
 * added if the first is in one. clear: shadows are added at once, and each position is tested for clashes as it is
 * found, since between two shadows with a common corner there is a ray that is in neither. Returns their number. */
static size_t find_among(others *all, const double home[2], double reach, bool clear, size_t most, double (*found)[2])
{
    sunder_i_search *s = all->search;
    const double spread = most > 1 ? ROUND_SHARE * s->gap : 0;
    size_t n = 0;
    sunder_i_obstacles *o = &s->obstacles;
    sunder_i_obstacles_clear(o);
    add_surroundings(all, o, home, reach);
    if (clear) {
        add_shadows_of_others(all, o, home, reach);
        o->admits = is_clear_at;
        o->user = all;
    } else if (s->model->preferred) {
        o->admits = is_within_limit;
        o->user = all;
    }
    for (int shadows = clear; shadows < 2; shadows++) {
        n = sunder_i_free_places(o, home, reach, spread, most, found, &s->steps, &s->failed);
        if (n == 0 && o->n && outside_all(o, home, reach, found[0])) n = !clear || is_clear_at(all, found[0]);
        if (n == 0 || shadows || s->failed || !is_shaded_by_others(all, found[0])) break;
        add_shadows_of_others(all, o, home, reach);
    }
    s->failed = s->failed || o->failed;
    return n;
}

/* Finds the free positions of body i that are nearest to the one it prefers, at most `most`. The distance searched
 * grows until it reaches `limit`, or exceeds `all`. clear: as in find_among(). Returns the number of positions found.
 * */
static size_t find_free_places(sunder_i_search *s, uint32_t i, double limit, double all, bool clear, size_t most,
                               double (*places)[2])
{
    const sunder_i_body *p = &s->model->body[s->body[i]];
    const double *to = s->preferred + 2 * i, now = sunder_i_search_stray(s, i), off = hypot(to[0], to[1]);
    for (double reach = 2 * s->gap + sunder_i_max(now, BODY_REACH * box_extent(p->box));; reach *= BODY_GROWTH) {
        if (reach > limit) reach = limit;
        others about = {.search = s, .i = i};
        const double r = reach + s->gap + off, box[4] = {p->box[0] - r, p->box[1] - r, p->box[2] + r, p->box[3] + r};
        if (!find_others(s, p, box, &about.foreign) || !sunder_i_search_find_about(s, i, r)) s->failed = true;
        const size_t found = s->failed ? 0 : find_among(&about, to, reach, clear, most, places);
        sunder_i_free(about.foreign.item);
        if (!sunder_i_look()) s->failed = true;
        if (found || s->failed) return s->failed ? 0 : found;
        if (reach >= limit || reach > all || !(reach > 0) ||
            (clear && off == 0 && sunder_i_search_is_enclosed(s, i, reach)))
            return 0;
    }
}

static double beyond_all(const sunder_i_search *s, uint32_t i)
{
    const sunder_i_rtree *tree = s->model->standing;
    return BEYOND_ALL * (box_extent(tree->box + 4 * (tree->level[tree->levels] - 1)) +
                         box_extent(s->model->body[s->body[i]].box) + s->gap);
}

bool sunder_i_search_free_body(sunder_i_search *search, uint32_t i, double limit, double place[2])
{
    const double now = sunder_i_search_stray(search, i), size = box_extent(search->model->body[search->body[i]].box);
    double all = beyond_all(search, i);
    if (!search->model->rules.jumps)
        all = sunder_i_min(all, now + FARTHEST_LEAP * (sunder_i_min(size, search->extent) + search->gap));
    double found[1][2];
    if (find_free_places(search, i, limit, all, false, 1, found) == 0) return false;
    memcpy(place, found[0], sizeof found[0]);
    return true;
}

size_t sunder_i_search_free_body_anywhere(sunder_i_search *s, uint32_t i, double limit, size_t most,
                                          double (*places)[2])
{
    return find_free_places(s, i, limit, beyond_all(s, i), true, most, places);
}

bool sunder_i_cluster_free_places(const sunder_i_model *model, uint32_t body, double limit, size_t most,
                                  double (*places)[2], size_t *n)
{
    sunder_i_search s;
    bool ok = sunder_i_search_init(&s, model, &body, 1, 0, model->move + 2 * (size_t)body);
    *n = ok && limit > 0 ? sunder_i_search_free_body_anywhere(&s, 0, limit, most, places) : 0;
    ok = ok && !s.failed;
    sunder_i_search_free(&s);
    return ok;
}
