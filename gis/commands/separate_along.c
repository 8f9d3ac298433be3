/* separate_along.c: layers of a sheet that go along with what moves, in the same run and output. They are what the
 * command follow would make of the result. */
#include "commands/resolve.h"
#include "commands/separate_run.h"

#include "read/crs_units.h"
#include "read/fields.h"

#include <stdlib.h>
#include <string.h>

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

/* The layer of features that move with this number; the only one has number 0. */
static const gis_layer_input *moving_layer(const gis_layer_input *input, size_t k)
{
    return input->parts ? &input->part[k] : input;
}

/* Does a layer go along with features of this layer? */
static bool goes_with(const gis_separate_run *run, const gis_follow *follow, const gis_layer_input *own)
{
    const char *of = follow->request->of;
    return !run->input.parts || !of || strcmp(of, gis_layer_name(own)) == 0;
}

/* Fails if a layer that it goes along with lacks the field of keys. */
static bool check_keys(const gis_separate_run *run, const gis_follow *follow, gis_error *error)
{
    int field;
    for (size_t k = 0; k < gis_layer_sources(&run->input); k++) {
        const gis_layer_input *own = moving_layer(&run->input, k);
        if (goes_with(run, follow, own) &&
            !gis_field_find(own->source, "--spec: id_field", follow->request->id_field, &field, error))
            return false;
    }
    return true;
}

/* The name of main layer number k, those that go along included. */
static const char *main_name(const gis_separate_run *run, size_t k)
{
    const gis_layer_input *input = &run->input;
    if (k >= gis_layer_sources(input)) return gis_follow_name(&run->along.follow[k - gis_layer_sources(input)]);
    if (input->parts) return gis_layer_name(&input->part[k]);
    return gis_resolve_sink(run->options, NULL, gis_layer_title(input)).main_layer;
}

static bool check_name(const gis_separate_run *run, size_t main, gis_error *error)
{
    for (size_t k = 0; k < main; k++)
        if (EQUAL(main_name(run, k), main_name(run, main)))
            return gis_fail_usage(error, "--spec: two layers of the output have the name %s: give one another \"name\"",
                                  main_name(run, main));
    return true;
}

static bool read_one(gis_separate_run *run, size_t k, gis_error *error)
{
    gis_follow *follow = &run->along.follow[k];
    follow->targets = &run->along.targets;
    follow->layers = run->input.parts > 0;
    if (!gis_resolve_along(run->options, &run->options->along[k], &run->along.request[k], error) ||
        !gis_follow_open(&run->along.request[k], follow, error))
        return false;
    if (!gis_crs_may_be_same(gis_source_crs(follow->input), gis_source_crs(run->input.source)))
        return gis_fail(error, "layer %s goes along with %s, and they are in different CRSs: reproject one of them",
                        gis_follow_name(follow), main_name(run, 0));
    return check_name(run, gis_layer_sources(&run->input) + k, error) && check_keys(run, follow, error) &&
           gis_destinations_spare(&run->to, follow->input, error);
}

bool gis_separate_read_along(gis_separate_run *run, gis_error *error)
{
    gis_separate_along *along = &run->along;
    const size_t n = run->options->n_along;
    if (n == 0) return true;
    along->request = calloc(n, sizeof *along->request);
    along->follow = calloc(n, sizeof *along->follow);
    if (!along->request || !along->follow) return gis_no_memory(error);
    for (; along->n < n; along->n++)
        if (!read_one(run, along->n, error)) {
            along->n++; /* it is cleared with the others */
            return false;
        }
    return true;
}

void gis_separate_clear_along(gis_separate_along *along)
{
    for (size_t k = 0; k < along->n; k++) gis_follow_clear(&along->follow[k]);
    gis_follow_targets_clear(&along->targets);
    free(along->request);
    free(along->follow);
    *along = (gis_separate_along){0};
}

/* ---- Targets ----------------------------------------------------------------------------------------------------- */

static bool watch_feature(void *user, const gis_layer_input *own, size_t i, const gis_feature_row *row,
                          gis_error *error)
{
    gis_separate_run *run = user;
    gis_separate_along *along = &run->along;
    const GIntBig fid = gis_source_fid(own->source, i);
    for (size_t k = 0; k < along->n; k++) {
        gis_follow *follow = &along->follow[k];
        const char *id_field = follow->request->id_field;
        const int field = id_field && goes_with(run, follow, own) ? gis_source_field(own->source, id_field) : -1;
        OGRFeatureH feature = field >= 0 ? gis_source_attributes(own->source, i) : NULL;
        if (!gis_follow_add_key(follow, feature, field, fid, error)) return false;
    }
    return gis_follow_take(&along->targets, own, run->input.parts > 0, i, row, error);
}

void gis_separate_watch(gis_separate_run *run, gis_result_layers *layers)
{
    if (!run->along.n) return;
    layers->watch = watch_feature;
    layers->watcher = run;
}

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

bool gis_separate_write_along(gis_separate_run *run, gis_error *error)
{
    gis_separate_along *along = &run->along;
    const bool wanted = along->n && run->chosen & GIS_SEPARATE_MAIN;
    bool ok = !wanted || gis_follow_complete(&along->targets, error);
    for (size_t k = 0; ok && wanted && k < along->n; k++)
        ok = gis_follow_attach(&along->follow[k], NULL, error) &&
             gis_follow_write(run->sink, gis_layer_sources(&run->input) + k, &along->follow[k], error);
    return ok;
}
