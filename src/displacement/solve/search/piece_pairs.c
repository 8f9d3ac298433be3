/* The distances that two bodies of a cluster have to keep, one for each pair of pieces: the gap, or what a relaxation
 * demands where the pair is left in conflict; and the walls of one body that keep the other inside. */
#include "displacement/solve/search/cluster_search.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"
#include "base/stage_switch.h"
#include "base/watch.h"

#include <math.h>

double sunder_i_search_owed(const sunder_i_search *search, const sunder_i_body_piece *a, const sunder_i_body_piece *b)
{
    if (!sunder_i_is_barrier(search->model, a->feature) && !sunder_i_is_barrier(search->model, b->feature))
        return search->gap;
    return search->gap + (sunder_i_owed_above(search->model, a->feature, b->feature) - search->model->rules.gap);
}

/* Does this relaxation of the model count in the search? */
static bool still_counts(const sunder_i_search *s, const sunder_i_relaxation *relaxation)
{
    if (s->restored_n == 0) return true;
    const sunder_i_restored wanted = sunder_i_restored_of(s->model, relaxation);
    const size_t at = sunder_i_restored_at(s->restored, s->restored_n, &wanted);
    return at == s->restored_n || sunder_i_by_restored(&s->restored[at], &wanted) != 0;
}

/* Has the search restored all relaxations of the model between the two bodies? */
static bool all_restored(const sunder_i_search *s, const sunder_i_relaxed_bodies *relaxed)
{
    const sunder_i_restored first = {{relaxed->i, relaxed->j}, {0, 0}},
                            last = {{relaxed->i, relaxed->j}, {UINT32_MAX, UINT32_MAX}};
    return s->restored_n && sunder_i_restored_at(s->restored, s->restored_n, &last) -
                                    sunder_i_restored_at(s->restored, s->restored_n, &first) ==
                                relaxed->n;
}

bool sunder_i_search_is_relaxed(const sunder_i_search *search, uint32_t body, uint32_t other, double *reach)
{
    *reach = 0;
    if (search->relaxations.n + search->model->relaxations.n == 0) return false;
    const sunder_i_relaxed_bodies *own = sunder_i_relaxations_between(&search->relaxations, body, other),
                                  *all = sunder_i_relaxations_between(&search->model->relaxations, body, other);
    if (all && all_restored(search, all)) all = NULL;
    if (own) *reach = own->reach;
    if (all) *reach = sunder_i_max(*reach, all->reach);
    return own || all;
}

const sunder_i_relaxation *sunder_i_search_relaxation(const sunder_i_search *search, const sunder_i_body_piece *a,
                                                      const sunder_i_body_piece *b)
{
    const sunder_i_relaxation *relaxation = sunder_i_relaxations_find(&search->relaxations, a->feature, b->feature);
    if (relaxation) return relaxation;
    relaxation = sunder_i_relaxations_find(&search->model->relaxations, a->feature, b->feature);
    return relaxation && still_counts(search, relaxation) ? relaxation : NULL;
}

/* Does the wall keep the piece inside, by the rules or by a relaxation? Sets pair->inclusion. */
static bool keeps_inside(const sunder_i_search *s, const sunder_i_body_piece *wall, const sunder_i_body_piece *piece,
                         sunder_i_piece_pair *pair)
{
    if (sunder_i_keeps_inside(s->model, wall->feature, piece->feature, &pair->inclusion)) return true;
    if (!pair->relaxed) return false;
    const sunder_i_relaxation *relaxation = sunder_i_search_relaxation(s, wall, piece);
    pair->inclusion = SUNDER_I_LENIENT;
    return relaxation && relaxation->inside && sunder_i_is_inner(s->model, piece->feature, wall->feature);
}

/* Are the pieces exempt from keeping a distance, since one feature lies in the other? Sets pair->relaxation. */
static bool are_exempt(const sunder_i_search *s, const sunder_i_body_piece *a, const sunder_i_body_piece *b,
                       sunder_i_piece_pair *pair)
{
    pair->inclusion = SUNDER_I_LAPSED;
    if (pair->relaxed) pair->relaxation = sunder_i_search_relaxation(s, a, b);
    return (s->model->inclusions && sunder_i_is_included(s->model, a->feature, b->feature)) ||
           (pair->relaxation && pair->relaxation->inside);
}

