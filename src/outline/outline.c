/* Lines, cells, coverage, boundary, one after the other; README.md tells why the boundary is found so. */
#include "outline/outline.h"

#include "outline/boundary.h"
#include "outline/culling.h"

typedef struct finder {
    const sunder_i_convex_pieces *parts;
    const sunder_sum_options *options;
    sunder_status (*keep)(sunder_i_coverage *coverage, void *user, sunder_error *err);
    void *user;
    sunder_sum *sum;
} finder;

static sunder_status find_along(const finder *f, const sunder_i_lines *lines, sunder_error *err)
{
    sunder_i_culled culled;
    sunder_i_coverage coverage;
    sunder_status status = sunder_i_cull(f->parts, lines, f->options, &culled, err);
    if (status != SUNDER_OK) return status;
    status = sunder_i_coverage_find(f->parts, lines, &culled, &coverage, err);
    sunder_i_culled_free(&culled);
    if (status != SUNDER_OK) return status;
    if (f->keep) status = f->keep(&coverage, f->user, err);
    if (status == SUNDER_OK)
        status = sunder_i_boundary_build(f->parts->lattice, f->parts->classes, lines, &coverage, f->sum, err);
    sunder_i_coverage_free(&coverage);
    return status;
}

sunder_status sunder_i_outline_find(const sunder_i_convex_pieces *parts, const sunder_sum_options *options,
                                    sunder_status (*keep)(sunder_i_coverage *coverage, void *user, sunder_error *err),
                                    void *user, sunder_sum *sum, sunder_error *err)
{
    const finder f = {parts, options, keep, user, sum};
    sunder_i_lines lines;
    sunder_status status = sunder_i_lines_group(parts, &lines, err);
    if (status != SUNDER_OK) return status;
    status = find_along(&f, &lines, err);
    sunder_i_lines_free(&lines);
    return status;
}
