/* The obstacles in the plane of one relative move: pairs of pieces that must keep a distance, and pieces that anchors
 * may not pass. Which pieces these are depends on the model alone, and is found once for all questions about the two
 * bodies. The distance that they have to keep depends on the question. It is the same for all obstacles between the
 * same two things, which form a run. The half-planes of an obstacle are made at most once, as in violations.c, when the
 * first place near it is tested; most are never needed. */
#include "displacement/layer/reads.h"
#include "displacement/prove/proofs/plane.h"

#include "displacement/geometry/obstacle_shadow.h"
#include "displacement/layer/sides.h"

#include "base/extremes.h"
#include "base/list.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PIECES, JUMPS, SIDES }; /* indices of sunder_i_plane_kept.looked */

typedef struct finding {
    const sunder_i_model *model;
    uint32_t p;                       /* the body whose obstacles are found */
    double reach;                     /* an upper bound of the relative moves that matter */
    struct sunder_i_plane_kept *kept; /* receives them */
} finding;

/* ---- Finding obstacles ------------------------------------------------------------------------------------------- */

/* Appends an obstacle between things f and g, to the last run or to a new one. Returns false if memory is out. */
static bool append_obstacle(const finding *w, const sunder_i_plane_obstacle *obstacle, uint32_t f, uint32_t g,
                            bool side)
{
    struct sunder_i_plane_kept *kept = w->kept;
    const sunder_i_plane_run *last = kept->runs ? &kept->run[kept->runs - 1] : NULL;
    const bool more = last && last->f == f && last->g == g && last->shadow == obstacle->shadow && last->side == side;
    if (!sunder_i_reserve(&kept->obstacle, &kept->capacity, kept->n + 1, sizeof *kept->obstacle) ||
        (!more && !sunder_i_reserve(&kept->run, &kept->run_capacity, kept->runs + 1, sizeof *kept->run)))
        return false;
    if (!more)
        kept->run[kept->runs++] = (sunder_i_plane_run){
            .f = f, .g = g, .shadow = obstacle->shadow, .side = side, .first = kept->n, .end = kept->n};
    kept->run[kept->runs - 1].end++;
    kept->obstacle[kept->n++] = *obstacle;
    return true;
}

static bool find_pieces(const finding *w, uint32_t other)
{
    const sunder_i_model *model = w->model;
    const sunder_i_body *p = &model->body[w->p], *q = &model->body[other];
    uint64_t *looked = &w->kept->looked[PIECES];
    const double far = w->reach + model->rules.gap;
    double box[4], shift[4];
    for (uint32_t x = 0; x < 4; x++) {
        shift[x] = p->origin[x & 1] - q->origin[x & 1] + (x < 2 ? -far : far);
        box[x] = p->box[x] + shift[x];
    }
    ++*looked;
    if (p->pieces == 0 || q->pieces == 0 || !sunder_i_box_meet(box, q->box)) return true;
    const sunder_i_body_pieces *of_p = sunder_i_pieces_of(model, p), *of_q = sunder_i_pieces_of(model, q);
    if (!of_p || !of_q) return false;
    for (uint32_t k = 0; k < p->pieces; k++) {
        const sunder_i_body_piece *a = &of_p->piece[k];
        for (uint32_t x = 0; x < 4; x++) box[x] = a->box[x] + shift[x];
        ++*looked;
        if (!sunder_i_box_meet(box, q->box)) continue;
        *looked += q->pieces / 4;
        for (uint32_t l = 0; l < q->pieces; l++) {
            const sunder_i_body_piece *b = &of_q->piece[l];
            if (sunder_i_box_meet(box, b->box) &&
                !append_obstacle(w, &(sunder_i_plane_obstacle){.a = a, .b = b, .q = other}, a->feature, b->feature,
                                 false))
                return false;
        }
    }
    return true;
}

