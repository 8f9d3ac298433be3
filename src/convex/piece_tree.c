/* piece_tree.c: the tree of pieces: they are converted to doubles, sorted along a space-filling curve, and divided in
 * halves recursively. */
#include "convex/piece_tree.h"

#include "predicate/predicate.h"
#include "spatial/box.h"
#include "spatial/curve.h"

#include "base/extremes.h"

#include <math.h>
#include <string.h>

/* Returns the doubles of the corner `from` and of the vector to the corner `to`. The vector is computed from exact
 * differences, so that its error is relative to its length. */
static sunder_i_approx_side side_of(sunder_i_lattice *l, sunder_i_point from, sunder_i_point to)
{
    if (l->narrow)
        return (sunder_i_approx_side){(double)from.x, (double)from.y, (double)(to.x - from.x), (double)(to.y - from.y)};
    sunder_i_approx_side s = {sunder_i_approx(l, from.x), sunder_i_approx(l, from.y), 0, 0};
    sunder_i_point_difference(l, to, from, &s.dx, &s.dy);
    return s;
}

static void clear_group(sunder_i_piece_group *g)
{
    for (int k = 0; k < SUNDER_I_WAYS; k++) {
        g->low[k] = INFINITY;
        g->high[k] = -INFINITY;
    }
}

/* Returns the group of one piece, and stores its sides in the tree. */
static sunder_i_piece_group single_group(sunder_i_piece_tree *t, uint32_t piece)
{
    const sunder_i_convex_pieces *s = t->pieces;
    const uint32_t first = sunder_i_convex_pieces_first(s, piece), end = s->end[piece];
    sunder_i_piece_group g = {
        .pieces = 1, .piece = piece, .part = {SUNDER_I_NO_GROUP, SUNDER_I_NO_GROUP, SUNDER_I_NO_GROUP}};
    clear_group(&g);
    for (uint32_t k = first; k < end; k++) {
        const sunder_i_approx_side a = side_of(s->lattice, s->corner[k], s->corner[k + 1 < end ? k + 1 : first]);
        const double at[SUNDER_I_WAYS] = {a.x, a.y, a.x + a.y, a.x - a.y};
        t->side[k] = a;
        for (int w = 0; w < SUNDER_I_WAYS; w++) {
            g.low[w] = sunder_i_min(g.low[w], at[w]);
            g.high[w] = sunder_i_max(g.high[w], at[w]);
        }
        t->most = sunder_i_max(t->most, sunder_i_max(fabs(a.x), fabs(a.y)));
    }
    for (int w = 0; w < SUNDER_I_WAYS; w++) g.widest[w] = g.high[w] - g.low[w];
    return g;
}

static double length_of(const sunder_i_piece_group *g) { return sunder_i_max(g->widest[0], g->widest[1]); }

/* The input of the tree's construction. */
typedef struct maker {
    sunder_i_piece_tree *tree;
    const sunder_i_piece_group *single; /* [pieces] the groups of single pieces */
    uint32_t *order;                    /* [pieces] the pieces in the order of the curve */
} maker;

static void join_group(sunder_i_piece_group *g, const sunder_i_piece_group *part)
{
    for (int k = 0; k < SUNDER_I_WAYS; k++) {
        g->low[k] = sunder_i_min(g->low[k], part->low[k]);
        g->high[k] = sunder_i_max(g->high[k], part->high[k]);
        g->widest[k] = sunder_i_max(g->widest[k], part->widest[k]);
    }
    g->pieces += part->pieces;
}

/* Adds the group of the pieces order[from .. to - 1], from < to, with all its subgroups. Returns its number. */
static uint32_t make_group(maker *m, uint32_t from, uint32_t to)
{
    sunder_i_piece_tree *t = m->tree;
    const uint32_t number = t->groups++;
    uint32_t longest = from;
    for (uint32_t i = from + 1; i < to; i++)
        if (length_of(&m->single[m->order[i]]) > length_of(&m->single[m->order[longest]])) longest = i;
    const uint32_t piece = m->order[longest];
    if (to - from == 1) {
        t->group[number] = m->single[piece];
        return number;
    }
    memmove(m->order + from + 1, m->order + from, (longest - from) * sizeof *m->order);
    m->order[from] = piece;
    const uint32_t middle = from + 1 + (to - from) / 2;
    sunder_i_piece_group g = {.piece = piece};
    clear_group(&g);
    g.part[0] = make_group(m, from, from + 1);
    g.part[1] = make_group(m, from + 1, middle);
    g.part[2] = middle < to ? make_group(m, middle, to) : SUNDER_I_NO_GROUP;
    for (int k = 0; k < 3; k++)
        if (g.part[k] != SUNDER_I_NO_GROUP) join_group(&g, &t->group[g.part[k]]);
    t->group[number] = g;
    return number;
}

bool sunder_i_piece_tree_build(const sunder_i_convex_pieces *pieces, sunder_i_piece_tree *out)
{
    const uint32_t n = pieces->n;
    sunder_i_arena arena = {0};
    memset(out, 0, sizeof *out);
    out->pieces = pieces;
    out->side = sunder_i_alloc(pieces->corners, sizeof *out->side);
    out->group = sunder_i_alloc(2 * (size_t)n, sizeof *out->group);
    sunder_i_piece_group *of = sunder_i_arena_alloc(&arena, n, sizeof *of);
    uint32_t *order = sunder_i_arena_alloc(&arena, n, sizeof *order);
    uint32_t *same = sunder_i_arena_alloc(&arena, n, sizeof *same);
    double *centre = sunder_i_arena_alloc(&arena, 2 * (size_t)n, sizeof *centre);
    bool ok = out->side && out->group && !arena.failed;
    for (uint32_t i = 0; ok && i < n; i++) {
        of[i] = single_group(out, i);
        order[i] = same[i] = i;
        for (int k = 0; k < 2; k++) centre[2 * (size_t)i + (size_t)k] = of[i].low[k] / 2 + of[i].high[k] / 2;
    }
    if (ok) sunder_i_curve_sort(centre, same, order, n, &arena);
    ok = ok && !arena.failed && !pieces->lattice->arena.failed;
    if (ok) make_group(&(maker){out, of, order}, 0, n);
    sunder_i_arena_free(&arena);
    if (!ok) sunder_i_piece_tree_free(out);
    return ok;
}

void sunder_i_piece_tree_free(sunder_i_piece_tree *tree)
{
    sunder_i_free_all(tree->side, tree->group);
    memset(tree, 0, sizeof *tree);
}

void sunder_i_piece_tree_box(const sunder_i_piece_tree *tree, uint32_t piece, double box[4])
{
    sunder_i_box_clear(box);
    for (uint32_t k = sunder_i_convex_pieces_first(tree->pieces, piece); k < tree->pieces->end[piece]; k++)
        sunder_i_box_include(box, (const double[2]){tree->side[k].x, tree->side[k].y});
}
