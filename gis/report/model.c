/* model.c: see model.h.
 *
 * Worst first: overlaps before pairs that are merely too near, for they are what a map may not show; the deeper, and
 * the more of the gap is missing, the worse. What may overlap (kept) comes last. Ties are ended by the features'
 * numbers, so that the order is one. */
#include "report/model.h"

#include "base/interrupt.h"
#include "layer/output.h"

#include <cpl_conv.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Boxes ------------------------------------------------------------------------------------------------------- */

void gis_box_clear(double box[4])
{
    box[0] = box[1] = INFINITY;
    box[2] = box[3] = -INFINITY;
}

void gis_box_add(double box[4], const double other[4])
{
    for (int k = 0; k < 2; k++) {
        box[k] = fmin(box[k], other[k]);
        box[k + 2] = fmax(box[k + 2], other[k + 2]);
    }
}

bool gis_box_meets(const double a[4], const double b[4])
{
    return a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3];
}

void gis_page_box(const gis_page_feature *feature, double part, double box[4])
{
    for (int k = 0; k < 4; k++) box[k] = feature->box[k] + part * feature->move[k % 2];
}

/* ---- Features ---------------------------------------------------------------------------------------------------- */

static void take_feature(gis_page_model *model, size_t i)
{
    const gis_page_request *request = model->request;
    gis_page_feature *feature = &model->feature[i];
    const sunder_shape *shape = request->input->shape[i];
    sunder_report_move(request->report, i, &feature->move[0], &feature->move[1]);
    feature->length = hypot(feature->move[0], feature->move[1]);
    feature->status = sunder_report_status(request->report, i);
    if (!shape || sunder_shape_is_empty(shape)) return;
    feature->shape = shape;
    sunder_shape_box(shape, feature->box);
    double after[4];
    gis_page_box(feature, 1, after);
    gis_box_add(model->extent, feature->box);
    gis_box_add(model->extent, after);
}

static bool take_features(gis_page_model *model, gis_error *error)
{
    model->feature = calloc(model->n + 1, sizeof *model->feature);
    if (!model->feature) return gis_no_memory(error);
    gis_box_clear(model->extent);
    for (size_t i = 0; i < model->n; i++) {
        if (!gis_go_on(error)) return false;
        take_feature(model, i);
    }
    model->empty = !(model->extent[0] <= model->extent[2]);
    if (model->empty) memset(model->extent, 0, sizeof model->extent);
    return true;
}

/* ---- Barriers ---------------------------------------------------------------------------------------------------- */

static void barrier_box(const sunder_barrier *barrier, double box[4])
{
    const sunder_obstacle *geometry = &barrier->geometry;
    size_t n = geometry->lines ? geometry->line_end[geometry->lines - 1] : 0;
    gis_box_clear(box);
    for (size_t i = 0; i < n; i++) {
        const double *at = geometry->xy + 2 * i, point[4] = {at[0], at[1], at[0], at[1]};
        gis_box_add(box, point);
    }
    if (geometry->shape && !sunder_shape_is_empty(geometry->shape)) {
        double of_shape[4];
        sunder_shape_box(geometry->shape, of_shape);
        gis_box_add(box, of_shape);
    }
    for (int k = 0; k < 4; k++) box[k] += (k < 2 ? -0.5 : 0.5) * barrier->width;
}

/* Of a network that goes on beyond the layer only what lies about the layer is of interest. */
static bool take_barriers(gis_page_model *model, gis_error *error)
{
    static const double beyond = 0.1;
    const gis_barriers *barriers = &model->request->input->barriers;
    double seen[4];
    model->barrier = malloc((barriers->n + 1) * sizeof *model->barrier);
    if (!model->barrier) return gis_no_memory(error);
    double rim = beyond * fmax(model->extent[2] - model->extent[0], model->extent[3] - model->extent[1]);
    for (int k = 0; k < 4; k++) seen[k] = model->extent[k] + (k < 2 ? -rim : rim);
    for (size_t k = 0; k < barriers->n; k++) {
        gis_page_barrier each = {.given = &barriers->barrier[k]};
        barrier_box(each.given, each.box);
        if (!model->empty && gis_box_meets(each.box, seen)) model->barrier[model->n_barriers++] = each;
    }
    return true;
}

