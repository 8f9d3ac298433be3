/* run_view.c: see layer/result_view.h. Shapes and names of a layer that was separated in parts are read from the spool
 * one by one; results of features are read from the sorted lists on disk. */
#include "base/array.h"
#include "base/text.h"
#include "disk/file.h"
#include "shards/run/shard_run.h"

#include <stdlib.h>
#include <string.h>

enum { STATUS_BUFFER = 1 << 16 };

/* The place of the row of a feature that has a smaller shape in the result, or is hidden. */
typedef struct changed_row {
    size_t feature;
    uint64_t place;
} changed_row;

typedef struct spool_view {
    gis_shard_run *parts;
    gis_spool *aside; /* the spool of features that conflict with nothing; NULL: there is none */
    sunder_conflict *conflict;
    size_t conflicts, conflict_room;
    size_t *blocker; /* the blockers of all conflicts, concatenated */
    size_t blockers, blocker_room;
    size_t *thing; /* the things of all hidden features, concatenated */
    size_t things, thing_room;
    changed_row *changed; /* by feature */
    size_t changes, change_room;
    uint64_t *barrier_place; /* [barriers] */
    bool lends_given;        /* the shape before the feature became larger is requested */
    sunder_shape *lent, *lent_barrier;
    sunder_obstacle lines; /* of the barrier that was lent last */
    gis_text text;         /* the name that was requested last */
    int64_t fid;
    bool named;
} spool_view;

/* ---- Places ------------------------------------------------------------------------------------------------------ */

/* Combines a feature's place in its spool with a lowest bit that tells which of the two spools it is in. */
static uint64_t place_of(uint64_t place, bool aside) { return place << 1 | aside; }

static gis_spool *spool_of(const spool_view *s, uint64_t place) { return place & 1 ? s->aside : s->parts->spool; }

/* ---- All features ------------------------------------------------------------------------------------------------ */

typedef struct filling {
    gis_view_feature *feature;
    gis_view_barrier *barrier;
    uint64_t *barrier_place;
    size_t n;
    bool aside;
} filling;

static bool is_numbered(const filling *f, const gis_spool_feature *feature, gis_error *error)
{
    return feature->index < f->n || gis_fail(error, "a spool has more features than its layer");
}

static bool take_feature(void *user, const gis_spool_feature *feature, gis_error *error)
{
    filling *f = user;
    const sunder_shape *shape = feature->demands.shape;
    const bool done = is_numbered(f, feature, error);
    if (done) {
        gis_view_feature *to = &f->feature[feature->index];
        to->place = place_of(feature->place, f->aside);
        to->vertices = (uint32_t)sunder_shape_vertices(shape);
        to->changed = feature->given.polygons > 0;
        if (to->vertices) sunder_shape_box(shape, to->box);
    }
    sunder_shape_free((sunder_shape *)shape);
    return done;
}

static bool visit_all(gis_spool *spool, gis_spool_visit *visit, filling *f, gis_error *error)
{
    bool done = true;
    for (size_t k = 0; k < gis_spool_cells(spool) && done; k++) done = gis_spool_read(spool, k, visit, f, error);
    return done;
}

/* Reads the status that each feature would have alone. */
static bool take_statuses(const spool_view *s, gis_view_feature *feature, size_t n, gis_error *error)
{
    unsigned char buffer[STATUS_BUFFER];
    gis_disk_file file = {0};
    const size_t bytes = gis_layer_status_bytes(&s->parts->request->rules), at_once = sizeof buffer / bytes;
    bool done = gis_disk_file_open(&file, s->parts->directory, "status", error);
    for (size_t k = 0; k < n && done; k += at_once) {
        const size_t more = n - k < at_once ? n - k : at_once;
        done = gis_disk_file_read(&file, k * bytes, buffer, more * bytes, error);
        for (size_t i = 0; i < more && done; i++) feature[k + i].status = buffer[i * bytes];
    }
    gis_disk_file_close(&file);
    return done;
}

