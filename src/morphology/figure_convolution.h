/* figure_convolution.h: the curve of a figure's convolution and its crossings, shared by figure_convolution*.c only.
 *
 *   figure_convolution_links.c      the curve: translated sides, arcs, chords
 *   figure_convolution_crossings.c  its crossings, exactly; other contacts are declined
 *   figure_convolution_places.c     positions that several of its corners have
 *   figure_convolution.c            winding numbers along it, and the rings that they bound */
#ifndef SUNDER_I_FIGURE_CONVOLUTION_H
#define SUNDER_I_FIGURE_CONVOLUTION_H

#include "morphology/morphology.h"

/* A corner of the curve, or a crossing; each double has an error of at most `error` of the curve. */
typedef struct sunder_i_curve_corner {
    sunder_i_rational_point at;
    double xy[2];
} sunder_i_curve_corner;

/* A segment of the curve, from its corner to that of the next link. */
typedef struct sunder_i_curve_link {
    sunder_i_curve_corner from;
    sunder_i_point along; /* its direction, a plain vector */
    uint32_t next, ring;
    uint32_t place; /* one more than the number of the place that its corner shares with others; 0: none */
    bool chord;
} sunder_i_curve_link;

/* Two links that have a corner in common by chance: the numbers of the links that begin there. */
typedef struct sunder_i_curve_touch {
    uint32_t corner[2];
} sunder_i_curve_touch;

/* A link at a place that several corners share: it leaves there, or arrives. */
typedef struct sunder_i_curve_ray {
    sunder_i_point along;  /* the direction away from the place */
    uint32_t link, corner; /* corner: the one of its two corners that is in the place */
    int32_t number;        /* the winding number of the sector after the ray, minus that of the sector west of the
                            * place */
    bool leaves;
} sunder_i_curve_ray;

/* A crossing on one of its two links. */
typedef struct sunder_i_curve_stop {
    uint32_t link, partner; /* partner: the stop on the other link */
    uint32_t crossing;
    bool rises; /* the link goes to the left of the other one */
} sunder_i_curve_stop;

typedef struct sunder_i_figure_convolution {
    const sunder_i_figure *figure;
    const sunder_i_structuring_element *element; /* one convex piece with plain directions */
    bool erode;                                  /* the curve is that of the figure's complement */
    long shift;                                  /* doubles are coordinates times 2^shift */
    double error;
    sunder_i_arena memory, scratch; /* memory for all of this, and for the current test */
    sunder_counts counts;
    sunder_i_curve_link *link;
    uint32_t links;
    uint32_t *ring_end; /* [rings] the end of each ring's links; the links of a ring are consecutive */
    uint32_t rings;
    uint32_t *stop_end; /* [links] the end of each link's stops, which are in the order of its direction */
    sunder_i_curve_stop *stop;
    sunder_i_curve_corner *crossing;
    size_t stops, crossings;
    sunder_i_curve_touch *touch;
    sunder_i_curve_ray *ray; /* the rays of all places; those of a place are counterclockwise, from the west on */
    uint32_t *place_end;     /* [places] the end of each place's rays */
    size_t touches, places;
} sunder_i_figure_convolution;

/* Builds the curve; *fits becomes false if the figure or the element is unsuitable. */
sunder_status sunder_i_figure_convolution_build(sunder_i_figure_convolution *curve, bool *fits, sunder_error *err);
/* Finds all stops, and corners at one position; *fits becomes false if links meet in another way than crossing in their
 * interiors, or if there are too many pairs to test. */
sunder_status sunder_i_figure_convolution_cross(sunder_i_figure_convolution *curve, bool *fits, sunder_error *err);

/* Sorts the links at all places that several corners share; *fits becomes false if two of them leave a place in one
 * direction. */
sunder_status sunder_i_figure_convolution_places(sunder_i_figure_convolution *curve, bool *fits, sunder_error *err);

/* Returns the position of c relative to the line ab: +1 left, -1 right, 0 on it. */
int sunder_i_curve_side(sunder_i_figure_convolution *curve, const sunder_i_curve_corner *a,
                        const sunder_i_curve_corner *b, const sunder_i_curve_corner *c);
/* Compare by x (axis 0) or y (1); and lexicographically, x first. */
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
