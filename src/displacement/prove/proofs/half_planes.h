/* The lines by which a convex part of one feature may pass a convex part of another. */
#ifndef SUNDER_I_HALF_PLANES_H
#define SUNDER_I_HALF_PLANES_H

#include <stdbool.h>
#include <stddef.h>

/* Two convex polygons, counter-clockwise, each relative to an origin, and the distance that they have to keep: to be
 * `clearance` apart; or, if that is negative, that some translation no longer than -clearance makes their interiors
 * disjoint. */
typedef struct sunder_i_parting {
    const double *a, *b;
    size_t na, nb;
    double offset[2]; /* the origin of B less that of A */
    double vague;     /* corners have an error of 2^-52 of this besides their own rounding; 0 if coordinates are
                       * doubles */
    double clearance;
    const double *at; /* NULL, or a relative move at which the lines must decide whether the clearance is kept */
    double coarse;    /* the distance by which lines may demand less, so that one can replace several */
    bool exact; /* corners and offset have no errors at all; then edges demand no less than they have to where doubles
                 * hold their lines (exact_line.h) */
} sunder_i_parting;

/* A half-plane of relative moves u of B. Moves in any one of the half-planes of a pair separate the two. */
typedef struct sunder_i_half_plane {
    double n[2], d;  /* the half-plane is n.u >= d; n has length 1 within 2^-51, or at most 1 if the line is exact */
    double base, by; /* d is base + by * clearance, for all clearances of one sign, if coarse and at are the same */
    double at;       /* n.u - d at the given relative move */
    size_t next;     /* in a proof: the node for this case */
} sunder_i_half_plane;

/* At a corner the lines that are not made for a given place demand less than the clearance, by up to this share. */
#define SUNDER_I_CORNER_LOSS (1.0 / 12)

#define SUNDER_I_HALF_PLANES_A_CORNER 5
#define SUNDER_I_HALF_PLANES_MORE 8

/* Computes half-planes such that every u outside the shadow of A + (-B) from the origin (geometry/obstacle_shadow.h),
 * or on its boundary, lies in one of them, exactly. One of the two polygons is an anchor, of one corner, and the
 * clearance does not apply. Room and result are as below; the result is also 0 if the origin is too near to the
 * obstacle. */
size_t sunder_i_half_planes_past(const sunder_i_parting *parting, sunder_i_half_plane *out);

/* Computes half-planes such that every u at which the two keep their clearance lies in one of them, exactly. out: room
 * for SUNDER_I_HALF_PLANES_A_CORNER (na + nb) + SUNDER_I_HALF_PLANES_MORE of them. Returns their number; 0 if rounding
 * hides the interior of the parts. */
size_t sunder_i_half_planes_between(const sunder_i_parting *parting, sunder_i_half_plane *out);

#endif