/* Notes that the feature of the current row has a smaller shape, or is hidden and has that which was read. */
static bool note_change(spool_view *s, gis_view_feature *feature, gis_error *error)
{
    const gis_sorted_results *rows = &s->parts->joined.rows;
    feature->changed = feature->status != SUNDER_FEATURE_HIDDEN;
    if (!gis_array_reserve(&s->changed, &s->change_room, s->changes + 1, sizeof *s->changed))
        return gis_no_memory(error);
    s->changed[s->changes++] = (changed_row){(size_t)rows->head.first, gis_sorted_results_place(rows)};
    return true;
}

/* Sets moves and status of the features that differ from features alone, and lists those with another shape. */
static bool take_rows(spool_view *s, gis_view_feature *feature, gis_error *error)
{
    gis_joined *joined = &s->parts->joined;
    gis_sorted_results *rows = &joined->rows;
    bool any = true;
    gis_sorted_results_rewind(rows);
    while (gis_sorted_results_next(rows, &any, error) && any) {
        gis_view_feature *to = &feature[rows->head.first];
        if (!gis_go_on(error)) return false;
        if (rows->one.rows) {
            memcpy(to->move, rows->one.row->move, sizeof to->move);
            to->status = (uint8_t)rows->one.row->status;
            if ((rows->one.row->now.polygons || to->status == SUNDER_FEATURE_HIDDEN) && !note_change(s, to, error))
                return false;
        } else {
            to->status = (uint8_t)gis_joined_status(joined, rows->one.still);
        }
    }
    return !any;
}

static bool fill_features(void *of, gis_view_feature *feature, gis_error *error)
{
    spool_view *s = of;
    filling f = {.feature = feature, .n = s->parts->facts.source.features};
    if (!visit_all(s->parts->spool, take_feature, &f, error)) return false;
    f.aside = true;
    return (!s->aside || visit_all(s->aside, take_feature, &f, error)) && take_statuses(s, feature, f.n, error) &&
           take_rows(s, feature, error);
}

/* ---- All barriers ------------------------------------------------------------------------------------------------ */

/* A barrier's geometry; its shape is NULL if it has no polygons. */
static sunder_obstacle geometry_of(const gis_spool_feature *barrier)
{
    sunder_obstacle out = barrier->lines;
    out.shape = sunder_shape_is_empty(barrier->demands.shape) ? NULL : barrier->demands.shape;
    return out;
}

static bool take_barrier(void *user, const gis_spool_feature *barrier, gis_error *error)
{
    filling *f = user;
    const bool done = is_numbered(f, barrier, error);
    if (done) {
        const sunder_obstacle geometry = geometry_of(barrier);
        f->barrier[barrier->index] = gis_view_barrier_of(&geometry, barrier->demands.weight);
        f->barrier[barrier->index].place = f->barrier_place[barrier->index] = barrier->place;
    }
    sunder_shape_free((sunder_shape *)barrier->demands.shape);
    return done;
}

static bool fill_barriers(void *of, gis_view_barrier *barrier, gis_error *error)
{
    spool_view *s = of;
    gis_spool *all = s->parts->barriers.all;
    if (!all) return true;
    filling f = {.barrier = barrier, .barrier_place = s->barrier_place, .n = gis_spool_features(all)};
    return visit_all(all, take_barrier, &f, error);
}

/* ---- Conflicts --------------------------------------------------------------------------------------------------- */

static bool keep_conflict(spool_view *s, const gis_part_result *one, gis_error *error)
{
    const sunder_conflict *conflict = &one->conflict->is;
    const size_t n = conflict->n_blocked_by;
    if (!gis_array_reserve(&s->conflict, &s->conflict_room, s->conflicts + 1, sizeof *s->conflict) ||
        !gis_array_reserve(&s->blocker, &s->blocker_room, s->blockers + n, sizeof *s->blocker))
        return gis_no_memory(error);
    s->conflict[s->conflicts++] = *conflict;
    if (n) memcpy(s->blocker + s->blockers, one->blocker, n * sizeof *s->blocker);
    s->blockers += n;
    return true;
}

