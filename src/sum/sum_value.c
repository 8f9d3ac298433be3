/* sum_value.c: frees a sum, and returns its parts and values. */
#include "sum/sum_value.h"

#include "sum/map_view.h"

void sunder_sum_free(sunder_sum *sum)
{
    if (!sum) return;
    sunder_i_map_view_free(sum->map);
    sunder_i_lattice_free(&sum->lattice);
    sunder_i_free_all(sum->vertex, sum->ring_vertex, sum->ring_end, sum->poly_end, sum->segment, sum->point, sum);
}

void sunder_sum_get_size(const sunder_sum *sum, sunder_sum_size *size)
{
    *size = (sunder_sum_size){sum->polygons, sum->rings - sum->polygons, sum->rings ? sum->ring_end[sum->rings - 1] : 0,
                              sum->segments, sum->points};
}

void sunder_sum_get_counts(const sunder_sum *sum, sunder_counts *counts) { *counts = sum->lattice.counts; }

void sunder_sum_get_method(const sunder_sum *sum, sunder_sum_method *method) { *method = sum->method; }

bool sunder_sum_phase(const sunder_sum *sum, sunder_phase phase, sunder_counts *counts)
{
    *counts = sum->phase[phase];
    return sum->method.algorithm != SUNDER_ALGORITHM_CONVOLUTION;
}

void sunder_sum_seconds(const sunder_sum *sum, double *decompose, double *subsums, double *unite)
{
    *decompose = sum->seconds[0];
    *subsums = sum->seconds[1];
    *unite = sum->seconds[2];
}

static size_t first_ring(const sunder_sum *sum, size_t polygon) { return polygon ? sum->poly_end[polygon - 1] : 0; }

size_t sunder_sum_rings(const sunder_sum *sum, size_t polygon)
{
    return sum->poly_end[polygon] - first_ring(sum, polygon);
}

const uint32_t *sunder_sum_ring(const sunder_sum *sum, size_t polygon, size_t ring, size_t *n)
{
    const size_t r = first_ring(sum, polygon) + ring, from = r ? sum->ring_end[r - 1] : 0;
    *n = sum->ring_end[r] - from;
    return sum->ring_vertex + from;
}

void sunder_sum_segment(const sunder_sum *sum, size_t i, uint32_t ends[2])
{
    ends[0] = sum->segment[2 * i];
    ends[1] = sum->segment[2 * i + 1];
}

uint32_t sunder_sum_point(const sunder_sum *sum, size_t i) { return sum->point[i]; }
