/* The same question for one relative move: for a single movable body among fixed things, or for two bodies by
 * themselves.
 *
 * Then the claims leave a convex polygon of relative moves, and each thing that forbids moves covers a part of it. So
 * the half-planes of all pieces within reach are computed once, and the polygon is divided by those of one piece: of
 * the pieces that cover its middle, the one that covers most of the polygon. Each part is divided again, by the pieces
 * that meet it. An empty part is a leaf: the two or three claims whose lines bound it, with the limit, contradict each
 * other. If no piece covers the middle, it is a place where nothing is forbidden.
 *
 * The polygon is in doubles, and decides nothing: it selects the claims to be tested (program.c). The record is a tree
 * like any other.
 *
 * A block of eighty houses between five roads has some hundred pieces in its way, thirty of which suffice. By
 * candidates (branches.c) the whole block would be examined again in each node, and the proof would take a hundred
 * times as long. */
#include "displacement/prove/proofs/plane.h"

#include <math.h>
#include <string.h>

/* ---- Division ---------------------------------------------------------------------------------------------------- */

/* Do the claim and one or two others leave nothing, or only a line or a point that something closed covers? */
static bool is_shut(sunder_i_plane *g, uint32_t claim)
{
    return g->c->subproblem->exact && sunder_i_branching_is_shut(g->c, claim);
}

/* Is it proved that the claim and the claims of two sides, or some of them, contradict the limits? */
static bool contradicts_limits(sunder_i_plane *g, uint32_t claim, const uint32_t by[2])
{
    sunder_i_branching *c = g->c;
    g->c->looked += 4;
    if (is_shut(g, claim)) return true;
    if ((c->claim[claim].d > g->reach || c->subproblem->exact) && sunder_i_branching_contradict(c, &claim, 1))
        return true;
    const uint32_t all[3] = {claim, by[0], by[1]};
    for (size_t k = 0; k < 2; k++) {
        const uint32_t two[2] = {claim, by[k]};
        if (by[k] != SUNDER_I_NO_CLAIM && by[k] != claim && sunder_i_branching_contradict(c, two, 2)) return true;
    }
    return by[0] != SUNDER_I_NO_CLAIM && by[1] != SUNDER_I_NO_CLAIM && by[0] != claim && by[1] != claim &&
           sunder_i_branching_contradict(c, all, 3);
}

/* Is it proved that the region is beyond the limits? by: the claims of its sides nearest to 0. */
static bool is_out_of_reach(sunder_i_plane *g, const uint32_t by[2])
{
    for (size_t k = 0; k < 2; k++) {
        const uint32_t other[2] = {by[1 - k], SUNDER_I_NO_CLAIM};
        if (by[k] != SUNDER_I_NO_CLAIM && contradicts_limits(g, by[k], other)) return true;
    }
    return false;
}

/* A region's number among those of the present question, and among those of the cached one. */
typedef struct place {
    uint32_t made, known;
} place;

static sunder_status divide_region(sunder_i_plane *g, const sunder_i_plane_region *r, place at, unsigned level,
                                   sunder_i_verdict *verdict, sunder_i_levels *levels, size_t *root, sunder_error *err);

/* The state while the cases of a node are examined. */
typedef struct cases {
    sunder_i_plane_region rest; /* the region behind the lines of the cases up to now */
    bool none;                  /* that region is empty, which `claim` and the claims of two sides `by` prove */
    uint32_t claim, by[2];
    unsigned thin; /* the number of times that only a sliver was left */
    place below;   /* the numbers of the first case's region */
} cases;

/* Is it proved that the claim and the claims of two sides contradict the limits? `by` are the sides next to what was
 * cut off. If many lines meet in a corner they may be the wrong two: then `by` is set to any other two that contradict
 * the claim, or to none. */
