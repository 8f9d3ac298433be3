/* pair_operands.h: two operands on one lattice, with what all folders of separation/ need: coordinates as doubles with
 * a bound of their error, boxes of the convex pieces, and the convex subsums R_ij = P_i + (-Q_j), which are computed on
 * demand.
 *
 * "Units" are those of sunder_i_approx(): lattice units divided by 2^approx_shift. Doubles decide a question only if
 * they exceed the error bound; else the lattice decides it. */
#ifndef SUNDER_I_OPERANDS_H
#define SUNDER_I_OPERANDS_H

#include "base/watch.h"
#include "predicate/narrow.h"
#include "shape/shape.h"
#include "spatial/box.h"
#include "spatial/lanes.h"

/* The least length, in units, of a side from which doubles may draw conclusions: the squares of shorter ones are near
 * 2^-1022, the end of the range of doubles, and quotients by them have a relative error of more than a few ulps. */
#define SUNDER_I_SHORTEST 0x1p-480

/* R_ij = P_i + (-Q_j), one of the convex subsums whose union is the sum (convex/subsums.h); they are computed one by
 * one, since a pair needs few of them. It is strictly convex and counterclockwise from its lowest vertex. All arrays
 * have `sides` elements and are in one block; if that number is odd, the arrays of doubles have one more side, with
 * everything on its left. */
typedef struct sunder_i_subsum {
    uint32_t i, j;  /* the numbers of the pieces of P and of Q */
    uint32_t sides; /* 0: not computed yet */
    double box[4];
    sunder_i_point *corner, *side; /* side[k] = corner[k + 1] - corner[k] */
    double *cx, *cy, *sx, *sy;     /* the same as doubles */
    double *bound; /* side k certainly has the point x on its left if cross(side, x - corner) > bound[k] */
    bool plain;    /* all vertices and sides are plain numbers */
} sunder_i_subsum;

/* Subsums with more sides are tested one side at a time, or by bisection. */
#define SUNDER_I_SIDES_IN_A_WORD 32

/* Tests a point against a subsum of at most SUNDER_I_SIDES_IN_A_WORD sides, in doubles. Returns false if the point is
 * on the right of a side by more than `bounds` error bounds; else *in_doubt is the set of uncertain sides, and the
 * point is certainly on the left of all others. It has no branches, since the decisive side cannot be predicted. */
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

/* A convex piece as a cycle that begins at its lowest vertex; that vertex is repeated at the end. */
typedef struct sunder_i_turned_piece {
    uint32_t n; /* the number of sides; 0: not computed yet */
    sunder_i_point *corner, *side;
} sunder_i_turned_piece;

typedef struct sunder_i_operands {
    const sunder_shape *shape[2];
    sunder_i_placed placed;
    const sunder_i_point *at[2]; /* vertices on the lattice; those of Q are reflected if requested */
    double *xy[2];               /* the same as doubles */
    double *piece_box[2];        /* [4 * pieces] x0 y0 x1 y1 */
    double box[2][4];
    double magnitude; /* the largest absolute value of a coordinate */
    bool brief;       /* all coordinates are integers below 2^28, so that products of sums fit 64 bits (narrow.h) */
    double error;     /* the error of a coordinate of a sum, or of a point on a line through sums, computed in
                       * doubles */
    double rough;     /* the absolute error of a difference vector in doubles, besides its relative error; usually 0 */
    double coarse;    /* the absolute error of the difference of two coordinates in doubles; 0 if coordinates are
                       * exact */
    double base[2];   /* a translation of both operands that was omitted */
    double unit;      /* approximately the length of one unit; may be 0 or infinite beyond the range of doubles */

    sunder_i_turned_piece *turned[2]; /* [pieces] */
    sunder_i_subsum *subsum; /* the subsums within reach (sunder_i_operands_reach); those that may cover the origin come
                              * first */
    size_t subsums;
    struct sunder_i_board *board; /* the board over all subsums (board.h); NULL: none */
} sunder_i_operands;

typedef struct sunder_i_operands_options {
    const double *tp, *tq; /* exact translations, or NULL */
    bool reflect_q, force_wide;
    const double *extra; /* further doubles that the lattice must contain */
    size_t extra_n;
    void *memory; /* NULL, or memory for small operands: aligned to 16 bytes, owned by the caller, valid as long as the
                   * operands */
    size_t memory_bytes;
} sunder_i_operands_options;

