#include "upheld.h"

#include "standing.h"

#include <stdlib.h>

static bool is_within(sunder_conflict_kind kind)
{
    return kind == SUNDER_CONFLICT_CONTAINED || kind == SUNDER_CONFLICT_DUPLICATE;
}

/* The kinds of pairs come from sunder_layer_check() on the original layer; that part of src/ is trusted here. It is not
 * cancelled. */
static sunder_report *check(const sunder_feature *feature, size_t n, const sunder_layer_options *options)
{
    sunder_layer *layer = NULL;
    sunder_report *report = NULL;
    sunder_layer_options to_the_end = *options;
    to_the_end.progress = NULL;
    if (sunder_layer_new(feature, n, &layer, NULL) || sunder_layer_check(layer, &to_the_end, &report, NULL)) abort();
    sunder_layer_free(layer);
    return report;
}

static bool was_within(const sunder_report *before, const sunder_conflict *now)
{
    size_t n;
    const sunder_conflict *c = sunder_report_conflicts(before, &n);
    for (size_t k = 0; k < n; k++)
        if (c[k].a == now->a && c[k].b == now->b) return is_within(c[k].kind);
    return false;
}

static void read_rings(polyset *set, const sunder_shape *shape, const double d[2])
{
    polyset_init(set);
    for (size_t p = 0; p < sunder_shape_polygons(shape); p++) {
        for (size_t r = 0; r < sunder_shape_rings(shape, p); r++) {
            size_t corners;
            const double *xy = sunder_shape_ring(shape, p, r, &corners);
            for (size_t k = 0; k < corners; k++) polyset_vertex(set, xy[2 * k] + d[0], xy[2 * k + 1] + d[1]);
            polyset_end_ring(set);
        }
        polyset_end_polygon(set);
    }
}

static const char *breach(const sunder_feature *feature, const sunder_conflict *c, double gap,
                          const sunder_report *report)
{
    polyset was[2], is[2];
    const size_t pair[2] = {c->a, c->b};
    for (int e = 0; e < 2; e++) {
        const double still[2] = {0, 0};
        double d[2];
        sunder_report_move(report, pair[e], &d[0], &d[1]);
        read_rings(&was[e], feature[pair[e]].shape, still);
        read_rings(&is[e], feature[pair[e]].shape, d);
    }
    const char *wrong = standing_rule(&was[0], &was[1], &is[0], &is[1], gap);
    for (int e = 0; e < 2; e++) {
        polyset_free(&was[e]);
        polyset_free(&is[e]);
    }
    return wrong;
}

char *upheld_breach(const sunder_feature *feature, size_t n, const sunder_layer_options *options,
                    const sunder_report *report)
{
    size_t conflicts;
    const sunder_conflict *c = sunder_report_conflicts(report, &conflicts);
    sunder_report *before = conflicts ? check(feature, n, options) : NULL;
    char *text = NULL;
    for (size_t k = 0; k < conflicts && !text; k++) {
        if (c[k].b >= n || c[k].inside_block || (is_within(c[k].kind) && was_within(before, &c[k]))) continue;
        if (sunder_shape_repaired(feature[c[k].a].shape) || sunder_shape_repaired(feature[c[k].b].shape)) continue;
        const char *wrong = breach(feature, &c[k], options->gap, report);
        if (wrong) text = test_format("%zu and %zu %s", c[k].a, c[k].b, wrong);
    }
    sunder_report_free(before);
    return text;
}