/* Adds a hidden feature to the list; where its things are is known when all are listed. */
static bool keep_hidden(spool_view *s, const gis_part_result *one, gis_hidden_row **list, size_t *room, size_t *n,
                        gis_error *error)
{
    const gis_part_hidden *h = one->hidden;
    if (!gis_array_reserve(list, room, *n + 1, sizeof **list) ||
        !gis_array_reserve(&s->thing, &s->thing_room, s->things + h->things, sizeof *s->thing))
        return gis_no_memory(error);
    (*list)[(*n)++] = (gis_hidden_row){h->index, h->cost, NULL, h->things, h->proved, h->forced};
    if (h->things) memcpy(s->thing + s->things, one->blocker, h->things * sizeof *s->thing);
    s->things += h->things;
    return true;
}

static bool list_hidden(void *of, gis_hidden_row **hidden, size_t *n, gis_error *error)
{
    spool_view *s = of;
    gis_sorted_results *sorted = &s->parts->joined.hidden;
    size_t room = 0;
    bool any = true;
    *hidden = NULL;
    *n = s->things = 0;
    gis_sorted_results_rewind(sorted);
    while (gis_sorted_results_next(sorted, &any, error) && any)
        if (!gis_go_on(error) || !keep_hidden(s, &sorted->one, hidden, &room, n, error)) return false;
    for (size_t k = 0, at = 0; k < *n; at += (*hidden)[k++].things) (*hidden)[k].thing = s->thing + at;
    return !any;
}

static bool list_conflicts(void *of, const sunder_conflict **conflict, size_t *n, gis_error *error)
{
    spool_view *s = of;
    gis_sorted_results *sorted = &s->parts->joined.conflicts;
    bool any = true;
    s->conflicts = s->blockers = 0;
    gis_sorted_results_rewind(sorted);
    while (gis_sorted_results_next(sorted, &any, error) && any)
        if (!gis_go_on(error) || !keep_conflict(s, &sorted->one, error)) return false;
    for (size_t k = 0, at = 0; k < s->conflicts; at += s->conflict[k++].n_blocked_by)
        s->conflict[k].blocked_by = s->blocker + at;
    *conflict = s->conflict;
    *n = s->conflicts;
    return !any;
}

static bool list_rows(void *of, const sunder_row **row, size_t *n, gis_error *error)
{
    const sunder_row_list *list = &((const spool_view *)of)->parts->joined.row_list;
    (void)error;
    *row = list->row;
    *n = list->rows;
    return true;
}

/* ---- One by one -------------------------------------------------------------------------------------------------- */

static bool lend_shape(void *user, const gis_spool_feature *feature, gis_error *error)
{
    spool_view *s = user;
    sunder_shape_free(s->lent);
    s->lent = (sunder_shape *)feature->demands.shape;
    if (!s->lends_given || feature->given.polygons == 0) return true;
    sunder_shape_free(s->lent);
    s->lent = NULL;
    return gis_spool_rings_shape(&feature->given, &s->lent, error);
}

static int by_feature(const void *a, const void *b)
{
    const changed_row *p = a, *q = b;
    return (p->feature > q->feature) - (p->feature < q->feature);
}

/* Lends the smaller shape of the feature, if it has one; else *lent becomes false. A hidden feature has the shape that
 * was read. */
static bool lend_other_shape(spool_view *s, size_t feature, bool *lent, gis_error *error)
{
    gis_sorted_results *rows = &s->parts->joined.rows;
    const changed_row key = {feature, 0};
    const changed_row *row = s->changes ? bsearch(&key, s->changed, s->changes, sizeof key, by_feature) : NULL;
    if (!row) return true;
    if (!gis_sorted_results_read_at(rows, row->place, error)) return false;
    s->lends_given = rows->one.row->now.polygons == 0;
    if (s->lends_given) return true;
    *lent = true;
    sunder_shape_free(s->lent);
    s->lent = NULL;
    return gis_part_make_shape(&rows->one, &rows->one.row->now, &s->lent, error);
}

