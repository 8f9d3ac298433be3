/* Cuts at a node: they remove only what is forbidden, or too expensive.
 *
 * Disc. Let D be the bound that the node's forces prove and t* their minimiser. Every t that satisfies the cuts of the
 * node costs at least D + sum w |t - t*|^2 (dual_program.c). So a t that costs less than the goal has
 *
 *     |u_ij - u*_ij|  <=  |t_i - t*_i| + |t_j - t*_j|  <=  sqrt((goal - D) (1 / w_i + 1 / w_j))
 *
 * by Cauchy and Schwarz: tangents of that disc are cuts.
 *
 * Hull. Removing a forbidden part of a region loses nothing, so a line beyond which the whole region is forbidden is a
 * cut. The hull of the free part, in doubles, proposes such a line; it is moved slightly outward, and made a cut if it
 * is proved that the part which it removes is covered. */
#include "displacement/prove/optimum/tree.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/watch.h"

#include <math.h>
#include <string.h>

/* Returns a bound of the distance between t* of body b and the exact minimiser for the forces: the rounding errors of
 * the sum of pushes on the body (whose size sunder_i_dual_value() computes) and of the anchor. */
static double doubt_of_place(const sunder_i_tree *t, uint32_t b)
{
    const double size =
        t->program.net[3 * b + 2] * t->mass[b] + fabs(t->task.anchor[2 * b]) + fabs(t->task.anchor[2 * b + 1]);
    return (double)(t->program.acting_n + 16) * 0x1p-51 * size;
}

/* Clips the region of the pair to the disc around u. value: the bound that the forces prove. Returns the number of cuts
 * made. */
static size_t cut_disc(sunder_i_tree *t, uint32_t pair, const double u[2], double value)
{
    const sunder_i_tree_pair *p = &t->pair[pair];
    const double radius = sqrt((t->task.goal - value) * p->slackness) * (1 + 0x1p-40) + doubt_of_place(t, p->i) +
                          doubt_of_place(t, p->j) + p->forbidden.grain;
    size_t made = 0;
    for (int k = 0; k < SUNDER_I_TREE_RAYS && !t->failed; k += 2) {
        const double n[2] = {t->ray[k][0], t->ray[k][1]};
        const double d = n[0] * u[0] + n[1] * u[1] - radius * (1 + 0x1p-48);
        double least = INFINITY;
        const sunder_i_region *region = sunder_i_tree_region(t, pair);
        for (uint32_t c = 0; c < region->n; c++) {
            const double at = n[0] * region->xy[2 * c] + n[1] * region->xy[2 * c + 1];
            if (at < least) least = at;
        }
        if (!(least < d - DISC_SHARE * radius)) continue;
        sunder_i_tree_cut(t, SUNDER_I_CUT_DISC, pair, n, d);
        made++;
    }
    return made;
}

/* Finds the reflex corners of a pair of few pieces, at the first call. Returns false if memory is out. */
static bool know_reflex(sunder_i_tree *t, sunder_i_tree_pair *p)
{
    if (p->has_reflex || sunder_i_forbidden_is_many(&p->forbidden)) return true;
    p->has_reflex = true;
    if (!sunder_i_reflex_find(&p->reflex, &p->forbidden, &t->steps)) t->failed = true;
    return !t->failed;
}

bool sunder_i_tree_propose(sunder_i_tree *tree, uint32_t pair, const sunder_i_region *region, const double u[2],
                           double n[2], double *d, bool *none)
{
    sunder_i_tree_pair *p = &tree->pair[pair];
    double place[2];
    *none = region->n == 0;
    if (*none || !know_reflex(tree, p)) return false;
    /* A trial must not change the free sides of the pair's own region. */
    sunder_i_free_sides *sides = region == sunder_i_tree_region(tree, pair) ? &p->sides : &tree->tried;
    if (sides == &tree->tried) sides->any = false;
    if (!sunder_i_free_sides_find(sides, &p->sides, region, &p->forbidden, &tree->steps)) {
        tree->failed = true;
        return false;
    }
    if (!sunder_i_free_hull_nearest(sides, &p->forbidden, &p->reflex, u, place, &tree->steps)) {
        *none = true;
        return false;
    }
    n[0] = place[0] - u[0];
    n[1] = place[1] - u[1];
    const double length = sqrt(n[0] * n[0] + n[1] * n[1]);
    if (!(length > IN_HULL * p->forbidden.size)) return false;
    for (int c = 0; c < 2; c++) n[c] /= length;
    *d = n[0] * place[0] + n[1] * place[1];
    return true;
}

/* Is it proved that the region is forbidden to the pair? If proofs are recorded, the pieces that this one uses are
 * listed in t->named from *named on, *names of them. gap: as in sunder_i_region_is_covered(). */
