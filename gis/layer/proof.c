/* proof.c: see proof.h. One JSON object a line: the problem; each conflict with its proof, if it has one; each tree of
 * the bound. Numbers are the shortest decimals that read back as the doubles they are. */
#include "layer/proof.h"

#include "base/interrupt.h"
#include "base/json.h"
#include "layer/output.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { VERSION = 1 };

typedef struct proof_writer {
    gis_json json;
    const gis_layer_input *input;
    const sunder_report *report;
    size_t *next;  /* [features] of the same block, in the order of the input; the number of features: none follows */
    size_t *first; /* [features] of the block that is called by this one; likewise */
} proof_writer;

/* ---- Things ------------------------------------------------------------------------------------------------------ */

/* The FID, or, where FIDs tell nobody apart, the place in the input. */
static void put_feature(proof_writer *w, size_t feature)
{
    if (gis_source_fids_unique(w->input->source))
        gis_json_signed(&w->json, gis_source_fid(w->input->source, feature));
    else
        gis_json_size(&w->json, feature);
}

/* A feature, or a barrier as "LAYER:FID". */
static void put_thing(proof_writer *w, const char *key, size_t thing)
{
    if (key) gis_json_key(&w->json, key);
    if (thing < w->input->n) {
        put_feature(w, thing);
        return;
    }
    const gis_barrier_feature *barrier = gis_barrier_of(w->input, thing);
    gis_text name = {0};
    gis_text_print(&name, "%s:" CPL_FRMT_GIB, gis_barrier_layer(w->input, barrier), barrier->fid);
    if (gis_text_get(&name))
        gis_json_string(&w->json, gis_text_get(&name));
    else
        w->json.text.failed = true;
    gis_text_clear(&name);
}

static void put_place(proof_writer *w, const char *key, double x, double y)
{
    if (key) gis_json_key(&w->json, key);
    gis_json_open(&w->json, '[');
    gis_json_double(&w->json, x);
    gis_json_double(&w->json, y);
    gis_json_close(&w->json, ']');
}

static void put_corners(proof_writer *w, const char *key, const double *xy, size_t n)
{
    gis_json_key(&w->json, key);
    gis_json_open(&w->json, '[');
    for (size_t k = 0; k < n; k++) put_place(w, NULL, xy[2 * k], xy[2 * k + 1]);
    gis_json_close(&w->json, ']');
}

static void put_sizes(proof_writer *w, const char *key, const size_t *number, size_t n)
{
    gis_json_key(&w->json, key);
    gis_json_open(&w->json, '[');
    for (size_t k = 0; k < n; k++) gis_json_size(&w->json, number[k]);
    gis_json_close(&w->json, ']');
}

static void end_line(proof_writer *w)
{
    gis_json_close(&w->json, '}');
    gis_json_raw(&w->json, "\n");
    w->json.need_comma = false;
}

/* Members of blocks as lists, in the order of the input. */
static bool list_blocks(proof_writer *w, gis_error *error)
{
    const size_t n = w->input->n;
    w->next = malloc((n + 1) * sizeof *w->next);
    w->first = malloc((n + 1) * sizeof *w->first);
    if (!w->next || !w->first) return gis_no_memory(error);
    for (size_t i = 0; i < n; i++) w->first[i] = n;
    for (size_t i = n; i-- > 0;) {
        const int64_t block = sunder_report_block(w->report, i);
        const size_t of = block < 0 ? i : (size_t)block;
        w->next[i] = w->first[of];
        w->first[of] = i;
    }
    return true;
}

/* ---- The problem ------------------------------------------------------------------------------------------------- */

static void put_problem(proof_writer *w, size_t trees, size_t conflicts)
{
    const gis_layer_rules *rules = &w->input->request->rules;
    sunder_layer_summary summary;
    sunder_report_summary(w->report, &summary);
    gis_json_open(&w->json, '{');
    gis_json_put_size(&w->json, "sunder_proof", VERSION);
    gis_json_put_string(&w->json, "layer", gis_source_name(w->input->source));
    gis_json_put_double(&w->json, "gap", w->input->gap);
    gis_json_put_double(&w->json, "max_shift", w->input->max_shift);
    gis_json_put_string(&w->json, "contained", sunder_containment_string(rules->contained));
    gis_json_put_bool(&w->json, "allow_jumps", w->input->points || rules->allow_jumps);
    gis_json_put_double(&w->json, "cost", summary.cost);
    gis_json_put_double(&w->json, "lower_bound", summary.lower_bound);
    gis_json_put_double(&w->json, "pair_bound", summary.pair_bound);
    gis_json_put_size(&w->json, "conflicts", conflicts);
    gis_json_put_size(&w->json, "trees", trees);
    end_line(w);
}