/* Adds the shadow of a piece from an anchor, if it may be within reach. swapped: the anchor belongs to q. Returns false
 * if memory is out. */
static bool find_shadow(const finding *w, uint32_t q, const sunder_i_body_piece *anchor,
                        const sunder_i_body_piece *piece, bool swapped, uint32_t f, bool side)
{
    const sunder_i_body_piece *a = swapped ? piece : anchor, *b = swapped ? anchor : piece;
    const sunder_i_body *body = w->model->body;
    const double offset[2] = {body[q].origin[0] - body[w->p].origin[0], body[q].origin[1] - body[w->p].origin[1]},
                 path_box[4] = {-w->reach, -w->reach, w->reach, w->reach};
    const sunder_i_plane_obstacle obstacle = {.a = a, .b = b, .q = q, .shadow = true};
    return !sunder_i_shadow_may_reach(a->box, b->box, offset, path_box) ||
           append_obstacle(w, &obstacle, f, piece->feature, side);
}

/* Adds the pieces of one body over which anchors of the other could jump. swapped: the anchors are those of q. */
static bool find_jumps(const finding *w, uint32_t q, bool swapped)
{
    const sunder_i_model *model = w->model;
    const sunder_i_body *of = &model->body[swapped ? q : w->p], *other = &model->body[swapped ? w->p : q];
    const sunder_i_body_pieces *from = sunder_i_pieces_of(model, of), *pieces = sunder_i_pieces_of(model, other);
    if (!from || !pieces) return false;
    for (uint32_t m = 0; m < of->members; m++) {
        const uint32_t f = model->member[of->member + m];
        const sunder_i_body_piece *anchor = &from->anchor[m];
        w->kept->looked[JUMPS] += 1 + (other->pieces + other->has->diagonal_covers) / 4;
        for (uint32_t l = 0; l < other->pieces + other->has->diagonal_covers && anchor->corners; l++) {
            const sunder_i_body_piece *piece =
                l < other->pieces ? &pieces->piece[l]
                                  : &model->diagonal_cover[other->has->diagonal_cover + l - other->pieces];
            if (!find_shadow(w, q, anchor, piece, swapped, f, false)) return false;
        }
    }
    return true;
}

/* Adds the sides of a part of a barrier, as shadows from the side anchors of the members of body w->p. Returns false if
 * memory is out. */
static bool find_sides(const finding *w, uint32_t part)
{
    const sunder_i_model *model = w->model;
    const sunder_i_body *of = &model->body[w->p], *q = &model->body[part];
    for (uint32_t m = 0; m < of->members && q->has->sides; m++) {
        const uint32_t f = model->member[of->member + m];
        const sunder_i_body_piece *anchor = &model->side_anchor[f];
        w->kept->looked[SIDES] += 1 + q->has->sides / 4;
        for (uint32_t l = q->has->side; l < q->has->side + q->has->sides && anchor->corners; l++) {
            const sunder_i_side *side = &model->side[l];
            if (sunder_i_side_faces(model, side, f) && !find_shadow(w, part, anchor, &side->piece, false, f, true))
                return false;
        }
    }
    return true;
}

/* Finds the obstacles between bodies w->p and q. Returns false if memory is out. */
static bool find_beside(const finding *w, uint32_t q)
{
    const sunder_i_model *model = w->model;
    if (!find_pieces(w, q)) return false;
    if (sunder_i_is_barrier_body(model, &model->body[q])) return find_sides(w, q);
    return model->rules.jumps || (find_jumps(w, q, false) && find_jumps(w, q, true));
}

/* Finds the obstacles between body w->p and all bodies near it that cannot move: fixed ones and parts of barriers.
 * Returns false if memory is out. */
