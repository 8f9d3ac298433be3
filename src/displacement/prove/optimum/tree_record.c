/* Records what a tree proves, in the types of the interface (sunder_bound_tree), for a checker that has only the layer.
 *
 * All nodes are recorded, in order, so a parent comes before its children; likewise cuts and forces. Only pieces of
 * pairs that are named by some cut or node are recorded, with their corners as the layer has them, not rounded as the
 * tree uses them. */
#include "displacement/prove/optimum/optimum.h"
#include "displacement/prove/optimum/tree.h"

#include <string.h>

void sunder_i_bound_tree_free(sunder_bound_tree *tree)
{
    sunder_i_free_all((void *)tree->body, (void *)tree->piece, (void *)tree->cut, (void *)tree->force,
                      (void *)tree->node, (void *)tree->named, (void *)tree->corner, (void *)tree->prices.price);
    *tree = (sunder_bound_tree){0};
}

void sunder_i_bound_trees_free(sunder_i_bound_trees *trees)
{
    for (size_t k = 0; k < trees->n; k++) sunder_i_bound_tree_free(&trees->tree[k]);
    sunder_i_free(trees->tree);
    *trees = (sunder_i_bound_trees){0};
}

bool sunder_i_bound_trees_take(sunder_i_bound_trees *to, sunder_i_bound_trees *from)
{
    if (from->n == 0) return true;
    if (!sunder_i_reserve(&to->tree, &to->capacity, to->n + from->n, sizeof *to->tree)) return false;
    memcpy(to->tree + to->n, from->tree, from->n * sizeof *to->tree);
    to->n += from->n;
    from->n = 0;
    return true;
}

typedef struct recording {
    const sunder_i_tree *tree;
    sunder_bound_tree *out;
    sunder_bound_body *body;
    sunder_bound_piece *piece;
    sunder_bound_cut *cut;
    sunder_bound_force *force;
    sunder_bound_node *node;
    size_t *named;
    double *corner;
    size_t *place; /* [pairs] the index of the first piece of each, among the pieces of all pairs */
    size_t *as;    /* [pieces of all pairs] the number of each in the record; SIZE_MAX if it has none */
    size_t corner_capacity, piece_capacity;
} recording;

static bool reserve_record(recording *r)
{
    const sunder_i_tree *t = r->tree;
    size_t pieces = 0;
    r->place = sunder_i_alloc(t->pairs, sizeof *r->place);
    for (size_t k = 0; r->place && k < t->pairs; k++) {
        r->place[k] = pieces;
        pieces += t->pair[k].forbidden.pieces;
    }
    r->as = sunder_i_alloc(pieces, sizeof *r->as);
    for (size_t k = 0; r->as && k < pieces; k++) r->as[k] = SIZE_MAX;
    r->out->body = r->body = sunder_i_alloc(t->task.n, sizeof *r->body);
    r->out->cut = r->cut = sunder_i_alloc(t->cuts, sizeof *r->cut);
    r->out->force = r->force = sunder_i_alloc(t->forces, sizeof *r->force);
    r->out->node = r->node = sunder_i_alloc(t->nodes, sizeof *r->node);
    r->out->named = r->named = sunder_i_alloc(t->named.n, sizeof *r->named);
    return r->place && r->as && r->body && r->cut && r->force && r->node && r->named;
}

static bool add_part(recording *r, const sunder_i_body_piece *part, size_t *first, size_t *n)
{
    sunder_bound_tree *out = r->out;
    *n = sunder_i_corners_as_given(r->tree->task.model, part);
    const bool ok = sunder_i_reserve(&r->corner, &r->corner_capacity, 2 * (out->corners + *n), sizeof *r->corner);
    out->corner = r->corner;
    if (!ok) return false;
    *first = out->corners;
    sunder_i_piece_as_given(r->tree->task.model, part, r->corner + 2 * out->corners);
    out->corners += *n;
    return true;
}

/* Sets *number to the index in the record of piece number `piece` of pair number `pair`, which is added to the record
 * if it is not there yet. Returns false if memory is out. */
static bool name_piece(recording *r, uint32_t pair, uint32_t piece, size_t *number)
{
    const sunder_i_tree_pair *p = &r->tree->pair[pair];
    const sunder_i_forbidden_piece *from = &p->forbidden.piece[piece];
    size_t *as = &r->as[r->place[pair] + piece];
    sunder_bound_tree *out = r->out;
    if (*as == SIZE_MAX) {
        const bool ok = sunder_i_reserve(&r->piece, &r->piece_capacity, out->pieces + 1, sizeof *r->piece);
        out->piece = r->piece;
        if (!ok) return false;
        sunder_bound_piece *to = &r->piece[out->pieces];
        *to =
            (sunder_bound_piece){.i = p->i, .j = p->j, .a = from->a->feature, .b = from->b->feature, .row = from->row};
        to->shadow = from->shadow && !from->row;
        to->clearance = from->clearance;
        if (!from->row &&
            !(add_part(r, from->a, &to->part_a, &to->corners_a) && add_part(r, from->b, &to->part_b, &to->corners_b)))
            return false;
        *as = out->pieces++;
    }
    *number = *as;
    return true;
}