typedef struct visiting {
    sunder_i_search *s;
    sunder_i_piece_pair *pair;
    const sunder_i_body_piece *from; /* [n] pieces of one body, or walls, numbered from `first` on */
    uint32_t n, first;
    const sunder_i_body_pieces *of; /* the pieces of that body; NULL: `from` are walls */
    const sunder_i_body *other;
    const sunder_i_body_pieces *facing; /* the pieces of `other` */
    bool swapped;
    sunder_i_visit_piece_pair call;
    void *context;
} visiting;

/* Visits piece or wall k of `from`, with its box, and piece l of the other body. It is inline, like its callers, as the
 * innermost loop of the search. */
static inline void visit_piece(const visiting *to, uint32_t k, const double box[4], uint32_t l)
{
    const sunder_i_body_piece *a = &to->from[k], *b = &to->facing->piece[l];
    sunder_i_piece_pair *pair = to->pair;
    if (!sunder_i_box_meet(box, b->box)) return;
    pair->relaxation = NULL;
    if (to->of ? are_exempt(to->s, a, b, pair) : !keeps_inside(to->s, a, b, pair)) return;
    pair->key = (uint64_t)!to->of << 62 | (uint64_t)(to->first + k) << 32 | (to->other->piece + l);
    pair->a = to->swapped ? b : a;
    pair->b = to->swapped ? a : b;
    to->call(to->s, pair, to->context);
}

/* The box of piece a relative to the other body, whose relative position is v, grown by `reach`. */
static inline void box_seen(const sunder_i_body_piece *a, const double v[2], double reach, double box[4])
{
    for (int c = 0; c < 4; c++) box[c] = a->box[c] - v[c & 1] + (c < 2 ? -reach : reach);
}

/* Does a run of SUNDER_I_RUN pieces begin with the piece of this number, whose common box does not meet `box`? left:
 * the number of pieces that remain. */
static inline bool is_run_beside(const sunder_i_body_pieces *of, uint32_t number, uint32_t left, const double box[4])
{
    return number % SUNDER_I_RUN == 0 && left >= SUNDER_I_RUN &&
           !sunder_i_box_meet(of->run + 4 * (size_t)(number / SUNDER_I_RUN - of->first_run), box);
}

/* Lists the pieces of the other body whose boxes meet `box`, ascending. Returns their number, or MOST_FACING + 1 if
 * there are more. */
static inline uint32_t find_facing(const visiting *to, const double box[4], uint32_t piece[MOST_FACING])
{
    const sunder_i_body *body = to->other;
    uint32_t n = 0;
    for (uint32_t l = 0; l < body->pieces; l++) {
        if (is_run_beside(to->facing, body->piece + l, body->pieces - l, box)) {
            l += SUNDER_I_RUN - 1;
            continue;
        }
        if (!sunder_i_box_meet(box, to->facing->piece[l].box)) continue;
        if (n == MOST_FACING) return n + 1;
        piece[n++] = l;
    }
    return n;
}

/* The box of the other body at its relative position v, grown by `reach` and by more than the rounding error. A piece
 * whose box does not meet it is not visited: the box of that piece relative to the other body (box_seen()) cannot meet
 * the other body's box either. */
static inline void box_of_other(const sunder_i_body *other, const double v[2], double reach, double box[4])
{
    double most = sunder_i_max(fabs(v[0]), fabs(v[1])) + fabs(reach);
    for (int c = 0; c < 4; c++) most = sunder_i_max(most, fabs(other->box[c]));
    const double grown = reach + 0x1p-46 * most;
    for (int c = 0; c < 4; c++) box[c] = other->box[c] + v[c & 1] + (c < 2 ? -grown : grown);
}

/* Visits up to PARTS_AT_ONCE pieces of `from`, from `begin` on, that are near the other body; returns where to
 * continue. Blocks have hundreds of pieces of which few face each other, so pieces of the other body that are near none
 * of these are dropped first. */
static inline uint32_t visit_some(const visiting *to, uint32_t begin, const double v[2], double reach)
{
    sunder_i_search *s = to->s;
    double box[PARTS_AT_ONCE][4], all[4], seen[4];
    uint32_t chosen[PARTS_AT_ONCE], piece[MOST_FACING], n = 0, k = begin;
    sunder_i_box_clear(all);
    box_of_other(to->other, v, reach, seen);
    for (; k < to->n && n < PARTS_AT_ONCE; k++) {
        if (to->of && is_run_beside(to->of, to->first + k, to->n - k, seen)) {
            k += SUNDER_I_RUN - 1;
            continue;
        }
        if (!sunder_i_box_meet(to->from[k].box, seen)) continue;
        box_seen(&to->from[k], v, reach, box[n]);
        if (!sunder_i_box_meet(box[n], to->other->box)) continue;
        sunder_i_box_join(all, box[n]);
        chosen[n++] = k;
    }
    if (!sunder_i_steps((k - begin) * (1 + (size_t)to->other->pieces / 8))) s->failed = true;
    if (n == 0) return k;
    const uint32_t facing = find_facing(to, all, piece);
    for (uint32_t i = 0; i < n; i++)
        if (facing <= MOST_FACING)
            for (uint32_t l = 0; l < facing && !s->failed; l++) visit_piece(to, chosen[i], box[i], piece[l]);
        else
            for (uint32_t l = 0; l < to->other->pieces && !s->failed; l++) visit_piece(to, chosen[i], box[i], l);
    return k;
}

