/* proof_lines.c: see proof_lines.h. Each double is written as the shortest decimal that reads back as the same
 * double. */
#include "layer/proof_lines.h"

#include "base/interrupt.h"
#include "layer/layer_rules.h"

#include <cpl_port.h>
#include <math.h>
#include <stdlib.h>

enum { VERSION = 2 };

/* ---- Things ------------------------------------------------------------------------------------------------------ */

static void put_feature(gis_proof_lines *w, size_t feature)
{
    gis_json_signed(&w->json, w->things.feature(w->things.of, feature));
}

void gis_proof_thing(gis_proof_lines *w, const char *key, size_t thing)
{
    if (key) gis_json_key(&w->json, key);
    if (thing < w->things.n) {
        put_feature(w, thing);
        return;
    }
    const char *layer;
    const int64_t fid = w->things.barrier(w->things.of, thing, &layer);
    gis_text name = {0};
    gis_text_print(&name, "%s:" CPL_FRMT_GIB, layer, (GIntBig)fid);
    if (gis_text_get(&name))
        gis_json_string(&w->json, gis_text_get(&name));
    else
        w->json.text.failed = true;
    gis_text_clear(&name);
}

static void put_place(gis_json *json, const char *key, double x, double y)
{
    if (key) gis_json_key(json, key);
    gis_json_open(json, '[');
    gis_json_double(json, x);
    gis_json_double(json, y);
    gis_json_close(json, ']');
}

void gis_proof_corners(gis_proof_lines *w, const char *key, const double *xy, size_t n)
{
    if (key) gis_json_key(&w->json, key);
    gis_json_open(&w->json, '[');
    for (size_t k = 0; k < n; k++) put_place(&w->json, NULL, xy[2 * k], xy[2 * k + 1]);
    gis_json_close(&w->json, ']');
}

static void put_sizes(gis_proof_lines *w, const char *key, const size_t *number, size_t n)
{
    gis_json_key(&w->json, key);
    gis_json_open(&w->json, '[');
    for (size_t k = 0; k < n; k++) gis_json_size(&w->json, number[k]);
    gis_json_close(&w->json, ']');
}

/* Makes linked lists of the members of each block, in input order. */
static bool list_blocks(gis_proof_lines *w, gis_error *error)
{
    const size_t n = w->things.n;
    w->next = malloc((n + 1) * sizeof *w->next);
    w->first = malloc((n + 1) * sizeof *w->first);
    if (!w->next || !w->first) return gis_no_memory(error);
    for (size_t i = 0; i < n; i++) w->first[i] = n;
    for (size_t i = n; i-- > 0;) {
        const size_t of = gis_proof_block(w, i);
        w->next[i] = w->first[of];
        w->first[of] = i;
    }
    return true;
}

size_t gis_proof_block(const gis_proof_lines *lines, size_t feature)
{
    const int64_t block = sunder_report_block(lines->report, feature);
    return block < 0 ? feature : (size_t)block;
}

bool gis_proof_lines_begin(gis_proof_lines *lines, const gis_proof_things *things, const sunder_report *report,
                           gis_error *error)
{
    *lines = (gis_proof_lines){.things = *things, .report = report};
    return list_blocks(lines, error);
}

void gis_proof_lines_clear(gis_proof_lines *lines)
{
    free(lines->next);
    free(lines->first);
    gis_json_clear(&lines->json);
    *lines = (gis_proof_lines){0};
}

/* ---- Conflicts --------------------------------------------------------------------------------------------------- */

static void put_parts(gis_proof_lines *w, const sunder_proof *proof, const sunder_proof_node *node)
{
    gis_proof_corners(w, "A", proof->corner + 2 * node->part_a, node->corners_a);
    gis_proof_corners(w, "B", proof->corner + 2 * node->part_b, node->corners_b);
    if (node->chord) {
        gis_proof_thing(w, "c", node->c);
        gis_proof_corners(w, "side_b", proof->corner + 2 * node->sides, 2);
        gis_proof_corners(w, "side_c", proof->corner + 2 * node->sides + 4, 2);
    }
    if (node->slack) gis_json_put_bool(&w->json, "slack", true);
    if (node->held) gis_json_put_bool(&w->json, "held", true);
    if (node->shadow)
        gis_json_put_bool(&w->json, "shadow", true);
    else
        gis_json_put_double(&w->json, "clearance", node->clearance);
}

