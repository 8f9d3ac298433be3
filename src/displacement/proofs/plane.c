/* The same question in one plane: of a body that alone may move, among what stands, or of two by themselves, whose
 * relative move is all that matters.
 *
 * Then what claims leave of the moves is a convex polygon, and whatever forbids one of them covers a part of it. So all
 * pieces that are within reach have their ways made once, and the polygon is divided: by the ways of the piece that,
 * of those which hold its middle, takes most of it. What each way leaves is asked for again, of the pieces that meet
 * it; what none leaves a thing of is a leaf, and the two or three claims whose lines bound what was there, with the
 * limit, contradict each other. A middle that no piece holds is a place where nothing is forbidden.
 *
 * The polygon is in doubles, and decides nothing: it tells which claims to ask about (program.c). What is recorded is a
 * tree like any other.
 *
 * A block of eighty houses between five roads has some hundred pieces in its way, of which thirty are enough: a
 * candidate at a time (branches.c), all of the block is looked at again in each node, and the proof takes a hundred
 * times as long. */
#include "displacement/proofs/plane.h"

#include <math.h>
#include <string.h>

/* ---- Dividing ---------------------------------------------------------------------------------------------------- */

/* Does it hold the place, in its box, and all about it as far as that? */
static bool holds(const sunder_i_plane *g, const sunder_i_plane_obstacle *o, const double u[2], double about)
{
    for (const sunder_i_way *w = g->kept->way + o->way, *end = w + o->ways; w < end; w++)
        if (!(sunder_i_plane_at(w->n, u) < w->d - about)) return false;
    return true;
}

/* No more of what is in the box is in that one. */
static double most_shared(const double box[4], const double of[4])
{
    const double x = (box[2] < of[2] ? box[2] : of[2]) - (box[0] > of[0] ? box[0] : of[0]),
                 y = (box[3] < of[3] ? box[3] : of[3]) - (box[1] > of[1] ? box[1] : of[1]);
    return x * y * (1 + 0x1p-30);
}

static double shared(const sunder_i_plane *g, const sunder_i_plane_obstacle *o, const sunder_i_plane_region *r)
{
    const sunder_i_way *way = g->kept->way;
    sunder_i_plane_region part = *r;
    uint32_t by[2];
    for (size_t k = o->way; k < o->way + o->ways; k++) {
        const double back[2] = {-way[k].n[0], -way[k].n[1]};
        if (!sunder_i_plane_clip(&part, back, -way[k].d, SUNDER_I_NO_CLAIM, by)) return 0;
    }
    return sunder_i_plane_area(&part);
}

/* Of those in whose boxes the place is, the one that holds it and takes most of the region; its ways are in c->scratch
 * then. NULL: none does. */
static const sunder_i_plane_obstacle *choose(sunder_i_plane *g, const sunder_i_plane_region *r, const double box[4],
                                             const double u[2], size_t *ways)
{
    const sunder_i_plane_obstacle *best = NULL;
    const double whole = sunder_i_plane_area(r) * (1 - 0x1p-30);
    const double about = g->thin ? 2 * SLIVER * g->reach : 0; /* what begins in a seam does not cover it */
    double most = -1;
    for (size_t k = 0; k < g->about_place && most < whole; k++) {
        const uint32_t at = g->place[k];
        const sunder_i_plane_obstacle *o = &g->kept->obstacle[at];
        if (most_shared(box, g->kept->box + 4 * (size_t)at) <= most || !holds(g, o, u, about)) continue;
        g->c->looked += o->ways;
        const double share = shared(g, o, r);
        if (share <= most) continue;
        most = share;
        best = o;
    }
    g->c->looked += g->about_place / BOXES_A_STEP;
    if (!best) return NULL;
    if (!sunder_i_reserve(&g->c->scratch, &g->c->scratch_capacity, best->ways, sizeof *g->c->scratch)) {
        g->c->failed = true;
        return NULL;
    }
    memcpy(g->c->scratch, g->kept->way + best->way, best->ways * sizeof *g->c->scratch);
    *ways = best->ways;
    return best;
}

