/* What hangs together by contact in a layout (contact_groups.c makes groups of it). */
#ifndef SUNDER_I_CONTACT_FLOOD_H
#define SUNDER_I_CONTACT_FLOOD_H

#include "displacement/solve/clusters/solver.h"

typedef struct sunder_i_flood {
    uint32_t *parent;        /* [bodies] union-find; fixed ones are by themselves */
    sunder_i_list body;      /* that moved, are in conflict, or in contact with such, and may move */
    sunder_i_id_pair *touch; /* one of the flood, and a fixed one in contact with it */
    size_t touches, touch_capacity;
} sunder_i_flood;

/* Floods contacts from bodies that moved, are in conflict, or were joined by groups. The caller frees `out` even
 * after failure. */
sunder_status sunder_i_flood_contacts(sunder_i_solver *solver, sunder_i_flood *out, sunder_error *err);
void sunder_i_flood_free(sunder_i_flood *flood);

#endif
