/* legibility.c: the parts of a shape that are below a limit, one after the other. */
#include "legibility/legibility.h"

#include <math.h>

const char *sunder_illegible_kind_string(sunder_illegible_kind kind)
{
    static const char *const word[SUNDER_ILLEGIBLE_KINDS] = {"narrow", "small", "neck", "inner_gap", "short_edge"};
    return (unsigned)kind < SUNDER_ILLEGIBLE_KINDS ? word[kind] : "";
}

typedef struct findings {
    sunder_illegible *item;
    size_t n, capacity;
} findings;

static sunder_status add(findings *all, const sunder_illegible *one, bool found, sunder_error *err)
{
    if (!found) return SUNDER_OK;
    if (!sunder_i_reserve(&all->item, &all->capacity, all->n + 1, sizeof *one)) return sunder_i_failure_cause(err);
    all->item[all->n++] = *one;
    return SUNDER_OK;
}

static double limit_of(const sunder_legible_limits *limits, sunder_illegible_kind kind)
{
    const double limit[SUNDER_ILLEGIBLE_KINDS] = {limits->width, limits->area, limits->neck, limits->inner_gap,
                                                  limits->edge};
    return limit[kind];
}

/* Measures what a kind asks of a part. */
static sunder_status measure(sunder_i_part_read *part, sunder_illegible_kind kind, double limit, findings *all,
                             sunder_error *err)
{
    sunder_illegible one = {.kind = kind, .polygon = part->polygon, .required = limit};
    sunder_status status = SUNDER_OK;
    bool found = false;
    switch (kind) {
    case SUNDER_ILLEGIBLE_NARROW: status = sunder_i_part_width(part, limit, &found, &one, err); break;
    case SUNDER_ILLEGIBLE_SMALL: sunder_i_part_area(part, limit, &found, &one); break;
    case SUNDER_ILLEGIBLE_NECK: status = sunder_i_part_links(part, true, limit, &found, &one, err); break;
    case SUNDER_ILLEGIBLE_INNER_GAP: status = sunder_i_part_links(part, false, limit, &found, &one, err); break;
    case SUNDER_ILLEGIBLE_SHORT_EDGE: sunder_i_part_edges(part, limit, &found, &one); break;
    }
    if (!status && part->placed.lattice.arena.failed) status = sunder_i_failure_cause(err);
    return status ? status : add(all, &one, found, err);
}

static sunder_status measure_part(sunder_i_part_read *part, size_t polygon, const sunder_legible_limits *limits,
                                  findings *all, sunder_error *err)
{
    const bool links = limits->neck > 0 || limits->inner_gap > 0;
    sunder_i_part_select(part, polygon);
    sunder_status status = links ? sunder_i_part_build_tree(part, err) : SUNDER_OK;
    for (sunder_illegible_kind kind = 0; !status && kind < SUNDER_ILLEGIBLE_KINDS; kind++)
        if (limit_of(limits, kind) > 0) status = measure(part, kind, limit_of(limits, kind), all, err);
    if (links) sunder_i_rtree_free(&part->tree);
    part->tree = (sunder_i_rtree){0};
    return status;
}

/* ---- The shape --------------------------------------------------------------------------------------------------- */

static sunder_status check_limits(const sunder_legible_limits *limits, sunder_error *err)
{
    for (sunder_illegible_kind kind = 0; kind < SUNDER_ILLEGIBLE_KINDS; kind++)
        if (!(limit_of(limits, kind) >= 0 && limit_of(limits, kind) < INFINITY))
            return sunder_i_fail(err, SUNDER_EARG, "the limit for %s must be finite and not negative",
                                 sunder_illegible_kind_string(kind));
    return SUNDER_OK;
}

sunder_status sunder_shape_illegible(const sunder_shape *shape, const sunder_legible_limits *limits,
                                     sunder_illegible **found, size_t *n, sunder_error *err)
{
    if (!shape || !limits || !found || !n) return sunder_i_fail(err, SUNDER_EARG, "a pointer is NULL");
    sunder_i_part_read part = {.shape = shape};
    findings all = {0};
    sunder_status status = check_limits(limits, err);
    if (!status && shape->vertices) {
        status = sunder_i_place(shape, NULL, NULL, &part.placed, err);
        if (status) return status;
        sunder_i_lattice_admit_ratios(&part.placed.lattice);
        for (size_t p = 0; !status && p < shape->form->cleaned.polygons; p++)
            status = measure_part(&part, p, limits, &all, err);
        sunder_i_placed_free(&part.placed);
    }
    if (status) {
        sunder_i_free(all.item);
        return status;
    }
    *found = all.item;
    *n = all.n;
    return SUNDER_OK;
}
