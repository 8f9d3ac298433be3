/* proof_town.c: see proof_town.h. */
#include "proof_town.h"

#include "run_layer.h"
#include "sunder_proof.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

sunder_feature *proof_town_add(proof_town *t, const double *xy, size_t corners, double limit)
{
    const size_t rings = 1;
    sunder_shape *shape = NULL;
    sunder_error err;
    double *own = t->xy[t->n];
    memcpy(own, xy, 2 * corners * sizeof *own);
    if (sunder_shape_from_rings(own, &corners, &rings, 1, SUNDER_VALIDITY_STRICT, &shape, &err))
        fail_msg("%s", err.message);
    t->plain[t->n] = (proof_feature){.xy = own, .corners = corners, .max_shift = limit, .fixed = limit == 0};
    t->feature[t->n] = (sunder_feature){.shape = shape, .weight = 1, .max_shift = limit, .block = -1};
    return &t->feature[t->n++];
}

sunder_feature *proof_town_add_box(proof_town *t, double x, double y, double w, double h, double limit)
{
    const double xy[8] = {x, y, x + w, y, x + w, y + h, x, y + h};
    return proof_town_add(t, xy, 4, limit);
}

void proof_town_add_barrier(proof_town *t, const double *xy, size_t corners, double width, double gap, bool sides)
{
    const size_t rings = 1, k = t->barriers++;
    double *own = t->xy[t->n + k];
    sunder_shape *area = NULL;
    sunder_error err;
    memcpy(own, xy, 2 * corners * sizeof *own);
    t->corners[k] = corners;
    t->plain[t->n + k] = (proof_feature){own, corners, 0, true, corners < 4, width / 2 + gap, sides};
    t->barrier[k] = (sunder_barrier){.width = width, .gap = gap, .side = sides};
    if (corners < 4) {
        t->barrier[k].geometry = (sunder_obstacle){.xy = own, .line_end = &t->corners[k], .lines = 1};
        return;
    }
    if (sunder_shape_from_rings(own, &t->corners[k], &rings, 1, SUNDER_VALIDITY_STRICT, &area, &err))
        fail_msg("%s", err.message);
    t->barrier[k].geometry.shape = area;
}

static sunder_report *separate_beside(const proof_town *t, const sunder_layer_options *options)
{
    sunder_layer *layer = NULL;
    sunder_report *report = NULL;
    assert_int_equal(sunder_layer_new(t->feature, t->n, &layer, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_set_barriers(layer, t->barrier, t->barriers, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_separate(layer, options, &report, NULL), SUNDER_OK);
    sunder_layer_free(layer);
    return report;
}

sunder_report *proof_town_separate(const proof_town *t)
{
    sunder_layer_options options;
    sunder_layer_options_init(&options);
    options.contained = SUNDER_CONTAINMENT_SEPARATE;
    options.no_blocks = !t->blocks;
    options.gap = t->gap;
    options.touch_tolerance = 0;
    options.allow_jumps = t->barriers > 0;
    if (t->barriers) return separate_beside(t, &options);
    return run_separate(t->feature, t->n, &options);
}

void proof_town_free(proof_town *t)
{
    for (size_t k = 0; k < t->n; k++) sunder_shape_free((sunder_shape *)t->feature[k].shape);
    for (size_t k = 0; k < t->barriers; k++) sunder_shape_free((sunder_shape *)t->barrier[k].geometry.shape);
}

size_t proof_town_check(const proof_town *t, const sunder_report *report, size_t trial, size_t *open)
{
    size_t n, proved = 0;
    const sunder_conflict *c = sunder_report_conflicts(report, &n);
    for (size_t k = 0; k < n; k++) {
        *open += c[k].reason == SUNDER_REASON_UNRESOLVED && !c[k].crowded;
        if (c[k].reason != SUNDER_REASON_NO_ROOM && c[k].reason != SUNDER_REASON_SIDE && !c[k].crowded) {
            assert_null(sunder_report_proof(report, k));
            continue;
        }
        proved++;
        const char *wrong = proof_check(t->plain, t->n, t->n + t->barriers, t->gap, report, k);
        if (wrong) fail_msg("trial %zu: the proof for %zu and %zu: %s", trial, c[k].a, c[k].b, wrong);
    }
    return proved;
}
