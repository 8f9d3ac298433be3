/* checksum.h: a checksum that detects changed bytes. */
#ifndef GIS_CHECKSUM_H
#define GIS_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Continues a checksum (0: begins one) with n bytes, eight at a time. Multiplication by an odd number and xor with a
 * shifted value are both invertible, so a change within one group of eight bytes is always detected. */
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
