/* How the features stand at one moment, exactly, and which pairs of them are near. */
#ifndef SUNDER_I_PLACEMENT_H
#define SUNDER_I_PLACEMENT_H

#include "displacement/layer/changes.h"
#include "displacement/layer/model.h"

/* How the features stand at one moment. */
typedef struct sunder_i_placement {
    double *move;                /* [2 * things] zeros of those that stand as a shape of their own */
    sunder_shape **rounded;      /* [things] owned shapes of features whose translate was rounded; else NULL */
    const sunder_layer *given;   /* NULL, or features are the shapes that they have there, with no move */
    sunder_i_seamless *seamless; /* [things] of both, where there are barriers without area; else NULL */
    bool *was_rounded;           /* [things] at any time */
    sunder_i_rtree tree;
} sunder_i_placement;

/* A thing as it stands. */
static inline sunder_i_translate sunder_i_standing(const sunder_i_model *model, const sunder_i_placement *placement,
                                                   uint32_t thing)
{
    if (sunder_i_is_barrier(model, thing)) return (sunder_i_translate){.shape = sunder_i_thing_shape(model, thing)};
    const sunder_shape *own = placement->given ? placement->given->shape[thing] : placement->rounded[thing];
    if (own)
        return (sunder_i_translate){.shape = own,
                                    .seamless = placement->seamless ? placement->seamless[thing].shape : NULL};
    sunder_i_translate home = sunder_i_at_home(model, thing);
    home.t[0] = placement->move[2 * (size_t)thing];
    home.t[1] = placement->move[2 * (size_t)thing + 1];
    return home;
}

/* The placement at the start, and after bodies moved: every feature that changed (sorted) is placed anew by
 * model->move. Failure leaves a placement that can be freed. */
sunder_status sunder_i_placement_init(const sunder_i_model *model, sunder_i_placement *placement, sunder_error *err);
sunder_status sunder_i_placement_move(sunder_i_model *model, sunder_i_placement *placement,
                                      const sunder_i_changes *changes, sunder_error *err);
/* The same for one body. */
sunder_status sunder_i_placement_move_body(sunder_i_model *model, sunder_i_placement *placement, uint32_t body,
                                           sunder_error *err);
void sunder_i_placement_free(const sunder_i_model *model, sunder_i_placement *placement);

/* ---- Near pairs -------------------------------------------------------------------------------------------------- */

/* All pairs that are near, touch or are kept, as the features stand; exact. changes: NULL, or those alone (sorted) of
 * whose pairs it is asked. */
sunder_status sunder_i_placement_relate(const sunder_i_model *model, const sunder_i_placement *placement,
                                        const sunder_i_changes *changes, sunder_i_relations *relations,
                                        sunder_error *err);
/* Updates relations that are right except for these features (sorted), which have moved since. things: NULL, or every
 * thing that is or was near one of these, once each: then the rest is not looked at. On failure relations may lack
 * some. */
sunder_status sunder_i_placement_relate_again(const sunder_i_model *model, const sunder_i_placement *placement,
                                              const sunder_i_changes *changes, const sunder_i_list *things,
                                              sunder_i_relations *relations, sunder_error *err);
/* Appends what stands near a thing, itself among it. False if memory is out. */
bool sunder_i_placement_near(const sunder_i_model *model, const sunder_i_placement *placement, uint32_t thing,
                             sunder_i_list *near);

/* Called for the relations of one body's members to those of others, as they stand, until *on is false; near:
 * scratch. */
typedef sunder_status (*sunder_i_visit_relation)(void *context, const sunder_i_relation *r, bool *on,
                                                 sunder_error *err);

sunder_status sunder_i_placement_visit(const sunder_i_model *model, const sunder_i_placement *placement, uint32_t body,
                                       sunder_i_list *near, sunder_i_visit_relation visit, void *context,
                                       sunder_error *err);

#endif
