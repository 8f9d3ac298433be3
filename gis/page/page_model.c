/* page_model.c: see page_model.h.
 *
 * Conflicts are sorted by severity: by the depth of the overlap, then by the missing part of the gap, largest first.
 * Pairs that may overlap (SUNDER_REASON_KEPT) come last. Ties are broken by the numbers of the features, so that the
 * order is unique. */
#include "page/page_model.h"

#include <cpl_conv.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Boxes ------------------------------------------------------------------------------------------------------- */

void gis_page_box(const gis_view_feature *feature, double part, double box[4])
{
    for (int k = 0; k < 4; k++) box[k] = feature->box[k] + part * feature->move[k % 2];
}

double gis_page_length(const gis_view_feature *feature) { return hypot(feature->move[0], feature->move[1]); }

/* ---- Features ---------------------------------------------------------------------------------------------------- */

static bool take_features(gis_page_model *model, gis_error *error)
{
    const gis_result_view *view = model->request->view;
    model->feature = calloc(model->n + 1, sizeof *model->feature);
    if (!model->feature) return gis_no_memory(error);
    if (!view->fill(view->of, model->feature, error)) return false;
    gis_box_clear(model->extent);
    for (size_t i = 0; i < model->n; i++) {
        double after[4];
        if (!model->feature[i].vertices) continue;
        gis_page_box(&model->feature[i], 1, after);
        gis_box_join(model->extent, model->feature[i].box);
        gis_box_join(model->extent, after);
        model->changed = model->changed || model->feature[i].changed;
    }
    model->empty = gis_box_is_empty(model->extent);
    if (model->empty) memset(model->extent, 0, sizeof model->extent);
    return true;
}

bool gis_page_shape(const gis_page_model *model, size_t feature, gis_view_shape which, const sunder_shape **shape,
                    gis_error *error)
{
    const gis_result_view *view = model->request->view;
    return view->shape(view->of, feature, model->feature[feature].place, which, shape, error);
}

/* ---- Barriers ---------------------------------------------------------------------------------------------------- */

/* Sorts areas before lines, then by width, so that a picture draws barriers of equal width in one path; ties keep the
 * order of the barriers. */
static int by_width(const void *left, const void *right)
{
    const gis_view_barrier *a = left, *b = right;
    if (a->area != b->area) return a->area ? -1 : 1;
    if (a->width != b->width) return a->width < b->width ? -1 : 1;
    return (a->order > b->order) - (a->order < b->order);
}

/* Takes the barriers that meet the extent of the features, enlarged by a tenth of its larger side. */
static bool take_barriers(gis_page_model *model, gis_error *error)
{
    static const double beyond = 0.1;
    const gis_result_view *view = model->request->view;
    double seen[4];
    model->barrier = malloc((view->barriers + 1) * sizeof *model->barrier);
    if (!model->barrier) return gis_no_memory(error);
    if (!view->fill_barriers(view->of, model->barrier, error)) return false;
    double rim = beyond * fmax(model->extent[2] - model->extent[0], model->extent[3] - model->extent[1]);
    for (int k = 0; k < 4; k++) seen[k] = model->extent[k] + (k < 2 ? -rim : rim);
    for (size_t k = 0; k < view->barriers; k++) {
        model->barrier[k].order = k;
        if (!model->empty && gis_box_meets(model->barrier[k].box, seen))
            model->barrier[model->n_barriers++] = model->barrier[k];
    }
    if (model->n_barriers) qsort(model->barrier, model->n_barriers, sizeof *model->barrier, by_width);
    return true;
}

bool gis_page_geometry(const gis_page_model *model, const gis_view_barrier *barrier, sunder_obstacle *geometry,
                       gis_error *error)
{
    const gis_result_view *view = model->request->view;
    return view->geometry(view->of, barrier->place, geometry, error);
}

/* ---- Sorting ----------------------------------------------------------------------------------------------------- */

static int compare_descending(double a, double b) { return (a < b) - (a > b); }

static int worse_first(const void *left, const void *right)
{
    const sunder_conflict *a = *(const sunder_conflict *const *)left, *b = *(const sunder_conflict *const *)right;
    int order = (a->reason == SUNDER_REASON_KEPT) - (b->reason == SUNDER_REASON_KEPT);
    if (!order) order = compare_descending(a->depth, b->depth);
    if (!order) order = compare_descending(a->required - a->distance, b->required - b->distance);
    if (!order) order = (a->a > b->a) - (a->a < b->a);
    return order ? order : (a->b > b->b) - (a->b < b->b);
}

/* Marks a feature as involved in a conflict; barriers, whose numbers follow those of the features, are not marked. */
static void mark_involved(gis_page_model *model, size_t thing)
{
    if (thing < model->n) model->feature[thing].involved = true;
}

