/* The forbidden set of a pair of bodies: the relative moves that it may not make, as a union of convex pieces. */
#ifndef SUNDER_I_FORBIDDEN_H
#define SUNDER_I_FORBIDDEN_H

#include "displacement/geometry/obstacle.h"
#include "displacement/layer/requirement.h"
#include "spatial/box_tree.h"

/* A convex polygon K grown by an open disc of radius `radius`; if that is 0, its interior. The true piece is that of
 * some true polygon; every corner of K is within `vague` of a point of it. */
typedef struct sunder_i_forbidden_piece {
    uint32_t edge, edges;             /* the edges of K, in sunder_i_forbidden.edge */
    const sunder_i_body_piece *a, *b; /* the pieces of the two bodies from which K is made; for a shadow one of them is
                                       * an anchor */
    bool shadow;                      /* true for a `row`, too */
    bool row;                         /* it is the half-plane of the rule of rows; a and b are any pieces of the two */
    bool priced; /* it forbids nothing, but has a price: a move lacks at least the radius less its distance from K, or
                  * plus its depth in K */
    bool joined; /* it is priced, and K lies in the union of the sets K of other pieces of the same features */
    double clearance; /* NAN: the full distance is required; else the clearance to which the pair is held instead
                       * (layer/requirement.h) */
    uint32_t side[2]; /* if they differ: it is the shadow of a chord, and lies in these two pieces */
    double radius, vague;
    double box[4];            /* of the grown K */
    double middle[2], within; /* a disc around `middle` with radius `within` that lies in the grown K, up to rounding;
                               * none if within <= 0 */
} sunder_i_forbidden_piece;

/* A chord between the shadows of two sides of a barrier (geometry/side_chord.h), as a piece of one of its parts. */
typedef struct sunder_i_chord_piece {
    sunder_i_body_piece piece;
    double corner[4];
    struct sunder_i_chord_piece *next;
} sunder_i_chord_piece;

/* A convex polygon in the union of the sets K of the priced pieces of two things, f < g in the order of the pair; a
 * barrier is named by its first part. */
#define SUNDER_I_JOINED_CORNERS 32
typedef struct sunder_i_joined {
    uint32_t price; /* the eased pair */
    uint32_t f, g, corners;
    double corner[2 * SUNDER_I_JOINED_CORNERS], blur;
} sunder_i_joined;

typedef struct sunder_i_forbidden {
    sunder_i_forbidden_piece *piece;
    size_t pieces, piece_capacity;
    sunder_i_obstacle_edge *edge;
    size_t edges, edge_capacity;
    sunder_i_chord_piece *chord; /* a list; owned */
    sunder_i_box_tree tree;      /* over the pieces, if they are many; else its box is NULL */
    double size;                 /* a bound of the coordinates of the grown pieces and of points that are tested */
    double grain;                /* more than the rounding error of a point, distance or product of that size */
} sunder_i_forbidden;

/* A pair that the report lists as remaining in conflict: things a < b. A barrier is represented by its first part,
 * whichever part is near. The pair need not keep the full distance, but must stand no worse than at the start, and must
 * remain disjoint if it is. */
typedef struct sunder_i_waiver {
    uint32_t a, b;
    double stood; /* the clearance at the start, as in layer/requirement.h */
    bool overlap; /* the two overlap in the present positions */
} sunder_i_waiver;

/* Returns the clearance to which the pair is held. */
static inline double sunder_i_waiver_clearance(const sunder_i_waiver *waiver)
{
    return waiver->stood < 0 && !waiver->overlap ? 0 : waiver->stood;
}

typedef struct sunder_i_waived {
    const sunder_i_waiver *pair; /* sorted by (a, b) */
    size_t n;
    /* [bodies] not 0: shadows of the body include those of the covers of its diagonals. NULL: of no body */
    const unsigned char *covered;
} sunder_i_waived;

/* ---- forbidden.c ------------------------------------------------------------------------------------------------- */

/* Returns the waiver of things a and b; NULL if the pair has to keep the full distance. */
const sunder_i_waiver *sunder_i_waiver_of(const sunder_i_model *model, const sunder_i_waived *waived, uint32_t a,
                                          uint32_t b);