static bool find_on_ground(const finding *w)
{
    const sunder_i_model *model = w->model;
    const sunder_i_body *p = &model->body[w->p];
    sunder_i_list near = {0};
    bool ok = true;
    for (uint32_t m = 0; m < p->members && ok; m++) {
        const uint32_t f = model->member[p->member + m];
        double box[4];
        if (!model->present[f]) continue;
        sunder_i_box_grow(sunder_i_home_box(model, f), w->reach + model->rules.gap, box);
        w->kept->looked[PIECES] += LOOK_WORK;
        ok = sunder_i_look_about(model, &model->tree, box, &near);
    }
    sunder_i_things_to_bodies(model, &near);
    for (size_t k = 0; k < near.n && ok; k++) {
        const uint32_t q = near.item[k];
        if (q != w->p && !(sunder_i_limit_of(&model->body[q]) > 0)) ok = find_beside(w, q);
    }
    sunder_i_free(near.item);
    return ok;
}

static int by_things(const void *a, const void *b)
{
    const sunder_i_plane_run *p = a, *q = b;
    if (p->f != q->f) return p->f < q->f ? -1 : 1;
    if (p->g != q->g) return p->g < q->g ? -1 : 1;
    if (p->shadow != q->shadow) return p->shadow ? 1 : -1;
    if (p->side != q->side) return p->side ? 1 : -1;
    return (p->first > q->first) - (p->first < q->first);
}

/* Makes one run of all obstacles between the same two things, so that the distance they have to keep is determined
 * once. Returns false if memory is out. */
static bool join_runs(struct sunder_i_plane_kept *kept)
{
    sunder_i_plane_obstacle *all = sunder_i_alloc(kept->n, sizeof *all);
    size_t runs = 0, n = 0;
    if (!all) return false;
    if (kept->runs) qsort(kept->run, kept->runs, sizeof *kept->run, by_things);
    for (size_t k = 0; k < kept->runs; k++) {
        sunder_i_plane_run run = kept->run[k], *last = runs ? &kept->run[runs - 1] : NULL;
        const size_t size = run.end - run.first;
        memcpy(all + n, kept->obstacle + run.first, size * sizeof *all);
        run.first = n;
        n = run.end = n + size;
        if (last && last->f == run.f && last->g == run.g && last->shadow == run.shadow && last->side == run.side)
            last->end = n;
        else
            kept->run[runs++] = run;
    }
    kept->found = kept->runs = runs;
    for (size_t r = 0; r < runs; r++)
        for (size_t k = kept->run[r].first; k < kept->run[r].end; k++) {
            all[k].run = (uint32_t)r;
            all[k].rank = (uint32_t)k;
        }
    sunder_i_free(kept->obstacle);
    kept->obstacle = all;
    kept->capacity = kept->n;
    return true;
}

bool sunder_i_plane_find(const sunder_i_plane *plane, struct sunder_i_plane_kept *kept)
{
    const finding w = {plane->c->model, plane->p, plane->reach, kept};
    return (plane->q == SUNDER_I_GROUND ? find_on_ground(&w) : find_beside(&w, plane->q)) && join_runs(kept) &&
           sunder_i_reserve(&kept->box, &kept->box_capacity, 4 * kept->n, sizeof *kept->box);
}

/* ---- Which obstacles are forbidden ------------------------------------------------------------------------------- */

/* The share of the limits by which the boxes of obstacles are larger: above rounding, or what plane_choose.c adds. */
static double more_of_box(const sunder_i_plane *g) { return g->c->subproblem->exact ? SHADOW_BORDER : BOX_MARGIN; }

/* Computes a box such that every relative move within the limits outside of it is outside the obstacle. The obstacle is
 * A + (-B) grown by its clearance, or a shadow: the part of it up to a bounded multiple of its distance. */
