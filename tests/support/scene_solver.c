#include "scene_solver.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

void scene_solver_begin(sunder_i_solver *s, scene_model *of)
{
    sunder_error err;
    memset(s, 0, sizeof *s);
    s->model = of->model;
    s->model.standing = &of->placement.tree;
    s->placement = of->placement;
    s->start = of->start;
    assert_int_equal(sunder_i_solver_init(s, &err), SUNDER_OK);
    for (size_t k = 0; k < s->start.n; k++) {
        const sunder_i_relation *r = &s->start.pair[k];
        const uint32_t body[2] = {s->model.body_of[r->a], s->model.body_of[r->b]};
        if (!sunder_i_is_conflict_of_bodies(&s->model, r)) continue;
        assert_true(sunder_i_solver_add_edge(s, body[0], body[1]));
        for (int e = 0; e < 2; e++)
            if (!s->model.body[body[e]].fixed) sunder_i_body_event(&s->states, body[e], SUNDER_I_MEETS_CONFLICT);
    }
}

void scene_solver_end(sunder_i_solver *s)
{
    s->model = (sunder_i_model){0};
    s->placement = (sunder_i_placement){0};
    s->start = (sunder_i_relations){0};
    sunder_i_solver_free(s);
}
