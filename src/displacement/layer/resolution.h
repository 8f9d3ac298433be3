/* What two features owe each other: the exact definition used by relations, clusters, proofs, report and bound.
 *
 *   apart    their interiors are disjoint and their distance is at least the gap
 *   inside   one lies in the other, up to the tolerance, and the rules let contained features overlap
 *
 * A pair that is neither is in conflict. The search uses the same definition in doubles, piece by piece, in its own
 * code (solve/search/piece_pairs.c), and its results are checked against this one: a new case has to be added to
 * both. */
#ifndef SUNDER_I_RESOLUTION_H
#define SUNDER_I_RESOLUTION_H

#include "displacement/layer/relate.h"

/* May a feature overlap the one that it lies in? */
static inline bool sunder_i_may_be_inside(const sunder_i_rules *rules)
{
    return rules->contained == SUNDER_CONTAINMENT_IGNORE;
}

/* Are the two, as they stand, in conflict? (Unless they are members of one block, which owe each other nothing.) */
static inline bool sunder_i_is_conflict(const sunder_i_relation *r) { return r->near && !r->kept; }

/* What it takes to resolve it between a pair, in lengths of relative moves of b. */
typedef struct sunder_i_resolution {
    double least;      /* proved: no shorter one does it, in any way */
    bool beyond;       /* proved: no place within the given length does */
    bool apart_beyond; /* proved: none up to that length takes them apart */
    double away[2];    /* about the shortest that takes them apart (not where apart_beyond; not of a barrier) */
    bool inside;       /* `place` is one that brings one of them inside the other, up to the rounding of doubles */
    bool a_inside;     /* ... which: a inside b */
    double place[2];
} sunder_i_resolution;

/* upper: a length past which the answer no longer matters; INFINITY for none. */
sunder_status sunder_i_resolve(const sunder_i_rules *rules, const sunder_shape *a, const sunder_shape *b, double upper,
                               sunder_i_resolution *out, sunder_error *err);
/* Could relative moves of no more than `reach` bring one inside the other, with leave to be there? By their boxes:
 * false only where that is certain. */
bool sunder_i_may_get_inside(const sunder_i_rules *rules, const double a[4], const double b[4], double reach);

#endif
