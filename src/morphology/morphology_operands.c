/* morphology_operands.c: places P and B on one lattice, once for all stages of an operation. */
#include "morphology/morphology.h"

#include <string.h>

/* Returns a lattice with the same unit only: placing has left all vertices of P in the pool. */
static sunder_i_lattice empty_like(const sunder_i_lattice *from)
{
    return (sunder_i_lattice){.exponent = from->exponent, .scale = from->scale, .approx_shift = from->approx_shift};
}

static bool fill_operands(const sunder_shape *p, const sunder_shape *b, sunder_i_placed *placed,
                          sunder_i_morphology_operands *operands)
{
    memcpy(operands->origin_p, placed->origin_p, sizeof operands->origin_p);
    memcpy(operands->origin_q, placed->origin_q, sizeof operands->origin_q);
    sunder_i_lattice *l = &placed->lattice;
    operands->lattice = empty_like(l);
    return sunder_i_structuring_element_of_shape(l, b, placed->q, false, &operands->element) &&
           sunder_i_structuring_element_of_shape(l, b, placed->q, true, &operands->reflected) &&
           (p->form->cleaned.polygons > 1 || sunder_i_figure_of_shape(l, p, placed->p, &operands->figure));
}

sunder_status sunder_i_morphology_operands_make(const sunder_shape *p, const sunder_shape *b,
                                                sunder_i_morphology_operands *out, sunder_error *err)
{
    memset(out, 0, sizeof *out);
    sunder_i_placed placed;
    const sunder_i_place_options how = {.force_wide = true};
    sunder_status status = sunder_i_place(p, b, &how, &placed, err);
    if (status != SUNDER_OK) return status;
    if (!fill_operands(p, b, &placed, out)) status = sunder_i_failure_cause(err);
    sunder_i_placed_free(&placed);
    if (status != SUNDER_OK) sunder_i_morphology_operands_free(out);
    return status;
}

void sunder_i_morphology_operands_free(sunder_i_morphology_operands *operands)
{
    sunder_i_lattice_free(&operands->lattice);
    sunder_i_structuring_element_free(&operands->element);
    sunder_i_structuring_element_free(&operands->reflected);
    sunder_i_figure_free(&operands->figure);
}

sunder_sum *sunder_i_morphology_operands_sum(const sunder_i_morphology_operands *operands, int moved)
{
    sunder_sum *sum = sunder_i_calloc(1, sizeof *sum);
    if (!sum) return NULL;
    sum->lattice = empty_like(&operands->lattice);
    sum->method.algorithm = SUNDER_ALGORITHM_INCREMENTAL;
    for (int k = 0; k < 2; k++) {
        sum->origin[0][k] = operands->origin_p[k];
        sum->origin[1][k] = moved ? moved * operands->origin_q[k] : 0;
    }
    if (!sum->lattice.arena.failed) return sum;
    sunder_sum_free(sum);
    return NULL;
}
