/* barrier_spooling.c: writes barriers to disk, for a layer that is separated in parts. The source is read a batch at a
 * time, and each barrier is written as it is read. */
#include "shards/run/barrier_spooling.h"

#include "layer/gap_rules.h"
#include "shards/spool/barrier_spool.h"

#include <cpl_conv.h>

/* Number of features in a batch. */
enum { BATCH = 8192 };

typedef struct spooling {
    gis_barriers_writer *writer;
    const gis_barrier_request *request;
    uint32_t gap_class; /* of the barriers of the request */
    size_t n;
} spooling;

static bool take_barrier(void *user, const gis_barrier_common *common, gis_barrier_feature *f, gis_error *error)
{
    spooling *s = user;
    const gis_spooled_barrier barrier = {
        .number = s->n++,
        .fid = f->fid,
        .layer = common->layer,
        .demands = gis_barrier_demands(f, s->request, common),
        .gap_class = s->gap_class,
    };
    const bool done = gis_barriers_add(s->writer, &barrier, error);
    gis_barrier_feature_clear(f);
    return done;
}

static bool spool_all(const gis_layer_input *input, const gis_barrier_surroundings *around, const char *directory,
                      gis_error *error)
{
    const gis_layer_input_request *request = input->request;
    const gis_gap_classes *classes = request->rules.classes;
    const sunder_gaps gaps = gis_class_gaps_core(classes, &input->class_tables);
    spooling s = {0};
    bool done = gis_barriers_create(directory, around->least_gap >= 0 ? around->least_gap : around->gap, around->gap,
                                    &gaps, &s.writer, error);
    for (size_t k = 0; k < request->barriers && done; k++) {
        gis_barrier_common common;
        s.request = &request->barrier[k];
        s.gap_class = classes ? gis_class_gaps_of_barrier(classes, k) : 0;
        done = gis_barrier_visit(s.request, around, BATCH, take_barrier, &s, &common, error);
        CPLFree(common.layer);
    }
    done = done && gis_barriers_finish(s.writer, error);
    gis_barriers_writer_free(s.writer);
    return done;
}

bool gis_barriers_spool(const gis_layer_input *input, const gis_barrier_surroundings *around, const char *directory,
                        gis_error *error)
{
    if (spool_all(input, around, directory, error)) return true;
    if (!error->in_a_box) return false;
    gis_barrier_surroundings all = *around;
    all.without_box = true;
    return spool_all(input, &all, directory, error);
}

/* ---- Targets ----------------------------------------------------------------------------------------------------- */

static const double *box_of_cell(void *spool, size_t cell) { return gis_spool_cell_at(spool, cell)->box; }

static size_t features_of_cell(void *spool, size_t cell) { return gis_spool_cell_at(spool, cell)->features; }

static bool read_boxes(void *spool, size_t cell, double (*box)[4], size_t *n, gis_error *error)
{
    return gis_spool_boxes(spool, cell, box, n, error);
}

gis_barrier_targets *gis_barrier_targets_of_spool(gis_spool *spool, double reach)
{
    const gis_box_cells cells = {spool, gis_spool_cells(spool), reach, box_of_cell, features_of_cell, read_boxes};
    return gis_barrier_targets_of_cells(&cells);
}
