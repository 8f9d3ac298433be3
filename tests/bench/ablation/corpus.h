/* A corpus: small layers, each a cluster of conflicts of a real layer with its surroundings, as a text from which the
 * library reads exactly the same input again. Numbers are hexadecimal doubles.
 *
 *     cluster NAME
 *     options GAP TOLERANCE NO_BLOCKS NO_TOUCH THIN LIST_INSIDE CONTAINED JUMPS EFFORT SEED BARRIER_REACH
 *             ROWS STIFFNESS STIFFNESS_ALONG EASE
 *     feature WEIGHT MAX_SHIFT BLOCK FIXED IGNORED SIDE_ANCHOR_X SIDE_ANCHOR_Y, and a shape
 *     barrier WIDTH GAP SIDE, and a shape; lines N, and N numbers of points; the points
 *     end
 *
 * A shape is "shape EVEN_ODD POLYGONS RINGS VERTICES", the ends of polygons and of rings, and the points; "shape -" is
 * none. */
#ifndef SUNDER_ABLATION_CORPUS_H
#define SUNDER_ABLATION_CORPUS_H

#include "sunder.h"

#include <stdio.h>

typedef struct corpus_item {
    char name[64];
    sunder_layer_options options;
    sunder_feature *feature;
    size_t features;
    double *side_anchor; /* [2 * features] not finite if the rule determines the side anchor */
    sunder_barrier *barrier;
    size_t barriers;
} corpus_item;

/* Appends an item. A write error is reported when the file is closed. */
void corpus_write(FILE *to, const corpus_item *item);

/* Reads the next item; false at the end of the file. A text that does not have this form ends the program. */
bool corpus_read(FILE *from, corpus_item *item);
void corpus_item_free(corpus_item *item);

#endif
