/* Exact relations of pairs in their present positions. */
#ifndef SUNDER_I_RELATE_H
#define SUNDER_I_RELATE_H

#include "displacement/layer/layer.h"

/* A feature in its present position: its shape and an exact translation. If the translate does not fit doubles, `shape`
 * is the rounded shape that is written, and t is zero. */
typedef struct sunder_i_translate {
    const sunder_shape *shape;
    double t[2];
    const sunder_shape *interior_cover; /* the interior cover of the same set, needed against things without area
                                   * (interior_cover.h); NULL: shape has such pieces itself */
} sunder_i_translate;

typedef struct sunder_i_relation {
    uint32_t a, b;  /* things, a < b; a is a feature */
    bool near;      /* interiors meet, or the distance is less than required: the gap, or that of the barrier b */
    bool overlap;   /* interiors meet */
    bool drawn;     /* the interiors do not meet, but a is nearer to b, a part of a barrier, than half its width */
    bool contained; /* one lies in the other, up to the tolerance */
    bool a_in_b;    /* if contained: a lies in b */
    bool duplicate; /* equal sets */
    bool touch;     /* they touch, or their distance or overlap is at most the tolerance */
    bool kept;      /* contained, and the rules allow such pairs to overlap */
} sunder_i_relation;

/* Sets all flags of the relation of a and b, which have to keep the gap, exactly; its members a and b are left
 * unchanged. */
sunder_status sunder_i_relate(const sunder_i_rules *rules, double gap, const sunder_i_translate *a,
                              const sunder_i_translate *b, sunder_i_relation *relation, sunder_error *err);

typedef struct sunder_i_relations {
    sunder_i_relation *pair; /* sorted by (a, b); only pairs that are near, touch or are kept */
    size_t n, room;
    size_t tested; /* the number of pairs whose boxes were within reach */
} sunder_i_relations;

/* Returns the relation of the things a < b; NULL if they are not listed. */
const sunder_i_relation *sunder_i_relations_find(const sunder_i_relations *relations, uint32_t a, uint32_t b);

/* ---- thin_overlap.c ---------------------------------------------------------------------------------------------- */

/* Sets *thin if the overlap of two features whose interiors meet is at most the tolerance. That is so if the least
 * translation that separates them is no longer than the tolerance, or if no polygon of 16 corners in the disc of that
 * diameter (sunder_shape_disc()) fits into their intersection. Exact. disc: that polygon. */
sunder_status sunder_i_overlap_is_thin(const sunder_i_translate *a, const sunder_i_translate *b, double tolerance,
                                       const sunder_shape *disc, bool *thin, sunder_error *err);
/* Makes that polygon, which the caller frees; making it costs more than most questions it is used for. *disc is NULL if
 * it would be a point. */
sunder_status sunder_i_thin_disc(double tolerance, sunder_shape **disc, sunder_error *err);

/* ---- roomy_place.c ----------------------------------------------------------------------------------------------- */

/* Proposes a place in both features at a distance of about `radius` from the sides of either, in doubles. If *found is
 * false such a place may exist all the same. */
sunder_status sunder_i_roomy_place(const sunder_i_translate *a, const sunder_i_translate *b, double radius, bool *found,
                                   double place[2], sunder_error *err);

/* ---- grown_shape.c ----------------------------------------------------------------------------------------------- */

/* Computes Q + D as a shape, where D is a polygon of 16 corners in the disc whose radius is the tolerance (> 0). Its
 * corners are rounded to the nearest doubles. */
sunder_status sunder_i_grow_by_tolerance(const sunder_shape *q, double tolerance, sunder_shape **out,
                                         sunder_error *err);

#endif