/* Visits the pairs of pieces whose boxes are within `reach`, for two bodies of few pieces: tests all pairs. */
static inline void visit_each(const visiting *to, const double v[2], double reach)
{
    sunder_i_search *s = to->s;
    for (uint32_t k = 0; k < to->n; k++) {
        double box[4];
        box_seen(&to->from[k], v, reach, box);
        if (!sunder_i_box_meet(box, to->other->box)) continue;
        for (uint32_t l = 0; l < to->other->pieces && !s->failed; l++) visit_piece(to, k, box, l);
    }
    if (!sunder_i_steps(to->n * (1 + (size_t)to->other->pieces / 8))) s->failed = true;
}

/* Visits all pairs within `reach`, with the other body at v. */
static inline void visit_all(const visiting *to, const double v[2], double reach)
{
    if (to->n <= FEW_PARTS && to->other->pieces <= FEW_PARTS)
        visit_each(to, v, reach);
    else
        for (uint32_t k = 0; k < to->n;) k = visit_some(to, k, v, reach);
}

void sunder_i_search_walls(sunder_i_search *search, const sunder_i_body *holder, const sunder_i_body *other,
                           const double v[2], double reach, sunder_i_piece_pair *pair, bool swapped,
                           sunder_i_visit_piece_pair visit, void *context)
{
    const sunder_i_body_pieces *facing = sunder_i_pieces_of(search->model, other);
    const visiting to = {.s = search,
                         .pair = pair,
                         .from = search->model->wall + holder->has->wall,
                         .n = holder->has->walls,
                         .first = holder->has->wall,
                         .other = other,
                         .facing = facing,
                         .swapped = swapped,
                         .call = visit,
                         .context = context};
    if (facing)
        visit_all(&to, v, reach);
    else
        search->failed = true;
}

/* Visits the pairs of pieces of two bodies. */
static void visit_pieces(sunder_i_search *s, const sunder_i_body *p, const sunder_i_body *q, const double v[2],
                         double reach, sunder_i_piece_pair *pair, sunder_i_visit_piece_pair visit, void *context)
{
    const sunder_i_body_pieces *of = sunder_i_pieces_of(s->model, p), *facing = sunder_i_pieces_of(s->model, q);
    if (!of || !facing) {
        s->failed = true;
        return;
    }
    const visiting to = {.s = s,
                         .pair = pair,
                         .from = of->piece,
                         .n = p->pieces,
                         .first = p->piece,
                         .of = of,
                         .other = q,
                         .facing = facing,
                         .call = visit,
                         .context = context};
    visit_all(&to, v, reach);
}

void sunder_i_search_piece_pairs(sunder_i_search *search, uint32_t i, uint32_t j, const double u[2], double reach,
                                 bool yields, sunder_i_visit_piece_pair visit, void *context)
{
    const sunder_i_model *model = search->model;
    const sunder_i_body *p = &model->body[search->body[i]], *q = &model->body[search->body[j]];
    sunder_i_piece_pair pair = {.offset = {q->origin[0] - p->origin[0], q->origin[1] - p->origin[1]}};
    const double v[2] = {pair.offset[0] + u[0], pair.offset[1] + u[1]}, back[2] = {-v[0], -v[1]};
    double shift = 0;
    pair.relaxed = yields && sunder_i_search_is_relaxed(search, search->body[i], search->body[j], &shift);
    reach += shift;
    visit_pieces(search, p, q, v, reach, &pair, visit, context);
    /* Shadows are seldom in the way, so they are looked for within a shorter distance. */
    const double ahead = sunder_i_min(reach - shift - search->gap, search->gap / LEAST_REACH);
    sunder_i_search_body_shadows(search, p, q, u, search->gap - model->rules.gap + ahead, visit, context);
    sunder_i_search_visit_row(search, p, q, pair.relaxed, visit, context);
    if (!pair.relaxed && model->inclusions == 0) return;
    if (p->has->walls) sunder_i_search_walls(search, p, q, v, reach, &pair, false, visit, context);
    if (q->has->walls) sunder_i_search_walls(search, q, p, back, reach, &pair, true, visit, context);
}

