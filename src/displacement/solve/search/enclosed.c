/* Do the sides of barriers enclose a body? They do if each ray from the side anchor of one of its members meets a side
 * that the member may not cross. The shadow of a side has no end, so then no position beyond these sides is free, and
 * positions are looked for no farther. In a layer of many closed rooms the search of each would otherwise go through
 * all the others. In doubles, as the search itself. */
#include "displacement/layer/reads.h"
#include "displacement/layer/sides.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979323846

/* The directions, as angles, in which a ray from the anchor meets a side. */
typedef struct arc {
    double from, to;
} arc;

typedef struct arcs {
    arc *arc;
    size_t n, capacity;
} arcs;

static bool add_arc(arcs *all, double from, double to)
{
    if (!sunder_i_reserve(&all->arc, &all->capacity, all->n + 1, sizeof *all->arc)) return false;
    all->arc[all->n++] = (arc){from, to};
    return true;
}

/* Adds the directions of a side, seen from `at`, if it is within `reach`. One across the direction of -x is added in
 * two parts. Returns false if memory is out. */
static bool add_side(arcs *all, const double at[2], const sunder_i_side *side, double reach)
{
    const double p[2] = {side->from[0] - at[0], side->from[1] - at[1]},
                 q[2] = {side->to[0] - at[0], side->to[1] - at[1]}, turn = p[0] * q[1] - p[1] * q[0];
    if (turn == 0 || hypot(p[0], p[1]) > reach || hypot(q[0], q[1]) > reach) return true;
    const double of_p = atan2(p[1], p[0]), of_q = atan2(q[1], q[0]), from = turn > 0 ? of_p : of_q,
                 to = turn > 0 ? of_q : of_p;
    return from <= to ? add_arc(all, from, to) : add_arc(all, from, PI) && add_arc(all, -PI, to);
}

static int by_start(const void *a, const void *b)
{
    const arc *p = a, *q = b;
    return (p->from > q->from) - (p->from < q->from);
}

static bool are_all_directions(arcs *all)
{
    double covered = -PI;
    if (all->n) qsort(all->arc, all->n, sizeof *all->arc, by_start);
    for (size_t k = 0; k < all->n && all->arc[k].from <= covered + SAME_DIRECTION; k++)
        covered = sunder_i_max(covered, all->arc[k].to);
    return covered >= PI - SAME_DIRECTION;
}

/* Lists the directions in which sides of these bodies, which are parts of barriers, stop feature f. */
static bool list_directions(const sunder_i_model *model, const sunder_i_list *part, uint32_t f, double reach, arcs *all)
{
    const double *at = model->side_at + 2 * (size_t)f;
    all->n = 0;
    for (size_t k = 0; k < part->n; k++) {
        const sunder_i_extras *has = model->body[part->item[k]].has;
        for (uint32_t l = has->side; l < has->side + has->sides; l++)
            if (sunder_i_side_faces(model, &model->side[l], f) && !add_side(all, at, &model->side[l], reach))
                return false;
    }
    return true;
}

bool sunder_i_search_is_enclosed(sunder_i_search *search, uint32_t i, double reach)
{
    const sunder_i_model *model = search->model;
    const sunder_i_body *body = &model->body[search->body[i]];
    sunder_i_list part = {0};
    arcs all = {0};
    double box[4];
    bool enclosed = false;
    if (model->sides == 0) return false;
    for (uint32_t x = 0; x < 4; x++) box[x] = body->box[x] + body->origin[x & 1];
    sunder_i_box_grow(box, reach, box);
    bool ok = sunder_i_look_about(model, &model->tree, box, &part);
    if (ok) sunder_i_things_to_bodies(model, &part);
    for (uint32_t m = 0; m < body->members && ok && !enclosed; m++) {
        const uint32_t f = model->member[body->member + m];
        if (!model->side_anchor[f].corners) continue;
        ok = list_directions(model, &part, f, reach, &all);
        enclosed = ok && are_all_directions(&all);
    }
    if (!ok) search->failed = true;
    sunder_i_free_all(part.item, all.arc);
    return enclosed;
}
