/* What the files of a figure's convolution share: the curve and its crossings. Internal to figure_convolution*.c.
 *
 * figure_convolution_links.c      the curve: sides moved, arcs, chords
 * figure_convolution_crossings.c  where it crosses itself, exactly; false where anything else comes up
 * figure_convolution_places.c     places where several of its corners stand
 * figure_convolution.c            winding numbers along it, and the rings that they bound */
#ifndef SUNDER_I_FIGURE_CONVOLUTION_H
#define SUNDER_I_FIGURE_CONVOLUTION_H

#include "morphology/morphology.h"

/* A corner of the curve, or a crossing; each double is at most `error` of the curve off. */
typedef struct sunder_i_curve_corner {
    sunder_i_rational_point at;
    double xy[2];
} sunder_i_curve_corner;

/* A segment of the curve, from its corner to that of the next link. */
typedef struct sunder_i_curve_link {
    sunder_i_curve_corner from;
    sunder_i_point along; /* its direction, a plain vector */
    uint32_t next, ring;
    uint32_t place; /* one more than the number of the place where its corner stands with others; 0: it stands alone */
    bool chord;
} sunder_i_curve_link;

/* Two links that have a corner in common by chance: the numbers of the links that start there. */
typedef struct sunder_i_curve_touch {
    uint32_t corner[2];
} sunder_i_curve_touch;

/* A link as seen from a place where several corners stand: it leaves there, or arrives. */
typedef struct sunder_i_curve_ray {
    sunder_i_point along;  /* away from the place */
    uint32_t link, corner; /* corner: that of the two that it has in the place */
    int32_t number;        /* what the sector behind the ray has more than that to the west of the place */
    bool leaves;
} sunder_i_curve_ray;

/* A crossing as seen from one of its two links. */
typedef struct sunder_i_curve_stop {
    uint32_t link, partner; /* partner: the stop of the other link */
    uint32_t crossing;
    bool rises; /* the link goes to the left of the other one */
} sunder_i_curve_stop;

typedef struct sunder_i_figure_convolution {
    const sunder_i_figure *figure;
    const sunder_i_structuring_element *element; /* one convex piece, plain */
    bool erode;                                  /* the curve is that of the figure's complement */
    long shift;                                  /* doubles are coordinates times 2^shift */
    double error;
    sunder_i_arena memory, scratch; /* of all of this, and of one question */
    sunder_counts counts;
    sunder_i_curve_link *link;
    uint32_t links;
    uint32_t *ring_end; /* [rings] in links, which follow each other ring by ring */
    uint32_t rings;
    uint32_t *stop_end; /* [links] past the last stop on each; stops of a link in its direction */
    sunder_i_curve_stop *stop;
    sunder_i_curve_corner *crossing;
    size_t stops, crossings;
    sunder_i_curve_touch *touch;
    sunder_i_curve_ray *ray; /* of all places; those of a place counter-clockwise, from the west on */
    uint32_t *place_end;     /* [places] in rays */
    size_t touches, places;
} sunder_i_figure_convolution;

/* Builds the curve; *fits is false where the figure or the element is of no kind that this is for. */
sunder_status sunder_i_figure_convolution_build(sunder_i_figure_convolution *curve, bool *fits, sunder_error *err);
/* Finds all stops, and corners that stand in one place; *fits is false where anything else meets but two links that
 * cross in their insides, or where there are too many pairs to look at. */
sunder_status sunder_i_figure_convolution_cross(sunder_i_figure_convolution *curve, bool *fits, sunder_error *err);

/* Sorts the links at all places where corners stand together; *fits is false where two of them leave a place in one
 * direction. */
sunder_status sunder_i_figure_convolution_places(sunder_i_figure_convolution *curve, bool *fits, sunder_error *err);

/* Side of c to the line ab: +1 left, -1 right, 0 on it. */
int sunder_i_curve_side(sunder_i_figure_convolution *curve, const sunder_i_curve_corner *a,
                        const sunder_i_curve_corner *b, const sunder_i_curve_corner *c);
/* Order by x (axis 0) or y (1); and lexicographic, x first. */
int sunder_i_curve_cmp_axis(sunder_i_figure_convolution *curve, const sunder_i_curve_corner *a,
                            const sunder_i_curve_corner *b, int axis);
static inline int sunder_i_curve_cmp(sunder_i_figure_convolution *curve, const sunder_i_curve_corner *a,
                                     const sunder_i_curve_corner *b)
{
    const int by_x = sunder_i_curve_cmp_axis(curve, a, b, 0);
    return by_x ? by_x : sunder_i_curve_cmp_axis(curve, a, b, 1);
}

/* The cross product of two plain vectors. */
static inline sunder_i_i128 sunder_i_plain_cross(sunder_i_point u, sunder_i_point v)
{
    return (sunder_i_i128)u.x * v.y - (sunder_i_i128)u.y * v.x;
}

static inline uint32_t sunder_i_curve_first(const sunder_i_figure_convolution *curve, uint32_t ring)
{
    return ring ? curve->ring_end[ring - 1] : 0;
}

static inline uint32_t sunder_i_place_first(const sunder_i_figure_convolution *curve, uint32_t place)
{
    return place ? curve->place_end[place - 1] : 0;
}

static inline const sunder_i_curve_corner *sunder_i_curve_end(const sunder_i_figure_convolution *curve, uint32_t link)
{
    return &curve->link[curve->link[link].next].from;
}

#endif