/* Lists the pieces of the forbidden set of bodies p and q that come within `reach` of u = 0, where u is the move of q
 * less that of p. If these are more than MOST_PIECES the reach is halved, as often as needed but not below half of the
 * gap, and pieces farther away are missing. Returns false if memory is out; the caller frees *forbidden in any case. */
bool sunder_i_forbidden_init(sunder_i_forbidden *forbidden, const sunder_i_model *model, const sunder_i_waived *waived,
                             uint32_t p, uint32_t q, double reach);
/* Lists the pieces of the forbidden sets of body p and n bodies q that do not move relative to each other. With
 * `prices` it also lists the pieces of pairs whose shortfall has a price: pairs left in conflict and, if the full gap
 * is greater than the least one, all pairs. At most about MOST_PIECES pieces are listed. */
bool sunder_i_forbidden_priced(sunder_i_forbidden *forbidden, const sunder_i_model *model,
                               const sunder_i_waived *waived, uint32_t p, const uint32_t *q, size_t n, double reach,
                               bool prices);
/* As sunder_i_forbidden_init(), but with the pieces for the required distances only: without the shadows from anchors
 * and side anchors, and without the covers of diagonals. */
bool sunder_i_forbidden_without_paths(sunder_i_forbidden *forbidden, const sunder_i_model *model,
                                      const sunder_i_waived *waived, uint32_t p, uint32_t q, double reach);
/* Lists all pieces that come within `hair` of u, and a few others. */
bool sunder_i_forbidden_init_near(sunder_i_forbidden *forbidden, const sunder_i_model *model,
                                  const sunder_i_waived *waived, uint32_t p, uint32_t q, const double u[2],
                                  double hair);
/* As sunder_i_forbidden_init(), including the shadows of the covers of diagonals (layer/diagonal_covers.c), and with
 * about `most` pieces at most: the list is complete only if there are no more. */
bool sunder_i_forbidden_with_covers(sunder_i_forbidden *forbidden, const sunder_i_model *model, uint32_t p, uint32_t q,
                                    double reach, size_t most);
/* Adds the shadow of a piece of one of the bodies p and q from an anchor of the other, up to the distance `reach` from
 * u = 0. A part of the same barrier may stand for one of the two bodies. The pieces must not have been
 * sorted into a tree of boxes. Returns false if memory is out. */
bool sunder_i_forbidden_add_shadow(sunder_i_forbidden *forbidden, const sunder_i_model *model, uint32_t p, uint32_t q,
                                   double reach, const sunder_i_body_piece *a, const sunder_i_body_piece *b);
/* Adds the shadow of a chord from an anchor of body `mover` in the same way; the anchor is of the first body unless
 * `swapped`. at: its ends, in coordinates of the layer; side: the pieces of the shadows of its two sides. */
bool sunder_i_forbidden_add_chord(sunder_i_forbidden *forbidden, const sunder_i_model *model, uint32_t mover,
                                  uint32_t part, bool swapped, double reach, const sunder_i_body_piece *anchor,
                                  const double at[4], const uint32_t side[2]);
void sunder_i_forbidden_free(sunder_i_forbidden *forbidden);

/* Adds a polygon to the priced pieces. Returns false if memory is out. */
bool sunder_i_forbidden_add_joined(sunder_i_forbidden *forbidden, const sunder_i_model *model,
                                   const sunder_i_joined *joined);

/* ---- joined_piece.c ---------------------------------------------------------------------------------------------- */

/* Sets *out to a polygon of things f and g around u, if it shows that u is deeper in the union of their sets K than
 * `more`; otherwise *any becomes false. Returns false if memory is out. */
bool sunder_i_join_pieces(const sunder_i_model *model, const sunder_i_forbidden *pieces, uint32_t f, uint32_t g,
                          const double u[2], double more, sunder_i_joined *out, bool *any, uint64_t *steps);
/* Sets used[k] for the pieces in whose union a joined one lies: those that prove it, or all of its two things. Returns
 * false if memory is out. */
bool sunder_i_joined_find_parts(const sunder_i_model *model, const sunder_i_forbidden *pieces, uint32_t joined,
                                bool *used);

/* ---- shut_in.c --------------------------------------------------------------------------------------------------- */