static bool any_contradict(sunder_i_plane *g, uint32_t claim, uint32_t by[2])
{
    if (contradicts_limits(g, claim, by)) return true;
    for (by[1] = 0; by[1] < g->c->claims; by[1]++)
        for (by[0] = 0; by[0] < by[1]; by[0]++)
            if (contradicts_limits(g, claim, by)) return true;
    by[0] = by[1] = SUNDER_I_NO_CLAIM;
    return false;
}

/* Clips the region to n.u >= d. Returns false if nothing is left, which the claim and the sides `by` prove, if anything
 * does.
 *
 * If pieces touch, as the parts of a house do, two claims may leave a line or a point: no area, and no contradiction. A
 * piece that covers the common boundary of the two shows that it is forbidden, if the claims are taken to say slightly
 * less, here and in no proof. A piece that only begins there shows it if it is closed, and if all three lines are exact
 * (subproblem->exact). */
static bool keep_side(sunder_i_plane *g, sunder_i_plane_region *r, const double n[2], double d, uint32_t claim,
                      uint32_t by[2], unsigned *thin)
{
    by[0] = by[1] = SUNDER_I_NO_CLAIM;
    if (is_shut(g, claim)) return false;
    if (sunder_i_plane_clip(r, n, d, claim, by)) return true;
    if (any_contradict(g, claim, by)) return false;
    g->seam = true;
    if (g->thin + *thin >= MOST_SLIVERS) return false;
    if (!sunder_i_plane_clip(r, n, d - ldexp(SLIVER * g->reach, -(int)(g->thin + *thin)), claim, by)) return false;
    ++*thin;
    return true;
}

/* Examines one case: beyond this line, and behind those before it. *dead is set if the case is infeasible by itself. */
static sunder_status divide_case(sunder_i_plane *g, cases *s, size_t node, size_t half_plane, unsigned level,
                                 bool *dead, sunder_i_verdict *verdict, sunder_i_levels *levels, size_t *root,
                                 sunder_error *err)
{
    sunder_i_branching *c = g->c;
    const sunder_i_half_plane *w = &c->half_plane[half_plane];
    if (!sunder_i_branching_push(c, g->i, g->j, node, half_plane, false, level)) return sunder_i_failure_cause(err);
    const uint32_t last = (uint32_t)c->claims - 1;
    uint32_t by[2];
    unsigned thin = s->thin;
    sunder_i_plane_region part = s->rest;
    *dead = s->none || !keep_side(g, &part, w->n, w->d, last, by, &thin);
    if (!*dead) {
        const uint32_t k = (uint32_t)(half_plane - c->node[node].half_plane);
        const place at = {s->below.made == SUNDER_I_NO_CHOICE ? s->below.made : s->below.made + k,
                          s->below.known == SUNDER_I_NO_CHOICE ? s->below.known : s->below.known + k};
        g->thin += thin;
        const sunder_status status = divide_region(g, &part, at, level + 1, verdict, levels, root, err);
        g->thin -= thin;
        return status;
    }
    *verdict = (s->none ? contradicts_limits(g, s->claim, s->by) : contradicts_limits(g, last, by))
                   ? SUNDER_I_INFEASIBLE
                   : SUNDER_I_UNKNOWN;
    if (*verdict == SUNDER_I_INFEASIBLE && !sunder_i_branching_add_leaf(c, levels, root))
        return sunder_i_failure_cause(err);
    return SUNDER_OK;
}

/* Continues behind the line of this case. */
static bool go_behind(sunder_i_plane *g, cases *s, size_t node, size_t half_plane, unsigned level)
{
    const sunder_i_half_plane *w = &g->c->half_plane[half_plane];
    const double back[2] = {-w->n[0], -w->n[1]};
    if (!sunder_i_branching_push(g->c, g->i, g->j, node, half_plane, true, level)) return false;
    if (s->none) return true;
    s->claim = (uint32_t)g->c->claims - 1;
    s->none = !keep_side(g, &s->rest, back, -w->d, s->claim, s->by, &s->thin);
    return true;
}