static void put_block(proof_writer *w, size_t first)
{
    gis_json_open(&w->json, '{');
    gis_json_key(&w->json, "block");
    gis_json_open(&w->json, '[');
    for (size_t i = w->first[first]; i < w->input->n; i = w->next[i]) put_feature(w, i);
    gis_json_close(&w->json, ']');
    end_line(w);
}

/* ---- Conflicts --------------------------------------------------------------------------------------------------- */

static void put_ways(proof_writer *w, const sunder_proof *proof, const sunder_proof_node *node)
{
    put_thing(w, "a", node->a);
    put_thing(w, "b", node->b);
    put_corners(w, "A", proof->corner + 2 * node->part_a, node->corners_a);
    put_corners(w, "B", proof->corner + 2 * node->part_b, node->corners_b);
    if (node->chord) {
        put_thing(w, "c", node->c);
        put_corners(w, "side_b", proof->corner + 2 * node->sides, 2);
        put_corners(w, "side_c", proof->corner + 2 * node->sides + 4, 2);
    }
    if (node->slack) gis_json_put_bool(&w->json, "slack", true);
    if (node->held) gis_json_put_bool(&w->json, "held", true);
    if (node->shadow)
        gis_json_put_bool(&w->json, "shadow", true);
    else
        gis_json_put_double(&w->json, "clearance", node->clearance);
    gis_json_key(&w->json, "ways");
    gis_json_open(&w->json, '[');
    for (size_t k = node->way; k < node->way + node->ways; k++) {
        const sunder_proof_way *way = &proof->way[k];
        gis_json_open(&w->json, '{');
        put_place(w, "n", way->n[0], way->n[1]);
        gis_json_put_double(&w->json, "d", way->d);
        gis_json_put_size(&w->json, "next", way->next);
        gis_json_close(&w->json, '}');
    }
    gis_json_close(&w->json, ']');
}

/* The two ways between whose lines a block stays where it is, each by its node and its place there. */
static void put_still(proof_writer *w, const sunder_proof *proof, const sunder_proof_node *leaf)
{
    gis_json_key(&w->json, "still");
    gis_json_open(&w->json, '[');
    for (size_t k = 0; k < 2; k++) {
        gis_json_open(&w->json, '[');
        gis_json_size(&w->json, leaf->line_node[k]);
        gis_json_size(&w->json, leaf->line_way[k] - proof->node[leaf->line_node[k]].way);
        gis_json_close(&w->json, ']');
    }
    gis_json_close(&w->json, ']');
}

static void put_proof(proof_writer *w, const sunder_proof *proof)
{
    gis_json_key(&w->json, "proof");
    gis_json_open(&w->json, '[');
    for (size_t k = 0; k < proof->nodes; k++) {
        const sunder_proof_node *node = &proof->node[k];
        gis_json_open(&w->json, '{');
        if (node->ways) put_ways(w, proof, node);
        gis_json_key(&w->json, "forces");
        gis_json_open(&w->json, '[');
        for (size_t f = node->force; f < node->force + node->forces; f++) {
            const sunder_proof_force *force = &proof->force[f];
            gis_json_open(&w->json, '{');
            gis_json_put_size(&w->json, "node", force->node);
            gis_json_put_size(&w->json, "way", force->way - proof->node[force->node].way);
            gis_json_put_bool(&w->json, "behind", force->behind);
            gis_json_put_double(&w->json, "force", force->force);
            gis_json_close(&w->json, '}');
        }
        gis_json_close(&w->json, ']');
        if (node->still) put_still(w, proof, node);
        gis_json_close(&w->json, '}');
    }
    gis_json_close(&w->json, ']');
}