void sunder_i_plane_bound(const sunder_i_plane *plane, const sunder_i_plane_obstacle *obstacle, double clearance,
                          double box[4])
{
    const sunder_i_body *body = plane->c->model->body;
    const double far = plane->disc.xy[0] * (1 + 0x1p-20);
    double square = 0;
    for (uint32_t x = 0; x < 2; x++) {
        const double offset = body[obstacle->q].origin[x] - body[plane->p].origin[x];
        box[x] = obstacle->a->box[x] - obstacle->b->box[x + 2] - offset;
        box[x + 2] = obstacle->a->box[x + 2] - obstacle->b->box[x] - offset;
        const double off = sunder_i_max(sunder_i_max(box[x], -box[x + 2]), 0);
        square += off * off;
    }
    const double times = obstacle->shadow ? far / sqrt(square) : 1,
                 margin = sunder_i_max(obstacle->shadow ? 0 : clearance, 0) + more_of_box(plane) * far;
    for (uint32_t x = 0; x < 2; x++) {
        if (times > 1) {
            if (box[x] < 0) box[x] *= times;
            if (box[x + 2] > 0) box[x + 2] *= times;
        }
        box[x] = sunder_i_max(box[x] - margin, -far);
        box[x + 2] = sunder_i_min(box[x + 2] + margin, far);
    }
    if (sqrt(square) > far + margin || !(box[0] <= box[2] && box[1] <= box[3])) sunder_i_box_clear(box);
}

/* Clips the set behind all half-planes in c->scratch to the relative moves within the limits, and sets box to the box
 * of what is left. Returns false if nothing is left. */
static bool is_within_reach(const sunder_i_plane *g, size_t half_planes, double box[4])
{
    const sunder_i_branching *c = g->c;
    const double beyond = g->disc.xy[0] * (1 + 0x1p-20); /* a line farther away has the whole disc on one side */
    for (size_t k = 0; k < half_planes; k++)
        if (c->scratch[k].d < -beyond) return false;
    sunder_i_plane_polygon r;
    sunder_i_plane_take_corners(&r, &g->disc);
    for (size_t k = 0; k < half_planes; k++)
        if (c->scratch[k].d <= beyond && !sunder_i_plane_clip_behind(&r, &c->scratch[k])) return false;
    sunder_i_box_clear(box);
    for (uint32_t k = 0; k < r.n; k++) sunder_i_box_include(box, r.xy + 2 * k);
    return half_planes > 0;
}

bool sunder_i_plane_make_half_planes(sunder_i_plane *plane, size_t at)
{
    struct sunder_i_plane_kept *kept = plane->kept;
    const sunder_i_model *model = plane->c->model;
    sunder_i_plane_obstacle *o = &kept->obstacle[at];
    const uint64_t looked = plane->c->looked;
    double box[4];
    const size_t half_planes = sunder_i_branching_take_half_planes(
        plane->c, &model->body[plane->p], o->a, &model->body[o->q], o->b, o->clearance, o->shadow);
    plane->c->looked = looked; /* this work was counted when the obstacle was listed */
    o->made = true;
    o->half_planes = 0;
    if (plane->c->failed || !is_within_reach(plane, half_planes, box)) return !plane->c->failed;
    if (!sunder_i_reserve(&kept->half_plane, &kept->half_plane_capacity, kept->half_planes + half_planes,
                          sizeof *kept->half_plane)) {
        plane->c->failed = true;
        return false;
    }
    sunder_i_box_grow(box, more_of_box(plane) * plane->reach, kept->box + 4 * at);
    o->half_plane = kept->half_planes;
    o->half_planes = half_planes;
    kept->half_planes += half_planes;
    memcpy(kept->half_plane + o->half_plane, plane->c->scratch, half_planes * sizeof *kept->half_plane);
    return true;
}

/* Gives the obstacles of run `at` this clearance, and adds those to the index that relative moves within the limits may
 * reach. Returns false if memory is out. */
