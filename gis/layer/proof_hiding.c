/* proof_hiding.c: the lines of --proof about what is hidden, larger or smaller: larger and smaller shapes, the clauses
 * with their proofs, and the trees of the bound. */
#include "layer/proof_lines.h"

static void put_polygons(gis_proof_lines *lines, const sunder_shape *shape)
{
    gis_json *json = &lines->json;
    gis_json_key(json, "polygons");
    gis_json_open(json, '[');
    for (size_t p = 0; p < sunder_shape_polygons(shape); p++) {
        gis_json_open(json, '[');
        for (size_t r = 0; r < sunder_shape_rings(shape, p); r++) {
            size_t n;
            const double *xy = sunder_shape_ring(shape, p, r, &n);
            gis_proof_corners(lines, NULL, xy, n);
        }
        gis_json_close(json, ']');
    }
    gis_json_close(json, ']');
}

void gis_proof_larger(gis_proof_lines *lines, size_t feature, const sunder_shape *shape)
{
    gis_proof_thing(lines, "fid", feature);
    put_polygons(lines, shape);
}

void gis_proof_shape(gis_proof_lines *lines, size_t feature, size_t level, size_t rung, const sunder_shape *shape)
{
    gis_json *json = &lines->json;
    gis_proof_thing(lines, "fid", feature);
    gis_json_put_size(json, "level", level);
    gis_json_put_size(json, "rung", rung);
    if (sunder_report_level(lines->report, feature) == level) gis_json_put_bool(json, "taken", true);
    put_polygons(lines, shape);
}

void gis_proof_clause(gis_proof_lines *lines, const sunder_clause *clause)
{
    gis_json *json = &lines->json;
    gis_json_key(json, "members");
    gis_json_open(json, '[');
    for (size_t m = 0; m < clause->members; m++) {
        gis_json_open(json, '[');
        gis_proof_thing(lines, NULL, clause->member[m]);
        gis_json_size(json, clause->level[m]);
        gis_json_close(json, ']');
    }
    gis_json_close(json, ']');
    gis_proof_thing(lines, "a", clause->a < clause->b ? clause->a : clause->b);
    gis_proof_thing(lines, "b", clause->a < clause->b ? clause->b : clause->a);
    gis_proof_reason(lines, clause->reason, clause->crowded);
    gis_proof_nodes(lines, clause->proof);
}

static void put_weight(gis_json *json, const sunder_hiding_share *share)
{
    gis_proof_class(json, share->hierarchy);
    gis_json_signed(json, share->weight);
    gis_json_close(json, ']');
}

/* The numbers of clauses, and whether they get a mark. */
typedef struct numbering {
    const size_t *of;
    bool marked;
} numbering;

static void put_number(gis_json *json, const numbering *number, size_t clause)
{
    if (number->marked) {
        gis_json_raw(json, json->need_comma ? ", " : "");
        gis_json_raw(json, (char[]){GIS_PROOF_MARK, '\0'});
        json->need_comma = false;
    }
    gis_json_size(json, number->of[clause]);
}

static void put_shares(gis_json *json, const sunder_hiding_share *share, size_t n, const numbering *clause)
{
    gis_json_key(json, "shares");
    gis_json_open(json, '[');
    for (size_t k = 0; k < n; k++) {
        gis_json_open(json, '[');
        put_number(json, clause, share[k].clause);
        put_weight(json, &share[k]);
    }
    gis_json_close(json, ']');
}

static void put_node(gis_proof_lines *lines, const sunder_hiding_node *node, const sunder_hiding_share *share,
                     const numbering *clause)
{
    gis_json *json = &lines->json;
    gis_json_open(json, '{');
    if (node->kind == SUNDER_HIDING_NODE_SPLIT) {
        gis_proof_thing(lines, "split", node->feature);
        gis_json_put_size(json, "level", node->level);
    } else if (node->kind == SUNDER_HIDING_NODE_UNMET) {
        gis_json_key(json, "unmet");
        put_number(json, clause, node->clause);
    } else {
        put_shares(json, share + node->share, node->shares, clause);
    }
    gis_json_close(json, '}');
}

void gis_proof_choice(gis_proof_lines *lines, size_t k, const size_t *clause, bool within)
{
    const numbering number = {clause, within};
    const sunder_hiding_trees *trees = sunder_report_hiding_trees(lines->report);
    const sunder_hiding_tree *tree = &trees->tree[k];
    gis_json *json = &lines->json;
    gis_json_key(json, "bound");
    gis_json_open(json, '[');
    for (size_t i = tree->bound; i < tree->bound + tree->bounds; i++) {
        gis_json_open(json, '[');
        put_weight(json, &trees->share[i]);
    }
    gis_json_close(json, ']');
    gis_json_key(json, "nodes");
    gis_json_open(json, '[');
    for (size_t i = tree->node; i < tree->node + tree->nodes; i++)
        put_node(lines, &trees->node[i], trees->share, &number);
    gis_json_close(json, ']');
}
