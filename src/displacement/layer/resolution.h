/* When is a pair of features resolved? This is the exact definition, used by relations, clusters, proofs, the report
 * and the bound.
 *
 *   apart    their interiors are disjoint and their distance is at least the gap
 *   inside   one lies in the other, up to the tolerance, and the rules let contained features overlap
 *
 * A pair that is neither is in conflict. The search has the same definition in doubles, for convex pieces, in its own
 * code (solve/search/piece_pairs.c), and its results are checked against this one. A new case has to be added to
 * both. */
#ifndef SUNDER_I_RESOLUTION_H
#define SUNDER_I_RESOLUTION_H

#include "displacement/layer/relate.h"

/* May a feature overlap another one that it lies in? */
static inline bool sunder_i_may_be_inside(const sunder_i_rules *rules)
{
    return rules->contained == SUNDER_CONTAINMENT_IGNORE;
}

/* Are the two things in conflict in their present positions? (Members of one block do not have to keep a distance; the
 * caller excludes them.) */
static inline bool sunder_i_is_conflict(const sunder_i_relation *r) { return r->near && !r->kept; }

/* The relative moves of b that resolve a pair, by their lengths. */
typedef struct sunder_i_resolution {
    double least;      /* proved: no move shorter than this resolves the pair, in any way */
    bool beyond;       /* proved: no move up to the length `upper` resolves the pair */
    bool apart_beyond; /* proved: no move up to the length `upper` takes the two apart */
    double away[2];    /* about the shortest move that takes them apart (not set if apart_beyond, nor for a barrier) */
    bool inside;       /* `place` is a move that brings one of them inside the other, up to the rounding of doubles */
    bool a_inside;     /* if inside: a lies inside b */
    double place[2];
} sunder_i_resolution;

/* Finds the least moves that resolve a pair of shapes, which have to keep the gap. upper: a length beyond which the
 * answer does not matter; INFINITY for none. */
sunder_status sunder_i_resolve(const sunder_i_rules *rules, double gap, const sunder_shape *a, const sunder_shape *b,
                               double upper, sunder_i_resolution *out, sunder_error *err);
/* May relative moves of length at most `reach` bring one of two features inside the other, where the rules allow it? a
 * and b are their boxes. Returns false only if it is certainly impossible. */
bool sunder_i_may_get_inside(const sunder_i_rules *rules, const double a[4], const double b[4], double reach);

#endif
