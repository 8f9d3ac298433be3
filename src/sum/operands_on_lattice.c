/* operands_on_lattice.c: places both operands on one lattice, which becomes that of the sum. */
#include "sum/operands_on_lattice.h"

#include <string.h>

sunder_status sunder_i_sum_place(sunder_sum *sum, const sunder_shape *p, const sunder_shape *q, bool force_wide,
                                 sunder_i_placed *placed, sunder_error *err)
{
    const sunder_i_place_options how = {.force_wide = force_wide};
    const sunder_status status = sunder_i_place(p, q, &how, placed, err);
    if (status != SUNDER_OK) return status;
    sum->lattice = placed->lattice;
    memset(&placed->lattice, 0, sizeof placed->lattice);
    memcpy(sum->origin[0], placed->origin_p, sizeof sum->origin[0]);
    memcpy(sum->origin[1], placed->origin_q, sizeof sum->origin[1]);
    return SUNDER_OK;
}