/* The same of all, by lines that are made for the place. */
static const sunder_i_plane_obstacle *choose_closely(sunder_i_plane *g, const double u[2], size_t *ways)
{
    sunder_i_branching *c = g->c;
    for (size_t k = 0; k < g->obstacles; k++) {
        const sunder_i_plane_obstacle *o = &g->kept->obstacle[g->list[k]];
        double box[4];
        sunder_i_box_grow(g->kept->box + 4 * (size_t)g->list[k], fmax(o->clearance, 0), box);
        c->looked++;
        if (o->shadow || !(o->clearance > 0) || u[0] < box[0] || u[0] > box[2] || u[1] < box[1] || u[1] > box[3])
            continue;
        *ways = sunder_i_branching_fill_ways(c, &c->model->body[g->p], o->a, &c->model->body[o->q], o->b, o->clearance,
                                             false, u);
        if (c->failed || sunder_i_branching_depth(c, *ways, u) > 2 * c->hair) return o;
    }
    return NULL;
}

/* Do the claim and those two sides, or some of them, contradict the limits? */
static bool contradict(sunder_i_plane *g, uint32_t claim, const uint32_t by[2])
{
    sunder_i_branching *c = g->c;
    g->c->looked += 4;
    if (c->claim[claim].d > g->reach && sunder_i_branching_contradict(c, &claim, 1)) return true;
    const uint32_t all[3] = {claim, by[0], by[1]};
    for (size_t k = 0; k < 2; k++) {
        const uint32_t two[2] = {claim, by[k]};
        if (by[k] != SUNDER_I_NO_CLAIM && by[k] != claim && sunder_i_branching_contradict(c, two, 2)) return true;
    }
    return by[0] != SUNDER_I_NO_CLAIM && by[1] != SUNDER_I_NO_CLAIM && by[0] != claim && by[1] != claim &&
           sunder_i_branching_contradict(c, all, 3);
}

/* Is the region beyond the limits? */
static bool is_out_of_reach(sunder_i_plane *g, const uint32_t by[2])
{
    for (size_t k = 0; k < 2; k++) {
        const uint32_t other[2] = {by[1 - k], SUNDER_I_NO_CLAIM};
        if (by[k] != SUNDER_I_NO_CLAIM && contradict(g, by[k], other)) return true;
    }
    return false;
}

static sunder_status divide(sunder_i_plane *g, const sunder_i_plane_region *r, size_t first, unsigned level,
                            sunder_i_verdict *verdict, sunder_i_levels *levels, size_t *root, sunder_error *err);

/* What the cases of a node say, as they are gone through. */
typedef struct cases {
    sunder_i_plane_region rest; /* behind the ways so far */
    bool none;                  /* that is nothing, by what this claim and sides say */
    uint32_t claim, by[2];
    unsigned thin; /* how often it was nothing but a sliver */
} cases;

/* The same where by are the sides that bound what was there. Where many lines meet in a corner they may be the wrong
 * two: then any others are taken that do, or none. */
static bool any_contradict(sunder_i_plane *g, uint32_t claim, uint32_t by[2])
{
    if (contradict(g, claim, by)) return true;
    for (by[1] = 0; by[1] < g->c->claims; by[1]++)
        for (by[0] = 0; by[0] < by[1]; by[0]++)
            if (contradict(g, claim, by)) return true;
    by[0] = by[1] = SUNDER_I_NO_CLAIM;
    return false;
}

/* Keeps what has n.u >= d. False: that is nothing, which the claim and sides prove, if anything does.
 *
 * Where pieces touch, as the parts of a house do, what two claims leave is a line, or a point: no area, and no
 * contradiction. What covers the seam shows it, if the claims are taken for a little less than they say, here and in
 * no proof. */
static bool keep(sunder_i_plane *g, sunder_i_plane_region *r, const double n[2], double d, uint32_t claim,
                 uint32_t by[2], unsigned *thin)
{
    if (sunder_i_plane_clip(r, n, d, claim, by)) return true;
    if (any_contradict(g, claim, by) || g->thin + *thin >= MOST_SLIVERS) return false;
    if (!sunder_i_plane_clip(r, n, d - ldexp(SLIVER * g->reach, -(int)(g->thin + *thin)), claim, by)) return false;
    ++*thin;
    return true;
}

