/* resources.c: see resources.h. The clock is POSIX's monotonic one, which nobody sets; the memory is the kernel's own
 * account of the process, the same that `time -v` prints. */
#include "base/resources.h"

#include <stdlib.h> /* __GLIBC__ */
#include <sys/resource.h>
#include <time.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

double gis_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

uint64_t gis_peak_rss(void)
{
    struct rusage usage;
    if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#ifdef __APPLE__
    return (uint64_t)usage.ru_maxrss;
#else
    return (uint64_t)usage.ru_maxrss * 1024; /* Linux and the BSDs count in KiB */
#endif
}

void gis_memory_back(void)
{
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}
