/* clean_ring.c: finds the corners of a raw ring. Repeated vertices (also the closing one) and vertices on the straight
 * line between their neighbours are removed; an edge that runs back along the previous one is a spike, and an error. */
#include "shape/build.h"

static bool same_place(const double *xy, uint32_t i, uint32_t j)
{
    return xy[2 * (size_t)i] == xy[2 * (size_t)j] && xy[2 * (size_t)i + 1] == xy[2 * (size_t)j + 1];
}

static int vertex_order(const double *xy, uint32_t i, uint32_t j)
{
    const double *a = xy + 2 * (size_t)i, *b = xy + 2 * (size_t)j;
    if (a[0] != b[0]) return a[0] < b[0] ? -1 : 1;
    return (a[1] > b[1]) - (a[1] < b[1]);
}

/* Returns whether the path continues beyond b, for collinear a, b, c with a != b != c. */
static bool goes_on(const double *xy, uint32_t a, uint32_t b, uint32_t c)
{
    return vertex_order(xy, a, b) == vertex_order(xy, b, c);
}

/* Returns why there is no ring: fewer than three positions, all on one line, or `otherwise`. Rarely called. */
static sunder_i_fault why_degenerate(sunder_i_lattice *lattice, const double *xy, const sunder_i_point *at, uint32_t lo,
                                     uint32_t hi, sunder_i_fault otherwise)
{
    uint32_t second = lo, third = lo;
    bool spread = false;
    for (uint32_t i = lo; i < hi; i++) {
        if (second == lo) {
            if (!same_place(xy, i, lo)) second = i;
            continue;
        }
        if (!same_place(xy, i, lo) && !same_place(xy, i, second)) third = i;
        if (sunder_i_orient(lattice, at[lo], at[second], at[i]) != 0) spread = true;
    }
    if (third == lo) return SUNDER_I_FEW;
    return spread ? otherwise : SUNDER_I_FLAT;
}

uint32_t sunder_i_clean_ring(sunder_i_lattice *lattice, const double *xy, const sunder_i_point *at, uint32_t lo,
                             uint32_t hi, uint32_t *keep, sunder_i_problem *problem)
{
    uint32_t m = 0, first = 0, spike = SUNDER_I_NONE;
    for (uint32_t i = lo; i < hi && spike == SUNDER_I_NONE; i++) {
        if (m && same_place(xy, keep[m - 1], i)) continue;
        /* The previous corner may turn out to be on a straight line; then the one before it is not, so that one test
         * suffices: without b, the edge a -> i has the direction of a -> b. */
        if (m >= 2 && sunder_i_orient_inline(lattice, at[keep[m - 2]], at[keep[m - 1]], at[i]) == 0) {
            if (!goes_on(xy, keep[m - 2], keep[m - 1], i))
                spike = keep[m - 1];
            else
                m--;
        }
        keep[m++] = i;
    }
    while (m > 1 && same_place(xy, keep[m - 1], keep[0])) m--;
    /* the seam: the last and the first corner, alternately */
    while (m - first >= 3 && spike == SUNDER_I_NONE) {
        if (sunder_i_orient_inline(lattice, at[keep[m - 2]], at[keep[m - 1]], at[keep[first]]) == 0) {
            if (!goes_on(xy, keep[m - 2], keep[m - 1], keep[first])) spike = keep[m - 1];
            m--;
        } else if (sunder_i_orient_inline(lattice, at[keep[m - 1]], at[keep[first]], at[keep[first + 1]]) == 0) {
            if (!goes_on(xy, keep[m - 1], keep[first], keep[first + 1])) spike = keep[first];
            first++;
        } else {
            break;
        }
    }
    if (spike != SUNDER_I_NONE || m - first < 3) {
        problem->fault = why_degenerate(lattice, xy, at, lo, hi, SUNDER_I_SPIKE);
        problem->vertex = spike == SUNDER_I_NONE ? lo : spike;
        problem->other = SUNDER_I_NONE;
        return 0;
    }
    if (first)
        for (uint32_t i = first; i < m; i++) keep[i - first] = keep[i];
    return m - first;
}
