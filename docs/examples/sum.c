/* The Minkowski sum of an L and a triangle, exactly: its size, its area, and the corners of its outline.
 *
 *     cc sum.c $(pkg-config --cflags --libs sunder) && ./a.out
 *
 * Prints:
 *
 *     1 polygon, 7 vertices, area 36
 *     (0, 0)
 *     (8, 0)
 *     (8, 2)
 *     (7, 4)
 *     (3, 4)
 *     (2, 6)
 *     (0, 6)
 */
#include <stdio.h>
#include <sunder.h>

/* Every step can fail; the error says why, and what was made so far is freed below. */
static sunder_status print_sum(const sunder_sum *sum, sunder_error *error)
{
    sunder_sum_size size;
    size_t n;
    char *area = NULL;
    sunder_status status = sunder_sum_area_text(sum, &area, error);
    if (status) return status;
    sunder_sum_get_size(sum, &size);
    printf("%zu polygon, %zu vertices, area %s\n", size.polygons, size.vertices, area);
    sunder_free(area);
    const uint32_t *vertex = sunder_sum_ring(sum, 0, 0, &n); /* the outer ring of polygon 0; lent by the sum */
    for (size_t k = 0; k < n; k++) {
        char *x, *y;
        status = sunder_sum_vertex_text(sum, vertex[k], &x, &y, error);
        if (status) return status;
        printf("(%s, %s)\n", x, y);
        sunder_free(x);
        sunder_free(y);
    }
    return SUNDER_OK;
}

int main(void)
{
    const double l[] = {0, 0, 7, 0, 7, 2, 2, 2, 2, 4, 0, 4};
    const double triangle[] = {0, 0, 1, 0, 0, 2};
    const size_t six = 6, three = 3, one = 1;
    sunder_shape *p = NULL, *q = NULL;
    sunder_sum *sum = NULL;
    sunder_error error;
    sunder_status status = sunder_shape_from_rings(l, &six, &one, 1, SUNDER_VALIDITY_STRICT, &p, &error);
    if (!status) status = sunder_shape_from_rings(triangle, &three, &one, 1, SUNDER_VALIDITY_STRICT, &q, &error);
    if (!status) status = sunder_minkowski_sum(p, q, NULL, &sum, &error);
    if (!status) status = print_sum(sum, &error);
    if (status) fprintf(stderr, "%s\n", error.message);
    sunder_sum_free(sum);
    sunder_shape_free(q);
    sunder_shape_free(p);
    return status ? 1 : 0;
}
