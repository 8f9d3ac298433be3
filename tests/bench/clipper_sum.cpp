// clipper_sum METHOD FILE: seconds of P + Q by Clipper 6 (Debian's libpolyclipping-dev; Clipper2 is not in Debian 12), on
// integers, with crossings rounded to integers; median of several runs. Prints vertices and holes of the result and the
// seconds. METHOD:
//
//   union    the union of all subsums of convex pieces (subsums.h); timed: from existing paths to the paths of the union
//   offset   for a Q that is a regular polygon: the offset of P with round joins of as many segments; timed in the same
//            way. Not the same sum, but what a user of Clipper would use
//
// Coordinates that are not integers are rounded to thousandths.
#include "subsums.h"

#include <polyclipping/clipper.hpp>

#include <cmath>
#include <cstdint>
#include <exception>

namespace {

struct Question {
    ClipperLib::Paths paths;
    double radius = 0; // 0: a union
    double arc = 0;    // largest distance of a round join from the true arc
};

double scale_of(const bench_set &p, const bench_set &q)
{
    for (const bench_set *s : {&p, &q})
        for (size_t i = 0; i < 2 * s->vertices; i++)
            if (s->xy[i] != std::floor(s->xy[i])) return 1000;
    return 1;
}

ClipperLib::Paths paths_of(const bench_set &s, double scale)
{
    ClipperLib::Paths paths(s.rings);
    for (size_t r = 0, v = 0; r < s.rings; r++)
        for (; v < s.ring_end[r]; v++)
            paths[r].emplace_back(std::llround(scale * s.xy[2 * v]), std::llround(scale * s.xy[2 * v + 1]));
    return paths;
}

__attribute__((noinline)) void bench_once(const Question &ask, ClipperLib::Paths &out)
{
    if (ask.radius > 0) {
        ClipperLib::ClipperOffset offset(2, ask.arc);
        offset.AddPaths(ask.paths, ClipperLib::jtRound, ClipperLib::etClosedPolygon);
        offset.Execute(out, ask.radius);
        return;
    }
    ClipperLib::Clipper clipper;
    clipper.AddPaths(ask.paths, ClipperLib::ptSubject, true);
    clipper.Execute(ClipperLib::ctUnion, out, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
}

void measure(const Question &ask)
{
    double t[100], spent = 0;
    size_t n = 0, vertices = 0, holes = 0;
    while (bench_again(n, spent)) {
        ClipperLib::Paths out;
        const double start = bench_now();
        bench_once(ask, out);
        t[n] = bench_now() - start;
        spent += t[n++];
        vertices = holes = 0;
        for (const ClipperLib::Path &path : out) {
            vertices += path.size();
            holes += !ClipperLib::Orientation(path);
        }
    }
    std::printf("%zu %zu %.9f\n", vertices, holes, bench_median(t, n));
}

} // namespace

int main(int argc, char **argv)
{
    bench_set p, q, sums;
    Question ask;
    const bool offset = argc == 3 && std::strcmp(argv[1], "offset") == 0;
    if (argc != 3 || (!offset && std::strcmp(argv[1], "union") != 0)) {
        std::fprintf(stderr, "usage: clipper_sum union|offset FILE\n");
        return 2;
    }
    if (!bench_pair_read(argv[2], &p, &q)) {
        std::fprintf(stderr, "clipper_sum: %s: cannot be read\n", argv[2]);
        return 1;
    }
    const double scale = scale_of(p, q);
    if (offset) {
        ask.radius = scale * bench_radius(&q);
        ask.arc = ask.radius * (1 - std::cos(std::acos(-1) / static_cast<double>(q.vertices)));
        ask.paths = paths_of(p, scale);
    } else {
        if (!bench_subsums(&p, &q, &sums)) return 1;
        ask.paths = paths_of(sums, scale);
        bench_set_free(&sums);
    }
    try {
        measure(ask);
    } catch (const std::exception &e) {
        std::fprintf(stderr, "clipper_sum: %s %s: %s\n", argv[1], argv[2], e.what());
        return 1;
    }
    return 0;
}