double sunder_i_search_shift(const sunder_i_relaxation *relaxation, uint32_t of_j, double *corner, size_t n)
{
    double shift[2];
    const double gap = sunder_i_relaxation_shift(relaxation, of_j, shift);
    for (size_t k = 0; k < 2 * n; k++) corner[k] -= shift[k & 1];
    return gap;
}

/* The obstacle A + (-B), without a relaxation. */
static size_t make_obstacle(sunder_i_search *s, const sunder_i_piece_pair *pair)
{
    const sunder_i_body_piece *a = pair->a, *b = pair->b;
    return sunder_i_obstacle_corners(a->corner, a->corners, b->corner, b->corners, pair->offset, &s->scratch);
}

/* The distance that a pair without a relaxation has to keep. edge: the n edges of its obstacle. */
static double owed_by_pair(const sunder_i_search *s, const sunder_i_piece_pair *pair,
                           const sunder_i_obstacle_edge *edge, size_t n)
{
    const double margin = s->gap - s->model->rules.gap, home[2] = {0, 0};
    if (pair->shadow) return sunder_i_min(margin, sunder_i_shadow_support_at(edge, n, home).distance);
    if (pair->inclusion == SUNDER_I_LAPSED) return sunder_i_search_owed(s, pair->a, pair->b);
    if (pair->inclusion == SUNDER_I_STRICT) return margin;
    return sunder_i_min(margin, sunder_i_support_at(edge, n, home).distance);
}

/* Converts the obstacle in s->scratch into edges, s->shifted. */
static const sunder_i_obstacle_edge *take_edges(sunder_i_search *s, size_t *n)
{
    if (!sunder_i_reserve(&s->shifted, &s->shifted_capacity, *n, sizeof *s->shifted)) return NULL;
    *n = sunder_i_obstacle_edges(s->scratch.xy, *n, s->shifted);
    return s->shifted;
}

/* The boundary of the half-plane that the rule of rows forbids, as two rays. It demands the margin, but no more than
 * the start has. Where that is less than half the tolerance it demands half the tolerance: the start still counts as
 * free, and a wider margin gives more room for rounding. */
static const sunder_i_obstacle_edge *row_edges(sunder_i_search *s, const sunder_i_piece_pair *pair, size_t *n,
                                               double *gap)
{
    const sunder_i_row_side *row = pair->row;
    const double least = pair->relaxed ? row->least_listed : row->least, margin = s->gap - s->model->rules.gap;
    s->steps++;
    if (!sunder_i_reserve(&s->shifted, &s->shifted_capacity, 2, sizeof *s->shifted)) {
        s->failed = true;
        return NULL;
    }
    for (*n = 0; *n < 2; ++*n)
        s->shifted[*n] = (sunder_i_obstacle_edge){
            {least * row->along[0], least * row->along[1]}, {row->along[0], row->along[1]}, INFINITY};
    *gap = least > 0 ? margin : sunder_i_max(sunder_i_min(margin, -least), s->tolerance / 2);
    return s->shifted;
}

/* The edges of a shadow, which no cache keeps. */
static const sunder_i_obstacle_edge *shadow_edges(sunder_i_search *s, const sunder_i_piece_pair *pair, size_t *n,
                                                  double *gap)
{
    s->steps++;
    const size_t corners = make_obstacle(s, pair);
    if (!corners || !sunder_i_steps(1 + corners / 8) ||
        !sunder_i_reserve(&s->shifted, &s->shifted_capacity, corners + 1, sizeof *s->shifted)) {
        s->failed = true;
        return NULL;
    }
    *n = sunder_i_shadow_edges(s->scratch.xy, corners, s->shifted);
    if (*n == 0) return NULL;
    *gap = owed_by_pair(s, pair, s->shifted, *n);
    return s->shifted;
}