/* ---- Orders ------------------------------------------------------------------------------------------------------ */

static int descending(double a, double b) { return (a < b) - (a > b); }

static int worse_first(const void *left, const void *right)
{
    const sunder_conflict *a = *(const sunder_conflict *const *)left, *b = *(const sunder_conflict *const *)right;
    int order = (a->reason == SUNDER_REASON_KEPT) - (b->reason == SUNDER_REASON_KEPT);
    if (!order) order = descending(a->depth, b->depth);
    if (!order) order = descending(a->required - a->distance, b->required - b->distance);
    if (!order) order = (a->a > b->a) - (a->a < b->a);
    return order ? order : (a->b > b->b) - (a->b < b->b);
}

/* Barriers, which follow the features, have no part in that. */
static void involve(gis_page_model *model, size_t thing)
{
    if (thing < model->n) model->feature[thing].involved = true;
}

static bool take_conflicts(gis_page_model *model, gis_error *error)
{
    size_t n;
    const sunder_conflict *conflicts = sunder_report_conflicts(model->request->report, &n);
    model->conflict = malloc((n + 1) * sizeof *model->conflict);
    if (!model->conflict) return gis_no_memory(error);
    for (size_t k = 0; k < n; k++) {
        const sunder_conflict *each = &conflicts[k];
        if (each->inside_block) continue;
        model->conflict[model->n_conflicts++] = each;
        involve(model, each->a);
        involve(model, each->b);
        for (size_t i = 0; i < each->n_blocked_by; i++) involve(model, each->blocked_by[i]);
    }
    qsort(model->conflict, model->n_conflicts, sizeof *model->conflict, worse_first);
    return true;
}

typedef struct move_order {
    double length;
    size_t feature;
} move_order;

static int longer_first(const void *left, const void *right)
{
    const move_order *a = left, *b = right;
    int order = descending(a->length, b->length);
    return order ? order : (a->feature > b->feature) - (a->feature < b->feature);
}

static bool take_moves(gis_page_model *model, gis_error *error)
{
    move_order *order = malloc((model->n + 1) * sizeof *order);
    model->moved = malloc((model->n + 1) * sizeof *model->moved);
    if (!order || !model->moved) {
        free(order);
        return gis_no_memory(error);
    }
    for (size_t i = 0; i < model->n; i++)
        if (model->feature[i].length > 0) order[model->n_moved++] = (move_order){model->feature[i].length, i};
    qsort(order, model->n_moved, sizeof *order, longer_first);
    for (size_t k = 0; k < model->n_moved; k++) model->moved[k] = order[k].feature;
    free(order);
    return true;
}

/* ---- Places ------------------------------------------------------------------------------------------------------ */

/* Of pictures of a place: width to height; how much of the surroundings is seen about what matters; and how many places
 * conflicts may take, so that the longest moves are seen, too. */
static const double aspect = 4.0 / 3.0, margin = 0.45;
enum { CONFLICT_PLACES = 8 };

static void frame(const double box[4], double window[4])
{
    double width = box[2] - box[0], height = box[3] - box[1], x = box[0] / 2 + box[2] / 2, y = box[1] / 2 + box[3] / 2;
    double half = fmax(width, height * aspect) / 2 * (1 + 2 * margin);
    if (!(half > 0)) half = 1;
    window[0] = x - half;
    window[1] = y - half / aspect;
    window[2] = x + half;
    window[3] = y + half / aspect;
}

/* What matters of a feature, around a point at which it matters: not all of a feature that is large beside `reach`. */
static void add_near(double box[4], const gis_page_feature *feature, const double about[4], double reach)
{
    double wide[4] = {about[0] - reach, about[1] - reach, about[2] + reach, about[3] + reach}, there[4];
    for (int after = 0; after < 2; after++) {
        gis_page_box(feature, after, there);
        if (!feature->shape || !gis_box_meets(there, wide)) continue;
        for (int k = 0; k < 2; k++) {
            there[k] = fmax(there[k], wide[k]);
            there[k + 2] = fmin(there[k + 2], wide[k + 2]);
        }
        gis_box_add(box, there);
    }
}

static double size_of(const double box[4]) { return fmax(box[2] - box[0], box[3] - box[1]); }

