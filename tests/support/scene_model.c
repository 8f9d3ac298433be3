/* The stages of displacement/layer in their order. */
#include "scene_model.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static void make(scene_model *m, const sunder_feature *feature, size_t n, const sunder_layer_options *options)
{
    sunder_i_rules rules;
    sunder_error err;
    memset(m, 0, sizeof *m);
    assert_int_equal(sunder_layer_new(feature, n, &m->layer, &err), SUNDER_OK);
    assert_int_equal(sunder_i_rules_of(options, &rules, &err), SUNDER_OK);
    assert_int_equal(sunder_i_barriers_make(m->layer, &rules, &m->parts, &err), SUNDER_OK);
    assert_int_equal(sunder_i_order_layer(m->layer, &m->parts, true, &m->work, &err), SUNDER_OK);
    assert_int_equal(sunder_i_model_init(&m->work, &m->parts, &rules, &m->model, &err), SUNDER_OK);
}

static void join(scene_model *m, const sunder_i_relations *relations)
{
    sunder_error err;
    assert_int_equal(sunder_i_model_join(&m->model, relations, &err), SUNDER_OK);
    assert_int_equal(sunder_i_model_cut(&m->model, &err), SUNDER_OK);
    assert_int_equal(sunder_i_model_anchor(&m->model, &err), SUNDER_OK);
}

void scene_model_begin(scene_model *m, const scene *s)
{
    const sunder_i_relations none = {0};
    make(m, s->feature, s->n, &s->options);
    join(m, &none);
    m->model.standing = &m->model.tree;
}

void scene_model_related(scene_model *m, const scene *s)
{
    scene_model_related_features(m, s->feature, s->n, &s->options);
}

void scene_model_related_features(scene_model *m, const sunder_feature *feature, size_t n,
                                  const sunder_layer_options *options)
{
    sunder_error err;
    make(m, feature, n, options);
    assert_int_equal(sunder_i_placement_init(&m->model, &m->placement, &err), SUNDER_OK);
    m->placed = true;
    assert_int_equal(sunder_i_placement_relate(&m->model, &m->placement, NULL, &m->start, &err), SUNDER_OK);
    join(m, &m->start);
    assert_int_equal(sunder_i_model_cover_diagonals(&m->model, &err), SUNDER_OK);
}

void scene_model_end(scene_model *m)
{
    sunder_i_free(m->start.pair);
    if (m->placed) sunder_i_placement_free(&m->model, &m->placement);
    sunder_i_model_free(&m->model);
    sunder_i_barriers_free(&m->parts);
    sunder_i_ordered_clear(&m->work);
    sunder_layer_free(m->layer);
}
