/* resources.c: see resources.h. The clock is POSIX's monotonic one, which cannot be set; the memory is the kernel's own
 * account of the process, as printed by `time -v`. */
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
    return (uint64_t)usage.ru_maxrss * 1024; /* Linux and the BSDs count in KiB */
#endif
}

/* Left to itself the C library takes arrays of up to 32 MB out of the heap once one as large was freed. There a hole
 * is kept until another array fits into it, and an array of zeros is written to, all of it, where pages that are fresh
 * cost nothing until they are touched. For a million features, whose arrays have 8 MB and more, that is 17 MB, and was
 * 60 while nothing went back before the end. Smaller ones come and go: from the system each time, 110,000
 * pages of theirs are made anew, 0.3 seconds of 17. */
#define LARGE (8 << 20)

void gis_memory_begin(void)
{
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, LARGE);
    mallopt(M_TRIM_THRESHOLD, 2 * LARGE); /* as the library has it beside the other */
#endif
}

void gis_memory_back(void)
{
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}
