/* The state of a search for a place without spare room (tight_place.c). A row is a set of coordinates, all along x or
 * all along y, of several bodies' moves that differ by multiples of one step and change together. */
#ifndef SUNDER_I_DISPLACEMENT_TIGHT_H
#define SUNDER_I_DISPLACEMENT_TIGHT_H

#include "displacement/prove/optimum/body_contact.h"

typedef struct sunder_i_tight_meeting {
    size_t i, j; /* places in the list of bodies */
    sunder_i_contact contact;
} sunder_i_tight_meeting;

typedef struct sunder_i_tight {
    const sunder_i_model *model;
    const sunder_i_waived *waived;
    size_t n, all;  /* n: the bodies that are to be placed; all: including bodies outside that are within a hair of
                     * them, which come after these */
    uint32_t *body; /* [all] */
    double *t;      /* [2 * all] moves, good up to rounding; those of bodies outside are exact */
    size_t capacity, places;
    int exponent; /* of the step, which is a power of two */
    double step, size, hair, margin;
    double room;   /* the distance by which moves have to be shorter than their limits */
    uint32_t *row; /* [2 * all] the row of each body's x and of its y; rows of both axes are numbered together */
    double *base;  /* [2 * all + 1] the move of the first body of each row */
    double *ahead; /* [2 * all] the offset of each coordinate from its row's base, a multiple of the step */
    bool *stays;   /* [2 * all + 1] the row does not move: it is that of fixed bodies, or begins with a body outside */
    bool *alone;   /* [2 * all] the coordinate is not aligned with others */
    size_t rows;
    sunder_i_contact_list touch; /* the contacts of one pair; scratch */
    sunder_i_tight_meeting *meeting;
    size_t meetings, most_meetings;
    sunder_i_list near; /* scratch */
    double *corner;     /* scratch */
    size_t corners;
} sunder_i_tight;

/* ---- tight_step.c: the step of coordinates, and the participants ------------------------------------------------- */

/* Adds a body, moved by t. Returns false if memory is out. */
bool sunder_i_tight_add(sunder_i_tight *f, uint32_t body, const double t[2]);
/* Finds the common step of all coordinates of the group's bodies and of the distances that they have to keep, and a
 * tolerance (hair) in proportion to the movable ones (a fixed one may be a road, miles long). Sets *coarse if there is
 * such a step. Returns false if memory is out. */
bool sunder_i_tight_find_step(sunder_i_tight *f, bool *coarse);
/* Adds the other bodies that are within a hair of the place. Returns false if memory is out. */
bool sunder_i_tight_find_outside(sunder_i_tight *f);

/* ---- tight_rows.c: what moves as one, and how far ---------------------------------------------------------------- */

/* Finds the rows of all bodies that take part, and moves rows apart where they have room, within limits. The exponent
 * of the step must have been found. Returns false if memory is out. */
bool sunder_i_tight_draw_rows(sunder_i_tight *f);
/* Moves the rows apart again, from where they are. */
void sunder_i_tight_draw_apart(sunder_i_tight *f);
/* Returns the present value of coordinate k; there are two for each body. */
static inline double sunder_i_tight_place_of(const sunder_i_tight *f, size_t k)
{
    return f->base[f->row[k]] + f->ahead[k];
}

#endif
