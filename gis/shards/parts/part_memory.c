/* part_memory.c: see part_memory.h. The constants were measured on towns, which take the most memory. */
#include "shards/parts/part_memory.h"

#include <math.h>

static const double bytes_a_feature = 2000, bytes_a_vertex = 120;
/* Bytes per feature for the proof without a search, and the additional bytes with --effort 1. If that effort proves all
 * groups, as in towns, more effort takes no more memory. Otherwise the tree of a single group may take hundreds of
 * megabytes more, which cannot be predicted. */
static const double bytes_a_proof = 3000, bytes_of_effort = 8000;

double gis_part_bytes(bool proofs, double effort, double features, double vertices)
{
    const double more = proofs ? bytes_a_proof + bytes_of_effort * fmin(1, effort) : 0;
    return GIS_PART_BYTES_ANYWAY + (bytes_a_feature + more) * features + bytes_a_vertex * vertices;
}
