/* Contacts of two bodies in a layout, as used for groups, blocks and pushes. */
#ifndef SUNDER_I_BODY_CONTACT_H
#define SUNDER_I_BODY_CONTACT_H

#include "displacement/prove/optimum/dual_program.h"
#include "displacement/prove/optimum/forbidden.h"

/* A piece of a pair's forbidden set on whose boundary the relative move u lies, up to a hair. The half-plane n.u >= d
 * has u on its boundary; n.u >= d + off is clear of the piece. */
typedef struct sunder_i_contact {
    double n[2], d, off;
    size_t a, b; /* the two things in contact */
    bool shadow; /* the piece is a shadow, which is closed: u may not lie on its boundary */
} sunder_i_contact;

typedef struct sunder_i_contact_list {
    sunder_i_contact *item;
    size_t n, capacity;
} sunder_i_contact_list;

/* Returns the distance, beyond the one that they have to keep, up to which two bodies count as in contact. */
double sunder_i_contact_hair(const sunder_i_model *model, const sunder_i_body *p, const sunder_i_body *q);
/* Sets *out to the contacts of bodies i and j, moved by t and v, for which u is at most `hair` from the boundary on
 * either side. *edges, if not NULL, grows by the number of edges processed. Returns false if memory is out. */
bool sunder_i_contacts_of_pair(const sunder_i_model *model, const sunder_i_waived *waived, uint32_t i, uint32_t j,
                               const double t[2], const double v[2], double hair, sunder_i_contact_list *out,
                               size_t *edges);
/* Sets cut[] to the springs between bodies `a` and `b` as cuts of bodies i and j of a program, one for each sign, and
 * returns their number. What they give is rounded upwards, so that a bound with them holds. */
size_t sunder_i_spring_cuts(const sunder_i_model *model, uint32_t a, uint32_t b, uint32_t i, uint32_t j,
                            sunder_i_move_cut cut[4]);
/* Sets *contact if the bodies i and j, moved by t and v, are in contact or in conflict. */
bool sunder_i_are_in_contact(const sunder_i_model *model, uint32_t i, uint32_t j, const double t[2], const double v[2],
                             bool *contact);

/* Sets *out to the bodies, ascending, whose boxes at their present positions come within `reach` of the body moved by
 * t, or of its path there if paths are restricted. The body itself is among them if it is there. Returns false if
 * memory is out. */
bool sunder_i_bodies_about(const sunder_i_model *model, uint32_t body, const double t[2], double reach,
                           sunder_i_list *out);

#endif
