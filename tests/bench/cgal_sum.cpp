// cgal_sum METHOD FILE [area]: seconds of the Minkowski sum by CGAL with exact constructions, polygons already
// built; median of several runs. Prints vertices and holes of the result and the seconds. METHOD: rc (reduced
// convolution), full (full convolution), ssab (small-side angle bisector), vert (vertical), tri (triangulation), hm
// (Hertel-Mehlhorn), greene, optimal. Operands with several members: the sums of all pairs of members, united in one
// aggregated operation, which is what the package offers. Methods that do not accept holes end with status 3. With
// "area", prints the exact area of the result instead.
#include "wkt_input.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Polygon_convex_decomposition_2.h>
#include <CGAL/Polygon_set_2.h>
#include <CGAL/Polygon_triangulation_decomposition_2.h>
#include <CGAL/Polygon_vertical_decomposition_2.h>
#include <CGAL/Polygon_with_holes_2.h>
#include <CGAL/Small_side_angle_bisector_decomposition_2.h>
#include <CGAL/minkowski_sum_2.h>

#include <exception>
#include <iostream>
#include <string>
#include <vector>

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Polygon = CGAL::Polygon_2<Kernel>;
using Holed = CGAL::Polygon_with_holes_2<Kernel>;

static Polygon ring(const bench_set &s, size_t first, size_t end, bool outer)
{
    Polygon r;
    for (size_t i = first; i < end; i++) r.push_back(Kernel::Point_2(s.xy[2 * i], s.xy[2 * i + 1]));
    if ((r.orientation() == CGAL::COUNTERCLOCKWISE) != outer) r.reverse_orientation();
    return r;
}

static std::vector<Holed> build(const bench_set &s)
{
    std::vector<Holed> out;
    size_t v = 0, r = 0;
    for (size_t p = 0; p < s.polygons; p++) {
        Holed h(ring(s, v, s.ring_end[r], true));
        v = s.ring_end[r++];
        for (; r < s.poly_end[p]; v = s.ring_end[r++]) h.add_hole(ring(s, v, s.ring_end[r], false));
        out.push_back(h);
    }
    return out;
}

static bool simple(const Holed &h) { return h.number_of_holes() == 0; }

struct No_holes {};

template <class Strategy> static Holed decomposed(const Holed &p, const Holed &q)
{
    if (!simple(p) || !simple(q)) throw No_holes();
    Strategy s;
    return CGAL::minkowski_sum_2(p.outer_boundary(), q.outer_boundary(), s);
}

template <class Strategy> static Holed decomposed_holed(const Holed &p, const Holed &q)
{
    Strategy s;
    if (simple(p) && simple(q)) return CGAL::minkowski_sum_2(p.outer_boundary(), q.outer_boundary(), s);
    return CGAL::minkowski_sum_2(p, q, s);
}

static Holed sum(const std::string &method, const Holed &p, const Holed &q)
{
    if (method == "rc") {
        if (simple(p) && simple(q)) return CGAL::minkowski_sum_by_reduced_convolution_2(p.outer_boundary(), q.outer_boundary());
        return CGAL::minkowski_sum_by_reduced_convolution_2(p, q);
    }
    if (method == "full") {
        if (!simple(p) || !simple(q)) throw No_holes();
        return CGAL::minkowski_sum_by_full_convolution_2(p.outer_boundary(), q.outer_boundary());
    }
    if (method == "ssab") return decomposed<CGAL::Small_side_angle_bisector_decomposition_2<Kernel>>(p, q);
    if (method == "hm") return decomposed<CGAL::Hertel_Mehlhorn_convex_decomposition_2<Kernel>>(p, q);
    if (method == "greene") return decomposed<CGAL::Greene_convex_decomposition_2<Kernel>>(p, q);
    if (method == "optimal") return decomposed<CGAL::Optimal_convex_decomposition_2<Kernel>>(p, q);
    if (method == "vert") return decomposed_holed<CGAL::Polygon_vertical_decomposition_2<Kernel>>(p, q);
    if (method == "tri") return decomposed_holed<CGAL::Polygon_triangulation_decomposition_2<Kernel>>(p, q);
    std::fprintf(stderr, "cgal_sum: no method %s\n", method.c_str());
    std::exit(2);
}

static void count(const Holed &h, size_t &vertices, size_t &holes)
{
    vertices += h.outer_boundary().size();
    holes += h.number_of_holes();
    for (auto it = h.holes_begin(); it != h.holes_end(); ++it) vertices += it->size();
}

static std::vector<Holed> sum_of_sets(const std::string &method, const std::vector<Holed> &p, const std::vector<Holed> &q)
{
    if (p.size() == 1 && q.size() == 1) return {sum(method, p[0], q[0])};
    std::vector<Holed> parts, out;
    for (const Holed &a : p)
        for (const Holed &b : q) parts.push_back(sum(method, a, b));
    CGAL::Polygon_set_2<Kernel> all;
    all.join(parts.begin(), parts.end());
    all.polygons_with_holes(std::back_inserter(out));
    return out;
}

// A function of its own, so that callgrind can count its instructions.
__attribute__((noinline)) static std::vector<Holed> bench_once(const std::string &method, const std::vector<Holed> &p,
                                                               const std::vector<Holed> &q)
{
    return sum_of_sets(method, p, q);
}

static double once(const std::string &method, const std::vector<Holed> &p, const std::vector<Holed> &q, size_t &vertices,
                   size_t &holes)
{
    vertices = holes = 0;
    const double start = bench_now();
    const std::vector<Holed> out = bench_once(method, p, q);
    const double seconds = bench_now() - start;
    for (const Holed &h : out) count(h, vertices, holes);
    return seconds;
}

static void print_area(const std::vector<Holed> &sums)
{
    Kernel::FT area = 0;
    for (const Holed &h : sums) {
        area += h.outer_boundary().area();
        for (auto it = h.holes_begin(); it != h.holes_end(); ++it) area += it->area(); // clockwise: negative
    }
    std::cout << CGAL::exact(area) << std::endl;
}

int main(int argc, char **argv)
{
    bench_set p, q;
    const bool area = argc == 4 && std::string(argv[3]) == "area";
    if (argc != 3 && !area) {
        std::fprintf(stderr, "usage: cgal_sum METHOD FILE [area]\n");
        return 2;
    }
    if (!bench_pair_read(argv[2], &p, &q)) {
        std::fprintf(stderr, "cgal_sum: %s: cannot be read\n", argv[2]);
        return 1;
    }
    const std::vector<Holed> a = build(p), b = build(q);
    double t[100], spent = 0;
    size_t n = 0, vertices = 0, holes = 0;
    try {
        if (area) {
            print_area(sum_of_sets(argv[1], a, b));
            return 0;
        }
        while (bench_again(n, spent)) {
            t[n] = once(argv[1], a, b, vertices, holes);
            spent += t[n++];
        }
    } catch (const No_holes &) {
        return 3;
    } catch (const std::exception &e) {
        std::fprintf(stderr, "cgal_sum: %s %s: %s\n", argv[1], argv[2], e.what());
        return 1;
    }
    std::printf("%zu %zu %.9f\n", vertices, holes, bench_median(t, n));
    return 0;
}
