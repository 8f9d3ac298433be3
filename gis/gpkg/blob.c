/* blob.c: see blob.h. */
#include "gpkg/blob.h"

#include <ogr_core.h>
#include <stdint.h>
#include <string.h>

enum { HEAD = 8, VERSION = 2, FLAGS = 3, BOX_KINDS = 0x0e, EXTENDED = 0x20, POINT_BYTES = 16 };

/* The byte order of this machine. */
#ifdef CPL_LSB
static const unsigned char order = wkbNDR;
#else
static const unsigned char order = wkbXDR;
#endif

const unsigned char *gis_blob_geometry(const unsigned char *blob, size_t size, size_t *bytes)
{
    static const size_t box[] = {0, 32, 48, 48, 64};
    if (size < HEAD || memcmp(blob, "GP", VERSION) != 0 || blob[VERSION] != 0 || blob[FLAGS] & EXTENDED) return NULL;
    const size_t kind = (blob[FLAGS] & BOX_KINDS) >> 1;
    if (kind >= sizeof box / sizeof *box || size < HEAD + box[kind]) return NULL;
    *bytes = size - HEAD - box[kind];
    return blob + HEAD + box[kind];
}

/* The part of the well-known binary that was not read yet. */
typedef struct rest {
    const unsigned char *at, *end;
} rest;

static bool take_number(rest *r, uint32_t *n)
{
    if (r->end - r->at < (ptrdiff_t)sizeof *n) return false;
    memcpy(n, r->at, sizeof *n);
    r->at += sizeof *n;
    return true;
}

static bool pass_ring(rest *r)
{
    uint32_t n;
    if (!take_number(r, &n) || n == 0 || (size_t)(r->end - r->at) / POINT_BYTES < n) return false;
    r->at += (size_t)n * POINT_BYTES;
    return true;
}

static bool pass_polygonal(rest *r, bool part)
{
    uint32_t type, n;
    if (r->at == r->end || *r->at++ != order || !take_number(r, &type) || !take_number(r, &n) || n == 0) return false;
    if (type != wkbPolygon && (part || type != wkbMultiPolygon)) return false;
    bool good = true;
    for (; good && n > 0; n--) good = type == wkbPolygon ? pass_ring(r) : pass_polygonal(r, true);
    return good;
}

bool gis_blob_is_polygonal(const unsigned char *geometry, size_t bytes)
{
    rest r = {geometry, geometry + bytes};
    return pass_polygonal(&r, false) && r.at == r.end;
}
