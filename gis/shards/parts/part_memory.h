/* part_memory.h: about how much memory does a part take? */
#ifndef GIS_PART_MEMORY_H
#define GIS_PART_MEMORY_H

#include <stdbool.h>

/* A piece of work is large, and gets a warning, if it takes this many times the memory allowed. */
#define GIS_PART_LARGE 1.5

/* Bytes of a process without any part: libraries, and what it reads and writes by. */
#define GIS_PART_BYTES_ANYWAY 96e6

/* A piece of work is large, and gets a warning, if it takes this many times the memory allowed. */
#define GIS_PART_LARGE 1.5

/* Bytes of a process with a part of this size, with or without proofs, at this effort. */
double gis_part_bytes(bool proofs, double effort, double features, double vertices);

#endif
