/* Chords across ends of two sides, for minimisers that are in no piece but on the boundary of two shadows.
 *
 * The shadows of two sides that meet in a corner share the ray behind it as their boundary. Pieces are open to the
 * search and to its proofs, so the ray is in neither of them, and the cheapest moves on it would end a tree: a layout
 * that no exact check accepts. The shadow of a chord between the two lies in their union (geometry/side_chord.c), and
 * contains the ray. So such chords are added where a minimiser without conflicts is on a ray like that; most trees need
 * none.
 *
 * The two sides belong to one barrier, perhaps to different parts of it. All parts stand still, so the forbidden set of
 * a body and one part may include shadows of another. */
#include "displacement/geometry/side_chord.h"
#include "displacement/geometry/tuning.h"
#include "displacement/layer/reads.h"
#include "displacement/layer/sides.h"
#include "displacement/prove/optimum/tree.h"
#include "displacement/prove/optimum/tuning.h"

#include <string.h>

/* A side with an end that the anchor passes. */
typedef struct spoke {
    const sunder_i_side *side;
    const double *end, *other;
    uint32_t part; /* the body of the part that has it */
} spoke;

/* One side anchor of body i, and the spokes on its way. */
typedef struct passing {
    sunder_i_tree *tree;
    uint32_t i, feature;
    const sunder_i_body_piece *anchor;
    double u[2]; /* the anchor moves by -u */
    spoke spoke[TREE_SPOKES];
    size_t n;
} passing;

static const double *place_of_anchor(const passing *g)
{
    return g->tree->task.model->side_at + 2 * (size_t)g->feature;
}

static void find_spokes_of_part(passing *g, uint32_t part)
{
    const sunder_i_model *model = g->tree->task.model;
    const double *a = place_of_anchor(g);
    const sunder_i_extras *has = model->body[part].has;
    g->tree->steps += has->sides;
    for (uint32_t k = has->side; k < has->side + has->sides && g->n < TREE_SPOKES; k++) {
        const sunder_i_side *side = &model->side[k];
        const bool from = sunder_i_passes_end(a, side->from, g->u), to = sunder_i_passes_end(a, side->to, g->u);
        if (from == to || (side->area && side->area->rational) || !sunder_i_side_faces(model, side, g->feature))
            continue;
        g->spoke[g->n++] = (spoke){side, from ? side->from : side->to, from ? side->to : side->from, part};
    }
}

static void find_spokes(passing *g)
{
    sunder_i_tree *t = g->tree;
    const double *a = place_of_anchor(g), end[2] = {a[0] - g->u[0], a[1] - g->u[1]};
    double box[4];
    t->near.n = 0;
    sunder_i_box_of_segment(a, end, box);
    if (!sunder_i_look_about(t->task.model, &t->task.model->tree, box, &t->near)) t->failed = true;
    t->near.n = sunder_i_set_make(t->near.item, t->near.n);
    t->steps += t->near.n;
    for (size_t k = 0; k < t->near.n && !t->failed; k++)
        if (sunder_i_is_barrier(t->task.model, t->near.item[k]))
            find_spokes_of_part(g, t->task.model->body_of[t->near.item[k]]);
}

/* Returns the number of the piece that is the shadow of a spoke, which is added if the pair does not have it. Returns
 * the number of pieces if it is out of reach, or memory is out. */
static uint32_t find_shadow(passing *g, sunder_i_tree_pair *p, const spoke *s)
{
    sunder_i_tree *t = g->tree;
    sunder_i_forbidden *f = &p->forbidden;
    const uint32_t mover = t->body[g->i];
    const bool swapped = p->j == g->i;
    const sunder_i_body_piece *a = swapped ? &s->side->piece : g->anchor, *b = swapped ? g->anchor : &s->side->piece;
    for (uint32_t k = 0; k < f->pieces; k++)
        if (f->piece[k].a == a && f->piece[k].b == b) return k;
    const uint32_t before = (uint32_t)f->pieces;
    if (!sunder_i_forbidden_add_shadow(f, t->task.model, swapped ? s->part : mover, swapped ? mover : s->part,
                                       sunder_i_tree_pair_reach(p), a, b))
        t->failed = true;
    return before;
}

