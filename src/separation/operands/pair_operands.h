/* Two operands on one lattice, with what all rooms of separation/ need: coordinates as doubles with a bound on their
 * error, boxes of the convex pieces, and the convex subsums R_ij = P_i + (-Q_j), made on demand.
 *
 * "Units" are those of sunder_i_approx(): lattice units over 2^approx_shift. Doubles settle a question only when they
 * clear the bound; else the lattice decides. */
#ifndef SUNDER_I_OPERANDS_H
#define SUNDER_I_OPERANDS_H

#include "base/watch.h"
#include "predicate/narrow.h"
#include "shape/shape.h"
#include "spatial/box.h"
#include "spatial/lanes.h"

/* Shorter sides, in units, take no part in conclusions from doubles: their squares come near 2^-1022, the end of the
 * range of doubles, and quotients by them have a relative error of more than a few ulps. */
#define SUNDER_I_SHORTEST 0x1p-480

/* R_ij = P_i + (-Q_j): the convex subsums that a sum is the union of (convex/subsums.h), one by one, since a pair needs
 * few of them. Counter-clockwise from its lowest corner, strictly convex. Arrays are of size sides, in one block;
 * where that is odd one side more, that has all on its left, stands in those of doubles. */
typedef struct sunder_i_subsum {
    uint32_t i, j;  /* the pieces of P and of Q */
    uint32_t sides; /* 0: not made yet */
    double box[4];
    sunder_i_point *corner, *side; /* side[k] = corner[k + 1] - corner[k] */
    double *cx, *cy, *sx, *sy;     /* the same as doubles */
    double *bound; /* side k has the point on its left for certain if cross(side, x - corner) > bound[k] */
    bool plain;    /* all corners and sides are plain numbers */
} sunder_i_subsum;

/* Sides with more of them are asked one by one, or by halving. */
#define SUNDER_I_SIDES_IN_A_WORD 32

/* Tests a point against a subsum of at most this many sides, in doubles: false if the point is to the right of a side
 * by more than `bounds` error bounds; else *in_doubt is the set of sides in doubt, and the point is certainly to the
 * left of all others. Without branches, since the decisive side cannot be predicted. */
static inline bool sunder_i_subsum_may_hold(const sunder_i_subsum *s, double x, double y, double bounds,
                                            uint32_t *in_doubt)
{
    sunder_i_double_masks right = {0, 0};
    uint32_t doubt = 0;
    for (uint32_t k = 0; k < s->sides; k += SUNDER_I_DOUBLES) {
        const sunder_i_doubles bound = sunder_i_doubles_at(s->bound + k);
        const sunder_i_doubles v = sunder_i_doubles_at(s->sx + k) * (y - sunder_i_doubles_at(s->cy + k)) -
                                   sunder_i_doubles_at(s->sy + k) * (x - sunder_i_doubles_at(s->cx + k));
        right |= v < -bounds * bound;
        doubt |= sunder_i_doubles_set(v <= bound) << k;
    }
    *in_doubt = doubt;
    return sunder_i_doubles_set(right) == 0;
}

/* A convex piece that starts at its lowest corner; the first corner stands again at the end. */
typedef struct sunder_i_turned_piece {
    uint32_t n; /* sides; 0: not made yet */
    sunder_i_point *corner, *side;
} sunder_i_turned_piece;

typedef struct sunder_i_operands {
    const sunder_shape *shape[2];
    sunder_i_placed placed;
    const sunder_i_point *at[2]; /* vertices on the lattice; Q's reflected if requested */
    double *xy[2];               /* the same as doubles */
    double *piece_box[2];        /* [4 * pieces] x0 y0 x1 y1 */
    double box[2][4];
    double magnitude; /* no coordinate is larger */
    bool brief;       /* all coordinates are integers below 2^28: what is made of sums fits 64 bits (narrow.h) */
    double error;     /* of a coordinate of a sum, or of a point on a line through sums, evaluated in doubles */
    double rough;     /* absolute error of a difference vector as doubles, besides its relative one; mostly 0 */
    double coarse;    /* the same for the difference of two coordinates in doubles; 0 if they are exact */
    double base[2];   /* a translation of both that was left out */
    double unit;      /* about: length of one unit; may be 0 or infinite past the range of doubles */

    sunder_i_turned_piece *turned[2]; /* [pieces] */
    sunder_i_subsum *subsum; /* those within reach (sunder_i_operands_reach); they that may cover the origin first */
    size_t subsums;
    struct sunder_i_board *board; /* the board over all of them (board.h); NULL: none */
} sunder_i_operands;

typedef struct sunder_i_operands_options {
    const double *tp, *tq; /* exact translations, or NULL */
    bool reflect_q, force_wide;
    const double *extra; /* further doubles for the lattice to hold */
    size_t extra_n;
    void *memory; /* NULL, or lent for small operands: 16-byte aligned, it outlives them */
    size_t memory_bytes;
} sunder_i_operands_options;

/* Both operands not empty. *operands is to be freed only after success. */
sunder_status sunder_i_operands_init(sunder_i_operands *operands, const sunder_shape *p, const sunder_shape *q,
                                     const sunder_i_operands_options *options, sunder_error *err);
