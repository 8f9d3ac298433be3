/* checksum.h: a number that tells whether bytes are what they were. */
#ifndef GIS_CHECKSUM_H
#define GIS_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Goes on from a checksum (0: from none), by eight bytes at a time: a multiplication with an odd number and a shift are
 * each one to one, so a change of eight bytes alone always shows. */
static inline uint64_t gis_checksum_of(uint64_t checksum, const void *bytes, size_t n)
{
    const unsigned char *at = bytes;
    for (size_t left = n; left > 0;) {
        const size_t part = left < sizeof(uint64_t) ? left : sizeof(uint64_t);
        uint64_t word = 0;
        memcpy(&word, at, part);
        checksum = (checksum ^ word) * UINT64_C(0x9e3779b97f4a7c15);
        checksum ^= checksum >> 29;
        at += part;
        left -= part;
    }
    checksum = (checksum ^ n) * UINT64_C(0xbf58476d1ce4e5b9);
    return checksum ^ checksum >> 32;
}

#endif
