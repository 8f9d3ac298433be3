/* resources.h: what a run takes of time and of memory, and on how many threads it may. */
#ifndef GIS_RESOURCES_H
#define GIS_RESOURCES_H

#include <stdint.h>

/* Seconds of a clock that never goes back. */
double gis_clock(void);
/* The number of threads asked for; for 0 the number of processors. */
unsigned gis_threads(unsigned asked);
/* The greatest amount of memory that the process has held, in bytes; 0: the system does not say. */
uint64_t gis_peak_rss(void);
/* Before anything is allocated: large arrays come from the system one by one, and go back to it when they are freed. */
void gis_memory_begin(void);
/* Memory that was freed goes back to the system, as far as the C library would keep it: what comes next is of another
 * kind, and would be held beside it. */
void gis_memory_back(void);

#endif
