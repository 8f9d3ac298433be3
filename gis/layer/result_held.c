/* result_held.c: see result.h. The result of a layer in memory, taken from the core's report. */
#include "layer/result_held.h"

#include "base/core_error.h"
#include "layer/levels.h"
#include "layer/output.h"
#include "layer/proof.h"

#include <stdlib.h>

static gis_value block_value(const gis_result *r, bool has_null, size_t feature)
{
    const bool unique = !r->input->parts && gis_source_fids_unique(r->input->source);
    int64_t first = sunder_report_block(r->of, feature);
    if (first < 0 && !has_null) first = (int64_t)feature;
    return gis_block_as_value(unique, first, first < 0 ? OGRNullFID : gis_layer_fid(r->input, (size_t)first));
}

static OGRGeometryH geometry_of(const gis_layer_input *input, size_t i)
{
    const gis_layer_input *own = gis_layer_own(input, &i);
    return gis_source_geometry(own->source, i);
}

/* Fills in the shape that the feature has instead of its own, if it does. */
static void fill_level(const gis_result *r, size_t i, gis_feature_row *row)
{
    const gis_layer_input *input = r->input;
    const sunder_shape *larger = input->given && input->given[i] ? input->shape[i] : NULL;
    const size_t level = sunder_report_level(r->of, i);
    if ((!level && !larger) || row->status == SUNDER_FEATURE_HIDDEN) return;
    row->multi = wkbFlatten(OGR_G_GetGeometryType(geometry_of(input, i))) == wkbMultiPolygon;
    row->other = larger;
    row->lost = larger ? 1 - sunder_shape_area(larger) / sunder_shape_area(input->given[i]) : 0;
    if (!level) return;
    const size_t rung = gis_levels_rung(&input->levels, i, level);
    row->rung = rung + 1;
    row->other = gis_levels_shape(&input->levels, i, rung);
    row->lost = 1 - sunder_shape_area(row->other) / sunder_shape_area(input->shape[i]);
}

static bool fill_size(const gis_result *r, size_t i, gis_feature_row *row, gis_error *error)
{
    const sunder_shape *shape = row->other ? row->other : gis_layer_original(r->input, i);
    double centre[2], radius;
    sunder_error why;
    if (sunder_shape_largest_disc(shape, centre, &radius, &why) != SUNDER_OK)
        return gis_core_failed(error, "sunder_siz", &why);
    row->size = 2 * radius;
    return true;
}

static bool visit_features(const gis_result *r, bool has_null, gis_feature_visit *visit, void *user, gis_error *error)
{
    for (size_t i = 0; visit && i < r->input->n; i++) {
        gis_feature_row row = {.status = sunder_report_status(r->of, i), .block = block_value(r, has_null, i)};
        sunder_report_move(r->of, i, &row.dx, &row.dy);
        fill_level(r, i, &row);
        if (gis_levels_asked(&r->input->request->rules) && !fill_size(r, i, &row, error)) return false;
        if (!visit(user, i, &row, error)) return false;
    }
    return true;
}

static bool visit_arrow(const gis_result *r, bool has_null, size_t i, const double move[2], gis_arrow_visit *visit,
                        void *user, gis_error *error)
{
    gis_arrow_row row = {
        .fid = gis_fid_value(r->input, i), .block = block_value(r, has_null, i), .move = {move[0], move[1]}};
    const gis_things things = gis_things_of(r->input);
    row.layer = gis_things_layer(&things, i);
    gis_conflict_texts scratch = {0};
    const bool done = gis_arrow_start(r->input, i, row.from, error) &&
                      gis_id_value(r->input, i, &scratch.id[0], &row.id, error) && visit(user, &row, error);
    gis_conflict_texts_clear(&scratch);
    return done;
}

static bool visit_arrows(const gis_result *r, bool has_null, gis_arrow_visit *visit, void *user, gis_error *error)
{
    for (size_t i = 0; i < r->input->n; i++) {
        double move[2];
        sunder_report_move(r->of, i, &move[0], &move[1]);
        if ((move[0] != 0 || move[1] != 0) && !visit_arrow(r, has_null, i, move, visit, user, error)) return false;
    }
    return true;
}

static bool visit_conflicts(const gis_result *r, gis_conflict_visit *visit, void *user, gis_error *error)
{
    const gis_things things = gis_things_of(r->input);
    size_t n;
    const sunder_conflict *conflict = sunder_report_conflicts(r->of, &n);
    for (size_t k = 0; k < n; k++)
        if (!visit(user, &conflict[k], &things, error)) return false;
    return true;
}

