/* proof_lines.h: the file of --proof, line by line, as docs/PROOF.md describes it: the proofs of the lower bound and of
 * the verdicts.
 *
 * The text about a conflict or a tree does not contain its number in the file, so the text can be made while only a
 * part of the layer is known. Numbers are assigned when all lines are put in order: conflicts by their features, and
 * groups of trees by the first of their movable features, which no two groups share. */
#ifndef GIS_PROOF_LINES_H
#define GIS_PROOF_LINES_H

#include "base/gis_error.h"
#include "base/json.h"
#include "sunder_hiding.h"
#include "sunder_parts.h"
#include "sunder_proof.h"

#include <stdio.h>

/* The features and barriers of a report. */
typedef struct gis_proof_things {
    const void *of;
    size_t n;                                           /* number of features: things with numbers from here on are
                                                         * barriers */
    int64_t (*feature)(const void *of, size_t feature); /* the number that identifies a feature */
    /* the FID of a barrier, and the name of its layer */
    int64_t (*barrier)(const void *of, size_t thing, const char **layer);
    const sunder_feature *(*demands)(const void *of, size_t feature);
    uint32_t (*class)(const void *of, size_t thing); /* for gaps; NULL: these do not depend on classes */
} gis_proof_things;

/* A zeroed struct is empty. */
typedef struct gis_proof_lines {
    gis_json json; /* where the text is made */
    gis_proof_things things;
    const sunder_report *report; /* borrowed */
    size_t *next;                /* [n] next member of the same block, in input order; n: none */
    size_t *first;               /* [n] first member of the block that is identified by this feature; n: none */
} gis_proof_lines;

bool gis_proof_lines_begin(gis_proof_lines *lines, const gis_proof_things *things, const sunder_report *report,
                           gis_error *error);
void gis_proof_lines_clear(gis_proof_lines *lines);
/* The number that identifies the feature's block: its first feature, or the feature itself if it is in no block. */
size_t gis_proof_block(const gis_proof_lines *lines, size_t feature);

/* Make the text that follows the number of conflict k, or of a tree's group. */
void gis_proof_conflict(gis_proof_lines *lines, size_t k);
bool gis_proof_tree(gis_proof_lines *lines, const sunder_bound_tree *tree, gis_error *error);
/* proof_hiding.c: the text that follows the number of a larger shape. */
void gis_proof_larger(gis_proof_lines *lines, size_t feature, const sunder_shape *shape);
/* The same for the text that follows the number of a smaller shape, which has this level of the feature, and this
 * rung of the run. */
void gis_proof_shape(gis_proof_lines *lines, size_t feature, size_t level, size_t rung, const sunder_shape *shape);
/* The same for the text that follows the number of a clause, or of tree k of the bound of what is hidden.
 * clause: the numbers of the proved clauses in the file. within: the numbers count within the component, and the mark
 * GIS_PROOF_MARK stands before each, since the numbers in the file are not known yet. */
#define GIS_PROOF_MARK '#'
void gis_proof_clause(gis_proof_lines *lines, const sunder_clause *clause);
void gis_proof_choice(gis_proof_lines *lines, size_t k, const size_t *clause, bool within);
/* Writes `reason` and `crowded`. */
void gis_proof_reason(gis_proof_lines *lines, sunder_reason reason, bool crowded);
/* Writes the proof with its `within`. NULL: writes nothing. */
void gis_proof_nodes(gis_proof_lines *w, const sunder_proof *proof);
/* Writes n corners; key: NULL in a list. */
void gis_proof_corners(gis_proof_lines *w, const char *key, const double *xy, size_t n);
/* Writes a feature as its number, or a barrier as "LAYER:FID"; key: NULL in a list. */
void gis_proof_thing(gis_proof_lines *w, const char *key, size_t thing);

/* The place of a tree: its group's first feature, and its number within the group; and its number in the report. */
typedef struct gis_proof_place {
    size_t first, among, tree;
} gis_proof_place;
/* Computes the places of all trees, in the report's order; the caller frees *out with free(). */
bool gis_proof_order(const gis_proof_lines *lines, gis_proof_place **out, size_t *n, gis_error *error);

/* The order of clauses and choices, and the features whose smaller shapes are listed (proof_choices.c). A place here
 * has the least feature of a component of clauses, the number in this component, and the number in the report. */
typedef struct gis_proof_choices {
    size_t *root;                   /* [n] the least feature of each feature's component */
    bool *told;                     /* [n] a clause names the feature, or another one of its block */
    gis_proof_place *clause, *tree; /* of the proved clauses, and of the trees of the bound, in order */
    size_t clauses, trees;
    size_t *number; /* [clauses of the report] the number of each proved one in its component */
} gis_proof_choices;
/* Clear *out also after a failure. */
bool gis_proof_choices_make(const gis_proof_lines *lines, gis_proof_choices *out, gis_error *error);
void gis_proof_choices_clear(gis_proof_choices *choices);

/* ---- Complete lines ---------------------------------------------------------------------------------------------- */

/* Gaps by classes; zeroed: there is one gap. */
typedef struct gis_proof_gaps {
    size_t classes;
    const char *const *name;  /* [classes] the first is none */
    const double *gap, *full; /* [classes * classes] gap: NULL if it is nowhere less than the full one */
} gis_proof_gaps;

typedef struct gis_proof_head {
    const char *layer, *sheet; /* sheet: the specification of the run; NULL: there is none */
    sunder_layer_options how;
    double max_shift;
    gis_proof_gaps gaps;
    const sunder_layer_summary *summary;
    size_t conflicts, trees;
    /* Only with options of this kind: the numbers of hidden features, of larger shapes (only with `enlarge`), of
     * smaller ones, of proved clauses, and of trees of their bound, and that bound by classes. */
    bool hide, enlarge;
    size_t hidden, larger, shapes, clauses, choices;
    const sunder_hiding_class *class;
    size_t classes;
} gis_proof_head;

/* A class as a number, or null. */
void gis_proof_class(gis_json *json, uint32_t hierarchy);
void gis_proof_head_line(gis_json *json, const gis_proof_head *head);
/* Begin and end the line of a block; between the two, the numbers of its members are written. */
void gis_proof_block_begins(gis_json *json);
void gis_proof_block_ends(gis_json *json);
/* Makes the line of a hidden feature; name: the number that identifies it. */
void gis_proof_hidden_line(gis_json *json, size_t number, int64_t name);
/* Makes the line of two neighbours in a row; name: the numbers that identify them. */
void gis_proof_row_line(gis_json *json, size_t number, const int64_t name[2], const sunder_row_pair *pair);
/* Makes the line {"key":number, followed by `rest`. */
void gis_proof_line(gis_json *json, const char *key, size_t number, const char *rest);

/* Writes the text to the file and empties it. False: a signal has arrived, memory is out, or writing failed
 * (ferror()). */
bool gis_proof_print(gis_json *json, FILE *to, gis_error *error);

#endif
