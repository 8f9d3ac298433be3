/* result_layers.c: see result.h. */
#include "layer/result.h"

#include "layer/levels.h"
#include "layer/output.h"

#include "base/interrupt.h"

/* Layers that move together are main layers of the sink. Each is begun before its first feature. */
typedef struct feature_writer {
    const gis_layer_input *input;
    gis_sink *sink;
    gis_sink_layer *layer;
    size_t begun; /* the number of main layers that are begun */
    const gis_result_layers *layers;
} feature_writer;

/* Begins main layers up to number `main`. */
static bool begin_mains(feature_writer *w, size_t main, gis_error *error)
{
    const gis_layer_rules *rules = &w->input->request->rules;
    bool ok = true;
    while (ok && w->begun <= main)
        ok = gis_main_begin(w->sink, w->begun++, rules->hide, gis_levels_asked(rules), &w->layer, error);
    return ok;
}

static bool write_feature(void *user, size_t i, const gis_feature_row *row, gis_error *error)
{
    feature_writer *w = user;
    const gis_layer_input *own = gis_layer_own(w->input, &i);
    if (w->layers->watch && !w->layers->watch(w->layers->watcher, own, i, row, error)) return false;
    if (own->request->rules.drop_hidden && row->status == SUNDER_FEATURE_HIDDEN) return true;
    return (!w->input->parts || begin_mains(w, (size_t)(own - w->input->part), error)) &&
           gis_main_row(w->layer, i, row, error);
}

static bool write_arrow(void *layer, const gis_arrow_row *row, gis_error *error)
{
    return gis_go_on(error) && gis_displacement_row(layer, row, error);
}

typedef struct conflict_writer {
    gis_sink_layer *layer;
    gis_conflict_texts scratch;
} conflict_writer;

static bool write_conflict(void *user, const sunder_conflict *conflict, const gis_things *things, gis_error *error)
{
    conflict_writer *w = user;
    gis_value values[N_CONFLICT_COLUMNS];
    return gis_go_on(error) && gis_things_conflict(things, conflict, &w->scratch, values, error) &&
           gis_line_row(w->layer, values, conflict->from, conflict->to, error);
}

static bool write_push(void *layer, const sunder_push *push, const gis_things *things, const double from[2],
                       const double to[2], gis_error *error)
{
    gis_value values[N_PUSH_COLUMNS];
    gis_things_push(things, push, values);
    return gis_go_on(error) && gis_line_row(layer, values, from, to, error);
}

static bool write_main(const gis_result *r, const gis_result_layers *layers, gis_sink *sink, gis_error *error)
{
    feature_writer w = {.input = r->input, .sink = sink, .layers = layers};
    if (!layers->main) return r->kind->features(r, true, NULL, NULL, error);
    return begin_mains(&w, 0, error) && r->kind->features(r, gis_sink_has_null(w.layer), write_feature, &w, error) &&
           (!r->input->parts || begin_mains(&w, r->input->parts - 1, error));
}

static bool write_displacement(const gis_result *r, gis_sink *sink, gis_error *error)
{
    gis_sink_layer *layer;
    return gis_displacement_begin(sink, r->kind->id_type(r), gis_source_crs(r->input->source), r->input->parts > 0,
                                  &layer, error) &&
           r->kind->arrows(r, gis_sink_has_null(layer), write_arrow, layer, error);
}

static bool write_conflicts(const gis_result *r, gis_sink *sink, gis_error *error)
{
    conflict_writer w = {0};
    const bool rows = gis_layer_core_options(r->input).rows != SUNDER_ROWS_NONE;
    const bool done =
        gis_conflicts_begin(sink, "conflicts", r->kind->id_type(r), gis_source_crs(r->input->source), rows,
                            r->input->parts > 0, r->input->request->rules.has_least_gap, &w.layer, error) &&
        r->kind->conflicts(r, write_conflict, &w, error);
    gis_conflict_texts_clear(&w.scratch);
    return done;
}

static bool write_pushes(const gis_result *r, gis_sink *sink, gis_error *error)
{
    gis_sink_layer *layer;
    return gis_pushes_begin(sink, gis_source_crs(r->input->source), r->input->parts > 0, &layer, error) &&
           r->kind->pushes(r, write_push, layer, error);
}

static bool write_house_row(void *layer, const sunder_row *row, GIntBig least_fid, const double *xy, gis_error *error)
{
    return gis_go_on(error) && gis_house_row(layer, row, least_fid, xy, error);
}

static bool write_rows(const gis_result *r, gis_sink *sink, gis_error *error)
{
    gis_sink_layer *layer;
    return gis_house_rows_begin(sink, gis_source_crs(r->input->source), &layer, error) &&
           r->kind->rows(r, write_house_row, layer, error);
}

static bool write_hidden_row(void *layer, const gis_hidden_row *row, const gis_things *things, OGRGeometryH geometry,
                             gis_error *error)
{
    return gis_hidden_put(layer, row, things, geometry, error);
}

static bool write_hidden(const gis_result *r, gis_sink *sink, gis_error *error)
{
    gis_sink_layer *layer;
    return gis_hidden_begin(sink, r->input, r->kind->id_type(r), &layer, error) &&
           r->kind->hidden(r, write_hidden_row, layer, error);
}

bool gis_result_write(const gis_result *result, const gis_result_layers *layers, gis_sink *sink, gis_error *error)
{
    return write_main(result, layers, sink, error) &&
           (!layers->displacement || write_displacement(result, sink, error)) &&
           (!layers->conflicts || write_conflicts(result, sink, error)) &&
           (!layers->pushes || write_pushes(result, sink, error)) &&
           (!layers->rows || write_rows(result, sink, error)) &&
           (!layers->symbols || result->kind->symbols(result, sink, error)) &&
           (!layers->hidden || write_hidden(result, sink, error));
}
