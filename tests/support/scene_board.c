/* See scene_board.h. */
#include "scene_board.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

void scene_board_begin(scene_board *b)
{
    b->scene.options.no_blocks = b->scene.options.allow_jumps = true;
    scene_model_begin(&b->of, &b->scene);
    assert_int_equal(b->of.model.bodies, b->scene.n);
    assert_true(b->scene.n <= SCENE_BOARD_MOST);
    for (uint32_t k = 0; k < b->scene.n; k++) b->body[k] = k;
    memset(b->move, 0, sizeof b->move);
}

void scene_board_end(scene_board *b)
{
    scene_model_end(&b->of);
    scene_end(&b->scene);
}
