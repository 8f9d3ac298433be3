/* Makes the constraints of a program, as half-planes of relative moves: one for each two pieces, of different bodies,
 * that are near each other at the reference position; and further ones for pieces that turn out to be in the way of the
 * program's solution. */
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"
#include "base/sort.h"

#include <string.h>

/* How the constraints of a pair (i, j) are made: for all pairs of pieces within gap + reach of each other at the
 * relative position `near`. The side of each is chosen at the relative position u. Pairs of pieces that have a
 * constraint in known[known_n] keep it. */
typedef struct sighting {
    const double *near, *u;
    double reach;
    bool yields;
    const sunder_i_constraint *known;
    size_t known_n;
} sighting;

typedef struct sighted {
    const sighting *at;
    uint32_t i, j;
    size_t first; /* index of the first constraint of the pair of bodies */
} sighted;

static void constrain_pieces(sunder_i_search *s, const sunder_i_piece_pair *pair, void *context)
{
    const sighted *bodies = context;
    const sighting *at = bodies->at;
    if (sunder_i_search_look_up(at->known, at->known_n, pair->key)) return;
    double gap;
    size_t n;
    if (sunder_i_search_is_clear(s, pair, at->near, at->reach + s->gap)) return;
    const sunder_i_obstacle_edge *edge = sunder_i_search_edges(s, pair, &n, &gap);
    if (!edge) return;
    sunder_i_support h = sunder_i_search_support(pair, edge, n, at->near);
    if (h.distance > (pair->shadow ? gap : sunder_i_max(s->gap, gap)) + at->reach) return;
    if (at->near != at->u) h = sunder_i_search_support(pair, edge, n, at->u);
    double d = h.support + gap;
    /* If the position violates d by at most the tolerance, d is lowered to the present value. Otherwise an exact fit
     * that is missed by a little on two sides would be a contradiction. While `roughly` is set d is not lowered, since
     * the violations of all rounds would add up; nor for neighbours in a row once they have moved by different
     * vectors, since their rule is one half-plane, which contradicts nothing. */
    const double now = h.n[0] * at->u[0] + h.n[1] * at->u[1];
    const bool keeps_d = s->roughly || (pair->row && (at->u[0] != 0 || at->u[1] != 0));
    if (!keeps_d && now < d && now >= d - s->tolerance) d = now;
    /* The move of a fixed body is a constant, which is added to d. */
    uint32_t ends[2] = {bodies->i, bodies->j};
    for (int e = 0; e < 2; e++) {
        const double *t = s->t + 2 * ends[e];
        if (s->mass[ends[e]] > 0) continue;
        d += (e ? -1 : 1) * (h.n[0] * t[0] + h.n[1] * t[1]);
        ends[e] = SUNDER_I_GROUND;
    }
    sunder_i_search_add_constraint(s, bodies->first,
                                   &(sunder_i_constraint){.i = ends[0],
                                                          .j = ends[1],
                                                          .n = {h.n[0], h.n[1]},
                                                          .d = d,
                                                          .force = sunder_i_search_force_before(s, pair->key),
                                                          .key = pair->key});
}

static void constrain_pair(sunder_i_search *s, uint32_t i, uint32_t j, const sighting *at)
{
    sighted pair = {at, i, j, s->program.n};
    sunder_i_search_piece_pairs(s, i, j, at->near, at->reach + s->gap, at->yields, constrain_pieces, &pair);
}

/* An upper bound of how much farther than the full distance a free place nearest to a pair may be from one of two
 * pieces that form a concave corner of the obstacle. Without this allowance that piece would be out of reach, and the
 * program could push the body through it. */
static double kept_too_much(const sunder_i_search *s, uint32_t i, uint32_t j)
{
    const sunder_i_model *model = s->model;
    double beyond = 0;
    for (int k = 0; k < 2; k++) {
        const sunder_i_body *body = &model->body[s->body[k ? j : i]];
        beyond = sunder_i_max(beyond, sunder_i_reach_beyond(model, model->member[body->member]));
    }
    return KEPT_TOO_MUCH * (s->gap + beyond);
}

typedef struct around {
    const double *t;
    double reach;
    bool as_it_stands; /* clashing pairs keep their present position, since they violate the distance by very little */
    bool clashing;
} around;

static void constrain_bodies(sunder_i_search *s, uint32_t i, uint32_t j, void *context)
{
    around *a = context;
    double reach = a->reach;
    double u[2] = {a->t[2 * j] - a->t[2 * i], a->t[2 * j + 1] - a->t[2 * i + 1]};
    bool yields;
    if (sunder_i_search_pair(s, i, j, u, &yields) > s->tolerance) {
        a->clashing = true;
        double place[1][2];
        if (!a->as_it_stands && sunder_i_search_free_pair(s, i, j, u, 0, 1, place)) {
            memcpy(u, place[0], sizeof u);
            reach = sunder_i_max(reach, kept_too_much(s, i, j));
        }
    }
    const double *side = u;
    double ahead[2];
    if (s->lead) {
        bool other;
        for (size_t c = 0; c < 2; c++) ahead[c] = s->lead[2 * (size_t)j + c] - s->lead[2 * (size_t)i + c];
        if (sunder_i_search_pair(s, i, j, ahead, &other) <= s->tolerance && other == yields) side = ahead;
    }
    constrain_pair(s, i, j, &(sighting){u, side, reach, yields, NULL, 0});
}