static void anchor_now(const gis_result *r, size_t feature, double at[2])
{
    double dx, dy;
    sunder_shape_anchor(r->input->shape[feature], at);
    sunder_report_move(r->of, feature, &dx, &dy);
    at[0] += dx;
    at[1] += dy;
}

static bool visit_pushes(const gis_result *r, gis_push_visit *visit, void *user, gis_error *error)
{
    const gis_things things = gis_things_of(r->input);
    size_t n;
    const sunder_push *push = sunder_report_pushes(r->of, &n);
    for (size_t k = 0; k < n; k++) {
        double from[2], to[2];
        anchor_now(r, push[k].a, from);
        if (gis_things_is_barrier(&things, push[k].b))
            gis_barrier_corner(&r->input->barriers.barrier[push[k].b - r->input->n].geometry, from, to);
        else
            anchor_now(r, push[k].b, to);
        if (!visit(user, &push[k], &things, from, to, error)) return false;
    }
    return true;
}

/* Visits one row; xy has room for the anchors of its features. */
static bool visit_row(const gis_result *r, const sunder_row *row, double *xy, gis_house_row_visit *visit, void *user,
                      gis_error *error)
{
    GIntBig least = OGRNullFID;
    for (size_t k = 0; k < row->features; k++) {
        const GIntBig fid =
            r->input->parts ? (GIntBig)row->feature[k] : gis_source_fid(r->input->source, row->feature[k]);
        if (k == 0 || fid < least) least = fid;
        anchor_now(r, row->feature[k], xy + 2 * k);
    }
    return visit(user, row, least, xy, error);
}

static bool visit_rows(const gis_result *r, gis_house_row_visit *visit, void *user, gis_error *error)
{
    size_t n, longest = 0;
    const sunder_row *row = sunder_report_rows(r->of, &n);
    for (size_t k = 0; k < n; k++) longest = row[k].features > longest ? row[k].features : longest;
    double *xy = malloc((2 * longest + 1) * sizeof *xy);
    bool done = xy || gis_no_memory(error);
    for (size_t k = 0; k < n && done; k++) done = visit_row(r, &row[k], xy, visit, user, error);
    free(xy);
    return done;
}

static bool write_symbols(const gis_result *r, gis_sink *sink, gis_error *error)
{
    return gis_write_symbols(sink, r->input, r->of, error);
}

static bool visit_hidden(const gis_result *r, gis_hidden_visit *visit, void *user, gis_error *error)
{
    const gis_things things = gis_things_of(r->input);
    gis_hidden_row *list;
    size_t n;
    bool ok = gis_hidden_list(r->input, r->of, &list, &n, error);
    for (size_t k = 0; k < n && ok; k++)
        ok = visit(user, &list[k], &things, geometry_of(r->input, list[k].feature), error);
    free(list);
    return ok;
}

/* Counts the features on the rungs of each kind. */
static void count_rungs(const gis_result *r, size_t count[GIS_RUNGS])
{
    const gis_levels *levels = &r->input->levels;
    for (size_t i = 0; levels->rungs && i < r->input->n; i++) {
        const size_t level = sunder_report_level(r->of, i);
        if (level && sunder_report_status(r->of, i) != SUNDER_FEATURE_HIDDEN)
            count[levels->kind[gis_levels_rung(levels, i, level)]]++;
    }
}

static void sum_hiding(const gis_result *r, gis_hiding *hiding)
{
    *hiding = (gis_hiding){.enlarged = r->input->enlarged};
    count_rungs(r, hiding->on_rung);
    sunder_report_hiding(r->of, &hiding->sum);
    hiding->class = sunder_report_hiding_classes(r->of, &hiding->classes);
}

static bool write_proof(const gis_result *r, const sunder_layer_summary *summary, FILE *to, gis_error *error)
{
    (void)summary; /* the report contains one */
    return gis_proof_write(r->input, r->of, to, error);
}

static GIntBig longest_fid(const gis_result *r, size_t feature) { return gis_layer_fid(r->input, feature); }

static OGRFieldType id_type(const gis_result *r) { return gis_id_type(r->input); }

gis_result gis_result_held(const gis_layer_input *input, sunder_report *report)
{
    static const gis_result_kind kind = {visit_features, visit_arrows,         visit_conflicts, visit_pushes,
                                         visit_rows,     write_symbols,        visit_hidden,    sum_hiding,
                                         write_proof,    gis_result_held_view, longest_fid,     id_type};
    return (gis_result){&kind, input, report};
}