static void put_conflict(proof_writer *w, size_t k, const sunder_conflict *c)
{
    const sunder_proof *proof = sunder_report_proof(w->report, k);
    gis_json_open(&w->json, '{');
    gis_json_put_size(&w->json, "conflict", k);
    put_thing(w, "a", c->a);
    put_thing(w, "b", c->b);
    gis_json_put_string(&w->json, "kind", sunder_conflict_kind_string(c->kind));
    gis_json_put_string(&w->json, "reason", sunder_reason_string(c->reason));
    if (c->inside_block) gis_json_put_bool(&w->json, "inside_block", true);
    gis_json_key(&w->json, "blocked_by");
    gis_json_open(&w->json, '[');
    for (size_t i = 0; i < c->n_blocked_by; i++) put_thing(w, NULL, c->blocked_by[i]);
    gis_json_close(&w->json, ']');
    if (proof && proof->within > 0) gis_json_put_double(&w->json, "within", proof->within);
    if (proof) put_proof(w, proof);
    end_line(w);
}

/* ---- Trees ------------------------------------------------------------------------------------------------------- */

static void put_members(proof_writer *w, size_t thing)
{
    const size_t n = w->input->n;
    const int64_t block = sunder_report_block(w->report, thing);
    const size_t first = w->first[block < 0 ? thing : (size_t)block];
    gis_json_key(&w->json, "features");
    gis_json_open(&w->json, '[');
    for (size_t i = first; i < n; i = w->next[i]) {
        const sunder_feature *f = &w->input->feature[i];
        gis_json_open(&w->json, '{');
        gis_json_key(&w->json, "fid");
        put_feature(w, i);
        gis_json_put_double(&w->json, "weight", f->weight);
        gis_json_put_double(&w->json, "max_shift", f->max_shift);
        if (f->shape) {
            double at[2];
            sunder_shape_anchor(f->shape, at);
            put_place(w, "anchor", at[0], at[1]);
        }
        gis_json_close(&w->json, '}');
    }
    gis_json_close(&w->json, ']');
}

static void put_body(proof_writer *w, const sunder_bound_body *body)
{
    gis_json_open(&w->json, '{');
    if (body->thing < w->input->n)
        put_members(w, body->thing);
    else
        put_thing(w, "barrier", body->thing);
    gis_json_put_double(&w->json, "weight", body->weight);
    put_place(w, "shift", body->shift[0], body->shift[1]);
    gis_json_close(&w->json, '}');
}

static void put_piece(proof_writer *w, const sunder_bound_tree *tree, const sunder_bound_piece *piece)
{
    gis_json_open(&w->json, '{');
    gis_json_put_size(&w->json, "i", piece->i);
    gis_json_put_size(&w->json, "j", piece->j);
    put_thing(w, "a", piece->a);
    put_thing(w, "b", piece->b);
    if (piece->shadow) gis_json_put_bool(&w->json, "shadow", true);
    if (!isnan(piece->clearance)) gis_json_put_double(&w->json, "clearance", piece->clearance);
    put_corners(w, "A", tree->corner + 2 * piece->part_a, piece->corners_a);
    put_corners(w, "B", tree->corner + 2 * piece->part_b, piece->corners_b);
    gis_json_close(&w->json, '}');
}

static void put_cut(proof_writer *w, const sunder_bound_tree *tree, const sunder_bound_cut *cut)
{
    static const char *const kinds[] = {[SUNDER_BOUND_CUT_LIMIT] = "limit",
                                        [SUNDER_BOUND_CUT_CONE] = "cone",
                                        [SUNDER_BOUND_CUT_DISC] = "disc",
                                        [SUNDER_BOUND_CUT_HULL] = "hull"};
    gis_json_open(&w->json, '{');
    gis_json_put_string(&w->json, "kind", kinds[cut->kind]);
    gis_json_put_size(&w->json, "i", cut->i);
    if (cut->j != SIZE_MAX) gis_json_put_size(&w->json, "j", cut->j);
    put_place(w, "n", cut->n[0], cut->n[1]);
    gis_json_put_double(&w->json, "d", cut->d);
    if (cut->kind == SUNDER_BOUND_CUT_HULL) put_sizes(w, "pieces", tree->named + cut->named, cut->names);
    gis_json_close(&w->json, '}');
}

