/* proof_lines.h: the file of --proof, line by line, as docs/PROOF.md describes it: the proofs of the lower bound and of
 * the verdicts.
 *
 * Statements about a conflict or a tree do not contain its number in the file, so any part of a layer that knows it can
 * make them: numbers are assigned when everything is put in order, to conflicts by their features, and to groups of
 * trees by the first of their movable features, which no two groups share. */
#ifndef GIS_PROOF_LINES_H
#define GIS_PROOF_LINES_H

#include "base/gis_error.h"
#include "base/json.h"
#include "sunder_proof.h"

#include <stdio.h>

/* The features and barriers that a report is on. */
typedef struct gis_proof_things {
    const void *of;
    size_t n;                                           /* features: from here on things are barriers */
    int64_t (*feature)(const void *of, size_t feature); /* what it is called by */
    int64_t (*barrier)(const void *of, size_t thing, const char **layer); /* its FID */
    const sunder_feature *(*demands)(const void *of, size_t feature);
} gis_proof_things;

/* Zeroed: none. */
typedef struct gis_proof_lines {
    gis_json json; /* where lines are made */
    gis_proof_things things;
    const sunder_report *report; /* borrowed */
    size_t *next;                /* [n] of the same block, in the order of the input; n: none follows */
    size_t *first;               /* [n] of the block that is called by this one; likewise */
} gis_proof_lines;

bool gis_proof_lines_begin(gis_proof_lines *lines, const gis_proof_things *things, const sunder_report *report,
                           gis_error *error);
void gis_proof_lines_clear(gis_proof_lines *lines);
/* The first of its block, or the feature itself. */
size_t gis_proof_block(const gis_proof_lines *lines, size_t feature);

/* What stands behind the number of the report's k-th conflict, and of the group of one of its trees. */
void gis_proof_conflict(gis_proof_lines *lines, size_t k);
bool gis_proof_tree(gis_proof_lines *lines, const sunder_bound_tree *tree, gis_error *error);

/* Where a tree belongs: by its group's first feature, and among those of its group. */
typedef struct gis_proof_place {
    size_t first, among, tree;
} gis_proof_place;
/* Of all trees of the report, in its order; *out is the caller's, with free(). */
bool gis_proof_order(const gis_proof_lines *lines, gis_proof_place **out, size_t *n, gis_error *error);

/* ---- Whole lines ------------------------------------------------------------------------------------------------- */

typedef struct gis_proof_head {
    const char *layer;
    sunder_layer_options how;
    double max_shift;
    const sunder_layer_summary *summary;
    size_t conflicts, trees;
} gis_proof_head;

void gis_proof_head_line(gis_json *json, const gis_proof_head *head);
/* Between them: what the members are called by. */
void gis_proof_block_begins(gis_json *json);
void gis_proof_block_ends(gis_json *json);
/* {"key":number, and the rest. */
void gis_proof_line(gis_json *json, const char *key, size_t number, const char *rest);

/* What the writer holds goes to the file. False: a signal came, memory is out; or, which the file knows, it could not
 * be written. */
bool gis_proof_print(gis_json *json, FILE *to, gis_error *error);

#endif