static bool has_chord(const sunder_i_forbidden *f, const uint32_t side[2])
{
    for (const sunder_i_forbidden_piece *p = f->piece; p < f->piece + f->pieces; p++)
        if (memcmp(p->side, side, sizeof p->side) == 0) return true;
    return false;
}

/* Returns the pair of the body and the part of one of the two spokes; a part that does not take part becomes a guest.
 * NULL if there is no room for guests, or memory is out. */
static sunder_i_tree_pair *find_pair(passing *g, const spoke *s, const spoke *r)
{
    sunder_i_tree *t = g->tree;
    uint32_t j = 0;
    while (j < t->task.n && t->body[j] != s->part && t->body[j] != r->part) j++;
    if (j == t->task.n) {
        if (!t->task.group_of || t->task.group_of[s->part] != SUNDER_I_NOBODY || t->task.n == t->capacity) return NULL;
        sunder_i_tree_add_guest(t, s->part);
    }
    return sunder_i_tree_find_pair(t, g->i < j ? g->i : j, g->i < j ? j : g->i);
}

/* Adds chords across two spokes. Returns true if they are new. */
static bool add_chords(passing *g, const spoke *s, const spoke *r)
{
    const double share[] = {CHORD, WIDE_CHORD};
    sunder_i_tree *t = g->tree;
    const sunder_i_model *model = t->task.model;
    const double *const end[2] = {s->end, r->end}, *const other[2] = {s->other, r->other};
    double at[4];
    if (sunder_i_whole_of(model, s->side->piece.feature) != sunder_i_whole_of(model, r->side->piece.feature) ||
        !sunder_i_side_chord(place_of_anchor(g), end, other, CHORD, at))
        return false;
    sunder_i_tree_pair *p = find_pair(g, s, r);
    if (!p || sunder_i_forbidden_is_many(&p->forbidden)) return false;
    const uint32_t side[2] = {find_shadow(g, p, s), find_shadow(g, p, r)};
    const size_t before = p->forbidden.pieces;
    if (t->failed || side[0] >= before || side[1] >= before || has_chord(&p->forbidden, side)) return false;
    for (size_t k = 0; k < sizeof share / sizeof *share && !t->failed; k++)
        if (sunder_i_side_chord(place_of_anchor(g), end, other, share[k], at) &&
            !sunder_i_forbidden_add_chord(&p->forbidden, model, t->body[g->i], s->part, p->j == g->i,
                                          sunder_i_tree_pair_reach(p), g->anchor, at, side))
            t->failed = true;
    p->has_reflex = p->sides.any = false;
    p->reflex.n = 0;
    return !t->failed && p->forbidden.pieces > before;
}

bool sunder_i_tree_add_chords(sunder_i_tree *tree)
{
    const sunder_i_model *model = tree->task.model;
    const size_t bodies = tree->task.n;
    bool any = false;
    for (uint32_t i = 0; i < bodies && model->sides && !tree->task.no_paths; i++) {
        const sunder_i_body *body = &model->body[tree->body[i]];
        const double *at = tree->program.t + 2 * i;
        for (uint32_t m = 0; m < body->members && tree->mass[i] > 0 && !tree->failed; m++) {
            const uint32_t f = model->member[body->member + m];
            passing g = {tree, i, f, &model->side_anchor[f], {-at[0], -at[1]}, {{0}}, 0};
            if (!g.anchor->corners) continue;
            find_spokes(&g);
            for (size_t k = 0; k < g.n; k++)
                for (size_t l = 0; l < k && !tree->failed; l++) any |= add_chords(&g, &g.spoke[l], &g.spoke[k]);
        }
    }
    return any && !tree->failed;
}