/* Sorts the constraints by their keys; most often they are sorted already. */
static void sort_constraints(sunder_i_search *s)
{
    const sunder_i_constraint *c = s->program.constraint;
    size_t k = 1;
    while (k < s->program.n && c[k - 1].key <= c[k].key) k++;
    if (k < s->program.n)
        sunder_i_sort_few(s->program.constraint, s->program.n, sizeof *s->program.constraint, sunder_i_by_constraint);
}

/* ---- Springs of rows --------------------------------------------------------------------------------------------- */

/* The key of a constraint of a spring, which tells the neighbour in a row, which of its springs, and the sign. */
static uint64_t spring_key(const sunder_i_model *model, const sunder_i_row_side *side, size_t spring, int sign)
{
    return UINT64_C(15) << 59 | (uint64_t)(side - model->row_side) << 2 | (uint64_t)spring << 1 | (uint64_t)(sign > 0);
}

/* Adds one spring as two constraints that give, one for each sign. */
static void add_spring(sunder_i_search *s, const sunder_i_row_link *link, size_t number, const sunder_i_spring *spring)
{
    const uint32_t end[2] = {link->i, link->j};
    for (int sign = -1; sign <= 1; sign += 2) {
        sunder_i_constraint c = {.i = end[0],
                                 .j = end[1],
                                 .n = {sign * spring->n[0], sign * spring->n[1]},
                                 .d = sign * (spring->n[0] * link->side->rest[0] + spring->n[1] * link->side->rest[1]),
                                 .give = 1 / (2 * spring->stiff),
                                 .key = spring_key(s->model, link->side, number, sign)};
        for (int e = 0; e < 2; e++) {
            if (end[e] != SUNDER_I_GROUND && s->mass[end[e]] > 0) continue;
            const double *t = end[e] == SUNDER_I_GROUND ? link->still : s->t + 2 * end[e];
            c.d += (e ? -1 : 1) * (c.n[0] * t[0] + c.n[1] * t[1]);
            *(e ? &c.j : &c.i) = SUNDER_I_GROUND;
        }
        c.force = sunder_i_search_force_before(s, c.key);
        sunder_i_search_add_constraint(s, s->program.n, &c);
    }
}

/* Adds the springs of the rows that bodies of the search are in. */
static void add_springs(sunder_i_search *s)
{
    sunder_i_row_link link;
    for (sunder_i_row_walk walk = {0}; sunder_i_search_next_row(s, &walk, &link) && !s->failed;) {
        sunder_i_spring spring[2];
        const size_t n = sunder_i_springs_of(s->model, link.side, spring);
        for (size_t k = 0; k < n; k++) add_spring(s, &link, k, &spring[k]);
    }
}

bool sunder_i_search_constrain(sunder_i_search *search, double reach, bool as_it_stands)
{
    sunder_i_quadratic *p = &search->program;
    /* Swaps the constraints of the last round with the old ones. */
    sunder_i_constraint *swap = search->old;
    const size_t capacity = search->old_capacity;
    search->old = p->constraint;
    search->old_n = p->n;
    search->old_capacity = p->capacity;
    p->constraint = swap;
    p->capacity = capacity;
    p->n = 0;
    around a = {.t = search->t, .reach = reach, .as_it_stands = as_it_stands};
    sunder_i_search_visit_near(search, search->t, search->gap + reach, constrain_bodies, &a);
    sunder_i_search_visit_passing(search, search->t, search->gap + reach, constrain_bodies, &a);
    for (size_t k = 0; k < search->old_n && !search->failed; k++)
        if (sunder_i_is_tangent(&search->old[k]) && search->old[k].force > 0)
            sunder_i_search_add_constraint(search, p->n, &search->old[k]);
    add_springs(search);
    sunder_i_search_constrain_shortfalls(search);
    sunder_i_search_constrain_tight(search, reach);
    sort_constraints(search);
    memcpy(search->next, search->t,
           2 * search->n * sizeof *search->t); /* if the patience has ended, the search stays in its present place */
    return a.clashing || sunder_i_search_is_beyond(search, search->t);
}

/* Adds constraints for the pieces that clash at s->next and have none in known[known_n], which is sorted. Their sides
 * are those of the reference position s->t. Pairs that clash there, too, are left out. */
static void constrain_met(sunder_i_search *s, const sunder_i_constraint *known, size_t known_n)
{
    const uint64_t before = s->steps;
    s->seen = sunder_i_search_find_clashes(s, s->next);
    s->seen_steps = s->steps - before;
    const size_t clashes = s->clashes;
    for (size_t c = 0; c < clashes && !s->failed; c++) {
        const uint32_t i = s->clash[c].i, j = s->clash[c].j;
        double u[2] = {s->t[2 * j] - s->t[2 * i], s->t[2 * j + 1] - s->t[2 * i + 1]};
        bool yields;
        if (sunder_i_search_pair(s, i, j, u, &yields) > s->tolerance) continue;
        const double w[2] = {s->next[2 * j] - s->next[2 * i], s->next[2 * j + 1] - s->next[2 * i + 1]};
        constrain_pair(s, i, j, &(sighting){w, u, -s->tolerance, yields, known, known_n});
    }
}

bool sunder_i_search_constrain_further(sunder_i_search *search)
{
    const bool beyond = sunder_i_search_constrain_limits(search);
    sort_constraints(search);
    const size_t before = search->program.n;
    sunder_i_constraint few[FEW_KNOWN], *known = before <= FEW_KNOWN ? few : sunder_i_alloc(before, sizeof *known);
    if (!known) {
        search->failed = true;
        return false;
    }
    if (before) memcpy(known, search->program.constraint, before * sizeof *known);
    constrain_met(search, known, before);
    const bool more = beyond || search->program.n > before;
    if (known != few) sunder_i_free(known);
    sort_constraints(search);
    return more;
}
