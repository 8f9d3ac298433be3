/* See reads.h. Two threads may read on behalf of the same body, for two conflicts of it. */
#include "displacement/layer/reads.h"

#include <pthread.h>

_Thread_local sunder_i_reading *sunder_i_reads = NULL;

static pthread_mutex_t joining = PTHREAD_MUTEX_INITIALIZER;

void sunder_i_reads_begin(sunder_i_reading *reading, const sunder_i_model *model, uint32_t body)
{
    reading->body = model->read ? &model->read[body] : NULL;
    if (!reading->body) return;
    reading->model = model;
    reading->outer = sunder_i_reads;
    sunder_i_box_clear(reading->box.place);
    sunder_i_box_clear(reading->box.seen);
    sunder_i_reads = reading;
}

void sunder_i_reads_end(sunder_i_reading *reading)
{
    if (!reading->body) return;
    sunder_i_reads = reading->outer;
    pthread_mutex_lock(&joining);
    sunder_i_box_join(reading->body->place, reading->box.place);
    sunder_i_box_join(reading->body->seen, reading->box.seen);
    pthread_mutex_unlock(&joining);
}

void sunder_i_reads_note(const sunder_i_model *model, const double box[4], const sunder_i_list *hits, size_t before)
{
    const double home[2] = {0, 0};
    sunder_i_reading *to = sunder_i_reads;
    sunder_i_box_join(to->box.place, box);
    for (size_t k = before; k < hits->n && model == to->model; k++) {
        const uint32_t thing = hits->item[k];
        double own[4];
        if (sunder_i_is_barrier(model, thing)) continue;
        sunder_i_body_box(&model->body[model->body_of[thing]], home, 0, own);
        sunder_i_box_join(to->box.seen, own);
    }
}
