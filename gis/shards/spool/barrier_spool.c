/* barrier_spool.c: see barrier_spool.h. A barrier is stored as a feature whose members have another meaning: index is
 * its number, weight its width, max_shift its gap, area its full gap, fixed says that it has sides, and id is the name
 * of its layer. */
#include "shards/spool/barrier_spool.h"

#include "base/array.h"
#include "base/core_error.h"
#include "disk/file.h"
#include "geometry/gis_box.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* ---- Copies ------------------------------------------------------------------------------------------------------ */

static void free_barrier(gis_spooled_barrier *barrier)
{
    sunder_shape_free((sunder_shape *)barrier->demands.geometry.shape);
    free((double *)barrier->demands.geometry.xy);
    free((size_t *)barrier->demands.geometry.line_end);
    free((char *)barrier->layer);
}

static void *copy_of(const void *from, size_t bytes)
{
    void *copy = malloc(bytes + 1);
    if (copy && bytes) memcpy(copy, from, bytes);
    return copy;
}

static size_t points_of(const sunder_obstacle *o) { return o->lines ? o->line_end[o->lines - 1] : 0; }

/* Replaces the lines and the name in *to by copies; its shape is not touched. */
static bool own_rest(gis_spooled_barrier *to, gis_error *error)
{
    sunder_obstacle *o = &to->demands.geometry;
    o->xy = o->lines ? copy_of(o->xy, 2 * points_of(o) * sizeof *o->xy) : NULL;
    o->line_end = o->lines ? copy_of(o->line_end, o->lines * sizeof *o->line_end) : NULL;
    to->layer = copy_of(to->layer, strlen(to->layer) + 1);
    return (to->layer && (!o->lines || (o->xy && o->line_end))) || gis_no_memory(error);
}

/* ---- Barriers that every part gets ------------------------------------------------------------------------------- */

/* Properties that some barrier has: any geometry, lines, no distance owed, a greater full distance, the largest full
 * distance. For each property the smallest barrier that has it is given to every part. */
enum { ANY, LINES, BARE, SLACK, MOST, FACTS };

struct gis_barriers_writer {
    char *directory;
    double gap, full_gap, most;
    sunder_gaps gaps; /* by classes; classes 0: there are none */
    gis_spool_writer *all;
    size_t n;
    struct {
        gis_spooled_barrier barrier;
        size_t size;
        bool there;
    } fact[FACTS];
};

/* Half the barrier's width plus a gap, rounded up as in the core. */
static double distance_with(const sunder_barrier *b, double gap)
{
    const double half = b->width / 2, sum = half + gap, back = sum - half;
    return (half - (sum - back)) + (gap - back) > 0 ? nextafter(sum, INFINITY) : sum;
}

/* Sets `gap` to the least gap that features of any class keep from the barrier, and to the greatest full gap. */
static void find_gaps(const gis_barriers_writer *w, const gis_spooled_barrier *barrier, double gap[2])
{
    const sunder_barrier *b = &barrier->demands;
    const size_t n = w->gaps.classes;
    gap[0] = b->gap < 0 ? w->gap : b->gap;
    gap[1] = b->full_gap > 0 ? b->full_gap : b->gap < 0 ? w->full_gap : b->gap;
    for (size_t k = 0; k < n && b->gap < 0; k++) {
        const size_t entry = barrier->gap_class * n + k;
        gap[0] = k ? fmin(gap[0], w->gaps.gap[entry]) : w->gaps.gap[entry];
        gap[1] = k ? fmax(gap[1], w->gaps.full_gap[entry]) : w->gaps.full_gap[entry];
    }
}

/* The least distance that features must keep from the barrier. */
static double distance_owed(const gis_barriers_writer *w, const gis_spooled_barrier *barrier)
{
    double gap[2];
    find_gaps(w, barrier, gap);
    return distance_with(&barrier->demands, gap[0]);
}

/* The greatest distance that features are to keep from the barrier if it pays. */
static double full_distance(const gis_barriers_writer *w, const gis_spooled_barrier *barrier)
{
    double gap[2];
    find_gaps(w, barrier, gap);
    return distance_with(&barrier->demands, gap[1]);
}

static size_t size_of(const sunder_obstacle *o)
{
    return points_of(o) + (o->shape ? sunder_shape_vertices(o->shape) : 0);
}

static bool copy_barrier(const gis_spooled_barrier *from, gis_spooled_barrier *to, gis_error *error)
{
    sunder_shape *shape = NULL;
    sunder_error why;
    const double *xy;
    const size_t *ring_end, *poly_end;
    *to = *from;
    to->demands.geometry.shape = NULL;
    if (!own_rest(to, error)) return false;
    if (!from->demands.geometry.shape) return true;
    const size_t n = sunder_shape_given(from->demands.geometry.shape, &xy, &ring_end, &poly_end);
    const bool repaired = sunder_shape_repaired(from->demands.geometry.shape);
    if (sunder_shape_from_rings(xy, ring_end, poly_end, n, repaired ? SUNDER_VALIDITY_EVEN_ODD : SUNDER_VALIDITY_STRICT,
                                &shape, &why) != SUNDER_OK)
        return gis_core_failed(error, "--barrier", &why);
    to->demands.geometry.shape = shape;
    return true;
}

