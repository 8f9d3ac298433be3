/* See scene_field.h. */
#include "scene_field.h"

#include "polyset.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

scene_field *scene_field_new(size_t most)
{
    scene_field *field = calloc(1, sizeof *field);
    assert_non_null(field);
    field->feature = calloc(most, sizeof *field->feature);
    field->body = calloc(most, sizeof *field->body);
    field->move = calloc(2 * most, sizeof *field->move);
    assert_true(field->feature && field->body && field->move);
    return field;
}

void scene_field_add(scene_field *field, const char *wkt, double max_shift)
{
    const size_t k = field->n++;
    field->body[k] = (uint32_t)k;
    field->feature[k] =
        (sunder_feature){.shape = polyset_shape_of_wkt(wkt), .weight = 1, .max_shift = max_shift, .block = -1};
    assert_non_null(field->feature[k].shape);
}

void scene_field_begin(scene_field *field, double gap)
{
    sunder_layer_options options;
    sunder_layer_options_init(&options);
    options.gap = gap;
    options.no_blocks = options.allow_jumps = true;
    scene_model_related_features(&field->of, field->feature, field->n, &options);
    assert_true(sunder_i_search_init(&field->search, &field->of.model, field->body, field->n, 0x1p-30, field->move));
    assert_int_equal(sunder_i_search_movers(&field->search), field->n);
}

void scene_field_free(scene_field *field)
{
    sunder_i_search_free(&field->search);
    scene_model_end(&field->of);
    for (size_t k = 0; k < field->n; k++) sunder_shape_free((sunder_shape *)(uintptr_t)field->feature[k].shape);
    free(field->feature);
    free(field->body);
    free(field->move);
    free(field);
}
