/* The smallest user of the library: the area of the sum of two squares, whose value is known. */
#include <stdio.h>
#include <sunder.h>

int main(void)
{
    const double xy[] = {0, 0, 4, 0, 4, 4, 0, 4};
    const size_t ring_end[] = {4}, poly_end[] = {1};
    sunder_shape *p = NULL, *q = NULL;
    sunder_sum *sum = NULL;
    sunder_error error;
    char *area = NULL;
    int failed = sunder_shape_from_rings(xy, ring_end, poly_end, 1, SUNDER_VALIDITY_STRICT, &p, &error) ||
                 sunder_shape_rectangle(1, 2, &q, &error) || sunder_minkowski_sum(p, q, NULL, &sum, &error) ||
                 sunder_sum_area_text(sum, &area, &error);
    puts(failed ? error.message : area);
    sunder_free(area);
    sunder_sum_free(sum);
    sunder_shape_free(q);
    sunder_shape_free(p);
    return failed;
}
