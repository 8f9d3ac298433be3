#include "equal.h"

#include <string.h>

#include "bytes.h"

static void demand_equal_text(const sunder_sum *a, uint32_t i, const sunder_sum *b, uint32_t j)
{
    char *ax = NULL, *ay = NULL, *bx = NULL, *by = NULL;
    if (sunder_sum_vertex_text(a, i, &ax, &ay, NULL) == SUNDER_OK &&
        sunder_sum_vertex_text(b, j, &bx, &by, NULL) == SUNDER_OK)
        FUZZ_DEMAND(strcmp(ax, bx) == 0 && strcmp(ay, by) == 0);
    sunder_free(ax);
    sunder_free(ay);
    sunder_free(bx);
    sunder_free(by);
}

void fuzz_demand_equal(const sunder_sum *a, const sunder_sum *b)
{
    sunder_sum_size m, n;
    sunder_sum_get_size(a, &m);
    sunder_sum_get_size(b, &n);
    FUZZ_DEMAND(m.polygons == n.polygons && m.holes == n.holes && m.vertices == n.vertices);
    FUZZ_DEMAND(m.degenerate_segments == n.degenerate_segments && m.degenerate_points == n.degenerate_points);
    for (size_t p = 0; p < m.polygons; ++p) {
        FUZZ_DEMAND(sunder_sum_rings(a, p) == sunder_sum_rings(b, p));
        for (size_t r = 0; r < sunder_sum_rings(a, p); ++r) {
            size_t k, l;
            const uint32_t *first = sunder_sum_ring(a, p, r, &k), *second = sunder_sum_ring(b, p, r, &l);
            FUZZ_DEMAND(k == l && k >= 3);
            for (size_t i = 0; i < k; ++i) demand_equal_text(a, first[i], b, second[i]);
        }
    }
    for (size_t i = 0; i < m.degenerate_segments; ++i) {
        uint32_t first[2], second[2];
        sunder_sum_segment(a, i, first);
        sunder_sum_segment(b, i, second);
        demand_equal_text(a, first[0], b, second[0]);
        demand_equal_text(a, first[1], b, second[1]);
    }
    for (size_t i = 0; i < m.degenerate_points; ++i)
        demand_equal_text(a, sunder_sum_point(a, i), b, sunder_sum_point(b, i));
}
