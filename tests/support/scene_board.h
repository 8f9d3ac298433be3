/* A scene in which each feature is a body, in the same order, together with the features' new positions. */
#ifndef SUNDER_TESTS_SCENE_BOARD_H
#define SUNDER_TESTS_SCENE_BOARD_H

#include "scene_model.h"

enum { SCENE_BOARD_MOST = SCENE_MOST };

typedef struct scene_board {
    scene scene;
    scene_model of;
    uint32_t body[SCENE_BOARD_MOST];
    double move[2 * SCENE_BOARD_MOST]; /* zero at the beginning */
} scene_board;

/* Begins the board of a scene that has its features already. Blocks are switched off and jumps allowed; the other
 * options are the scene's. */
void scene_board_begin(scene_board *b);
/* Ends the scene, too. */
void scene_board_end(scene_board *b);

#endif