void sunder_i_operands_free(sunder_i_operands *operands);
/* Frees them, when the question is answered. Fails with SUNDER_ENOMEM if memory ran out on the way: then it is not. */
sunder_status sunder_i_operands_end(sunder_i_operands *operands, sunder_error *err);

/* Numbers up to that magnitude, in units, are to be as good as coordinates: raises the bounds. */
void sunder_i_operands_admit(sunder_i_operands *operands, double magnitude);

/* The boxes of an operand's pieces, and its own. */
void sunder_i_operands_fill_boxes(sunder_i_operands *operands, int side);

/* Cuts up the pieces that have many corners (cut_pieces.c); false if memory is out. */
bool sunder_i_operands_cut(sunder_i_operands *operands);
/* Restores the pieces as they were before the cut. */
void sunder_i_operands_uncut(sunder_i_operands *operands, const sunder_i_operands *before);
/* The approximate number of pairs of pieces after a cut. */
uint64_t sunder_i_operands_parts(const sunder_i_operands *operands);

/* Do the boxes of P + tp and Q + tq stand at least gap apart in one coordinate? True only if that is certain. */
bool sunder_i_boxes_apart(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                          double gap);

/* Do the interiors of piece i of P and piece j of Q (not reflected) meet? Exact. */
bool sunder_i_pieces_overlap(sunder_i_operands *operands, uint32_t i, uint32_t j);
/* Do the interiors of any two? False too if memory is out. */
bool sunder_i_operands_overlap(sunder_i_operands *operands);

/* The shortest way out of the sum of the boxes along an axis, which is free. Q is reflected. */
double sunder_i_operands_way_out(const sunder_i_operands *operands);

/* Lists the subsums whose boxes come within `radius` units of the origin (none is made yet). False if memory is out. */
bool sunder_i_operands_reach(sunder_i_operands *operands, double radius);
/* Turns all pieces at once, which is done for each when it is wanted else; false if memory is out. */
bool sunder_i_operands_turn(sunder_i_operands *operands);
/* Makes the corners of one; false if memory is out. */
bool sunder_i_subsum_make(sunder_i_operands *operands, sunder_i_subsum *subsum);

/* A piece of an operand: its corners, counter-clockwise, as numbers of vertices. */
typedef struct sunder_i_operand_piece {
    int side; /* whose: 0 P's, 1 Q's */
    const uint32_t *corner;
    uint32_t n;
} sunder_i_operand_piece;

static inline sunder_i_operand_piece sunder_i_operands_piece(const sunder_i_operands *g, int side, uint32_t i)
{
    const sunder_shape *s = g->shape[side];
    const uint32_t first = i ? s->piece_end[i - 1] : 0;
    return (sunder_i_operand_piece){side, sunder_i_piece_vertices(s) + first, s->piece_end[i] - first};
}

/* The corner after the k-th. */
static inline uint32_t sunder_i_piece_next(const sunder_i_operand_piece *piece, uint32_t k)
{
    return piece->corner[k + 1 < piece->n ? k + 1 : 0];
}

/* The squared distance of the origin from the segment from (ax, ay) in direction (dx, dy); inverse = 1 / |d|^2. The
 * distance itself is good to 4 times the operands' error, if it is that of a sum of vertices from such a segment. */
static inline double sunder_i_segment_square(double ax, double ay, double dx, double dy, double inverse)
{
    /* 0 too where a length is lost in the doubles. */
    const double t = sunder_i_clamped(-(ax * dx + ay * dy) * inverse);
    const double x = ax + t * dx, y = ay + t * dy;
    return x * x + y * y;
}

/* Of point c from the segment ab. */
static inline double sunder_i_point_square(const double c[2], const double a[2], const double b[2])
{
    const double dx = b[0] - a[0], dy = b[1] - a[1];
    return sunder_i_segment_square(a[0] - c[0], a[1] - c[1], dx, dy, 1 / (dx * dx + dy * dy));
}

static inline sunder_i_point sunder_i_operands_diff(sunder_i_operands *g, sunder_i_point a, sunder_i_point b)
{
    return g->placed.lattice.narrow ? sunder_i_narrow_sub(a, b) : sunder_i_point_sub(&g->placed.lattice, a, b);
}

static inline sunder_i_point sunder_i_operands_add(sunder_i_operands *g, sunder_i_point a, sunder_i_point b)
{
    return g->placed.lattice.narrow ? (sunder_i_point){a.x + b.x, a.y + b.y}
                                    : sunder_i_point_add(&g->placed.lattice, a, b);
}

static inline int sunder_i_operands_cross(sunder_i_operands *g, sunder_i_point u, sunder_i_point v)
{
    if (g->brief) {
        const int64_t cross = sunder_i_brief_cross(u, v);
        return (cross > 0) - (cross < 0);
    }
    return g->placed.lattice.narrow ? sunder_i_i128_sign(sunder_i_narrow_cross(u, v))
                                    : sunder_i_cross_sign(&g->placed.lattice, u, v);
}

static inline int sunder_i_operands_dot(sunder_i_operands *g, sunder_i_point u, sunder_i_point v)
{
    return g->placed.lattice.narrow ? sunder_i_i128_sign(sunder_i_narrow_dot(u, v))
                                    : sunder_i_dot_sign(&g->placed.lattice, u, v);
}

#endif
