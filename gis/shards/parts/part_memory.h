/* part_memory.h: estimates the memory that a part takes. */
#ifndef GIS_PART_MEMORY_H
#define GIS_PART_MEMORY_H

#include <stdbool.h>

/* A part or contact group gets a warning if it takes more than this multiple of the memory allowed. */
#define GIS_PART_LARGE 1.5

/* Bytes of a process without any part: libraries and buffers for reading and writing. */
#define GIS_PART_BYTES_ANYWAY 96e6

/* Estimated bytes of a process that separates a part with these numbers of features and vertices. proofs: the trees of
 * the proof are kept; effort: the value of --effort. */
double gis_part_bytes(bool proofs, double effort, double features, double vertices);

#endif
