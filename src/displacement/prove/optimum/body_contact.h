/* Where two bodies of a layout touch: the one answer for groups, blocks and pushes. */
#ifndef SUNDER_I_BODY_CONTACT_H
#define SUNDER_I_BODY_CONTACT_H

#include "displacement/prove/optimum/forbidden.h"

/* A piece of a pair that its relative move u is on the boundary of, up to a hair: n.u >= d keeps it where it is, and
 * with d + off it is off the piece. */
typedef struct sunder_i_contact {
    double n[2], d, off;
    size_t a, b; /* the things that touch */
    bool shadow; /* which are closed: u may not be on the boundary of one */
} sunder_i_contact;

typedef struct sunder_i_contact_list {
    sunder_i_contact *item;
    size_t n, capacity;
} sunder_i_contact_list;

/* How far apart, beyond what they owe, bodies may be that are in contact. */
double sunder_i_contact_hair(const sunder_i_model *model, const sunder_i_body *p, const sunder_i_body *q);
/* The contacts of bodies i and j, which stand at moves t and v, that are no farther than `hair` from the boundary on
 * either side, in place of what the list held. *edges, if given, grows by the size of what was looked at. False if
 * memory is out. */
bool sunder_i_contacts_of_pair(const sunder_i_model *model, const sunder_i_waived *waived, uint32_t i, uint32_t j,
                               const double t[2], const double v[2], double hair, sunder_i_contact_list *out,
                               size_t *edges);
/* Are they in contact, or in conflict? */
bool sunder_i_are_in_contact(const sunder_i_model *model, uint32_t i, uint32_t j, const double t[2], const double v[2],
                             bool *contact);

/* Bodies that stand within reach of where one goes, or, where ways matter, of its way there, by boxes: instead of what
 * is in out, ascending, the body itself among them if it stands there. False if memory is out. */
bool sunder_i_who_is_about(const sunder_i_model *model, uint32_t body, const double t[2], double reach,
                           sunder_i_list *out);

#endif