static bool note_facts(gis_barriers_writer *w, const gis_spooled_barrier *barrier, gis_error *error)
{
    const sunder_obstacle *o = &barrier->demands.geometry;
    const double own = distance_owed(w, barrier), full = full_distance(w, barrier);
    const size_t size = size_of(o);
    const bool more = full > w->most || w->n == 1,
               is[FACTS] = {size > 0, o->lines > 0, own == 0, full > own, full >= w->most || more};
    if (more) w->most = full;
    for (int k = 0; k < FACTS; k++) {
        if (!is[k] || (w->fact[k].there && w->fact[k].size <= size && !(k == MOST && more))) continue;
        free_barrier(&w->fact[k].barrier);
        w->fact[k].there = true;
        w->fact[k].size = size;
        if (!copy_barrier(barrier, &w->fact[k].barrier, error)) return false;
    }
    return true;
}

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

static bool add_barrier(gis_spool_writer *to, const gis_spooled_barrier *b, double reach, gis_error *error)
{
    const gis_spool_feature feature = {
        .index = b->number,
        .fid = b->fid,
        .demands = {.shape = b->demands.geometry.shape,
                    .weight = b->demands.width,
                    .max_shift = b->demands.gap,
                    .block = -1,
                    .fixed = b->demands.side},
        .start = {NAN, NAN},
        .area = b->demands.full_gap,
        .id = b->layer,
        .lines = b->demands.geometry,
        .reach = reach,
        .gap_class = b->gap_class,
    };
    return gis_spool_add(to, &feature, error);
}

/* Makes a directory; an existing one is used as it is. */
static bool make_directory(const char *path, gis_error *error)
{
    return mkdir(path, 0777) == 0 || errno == EEXIST ||
           gis_fail(error, "%s: it cannot be made: %s", path, strerror(errno));
}

bool gis_barriers_create(const char *directory, double gap, double full_gap, const sunder_gaps *gaps,
                         gis_barriers_writer **out, gis_error *error)
{
    gis_barriers_writer *w = calloc(1, sizeof *w);
    if (!w) return gis_no_memory(error);
    w->gap = gap;
    w->full_gap = full_gap;
    w->gaps = *gaps;
    w->directory = gis_disk_path(directory, GIS_BARRIERS);
    const bool done = (w->directory || gis_no_memory(error)) && make_directory(w->directory, error) &&
                      gis_spool_create(w->directory, NULL, &w->all, error);
    if (done)
        *out = w;
    else
        gis_barriers_writer_free(w);
    return done;
}

bool gis_barriers_add(gis_barriers_writer *writer, const gis_spooled_barrier *barrier, gis_error *error)
{
    writer->n++;
    return note_facts(writer, barrier, error) &&
           add_barrier(writer->all, barrier, full_distance(writer, barrier), error);
}

bool gis_barriers_finish(gis_barriers_writer *writer, gis_error *error)
{
    char *path = gis_disk_path(writer->directory, GIS_BARRIERS_EVERYWHERE);
    gis_spool_writer *few = NULL;
    bool done =
        (path || gis_no_memory(error)) && make_directory(path, error) && gis_spool_create(path, NULL, &few, error);
    for (int k = 0; k < FACTS && done; k++) {
        bool again = !writer->fact[k].there;
        for (int i = 0; i < k; i++)
            again =
                again || (writer->fact[i].there && writer->fact[i].barrier.number == writer->fact[k].barrier.number);
        if (!again)
            done = add_barrier(few, &writer->fact[k].barrier, full_distance(writer, &writer->fact[k].barrier), error);
    }
    done = done && gis_spool_finish(few, 1, NULL, NULL, error) && gis_spool_finish(writer->all, 1, NULL, NULL, error);
    gis_spool_writer_free(few);
    free(path);
    return done;
}

