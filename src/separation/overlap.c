/* overlap.c: tests whether the interiors of two sets meet. */
#include "separation/separation.h"

#include "separation/operands/pair_operands.h"

sunder_status sunder_i_overlap(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                               bool *overlap, sunder_error *err)
{
    if (p->pieces == 0 || q->pieces == 0 || sunder_i_boxes_apart(p, tp, q, tq, 0)) {
        *overlap = false;
        return SUNDER_OK;
    }
    sunder_i_operands g;
    const sunder_i_operands_options options = {.tp = tp, .tq = tq};
    sunder_status status = sunder_i_operands_init(&g, p, q, &options, err);
    if (status) return status;
    const bool answer = sunder_i_operands_overlap(&g);
    status = sunder_i_operands_end(&g, err);
    if (status == SUNDER_OK) *overlap = answer;
    return status;
}

sunder_status sunder_pair_overlap(const sunder_shape *p, const sunder_shape *q, bool *overlap, sunder_error *err)
{
    return sunder_i_overlap(p, NULL, q, NULL, overlap, err);
}
