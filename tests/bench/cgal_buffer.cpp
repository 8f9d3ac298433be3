// cgal_buffer METHOD each|dissolve SHAPE FILE: the operations of bench_buffer, by CGAL with exact constructions:
// minkowski_sum_2 of every polygon with the disc or square, and for `dissolve` the join of all sums in one
// aggregated operation, which is what its package of set operations offers. METHOD as of cgal_sum: rc, full, ssab,
// hm, greene, optimal, vert, tri. Timed from polygons of its own kernel to the exact result with its coordinates as
// doubles. Methods that do not accept holes leave those polygons to the vertical decomposition.
#include "buffer_input.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Polygon_convex_decomposition_2.h>
#include <CGAL/Polygon_set_2.h>
#include <CGAL/Polygon_triangulation_decomposition_2.h>
#include <CGAL/Polygon_vertical_decomposition_2.h>
#include <CGAL/Polygon_with_holes_2.h>
#include <CGAL/Small_side_angle_bisector_decomposition_2.h>
#include <CGAL/minkowski_sum_2.h>

#include <cmath>
#include <exception>
#include <string>
#include <vector>

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Polygon = CGAL::Polygon_2<Kernel>;
using Holed = CGAL::Polygon_with_holes_2<Kernel>;

static Polygon ring(const double *xy, size_t n, bool outer)
{
    Polygon r;
    for (size_t i = 0; i < n; i++) r.push_back(Kernel::Point_2(xy[2 * i], xy[2 * i + 1]));
    if ((r.orientation() == CGAL::COUNTERCLOCKWISE) != outer) r.reverse_orientation();
    return r;
}

static void build(const bench_set &s, std::vector<Holed> &out)
{
    size_t v = 0, r = 0;
    for (size_t p = 0; p < s.polygons; p++) {
        Holed h(ring(s.xy + 2 * v, s.ring_end[r] - v, true));
        v = s.ring_end[r++];
        for (; r < s.poly_end[p]; v = s.ring_end[r++]) h.add_hole(ring(s.xy + 2 * v, s.ring_end[r] - v, false));
        out.push_back(h);
    }
}

// Approximately the polygon by which the library dilates: the cost does not depend on the last digits.
static Polygon shape(const bench_shape &s)
{
    std::vector<double> xy;
    if (s.segments == 0) {
        const double h = s.size / 2;
        xy = {-h, -h, h, -h, h, h, -h, h};
    }
    const double pi = 3.14159265358979323846, r = s.inside ? s.size : s.size / std::cos(pi / s.segments);
    const double unit = std::ldexp(1.0, std::ilogb(s.size) - 25);
    for (unsigned i = 0; i < s.segments; i++) {
        xy.push_back(std::round(r * std::cos(2 * pi * i / s.segments) / unit) * unit);
        xy.push_back(std::round(r * std::sin(2 * pi * i / s.segments) / unit) * unit);
    }
    return ring(xy.data(), xy.size() / 2, true);
}

template <class Strategy> static Holed decomposed(const Holed &p, const Polygon &q)
{
    Strategy s;
    return CGAL::minkowski_sum_2(p.outer_boundary(), q, s);
}

static Holed sum(const std::string &method, const Holed &p, const Polygon &q)
{
    if (method == "rc") {
        if (p.number_of_holes()) return CGAL::minkowski_sum_by_reduced_convolution_2(p, Holed(q));
        return CGAL::minkowski_sum_by_reduced_convolution_2(p.outer_boundary(), q);
    }
    if (p.number_of_holes()) {
        CGAL::Polygon_vertical_decomposition_2<Kernel> s;
        return CGAL::minkowski_sum_2(p, Holed(q), s);
    }
    if (method == "full") return CGAL::minkowski_sum_by_full_convolution_2(p.outer_boundary(), q);
    if (method == "ssab") return decomposed<CGAL::Small_side_angle_bisector_decomposition_2<Kernel>>(p, q);
    if (method == "hm") return decomposed<CGAL::Hertel_Mehlhorn_convex_decomposition_2<Kernel>>(p, q);
    if (method == "greene") return decomposed<CGAL::Greene_convex_decomposition_2<Kernel>>(p, q);
    if (method == "optimal") return decomposed<CGAL::Optimal_convex_decomposition_2<Kernel>>(p, q);
    if (method == "vert") return decomposed<CGAL::Polygon_vertical_decomposition_2<Kernel>>(p, q);
    if (method == "tri") return decomposed<CGAL::Polygon_triangulation_decomposition_2<Kernel>>(p, q);
    std::fprintf(stderr, "cgal_buffer: no method %s\n", method.c_str());
    std::exit(2);
}

static void measure(const Polygon &r, size_t &vertices, double &area)
{
    std::vector<double> xy;
    for (auto v = r.vertices_begin(); v != r.vertices_end(); ++v) {
        xy.push_back(CGAL::to_double(v->x()));
        xy.push_back(CGAL::to_double(v->y()));
    }
    vertices += r.size();
    area += bench_ring_area(xy.data(), r.size());
}

static void measure(const Holed &h, size_t &vertices, double &area)
{
    measure(h.outer_boundary(), vertices, area);
    for (auto it = h.holes_begin(); it != h.holes_end(); ++it) measure(*it, vertices, area);
}

static double once(const std::string &method, const std::vector<Holed> &all, const Polygon &by, bool dissolve, size_t &vertices,
                   double &area)
{
    vertices = 0;
    area = 0;
    const double start = bench_now();
    std::vector<Holed> sums;
    for (const Holed &h : all) {
        sums.push_back(sum(method, h, by));
        if (dissolve) continue;
        measure(sums.back(), vertices, area);
        sums.clear();
    }
    if (dissolve) {
        CGAL::Polygon_set_2<Kernel> joined;
        joined.join(sums.begin(), sums.end());
        sums.clear();
        joined.polygons_with_holes(std::back_inserter(sums));
        for (const Holed &h : sums) measure(h, vertices, area);
    }
    return bench_now() - start;
}

int main(int argc, char **argv)
{
    if (argc != 5) {
        std::fprintf(stderr, "usage: cgal_buffer METHOD each|dissolve SHAPE FILE\n");
        return 2;
    }
    bench_layer layer;
    bench_shape by;
    bench_buffer_arguments(argc - 1, argv + 1, &layer);
    if (!bench_shape_read(&by, argv[3])) return 2;
    double t[100], spent = 0, area = 0;
    size_t n = 0, vertices = 0;
    try {
        std::vector<Holed> all;
        for (size_t i = 0; i < layer.n; i++) build(layer.set[i], all);
        const Polygon q = shape(by);
        for (; bench_again(n, spent); n++)
            spent += t[n] = once(argv[1], all, q, std::string(argv[2]) == "dissolve", vertices, area);
    } catch (const std::exception &e) {
        std::fprintf(stderr, "cgal_buffer: %s\n", e.what());
        return 1;
    }
    std::printf("%zu %zu %zu %.12g %.6f\n", layer.n, bench_layer_vertices(&layer), vertices, area, bench_median(t, n));
    bench_layer_free(&layer);
    return 0;
}
