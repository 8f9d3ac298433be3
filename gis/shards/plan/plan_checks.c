/* plan_checks.c: see plan.h. The spool verifies its own files, cell by cell; here it is checked that each file belongs
 * to this plan. */
#include "shards/plan/plan.h"

#include "disk/checksum.h"
#include "disk/file.h"

#include <stdlib.h>

enum { PIECE = 1 << 16 };

bool gis_plan_status_checksum(const char *directory, uint64_t *checksum, gis_error *error)
{
    gis_disk_file file = {0};
    unsigned char piece[PIECE];
    *checksum = 0;
    bool done = gis_disk_file_open(&file, directory, "status", error);
    for (uint64_t at = 0; done && at < file.size; at += PIECE) {
        const size_t n = file.size - at < PIECE ? (size_t)(file.size - at) : PIECE;
        done = gis_disk_file_read(&file, at, piece, n, error) && gis_go_on(error);
        if (done) *checksum = gis_checksum_of(*checksum, piece, n);
    }
    gis_disk_file_close(&file);
    return done;
}

/* Fails if the layer's feature count differs from that of its files: `status` has the same number of bytes for each
 * feature, and the spool must not have more features. */
static bool holds_all(const gis_shard_run *parts, gis_error *error)
{
    gis_disk_file file = {0};
    const bool opened = gis_disk_file_open(&file, parts->directory, "status", error);
    const bool same = opened &&
                      file.size == parts->facts.source.features * gis_layer_status_bytes(&parts->request->rules) &&
                      gis_spool_features(parts->spool) <= parts->facts.source.features;
    gis_disk_file_close(&file);
    return same || !opened
               ? same
               : gis_fail(error,
                          "%s: the plan is for %zu features, but its files are for another number; make the plan anew",
                          parts->directory, parts->facts.source.features);
}

bool gis_plan_check(const gis_plan *plan, const gis_shard_run *parts, bool status, gis_error *error)
{
    uint64_t now;
    if (!holds_all(parts, error)) return false;
    if (gis_spool_checksum(parts->spool) != plan->spool)
        return gis_fail(error, "%s: features and cells are not those of this plan; make it anew", parts->directory);
    if (!status) return true;
    if (!gis_plan_status_checksum(parts->directory, &now, error)) return false;
    return now == plan->status || gis_fail(error, "%s/status: it was altered; make the plan anew", parts->directory);
}
