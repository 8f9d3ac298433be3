/* Convex sets that a relative move must avoid, made from convex parts: the hull of all differences of corners; and the
 * shadow of a part, { s q : q in part, s >= 1 }, represented by its near side. Exact: sums and orientations of such
 * coordinates are doubles. */
#include "optimum.h"

#include <stdlib.h>
#include <string.h>

static double turn(const double *p, const double *q, const double *r)
{
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

static int by_place(const void *p, const void *q)
{
    const double *a = p, *b = q;
    return a[0] != b[0] ? (a[0] > b[0]) - (a[0] < b[0]) : (a[1] > b[1]) - (a[1] < b[1]);
}

/* Andrew's chain; counter-clockwise, strictly convex. Returns the number of corners. */
static size_t hull(double *xy, size_t n, double *out)
{
    size_t k = 0;
    qsort(xy, n, 2 * sizeof *xy, by_place);
    for (size_t pass = 0, base = 0; pass<2; pass++, base = k> 0 ? k - 1 : 0, k = base) {
        for (size_t i = 0; i < n; i++) {
            const double *p = xy + 2 * (pass ? n - 1 - i : i);
            while (k >= base + 2 && turn(out + 2 * (k - 2), out + 2 * (k - 1), p) <= 0) k--;
            memcpy(out + 2 * k++, p, 2 * sizeof *p);
        }
    }
    return k;
}

static optimum_piece *add(optimum_problem *m, size_t a, size_t b)
{
    if (m->pieces == m->room) {
        m->room = 2 * m->room + 16;
        m->piece = realloc(m->piece, m->room * sizeof *m->piece);
        if (!m->piece) abort();
    }
    optimum_piece *piece = &m->piece[m->pieces++];
    *piece = (optimum_piece){.a = a, .b = b};
    return piece;
}

void optimum_keep_apart(optimum_problem *m, size_t a, size_t b, const double *p, size_t np, const double *q, size_t nq,
                        double radius)
{
    double difference[2 * 64], corner[2 * 130];
    size_t n = 0;
    if (np * nq > 64) abort();
    for (size_t i = 0; i < np; i++)
        for (size_t j = 0; j < nq; j++, n++)
            for (size_t k = 0; k < 2; k++) difference[2 * n + k] = p[2 * i + k] - q[2 * j + k];
    n = hull(difference, n, corner);
    if (n > OPTIMUM_CORNERS) abort();
    optimum_piece *piece = add(m, a, b);
    piece->radius = radius;
    piece->corners = n;
    memcpy(piece->xy, corner, 2 * n * sizeof *corner);
}

/* The sides that face away from the origin are consecutive; a side whose line contains the origin does not. If all of a
 * part lies on a line through the origin, its shadow has no area, and contains only relative moves along the line. Such
 * a part is left out, since the infimum is the same. */
void optimum_keep_off(optimum_problem *m, size_t a, size_t b, const double *q, size_t nq, const double anchor[2])
{
    const double origin[2] = {0, 0};
    double from[2 * OPTIMUM_CORNERS], corner[4 * OPTIMUM_CORNERS + 4];
    for (size_t k = 0; k < 2 * nq; k++) from[k] = q[k] - anchor[k & 1];
    const size_t n = hull(from, nq, corner);
    size_t first = n;
    for (size_t k = 0; k < n && n > 1; k++) {
        const size_t before = (k + n - 1) % n, next = (k + 1) % n;
        if (turn(origin, corner + 2 * k, corner + 2 * next) < 0 &&
            turn(origin, corner + 2 * before, corner + 2 * k) >= 0)
            first = k;
    }
    if (first == n) return;
    optimum_piece *piece = add(m, a, b);
    piece->shadow = true;
    for (size_t k = first;; k = (k + 1) % n) {
        memcpy(piece->xy + 2 * piece->corners++, corner + 2 * k, 2 * sizeof *corner);
        if (turn(origin, corner + 2 * k, corner + 2 * ((k + 1) % n)) >= 0) break;
    }
}

void optimum_free(optimum_problem *m)
{
    free(m->piece);
    *m = (optimum_problem){.bodies = 0};
}