static sunder_status divide_all(sunder_i_plane *g, const sunder_i_plane_region *r, size_t node, place first,
                                unsigned level, sunder_i_verdict *verdict, sunder_i_levels *levels, size_t *root,
                                sunder_error *err)
{
    sunder_i_branching *c = g->c;
    const size_t begin = c->node[node].half_plane, end = begin + c->node[node].half_planes, claims = c->claims;
    cases s = {.rest = *r, .below = first};
    sunder_status status = SUNDER_OK;
    memset(levels, 0, sizeof *levels);
    *root = node;
    *verdict = SUNDER_I_INFEASIBLE;
    for (size_t half_plane = begin; half_plane < end; half_plane++) {
        sunder_i_levels used;
        size_t below = 0;
        bool dead = false;
        const size_t before = c->claims;
        status = divide_case(g, &s, node, half_plane, level, &dead, verdict, &used, &below, err);
        if (status || *verdict != SUNDER_I_INFEASIBLE) break;
        c->half_plane[half_plane].next = below;
        if (!sunder_i_levels_has(&used, level)) { /* the proof does not use the claim of this case, so it proves the
                                                   * node */
            *root = below;
            *levels = used;
            break;
        }
        sunder_i_levels_join(levels, &used);
        c->claims = before;
        if (!dead && !go_behind(g, &s, node, half_plane, level)) status = sunder_i_failure_cause(err);
        if (status) break;
    }
    sunder_i_levels_drop(levels, level);
    c->claims = claims;
    return status;
}

/* The obstacle or chord that divides a region. */
typedef struct divider {
    const sunder_i_plane_obstacle *obstacle; /* NULL: nothing forbids the middle */
    size_t half_planes;
    sunder_i_chord chord;
    bool across;
    place below;
} divider;

/* Is the place forbidden by the rule of rows, for the two bodies or, with one moving body, for it and one that does not
 * move? If so, sets *missed, and the half-plane is in c->scratch. */
static bool find_row(sunder_i_plane *g, const double u[2], sunder_i_violation *missed)
{
    sunder_i_branching *c = g->c;
    const sunder_i_extras *has = c->model->body[g->p].has;
    bool found = false;
    for (uint32_t k = has->row_side; k < has->row_side + has->row_sides && c->subproblem->rows && !found; k++) {
        const uint32_t other = c->model->row_side[k].other;
        if (g->q == SUNDER_I_GROUND ? sunder_i_limit_of(&c->model->body[other]) > 0 : other != g->q) continue;
        found = sunder_i_branching_misses_row(c, g->p, other, u, missed) &&
                sunder_i_branching_row_half_plane(c, g->p, other);
    }
    return found;
}

static bool find_divider(sunder_i_plane *g, const sunder_i_plane_region *r, place at, const double middle[2],
                         divider *by)
{
    sunder_i_branching *c = g->c;
    double share;
    *by = (divider){.obstacle = sunder_i_plane_choose(g, r, middle, sunder_i_plane_choices_known(g, at.known), &share)};
    const sunder_i_plane_obstacle *o = by->obstacle;
    const uint32_t chosen = o ? (uint32_t)(o - g->kept->obstacle) : SUNDER_I_NO_CHOICE;
    by->half_planes = o ? o->half_planes : 0;
    if (c->failed || !sunder_i_plane_choices_add(g, at.made, chosen, by->half_planes, share, &by->below.made))
        return false;
    by->below.known = o ? sunder_i_plane_choices_below(g, at.known, chosen) : SUNDER_I_NO_CHOICE;
    if (o) return true;
    by->below.made = SUNDER_I_NO_CHOICE;
    by->obstacle = sunder_i_plane_find_chord(g, middle, &by->chord, &by->half_planes);
    by->across = by->obstacle;
    if (!by->obstacle && !c->failed && !(c->subproblem->coarse > 0))
        by->obstacle = sunder_i_plane_choose_closely(g, middle, &by->half_planes);
    return !c->failed;
}

