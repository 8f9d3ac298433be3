/* Components of bodies in contact in the present layout (contact_groups.c makes groups of them). */
#ifndef SUNDER_I_CONTACT_FLOOD_H
#define SUNDER_I_CONTACT_FLOOD_H

#include "displacement/solve/clusters/solver.h"

typedef struct sunder_i_flood {
    uint32_t *parent;        /* [bodies] union-find; a fixed body is a component by itself */
    sunder_i_list body;      /* movable bodies that have moved, are in conflict, or are connected with one of these by
                              * contacts */
    sunder_i_id_pair *touch; /* [touches] a body of `body`, and a fixed one in contact with it */
    size_t touches, touch_capacity;
} sunder_i_flood;

/* Finds the contacts, starting from bodies that have moved or are in conflict, and the pairs that groups joined. The
 * caller frees `out` even after failure. */
sunder_status sunder_i_flood_contacts(sunder_i_solver *solver, sunder_i_flood *out, sunder_error *err);
void sunder_i_flood_free(sunder_i_flood *flood);

#endif
