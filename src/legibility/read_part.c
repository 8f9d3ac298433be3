/* read_part.c: one part of a shape, its edges in a tree, and the comparison of a length with a limit. */
#include "legibility/legibility.h"

#include <string.h>

bool sunder_i_distance_below(sunder_i_lattice *lattice, sunder_i_big num, sunder_i_big den, double limit)
{
    sunder_i_arena *m = &lattice->scratch;
    int exponent;
    const sunder_i_big least = sunder_i_big_double(m, limit, &exponent);
    const long shift = 2 * (lattice->exponent - exponent);
    sunder_i_big right = sunder_i_big_mul(m, sunder_i_big_mul(m, least, least), den);
    if (shift > 0) num = sunder_i_big_shl(m, num, (unsigned long)shift);
    if (shift < 0) right = sunder_i_big_shl(m, right, (unsigned long)-shift);
    return sunder_i_big_cmp(num, right) < 0;
}

void sunder_i_part_edge_box(const sunder_i_part_read *part, uint32_t v, double box[4])
{
    double exact[4];
    sunder_i_box_of_segment(sunder_i_part_xy(part, v), sunder_i_part_xy(part, sunder_i_part_next(part, v)), exact);
    if (part->shape->rational)
        sunder_i_box_grow(exact, 0, box); /* corners are rounded to the nearest doubles */
    else
        memcpy(box, exact, sizeof exact);
}

void sunder_i_part_select(sunder_i_part_read *part, size_t polygon)
{
    const sunder_i_cleaned *c = &part->shape->form->cleaned;
    const uint32_t last = c->poly_end[polygon], ring = polygon ? c->poly_end[polygon - 1] : 0;
    part->polygon = polygon;
    part->first = ring ? c->ring_end[ring - 1] : 0;
    part->n = c->ring_end[last - 1] - part->first;
    sunder_i_box_clear(part->box);
    for (uint32_t k = 0; k < part->n; k++) sunder_i_box_include(part->box, sunder_i_part_xy(part, part->first + k));
}

sunder_status sunder_i_part_build_tree(sunder_i_part_read *part, sunder_error *err)
{
    double *box = sunder_i_alloc(4 * (size_t)part->n, sizeof *box);
    if (!box) return sunder_i_failure_cause(err);
    for (uint32_t k = 0; k < part->n; k++) sunder_i_part_edge_box(part, part->first + k, box + 4 * (size_t)k);
    const sunder_status status = sunder_i_rtree_build(box, NULL, part->n, &part->tree, err);
    sunder_i_free(box);
    return status;
}
