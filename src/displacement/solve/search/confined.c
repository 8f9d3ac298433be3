/* How far to search for a place of one body beside another, if only a jump separates the two bodies
 * (solve/clusters/shut_in_pairs.c).
 *
 * For such a pair the full distances and the shadows, which are never waived, forbid every relative move. A relaxed
 * pair of features may be nearer than the full distance, so a move may be free only if a relaxed pair of their features
 * is nearer than that. The boxes of these features bound how far such a move can be. */
#include "displacement/solve/search/search_stages.h"

#include "base/extremes.h"

#include <math.h>

/* An upper bound of the distance from u to relative moves at which the boxes of features f and g are closer than the
 * gap. */
static double farthest_near(const sunder_i_search *s, uint32_t f, uint32_t g, const double u[2])
{
    const sunder_i_model *model = s->model;
    const double *a = sunder_i_home_box(model, f), *b = sunder_i_home_box(model, g);
    const double owed = s->gap + 2 * s->tolerance;
    double square = 0;
    for (uint32_t x = 0; x < 2; x++) {
        const double far = sunder_i_max(fabs(a[x] - b[x + 2] - owed - u[x]), fabs(a[x + 2] - b[x] + owed - u[x]));
        square += far * far;
    }
    return sqrt(square);
}

static double farthest_of(const sunder_i_search *s, const sunder_i_relaxations *all, uint32_t p, uint32_t q,
                          const double u[2])
{
    const uint32_t *body_of = s->model->body_of;
    double farthest = 0;
    for (size_t k = 0; k < all->n; k++) {
        const uint32_t a = all->item[k].a, b = all->item[k].b;
        if (body_of[a] == p && body_of[b] == q) farthest = sunder_i_max(farthest, farthest_near(s, a, b, u));
        if (body_of[a] == q && body_of[b] == p) farthest = sunder_i_max(farthest, farthest_near(s, b, a, u));
    }
    return farthest;
}

bool sunder_i_search_is_confined(const sunder_i_search *search, uint32_t i, uint32_t j, const double u[2],
                                 double *farthest)
{
    const uint32_t p = search->body[i], q = search->body[j];
    if (!sunder_i_are_confined(search->model, p, q)) return false;
    *farthest = sunder_i_max(farthest_of(search, &search->relaxations, p, q, u),
                             farthest_of(search, &search->model->relaxations, p, q, u));
    return true;
}
