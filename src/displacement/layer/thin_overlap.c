/* How thin is an overlap? By the least translation that takes the two apart, and by the disc that fits into it: of two
 * that interlock, as a house in the notch of another, the translation is as long as the notch is deep, however thin the
 * sliver. The translation is asked first, for as a rule it is the cheaper question; and before the erosion is, a place
 * where the disc may fit is looked for in doubles, and tried exactly: overlaps that are not thin have one. */
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

static sunder_status no_disc_fits(const sunder_i_translate *a, const sunder_i_translate *b, double diameter, bool *thin,
                                  sunder_error *err)
{
    sunder_shape *disc;
    bool fits;
    if (!(diameter / 2 > 0)) return SUNDER_OK; /* a point, as far as doubles go, and there is one */
    sunder_status status = sunder_shape_disc(diameter / 2, DISC_CORNERS, true, &disc, err);
    if (status) return status;
    status = fits_where_proposed(a, b, disc, diameter / 2, &fits, err);
    if (!status && !fits) status = sunder_i_fits_in_both(a->shape, a->t, b->shape, b->t, disc, &fits, err);
    if (!status) *thin = !fits;
    sunder_shape_free(disc);
    return status;
}

sunder_status sunder_i_overlap_is_thin(const sunder_i_translate *a, const sunder_i_translate *b, double tolerance,
                                       bool *thin, sunder_error *err)
{
    *thin = false;
    if (!(tolerance > 0)) return SUNDER_OK;
    sunder_separation least;
    bool beyond = false;
    const sunder_status status = sunder_i_separate(a->shape, a->t, b->shape, b->t, 0, tolerance, &least, &beyond, err);
    if (status) return status;
    sunder_separation_clear(&least);
    *thin = !beyond;
    return *thin ? SUNDER_OK : no_disc_fits(a, b, tolerance, thin, err);
}
