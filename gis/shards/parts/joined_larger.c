/* joined_larger.c: see join.h. Lists the features that became larger before the separation; a feature that is in no
 * world has no row, and is not of its own shape all the same. */
#include "shards/parts/join.h"

#include "base/array.h"
#include "base/core_error.h"

typedef struct listing {
    gis_sorted_results *to;
    gis_part_result one;
} listing;

static bool fill_larger(gis_part_result *one, const gis_spool_feature *feature, const sunder_shape *given,
                        gis_error *error)
{
    const sunder_shape *shape = feature->demands.shape;
    gis_part_row row = {.index = feature->index, .fid = feature->fid, .id = GIS_NO_TEXT};
    double centre[2], radius;
    sunder_error why;
    if (sunder_shape_largest_disc(shape, centre, &radius, &why) != SUNDER_OK)
        return gis_core_failed(error, "sunder_siz", &why);
    row.lost = 1 - sunder_shape_area(shape) / sunder_shape_area(given);
    row.size = 2 * radius;
    gis_part_result_empty(one);
    if (!gis_part_add_shape(one, shape, &row.now, error) || !GIS_PART_MORE(one, row, rows, 1, error)) return false;
    one->row[one->rows++] = row;
    return true;
}

static bool list_feature(void *user, const gis_spool_feature *feature, gis_error *error)
{
    listing *l = user;
    sunder_shape *given = NULL;
    const bool larger = feature->given.polygons > 0;
    const bool done = !larger || (gis_spool_rings_shape(&feature->given, &given, error) &&
                                  fill_larger(&l->one, feature, given, error) &&
                                  gis_sorted_results_add(l->to, feature->index, 0, &l->one, error));
    sunder_shape_free(given);
    sunder_shape_free((sunder_shape *)feature->demands.shape);
    return done;
}

static bool keep_all(void *user, const gis_sort_head *head, const gis_part_result *one, bool *keep, gis_error *error)
{
    (void)user, (void)head, (void)one, (void)error;
    *keep = true;
    return true;
}

bool gis_joined_larger_make(gis_joined *joined, gis_spool *spool, const char *directory, gis_error *error)
{
    listing l = {.to = &joined->larger};
    bool done = gis_sorted_results_begin(l.to, directory, "larger", error);
    for (size_t k = 0; k < gis_spool_cells(spool) && done; k++)
        done = gis_spool_read(spool, k, list_feature, &l, error);
    gis_part_result_clear(&l.one);
    return done && gis_sorted_results_sort(l.to, keep_all, NULL, error);
}
