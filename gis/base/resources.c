/* resources.c: see resources.h. The clock is POSIX's monotonic one, which cannot be set; memory is the kernel's count
 * for the process, as `time -v` prints it. */
#include "base/resources.h"

#include <stdlib.h> /* __GLIBC__ */
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

double gis_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

unsigned gis_threads(unsigned asked)
{
    const long there = sysconf(_SC_NPROCESSORS_ONLN);
    return asked ? asked : there > 0 ? (unsigned)there : 1;
}

uint64_t gis_peak_rss(void)
{
    struct rusage usage;
    if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#ifdef __APPLE__
    return (uint64_t)usage.ru_maxrss;
#else
    return (uint64_t)usage.ru_maxrss * 1024; /* in KiB on Linux and the BSDs */
#endif
}

/* The smallest size of arrays that are taken from the system one by one. By default glibc takes arrays of up to 32 MB
 * from the heap once one of that size was freed. There a freed array stays until another fits into it, and an array of
 * zeros must be written, whereas fresh pages cost nothing until they are touched. For a million features, whose arrays
 * have 8 MB and more, the heap would keep 17 MB, and 60 MB before gis_memory_back() existed. Smaller arrays are
 * allocated too often to be taken from the system: 110,000 pages would be made anew, 0.3 of 17 seconds. */
#define LARGE (8 << 20)

void gis_memory_begin(void)
{
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, LARGE);
    mallopt(M_TRIM_THRESHOLD, 2 * LARGE); /* the library's own ratio between the two */
#endif
}

void gis_memory_back(void)
{
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}