static void conflict_window(const gis_page_model *model, const sunder_conflict *conflict, double window[4])
{
    const gis_page_feature *a = &model->feature[conflict->a];
    const gis_page_feature *b = conflict->b < model->n ? &model->feature[conflict->b] : a;
    double box[4] = {fmin(conflict->from[0], conflict->to[0]), fmin(conflict->from[1], conflict->to[1]),
                     fmax(conflict->from[0], conflict->to[0]), fmax(conflict->from[1], conflict->to[1])};
    double about[4];
    memcpy(about, box, sizeof about);
    double reach = fmax(fmin(size_of(a->box), size_of(b->box)), 2 * fmax(conflict->required, conflict->depth));
    add_near(box, a, about, reach);
    add_near(box, b, about, reach);
    frame(box, window);
}

static void move_window(const gis_page_feature *feature, double window[4])
{
    double box[4];
    gis_page_box(feature, 1, box);
    gis_box_add(box, feature->box);
    frame(box, window);
}

/* The place in whose window the middle of another lies; NULL: in none. */
static gis_page_place *shown_in(gis_page_place *first, gis_page_place *end, const double window[4])
{
    double x = window[0] / 2 + window[2] / 2, y = window[1] / 2 + window[3] / 2;
    const double middle[4] = {x, y, x, y};
    while (first < end && !gis_box_meets(first->window, middle)) first++;
    return first < end ? first : NULL;
}

/* Adds a place, unless it is shown already, among those from `first` on, or there is no room left before `limit`. */
static void add_place(gis_page_model *model, size_t first, size_t limit, const gis_page_place *place)
{
    gis_page_place *shown = shown_in(model->place + first, model->place + model->n_places, place->window);
    if (shown)
        shown->others++;
    else if (model->n_places < limit)
        model->place[model->n_places++] = *place;
}

static void choose_places(gis_page_model *model)
{
    size_t limit = model->n_moved ? CONFLICT_PLACES : GIS_PAGE_PLACES;
    for (size_t k = 0; k < model->n_conflicts; k++) {
        gis_page_place place = {.conflict = model->conflict[k], .feature = model->conflict[k]->a};
        conflict_window(model, place.conflict, place.window);
        add_place(model, 0, limit, &place);
    }
    size_t first = model->n_places;
    for (size_t k = 0; k < model->n_moved && model->n_places < GIS_PAGE_PLACES; k++) {
        gis_page_place place = {.feature = model->moved[k]};
        move_window(&model->feature[place.feature], place.window);
        if (!shown_in(model->place, model->place + first, place.window))
            add_place(model, first, GIS_PAGE_PLACES, &place);
    }
}

bool gis_page_model_make(const gis_page_request *request, gis_page_model *model, gis_error *error)
{
    *model = (gis_page_model){.request = request, .n = request->input->n, .unit = gis_report_unit_of(request->unit)};
    if (!take_features(model, error) || !take_barriers(model, error) || !take_conflicts(model, error) ||
        !take_moves(model, error))
        return false;
    choose_places(model);
    return true;
}

void gis_page_model_clear(gis_page_model *model)
{
    free(model->feature);
    free(model->barrier);
    free(model->conflict);
    free(model->moved);
    *model = (gis_page_model){0};
}

void gis_page_name(const gis_page_model *model, size_t thing, gis_text *to)
{
    const gis_layer_input *input = model->request->input;
    if (thing >= model->n) {
        const gis_barrier_feature *barrier = &input->barriers.feature[thing - model->n];
        gis_text_print(to, "%s:" CPL_FRMT_GIB, input->barriers.layer[barrier->request], barrier->fid);
        return;
    }
    GIntBig fid = gis_source_fid(input->source, thing);
    OGRFeatureH feature = gis_source_feature(input->source, thing);
    if (input->id_field >= 0 && OGR_F_IsFieldSetAndNotNull(feature, input->id_field))
        gis_text_print(to, "%s (", OGR_F_GetFieldAsString(feature, input->id_field));
    if (fid == OGRNullFID)
        gis_text_print(to, "feature %zu", thing + 1);
    else
        gis_text_print(to, "FID " CPL_FRMT_GIB, fid);
    if (input->id_field >= 0 && OGR_F_IsFieldSetAndNotNull(feature, input->id_field)) gis_text_add(to, ")");
}