/* One case: beyond this way, and behind those before it. *dead: it is void by itself. */
static sunder_status divide_case(sunder_i_plane *g, cases *s, size_t node, size_t way, size_t first, unsigned level,
                                 bool *dead, sunder_i_verdict *verdict, sunder_i_levels *levels, size_t *root,
                                 sunder_error *err)
{
    sunder_i_branching *c = g->c;
    const sunder_i_way *w = &c->way[way];
    if (!sunder_i_branching_push(c, g->i, g->j, node, way, false, level)) return sunder_i_no_memory(err);
    const uint32_t last = (uint32_t)c->claims - 1;
    uint32_t by[2];
    unsigned thin = s->thin;
    sunder_i_plane_region part = s->rest;
    *dead = s->none || !keep(g, &part, w->n, w->d, last, by, &thin);
    if (!*dead) {
        g->thin += thin;
        const sunder_status status = divide(g, &part, first, level + 1, verdict, levels, root, err);
        g->thin -= thin;
        return status;
    }
    *verdict =
        (s->none ? contradict(g, s->claim, s->by) : contradict(g, last, by)) ? SUNDER_I_INFEASIBLE : SUNDER_I_UNKNOWN;
    if (*verdict == SUNDER_I_INFEASIBLE && !sunder_i_branching_add_leaf(c, levels, root))
        return sunder_i_no_memory(err);
    return SUNDER_OK;
}

/* What comes now is behind this way. */
static bool go_behind(sunder_i_plane *g, cases *s, size_t node, size_t way, unsigned level)
{
    const sunder_i_way *w = &g->c->way[way];
    const double back[2] = {-w->n[0], -w->n[1]};
    if (!sunder_i_branching_push(g->c, g->i, g->j, node, way, true, level)) return false;
    if (s->none) return true;
    s->claim = (uint32_t)g->c->claims - 1;
    s->none = !keep(g, &s->rest, back, -w->d, s->claim, s->by, &s->thin);
    return true;
}

static sunder_status divide_all(sunder_i_plane *g, const sunder_i_plane_region *r, size_t node, size_t first,
                                unsigned level, sunder_i_verdict *verdict, sunder_i_levels *levels, size_t *root,
                                sunder_error *err)
{
    sunder_i_branching *c = g->c;
    const size_t begin = c->node[node].way, end = begin + c->node[node].ways, claims = c->claims;
    cases s = {.rest = *r};
    sunder_status status = SUNDER_OK;
    memset(levels, 0, sizeof *levels);
    *root = node;
    *verdict = SUNDER_I_INFEASIBLE;
    for (size_t way = begin; way < end; way++) {
        sunder_i_levels used;
        size_t below = 0;
        bool dead = false;
        const size_t before = c->claims;
        status = divide_case(g, &s, node, way, first, level, &dead, verdict, &used, &below, err);
        if (status || *verdict != SUNDER_I_INFEASIBLE) break;
        c->way[way].next = below;
        if (!sunder_i_levels_has(&used, level)) { /* it does not use what the case says: it proves the node */
            *root = below;
            *levels = used;
            break;
        }
        sunder_i_levels_join(levels, &used);
        c->claims = before;
        if (!dead && !go_behind(g, &s, node, way, level)) status = sunder_i_no_memory(err);
        if (status) break;
    }
    sunder_i_levels_drop(levels, level);
    c->claims = claims;
    return status;
}

/* Lists those of the list from `first` on that meet the region, behind it, by their boxes, and in whose boxes the place
 * is: to ask more of tens of thousands takes longer than to look at them once more. False if memory is out. */
static bool list_meeting(sunder_i_plane *g, const double box[4], const double u[2], size_t first)
{
    const size_t end = g->listed;
    if (!sunder_i_reserve(&g->list, &g->list_capacity, 2 * end - first + 1, sizeof *g->list) ||
        !sunder_i_reserve(&g->place, &g->place_capacity, end - first + 1, sizeof *g->place))
        return false;
    size_t n = 0;
    /* No branches: they would be guessed wrong half of the time. */
    for (size_t k = first; k < end; k++) {
        const uint32_t at = g->list[k];
        const double *b = g->kept->box + 4 * (size_t)at;
        g->list[g->listed] = g->place[n] = at;
        g->listed += (size_t)((b[0] <= box[2]) & (b[2] >= box[0]) & (b[1] <= box[3]) & (b[3] >= box[1]));
        n += (size_t)((b[0] <= u[0]) & (b[2] >= u[0]) & (b[1] <= u[1]) & (b[3] >= u[1]));
    }
    g->about_place = n;
    g->c->looked += (end - first) / BOXES_A_STEP;
    return true;
}

