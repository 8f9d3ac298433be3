/* operands.c: see operands.h. Data sources are read before texts, since their CRS defines the units of lengths in the
 * other operand. */
#include "sum/operands.h"

#include "geometry/wkt.h"
#include "read/crs_units.h"
#include "read/source_files.h"

#include <stdlib.h>
#include <string.h>

static bool check_crs(const gis_operands *operands, gis_error *error)
{
    OGRSpatialReferenceH p = operands->p_source ? gis_source_crs(operands->p_source) : NULL;
    OGRSpatialReferenceH q = operands->q_source ? gis_source_crs(operands->q_source) : NULL;
    return gis_crs_may_be_same(p, q) || gis_fail(error, "P and Q have different CRSs; reproject one of them first");
}

/* Returns the SRID of an operand: the code of EPSG of a source's CRS, or the SRID before WKT; 0 if there is none. */
static int srid_of(const char *text, const gis_source *source)
{
    OGRSpatialReferenceH crs = source ? gis_source_crs(source) : NULL;
    const char *authority = crs ? OSRGetAuthorityName(crs, NULL) : NULL;
    int srid;
    if (!source) {
        gis_wkt_after_srid(text, &srid);
        return srid;
    }
    return authority && strcmp(authority, "EPSG") == 0 ? atoi(OSRGetAuthorityCode(crs, NULL)) : 0;
}

static bool check_srids(const gis_operands_request *request, const gis_operands *operands, gis_error *error)
{
    const int p = srid_of(request->text[0], operands->p_source), q = srid_of(request->text[1], operands->q_source);
    return p == 0 || q == 0 || p == q ||
           gis_fail(error, "P has the SRID %d and Q the SRID %d; transform one of them first", p, q);
}

bool gis_operands_read(const gis_operands_request *request, gis_operands *out, gis_error *error)
{
    static const char *const names[2] = {"P", "Q"};
    gis_operands read = {0};
    sunder_shape **shape[2] = {&read.p, &read.q};
    gis_source **source[2] = {&read.p_source, &read.q_source};
    bool ok = true;
    for (int i = 0; ok && i < 2; i++) {
        if (gis_shape_is_text(request->text[i])) continue;
        gis_source_request selected = request->source;
        selected.path = request->text[i];
        ok = gis_shape_from_source(&selected, request->invalid, names[i], source[i], shape[i], &read.building, error);
        if (ok && !gis_crs_is_known(read.crs)) read.crs = gis_source_crs(*source[i]);
    }
    ok = ok && check_crs(&read, error) && check_srids(request, &read, error);
    read.units = gis_crs_units_of(read.crs, request->scale);
    for (int i = 0; ok && i < 2; i++)
        if (!*source[i])
            ok = gis_shape_from_text(request->text[i], names[i], &read.units, request->invalid, shape[i],
                                     &read.building, error);
    if (ok)
        *out = read;
    else
        gis_operands_clear(&read);
    return ok;
}

const gis_source *gis_operands_source(const gis_operands *operands)
{
    return operands->p_source ? operands->p_source : operands->q_source;
}

bool gis_operands_spare(const gis_operands *operands, const char *output, bool update, gis_error *error)
{
    return gis_source_spare(operands->p_source, output, update, error) &&
           gis_source_spare(operands->q_source, output, update, error);
}

void gis_operands_clear(gis_operands *operands)
{
    sunder_shape_free(operands->p);
    sunder_shape_free(operands->q);
    gis_source_close(operands->p_source);
    gis_source_close(operands->q_source);
    *operands = (gis_operands){0};
}
