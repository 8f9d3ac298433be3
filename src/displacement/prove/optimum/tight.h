/* A place with no room to spare while it is looked for (tight_place.c), which the steps share. */
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
    size_t n, all;  /* those that are to be placed; with those outside that stand within a hair, after them */
    uint32_t *body; /* [all] */
    double *t;      /* [2 * all] moves, good up to rounding; those outside stand just so */
    size_t capacity, places;
    int exponent; /* of the step */
    double step, size, hair, margin;
    double room;   /* moves are to be shorter than their limits by this */
    uint32_t *row; /* [2 * all] of each body's x, and of its y; rows of both axes are numbered together */
    double *base;  /* [2 * all + 1] the move of the first body of each row */
    double *ahead; /* [2 * all] whole steps from there */
    bool *stays;   /* [2 * all + 1] rows with a fixed body */
    bool *alone;   /* [2 * all] coordinates that are not lined up */
    size_t rows;
    sunder_i_contact_list touch; /* of the pair looked at */
    sunder_i_tight_meeting *meeting;
    size_t meetings, most_meetings;
    sunder_i_list near; /* scratch */
    double *corner;     /* scratch */
    size_t corners;
} sunder_i_tight;

/* ---- tight_step.c: the step of coordinates, and the participants ------------------------------------------------- */

/* One more body, which stands there. */
bool sunder_i_tight_add(sunder_i_tight *f, uint32_t body, const double t[2]);
/* Finds the common step of all coordinates of the group's bodies and of the distances they owe, and a hair in
 * proportion to the movable ones (a fixed one may be a road, miles long); *coarse: there is such a step. False if
 * memory is out. */
bool sunder_i_tight_find_step(sunder_i_tight *f, bool *coarse);
/* Other bodies within a hair of the place take part, too. */
bool sunder_i_tight_find_outside(sunder_i_tight *f);

/* ---- tight_rows.c: what moves as one, and how far ---------------------------------------------------------------- */

/* Finds the rows of all bodies that take part. Draws them apart where they have room, within limits. The exponent of
 * the step is known before. False if memory is out. */
bool sunder_i_tight_draw_rows(sunder_i_tight *f);
/* These rows, from where they are. */
void sunder_i_tight_draw_apart(sunder_i_tight *f);
/* Where coordinate k is, of two for each body. */
static inline double sunder_i_tight_place_of(const sunder_i_tight *f, size_t k)
{
    return f->base[f->row[k]] + f->ahead[k];
}

#endif