/* May two bodies be shut in, because no direction is found in which one could leave the other? In doubles, and fast. */
bool sunder_i_may_be_shut_in(const sunder_i_model *model, uint32_t p, uint32_t q);
/* Sets *shut to whether it is proved that every relative move of bodies p and q is forbidden: one jumps over the other
 * or crosses a side, or they are too near to each other. The covers of diagonals must have been made. Returns false if
 * memory is out. */
bool sunder_i_is_shut_in(const sunder_i_model *model, uint32_t p, uint32_t q, bool *shut);
/* Examines n pairs of features, each with one feature of p and one of q. Sets shut[k] to whether it is proved that
 * every relative move is forbidden by jumps and sides of the two whole bodies together with the distance that pair k
 * alone has to keep. Returns false if memory is out. */
bool sunder_i_find_shut_in_pairs(const sunder_i_model *model, uint32_t p, uint32_t q, const sunder_i_id_pair *pair,
                                 size_t n, bool *shut);

/* ---- forbidden_places.c ------------------------------------------------------------------------------------------ */

/* Sorts the pieces, if there are many, so that those near a place are found fast. Returns false if memory is out. */
bool sunder_i_forbidden_index(sunder_i_forbidden *forbidden);
static inline bool sunder_i_forbidden_is_many(const sunder_i_forbidden *forbidden) { return forbidden->tree.box; }

/* Returns the cost of testing one place, in steps. */
static inline uint64_t sunder_i_forbidden_look(const sunder_i_forbidden *forbidden)
{
    return sunder_i_forbidden_is_many(forbidden) ? 128 : forbidden->pieces + forbidden->edges / 4;
}

/* An iteration over the pieces whose boxes meet a given box, each once. */
typedef struct sunder_i_forbidden_walk {
    sunder_i_box_walk waiting;
    size_t at, end; /* the pieces of the present leaf that remain */
    uint64_t looks; /* the number of boxes tested up to now */
} sunder_i_forbidden_walk;

void sunder_i_forbidden_start(sunder_i_forbidden_walk *walk, const sunder_i_forbidden *forbidden);
/* Returns the next piece; NULL if there are no more. */
const sunder_i_forbidden_piece *sunder_i_forbidden_next(sunder_i_forbidden_walk *walk,
                                                        const sunder_i_forbidden *forbidden, const double box[4]);

/* Returns the distance of u from K; inside it is negative, minus the distance to the nearest line of an edge. */
double sunder_i_forbidden_distance(const sunder_i_forbidden *forbidden, const sunder_i_forbidden_piece *piece,
                                   const double u[2]);
/* Returns the same distance, and sets n to the direction in which it grows. */
double sunder_i_forbidden_normal(const sunder_i_forbidden *forbidden, const sunder_i_forbidden_piece *piece,
                                 const double u[2], double n[2]);
/* Finds where the line from + s dir, with |dir| = 1, is in the grown piece: for span[0] <= s <= span[1], up to
 * rounding. Returns false if nowhere. */
bool sunder_i_forbidden_span(const sunder_i_forbidden *forbidden, const sunder_i_forbidden_piece *piece,
                             const double from[2], const double dir[2], double span[2]);
/* Returns how deep u is in the union, in doubles: the greatest radius less distance of a piece; 0 if u is in none. */
double sunder_i_forbidden_depth(const sunder_i_forbidden *forbidden, const double u[2]);
/* Is u deeper than `hair`, which is at least 2^-45 of the size? The result is that of comparing
 * sunder_i_forbidden_depth(), but not all pieces need be tested: piece number *guess is tried first, and *guess is set
 * to a piece that covers u. */
bool sunder_i_forbidden_is_deeper(const sunder_i_forbidden *forbidden, const double u[2], double hair, size_t *guess);
/* Is u in the union, or within `hair` of it? */
bool sunder_i_forbidden_is_near(const sunder_i_forbidden *forbidden, const double u[2], double hair);
/* Returns the distance along the ray from u to the first point that is in none of the pieces; a value of at least
 * `most` if it is no nearer. */
double sunder_i_forbidden_exit(const sunder_i_forbidden *forbidden, const double u[2], const double dir[2],
                               double most);
/* Returns the distance that the ray from u, which is in no piece, goes until it enters a piece; at most `most`. *steps
 * grows by the work done. */
double sunder_i_forbidden_entry(const sunder_i_forbidden *forbidden, const double u[2], const double dir[2],
                                double most, uint64_t *steps);

#endif
