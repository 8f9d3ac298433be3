/* What the bodies of a layer influenced each other by, over one layout or several. See influence.c. */
#ifndef SUNDER_I_INFLUENCE_H
#define SUNDER_I_INFLUENCE_H

#include "displacement/report/report.h"

/* Returns the greatest distance at which two bodies may be in contact. */
double sunder_i_contact_reach(const sunder_i_rules *rules);

/* All arrays are by body. A struct of zeros is empty. */
struct sunder_i_influence {
    size_t bodies;
    uint32_t *root; /* union-find of bodies that influenced each other */
    bool *active;   /* the body influenced another, or was influenced */
    bool *fixed;    /* in the layer as given */
    bool *lowers;   /* a member may be hidden or become smaller, so that even a fixed body is not always the same */
    /* The places read for the body, those seen, and those where it stood; of a whole set at its root once
     * sunder_i_influence_gather() was called. */
    double (*read)[4], (*seen)[4], (*wrote)[4];
};

/* Adds the solver's layout, with the conflicts that the report lists; both are of the same layer each time. The caller
 * frees *influence, also after a failure. */
sunder_status sunder_i_influence_add(sunder_i_influence *influence, const sunder_i_solver *solver,
                                     const sunder_report *report, sunder_error *err);
/* Notes that a feature of the model may be hidden or become smaller. */
void sunder_i_influence_lower(sunder_i_influence *influence, const sunder_i_model *model, uint32_t feature);
/* Notes that two things of the model influenced each other. A barrier, and a fixed body that does not lower, joins
 * nothing. */
void sunder_i_influence_meet(sunder_i_influence *influence, const sunder_i_model *model, uint32_t a, uint32_t b);
/* Notes that a hidden feature might stand in the box `place`, for which `read` was looked at. */
void sunder_i_influence_place(sunder_i_influence *influence, const sunder_i_model *model, uint32_t feature,
                              const double place[4], const double read[4]);

/* Is the body fixed in all layouts, and always the same? */
static inline bool sunder_i_influence_stands(const sunder_i_influence *influence, uint32_t body)
{
    return influence->fixed[body] && !influence->lowers[body];
}

/* Gathers the boxes at the roots of sets. Sets world[bodies] to a union-find of the sets, joined if the places read for
 * one meet those where the other stood. */
sunder_status sunder_i_influence_gather(sunder_i_influence *influence, uint32_t *world, sunder_error *err);
void sunder_i_influence_free(sunder_i_influence *influence);

#endif
