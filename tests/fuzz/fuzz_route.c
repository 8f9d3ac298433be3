/* Routes among hostile obstacles: the routes there and back have equal length, and the same obstacles are in the way.
 * The library itself proves that no leg collides; a path that fails this proof is an error that may not occur here. */
#include <stdlib.h>

#include "bytes.h"

#include <math.h>

#define MOST_POINTS 8

static sunder_place choose_place(fuzz_bytes *bytes, fuzz_scale scale)
{
    const double x = fuzz_coordinate(bytes, scale), y = fuzz_coordinate(bytes, scale);
    return (sunder_place){{x, y}, {NULL, NULL}};
}

/* Properties of the request: are the places finite, are the points of obstacles finite, may memory run out? */
typedef struct asked {
    bool places, points, failing;
} asked;

/* Far places may be refused, and coordinates that are not finite have to be; no other refusal is allowed. If there are
 * several faults, any of them may be reported. */
static bool allowed(sunder_status status, const asked *a)
{
    switch (status) {
    case SUNDER_OK: return a->places && a->points;
    case SUNDER_ERANGE: return a->points;
    case SUNDER_EARG: return !a->places;
    case SUNDER_EINVALID: return !a->points;
    case SUNDER_ECANCEL: return fuzz_is_out_of_patience();
    default: return status == SUNDER_ENOMEM && a->failing;
    }
}

static bool all_finite(const double *v, size_t n)
{
    for (size_t i = 0; i < n; ++i)
        if (!isfinite(v[i])) return false;
    return true;
}

static void demand_same(const sunder_route *there, const sunder_route *back)
{
    const sunder_route_status one = sunder_route_reason(there, NULL), other = sunder_route_reason(back, NULL);
    const bool found = one == SUNDER_ROUTE_FOUND;
    FUZZ_DEMAND(found == (other == SUNDER_ROUTE_FOUND));
    FUZZ_DEMAND((one == SUNDER_ROUTE_DISCONNECTED) == (other == SUNDER_ROUTE_DISCONNECTED));
    FUZZ_DEMAND(found == (sunder_route_vertices(there) > 0));
    if (!found) return;
    const double a = sunder_route_length(there), b = sunder_route_length(back);
    FUZZ_DEMAND(a == b || fabs(a - b) <= 0x1p-51 * a);
    for (size_t i = 0; i < sunder_route_vertices(there); ++i) {
        double xy[2];
        sunder_route_vertex(there, i, xy);
        FUZZ_DEMAND(!isnan(xy[0]) && !isnan(xy[1]));
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_bytes bytes = {data, size};
    const unsigned fail = fuzz_byte(&bytes), kind = fuzz_byte(&bytes);
    const fuzz_scale scale = fuzz_choose_scale(&bytes);
    fuzz_fail_allocations(0);
    fuzz_patience(FUZZ_LOOKS);
    const sunder_place from = choose_place(&bytes, scale), to = choose_place(&bytes, scale);
    double xy[2 * MOST_POINTS];
    size_t points = kind % MOST_POINTS, line_end[2] = {points / 2, points};
    for (size_t i = 0; i < 2 * points; ++i) xy[i] = fuzz_coordinate(&bytes, scale);
    sunder_shape *p = fuzz_shape(&bytes, scale, 14), *robot = fuzz_shape(&bytes, scale, 8);
    sunder_route *there = NULL, *back = NULL;
    if (p && robot && !fuzz_is_out_of_patience() && !sunder_shape_is_empty(robot)) {
        const sunder_obstacle obstacle[] = {{p, NULL, NULL, 0}, {NULL, xy, line_end, points ? 2 : 0}};
        const sunder_route_options options = {.size = sizeof options, .gap = kind & 64 ? ldexp(1, (int)(kind % 5)) : 0};
        sunder_error error;
        fuzz_fail_allocations(fail < 128 ? fail * 8 : 0);
        sunder_status status = sunder_route_find(obstacle, 2, robot, &from, &to, &options, &there, &error);
        asked a = {all_finite(from.xy, 2) && all_finite(to.xy, 2), all_finite(xy, 2 * points), fail > 0 && fail < 128};
        FUZZ_DEMAND((there != NULL) == (status == SUNDER_OK) && allowed(status, &a));
        fuzz_fail_allocations(0);
        a.failing = false;
        status = sunder_route_find(obstacle, 2, robot, &to, &from, &options, &back, &error);
        FUZZ_DEMAND((back != NULL) == (status == SUNDER_OK) && allowed(status, &a));
        if (there && back) demand_same(there, back);
    }
    sunder_route_free(there);
    sunder_route_free(back);
    sunder_shape_free(robot);
    sunder_shape_free(p);
    return 0;
}
