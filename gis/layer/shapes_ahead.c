/* shapes_ahead.c: makes the shapes of plain polygons, as almost all are, on two threads before features are examined
 * one by one (shapes.c). Anything that does not become a shape here, for whatever reason, is left to shapes.c, so that
 * messages do not depend on threads. */
#include "layer/shapes_ahead.h"

#include "base/interrupt.h"
#include "base/resources.h"
#include "base/side_thread.h"

#include <stdatomic.h>

/* MANY: with fewer features, starting a thread takes longer than the work. AT_A_TIME: number of features that a thread
 * takes at once. */
enum { MANY = 5000, AT_A_TIME = 512 };

bool gis_layer_plain_shape(const gis_layer_input *input, const gis_polygonal_part *part, size_t i)
{
    sunder_error why;
    return !(part->linearised > 0) &&
           gis_polygons_shape(&part->set, SUNDER_VALIDITY_STRICT, &input->shape[i], &why) == SUNDER_OK;
}

typedef struct making {
    const gis_layer_input *input;
    atomic_size_t next; /* the first feature that no thread has taken */
} making;

static void make_shapes(void *context)
{
    making *m = context;
    const gis_layer_input *input = m->input;
    gis_polygonal_part part = {0};
    gis_error unheard;
    gis_watch();
    for (size_t i; !gis_interrupted() && (i = atomic_fetch_add(&m->next, AT_A_TIME)) < input->n;)
        for (const size_t end = input->n - i < AT_A_TIME ? input->n : i + AT_A_TIME; i < end; i++) {
            if (!gis_source_is_packed(input->source, i) || !gis_source_polygons(input->source, i, &part, &unheard))
                continue;
            if (input->request->wound) gis_polygons_wind(&part.set);
            gis_layer_plain_shape(input, &part, i);
        }
    gis_polygonal_part_clear(&part);
}

void gis_layer_shapes_ahead(gis_layer_input *input)
{
    if (input->points || input->n < MANY || gis_threads(input->request->rules.core.threads) == 1) return;
    making m = {.input = input};
    gis_side_thread *beside = gis_side_thread_new();
    if (!beside) return;
    gis_side_thread_do(beside, make_shapes, &m);
    make_shapes(&m);
    gis_side_thread_free(beside);
}
