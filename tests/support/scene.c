#include "scene.h"

#include "polyset.h"
#include "run_layer.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

void scene_begin(scene *s, double gap)
{
    memset(s, 0, sizeof *s);
    sunder_layer_options_init(&s->options);
    s->options.gap = gap;
}

void scene_end(scene *s)
{
    sunder_report_free(s->report);
    for (size_t i = 0; i < s->n; i++) sunder_shape_free((sunder_shape *)s->feature[i].shape);
}

sunder_feature *scene_add(scene *s, const char *wkt)
{
    assert_true(s->n < SCENE_MOST);
    sunder_feature *f = &s->feature[s->n++];
    *f = (sunder_feature){.weight = 1, .max_shift = INFINITY, .block = -1};
    if (wkt) {
        f->shape = polyset_shape_of_wkt(wkt);
        assert_non_null(f->shape);
    }
    return f;
}

sunder_feature *scene_add_box(scene *s, double x, double y, double w, double h)
{
    char wkt[400];
    snprintf(wkt, sizeof wkt, "POLYGON ((%.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g))", x, y,
             x + w, y, x + w, y + h, x, y + h, x, y);
    return scene_add(s, wkt);
}

static void take(scene *s, sunder_report *report)
{
    sunder_report_free(s->report);
    s->report = report;
    sunder_report_summary(report, &s->summary);
}

void scene_separate(scene *s) { take(s, run_separate(s->feature, s->n, &s->options)); }

void scene_check(scene *s) { take(s, run_check(s->feature, s->n, &s->options)); }

size_t scene_left(const scene *s)
{
    const sunder_conflict_counts *after = &s->summary.after;
    return after->overlap + after->too_close + after->barrier + after->barrier_drawn + after->barrier_near +
           after->contained + after->duplicate;
}

double scene_length(const scene *s, size_t feature)
{
    double dx, dy;
    sunder_report_move(s->report, feature, &dx, &dy);
    return hypot(dx, dy);
}
