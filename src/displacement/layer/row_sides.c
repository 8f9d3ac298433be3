/* The rule of rows: neighbours in a row keep their order along it. It is one half-plane of their relative move,
 * whatever their shapes. */
#include "displacement/layer/model.h"

#include "sunder_parts.h"

#include <math.h>

const sunder_i_row_side *sunder_i_row_side_of(const sunder_i_model *model, const sunder_i_body *body, uint32_t other)
{
    const sunder_i_row_side *side = model->row_side + body->has->row_side;
    for (uint32_t k = 0; k < body->has->row_sides; k++)
        if (side[k].other == other) return &side[k];
    return NULL;
}

/* Adds a product of two doubles to the sum, without rounding. */
static void add_product(sunder_total *sum, double a, double b)
{
    const double product = a * b;
    sunder_total_add(sum, product);
    sunder_total_add(sum, fma(a, b, -product));
}

bool sunder_i_keeps_row(const sunder_i_row_side *side, const double t[2], const double s[2], double least)
{
    /* In doubles the value has an error of a few units of its terms. */
    const double value = (s[0] - t[0]) * side->along[0] + (s[1] - t[1]) * side->along[1] - least,
                 size = fabs(s[0]) + fabs(t[0]) + fabs(s[1]) + fabs(t[1]) + fabs(least);
    if (fabs(value) > 0x1p-50 * size) return value > 0;
    sunder_total sum = {0};
    for (int c = 0; c < 2; c++) {
        add_product(&sum, s[c], side->along[c]);
        add_product(&sum, -t[c], side->along[c]);
    }
    sunder_total_add(&sum, -least);
    return sunder_total_nearest(&sum) >= 0;
}