static void put_forces(proof_writer *w, const char *key, const sunder_bound_force *force, size_t n)
{
    gis_json_key(&w->json, key);
    gis_json_open(&w->json, '[');
    for (size_t k = 0; k < n; k++) {
        gis_json_open(&w->json, '[');
        gis_json_size(&w->json, force[k].cut);
        gis_json_double(&w->json, force[k].force);
        gis_json_close(&w->json, ']');
    }
    gis_json_close(&w->json, ']');
}

static bool are_same_forces(const sunder_bound_tree *tree, const sunder_bound_node *p, const sunder_bound_node *q)
{
    bool same = q->bys == p->forces;
    for (size_t k = 0; same && k < q->bys; k++) {
        const sunder_bound_force *f = &tree->force[q->by + k], *g = &tree->force[p->force + k];
        same = f->cut == g->cut && f->force == g->force;
    }
    return same;
}

static void put_node(proof_writer *w, const sunder_bound_tree *tree, const sunder_bound_node *node)
{
    gis_json_open(&w->json, '{');
    gis_json_key(&w->json, "parent");
    if (node->parent == SIZE_MAX)
        gis_json_null(&w->json);
    else
        gis_json_size(&w->json, node->parent);
    gis_json_key(&w->json, "cuts");
    gis_json_open(&w->json, '[');
    for (size_t k = node->cut; k < node->cut + node->cuts; k++) put_cut(w, tree, &tree->cut[k]);
    gis_json_close(&w->json, ']');
    if (node->bys && !are_same_forces(tree, &tree->node[node->parent], node))
        put_forces(w, "by", tree->force + node->by, node->bys);
    put_forces(w, "forces", tree->force + node->force, node->forces);
    if (node->empty) {
        gis_json_key(&w->json, "empty");
        gis_json_open(&w->json, '{');
        gis_json_put_size(&w->json, "i", node->i);
        gis_json_put_size(&w->json, "j", node->j);
        put_sizes(w, "pieces", tree->named + node->named, node->names);
        gis_json_close(&w->json, '}');
    }
    gis_json_close(&w->json, '}');
}

static bool put_tree(proof_writer *w, const sunder_bound_tree *tree, gis_error *error)
{
    gis_json_open(&w->json, '{');
    gis_json_put_size(&w->json, "group", tree->group);
    gis_json_put_double(&w->json, "bound", tree->bound);
    gis_json_key(&w->json, "bodies");
    gis_json_open(&w->json, '[');
    for (size_t k = 0; k < tree->bodies; k++) put_body(w, &tree->body[k]);
    gis_json_close(&w->json, ']');
    gis_json_key(&w->json, "pieces");
    gis_json_open(&w->json, '[');
    for (size_t k = 0; k < tree->pieces; k++) put_piece(w, tree, &tree->piece[k]);
    gis_json_close(&w->json, ']');
    gis_json_key(&w->json, "nodes");
    gis_json_open(&w->json, '[');
    for (size_t k = 0; k < tree->nodes; k++) {
        if (!gis_go_on(error)) return false;
        put_node(w, tree, &tree->node[k]);
    }
    gis_json_close(&w->json, ']');
    end_line(w);
    return true;
}

bool gis_proof_write(const gis_layer_input *input, const sunder_report *report, gis_text *out, gis_error *error)
{
    proof_writer w = {.input = input, .report = report};
    size_t conflicts, trees;
    const sunder_conflict *conflict = sunder_report_conflicts(report, &conflicts);
    const sunder_bound_tree *tree = sunder_report_bound_trees(report, &trees);
    bool ok = list_blocks(&w, error);
    if (ok) put_problem(&w, trees, conflicts);
    for (size_t i = 0; ok && i < input->n; i++)
        if (sunder_report_block(report, i) == (int64_t)i) put_block(&w, i);
    for (size_t k = 0; ok && k < conflicts; k++) put_conflict(&w, k, &conflict[k]);
    for (size_t k = 0; ok && k < trees; k++) ok = put_tree(&w, &tree[k], error);
    free(w.next);
    free(w.first);
    if (ok && w.json.text.failed) ok = gis_no_memory(error);
    if (ok) {
        *out = w.json.text;
        w.json.text = (gis_text){0};
    }
    gis_json_clear(&w.json);
    return ok;
}
