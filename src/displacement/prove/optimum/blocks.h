/* Large groups: a bound from overlapping blocks of a few bodies; see blocks.c. */
#ifndef SUNDER_I_BLOCKS_H
#define SUNDER_I_BLOCKS_H

#include "displacement/prove/optimum/body_contact.h"
#include "displacement/prove/optimum/bundle.h"
#include "displacement/prove/optimum/dual_program.h"
#include "displacement/prove/optimum/optimum.h"

/* ---- contact_forces.c -------------------------------------------------------------------------------------------- */

/* The contacts of a layout, and the forces that act on them; i and j are places in the group's list. */
typedef struct sunder_i_contact_forces {
    const sunder_i_model *model;
    const sunder_i_waived *waived;
    sunder_i_move_cut *cut;
    double *force; /* [n] */
    size_t n, capacity;
    sunder_i_contact_list touch;   /* of the pair looked at */
    sunder_i_dual_program program; /* its t: where these forces hold the bodies */
    uint64_t steps;
} sunder_i_contact_forces;

/* weight, mass, anchor: as of the program; lent. False if memory is out; failure leaves what is freed. */
bool sunder_i_contact_forces_find(sunder_i_contact_forces *contacts, const sunder_i_model *model,
                                  const sunder_i_waived *waived, const sunder_i_group *group, const double *weight,
                                  const double *mass, const double *anchor);
void sunder_i_contact_forces_free(sunder_i_contact_forces *contacts);

/* ---- block_cover.c ----------------------------------------------------------------------------------------------- */

/* A body as a member of a block. */
typedef struct sunder_i_block_copy {
    uint32_t at; /* in the group's list */
    double share;
    double force[2], anchor[2], t[2];
} sunder_i_block_copy;

typedef struct sunder_i_lagrangian {
    const sunder_i_model *model;
    const sunder_i_waived *waived;
    const sunder_i_group *group;
    double *weight, *mass, *anchor; /* of the group's bodies; anchors are 0 */
    sunder_i_contact_forces contacts;
    uint32_t *home;  /* [contacts] the block that holds the contact */
    uint32_t *count; /* [group] copies of each body */
    sunder_i_block_copy *item;
    size_t items, capacity;
    size_t *first; /* [blocks + 1] */
    size_t blocks, first_capacity;
    double *pressure; /* [group] scratch */
    sunder_i_bundle bundle;
    uint32_t *member; /* [items] as the bundle wants them */
    double *others;
    size_t size;                /* movers of a block */
    double proved;              /* by blocks of other sizes, at most */
    uint64_t steps, most, each; /* each: for the tree of a block */
} sunder_i_lagrangian;

/* May the body move, which is in that place of the group's list? */
static inline bool sunder_i_is_mover_of(const sunder_i_lagrangian *d, uint32_t at) { return d->mass[at] > 0; }

/* Blocks from the contacts, afresh. False if memory is out. */
bool sunder_i_make_blocks(sunder_i_lagrangian *lagrangian);

/* ---- blocks.c ---------------------------------------------------------------------------------------------------- */

/* The bound of the group proved by blocks, rounded downwards, within this many steps; its trees are kept, if requested
 * and if it exceeds what is `known`. */
sunder_status sunder_i_blocks_bound(const sunder_i_model *model, const sunder_i_waived *waived,
                                    const sunder_i_group *group, uint64_t steps, double known, double *bound,
                                    sunder_i_bound_trees *trees, sunder_error *err);

#endif
