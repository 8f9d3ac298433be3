/* layer_checksum.c: see layer_checksum.h. For conditions the checksum covers their results, not the columns that they
 * name: these may be in other tables, and a change that changes no result changes no move. */
#include "layer/layer_checksum.h"

#include "base/interrupt.h"
#include "disk/checksum.h"
#include "read/fields.h"
#include "read/source_checksum.h"

#include <stdlib.h>
#include <string.h>

/* Number of features in a batch. */
enum { BATCH = 8192 };

/* The index of a field that was found when the layer was opened; -1: the option was not given. */
static int field_of(const gis_layer_input *input, const char *name)
{
    return name ? gis_source_field(input->source, name) : -1;
}

static bool add_field(const gis_layer_input *input, int field, uint64_t *checksum, gis_error *error)
{
    for (size_t i = 0; field >= 0 && i < gis_source_count(input->source); i++) {
        OGRFeatureH feature = gis_source_feature(input->source, i);
        const bool set = OGR_F_IsFieldSetAndNotNull(feature, field) != 0;
        char *value = set ? gis_field_key(feature, field) : NULL;
        if (set && !value) return gis_no_memory(error);
        *checksum = gis_checksum_of(*checksum, value, set ? strlen(value) + 1 : 0);
        free(value);
        if (!gis_go_on(error)) return false;
    }
    return true;
}

static bool add_marks(const gis_layer_input *input, const char *option, const char *where, uint64_t *checksum,
                      gis_error *error)
{
    const size_t n = gis_source_count(input->source);
    bool *marks = where ? calloc(n + 1, sizeof *marks) : NULL;
    if (!where) return true;
    if (!marks) return gis_no_memory(error);
    const bool done = gis_source_mark(input->source, option, where, marks, error);
    for (size_t i = 0; i < n && done; i++) *checksum = gis_checksum_of(*checksum, &marks[i], sizeof *marks);
    free(marks);
    return done;
}

bool gis_layer_checksums_add(gis_layer_checksums *sums, const gis_layer_input *input, gis_error *error)
{
    const gis_layer_input_request *request = input->request;
    const int field[] = {input->id_field,
                         input->block_field,
                         input->limit_field,
                         input->weight_field,
                         input->rows_field,
                         input->hierarchy_field,
                         input->class_field,
                         field_of(input, request->symbol_field),
                         field_of(input, request->symbol_size_field)};
    enum { FIELDS = sizeof field / sizeof *field, FIRST_FIELD = 4 };
    _Static_assert(FIRST_FIELD + FIELDS == GIS_LAYER_CHECKSUMS, "a sum for each");
    bool done = gis_source_checksum(input->source, &sums->of[0], error) &&
                add_marks(input, "--ignore-where", request->rules.ignore_where, &sums->of[1], error) &&
                add_marks(input, "--fixed-where", request->rules.fixed_where, &sums->of[2], error) &&
                add_marks(input, "--rigid-where", request->rules.rigid_where, &sums->of[3], error);
    for (int k = 0; done && k < FIELDS; k++) done = add_field(input, field[k], &sums->of[FIRST_FIELD + k], error);
    return done;
}

uint64_t gis_layer_checksums_end(const gis_layer_checksums *sums)
{
    return gis_checksum_of(0, sums->of, sizeof sums->of);
}

bool gis_layer_checksum(const gis_layer_input_request *request, const gis_source_facts *facts, uint64_t *checksum,
                        gis_error *error)
{
    gis_layer_input_request by_batches = *request;
    gis_layer_input input = {0};
    gis_layer_checksums sums = {0};
    by_batches.source.batch = BATCH;
    by_batches.source.fids_mean_nothing = !facts->fids_unique;
    bool done = gis_layer_begin(&by_batches, true, &input, error), any = true;
    while (done && any)
        done = gis_layer_checksums_add(&sums, &input, error) && gis_source_next(input.source, &any, error);
    gis_layer_input_clear(&input);
    *checksum = gis_layer_checksums_end(&sums);
    return done;
}
