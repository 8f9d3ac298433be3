/* morphology.c: dilation, erosion, opening and closing, as stages that are exact sums:
 *
 *   dilate   P + B                                     the convolution (../minkowski/)
 *   erode    { x : B + x in P }                        the complement of P^c + int(-B)
 *   open     the erosion, with its degenerate parts, + B
 *   close    the erosion of the closed P + B
 *
 * All sets here are closed. Each stage reads the vertices of the previous one as rational numbers; nothing is rounded
 * in between. P's polygons may overlap: an erosion computes their union first. */
#include "morphology/morphology.h"
#include "base/sized_struct.h"
#include "base/watch.h"
#include "minkowski/minkowski.h"

/* One of several stages, in relation to the caller's options. */
typedef struct stage {
    const sunder_sum_options *asked;
    double from, to; /* the interval of the whole progress that the stage takes */
    sunder_sum_options options;
} stage;

static bool tell_progress(double fraction, void *user)
{
    const stage *s = user;
    return s->asked->progress(s->from + (s->to - s->from) * fraction, s->asked->progress_user);
}

static const sunder_sum_options *begin_stage(stage *s, const sunder_sum_options *asked, double from, double to)
{
    *s = (stage){asked, from, to, {.size = sizeof s->options, .seed = asked->seed, .threads = asked->threads}};
    if (asked->progress) {
        s->options.progress = tell_progress;
        s->options.progress_user = s;
    }
    return &s->options;
}

/* Computes the set that is eroded: *out becomes NULL for P itself, if it has one polygon. */
static sunder_status first_stage(const sunder_shape *p, const sunder_shape *b, bool close,
                                 const sunder_sum_options *options, sunder_sum **out, sunder_error *err)
{
    *out = NULL;
    if (close) return sunder_minkowski_sum(p, b, options, out, err);
    return p->form->cleaned.polygons > 1 ? sunder_i_union_of_members(p, b, options, out, err) : SUNDER_OK;
}

/* Performs an erosion, opening or closing. */
static sunder_status shrink_shape(const sunder_shape *p, const sunder_shape *b, sunder_operation operation,
                                  const sunder_sum_options *asked, sunder_sum **out, sunder_error *err)
{
    const double ready = 0.2;
    const bool connected = b->form->cleaned.polygons == 1;
    stage s;
    sunder_sum *whole;
    sunder_i_morphology_operands operands;
    const bool close = operation == SUNDER_OPERATION_CLOSE;
    sunder_status status = first_stage(p, b, close, begin_stage(&s, asked, 0, ready), &whole, err);
    if (status != SUNDER_OK) return status;
    status = sunder_i_morphology_operands_make(p, b, &operands, err);
    if (status == SUNDER_OK) {
        status = sunder_i_islands(&operands, whole, connected, operation, begin_stage(&s, asked, ready, 1), out, err);
        sunder_i_morphology_operands_free(&operands);
    }
    sunder_sum_free(whole);
    return status;
}

sunder_status sunder_morphology(const sunder_shape *p, const sunder_shape *b, sunder_operation operation,
                                const sunder_sum_options *options, sunder_sum **out, sunder_error *err)
{
    if (b->form->cleaned.polygons == 0)
        return sunder_i_fail(err, SUNDER_EARG, "the shape to grow or shrink by has no area");
    if ((unsigned)operation > SUNDER_OPERATION_CLOSE)
        return sunder_i_fail(err, SUNDER_EARG, "there is no such operation");
    if (operation == SUNDER_OPERATION_DILATE) return sunder_minkowski_sum(p, b, options, out, err);
    sunder_sum_options o = {.size = sizeof o};
    sunder_status status = sunder_i_options_read(&o, sizeof o, options, err);
    if (status != SUNDER_OK) return status;
    sunder_i_watch watch;
    sunder_i_watch_begin(&watch, &o.progress, &o.progress_user);
    status = shrink_shape(p, b, operation, &o, out, err);
    sunder_i_watch_end(&watch);
    return status;
}
