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
                      (void *)tree->node, (void *)tree->eased, (void *)tree->named, (void *)tree->corner,
                      (void *)tree->prices.price);
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
    sunder_bound_eased *eased;
    size_t *named;
    double *corner;
    size_t *place; /* [pairs + prices] the index of the first piece of each, among those of all pairs and eased pairs */
    size_t *as;    /* [all these pieces] the number of each in the record; SIZE_MAX if it has none */
    size_t corner_capacity, piece_capacity, named_capacity;
    size_t lacks; /* the cuts about what pairs lack, which a checker does not need, follow the springs */
} recording;

/* The pieces of a pair or, with set = pairs + k, of eased pair k. */
static const sunder_i_forbidden *pieces_of(const sunder_i_tree *t, size_t set)
{
    return set < t->pairs ? &t->pair[set].forbidden : &t->eased[set - t->pairs].pieces;
}

static bool reserve_record(recording *r)
{
    const sunder_i_tree *t = r->tree;
    const size_t sets = t->pairs + t->task.prices;
    size_t pieces = 0;
    r->place = sunder_i_alloc(sets, sizeof *r->place);
    for (size_t k = 0; r->place && k < sets; k++) {
        r->place[k] = pieces;
        pieces += pieces_of(t, k)->pieces;
    }
    r->as = sunder_i_alloc(pieces, sizeof *r->as);
    for (size_t k = 0; r->as && k < pieces; k++) r->as[k] = SIZE_MAX;
    r->out->body = r->body = sunder_i_alloc(t->task.n, sizeof *r->body);
    r->out->cut = r->cut = sunder_i_alloc(t->cuts, sizeof *r->cut);
    r->out->force = r->force = sunder_i_alloc(t->forces, sizeof *r->force);
    r->out->node = r->node = sunder_i_alloc(t->nodes, sizeof *r->node);
    r->out->eased = r->eased = sunder_i_alloc(t->task.prices, sizeof *r->eased);
    const bool ok = sunder_i_reserve(&r->named, &r->named_capacity, t->named.n, sizeof *r->named);
    r->out->named = r->named;
    return r->place && r->as && r->body && r->cut && r->force && r->node && r->eased && ok;
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

static bool name_piece(recording *r, size_t set, uint32_t piece, size_t *number);

/* Records the polygon of a joined piece, and names the pieces in whose union it lies. */
static bool record_joined(recording *r, size_t set, uint32_t piece, sunder_bound_piece *to)
{
    const sunder_i_forbidden *f = pieces_of(r->tree, set);
    const sunder_i_forbidden_piece *from = &f->piece[piece];
    sunder_bound_tree *out = r->out;
    bool *used = sunder_i_calloc(f->pieces, sizeof *used);
    bool ok = used && sunder_i_joined_find_parts(r->tree->task.model, f, piece, used) &&
              sunder_i_reserve(&r->named, &r->named_capacity, out->names + f->pieces, sizeof *r->named) &&
              sunder_i_reserve(&r->corner, &r->corner_capacity, 2 * (out->corners + from->edges), sizeof *r->corner);
    out->named = r->named;
    out->corner = r->corner;
    if (ok) {
        to->part_a = out->corners;
        to->corners_a = from->edges;
        for (uint32_t e = 0; e < from->edges; e++)
            memcpy(r->corner + 2 * out->corners++, f->edge[from->edge + e].from, 2 * sizeof *r->corner);
        to->named = out->names;
    }
    for (uint32_t k = 0; k < f->pieces && ok; k++)
        if (used[k]) ok = name_piece(r, set, k, &r->named[out->names]) && ++out->names;
    to->names = ok ? out->names - to->named : 0;
    sunder_i_free(used);
    return ok;
}

static bool record_piece(recording *r, size_t set, uint32_t piece, sunder_bound_piece *to)
{
    const sunder_i_tree *t = r->tree;
    const sunder_i_tree_pair *p = &t->pair[set < t->pairs ? set : t->eased[set - t->pairs].pair];
    const sunder_i_forbidden_piece *from = &pieces_of(t, set)->piece[piece];
    *to = (sunder_bound_piece){.i = p->i,
                               .j = p->j,
                               .a = from->a->feature,
                               .b = from->b->feature,
                               .row = from->row,
                               .shadow = from->shadow && !from->row,
                               .priced = from->priced,
                               .joined = from->joined,
                               .clearance = from->clearance};
    if (from->row) return true;
    if (from->joined) return record_joined(r, set, piece, to);
    return add_part(r, from->a, &to->part_a, &to->corners_a) && add_part(r, from->b, &to->part_b, &to->corners_b);
}

/* Sets *number to the index in the record of a piece, which is added to the record if it is not there yet. Returns
 * false if memory is out. */
static bool name_piece(recording *r, size_t set, uint32_t piece, size_t *number)
{
    size_t *as = &r->as[r->place[set] + piece];
    if (*as == SIZE_MAX) {
        sunder_bound_piece made;
        if (!record_piece(r, set, piece, &made) ||
            !sunder_i_reserve(&r->piece, &r->piece_capacity, r->out->pieces + 1, sizeof *r->piece))
            return false;
        r->out->piece = r->piece;
        *as = r->out->pieces;
        r->piece[r->out->pieces++] = made;
    }
    *number = *as;
    return true;
}

static bool name_all(recording *r, size_t set, uint32_t first, uint32_t n)
{
    for (uint32_t k = first; k < first + n; k++) {
        size_t number;
        if (!name_piece(r, set, r->tree->named.item[k], &number)) return false;
        r->named[k] = number; /* the array may have been moved */
    }
    return true;
}

static bool record_cuts(recording *r)
{
    static const sunder_bound_cut_kind kinds[] = {
        [SUNDER_I_CUT_LIMIT] = SUNDER_BOUND_CUT_LIMIT, [SUNDER_I_CUT_CONE] = SUNDER_BOUND_CUT_CONE,
        [SUNDER_I_CUT_HULL] = SUNDER_BOUND_CUT_HULL,   [SUNDER_I_CUT_DISC] = SUNDER_BOUND_CUT_DISC,
        [SUNDER_I_CUT_PRICE] = SUNDER_BOUND_CUT_PRICE, [SUNDER_I_CUT_SPRING] = SUNDER_BOUND_CUT_SPRING};
    const sunder_i_tree *t = r->tree;
    for (size_t k = 0; k < t->cuts; k++) {
        const sunder_i_move_cut *c = &t->cut[k];
        const sunder_i_cut_note *note = &t->note[k];
        if (note->kind == SUNDER_I_CUT_LACK) continue;
        r->cut[r->out->cuts++] = (sunder_bound_cut){.kind = kinds[note->kind],
                                                    .i = c->i,
                                                    .j = c->j == SUNDER_I_GROUND ? SIZE_MAX : c->j,
                                                    .n = {c->n[0], c->n[1]},
                                                    .d = c->d,
                                                    .stiff = c->give > 0 ? 1 / (2 * c->give) : 0,
                                                    .share = c->share,
                                                    .named = note->named,
                                                    .names = note->names};
        const bool price = note->kind == SUNDER_I_CUT_PRICE;
        if ((price || note->kind == SUNDER_I_CUT_HULL) &&
            !name_all(r, (price ? t->pairs : 0) + note->pair, note->named, note->names))
            return false;
    }
    return true;
}

/* Records a list of forces, without those on cuts that are not recorded. */
static void record_forces(recording *r, uint32_t from, uint32_t n, size_t *first, size_t *count)
{
    const size_t springs = r->tree->springs;
    *first = r->out->forces;
    for (uint32_t k = from; k < from + n; k++) {
        const sunder_i_cut_force *f = &r->tree->force[k];
        if (f->cut >= springs && f->cut < springs + r->lacks) continue;
        r->force[r->out->forces++] = (sunder_bound_force){f->cut < springs ? f->cut : f->cut - r->lacks, f->force};
    }
    *count = r->out->forces - *first;
}

static bool record_nodes(recording *r)
{
    const sunder_i_tree *t = r->tree;
    for (size_t k = 0; k < t->nodes; k++) {
        const sunder_i_tree_node *n = &t->node[k];
        sunder_bound_node *to = &r->node[k];
        *to = (sunder_bound_node){.parent = n->parent == SUNDER_I_NO_NODE ? SIZE_MAX : n->parent,
                                  .cut = n->cut - r->lacks,
                                  .cuts = n->cuts,
                                  .empty = n->state == SUNDER_I_EMPTY};
        record_forces(r, n->by, n->bys, &to->by, &to->bys);
        record_forces(r, n->force, n->forces, &to->force, &to->forces);
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
    recording r = {.tree = tree, .out = out, .lacks = 2 * tree->task.prices};
    *out = (sunder_bound_tree){.bound = sunder_i_tree_bound(tree), .names = tree->named.n};
    bool ok = reserve_record(&r);
    for (size_t k = 0; ok && k < tree->task.n; k++)
        r.body[k] = (sunder_bound_body){.thing = tree->task.model->member[tree->task.model->body[tree->body[k]].member],
                                        .weight = tree->weight[k],
                                        .shift = {tree->anchor[2 * k], tree->anchor[2 * k + 1]}};
    for (size_t k = 0; ok && k < tree->task.prices; k++)
        r.eased[k] = (sunder_bound_eased){tree->task.price[k].i, tree->task.price[k].j};
    for (size_t k = 0; ok && k < tree->named.n; k++) r.named[k] = 0;
    ok = ok && record_cuts(&r) && record_nodes(&r);
    sunder_i_free_all(r.place, r.as);
    if (!ok) {
        sunder_i_bound_tree_free(out);
        return false;
    }
    out->bodies = tree->task.n;
    out->springs = tree->springs;
    out->eased_pairs = tree->task.prices;
    out->nodes = tree->nodes;
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