void gis_barriers_writer_free(gis_barriers_writer *writer)
{
    if (!writer) return;
    for (int k = 0; k < FACTS; k++) free_barrier(&writer->fact[k].barrier);
    gis_spool_writer_free(writer->all);
    free(writer->directory);
    free(writer);
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

bool gis_barriers_open(const char *directory, gis_spooled_barriers *out, gis_error *error)
{
    char *all = gis_disk_path(directory, GIS_BARRIERS), *few = all ? gis_disk_path(all, GIS_BARRIERS_EVERYWHERE) : NULL;
    *out = (gis_spooled_barriers){0};
    const bool done = (few || gis_no_memory(error)) && gis_spool_open(all, &out->all, error) &&
                      gis_spool_open(few, &out->everywhere, error);
    free(all);
    free(few);
    return done;
}

void gis_barriers_close(gis_spooled_barriers *spool)
{
    gis_spool_close(spool->all);
    gis_spool_close(spool->everywhere);
    *spool = (gis_spooled_barriers){0};
}

bool gis_barriers_may_meet(const gis_spooled_barriers *spool, const double box[4])
{
    for (size_t k = 0; spool->all && k < gis_spool_cells(spool->all); k++)
        if (gis_box_meets(box, gis_spool_cell_at(spool->all, k)->box)) return true;
    return false;
}

typedef struct loading {
    gis_barriers_list *out;
    const double (*box)[4];
    size_t n;
    bool all; /* take every barrier, whatever it meets */
} loading;

static bool meets_any(const loading *l, const double box[4])
{
    for (size_t k = 0; k < l->n; k++)
        if (gis_box_meets(l->box[k], box)) return true;
    return l->all;
}

/* The box of a barrier, computed as when it was written. */
static void box_of(const gis_spool_feature *f, double box[4])
{
    const size_t points = points_of(&f->lines);
    if (!sunder_shape_is_empty(f->demands.shape)) sunder_shape_box(f->demands.shape, box);
    for (size_t k = 0; k < 2 * points; k++) {
        box[k % 2] = fmin(box[k % 2], f->lines.xy[k]);
        box[k % 2 + 2] = fmax(box[k % 2 + 2], f->lines.xy[k]);
    }
    for (int c = 0; c < 4; c++)
        box[c] = c < 2 ? nextafter(box[c] - f->reach, -INFINITY) : nextafter(box[c] + f->reach, INFINITY);
}

static bool take_barrier(void *user, const gis_spool_feature *f, gis_error *error)
{
    loading *l = user;
    double box[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    sunder_shape *shape = (sunder_shape *)f->demands.shape;
    box_of(f, box);
    const bool wanted = meets_any(l, box);
    if (!wanted || sunder_shape_is_empty(shape)) {
        sunder_shape_free(shape);
        shape = NULL;
    }
    if (!wanted) return true;
    gis_barriers_list *to = l->out;
    if (!gis_array_reserve(&to->item, &to->capacity, to->n + 1, sizeof *to->item)) {
        sunder_shape_free(shape);
        return gis_no_memory(error);
    }
    gis_spooled_barrier *b = &to->item[to->n++];
    *b = (gis_spooled_barrier){.number = f->index,
                               .fid = f->fid,
                               .layer = f->id ? f->id : "",
                               .gap_class = f->gap_class,
                               .demands = {.geometry = f->lines,
                                           .width = f->demands.weight,
                                           .gap = f->demands.max_shift,
                                           .side = f->demands.fixed,
                                           .full_gap = f->area}};
    b->demands.geometry.shape = shape;
    return own_rest(b, error);
}

static int by_number(const void *a, const void *b)
{
    const gis_spooled_barrier *p = a, *q = b;
    return (p->number > q->number) - (p->number < q->number);
}

/* Sorts by number and removes duplicates: a barrier that every part gets may have been read twice. */
static void sort_barriers(gis_barriers_list *list)
{
    size_t kept = 0;
    if (list->n) qsort(list->item, list->n, sizeof *list->item, by_number);
    for (size_t k = 0; k < list->n; k++) {
        if (kept && list->item[kept - 1].number == list->item[k].number)
            free_barrier(&list->item[k]);
        else
            list->item[kept++] = list->item[k];
    }
    list->n = kept;
}

bool gis_barriers_load(const gis_spooled_barriers *spool, const double (*box)[4], size_t n, gis_barriers_list *out,
                       gis_error *error)
{
    loading l = {.out = out, .box = box, .n = n};
    bool done = true;
    *out = (gis_barriers_list){0};
    if (!spool->all) return true;
    for (size_t k = 0; k < gis_spool_cells(spool->all) && done; k++)
        if (meets_any(&l, gis_spool_cell_at(spool->all, k)->box))
            done = gis_spool_read(spool->all, k, take_barrier, &l, error);
    l.all = true;
    for (size_t k = 0; k < gis_spool_cells(spool->everywhere) && done; k++)
        done = gis_spool_read(spool->everywhere, k, take_barrier, &l, error);
    sort_barriers(out);
    return done;
}

bool gis_barriers_set(const gis_barriers_list *list, sunder_layer *layer, gis_error *error)
{
    sunder_error why;
    if (list->n == 0) return true;
    sunder_barrier *barrier = malloc(list->n * sizeof *barrier);
    if (!barrier) return gis_no_memory(error);
    for (size_t k = 0; k < list->n; k++) barrier[k] = list->item[k].demands;
    const bool done = sunder_layer_set_barriers(layer, barrier, list->n, &why) == SUNDER_OK;
    free(barrier);
    return done || gis_core_failed(error, "--barrier", &why);
}

void gis_barriers_list_clear(gis_barriers_list *list)
{
    for (size_t k = 0; k < list->n; k++) free_barrier(&list->item[k]);
    free(list->item);
    *list = (gis_barriers_list){0};
}
