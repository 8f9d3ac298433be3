/* Which obstacles cover a place in the plane of one relative move, and by which of them is a region divided? By the one
 * that covers its middle and most of it. */
#include "displacement/prove/proofs/plane.h"

#include "base/extremes.h"

#include <math.h>
#include <string.h>

/* Does the obstacle contain the place u, and everything within the distance `about` of it? u must be in its box. */
static bool holds_around(sunder_i_plane *g, sunder_i_plane_item *item, const double u[2], double about)
{
    const sunder_i_plane_obstacle *o = &g->kept->obstacle[item->at];
    if (!o->made) {
        if (!sunder_i_plane_make_half_planes(g, item->at)) return false;
        memcpy(item->box, g->kept->box + 4 * (size_t)item->at, sizeof item->box);
    }
    if (!o->half_planes) return false;
    for (const sunder_i_half_plane *w = g->kept->half_plane + o->half_plane, *end = w + o->half_planes; w < end; w++)
        if (!(sunder_i_plane_at(w->n, u) < w->d - about)) return false;
    return true;
}

/* Returns an upper bound of the area that two boxes share. */
static double most_shared(const double box[4], const double of[4])
{
    const double x = (box[2] < of[2] ? box[2] : of[2]) - (box[0] > of[0] ? box[0] : of[0]),
                 y = (box[3] < of[3] ? box[3] : of[3]) - (box[1] > of[1] ? box[1] : of[1]);
    return x * y * (1 + 0x1p-30);
}

static double shared_area(const sunder_i_plane *g, const sunder_i_plane_obstacle *o, const sunder_i_plane_region *r)
{
    const sunder_i_half_plane *half_plane = g->kept->half_plane + o->half_plane;
    sunder_i_plane_polygon part;
    sunder_i_plane_take_corners(&part, r);
    for (size_t k = 0; k < o->half_planes; k++)
        if (!sunder_i_plane_clip_behind(&part, &half_plane[k])) return 0;
    return sunder_i_plane_area_of(&part);
}

/* The best obstacle to divide a region by, up to now. */
typedef struct choice {
    double box[4], whole, share;
    double about[2]; /* the distance around the place that an obstacle has to contain: a piece; a shadow */
    const sunder_i_plane_obstacle *best;
} choice;

/* Is the region beyond a line of this obstacle? Then it cannot be divided by it, although it may be within
 * SHADOW_BORDER. */
static bool is_beyond(const sunder_i_branching *c, const sunder_i_plane_obstacle *o)
{
    for (size_t k = 0; k < c->claims && c->subproblem->exact; k++) {
        const sunder_i_node *node = &c->node[c->claim[k].node];
        if (!c->claim[k].behind && node->part_a == o->a && node->part_b == o->b && node->shadow == o->shadow)
            return true;
    }
    return false;
}

/* Replaces the best obstacle by this one if it contains the place u and covers more of the region; of equal ones the
 * one found first is kept. */
static void weigh_obstacle(sunder_i_plane *g, const sunder_i_plane_region *r, const double u[2],
                           sunder_i_plane_item *item, choice *to)
{
    if (most_shared(to->box, item->box) < to->share) return;
    const sunder_i_plane_obstacle *o = &g->kept->obstacle[item->at];
    if (to->best && to->share >= to->whole && o->rank > to->best->rank) return;
    if (is_beyond(g->c, o) || !holds_around(g, item, u, to->about[o->shadow])) return;
    const double share = sunder_i_min(shared_area(g, o, r), to->whole);
    if (share < to->share || (to->best && share == to->share && o->rank > to->best->rank)) return;
    to->share = share;
    to->best = o;
}

