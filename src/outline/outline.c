/* outline.c: lines, cells, coverage and boundary, one after the other; README.md explains why the boundary is found in
 * this way.
 *
 * Why line by line? The outline of a union of convex parts is usually computed in one of three other ways.
 *
 *   - An arrangement of all sides, with marks on the faces that a part covers (../unions/arrangement.c). It computes
 *     every crossing, also those deep inside the union: more than a million for two stars of 100 vertices, whose sum
 *     has 304.
 *   - Incremental: one part at a time is added to the map of the union so far (../unions/incremental.c), or unions are
 *     united in pairs (../unions/divide.c, GEOS). Few crossings are computed in vain, but the map is searched, divided
 *     and repaired at each step, and the time depends on the order.
 *   - A sweep, as in Clipper, keeps the sides that cross the sweep line. It computes all crossings, too, and must sort
 *     them against each other.
 *
 * Here the unit of work is the line. An edge of the outline is on the line of a side. Along one line a part covers an
 * interval, whose ends are crossings with two sides of that part. The ends are sorted and counted, and the counts show
 * what is covered; no line needs the result of another one. This has three consequences. Numbers stay short: a crossing
 * is compared only with crossings on the same line, in degree 4, and no crossing of crossings is computed. Degenerate
 * holes are found by the same counts as edges (coverage.c); a regularised union of faces loses them. What a single part
 * covers is discarded before anything is sorted (culling.c), so that most crossings are never computed.
 *
 * The weakness is a stretch that many parts cover together, but none of them alone: all of their ends are sorted there.
 * Where houses stand wall to wall there are many such stretches: dissolved buffers of Paris are 1.7 times as fast as
 * those of GEOS, the least ratio in the record (tests/bench/BUFFERS.md).
 *
 * Measured for the two stars (tests/bench/paper/paper.csv, ddbed78): 5,642 crossings and 5.7 ms line by line; 1,232,505
 * and 2.86 s by the arrangement; 2,940 and 22 ms incrementally in random order. tests/property/test_unions_random.c
 * compares the bytes of the results. */
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