static bool take_conflicts(gis_page_model *model, gis_error *error)
{
    const gis_result_view *view = model->request->view;
    const sunder_conflict *conflicts;
    size_t n;
    if (!view->conflicts(view->of, &conflicts, &n, error)) return false;
    model->conflict = malloc((n + 1) * sizeof *model->conflict);
    if (!model->conflict) return gis_no_memory(error);
    for (size_t k = 0; k < n; k++) {
        const sunder_conflict *each = &conflicts[k];
        if (each->inside_block || each->kind == SUNDER_CONFLICT_TIGHT) continue;
        model->conflict[model->n_conflicts++] = each;
        mark_involved(model, each->a);
        mark_involved(model, each->b);
        for (size_t i = 0; i < each->n_blocked_by; i++) mark_involved(model, each->blocked_by[i]);
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
    int order = compare_descending(a->length, b->length);
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
    for (size_t i = 0; i < model->n; i++) {
        const double length = gis_page_length(&model->feature[i]);
        if (length > 0) order[model->n_moved++] = (move_order){length, i};
    }
    qsort(order, model->n_moved, sizeof *order, longer_first);
    for (size_t k = 0; k < model->n_moved; k++) model->moved[k] = order[k].feature;
    free(order);
    return true;
}

/* ---- Close-ups --------------------------------------------------------------------------------------------------- */

/* aspect: width to height of a close-up; margin: the surroundings on each side, relative to what is shown.
 * CONFLICT_PLACES: the number of close-ups that conflicts may take, so that the longest moves have some, too. */
static const double aspect = 4.0 / 3.0, margin = 0.45;
enum { CONFLICT_PLACES = 8 };

void gis_page_frame(const double box[4], double window[4])
{
    double width = box[2] - box[0], height = box[3] - box[1], x = box[0] / 2 + box[2] / 2, y = box[1] / 2 + box[3] / 2;
    double half = fmax(width, height * aspect) / 2 * (1 + 2 * margin);
    if (!(half > 0)) half = 1;
    window[0] = x - half;
    window[1] = y - half / aspect;
    window[2] = x + half;
    window[3] = y + half / aspect;
}

/* Adds to `box` the part of a feature, before and after its move, that lies within the distance `reach` of the box
 * `about`: a large feature is not shown completely. */
static void add_near(double box[4], const gis_view_feature *feature, const double about[4], double reach)
{
    double wide[4] = {about[0] - reach, about[1] - reach, about[2] + reach, about[3] + reach}, there[4];
    for (int after = 0; after < 2; after++) {
        gis_page_box(feature, after, there);
        if (!feature->vertices || !gis_box_meets(there, wide)) continue;
        for (int k = 0; k < 2; k++) {
            there[k] = fmax(there[k], wide[k]);
            there[k + 2] = fmin(there[k + 2], wide[k + 2]);
        }
        gis_box_join(box, there);
    }
}

static double size_of(const double box[4]) { return fmax(box[2] - box[0], box[3] - box[1]); }

static void conflict_window(const gis_page_model *model, const sunder_conflict *conflict, double window[4])
{
    const gis_view_feature *a = &model->feature[conflict->a];
    const gis_view_feature *b = conflict->b < model->n ? &model->feature[conflict->b] : a;
    double box[4] = {fmin(conflict->from[0], conflict->to[0]), fmin(conflict->from[1], conflict->to[1]),
                     fmax(conflict->from[0], conflict->to[0]), fmax(conflict->from[1], conflict->to[1])};
    double about[4];
    memcpy(about, box, sizeof about);
    double reach = fmax(fmin(size_of(a->box), size_of(b->box)), 2 * fmax(conflict->required, conflict->depth));
    add_near(box, a, about, reach);
    add_near(box, b, about, reach);
    gis_page_frame(box, window);
}

static void move_window(const gis_view_feature *feature, double window[4])
{
    double box[4];
    gis_page_box(feature, 1, box);
    gis_box_join(box, feature->box);
    gis_page_frame(box, window);
}

/* Returns the place in [first, end) whose window contains the centre of `window`; NULL if none does. */
static gis_page_place *shown_in(gis_page_place *first, gis_page_place *end, const double window[4])
{
    double x = window[0] / 2 + window[2] / 2, y = window[1] / 2 + window[3] / 2;
    const double middle[4] = {x, y, x, y};
    while (first < end && !gis_box_meets(first->window, middle)) first++;
    return first < end ? first : NULL;
}

/* Adds a place, unless one of the places from number `first` on shows it already, or there are `limit` places. */
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
    *model =
        (gis_page_model){.request = request, .n = request->view->features, .unit = gis_page_unit_of(request->unit)};
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

bool gis_page_name(const gis_page_model *model, size_t thing, gis_text *to, gis_error *error)
{
    const gis_result_view *view = model->request->view;
    const char *text;
    GIntBig fid;
    if (thing >= model->n) {
        if (!view->barrier_name(view->of, thing - model->n, &fid, &text, error)) return false;
        gis_text_print(to, "%s:" CPL_FRMT_GIB, text, fid);
        return true;
    }
    if (!view->name(view->of, thing, model->feature[thing].place, &fid, &text, error)) return false;
    if (text) gis_text_print(to, "%s (", text);
    if (fid == OGRNullFID)
        gis_text_print(to, "feature %zu", thing + 1);
    else
        gis_text_print(to, "FID " CPL_FRMT_GIB, fid);
    if (text) gis_text_add(to, ")");
    return true;
}