static bool name_all(recording *r, uint32_t pair, uint32_t first, uint32_t n)
{
    for (uint32_t k = first; k < first + n; k++)
        if (!name_piece(r, pair, r->tree->named.item[k], &r->named[k])) return false;
    return true;
}

static bool record_cuts(recording *r)
{
    static const sunder_bound_cut_kind kinds[] = {[SUNDER_I_CUT_LIMIT] = SUNDER_BOUND_CUT_LIMIT,
                                                  [SUNDER_I_CUT_CONE] = SUNDER_BOUND_CUT_CONE,
                                                  [SUNDER_I_CUT_HULL] = SUNDER_BOUND_CUT_HULL,
                                                  [SUNDER_I_CUT_DISC] = SUNDER_BOUND_CUT_DISC,
                                                  [SUNDER_I_CUT_SPRING] = SUNDER_BOUND_CUT_SPRING};
    const sunder_i_tree *t = r->tree;
    for (size_t k = 0; k < t->cuts; k++) {
        const sunder_i_move_cut *c = &t->cut[k];
        const sunder_i_cut_note *note = &t->note[k];
        r->cut[k] = (sunder_bound_cut){.kind = kinds[note->kind],
                                       .i = c->i,
                                       .j = c->j == SUNDER_I_GROUND ? SIZE_MAX : c->j,
                                       .n = {c->n[0], c->n[1]},
                                       .d = c->d,
                                       .stiff = c->give > 0 ? 1 / (2 * c->give) : 0,
                                       .named = note->named,
                                       .names = note->names};
        if (note->kind == SUNDER_I_CUT_HULL && !name_all(r, note->pair, note->named, note->names)) return false;
    }
    return true;
}

static bool record_nodes(recording *r)
{
    const sunder_i_tree *t = r->tree;
    for (size_t k = 0; k < t->nodes; k++) {
        const sunder_i_tree_node *n = &t->node[k];
        sunder_bound_node *to = &r->node[k];
        *to = (sunder_bound_node){.parent = n->parent == SUNDER_I_NO_NODE ? SIZE_MAX : n->parent,
                                  .cut = n->cut,
                                  .cuts = n->cuts,
                                  .force = n->force,
                                  .forces = n->forces,
                                  .by = n->by,
                                  .bys = n->bys,
                                  .empty = n->state == SUNDER_I_EMPTY};
        if (!to->empty) continue;
        to->i = t->pair[n->pair].i;
        to->j = t->pair[n->pair].j;
        to->named = n->named;
        to->names = n->names;
        if (!name_all(r, n->pair, n->named, n->names)) return false;
    }
    return true;
}

bool sunder_i_tree_record(const sunder_i_tree *tree, sunder_bound_tree *out)
{
    recording r = {.tree = tree, .out = out};
    *out = (sunder_bound_tree){.bound = sunder_i_tree_bound(tree)};
    bool ok = reserve_record(&r);
    for (size_t k = 0; ok && k < tree->task.n; k++)
        r.body[k] = (sunder_bound_body){.thing = tree->task.model->member[tree->task.model->body[tree->body[k]].member],
                                        .weight = tree->weight[k],
                                        .shift = {tree->anchor[2 * k], tree->anchor[2 * k + 1]}};
    for (size_t k = 0; ok && k < tree->forces; k++)
        r.force[k] = (sunder_bound_force){tree->force[k].cut, tree->force[k].force};
    for (size_t k = 0; ok && k < tree->named.n; k++) r.named[k] = 0;
    ok = ok && record_cuts(&r) && record_nodes(&r);
    sunder_i_free_all(r.place, r.as);
    if (!ok) {
        sunder_i_bound_tree_free(out);
        return false;
    }
    out->bodies = tree->task.n;
    out->cuts = tree->cuts;
    out->springs = tree->springs;
    out->forces = tree->forces;
    out->nodes = tree->nodes;
    out->names = tree->named.n;
    return true;
}

bool sunder_i_tree_keep(const sunder_i_tree *tree, sunder_i_bound_trees *trees)
{
    if (!sunder_i_reserve(&trees->tree, &trees->capacity, trees->n + 1, sizeof *trees->tree) ||
        !sunder_i_tree_record(tree, &trees->tree[trees->n]))
        return false;
    trees->n++;
    return true;
}
