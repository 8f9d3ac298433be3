/* The parts of proof_check.h's verification. Each returns the fault, or NULL. */
#ifndef SUNDER_TESTS_PROOF_CHECKING_H
#define SUNDER_TESTS_PROOF_CHECKING_H

#include "proof_check.h"
#include "rational_plane.h"
#include "sunder_proof.h"

#include <stdbool.h>

/* A pair with slack: the first node that gives it slack, and the longest slack that a node gives it. */
typedef struct proof_slack {
    size_t node;
    double longest;
} proof_slack;

typedef struct checking {
    const proof_feature *feature; /* [things], barriers from n on */
    size_t n, things, conflict;
    double gap;
    const sunder_report *report;
    const sunder_conflict *listed;
    size_t listed_n;
    const sunder_proof *proof;
    size_t *path_node, *path_way; /* on the path from the root */
    bool *seen;
    proof_slack *slack; /* [slacks] */
    size_t slacks;
} checking;

/* proof_parts.c: is every other corner on the left of every side? Is the part convex, and inside the feature? */
bool is_convex_part(const double *xy, size_t n);
bool is_part_of(const double *part, size_t n, const proof_feature *f);

/* proof_lines.c, for a line and a polygon: does the line run through the open polygon? The square of their distance. */
bool proof_line_meets(const proof_feature *line, const proof_feature *polygon);
void proof_line_square(mpq_t square, const proof_feature *line, const proof_feature *polygon);
/* Sets `square` to the square of the least translation that separates a convex polygon and one segment. Returns false
 * for all other operands. */
bool proof_line_least(mpq_t square, const proof_feature *line, const proof_feature *polygon);
/* Are the one or two corners of the part on one segment of the line? */
bool is_part_of_line(const double *part, size_t n, const proof_feature *line);

/* proof_ways.c: the set behind all ways, an open convex polygon, has to be in conflict: at a squared distance of less
 * than `most`, or deeper inside. */
const char *proof_check_ways(const checking *c, const sunder_proof_node *node, bool inside, const mpq_t most);
/* The crossing of two ways' lines; false if there is none. Does v lie behind all ways, or on their lines? exact, first:
 * NULL, or a replacement for the d of way a, or of the first way. */
bool proof_crossing(const sunder_proof_way *a, const mpq_t *exact, const sunder_proof_way *b, vec *v);
bool proof_is_behind_all(const sunder_proof_way *way, const mpq_t *first, size_t n, const vec *v);
/* The maximum over the polygon of the dot product with the way's n. */
void proof_farthest(mpq_t d, const hull *k, const sunder_proof_way *way);

/* proof_shadow.c: the node is about an anchor and a feature or barrier that it may not jump over, or about a side
 * anchor and a side; and the set behind all the ways is in its shadow. */
const char *proof_check_shadow(const checking *c, const sunder_proof_node *node);

/* proof_check.c: did the two meet at the start? Sets the square of their least translation out of the overlap, or of
 * their distance. False: not known. */
bool proof_find_standing(const proof_feature *a, const proof_feature *b, bool *meet, mpq_t square);

/* proof_still.c: two lines leave a block only one place; *first is then a member of it, otherwise SIZE_MAX. */
const char *proof_check_still(const checking *c, const sunder_proof_node *leaf, size_t depth, size_t *first);

/* proof_leaf.c: the forces on the path to the leaf gain more than the limits can lose. */
bool proof_same_block(const checking *c, size_t a, size_t b);
double proof_limit_of(const checking *c, size_t feature);
/* Lists the pairs with slack in c->slack, which the caller frees, before leaves are checked. */
void proof_list_slacks(checking *c);
const char *proof_check_leaf(const checking *c, const sunder_proof_node *leaf, size_t depth);

#endif
