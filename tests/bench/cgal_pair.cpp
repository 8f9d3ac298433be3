// cgal_pair FILE [COUNT [reflect]]: microseconds per pair for the least translation of Q off P by CGAL with exact
// constructions: reduced convolution of P and -Q, both already built, then the boundary point nearest to the origin,
// exactly. The first COUNT pairs of a file with P and Q on alternating lines (0: all), or with P and -Q (reflect).
// Prints pairs, microseconds (median of three passes), the sum of the lengths, and the number of pairs for which
// CGAL failed. CGAL drops degenerate holes: if the nearest place is in one, its length is too large.
#include "wkt_input.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Polygon_with_holes_2.h>
#include <CGAL/minkowski_sum_2.h>

#include <cmath>
#include <exception>
#include <vector>

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Polygon = CGAL::Polygon_2<Kernel>;
using Holed = CGAL::Polygon_with_holes_2<Kernel>;

static Polygon ring(const bench_set &s, size_t first, size_t end, bool outer, double sign)
{
    Polygon r;
    for (size_t i = first; i < end; i++) r.push_back(Kernel::Point_2(sign * s.xy[2 * i], sign * s.xy[2 * i + 1]));
    if ((r.orientation() == CGAL::COUNTERCLOCKWISE) != outer) r.reverse_orientation();
    return r;
}

static Holed build(const bench_set &s, double sign)
{
    Holed h(ring(s, 0, s.ring_end[0], true, sign));
    for (size_t r = 1; r < s.rings; r++) h.add_hole(ring(s, s.ring_end[r - 1], s.ring_end[r], false, sign));
    return h;
}

// The least squared distance of the origin to a boundary: each edge, exactly.
static void nearest(const Polygon &ring, const Kernel::Point_2 &origin, Kernel::FT &best, bool &any)
{
    for (auto e = ring.edges_begin(); e != ring.edges_end(); ++e) {
        const Kernel::FT d = CGAL::squared_distance(origin, *e);
        if (!any || d < best) best = d;
        any = true;
    }
}

static bool inside(const Holed &h, const Kernel::Point_2 &origin)
{
    if (h.outer_boundary().bounded_side(origin) != CGAL::ON_BOUNDED_SIDE) return false;
    for (auto it = h.holes_begin(); it != h.holes_end(); ++it)
        if (it->bounded_side(origin) != CGAL::ON_UNBOUNDED_SIDE) return false;
    return true;
}

static double length(const Holed &p, const Holed &q)
{
    const Kernel::Point_2 origin(0, 0);
    const Holed sum = p.number_of_holes() == 0 && q.number_of_holes() == 0
                          ? CGAL::minkowski_sum_by_reduced_convolution_2(p.outer_boundary(), q.outer_boundary())
                          : CGAL::minkowski_sum_by_reduced_convolution_2(p, q);
    if (!inside(sum, origin)) return 0;
    Kernel::FT best = 0;
    bool any = false;
    nearest(sum.outer_boundary(), origin, best, any);
    for (auto it = sum.holes_begin(); it != sum.holes_end(); ++it) nearest(*it, origin, best, any);
    CGAL::exact(best);
    return std::sqrt(CGAL::to_double(best));
}

int main(int argc, char **argv)
{
    std::FILE *f = argc > 1 ? std::fopen(argv[1], "r") : nullptr;
    const size_t most = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 0;
    if (!f) {
        std::fprintf(stderr, "usage: cgal_pair FILE [COUNT]\n");
        return 2;
    }
    const double sign = argc > 3 && std::strcmp(argv[3], "reflect") == 0 ? 1 : -1;
    std::vector<Holed> set;
    for (char *line; (!most || set.size() < 2 * most) && (line = bench_line(f)); std::free(line)) {
        bench_set s;
        if (!bench_set_read(&s, line)) return 1;
        set.push_back(build(s, set.size() % 2 ? sign : 1));
        bench_set_free(&s);
    }
    std::fclose(f);
    double t[3], total = 0;
    size_t lost = 0;
    for (int k = 0; k < 3; k++) {
        const double start = bench_now();
        total = 0;
        lost = 0;
        for (size_t i = 0; i + 1 < set.size(); i += 2) {
            try {
                total += length(set[i], set[i + 1]);
            } catch (const std::exception &) {
                lost++;
            }
        }
        t[k] = bench_now() - start;
    }
    const size_t n = set.size() / 2;
    std::printf("%zu %.3f %.9g %zu\n", n, 1e6 * bench_median(t, 3) / static_cast<double>(n), total, lost);
    return 0;
}
