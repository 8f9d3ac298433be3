/* What a pair of bodies may not do: the forbidden set of its relative moves, as a union of convex pieces. */
#ifndef SUNDER_I_FORBIDDEN_H
#define SUNDER_I_FORBIDDEN_H

#include "displacement/geometry/obstacle.h"
#include "displacement/layer/requirement.h"
#include "spatial/box_tree.h"

/* A convex polygon K grown by an open disc of that radius; with radius 0 its interior. The true piece is that of some
 * true polygon; every corner of K is within `vague` of a point of it. */
typedef struct sunder_i_forbidden_piece {
    uint32_t edge, edges;             /* of K, in sunder_i_forbidden.edge */
    const sunder_i_body_piece *a, *b; /* what it is made of: a piece of each body; of a shadow one is an anchor */
    bool shadow;
    double clearance; /* NAN: all that is owed; else what its pair is held to instead (layer/requirement.h) */
    double radius, vague;
    double box[4];            /* of K grown */
    double middle[2], within; /* a disc that lies in it, up to rounding; of no radius, or none, if within <= 0 */
} sunder_i_forbidden_piece;

typedef struct sunder_i_forbidden {
    sunder_i_forbidden_piece *piece;
    size_t pieces, piece_capacity;
    sunder_i_obstacle_edge *edge;
    size_t edges, edge_capacity;
    sunder_i_box_tree tree; /* over the first pieces, where they are many; else its box is NULL */
    double size;            /* bound on coordinates of the grown pieces, and of places that are tested */
    double grain;           /* more than rounding does to any point, distance or product of that size */
} sunder_i_forbidden;

/* A pair that is listed in the report: things a < b, a barrier by its first part, for a pair with it is one, whichever
 * part is near. What it owes is not asked of it, but to stand no worse than it stood, and to remain disjoint if it is.
 */
typedef struct sunder_i_waiver {
    uint32_t a, b;
    double stood; /* at the start: a clearance, as of layer/requirement.h */
    bool overlap; /* in the present positions */
} sunder_i_waiver;

/* What the pair is held to. */
static inline double sunder_i_waiver_clearance(const sunder_i_waiver *waiver)
{
    return waiver->stood < 0 && !waiver->overlap ? 0 : waiver->stood;
}

typedef struct sunder_i_waived {
    const sunder_i_waiver *pair; /* sorted */
    size_t n;
    /* [bodies] not 0: shadows of the body include those of the pieces that cover its diagonals. NULL: of no body */
    const unsigned char *covered;
} sunder_i_waived;

/* ---- forbidden.c ------------------------------------------------------------------------------------------------- */

/* NULL: the pair owes all that it owes. */
const sunder_i_waiver *sunder_i_waiver_of(const sunder_i_model *model, const sunder_i_waived *waived, uint32_t a,
                                          uint32_t b);
/* The pieces of bodies p and q that meet the disc of radius reach around u = 0 (u: the move of q less that of p).
 * False if memory is out; failure leaves what sunder_i_forbidden_free() takes. */
bool sunder_i_forbidden_init(sunder_i_forbidden *forbidden, const sunder_i_model *model, const sunder_i_waived *waived,
                             uint32_t p, uint32_t q, double reach);
/* As sunder_i_forbidden_init(), without the shadows of anchors and side anchors. */
bool sunder_i_forbidden_without_paths(sunder_i_forbidden *forbidden, const sunder_i_model *model,
                                      const sunder_i_waived *waived, uint32_t p, uint32_t q, double reach);
/* All pieces that come within a hair of u, and a few others. */
bool sunder_i_forbidden_init_near(sunder_i_forbidden *forbidden, const sunder_i_model *model,
                                  const sunder_i_waived *waived, uint32_t p, uint32_t q, const double u[2],
                                  double hair);
/* As sunder_i_forbidden_init(), with the pieces that cover the diagonals between others (layer/diagonal_covers.c), and
 * with at most about `most` pieces: complete only if there are no more. */
bool sunder_i_forbidden_with_covers(sunder_i_forbidden *forbidden, const sunder_i_model *model, uint32_t p, uint32_t q,
                                    double reach, size_t most);
