/* digest.h: how a feature is reduced to two hashes (readback/digests.c explains the purpose): from a GDAL feature, from
 * a record of the source, or from a row that is read. */
#ifndef GIS_DIGEST_H
#define GIS_DIGEST_H

#include "write/sink/sink_internal.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

enum { GIS_MIX_START = 1, GIS_MIX_NOTHING, GIS_MIX_POLYGON, GIS_MIX_NO_VALUE, GIS_MIX_TEXT };

static inline uint64_t gis_mix(uint64_t so_far, uint64_t word)
{
    uint64_t h = (so_far ^ word) * 0x9E3779B97F4A7C15u; /* an odd constant with irregular bits: 2^64 over the golden
                                                         * ratio */
    return h ^ h >> 29;
}

/* Hashes a double. -0 counts as 0, since some formats store it so, and all NaNs count as one. */
static inline uint64_t gis_mix_double(uint64_t so_far, double x)
{
    uint64_t word;
    x = isnan(x) ? NAN : x + 0.0;
    memcpy(&word, &x, sizeof word);
    return gis_mix(so_far, word);
}

static inline uint64_t gis_mix_bytes(uint64_t so_far, const char *bytes, size_t n)
{
    for (; n >= 8; bytes += 8, n -= 8) {
        uint64_t word;
        memcpy(&word, bytes, 8);
        so_far = gis_mix(so_far, word);
    }
    uint64_t rest = 0;
    memcpy(&rest, bytes, n);
    return gis_mix(gis_mix(so_far, rest), n);
}

static inline uint64_t gis_mix_text(uint64_t so_far, const char *text, int width)
{
    size_t n = strlen(text);
    if (width > 0 && n > (size_t)width) /* a format may cut a text to `width` characters, and a character has at least
                                         * one byte */
        n = (size_t)width;
    return gis_mix_bytes(gis_mix(so_far, GIS_MIX_TEXT), text, n);
}

static inline uint64_t gis_mix_plain(uint64_t so_far, const gis_value *value, const gis_plain_field *as)
{
    switch (value->kind) {
    case GIS_TEXT: return gis_mix_text(so_far, value->as.text, as->width);
    case GIS_INTEGER: return gis_mix(so_far, (uint64_t)value->as.integer);
    case GIS_REAL:
        return isnan(value->as.real) ? gis_mix(so_far, GIS_MIX_NO_VALUE) : gis_mix_double(so_far, value->as.real);
    default: return gis_mix(so_far, GIS_MIX_NO_VALUE);
    }
}

/* The hashes of a GDAL feature. as_written: `feature` comes from the layer that is read back, else from the layer that
 * is written; this selects the field numbers. False: no memory. */
bool gis_digest_of(gis_digests *all, OGRFeatureH feature, GIntBig fid, bool as_written, gis_digest *out);

/* Compares the features that are read with those that were sent, one by one. Hashes of features that were read are
 * stored only from the first difference on. A zeroed struct is empty. */
typedef struct gis_digests_read {
    gis_digest *at; /* the hashes of all features read, once `differ` is true */
    size_t n, capacity;
    bool differ;
} gis_digests_read;

bool gis_digests_read_add(gis_digests_read *read, gis_digests *all, gis_digest one, gis_error *error);

/* Reads all rows of the layer through SQLite and adds their hashes to *read. Returns false with *read zeroed if a row
 * is not plain, SQLite is not available, or any error occurs; the caller then reads the layer with GDAL, which reports
 * the error. */
bool gis_read_rows(gis_sink_layer *layer, GDALDatasetH dataset, OGRLayerH as_written, gis_digests_read *read);

#endif