static void put_ways(gis_proof_lines *w, const sunder_proof *proof, const sunder_proof_node *node)
{
    gis_proof_thing(w, "a", node->a);
    gis_proof_thing(w, "b", node->b);
    if (node->row)
        gis_json_put_bool(&w->json, "row", true);
    else
        put_parts(w, proof, node);
    gis_json_key(&w->json, "ways");
    gis_json_open(&w->json, '[');
    for (size_t k = node->way; k < node->way + node->ways; k++) {
        const sunder_proof_way *way = &proof->way[k];
        gis_json_open(&w->json, '{');
        put_place(&w->json, "n", way->n[0], way->n[1]);
        gis_json_put_double(&w->json, "d", way->d);
        gis_json_put_size(&w->json, "next", way->next);
        gis_json_close(&w->json, '}');
    }
    gis_json_close(&w->json, ']');
}

/* Writes the two alternatives between whose lines a block cannot move, each as a node and its number there. */
static void put_still(gis_proof_lines *w, const sunder_proof *proof, const sunder_proof_node *leaf)
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

void gis_proof_nodes(gis_proof_lines *w, const sunder_proof *proof)
{
    if (!proof) return;
    if (proof->within > 0) gis_json_put_double(&w->json, "within", proof->within);
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

void gis_proof_reason(gis_proof_lines *lines, sunder_reason reason, bool crowded)
{
    gis_json_put_string(&lines->json, "reason", sunder_reason_string(reason));
    if (crowded) gis_json_put_bool(&lines->json, "crowded", true);
}

void gis_proof_conflict(gis_proof_lines *lines, size_t k)
{
    size_t n;
    const sunder_conflict *c = &sunder_report_conflicts(lines->report, &n)[k];
    const sunder_proof *proof = sunder_report_proof(lines->report, k);
    gis_proof_thing(lines, "a", c->a);
    gis_proof_thing(lines, "b", c->b);
    gis_json_put_string(&lines->json, "kind", sunder_conflict_kind_string(c->kind));
    gis_proof_reason(lines, c->reason, c->crowded);
    if (c->inside_block) gis_json_put_bool(&lines->json, "inside_block", true);
    gis_json_key(&lines->json, "blocked_by");
    gis_json_open(&lines->json, '[');
    for (size_t i = 0; i < c->n_blocked_by; i++) gis_proof_thing(lines, NULL, c->blocked_by[i]);
    gis_json_close(&lines->json, ']');
    gis_proof_nodes(lines, proof);
}

/* ---- Trees ------------------------------------------------------------------------------------------------------- */

/* Writes the class of a thing for gaps, if gaps depend on classes. */
static void put_class(gis_proof_lines *w, size_t thing)
{
    if (w->things.class) gis_json_put_size(&w->json, "class", w->things.class(w->things.of, thing));
}

static void put_barrier(gis_proof_lines *w, size_t barrier)
{
    gis_proof_thing(w, "barrier", barrier);
    put_class(w, barrier);
}

static void put_members(gis_proof_lines *w, size_t thing)
{
    const size_t n = w->things.n, first = w->first[gis_proof_block(w, thing)];
    gis_json_key(&w->json, "features");
    gis_json_open(&w->json, '[');
    for (size_t i = first; i < n; i = w->next[i]) {
        if (sunder_report_status(w->report, i) == SUNDER_FEATURE_HIDDEN) continue;
        const sunder_feature *f = w->things.demands(w->things.of, i);
        gis_json_open(&w->json, '{');
        gis_json_key(&w->json, "fid");
        put_feature(w, i);
        gis_json_put_double(&w->json, "weight", f->weight);
        gis_json_put_double(&w->json, "max_shift", f->max_shift);
        put_class(w, i);
        if (f->shape) {
            double at[2];
            sunder_shape_anchor(f->shape, at);
            put_place(&w->json, "anchor", at[0], at[1]);
        }
        gis_json_close(&w->json, '}');
    }
    gis_json_close(&w->json, ']');
}

static void put_body(gis_proof_lines *w, const sunder_bound_body *body)
{
    gis_json_open(&w->json, '{');
    if (body->thing < w->things.n)
        put_members(w, body->thing);
    else
        put_barrier(w, body->thing);
    gis_json_put_double(&w->json, "weight", body->weight);
    put_place(&w->json, "shift", body->shift[0], body->shift[1]);
    gis_json_close(&w->json, '}');
}

static void put_piece(gis_proof_lines *w, const sunder_bound_tree *tree, const sunder_bound_piece *piece)
{
    gis_json_open(&w->json, '{');
    gis_json_put_size(&w->json, "i", piece->i);
    gis_json_put_size(&w->json, "j", piece->j);
    gis_proof_thing(w, "a", piece->a);
    gis_proof_thing(w, "b", piece->b);
    if (piece->row) {
        gis_json_put_bool(&w->json, "row", true);
        if (piece->priced) gis_json_put_bool(&w->json, "priced", true);
        gis_json_close(&w->json, '}');
        return;
    }
    if (piece->joined) {
        gis_proof_corners(w, "joined", tree->corner + 2 * piece->part_a, piece->corners_a);
        put_sizes(w, "pieces", tree->named + piece->named, piece->names);
        gis_json_close(&w->json, '}');
        return;
    }
    if (piece->shadow) gis_json_put_bool(&w->json, "shadow", true);
    if (piece->priced) gis_json_put_bool(&w->json, "priced", true);
    if (!isnan(piece->clearance)) gis_json_put_double(&w->json, "clearance", piece->clearance);
    gis_proof_corners(w, "A", tree->corner + 2 * piece->part_a, piece->corners_a);
    gis_proof_corners(w, "B", tree->corner + 2 * piece->part_b, piece->corners_b);
    gis_json_close(&w->json, '}');
}

static void put_cut(gis_proof_lines *w, const sunder_bound_tree *tree, const sunder_bound_cut *cut)
{
    static const char *const kinds[] = {[SUNDER_BOUND_CUT_LIMIT] = "limit",
                                        [SUNDER_BOUND_CUT_CONE] = "cone",
                                        [SUNDER_BOUND_CUT_DISC] = "disc",
                                        [SUNDER_BOUND_CUT_HULL] = "hull",
                                        [SUNDER_BOUND_CUT_PRICE] = "price"};
    const bool price = cut->kind == SUNDER_BOUND_CUT_PRICE;
    gis_json_open(&w->json, '{');
    gis_json_put_string(&w->json, "kind", kinds[cut->kind]);
    gis_json_put_size(&w->json, "i", cut->i);
    if (cut->j != SIZE_MAX) gis_json_put_size(&w->json, "j", cut->j);
    put_place(&w->json, "n", cut->n[0], cut->n[1]);
    gis_json_put_double(&w->json, "d", cut->d);
    if (price) gis_json_put_double(&w->json, "share", cut->share);
    if (price || cut->kind == SUNDER_BOUND_CUT_HULL) put_sizes(w, "pieces", tree->named + cut->named, cut->names);
    gis_json_close(&w->json, '}');
}

static void put_springs(gis_proof_lines *w, const sunder_bound_tree *tree)
{
    gis_json_key(&w->json, "springs");
    gis_json_open(&w->json, '[');
    for (size_t k = 0; k < tree->springs; k++) {
        const sunder_bound_cut *spring = &tree->cut[k];
        gis_json_open(&w->json, '{');
        gis_json_put_size(&w->json, "i", spring->i);
        gis_json_put_size(&w->json, "j", spring->j);
        put_place(&w->json, "n", spring->n[0], spring->n[1]);
        gis_json_put_double(&w->json, "stiff", spring->stiff);
        gis_json_close(&w->json, '}');
    }
    gis_json_close(&w->json, ']');
}

static void put_eased(gis_proof_lines *w, const sunder_bound_tree *tree)
{
    gis_json_key(&w->json, "eased");
    gis_json_open(&w->json, '[');
    for (size_t k = 0; k < tree->eased_pairs; k++) {
        gis_json_open(&w->json, '[');
        gis_json_size(&w->json, tree->eased[k].i);
        gis_json_size(&w->json, tree->eased[k].j);
        gis_json_close(&w->json, ']');
    }
    gis_json_close(&w->json, ']');
}

static void put_forces(gis_proof_lines *w, const char *key, const sunder_bound_force *force, size_t n)
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

static bool has_disc(const sunder_bound_tree *tree, const sunder_bound_node *node)
{
    for (size_t k = node->cut; k < node->cut + node->cuts; k++)
        if (tree->cut[k].kind == SUNDER_BOUND_CUT_DISC) return true;
    return false;
}

static void put_node(gis_proof_lines *w, const sunder_bound_tree *tree, const sunder_bound_node *node)
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
    if (has_disc(tree, node) && !are_same_forces(tree, &tree->node[node->parent], node))
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

/* Writes a row of prices as the index of the first price that is not 0, followed by the prices from there to the last
 * that is not 0; an empty list if all are 0. */
static void put_price_row(gis_proof_lines *w, const uint32_t *price, size_t columns)
{
    size_t first = 0, end = columns;
    while (first < columns && !price[first]) first++;
    while (end > first && !price[end - 1]) end--;
    gis_json_open(&w->json, '[');
    if (first < end) gis_json_size(&w->json, first);
    for (size_t k = first; k < end; k++) gis_json_size(&w->json, price[k]);
    gis_json_close(&w->json, ']');
}

static void put_prices(gis_proof_lines *w, const sunder_bound_prices *prices)
{
    gis_json_key(&w->json, "prices");
    gis_json_open(&w->json, '{');
    gis_json_put_double(&w->json, "side", prices->side);
    gis_json_put_double(&w->json, "unit", prices->unit);
    gis_json_key(&w->json, "x");
    gis_json_signed(&w->json, prices->x);
    gis_json_key(&w->json, "y");
    gis_json_signed(&w->json, prices->y);
    gis_json_put_size(&w->json, "columns", prices->columns);
    gis_json_key(&w->json, "rows");
    gis_json_open(&w->json, '[');
    for (size_t j = 0; j < prices->rows; j++) put_price_row(w, prices->price + j * prices->columns, prices->columns);
    gis_json_close(&w->json, ']');
    gis_json_close(&w->json, '}');
}

bool gis_proof_tree(gis_proof_lines *lines, const sunder_bound_tree *tree, gis_error *error)
{
    gis_json_put_double(&lines->json, "bound", tree->bound);
    gis_json_key(&lines->json, "bodies");
    gis_json_open(&lines->json, '[');
    for (size_t k = 0; k < tree->bodies; k++) put_body(lines, &tree->body[k]);
    gis_json_close(&lines->json, ']');
    if (tree->prices.price) {
        put_prices(lines, &tree->prices);
        return gis_go_on(error);
    }
    gis_json_key(&lines->json, "pieces");
    gis_json_open(&lines->json, '[');
    for (size_t k = 0; k < tree->pieces; k++) put_piece(lines, tree, &tree->piece[k]);
    gis_json_close(&lines->json, ']');
    if (tree->springs) put_springs(lines, tree);
    if (tree->eased_pairs) put_eased(lines, tree);
    gis_json_key(&lines->json, "nodes");
    gis_json_open(&lines->json, '[');
    for (size_t k = 0; k < tree->nodes; k++) {
        if (!gis_go_on(error)) return false;
        put_node(lines, tree, &tree->node[k]);
    }
    gis_json_close(&lines->json, ']');
    return true;
}

/* ---- Whole lines, and lines about the layer ---------------------------------------------------------------------- */

static void end_line(gis_json *json)
{
    gis_json_close(json, '}');
    gis_json_raw(json, "\n");
    json->need_comma = false;
}

void gis_proof_row_line(gis_json *json, size_t number, const int64_t name[2], const sunder_row_pair *pair)
{
    gis_json_open(json, '{');
    gis_json_put_size(json, "row", number);
    gis_json_key(json, "a");
    gis_json_signed(json, name[0]);
    gis_json_key(json, "b");
    gis_json_signed(json, name[1]);
    put_place(json, "along", pair->along[0], pair->along[1]);
    gis_json_put_double(json, "apart", pair->apart);
    end_line(json);
}

void gis_proof_hidden_line(gis_json *json, size_t number, int64_t name)
{
    gis_json_open(json, '{');
    gis_json_put_size(json, "hidden", number);
    gis_json_key(json, "fid");
    gis_json_signed(json, name);
    end_line(json);
}

void gis_proof_line(gis_json *json, const char *key, size_t number, const char *rest)
{
    gis_json_open(json, '{');
    gis_json_put_size(json, key, number);
    gis_json_raw(json, ", ");
    gis_json_raw(json, rest);
    end_line(json);
}

void gis_proof_class(gis_json *json, uint32_t hierarchy)
{
    if (hierarchy == GIS_LAST_CLASS)
        gis_json_null(json);
    else
        gis_json_size(json, hierarchy);
}

/* Writes a table of gaps: of each class, those to the classes up to itself. */
static void put_table(gis_json *json, const char *key, const double *table, size_t classes)
{
    gis_json_key(json, key);
    gis_json_open(json, '[');
    for (size_t i = 0; i < classes; i++) {
        gis_json_open(json, '[');
        for (size_t j = 0; j <= i; j++) gis_json_double(json, table[i * classes + j]);
        gis_json_close(json, ']');
    }
    gis_json_close(json, ']');
}

static void put_gaps(gis_json *json, const gis_proof_gaps *gaps)
{
    gis_json_key(json, "classes");
    gis_json_open(json, '[');
    for (size_t k = 1; k < gaps->classes; k++) gis_json_string(json, gaps->name[k]);
    gis_json_close(json, ']');
    put_table(json, "gaps", gaps->full, gaps->classes);
    if (gaps->gap) put_table(json, "least_gaps", gaps->gap, gaps->classes);
}

static void put_hiding(gis_json *json, const gis_proof_head *head)
{
    gis_json_key(json, "hide");
    gis_json_open(json, '{');
    gis_json_put_size(json, "hidden", head->hidden);
    if (head->enlarge) gis_json_put_size(json, "larger", head->larger);
    gis_json_put_size(json, "shapes", head->shapes);
    gis_json_put_size(json, "clauses", head->clauses);
    gis_json_put_size(json, "choices", head->choices);
    gis_json_key(json, "bound");
    gis_json_open(json, '[');
    for (size_t k = 0; k < head->classes; k++) {
        if (head->class[k].least == 0) continue;
        gis_json_open(json, '[');
        gis_proof_class(json, head->class[k].hierarchy);
        gis_json_signed(json, head->class[k].least);
        gis_json_close(json, ']');
    }
    gis_json_close(json, ']');
    gis_json_close(json, '}');
}

void gis_proof_head_line(gis_json *json, const gis_proof_head *head)
{
    gis_json_open(json, '{');
    gis_json_put_size(json, "sunder_proof", VERSION);
    gis_json_put_string(json, "layer", head->layer);
    gis_json_put_double(json, "gap", fmax(head->how.gap, head->how.full_gap));
    if (head->how.full_gap > 0) gis_json_put_double(json, "least_gap", head->how.gap);
    if (head->gaps.classes) put_gaps(json, &head->gaps);
    gis_json_put_double(json, "max_shift", head->max_shift);
    gis_json_put_string(json, "contained", sunder_containment_string(head->how.contained));
    gis_json_put_bool(json, "allow_jumps", head->how.allow_jumps);
    if (head->how.rows) {
        gis_json_key(json, "row_stiffness");
        gis_json_open(json, '[');
        for (size_t k = 0; k < 2; k++) gis_json_double(json, head->how.row_stiffness[k]);
        gis_json_close(json, ']');
    }
    if (head->how.ease > 0) gis_json_put_double(json, "ease", head->how.ease);
    gis_json_put_double(json, "lower_bound", head->summary->lower_bound);
    gis_json_put_size(json, "conflicts", head->conflicts);
    gis_json_put_size(json, "trees", head->trees);
    if (head->hide) put_hiding(json, head);
    if (head->sheet) {
        gis_json_key(json, "spec");
        gis_json_raw(json, head->sheet);
    }
    end_line(json);
}

void gis_proof_block_begins(gis_json *json)
{
    gis_json_open(json, '{');
    gis_json_key(json, "block");
    gis_json_open(json, '[');
}

void gis_proof_block_ends(gis_json *json)
{
    gis_json_close(json, ']');
    end_line(json);
}

bool gis_proof_print(gis_json *json, FILE *to, gis_error *error)
{
    const char *text = gis_json_text(json);
    if (!text) return gis_no_memory(error);
    const bool done = fwrite(text, 1, json->text.length, to) == json->text.length;
    gis_text_empty(&json->text);
    return done && gis_go_on(error);
}

/* ---- The order of trees ------------------------------------------------------------------------------------------ */

static size_t first_of_tree(const gis_proof_lines *w, const sunder_bound_tree *tree)
{
    size_t first = SIZE_MAX;
    for (size_t k = 0; k < tree->bodies; k++) {
        const sunder_bound_body *body = &tree->body[k];
        if (body->thing >= w->things.n || !isfinite(body->weight)) continue;
        const size_t own = gis_proof_block(w, body->thing);
        if (own < first) first = own;
    }
    return first;
}

bool gis_proof_order(const gis_proof_lines *lines, gis_proof_place **out, size_t *n, gis_error *error)
{
    const sunder_bound_tree *tree = sunder_report_bound_trees(lines->report, n);
    gis_proof_place *place = *out = malloc((*n + 1) * sizeof *place);
    if (!place) return gis_no_memory(error);
    for (size_t from = 0, end; from < *n; from = end) {
        size_t first = SIZE_MAX;
        for (end = from; end < *n && tree[end].group == tree[from].group; end++) {
            const size_t own = first_of_tree(lines, &tree[end]);
            if (own < first) first = own;
        }
        for (size_t k = from; k < end; k++) place[k] = (gis_proof_place){first, k - from, k};
    }
    return true;
}
