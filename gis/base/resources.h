/* resources.h: time, memory and number of threads of a run. */
#ifndef GIS_RESOURCES_H
#define GIS_RESOURCES_H

#include <stdint.h>

/* Returns the time in seconds of a clock that never goes back. */
double gis_clock(void);
/* Returns the number of threads to use: `asked`, or for 0 the number of processors. */
unsigned gis_threads(unsigned asked);
/* Returns the largest resident memory of the process, in bytes; 0: not known. */
uint64_t gis_peak_rss(void);
/* Sets up allocation; call it before anything is allocated. Large arrays are then taken from the system one by one, and
 * returned to it when they are freed. */
void gis_memory_begin(void);
/* Returns freed memory to the system, which the C library would keep. Call it between stages that allocate different
 * things. */
void gis_memory_back(void);

#endif
