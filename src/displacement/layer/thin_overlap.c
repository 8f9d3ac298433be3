/* Is an overlap at most the tolerance? Two measures are tested: the least translation that separates the two features,
 * and the disc that fits into their intersection. For two that interlock, such as a house in the notch of another, the
 * translation is as long as the notch is deep, however thin the overlap is. The translation is tested first, since that
 * is usually cheaper. Before the erosion is computed, a place where the disc may fit is proposed in doubles and tested
 * exactly; thick overlaps have one. */
#include "displacement/layer/relate.h"

#include "morphology/morphology.h"
#include "separation/separation.h"

enum { DISC_CORNERS = 16 };

static sunder_status fits_where_proposed(const sunder_i_translate *a, const sunder_i_translate *b,
                                         const sunder_shape *disc, double radius, bool *fits, sunder_error *err)
{
    double place[2];
    *fits = false;
    sunder_status status = sunder_i_roomy_place(a, b, radius, fits, place, err);
    if (!status && *fits) status = sunder_i_contained(disc, place, a->shape, a->t, fits, err);
    if (!status && *fits) status = sunder_i_contained(disc, place, b->shape, b->t, fits, err);
    return status;
}

sunder_status sunder_i_thin_disc(double tolerance, sunder_shape **disc, sunder_error *err)
{
    *disc = NULL;
    return tolerance / 2 > 0 ? sunder_shape_disc(tolerance / 2, DISC_CORNERS, true, disc, err) : SUNDER_OK;
}

sunder_status sunder_i_overlap_is_thin(const sunder_i_translate *a, const sunder_i_translate *b, double tolerance,
                                       const sunder_shape *disc, bool *thin, sunder_error *err)
{
    *thin = false;
    if (!(tolerance > 0)) return SUNDER_OK;
    sunder_separation least;
    bool beyond = false, fits;
    sunder_status status = sunder_i_separate(a->shape, a->t, b->shape, b->t, 0, tolerance, &least, &beyond, err);
    if (status) return status;
    sunder_separation_clear(&least);
    *thin = !beyond;
    if (*thin || !disc) return SUNDER_OK; /* a NULL disc is a point in doubles, and a point fits */
    status = fits_where_proposed(a, b, disc, tolerance / 2, &fits, err);
    if (!status && !fits) status = sunder_i_fits_in_both(a->shape, a->t, b->shape, b->t, disc, &fits, err);
    if (!status) *thin = !fits;
    return status;
}
