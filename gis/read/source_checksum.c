/* source_checksum.c: see source_checksum.h. Geometries are taken as well-known binary in the machine's byte order, as
 * they are packed. */
#include "read/source_checksum.h"

#include "base/array.h"
#include "base/interrupt.h"
#include "disk/checksum.h"

#include <cpl_port.h>
#include <stdlib.h>

typedef struct checking {
    const gis_source *source;
    int *none; /* a map in which no field is requested */
    unsigned char *bytes;
    size_t room;
} checking;

static bool geometry_checksum(checking *c, size_t i, uint64_t *checksum, gis_error *error)
{
    const unsigned char *packed;
    size_t n = 0;
    if (gis_source_plain(c->source, i, 0, 0, c->none, NULL, &packed, &n)) {
        if (!packed) return gis_no_memory(error);
        *checksum = gis_checksum_of(*checksum, packed, n);
        return true;
    }
    OGRGeometryH geometry = gis_source_geometry(c->source, i);
    if (geometry) {
        n = OGR_G_WkbSizeEx(geometry);
        if (!gis_array_reserve(&c->bytes, &c->room, n + 1, 1)) return gis_no_memory(error);
        if (OGR_G_ExportToIsoWkb(geometry, CPL_IS_LSB ? wkbNDR : wkbXDR, c->bytes) != OGRERR_NONE)
            return gis_fail(error, "layer %s: a geometry has no well-known binary", gis_source_name(c->source));
    }
    *checksum = gis_checksum_of(*checksum, c->bytes, n);
    return true;
}

bool gis_source_checksum(const gis_source *source, uint64_t *checksum, gis_error *error)
{
    const int fields = OGR_FD_GetFieldCount(OGR_L_GetLayerDefn(gis_source_layer(source)));
    checking c = {.source = source, .none = malloc(((size_t)fields + 1) * sizeof *c.none)};
    bool done = c.none || gis_no_memory(error);
    for (int f = 0; done && f < fields; f++) c.none[f] = -1;
    for (size_t i = 0; done && i < gis_source_count(source); i++) {
        const GIntBig fid = gis_source_fid(source, i);
        *checksum = gis_checksum_of(*checksum, &fid, sizeof fid);
        done = geometry_checksum(&c, i, checksum, error) && gis_go_on(error);
    }
    free(c.none);
    free(c.bytes);
    return done;
}