static sunder_status divide_region(sunder_i_plane *g, const sunder_i_plane_region *r, place at, unsigned level,
                                   sunder_i_verdict *verdict, sunder_i_levels *levels, size_t *root, sunder_error *err)
{
    sunder_i_branching *c = g->c;
    double nearest[2] = {0, 0}, middle[2];
    uint32_t by[2] = {SUNDER_I_NO_CLAIM, SUNDER_I_NO_CLAIM};
    *verdict = SUNDER_I_UNKNOWN;
    if (level == SUNDER_I_LEVELS || c->looked > PLANE_EFFORT) return SUNDER_OK;
    if (sunder_i_plane_distance(r, nearest, by) > g->reach) {
        if (!is_out_of_reach(g, by)) return SUNDER_OK;
        *verdict = SUNDER_I_INFEASIBLE;
        return sunder_i_branching_add_leaf(c, levels, root) ? SUNDER_OK : sunder_i_failure_cause(err);
    }
    sunder_i_plane_middle(r, nearest, g->reach, middle);
    divider d;
    sunder_i_violation v;
    size_t node;
    if (!find_divider(g, r, at, middle, &d)) return sunder_i_failure_cause(err);
    const sunder_i_plane_obstacle *o = d.obstacle;
    if (o) {
        v = (sunder_i_violation){
            .a = o->a, .b = o->b, .clearance = o->clearance, .shadow = o->shadow, .chord = d.across ? &d.chord : NULL};
    } else if (find_row(g, middle, &v)) {
        d.half_planes = 1;
    } else {
        if (c->failed) return sunder_i_failure_cause(err);
        if (g->thin) return SUNDER_OK; /* a sliver is forbidden, up to rounding */
        *verdict = SUNDER_I_FEASIBLE;
        g->seam = sunder_i_plane_is_at_border(g, middle);
        memcpy(g->free, middle, sizeof middle);
        return SUNDER_OK;
    }
    if (!sunder_i_branching_add_branch(c, &v, d.half_planes, &node)) return sunder_i_failure_cause(err);
    return divide_all(g, r, node, d.below, level, verdict, levels, root, err);
}

/* ---- The question ------------------------------------------------------------------------------------------------ */

/* Finds the bodies of the relative move: the one that may move, or the two, in whichever order they are given. Returns
 * false if there are more. */
static bool find_bodies(const sunder_i_branching *c, sunder_i_plane *g)
{
    const sunder_i_subproblem *asked = c->subproblem;
    size_t moving = 0;
    g->p = g->q = SUNDER_I_GROUND;
    for (size_t k = 0; k < asked->bodies; k++) {
        if (!(sunder_i_limit_of(&c->model->body[asked->body[k]]) > 0)) continue;
        moving++;
        *(g->p == SUNDER_I_GROUND ? &g->p : &g->q) = asked->body[k];
    }
    if (moving == 2 && g->p > g->q) {
        const uint32_t p = g->p;
        g->p = g->q;
        g->q = p;
    }
    return moving == 1 || moving == 2;
}

/* Does a free relative move of p and q answer the whole question? It does if the question lists its features, has no
 * reserve, and lists none of a movable body besides p and q (if q moves, none of any other body), and if no sides of
 * barriers matter besides. */
static bool is_all(const sunder_i_branching *c, const sunder_i_plane *g)
{
    const sunder_i_subproblem *asked = c->subproblem;
    const sunder_i_model *model = c->model;
    if (!asked->feature || asked->reserves) return false;
    if (g->q != SUNDER_I_GROUND && model->sides && asked->every_side && !asked->ignore_paths) return false;
    for (size_t k = 0; k < asked->features; k++) {
        const uint32_t body = model->body_of[asked->feature[k]];
        if (body != g->p && body != g->q && (g->q != SUNDER_I_GROUND || sunder_i_limit_of(&model->body[body]) > 0))
            return false;
    }
    return true;
}

