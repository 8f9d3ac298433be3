/* The positions of the features at one moment, exactly, and which pairs of them are near. */
#ifndef SUNDER_I_PLACEMENT_H
#define SUNDER_I_PLACEMENT_H

#include "displacement/layer/changes.h"
#include "displacement/layer/model.h"

/* The positions of the features at one moment. */
typedef struct sunder_i_placement {
    double *move;              /* [2 * things] the move of each; zeros if it has a shape of its own in `rounded` or
                                  * `given` */
    sunder_shape **rounded;    /* [things] the rounded translate of a feature whose translate is not exact, owned;
                                  * else NULL */
    const sunder_layer *given; /* NULL, or: features have the shapes of this layer, with no move */
    sunder_i_interior_cover
        *interior_cover; /* [things] the interior covers of these shapes, if there are barriers without area;
                                  * else NULL */
    bool *reshaped;      /* [things] the feature was rounded at some time, or does not have its shape as given */
    sunder_i_rtree tree;
} sunder_i_placement;

/* Returns a thing at its present position. */
static inline sunder_i_translate sunder_i_standing(const sunder_i_model *model, const sunder_i_placement *placement,
                                                   uint32_t thing)
{
    if (sunder_i_is_barrier(model, thing)) return (sunder_i_translate){.shape = sunder_i_thing_shape(model, thing)};
    const sunder_shape *own = placement->given ? placement->given->shape[thing] : placement->rounded[thing];
    if (own)
        return (sunder_i_translate){
            .shape = own, .interior_cover = placement->interior_cover ? placement->interior_cover[thing].shape : NULL};
    sunder_i_translate home = sunder_i_at_home(model, thing);
    home.t[0] = placement->move[2 * (size_t)thing];
    home.t[1] = placement->move[2 * (size_t)thing + 1];
    return home;
}

/* Sets up the placement at the original positions. */
sunder_status sunder_i_placement_init(const sunder_i_model *model, sunder_i_placement *placement, sunder_error *err);
/* Puts the features in `changes` at the present positions of their bodies in model->move. */
sunder_status sunder_i_placement_move(sunder_i_model *model, sunder_i_placement *placement,
                                      const sunder_i_changes *changes, sunder_error *err);
/* Puts the members of one body at its present position in model->move. */
sunder_status sunder_i_placement_move_body(sunder_i_model *model, sunder_i_placement *placement, uint32_t body,
                                           sunder_error *err);
void sunder_i_placement_free(const sunder_i_model *model, sunder_i_placement *placement);
/* Leaves features out, hidden[f] says of each whether it is (NULL: none), and takes the shapes of a lowered layer. To
 * be called once, when the bodies are joined, and while everything is at its original position. `relations` are those
 * there (lowered_features.c). */
sunder_status sunder_i_placement_lower(sunder_i_model *model, sunder_i_placement *placement,
                                       sunder_i_relations *relations, const bool *hidden, sunder_error *err);

/* Sets *fits if the hidden feature f, moved by t, would be in no conflict with the present positions. */
sunder_status sunder_i_placement_fits(const sunder_i_model *model, const sunder_i_placement *placement, uint32_t f,
                                      const double t[2], bool *fits, sunder_error *err);

/* ---- Near pairs -------------------------------------------------------------------------------------------------- */

/* Finds all pairs that are near, touch or are `kept` in the present positions; exact. changes: NULL, or only pairs with
 * one of these features (sorted) are asked for. */
sunder_status sunder_i_placement_relate(const sunder_i_model *model, const sunder_i_placement *placement,
                                        const sunder_i_changes *changes, sunder_i_relations *relations,
                                        sunder_error *err);
/* As sunder_i_placement_relate() for all pairs, with the full gap in place of the gap (full_gap.c). */
sunder_status sunder_i_placement_relate_fully(const sunder_i_model *model, const sunder_i_placement *placement,
                                              sunder_i_relations *relations, sunder_error *err);
/* Updates relations that are right except for pairs with a feature in `changes` (sorted). things: NULL, or all things
 * that are or were near one of these, once each; then no other pairs are looked at. After a failure some relations may
 * be missing. */
sunder_status sunder_i_placement_relate_again(const sunder_i_model *model, const sunder_i_placement *placement,
                                              const sunder_i_changes *changes, const sunder_i_list *things,
                                              sunder_i_relations *relations, sunder_error *err);
/* Appends the things whose boxes come within the gap (or the tolerance, if that is greater) of the box of `thing`,
 * `thing` included. Returns false if memory is out. */
bool sunder_i_placement_near(const sunder_i_model *model, const sunder_i_placement *placement, uint32_t thing,
                             sunder_i_list *near);

/* Called for each relation of a member of one body to a member of another one that is near, touches or is `kept`, in
 * the present positions. Sets *on to false to end the visits. sunder_i_placement_visit() calls it; `near` is scratch
 * there. */
typedef sunder_status (*sunder_i_visit_relation)(void *context, const sunder_i_relation *r, bool *on,
                                                 sunder_error *err);

sunder_status sunder_i_placement_visit(const sunder_i_model *model, const sunder_i_placement *placement, uint32_t body,
                                       sunder_i_list *near, sunder_i_visit_relation visit, void *context,
                                       sunder_error *err);

#endif