static sunder_status divide(sunder_i_plane *g, const sunder_i_plane_region *r, size_t first, unsigned level,
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
        return sunder_i_branching_add_leaf(c, levels, root) ? SUNDER_OK : sunder_i_no_memory(err);
    }
    const size_t listed = g->listed;
    double box[4];
    sunder_i_box_clear(box);
    for (uint32_t k = 0; k < r->n; k++) sunder_i_box_include(box, r->xy + 2 * k);
    sunder_i_plane_middle(r, nearest, g->reach, middle);
    if (!list_meeting(g, box, middle, first)) return sunder_i_no_memory(err);
    size_t ways = 0, node;
    const sunder_i_plane_obstacle *o = choose(g, r, box, middle, &ways);
    sunder_i_chord chord;
    bool across = false;
    if (!o && !c->failed) across = (o = sunder_i_plane_find_chord(g, middle, &chord, &ways)) != NULL;
    if (!o && !c->failed && !(c->subproblem->coarse > 0)) o = choose_closely(g, middle, &ways);
    sunder_status status = SUNDER_OK;
    if (o && !c->failed) {
        const sunder_i_violation v = {
            .a = o->a, .b = o->b, .clearance = o->clearance, .shadow = o->shadow, .chord = across ? &chord : NULL};
        if (sunder_i_branching_add_branch(c, &v, ways, &node))
            status = divide_all(g, r, node, listed, level, verdict, levels, root, err);
        else
            c->failed = true;
    } else if (!g->thin) { /* a sliver is forbidden, by a hair */
        *verdict = SUNDER_I_FEASIBLE;
        memcpy(g->free, middle, sizeof middle);
    }
    g->listed = listed;
    return c->failed ? sunder_i_no_memory(err) : status;
}

/* ---- The question ------------------------------------------------------------------------------------------------ */

/* Which two bodies it is about: the one that may move, or the two, in whichever order they are asked about. False:
 * there are more. */
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

/* Does nobody else have a say? */
static bool is_all(const sunder_i_branching *c, const sunder_i_plane *g)
{
    const sunder_i_subproblem *asked = c->subproblem;
    const sunder_i_model *model = c->model;
    if (!asked->feature || asked->reserves) return false;
    if (g->q != SUNDER_I_GROUND && model->sides && asked->every_side && !asked->any_way) return false;
    for (size_t k = 0; k < asked->features; k++) {
        const uint32_t body = model->body_of[asked->feature[k]];
        if (body != g->p && body != g->q && (g->q != SUNDER_I_GROUND || sunder_i_limit_of(&model->body[body]) > 0))
            return false;
    }
    return true;
}

sunder_status sunder_i_branching_plane(sunder_i_branching *c, sunder_i_plane_answer *answer, sunder_error *err)
{
    *answer = (sunder_i_plane_answer){.verdict = SUNDER_I_UNKNOWN};
    sunder_i_plane g = {.c = c};
    if (!find_bodies(c, &g)) return SUNDER_OK;
    g.i = sunder_i_branching_join(c, g.p);
    g.j = g.q == SUNDER_I_GROUND ? SUNDER_I_GROUND : sunder_i_branching_join(c, g.q);
    for (size_t k = 0; k < c->bodies && !c->failed; k++) g.reach += c->limit[k];
    sunder_i_plane_disc(&g.disc, g.reach);
    sunder_i_planes own = {0}, *planes = c->subproblem->planes ? c->subproblem->planes : &own;
    const bool ok = !c->failed && (g.kept = sunder_i_planes_take(planes, &g)) != NULL && sunder_i_plane_list(&g);
    sunder_status status = ok ? SUNDER_OK : sunder_i_no_memory(err);
    if (ok) {
        sunder_i_levels levels;
        status = divide(&g, &g.disc, 0, 0, &answer->verdict, &levels, &answer->root, err);
    }
    answer->p = g.p;
    answer->q = g.q;
    memcpy(answer->u, g.free, sizeof g.free);
    answer->free = answer->verdict == SUNDER_I_FEASIBLE;
    if (answer->free && !is_all(c, &g)) answer->verdict = SUNDER_I_UNKNOWN;
    sunder_i_planes_clear(&own);
    sunder_i_free(g.list);
    sunder_i_free(g.place);
    return status;
}
