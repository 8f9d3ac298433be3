/* barrier_transform.c: barriers in another CRS than the layer's. Vertices are transformed, and edges between them are
 * straight in the layer's CRS; the resulting doubles are the barrier. */
#include "layer/barriers/barrier.h"

#include "base/message.h"

#include <math.h>

bool gis_barrier_transformation(OGRSpatialReferenceH from, OGRSpatialReferenceH to, const char *who,
                                OGRCoordinateTransformationH *out, gis_error *error)
{
    *out = NULL;
    bool known = gis_crs_is_known(from), layer_known = gis_crs_is_known(to);
    if (known != layer_known)
        gis_say_warning(GIS_MESSAGE_CRS, "%s: %s; its coordinates are taken as those of the layer", who,
                        known ? "the layer has no CRS to transform it to" : "it has no CRS");
    if (!known || !layer_known || OSRIsSame(from, to)) return true;
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    *out = OCTNewCoordinateTransformation(from, to);
    gis_listen_end();
    if (!*out)
        gis_fail(error, "%s: its CRS cannot be transformed to the layer's: %s", who,
                 gis_listener_reason(&listener, "no reason given"));
    gis_listener_clear(&listener);
    return *out != NULL;
}

/* Number of points that are transformed along each side of the box, and the fraction of its size by which the result is
 * enlarged. Between two such points an edge bends by much less, unless the box is far larger than a map sheet; and then
 * PROJ fails somewhere. */
enum { ALONG = 32 };
static const double grown_by = 0.1;

bool gis_barrier_box(const double box[4], OGRSpatialReferenceH of_layer, OGRSpatialReferenceH other, double out[4])
{
    OGRCoordinateTransformationH back = OCTNewCoordinateTransformation(of_layer, other);
    bool ok = back != NULL;
    out[0] = out[1] = INFINITY;
    out[2] = out[3] = -INFINITY;
    for (int i = 0; ok && i < 4 * ALONG; i++) {
        double s = (double)(i % ALONG) / ALONG;
        double x = i / ALONG == 0 ? s : i / ALONG == 1 ? 1 : i / ALONG == 2 ? 1 - s : 0;
        double y = i / ALONG == 0 ? 0 : i / ALONG == 1 ? s : i / ALONG == 2 ? 1 : 1 - s;
        x = box[0] + x * (box[2] - box[0]);
        y = box[1] + y * (box[3] - box[1]);
        ok = OCTTransform(back, 1, &x, &y, NULL) && isfinite(x) && isfinite(y);
        out[0] = fmin(out[0], x), out[1] = fmin(out[1], y);
        out[2] = fmax(out[2], x), out[3] = fmax(out[3], y);
    }
    if (back) OCTDestroyCoordinateTransformation(back);
    double grow = grown_by * fmax(out[2] - out[0], out[3] - out[1]);
    for (int k = 0; k < 4; k++) out[k] += k < 2 ? -grow : grow;
    /* the box may extend across the antimeridian */
    return ok && !(OSRIsGeographic(other) && (out[0] < -180 || out[2] > 180));
}