static bool lend_feature_shape(void *of, size_t feature, uint64_t place, gis_view_shape which, const sunder_shape **out,
                               gis_error *error)
{
    spool_view *s = of;
    bool lent = false;
    s->lends_given = which == GIS_VIEW_READ;
    if (which == GIS_VIEW_NOW && !lend_other_shape(s, feature, &lent, error)) return false;
    if (!lent && !gis_spool_read_one(spool_of(s, place), place >> 1, lend_shape, s, error)) return false;
    *out = s->lent;
    return true;
}

static bool lend_geometry(void *user, const gis_spool_feature *barrier, gis_error *error)
{
    spool_view *s = user;
    (void)error;
    sunder_shape_free(s->lent_barrier);
    s->lent_barrier = (sunder_shape *)barrier->demands.shape;
    s->lines = geometry_of(barrier);
    return true;
}

static bool lend_barrier_geometry(void *of, uint64_t place, sunder_obstacle *out, gis_error *error)
{
    spool_view *s = of;
    if (!gis_spool_read_one(s->parts->barriers.all, place, lend_geometry, s, error)) return false;
    *out = s->lines;
    return true;
}

static bool take_name(void *user, const gis_spool_feature *feature, gis_error *error)
{
    spool_view *s = user;
    (void)error;
    s->fid = feature->fid;
    s->named = feature->id != NULL;
    s->text.length = 0;
    gis_text_add(&s->text, feature->id ? feature->id : "");
    sunder_shape_free((sunder_shape *)feature->demands.shape);
    return true;
}

static bool ask_name(spool_view *s, gis_spool *spool, uint64_t place, GIntBig *fid, const char **text, gis_error *error)
{
    if (!gis_spool_read_one(spool, place, take_name, s, error)) return false;
    *fid = s->fid;
    *text = s->named ? gis_text_get(&s->text) : NULL;
    return !s->text.failed || gis_no_memory(error);
}

static bool feature_name(void *of, size_t feature, uint64_t place, GIntBig *fid, const char **id, gis_error *error)
{
    spool_view *s = of;
    (void)feature;
    return ask_name(s, spool_of(s, place), place >> 1, fid, id, error);
}

static bool barrier_name(void *of, size_t barrier, GIntBig *fid, const char **layer, gis_error *error)
{
    spool_view *s = of;
    return ask_name(s, s->parts->barriers.all, s->barrier_place[barrier], fid, layer, error);
}

/* ---- From beginning to end --------------------------------------------------------------------------------------- */

static bool open_aside(spool_view *s, gis_error *error)
{
    if (s->parts->facts.aside == 0) return true;
    char *path = gis_disk_path(s->parts->directory, GIS_SPOOL_ASIDE);
    const bool done = (path || gis_no_memory(error)) && gis_spool_open(path, &s->aside, error);
    free(path);
    return done;
}

static void close_view(void *of)
{
    spool_view *s = of;
    if (!s) return;
    gis_spool_close(s->aside);
    sunder_shape_free(s->lent);
    sunder_shape_free(s->lent_barrier);
    gis_text_clear(&s->text);
    free(s->conflict);
    free(s->thing);
    free(s->blocker);
    free(s->changed);
    free(s->barrier_place);
    free(s);
}

bool gis_shard_run_view(const gis_result *result, gis_result_view *out, gis_error *error)
{
    gis_shard_run *parts = result->of;
    const size_t barriers = parts->barriers.all ? gis_spool_features(parts->barriers.all) : 0;
    spool_view *s = calloc(1, sizeof *s);
    *out = (gis_result_view){s,
                             parts->facts.source.features,
                             barriers,
                             fill_features,
                             fill_barriers,
                             list_conflicts,
                             list_hidden,
                             list_rows,
                             lend_feature_shape,
                             lend_barrier_geometry,
                             feature_name,
                             barrier_name,
                             close_view};
    if (!s) return gis_no_memory(error);
    s->parts = parts;
    s->barrier_place = calloc(barriers + 1, sizeof *s->barrier_place);
    return (s->barrier_place || gis_no_memory(error)) && open_aside(s, error);
}
