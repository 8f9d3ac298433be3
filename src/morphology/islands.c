/* islands.c: an erosion, or an opening, polygon by polygon.
 *
 * The polygons of a set in canonical form have disjoint interiors and touch in points at most. Let the interior of B be
 * connected. If B + x is a subset of the set, its interior is in the interior of the set, whose components are the
 * interiors of the polygons: so it is in one of them, and the closed B + x in that polygon. The erosion is the union of
 * the erosions of the polygons, which are closed and disjoint. The union of the translates of B in them, the opening,
 * is also in one polygon each.
 *
 * So a layer of a hundred thousand blocks needs the memory of its largest one besides the result, and uses all
 * threads. */
#include "base/extremes.h"
#include "base/parallel.h"
#include "morphology/morphology.h"
#include "sum/sum_of_parts.h"

#include <pthread.h>

typedef struct islands {
    const sunder_i_morphology_operands *operands;
    const sunder_sum *whole;
    const sunder_sum_options *asked;
    bool connected, open, dilated;
    sunder_sum **part;    /* [n] the results of the islands */
    size_t n, sides;      /* the number of sides of all islands */
    pthread_mutex_t lock; /* protects the caller's progress and the members below */
    size_t done;          /* the number of sides of finished islands */
    double told;
    bool stopped;
} islands;

/* Converts the progress of one island to that of the whole. Reported fractions never decrease, whichever thread reports
 * them. */
typedef struct teller {
    islands *all;
    size_t sides;
    double from, to; /* the interval of the island's progress that the current stage takes */
} teller;

static bool tell_progress(double fraction, void *user)
{
    const teller *t = user;
    islands *all = t->all;
    pthread_mutex_lock(&all->lock);
    const double part = (t->from + (t->to - t->from) * fraction) * (double)t->sides;
    all->told = sunder_i_max(all->told, ((double)all->done + part) / (double)(all->sides + 1));
    if (!all->stopped) all->stopped = !all->asked->progress(all->told, all->asked->progress_user);
    const bool go_on = !all->stopped;
    pthread_mutex_unlock(&all->lock);
    return go_on;
}

static sunder_status dilate_again(const islands *all, const sunder_sum_options *options, sunder_sum *eroded,
                                  sunder_sum **out, sunder_error *err)
{
    sunder_i_figure figure;
    sunder_sum *sum = sunder_i_morphology_operands_sum(all->operands, 0);
    if (!sum) return sunder_i_failure_cause(err);
    sunder_status status;
    if (sunder_i_figure_of_sum(eroded, 0, eroded->polygons, false, &figure)) {
        bool done;
        status = sunder_i_sum_by_convolution(&figure, &all->operands->element, false, sum, &done, err);
        if (status == SUNDER_OK && !done)
            status = sunder_i_dilate_figure(&figure, &all->operands->element, options, sum, err);
        sunder_i_figure_free(&figure);
    } else
        status = sunder_i_failure_cause(err);
    if (status == SUNDER_OK)
        *out = sum;
    else
        sunder_sum_free(sum);
    return status;
}

/* Erodes one island, trying the fastest method first: after a dilation most of the boundary is arcs, which vanish along
 * the convolution. */
static sunder_status erode_island(const islands *all, const sunder_i_figure *figure, const sunder_sum_options *options,
                                  sunder_sum *eroded, sunder_error *err)
{
    const sunder_i_structuring_element *element = &all->operands->reflected;
    bool done = false;
    sunder_status status = SUNDER_OK;
    if (all->dilated) status = sunder_i_sum_by_convolution(figure, element, true, eroded, &done, err);
    if (status == SUNDER_OK && !done) status = sunder_i_erode_by_outline(figure, element, options, eroded, &done, err);
    if (status == SUNDER_OK && !done && !all->dilated)
        status = sunder_i_sum_by_convolution(figure, element, true, eroded, &done, err);
    if (status == SUNDER_OK && !done) status = sunder_i_erode_figure(figure, element, options, eroded, err);
    return status;
}

static sunder_status one_island(islands *all, const sunder_i_figure *figure, sunder_sum **out, sunder_error *err)
{
    teller t = {all, figure->sides, 0, all->open ? 0.5 : 1};
    sunder_sum_options options = {.size = sizeof options, .seed = all->asked->seed};
    if (all->asked->progress) {
        options.progress = tell_progress;
        options.progress_user = &t;
    }
    sunder_sum *eroded = sunder_i_morphology_operands_sum(all->operands, -1);
    if (!eroded) return sunder_i_failure_cause(err);
    sunder_status status = erode_island(all, figure, &options, eroded, err);
    if (status == SUNDER_OK && !all->open) {
        *out = eroded;
        return SUNDER_OK;
    }
    t.from = 0.5;
    t.to = 1;
    if (status == SUNDER_OK) status = dilate_again(all, &options, eroded, out, err);
    sunder_sum_free(eroded);
    return status;
}

static sunder_status work_on_islands(void *context, size_t begin, size_t end, sunder_error *err)
{
    islands *all = context;
    sunder_status status = SUNDER_OK;
    for (size_t i = begin; i < end && status == SUNDER_OK; i++) {
        if (!all->whole) {
            status = one_island(all, &all->operands->figure, &all->part[i], err);
            continue;
        }
        sunder_i_figure figure;
        const size_t last = all->connected ? i + 1 : all->whole->polygons;
        if (!sunder_i_figure_of_sum(all->whole, i, last, true, &figure)) return sunder_i_failure_cause(err);
        status = one_island(all, &figure, &all->part[i], err);
        pthread_mutex_lock(&all->lock);
        all->done += figure.sides;
        pthread_mutex_unlock(&all->lock);
        sunder_i_figure_free(&figure);
    }
    return status;
}

static sunder_status run_islands(islands *all, sunder_sum **out, sunder_error *err)
{
    all->part = sunder_i_calloc(all->n + 1, sizeof *all->part);
    /* in a closing the dilation has added B's origin already */
    sunder_sum *sum = sunder_i_morphology_operands_sum(all->operands, all->open || all->dilated ? 0 : -1);
    sunder_status status = all->part && sum ? SUNDER_OK : sunder_i_failure_cause(err);
    if (status == SUNDER_OK) {
        pthread_mutex_init(&all->lock, NULL);
        status = sunder_i_parallel(all->asked->threads, all->n, SUNDER_I_GRAIN_WHOLE, work_on_islands, all, err);
        pthread_mutex_destroy(&all->lock);
    }
    if (status == SUNDER_OK && !sunder_i_gather(all->part, all->n, sum)) status = sunder_i_failure_cause(err);
    for (size_t i = 0; all->part && i < all->n; i++) sunder_sum_free(all->part[i]);
    sunder_i_free(all->part);
    if (status == SUNDER_OK)
        *out = sum;
    else
        sunder_sum_free(sum);
    return status;
}

sunder_status sunder_i_islands(const sunder_i_morphology_operands *operands, const sunder_sum *whole, bool connected,
                               sunder_operation operation, const sunder_sum_options *options, sunder_sum **out,
                               sunder_error *err)
{
    islands all = {.operands = operands,
                   .whole = whole,
                   .asked = options,
                   .connected = connected,
                   .open = operation == SUNDER_OPERATION_OPEN,
                   .dilated = operation == SUNDER_OPERATION_CLOSE};
    all.n = whole && connected ? whole->polygons : 1;
    all.sides = !whole ? operands->figure.sides : whole->rings ? whole->ring_end[whole->rings - 1] : 0;
    return run_islands(&all, out, err);
}