/* Lists the obstacles. Returns false if memory is out. */
static bool begin_plane(sunder_i_branching *c, sunder_i_plane *g, sunder_i_planes *own)
{
    g->i = sunder_i_branching_join(c, g->p);
    g->j = g->q == SUNDER_I_GROUND ? SUNDER_I_GROUND : sunder_i_branching_join(c, g->q);
    for (size_t k = 0; k < c->bodies && !c->failed; k++) g->reach += c->limit[k];
    sunder_i_plane_disc(&g->disc, g->reach);
    sunder_i_planes *planes = c->subproblem->planes ? c->subproblem->planes : own;
    return !c->failed && (g->kept = sunder_i_planes_take(planes, g)) != NULL && sunder_i_plane_list(g) &&
           sunder_i_plane_index_begin(g);
}

static void end_plane(sunder_i_branching *c, sunder_i_plane *g, sunder_i_planes *own, sunder_i_plane_answer *answer)
{
    answer->p = g->p;
    answer->q = g->q;
    memcpy(answer->u, g->free, sizeof g->free);
    answer->free = answer->verdict == SUNDER_I_FEASIBLE;
    answer->seam = g->seam;
    if (answer->free && !is_all(c, g)) answer->verdict = SUNDER_I_UNKNOWN;
    sunder_i_planes_clear(own);
    sunder_i_free_all(g->run, g->place, g->few, g->fresh);
    sunder_i_plane_choices_free(&g->made);
}

sunder_status sunder_i_branching_plane(sunder_i_branching *branching, sunder_i_plane_answer *answer, sunder_error *err)
{
    *answer = (sunder_i_plane_answer){.verdict = SUNDER_I_UNKNOWN};
    sunder_i_plane g = {.c = branching};
    sunder_i_planes own = {0};
    if (!find_bodies(branching, &g)) return SUNDER_OK;
    const bool ok = begin_plane(branching, &g, &own) && sunder_i_plane_choices_begin(&g);
    sunder_status status = ok ? SUNDER_OK : sunder_i_failure_cause(err);
    if (ok) {
        sunder_i_levels levels;
        const place all = {0, 0};
        status = divide_region(&g, &g.disc, all, 0, &answer->verdict, &levels, &answer->root, err);
        if (!status && !sunder_i_plane_choices_end(&g, answer->verdict == SUNDER_I_INFEASIBLE))
            status = sunder_i_failure_cause(err);
    }
    end_plane(branching, &g, &own, answer);
    return status;
}

sunder_status sunder_i_branching_plane_try(sunder_i_branching *branching, const double (*at)[2], size_t n,
                                           sunder_i_plane_answer *answer, sunder_error *err)
{
    *answer = (sunder_i_plane_answer){.verdict = SUNDER_I_UNKNOWN};
    sunder_i_plane g = {.c = branching};
    sunder_i_planes own = {0};
    if (!n || !find_bodies(branching, &g)) return SUNDER_OK;
    const bool ok = begin_plane(branching, &g, &own);
    for (size_t k = 0; k < n && ok && !branching->failed && answer->verdict == SUNDER_I_UNKNOWN; k++) {
        sunder_i_violation missed;
        if (!sunder_i_plane_is_free(&g, at[k]) || find_row(&g, at[k], &missed) ||
            sunder_i_plane_is_at_border(&g, at[k]))
            continue;
        answer->verdict = SUNDER_I_FEASIBLE;
        memcpy(g.free, at[k], sizeof g.free);
    }
    const sunder_status status = ok && !branching->failed ? SUNDER_OK : sunder_i_failure_cause(err);
    end_plane(branching, &g, &own, answer);
    return status;
}

bool sunder_i_branching_plane_bodies(const sunder_i_branching *branching, uint32_t *p, uint32_t *q)
{
    sunder_i_plane g = {.c = NULL};
    if (!find_bodies(branching, &g)) return false;
    *p = g.p;
    *q = g.q;
    return true;
}
