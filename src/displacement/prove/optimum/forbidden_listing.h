/* A forbidden set while its pieces are listed: for the files of forbidden.h. */
#ifndef SUNDER_I_FORBIDDEN_LISTING_H
#define SUNDER_I_FORBIDDEN_LISTING_H

#include "displacement/prove/optimum/forbidden.h"

/* The pair whose pieces are listed, and which of them count. */
typedef struct sunder_i_listing {
    sunder_i_forbidden *out;
    const sunder_i_model *model;
    const sunder_i_waived *waived;
    const sunder_i_body *p, *q;
    const sunder_i_body_pieces *of_p, *of_q;
    double offset[2], reach;
    double window[4]; /* the relative moves u that matter */
    size_t most;      /* the greatest number of pieces */
    bool diagonal_covers, no_paths;
    bool priced; /* priced pieces are listed, instead of others */
    sunder_i_scratch scratch;
    double *drawn, *hull; /* scratch for shadows */
    size_t drawn_capacity, hull_capacity;
} sunder_i_listing;

static inline bool sunder_i_listing_is_full(const sunder_i_listing *l) { return l->out->pieces > l->most; }

/* ---- forbidden_pieces.c ------------------------------------------------------------------------------------------ */

/* Computes K = a + (-B): its corners in l->scratch, *n of them, and its edges after those of the list, which they join
 * if the piece is kept. Returns false if memory is out. */
bool sunder_i_listing_begin_piece(sunder_i_listing *l, const sunder_i_body_piece *a, const sunder_i_body_piece *b,
                                  sunder_i_forbidden_piece *piece, size_t *n);
/* Replaces the edges of the piece by those of the polygon xy. Returns false if memory is out. */
bool sunder_i_listing_set_edges(sunder_i_forbidden *f, sunder_i_forbidden_piece *piece, const double *xy, size_t n);
/* Keeps a piece that was begun, unless it has no interior; xy: its n corners. */
void sunder_i_listing_keep(sunder_i_forbidden *f, sunder_i_forbidden_piece *piece, const double *xy, size_t n);
/* Adds the piece of a and b: with the radius that they owe, with that of their price (l->priced), or with what the
 * waiver demands. Returns false if memory is out. */
bool sunder_i_listing_add_piece(sunder_i_listing *l, const sunder_i_body_piece *a, const sunder_i_body_piece *b,
                                const sunder_i_waiver *waiver);

/* ---- forbidden_shadows.c ----------------------------------------------------------------------------------------- */

/* Adds the shadow of K = a + (-B) from u = 0, as far as it is within reach; one of a and b is an anchor. It is the
 * convex hull of K and of K scaled so that it is beyond reach. The hull lies in the shadow, which is convex; the errors
 * of its corners are scaled likewise. If rounding errors could bring K to 0 no shadow is added. Returns false if memory
 * is out. */
bool sunder_i_listing_add_shadow(sunder_i_listing *l, const sunder_i_body_piece *a, const sunder_i_body_piece *b);
/* Adds the shadows of the pieces of `other` from the anchors of `p`. swapped: `p` is the second body of the pair. */
bool sunder_i_listing_add_shadows(sunder_i_listing *l, const sunder_i_body *p, const sunder_i_body *other,
                                  bool swapped);
/* Adds the shadows of the sides of `part` from the side anchors of `p`. swapped: `p` is the second body of the pair. */
bool sunder_i_listing_add_sides(sunder_i_listing *l, const sunder_i_body *p, const sunder_i_body *part, bool swapped);

#endif