/* Places two operands, neither empty. *operands must be freed after success only. */
sunder_status sunder_i_operands_init(sunder_i_operands *operands, const sunder_shape *p, const sunder_shape *q,
                                     const sunder_i_operands_options *options, sunder_error *err);
void sunder_i_operands_free(sunder_i_operands *operands);
/* Frees the operands at the end of a computation. Fails with SUNDER_ENOMEM if memory ran out during it; then its result
 * is invalid. */
sunder_status sunder_i_operands_end(sunder_i_operands *operands, sunder_error *err);

/* Raises the error bounds so that they hold for numbers up to `magnitude`, in units. */
void sunder_i_operands_admit(sunder_i_operands *operands, double magnitude);

/* Computes the boxes of an operand's pieces, and of the operand. */
void sunder_i_operands_fill_boxes(sunder_i_operands *operands, int side);

/* Divides pieces with many vertices (cut_pieces.c). Returns false if out of memory. */
bool sunder_i_operands_cut(sunder_i_operands *operands);
/* Restores the pieces that the operands had before they were divided. */
void sunder_i_operands_uncut(sunder_i_operands *operands, const sunder_i_operands *before);
/* Returns the approximate number of pairs of pieces after they are divided. */
uint64_t sunder_i_operands_parts(const sunder_i_operands *operands);

/* Returns whether the boxes of P + tp and Q + tq are at least `gap` apart in one coordinate; true only if certain. */
bool sunder_i_boxes_apart(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                          double gap);

/* Returns whether the interiors of piece i of P and piece j of Q (not reflected) meet. Exact. */
bool sunder_i_pieces_overlap(sunder_i_operands *operands, uint32_t i, uint32_t j);
/* Returns whether the interiors of any two pieces meet; false also if out of memory. */
bool sunder_i_operands_overlap(sunder_i_operands *operands);

/* Returns the length of the shortest translation along an axis that leaves the sum of the boxes; Q is reflected. */
double sunder_i_operands_way_out(const sunder_i_operands *operands);

/* Lists the subsums whose boxes are within `radius` units of the origin, without computing them. Returns false if out
 * of memory. */
bool sunder_i_operands_reach(sunder_i_operands *operands, double radius);
/* Computes operands->turned for all pieces, which else is done for each piece when needed. Returns false if out of
 * memory. */
bool sunder_i_operands_turn(sunder_i_operands *operands);
/* Computes the vertices of a subsum. Returns false if out of memory. */
bool sunder_i_subsum_make(sunder_i_operands *operands, sunder_i_subsum *subsum);

/* A piece of an operand: its vertices, counterclockwise, as numbers of the operand's vertices. */
typedef struct sunder_i_operand_piece {
    int side; /* the operand: 0 P, 1 Q */
    const uint32_t *corner;
    uint32_t n;
} sunder_i_operand_piece;

static inline sunder_i_operand_piece sunder_i_operands_piece(const sunder_i_operands *g, int side, uint32_t i)
{
    const sunder_shape *s = g->shape[side];
    const uint32_t first = i ? s->piece_end[i - 1] : 0;
    return (sunder_i_operand_piece){side, sunder_i_piece_vertices(s) + first, s->piece_end[i] - first};
}

/* Returns the vertex after the k-th one. */
static inline uint32_t sunder_i_piece_next(const sunder_i_operand_piece *piece, uint32_t k)
{
    return piece->corner[k + 1 < piece->n ? k + 1 : 0];
}

/* Returns the squared distance of the origin from the segment from (ax, ay) with the vector (dx, dy); inverse = 1 /
 * |d|^2. For segments of sums of vertices the distance itself has an error of at most 4 times operands->error. */
static inline double sunder_i_segment_square(double ax, double ay, double dx, double dy, double inverse)
{
    /* 0 also if a length is below the range of doubles */
    const double t = sunder_i_clamped(-(ax * dx + ay * dy) * inverse);
    const double x = ax + t * dx, y = ay + t * dy;
    return x * x + y * y;
}

/* Returns the squared distance of point c from the segment ab. */
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
