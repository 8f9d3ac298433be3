/* Gaps by classes, as the caller gives them. */
#include "displacement/layer/class_gaps.h"
#include "displacement/layer/layer.h"

#include "base/error.h"
#include "base/extremes.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/* The greatest number of classes. Tables have the square of it. */
#define MOST_CLASSES 1024

void sunder_i_class_gaps_free(sunder_i_class_gaps *gaps)
{
    if (gaps) sunder_i_free_all(gaps->of, gaps->gap, gaps->full, gaps->part);
    sunder_i_free(gaps);
}

static sunder_status check_tables(const sunder_gaps *gaps, sunder_error *err)
{
    const size_t n = gaps->classes;
    if (n == 0 || n > MOST_CLASSES)
        return sunder_i_fail(err, SUNDER_EARG, "the number of classes for gaps, %zu, is not 1 to %d", n, MOST_CLASSES);
    for (size_t k = 0; k < n * n; k++) {
        const size_t i = k / n, j = k % n, back = j * n + i;
        const double gap = gaps->gap[k], full = gaps->full_gap ? gaps->full_gap[k] : gap;
        if (!(gap >= 0) || !isfinite(full))
            return sunder_i_fail(err, SUNDER_EARG, "the gap of classes %zu and %zu, %g, is negative or not finite", i,
                                 j, gap);
        if (!(full >= gap))
            return sunder_i_fail(err, SUNDER_EARG, "classes %zu and %zu: the full gap, %g, is less than the gap, %g", i,
                                 j, full, gap);
        if (gap != gaps->gap[back] || (gaps->full_gap && full != gaps->full_gap[back]))
            return sunder_i_fail(err, SUNDER_EARG, "classes %zu and %zu have another gap than %zu and %zu", i, j, j, i);
    }
    return SUNDER_OK;
}

static sunder_status check_classes(const uint32_t *of, size_t n, size_t classes, const char *what, sunder_error *err)
{
    for (size_t k = 0; k < n; k++)
        if (of[k] >= classes)
            return sunder_i_fail(err, SUNDER_EARG, "%s %zu: its class for gaps, %u, is not one of the %zu", what, k,
                                 of[k], classes);
    return SUNDER_OK;
}

/* Sets what depends on which classes features have. */
static void find_parts(const sunder_gaps *gaps, size_t features, sunder_i_class_gaps *out)
{
    const size_t n = out->n;
    bool has[MOST_CLASSES] = {false};
    for (size_t k = 0; k < features && !gaps->there; k++) has[gaps->feature[k]] = true;
    for (size_t k = 0; k < n && gaps->there; k++) has[k] = gaps->there[k];
    for (size_t i = 0; i < n; i++) {
        out->part[i] = INFINITY;
        for (size_t j = 0; j < n; j++) {
            if (!has[j]) continue;
            out->part[i] = sunder_i_min(out->part[i], out->gap[i * n + j]);
            if (!has[i]) continue;
            out->among[0] = sunder_i_max(out->among[0], out->gap[i * n + j]);
            out->among[1] = sunder_i_max(out->among[1], out->full[i * n + j]);
        }
    }
}

static sunder_i_class_gaps *copy_gaps(const sunder_gaps *gaps, size_t features, size_t barriers)
{
    const size_t n = gaps->classes, table = n * n * sizeof *gaps->gap;
    sunder_i_class_gaps *out = sunder_i_calloc(1, sizeof *out);
    if (!out) return NULL;
    out->n = n;
    out->of = sunder_i_alloc(features + barriers, sizeof *out->of);
    out->gap = sunder_i_alloc(n * n, sizeof *out->gap);
    out->full = sunder_i_alloc(n * n, sizeof *out->full);
    out->part = sunder_i_alloc(n, sizeof *out->part);
    if (!out->of || !out->gap || !out->full || !out->part) {
        sunder_i_class_gaps_free(out);
        return NULL;
    }
    if (features) memcpy(out->of, gaps->feature, features * sizeof *out->of);
    if (barriers) memcpy(out->of + features, gaps->barrier, barriers * sizeof *out->of);
    memcpy(out->gap, gaps->gap, table);
    memcpy(out->full, gaps->full_gap ? gaps->full_gap : gaps->gap, table);
    find_parts(gaps, features, out);
    return out;
}

sunder_status sunder_layer_set_gaps(sunder_layer *layer, const sunder_gaps *gaps, sunder_error *err)
{
    sunder_i_class_gaps *copy = NULL;
    if (gaps) {
        sunder_status status = check_tables(gaps, err);
        if (!status) status = check_classes(gaps->feature, layer->n, gaps->classes, "feature", err);
        if (!status) status = check_classes(gaps->barrier, layer->barriers, gaps->classes, "barrier", err);
        if (status) return status;
        copy = copy_gaps(gaps, layer->n, layer->barriers);
        if (!copy) return sunder_i_failure_cause(err);
    }
    sunder_i_class_gaps_free(layer->gaps);
    layer->gaps = copy;
    return SUNDER_OK;
}
