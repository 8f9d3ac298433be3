/* spool_enlarging.h: makes the features of a spool larger that are too small (--enlarge), into another spool. */
#ifndef GIS_SPOOL_ENLARGING_H
#define GIS_SPOOL_ENLARGING_H

#include "layer/layer_input.h"
#include "shards/spool/spool.h"

/* Reads the spool in the directory `from`, part by part, and makes one with the same parts in `directory`: features
 * have their larger shapes, with those that they had before as `given`, and all blocks are numbered. input: the rules
 * and lengths. *larger becomes the number of features that grew. */
bool gis_spool_enlarge(const gis_layer_input *input, const char *from, const char *directory, size_t *larger,
                       gis_error *error);

#endif
