/* Exact relations of pairs, as they stand. */
#ifndef SUNDER_I_RELATE_H
#define SUNDER_I_RELATE_H

#include "displacement/layer/layer.h"

/* A feature as it stands: its shape, exactly translated. A feature whose translate does not fit doubles stands as the
 * shape that is written, with no translation. */
typedef struct sunder_i_translate {
    const sunder_shape *shape;
    double t[2];
    const sunder_shape *seamless; /* the same set in the form needed against things without area (seamless.h); NULL:
                                   * shape will do */
} sunder_i_translate;

typedef struct sunder_i_relation {
    uint32_t a, b;  /* things, a < b; a is a feature */
    bool near;      /* not the gap apart */
    bool overlap;   /* interiors meet */
    bool drawn;     /* ... do not, but a is nearer to b, a part of a barrier, than half its width */
    bool contained; /* one lies in the other, up to the tolerance */
    bool a_in_b;    /* which: a in b */
    bool duplicate; /* equal sets */
    bool touch;     /* they touch, or gape or overlap by no more than the tolerance */
    bool kept;      /* contained, and the rules let such pairs overlap */
} sunder_i_relation;

/* All questions about one pair, exact. */
sunder_status sunder_i_relate(const sunder_i_rules *rules, const sunder_i_translate *a, const sunder_i_translate *b,
                              sunder_i_relation *relation, sunder_error *err);

typedef struct sunder_i_relations {
    sunder_i_relation *pair; /* sorted by (a, b); only pairs that are near, touch or are kept */
    size_t n, room;
    size_t tested; /* pairs of boxes that were looked at */
} sunder_i_relations;

const sunder_i_relation *sunder_i_relations_find(const sunder_i_relations *relations, uint32_t a, uint32_t b);

/* ---- thin_overlap.c ---------------------------------------------------------------------------------------------- */

/* Two interiors meet: in no more than the tolerance? That is, the least translation that separates them is no longer,
 * or no polygon of 16 corners in the disc of that diameter (sunder_shape_disc()) fits into their intersection. Exact.
 * disc: that polygon. */
sunder_status sunder_i_overlap_is_thin(const sunder_i_translate *a, const sunder_i_translate *b, double tolerance,
                                       const sunder_shape *disc, bool *thin, sunder_error *err);
/* The polygon, to be freed: it costs more than most of the questions that it is for. NULL where it would be a point. */
sunder_status sunder_i_thin_disc(double tolerance, sunder_shape **disc, sunder_error *err);

/* ---- roomy_place.c ----------------------------------------------------------------------------------------------- */

/* A place in both, about so far from the sides of either; a proposal of doubles. None found says nothing. */
sunder_status sunder_i_roomy_place(const sunder_i_translate *a, const sunder_i_translate *b, double radius, bool *found,
                                   double place[2], sunder_error *err);

/* ---- grown_shape.c ----------------------------------------------------------------------------------------------- */

/* Q + D as a shape, where D is a polygon of 16 corners in the disc whose radius is the tolerance (> 0); its corners are
 * the nearest doubles. */
sunder_status sunder_i_grow_by_tolerance(const sunder_shape *q, double tolerance, sunder_shape **out,
                                         sunder_error *err);

#endif
