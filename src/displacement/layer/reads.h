/* Read sets: which places of the layer a result depends on, needed for layers that are processed in parts.
 *
 * Between begin and end, each query of a tree of things by this thread is recorded for a body, if the model records
 * reads: the box that was queried, and the bodies found there, as a whole. The state belongs to the thread, since the
 * code that begins a question is ten calls above the code that queries. If a question is answered by means of a layer
 * of its own, whose model does not record, its queries are recorded for the outer layer. */
#ifndef SUNDER_I_READS_H
#define SUNDER_I_READS_H

#include "displacement/layer/model.h"

typedef struct sunder_i_reading {
    sunder_i_read box;
    const sunder_i_model *model;
    sunder_i_read *body; /* the body that the reads are recorded for; NULL: none */
    struct sunder_i_reading *outer;
} sunder_i_reading;

extern _Thread_local sunder_i_reading *sunder_i_reads __attribute__((tls_model("initial-exec"), visibility("hidden")));

/* Records the reads of this thread for `body`, until sunder_i_reads_end(). Readings may be nested; a read is recorded
 * for the innermost. If the model records no reads this has no effect, and an outer reading goes on. */
void sunder_i_reads_begin(sunder_i_reading *reading, const sunder_i_model *model, uint32_t body);
void sunder_i_reads_end(sunder_i_reading *reading);
/* Records a query of `box` that appended the things hits->item[before] and those after it. Something must be recorded
 * at present (sunder_i_reads). */
void sunder_i_reads_note(const sunder_i_model *model, const double box[4], const sunder_i_list *hits, size_t before);

/* Returns the body for which reads on the pair of things a and b are recorded: that of a, unless a is fixed and b is a
 * feature that is not. */
static inline uint32_t sunder_i_reader_of(const sunder_i_model *model, size_t a, size_t b)
{
    const uint32_t i = model->body_of[a];
    return model->body[i].fixed && b < model->features && !model->body[model->body_of[b]].fixed ? model->body_of[b] : i;
}

/* Calls sunder_i_rtree_query() for a tree of the model's things, and records the read. */
static inline bool sunder_i_look_about(const sunder_i_model *model, const sunder_i_rtree *tree, const double box[4],
                                       sunder_i_list *hits)
{
    const size_t before = hits->n;
    const bool ok = sunder_i_rtree_query(tree, box, hits);
    if (sunder_i_reads && ok) sunder_i_reads_note(model, box, hits, before);
    return ok;
}

/* Replaces the things in a list by their bodies, ascending and without duplicates. */
static inline void sunder_i_things_to_bodies(const sunder_i_model *model, sunder_i_list *list)
{
    for (size_t k = 0; k < list->n; k++) list->item[k] = model->body_of[list->item[k]];
    list->n = sunder_i_set_make(list->item, list->n);
}

#endif
