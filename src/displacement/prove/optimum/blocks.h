/* Large groups: a lower bound from overlapping blocks of a few bodies; see blocks.c. */
#ifndef SUNDER_I_BLOCKS_H
#define SUNDER_I_BLOCKS_H

#include "displacement/prove/optimum/body_contact.h"
#include "displacement/prove/optimum/bundle.h"
#include "displacement/prove/optimum/dual_program.h"
#include "displacement/prove/optimum/optimum.h"

/* ---- contact_forces.c -------------------------------------------------------------------------------------------- */

/* The contacts of a layout, and the forces on them. Bodies are numbered by their places in the group's list. */
typedef struct sunder_i_contact_forces {
    const sunder_i_model *model;
    const sunder_i_waived *waived;
    sunder_i_move_cut *cut;
    double *force; /* [n] the force on each contact */
    size_t n, capacity;
    sunder_i_contact_list touch;   /* the contacts of one pair; scratch */
    sunder_i_dual_program program; /* its t: the moves at which these forces hold the bodies */
    uint64_t steps;
} sunder_i_contact_forces;

/* Finds the contacts of the group's layout and their forces. weight, mass, anchor: as in the program; borrowed. Returns
 * false if memory is out; the caller frees *contacts in any case. */
bool sunder_i_contact_forces_find(sunder_i_contact_forces *contacts, const sunder_i_model *model,
                                  const sunder_i_waived *waived, const sunder_i_group *group, const double *weight,
                                  const double *mass, const double *anchor);
void sunder_i_contact_forces_free(sunder_i_contact_forces *contacts);

/* ---- block_cover.c ----------------------------------------------------------------------------------------------- */

/* A copy of a body: the body as a member of one block. share: its share of the body's weight; force: the sum of the
 * forces of the block's contacts on it; anchor: the place to which it is drawn, not relative to the preferred one; t:
 * its move in the block's last layout. */
typedef struct sunder_i_block_copy {
    uint32_t at; /* the body's place in the group's list */
    double share;
    double force[2], anchor[2], t[2];
} sunder_i_block_copy;

typedef struct sunder_i_lagrangian {
    const sunder_i_model *model;
    const sunder_i_waived *waived;
    const sunder_i_group *group;
    double *weight, *mass, *anchor; /* [group] of the bodies; the anchors are the preferred moves */
    sunder_i_contact_forces contacts;
    uint32_t *home;  /* [contacts] the block that each belongs to */
    uint32_t *count; /* [group] the number of copies of each body */
    sunder_i_block_copy *item;
    size_t items, capacity;
    size_t *first; /* [blocks + 1] the first copy of each block */
    size_t blocks, first_capacity;
    double *pressure; /* [group] scratch */
    sunder_i_bundle bundle;
    uint32_t *member; /* [items] the arrays that the bundle borrows */
    double *others;
    size_t size;                /* the number of movable bodies of a block */
    double proved;              /* the greatest bound proved by blocks of other sizes */
    uint64_t steps, most, each; /* done, the limit for the whole group, and the limit for the tree of one block */
} sunder_i_lagrangian;

/* Does the body at place `at` of the group's list move? */
static inline bool sunder_i_is_mover_of(const sunder_i_lagrangian *d, uint32_t at) { return d->mass[at] > 0; }

/* Divides the group into blocks by its contacts. Returns false if memory is out. */
bool sunder_i_make_blocks(sunder_i_lagrangian *lagrangian);

/* ---- blocks.c ---------------------------------------------------------------------------------------------------- */

/* Proves a lower bound of the group's cost by blocks, rounded downwards, in at most `steps` steps. *trees gets the
 * trees if they are kept and *bound exceeds `known`. */
sunder_status sunder_i_blocks_bound(const sunder_i_model *model, const sunder_i_waived *waived,
                                    const sunder_i_group *group, uint64_t steps, double known, double *bound,
                                    sunder_i_bound_trees *trees, sunder_error *err);

#endif