const sunder_i_plane_obstacle *sunder_i_plane_choose(sunder_i_plane *plane, const sunder_i_plane_region *region,
                                                     const double u[2], const sunder_i_plane_choice *known,
                                                     double *share)
{
    sunder_i_branching *c = plane->c;
    choice to = {.share = -1};
    sunder_i_box_clear(to.box);
    for (uint32_t k = 0; k < region->n; k++) sunder_i_box_include(to.box, region->xy + 2 * k);
    to.whole = sunder_i_plane_area(region) * (1 - 0x1p-30); /* an obstacle that covers at least this area covers the
                                                             * whole region */
    if (plane->thin) /* what begins at the common boundary of two others does not cover it */
        to.about[0] = to.about[1] = 2 * SLIVER * plane->reach;
    if (c->subproblem->exact) to.about[1] = -SHADOW_BORDER * plane->reach; /* what is closed covers it by its border */
    if (known) {
        to.share = known->share;
        to.best = known->obstacle == SUNDER_I_NO_CHOICE ? NULL : &plane->kept->obstacle[known->obstacle];
        for (size_t k = 0; k < plane->freshes; k++)
            if (sunder_i_plane_is_in(plane->fresh[k].box, u)) weigh_obstacle(plane, region, u, &plane->fresh[k], &to);
    } else if (sunder_i_plane_index_find(plane, u)) {
        for (size_t k = 0; k < plane->about_place; k++) weigh_obstacle(plane, region, u, plane->place[k], &to);
    } else {
        c->failed = true;
    }
    c->looked += PLACE_LOOK + plane->obstacles / BOXES_A_STEP;
    *share = to.share;
    if (!to.best || c->failed) return NULL;
    if (!sunder_i_reserve(&c->scratch, &c->scratch_capacity, to.best->half_planes, sizeof *c->scratch)) {
        c->failed = true;
        return NULL;
    }
    memcpy(c->scratch, plane->kept->half_plane + to.best->half_plane, to.best->half_planes * sizeof *c->scratch);
    return to.best;
}

/* Does the obstacle contain the place u by half-planes made for u? These are then in c->scratch, *half_planes of
 * them. */
static bool holds_closely(sunder_i_plane *g, size_t at, const double u[2], size_t *half_planes)
{
    sunder_i_branching *c = g->c;
    const sunder_i_plane_obstacle *o = &g->kept->obstacle[at];
    double box[4];
    sunder_i_plane_bound(g, o, o->clearance, box);
    c->looked++;
    if (u[0] < box[0] || u[0] > box[2] || u[1] < box[1] || u[1] > box[3]) return false;
    *half_planes = sunder_i_branching_fill_half_planes(c, &c->model->body[g->p], o->a, &c->model->body[o->q], o->b,
                                                       o->clearance, false, u);
    return c->failed || sunder_i_branching_depth(c, *half_planes, u) > 2 * c->hair;
}

const sunder_i_plane_obstacle *sunder_i_plane_choose_closely(sunder_i_plane *plane, const double u[2],
                                                             size_t *half_planes)
{
    const struct sunder_i_plane_kept *kept = plane->kept;
    for (size_t r = 0; r < plane->runs; r++) {
        const sunder_i_plane_run *run = &kept->run[plane->run[r]];
        if (run->shadow || !(run->clearance > 0)) continue;
        for (size_t k = run->first; k < run->end; k++)
            if (kept->box[4 * k] <= kept->box[4 * k + 2] && holds_closely(plane, k, u, half_planes))
                return &kept->obstacle[k];
    }
    return NULL;
}

bool sunder_i_plane_is_at_border(sunder_i_plane *plane, const double u[2])
{
    const struct sunder_i_plane_kept *kept = plane->kept;
    const double hair = 2 * plane->c->hair;
    bool found = false;
    for (size_t r = 0; r < plane->runs && !found; r++) {
        const sunder_i_plane_run *run = &kept->run[plane->run[r]];
        for (size_t k = run->first; k < run->end && run->shadow && !found; k++) {
            sunder_i_plane_item item = {.at = (uint32_t)k};
            sunder_i_box_grow(kept->box + 4 * k, hair, item.box);
            found = sunder_i_plane_is_in(item.box, u) && holds_around(plane, &item, u, -hair);
        }
    }
    return found && !plane->c->failed;
}

bool sunder_i_plane_is_free(sunder_i_plane *plane, const double u[2])
{
    sunder_i_chord chord;
    size_t half_planes;
    if (hypot(u[0], u[1]) > plane->reach) return false;
    if (!sunder_i_plane_index_find(plane, u)) plane->c->failed = true;
    plane->c->looked += PLACE_LOOK + plane->obstacles / BOXES_A_STEP;
    for (size_t k = 0; k < plane->about_place && !plane->c->failed; k++)
        if (holds_around(plane, plane->place[k], u, 0)) return false;
    return !plane->c->failed && !sunder_i_plane_find_chord(plane, u, &chord, &half_planes) &&
           !sunder_i_plane_choose_closely(plane, u, &half_planes);
}
