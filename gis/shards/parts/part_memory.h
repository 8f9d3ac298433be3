/* part_memory.h: about how much memory does a part take? */
#ifndef GIS_PART_MEMORY_H
#define GIS_PART_MEMORY_H

#include <stdbool.h>

/* A piece of work is large, and told of, when it takes so many times the memory that it may. */
#define GIS_PART_LARGE 1.5

/* Bytes of a process without any part: libraries, and what it reads and writes by. */
#define GIS_PART_BYTES_ANYWAY 96e6

/* A piece of work is large, and told of, when it takes so many times the memory that it may. */
#define GIS_PART_LARGE 1.5

/* Bytes of a process with a part of so much, of a run with or without proofs and of that effort. */
double gis_part_bytes(bool proofs, double effort, double features, double vertices);

#endif