const sunder_i_obstacle_edge *sunder_i_search_edges(sunder_i_search *search, const sunder_i_piece_pair *pair, size_t *n,
                                                    double *gap)
{
    if (pair->row) return row_edges(search, pair, n, gap);
    if (pair->shadow) return shadow_edges(search, pair, n, gap);
    const sunder_i_obstacle_edge *edge =
        pair->relaxation ? NULL : sunder_i_obstacle_cache_find(&search->cache, pair->key, n);
    *gap = search->gap;
    search->steps++;
    if (!edge) {
        *n = make_obstacle(search, pair);
        if (*n && pair->relaxation) {
            *gap = sunder_i_min(sunder_i_search_owed(search, pair->a, pair->b),
                                sunder_i_search_shift(pair->relaxation, pair->b->feature, search->scratch.xy, *n));
            edge = take_edges(search, n);
        } else if (*n) {
            edge = sunder_i_obstacle_cache_add(&search->cache, pair->key, search->scratch.xy, n);
        }
    }
    if (!edge || !sunder_i_steps(1 + *n / 8)) search->failed = true;
    if (edge && !pair->relaxation) *gap = owed_by_pair(search, pair, edge, *n);
    return edge;
}

size_t sunder_i_search_obstacle(sunder_i_search *search, const sunder_i_piece_pair *pair, double *gap)
{
    size_t n = 0;
    sunder_i_search_edges(search, pair, &n, gap);
    n = search->failed ? 0 : make_obstacle(search, pair);
    if (n && pair->relaxation) sunder_i_search_shift(pair->relaxation, pair->b->feature, search->scratch.xy, n);
    if (n == 0) search->failed = true;
    return n;
}

bool sunder_i_search_is_clear(sunder_i_search *search, const sunder_i_piece_pair *pair, const double u[2],
                              double distance)
{
    const double *p = pair->a->box, *q = pair->b->box;
    double shift[2], most = 0, apart = -INFINITY;
    if (!pair->relaxation) return false;
    distance += sunder_i_relaxation_shift(pair->relaxation, pair->b->feature, shift);
    for (int c = 0; c < 2; c++) {
        const double v = pair->offset[c] + u[c] + shift[c];
        apart = sunder_i_max(apart, sunder_i_max(q[c] + v - p[c + 2], p[c] - (q[c + 2] + v)));
        most = sunder_i_max(most, fabs(pair->offset[c]) + fabs(u[c]) + fabs(shift[c]));
        most = sunder_i_max(most, sunder_i_max(fabs(p[c]) + fabs(p[c + 2]), fabs(q[c]) + fabs(q[c + 2])));
    }
    if (!(apart - distance > 0x1p-46 * (most + distance))) return false;
    search->steps++;
    if (!sunder_i_steps(1 + (pair->a->corners + pair->b->corners) / 8)) search->failed = true;
    return true;
}

/* ---- What they miss ---------------------------------------------------------------------------------------------- */

typedef struct missing {
    const double *u;
    double worst;
} missing;

static void measure_pieces(sunder_i_search *s, const sunder_i_piece_pair *pair, void *context)
{
    missing *m = context;
    double gap;
    size_t n;
    if (sunder_i_search_is_clear(s, pair, m->u, 0)) return;
    const sunder_i_obstacle_edge *edge = sunder_i_search_edges(s, pair, &n, &gap);
    if (edge) m->worst = sunder_i_max(m->worst, gap - sunder_i_search_support(pair, edge, n, m->u).distance);
}

/* The violation of pair (i, j) at relative position u as if no pair were relaxed. It depends on u alone, so it is kept
 * in s->measures. */
static double measure_pair(sunder_i_search *s, uint32_t i, uint32_t j, const double u[2])
{
    missing m = {u, 0};
    sunder_i_measure *known = sunder_i_measures_slot(&s->measures, s->n, i, j, u);
    if (!known) {
        s->failed = true;
        return 0;
    }
    if (sunder_i_measure_is_of(known, i, j, u) && sunder_i_stage_is_on("memo", "measures")) {
        s->steps += known->steps;
        return known->missed;
    }
    const uint64_t before = s->steps;
    sunder_i_search_piece_pairs(s, i, j, u, s->gap, false, measure_pieces, &m);
    if (!s->failed) *known = (sunder_i_measure){i, j, {u[0], u[1]}, m.worst, s->steps - before};
    return m.worst;
}

double sunder_i_search_pair(sunder_i_search *search, uint32_t i, uint32_t j, const double u[2], bool *yields)
{
    missing m = {u, measure_pair(search, i, j, u)};
    double shift;
    *yields = false;
    if (m.worst <= search->tolerance || !sunder_i_search_is_relaxed(search, search->body[i], search->body[j], &shift))
        return m.worst;
    *yields = true;
    m.worst = 0;
    sunder_i_search_piece_pairs(search, i, j, u, search->gap, true, measure_pieces, &m);
    return m.worst;
}