static bool is_covered(sunder_i_tree *t, const sunder_i_tree_pair *p, const sunder_i_region *region, double gap[2],
                       uint32_t *named, uint32_t *names)
{
    const sunder_i_forbidden *f = &p->forbidden;
    if (!t->task.keep) return sunder_i_region_is_covered(region, f, NULL, gap, &t->steps);
    if (!sunder_i_reserve(&t->used, &t->used_capacity, f->pieces, sizeof *t->used)) {
        t->failed = true;
        return false;
    }
    if (f->pieces) memset(t->used, 0, f->pieces * sizeof *t->used);
    if (!sunder_i_region_is_covered(region, f, t->used, gap, &t->steps)) return false;
    /* Instead of a chord its two sides are named, from which it follows. */
    for (uint32_t k = 0; k < f->pieces; k++) {
        const uint32_t *side = f->piece[k].side;
        if (!t->used[k] || side[0] == side[1]) continue;
        t->used[side[0]] = t->used[side[1]] = true;
        t->used[k] = false;
    }
    *named = (uint32_t)t->named.n;
    for (uint32_t k = 0; k < f->pieces; k++)
        if (t->used[k] && !sunder_i_list_push(&t->named, k)) t->failed = true;
    *names = (uint32_t)t->named.n - *named;
    return true;
}

/* Is it proved that the pair has no room left at the last node? It is recorded there. gap: as in
 * sunder_i_region_is_covered(). */
static bool is_empty(sunder_i_tree *t, uint32_t pair, double gap[2])
{
    const sunder_i_tree_pair *p = &t->pair[pair];
    sunder_i_tree_node *node = &t->node[t->nodes - 1];
    node->pair = pair;
    return is_covered(t, p, sunder_i_tree_region(t, pair), gap, &node->named, &node->names);
}

/* Adds the cut n.u >= d - room if it is proved that what it removes is forbidden. */
static bool try_cut(sunder_i_tree *t, uint32_t pair, const double n[2], double d, double room, double gap[2])
{
    const sunder_i_tree_pair *p = &t->pair[pair];
    const double back[2] = {-n[0], -n[1]};
    uint32_t named = 0, names = 0;
    sunder_i_region cap = *sunder_i_tree_region(t, pair);
    sunder_i_region_clip(&cap, back, room - d, SUNDER_I_NO_CUT, p->forbidden.grain);
    if (!is_covered(t, p, &cap, gap, &named, &names)) return false;
    const uint32_t cut = sunder_i_tree_cut(t, SUNDER_I_CUT_HULL, pair, n, d - room);
    if (t->failed) return false;
    t->note[cut].named = named;
    t->note[cut].names = names;
    return true;
}

/* Tries the proposed cut with several widths of room. */
static bool try_rooms(sunder_i_tree *t, uint32_t pair, const double u[2], const double n[2], double d, double gap[2])
{
    const sunder_i_forbidden *f = &t->pair[pair].forbidden;
    const double far = CUT_FAR_ROOM * (d - (n[0] * u[0] + n[1] * u[1])), size = f->size;
    if (!sunder_i_forbidden_is_many(f) &&
        (try_cut(t, pair, n, d, CUT_ROOM * size, gap) || try_cut(t, pair, n, d, CUT_MORE_ROOM * size, gap)))
        return true;
    return try_cut(t, pair, n, d, far, gap);
}

/* A proposal is based on the known reflex corners: for many pieces some of them, for a few pieces all except those in
 * gaps without width. If the proof fails at a free place, one more corner is found from that place. */
bool sunder_i_tree_cut_hull(sunder_i_tree *tree, uint32_t pair, const double u[2], bool *empty)
{
    double before = NAN;
    *empty = false;
    for (int tries = 0; tries < MOST_GAPS && !tree->failed; tries++) {
        sunder_i_tree_pair *p = &tree->pair[pair];
        double n[2], d, gap[2];
        bool none;
        if (sunder_i_tree_propose(tree, pair, sunder_i_tree_region(tree, pair), u, n, &d, &none)) {
            if (d == before) return false; /* the same proposal again */
            before = d;
            if (try_rooms(tree, pair, u, n, d, gap)) return true;
        } else {
            *empty = none && is_empty(tree, pair, gap);
            if (!none || *empty) return false;
            for (int c = 0; c < 2; c++) n[c] = gap[c] - u[c];
            const double length = sqrt(n[0] * n[0] + n[1] * n[1]);
            if (!(length > 0)) return false;
            for (int c = 0; c < 2; c++) n[c] /= length;
        }
        if (tree->failed || !(fabs(gap[0]) < INFINITY)) return false;
        const double down[2] = {-n[0], -n[1]};
        const size_t known = p->reflex.n;
        p = &tree->pair[pair];
        if (!sunder_i_reflex_seek(&p->reflex, &p->forbidden, sunder_i_tree_region(tree, pair), gap, down, &tree->steps))
            tree->failed = true;
        if (p->reflex.n == known) return false;
    }
    return false;
}

size_t sunder_i_tree_refine(sunder_i_tree *tree, double value, bool *empty)
{
    size_t made = 0, discs = 0;
    sunder_i_tree_node *node = &tree->node[tree->nodes - 1];
    *empty = false;
    for (size_t k = 0; k < tree->conflicts && !*empty && !tree->failed; k++) {
        const sunder_i_tree_conflict c = tree->conflict[k];
        const uint64_t before = tree->steps;
        discs += cut_disc(tree, c.pair, c.u, value);
        made += c.eased == SUNDER_I_NOBODY ? sunder_i_tree_cut_hull(tree, c.pair, c.u, empty)
                                           : sunder_i_tree_cut_price(tree, c.eased, c.u);
        if (!sunder_i_steps(1 + (size_t)(tree->steps - before) / 64)) tree->failed = true;
    }
    if (tree->task.keep && discs && !tree->failed) sunder_i_tree_note_forces(tree, &node->by, &node->bys);
    return made;
}