static bool make_run(sunder_i_plane *g, size_t at, double clearance)
{
    struct sunder_i_plane_kept *kept = g->kept;
    sunder_i_plane_run *run = &kept->run[at];
    const size_t items = kept->items;
    run->cost = 0;
    for (size_t k = run->first; k < run->end; k++) {
        sunder_i_plane_obstacle *o = &kept->obstacle[k];
        double *box = kept->box + 4 * k;
        o->made = false;
        o->clearance = clearance;
        run->cost += o->a->corners + o->b->corners;
        sunder_i_plane_bound(g, o, clearance, box);
        if (box[0] <= box[2] && !sunder_i_plane_index_add(kept, (uint32_t)k)) return false;
    }
    g->c->looked += run->cost;
    run->reached = kept->items - items;
    run->made = true;
    run->clearance = clearance;
    return true;
}

/* Appends a run of the same obstacles as run `of`, for another clearance. Returns false if memory is out. */
static bool add_run(struct sunder_i_plane_kept *kept, size_t of)
{
    const size_t size = kept->run[of].end - kept->run[of].first, n = kept->n + size;
    if (!sunder_i_reserve(&kept->obstacle, &kept->capacity, n, sizeof *kept->obstacle) ||
        !sunder_i_reserve(&kept->box, &kept->box_capacity, 4 * n, sizeof *kept->box) ||
        !sunder_i_reserve(&kept->run, &kept->run_capacity, kept->runs + 1, sizeof *kept->run))
        return false;
    sunder_i_plane_run run = kept->run[of];
    memcpy(kept->obstacle + kept->n, kept->obstacle + run.first, size * sizeof *kept->obstacle);
    for (size_t k = kept->n; k < n; k++) kept->obstacle[k].run = (uint32_t)kept->runs;
    run.first = kept->n;
    run.end = kept->n = n;
    run.next = 0;
    run.made = run.asked = false;
    kept->run[of].next = (uint32_t)kept->runs;
    kept->run[kept->runs++] = run;
    return true;
}

/* Lists run `at` for this clearance. A run that was made for another clearance before is copied. Returns false if
 * memory is out. */
static bool list_run(sunder_i_plane *g, size_t at, double clearance)
{
    struct sunder_i_plane_kept *kept = g->kept;
    while (kept->run[at].made && kept->run[at].clearance != clearance) {
        if (!kept->run[at].next && !add_run(kept, at)) return false;
        at = kept->run[at].next;
    }
    if (kept->run[at].made)
        g->c->looked += kept->run[at].cost; /* the counted cost is that of the first time */
    else if (!make_run(g, at, clearance))
        return false;
    kept->run[at].asked = true;
    g->obstacles += kept->run[at].reached;
    if (!sunder_i_reserve(&g->run, &g->run_capacity, g->runs + 1, sizeof *g->run)) return false;
    g->run[g->runs++] = (uint32_t)at;
    return true;
}

bool sunder_i_plane_list(sunder_i_plane *plane)
{
    sunder_i_branching *c = plane->c;
    struct sunder_i_plane_kept *kept = plane->kept;
    const sunder_i_subproblem *asked = c->subproblem;
    const bool sides = !asked->ignore_paths, jumps = sides && !asked->any_jump;
    bool ok = true, heeded = false;
    c->looked += kept->looked[PIECES] + (jumps ? kept->looked[JUMPS] : 0) + (sides ? kept->looked[SIDES] : 0);
    for (size_t k = 0; k < kept->runs; k++) kept->run[k].asked = false;
    for (size_t k = 0; k < kept->found && ok; k++) {
        const sunder_i_plane_run *run = &kept->run[k];
        double clearance = 0;
        if (k == 0 || run->f != run[-1].f) heeded = sunder_i_branching_is_path_heeded(c, run->f);
        if (!heeded || (run->shadow && !(run->side ? sides : jumps))) continue;
        if (run->shadow ? sunder_i_branching_shades(c, run->f, run->g)
                        : sunder_i_branching_owe(c, run->f, run->g, &clearance))
            ok = list_run(plane, k, clearance);
    }
    return ok;
}
