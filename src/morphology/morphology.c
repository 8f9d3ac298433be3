/* Dilate, erode, open, close, as stages that are exact sums:
 *
 *     dilate   P + B                                     the convolution (../minkowski/)
 *     erode    { x : B + x in P }                        the complement of P^c + int(-B)
 *     open     the erosion, degenerate parts and all, + B
 *     close    the erosion of the closed P + B
 *
 * All sets here are closed. Each stage reads the corners of the one before as they are, as rationals; nothing is rounded
 * in between. P's members may overlap: an erosion takes their union first. */
#include "minkowski/minkowski.h"
#include "morphology/morphology.h"

#include <string.h>

typedef enum stage_kind { UNITE, SHRINK, GROW } stage_kind;

typedef struct work {
    const sunder_shape *p, *b;
    sunder_sum_options options; /* of the stage at hand */
    const sunder_sum_options *asked;
    double from, to; /* the part of the whole that the stage is */
} work;

static bool stage_progress(double fraction, void *user)
{
    const work *w = user;
    return w->asked->progress(w->from + (w->to - w->from) * fraction, w->asked->progress_user);
}

static void begin_stage(work *w, double from, double to)
{
    w->from = from;
    w->to = to;
    w->options = (sunder_sum_options){.seed = w->asked->seed};
    if (!w->asked->progress) return;
    w->options.progress = stage_progress;
    w->options.progress_user = w;
}

static sunder_status run_stage(const work *w, stage_kind kind, const sunder_i_figure *figure,
                               const sunder_i_probe *probe, sunder_sum *sum, sunder_error *err)
{
    switch (kind) {
    case UNITE:
        return sunder_i_unite_figure(figure, &w->options, sum, err);
    case SHRINK:
        return sunder_i_shrink(figure, probe, &w->options, sum, err);
    case GROW:
        break;
    }
    return sunder_i_grow(figure, probe, &w->options, sum, err);
}

/* One stage on what `from` bounds (NULL: P itself). P and B are placed as often as stages need them, always in the same
 * way: units and origins agree, and what one stage leaves on its lattice another finds. Wide always: corners of the later
 * stages fit no narrow lattice. `moved` says how many times B's origin the result's coordinates are off P's. */
static sunder_status do_stage(const work *w, stage_kind kind, sunder_sum *from, bool regular, int moved,
                              sunder_sum **out, sunder_error *err)
{
    sunder_sum *sum = sunder_i_calloc(1, sizeof *sum);
    if (!sum) return sunder_i_no_memory(err);
    sunder_i_placed placed;
    const sunder_i_place_options how = {.force_wide = true};
    sunder_status status = sunder_i_place(w->p, w->b, &how, &placed, err);
    if (status != SUNDER_OK) {
        sunder_i_free(sum);
        return status;
    }
    sum->lattice = placed.lattice; /* moved */
    memset(&placed.lattice, 0, sizeof placed.lattice);
    sum->method.algorithm = SUNDER_INCREMENTAL;
    for (int k = 0; k < 2; k++) {
        sum->origin[0][k] = placed.origin_p[k];
        sum->origin[1][k] = moved ? moved * placed.origin_q[k] : 0;
    }
    sunder_i_figure figure = {0};
    sunder_i_probe probe = {0};
    const bool ok = (from ? sunder_i_figure_of_sum(from, regular, &figure)
                          : sunder_i_figure_of_shape(&sum->lattice, w->p, placed.p, &figure)) &&
                    (!w->b || sunder_i_probe_of_shape(&sum->lattice, w->b, placed.q, kind == SHRINK, &probe));
    status = ok ? run_stage(w, kind, &figure, &probe, sum, err) : sunder_i_no_memory(err);
    sunder_i_figure_free(&figure);
    sunder_i_probe_free(&probe);
    sunder_i_placed_free(&placed);
    if (status == SUNDER_OK)
        *out = sum;
    else
        sunder_sum_free(sum);
    return status;
}

sunder_status sunder_shape_union(const sunder_shape *shape, const sunder_sum_options *options, sunder_sum **out,
                                 sunder_error *err)
{
    static const sunder_sum_options defaults;
    work w = {.p = shape, .asked = options ? options : &defaults};
    begin_stage(&w, 0, 1);
    return do_stage(&w, UNITE, NULL, true, 0, out, err);
}

/* The erosion of P, in the part of the whole from 0 to `to`. */
static sunder_status erode(work *w, double to, sunder_sum **out, sunder_error *err)
{
    sunder_sum *whole = NULL;
    sunder_status status = SUNDER_OK;
    const double united = w->p->polygons > 1 ? 0.2 * to : 0;
    begin_stage(w, 0, united);
    if (w->p->polygons > 1) status = do_stage(w, UNITE, NULL, true, 0, &whole, err);
    begin_stage(w, united, to);
    if (status == SUNDER_OK) status = do_stage(w, SHRINK, whole, true, -1, out, err);
    sunder_sum_free(whole);
    return status;
}

static sunder_status open_by(work *w, sunder_sum **out, sunder_error *err)
{
    sunder_sum *eroded;
    sunder_status status = erode(w, 0.5, &eroded, err);
    if (status != SUNDER_OK) return status;
    begin_stage(w, 0.5, 1);
    status = do_stage(w, GROW, eroded, false, 0, out, err);
    sunder_sum_free(eroded);
    return status;
}

static sunder_status close_by(work *w, sunder_sum **out, sunder_error *err)
{
    sunder_sum *dilated;
    begin_stage(w, 0, 0.2);
    sunder_status status = sunder_minkowski_sum(w->p, w->b, &w->options, &dilated, err);
    if (status != SUNDER_OK) return status;
    begin_stage(w, 0.2, 1);
    status = do_stage(w, SHRINK, dilated, true, 0, out, err);
    sunder_sum_free(dilated);
    return status;
}

sunder_status sunder_morphology(const sunder_shape *p, const sunder_shape *b, sunder_operation operation,
                                const sunder_sum_options *options, sunder_sum **out, sunder_error *err)
{
    static const sunder_sum_options defaults;
    work w = {.p = p, .b = b, .asked = options ? options : &defaults};
    if (b->polygons == 0)
        return sunder_i_fail(err, SUNDER_EARG, "the shape to grow or shrink by has no area");
    switch (operation) {
    case SUNDER_DILATE:
        return sunder_minkowski_sum(p, b, options, out, err);
    case SUNDER_ERODE:
        return erode(&w, 1, out, err);
    case SUNDER_OPEN:
        return open_by(&w, out, err);
    case SUNDER_CLOSE:
        return close_by(&w, out, err);
    }
    return sunder_i_fail(err, SUNDER_EARG, "there is no such operation");
}

const char *sunder_operation_string(sunder_operation operation)
{
    static const char *const name[] = {"dilate", "erode", "open", "close"};
    return (unsigned)operation <= SUNDER_CLOSE ? name[operation] : "";
}