void sunder_i_forbidden_free(sunder_i_forbidden *forbidden);

/* ---- shut_in.c --------------------------------------------------------------------------------------------------- */

/* Is no direction seen to be open in which one of the two bodies could leave the other? In doubles, and fast. */
bool sunder_i_may_be_shut_in(const sunder_i_model *model, uint32_t p, uint32_t q);
/* *shut: proved, whatever the two do, one jumps over the other, crosses a side, or they stand too near each other.
 * Seams are to be known. False if memory is out. */
bool sunder_i_is_shut_in(const sunder_i_model *model, uint32_t p, uint32_t q, bool *shut);
/* The same for n pairs of their features: if those two alone, of all that may be too near, are asked about. */
bool sunder_i_which_are_shut_in(const sunder_i_model *model, uint32_t p, uint32_t q, const sunder_i_id_pair *pair,
                                size_t n, bool *shut);

/* ---- forbidden_places.c ------------------------------------------------------------------------------------------ */

/* Of many pieces those near a place will be found fast; their order changes. False if memory is out. */
bool sunder_i_forbidden_index(sunder_i_forbidden *forbidden);
static inline bool sunder_i_forbidden_is_many(const sunder_i_forbidden *forbidden) { return forbidden->tree.box; }

/* The cost of testing one place, in steps. */
static inline uint64_t sunder_i_forbidden_look(const sunder_i_forbidden *forbidden)
{
    return sunder_i_forbidden_is_many(forbidden) ? 128 : forbidden->pieces + forbidden->edges / 4;
}

/* The pieces whose boxes meet one, each once. */
typedef struct sunder_i_forbidden_walk {
    sunder_i_box_walk waiting;
    size_t at, end; /* pieces of the leaf at hand */
    uint64_t looks; /* at boxes, so far */
} sunder_i_forbidden_walk;

void sunder_i_forbidden_start(sunder_i_forbidden_walk *walk, const sunder_i_forbidden *forbidden);
/* The next one; NULL: that was all. */
const sunder_i_forbidden_piece *sunder_i_forbidden_next(sunder_i_forbidden_walk *walk,
                                                        const sunder_i_forbidden *forbidden, const double box[4]);

/* The distance of u from K: negative inside, then of the nearest line of an edge. */
double sunder_i_forbidden_distance(const sunder_i_forbidden *forbidden, const sunder_i_forbidden_piece *piece,
                                   const double u[2]);
/* The same, and the direction in which that grows. */
double sunder_i_forbidden_normal(const sunder_i_forbidden *forbidden, const sunder_i_forbidden_piece *piece,
                                 const double u[2], double n[2]);
/* Where the line from + s dir is in the piece grown: span[0] <= s <= span[1], up to rounding; false: nowhere. |dir| is
 * 1. */
bool sunder_i_forbidden_span(const sunder_i_forbidden *forbidden, const sunder_i_forbidden_piece *piece,
                             const double from[2], const double dir[2], double span[2]);
/* How deep u is in the union, in doubles: the most of radius less distance; 0 where it is in none. */
double sunder_i_forbidden_depth(const sunder_i_forbidden *forbidden, const double u[2]);
/* Is u deeper than `hair` > 0, a share of 2^-45 of the size at least? The answer is that of the depth, but it does not
 * depend on all pieces: *guess, the number of a piece, is tried first, and is the piece that covers u if one does. */
bool sunder_i_forbidden_is_deeper(const sunder_i_forbidden *forbidden, const double u[2], double hair, size_t *guess);
/* Is u within `hair` of the union? */
bool sunder_i_forbidden_is_near(const sunder_i_forbidden *forbidden, const double u[2], double hair);
/* How far along the ray from u the first place is that is in none of the pieces; no less than `most`, if it is no
 * nearer. */
double sunder_i_forbidden_exit(const sunder_i_forbidden *forbidden, const double u[2], const double dir[2],
                               double most);
/* How far the ray from u, where nothing is forbidden, goes until it enters a piece, or comes to `most`. steps: grows by
 * the work done. */
double sunder_i_forbidden_entry(const sunder_i_forbidden *forbidden, const double u[2], const double dir[2],
                                double most, uint64_t *steps);

#endif
