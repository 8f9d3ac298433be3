/* digests.c: verifies written layers by reading them back, for formats that keep every value exactly.
 *
 * In such formats a feature that reads back equals the feature that was sent, double for double, but the order of
 * features may differ. Each feature is reduced to two 64-bit hashes when it is sent (one of geometry and FID, one of
 * values), and again when it is read; both lists are sorted and compared. Counts in headers are not trusted, and no
 * copy of the geometries is kept. The hashes need not be cryptographic, since there is no adversary: for each pair of
 * features, the probability that a damaged feature has the hash of another is 2^-64. */
#include "write/sink/digest.h"

#include "base/interrupt.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Fields whose values must come back -------------------------------------------------------------------------- */

/* Finds the fields in the layer that is read back. If a field is missing or has another type, values cannot be compared
 * (values_comparable = false); losses.c reports the change. */
static void find_fields(gis_digests *all, OGRLayerH as_written)
{
    OGRFeatureDefnH definition = OGR_L_GetLayerDefn(as_written);
    for (size_t i = 0; i < all->n_fields; i++) {
        gis_plain_field *field = &all->fields[i];
        field->read = gis_sink_field_index(definition, field->name);
        if (field->read < 0 || OGR_Fld_GetType(OGR_FD_GetFieldDefn(definition, field->read)) != field->type)
            all->values_comparable = false;
    }
}

/* ---- Both lists -------------------------------------------------------------------------------------------------- */

static int order_digests(const void *a, const void *b)
{
    const gis_digest *p = a, *q = b;
    if (p->place != q->place) return p->place < q->place ? -1 : 1;
    return (p->values > q->values) - (p->values < q->values);
}

/* The number of elements of `sent` that are not in `read`. Both have n elements, are sorted, and may have repeats.
 * values: compare `values` too, not only `place`. */
static size_t count_missing(const gis_digest *sent, const gis_digest *read, size_t n, bool values)
{
    size_t count = 0;
    for (size_t i = 0, k = 0; i < n;) {
        int way = k == n                           ? -1
                  : sent[i].place != read[k].place ? (sent[i].place < read[k].place ? -1 : 1)
                  : values                         ? order_digests(&sent[i], &read[k])
                                                   : 0;
        count += way < 0;
        i += way <= 0;
        k += way >= 0;
    }
    return count;
}

static bool compare_digests(gis_sink_layer *layer, const gis_digests_read *as_read, gis_error *error)
{
    gis_sink *sink = layer->sink;
    gis_digests *all = &layer->digests;
    if (!all->wanted) /* a format that keeps nothing exactly: only the number of features was checked */
        return true;
    if (!as_read->differ) return true;
    const size_t n = all->sent.n;
    gis_digest *read = as_read->at;
    if (!gis_digest_list_hold(&all->sent, n, error)) return false;
    if (n) { /* with n = 0 both arrays are NULL */
        qsort(all->sent.at, n, sizeof *read, order_digests);
        qsort(read, n, sizeof *read, order_digests);
    }
    size_t lost = count_missing(all->sent.at, read, n, false);
    size_t changed = lost || !all->values_comparable ? 0 : count_missing(all->sent.at, read, n, true);
    if (!lost && changed && !sink->format.keeps_values) {
        gis_sentences_add(&sink->losses, "layer %s: the values of %zu features do not read back as they were written",
                          layer->name, changed);
        return true;
    }
    return !(lost || changed) ||
           gis_fail(error, "%s, layer %s: %zu of %zu features do not read back as they were written; is the disk full?",
                    sink->request.path, layer->name, lost ? lost : changed, n);
}

/* Reads and decodes every feature of the layer; errors that the driver reports meanwhile make it fail. */
static bool read_back(gis_sink_layer *layer, OGRLayerH as_written, gis_digests_read *read, gis_error *error)
{
    gis_digests *all = &layer->digests;
    size_t with_z = 0;
    bool done = true;
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    OGR_L_ResetReading(as_written);
    for (OGRFeatureH feature; done && (feature = OGR_L_GetNextFeature(as_written)) != NULL; OGR_F_Destroy(feature)) {
        gis_digest one;
        OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
        with_z += geometry && OGR_G_Is3D(geometry);
        done = gis_go_on(error) &&
               (gis_digest_of(all, feature, OGR_F_GetFID(feature), true, &one) || gis_no_memory(error)) &&
               gis_digests_read_add(read, all, one, error);
    }
    OGR_L_ResetReading(as_written); /* otherwise a database would keep the table open */
    gis_listen_end();
    if (done && listener.failures)
        done = gis_sink_fail_reading(layer, read->n, gis_listener_reason(&listener, "no reason given"), error);
    else if (done && read->n != layer->written)
        done = gis_sink_fail_count(layer, read->n, error);
    if (done && with_z < all->with_z && gis_sink_tells(layer))
        gis_sentences_add(&layer->sink->losses, "Z values are not written: %s has none", layer->sink->format.name);
    gis_listener_clear(&listener);
    return done;
}

bool gis_digests_agree(gis_sink_layer *layer, GDALDatasetH dataset, OGRLayerH as_written, gis_error *error)
{
    gis_digests_read read = {0};
    layer->digests.values_comparable = true;
    find_fields(&layer->digests, as_written);
    bool done = (gis_read_rows(layer, dataset, as_written, &read) || read_back(layer, as_written, &read, error)) &&
                (layer->written == 0 || compare_digests(layer, &read, error));
    free(read.at);
    return done;
}
