/* F + B and F^c + (-B), where the corners of F are rational.
 *
 * Let C be a convex piece of what is added, c a point inside it, and X a set of which the boundary is known. Then
 *
 *     X + int C  =  (X + c)  u  (boundary of X + int C)           for X open or closed
 *
 * For let x = y + b with y in X, b in int C. If x - c is not in X, then on the way from b to c, which stays inside C, x
 * minus the way leaves X, and where it does it is on the boundary. The boundary is sides, so the second set is a union
 * of *bands*: a side s gives the open convex polygon s + int C. (A degenerate segment or point of X is boundary, too.)
 * Uniting over the pieces of B gives all but what only the diagonals between pieces reach: with X open nothing, since a
 * bit of y can be traded for a bit of b; with X closed only seams without area, which the closure has.
 *
 * So the bands are united in a planar map (../planar_map/), one after the other in biased random order, what lies
 * inside being forgotten. No band reaches a cell of the map that none covers, be it a face, an edge or a vertex: so the
 * boundary of X + c does not either, and the cell lies in X + c as a whole or not at all. One of its corners is enough
 * to ask.
 * (Where X + c is drawn as a region beside the bands, its complement needs a frame, and counts of vertices where rings
 * touch; asking costs one location a cell, and few cells are left.)
 *
 *     dilation: a cell is in   if covered, or in F + c for some piece;
 *     erosion:  a cell is in   if not covered, and in F + c for every piece: in no F^c + c.
 *
 * Every corner that is compared is on the lines of two sides: of F, of B moved to a corner of F, or of F moved by a
 * corner of B. All have lattice directions, and none is made from more than one corner of F: so numbers do not grow
 * with the figure, only with what its own corners were made from.
 *
 * Cost: expected O(b log b + k), b sides of bands, k crossings drawn, of which those inside the union go at once. */
#include "morphology/morphology.h"

#include "base/extremes.h"
#include "base/invariant.h"
#include "base/random.h"
#include "base/watch.h"
#include "predicate/rational_point.h"
#include "spatial/strips.h"
#include "sum/canonical_sum.h"
#include "sum/from_map.h"

#include <math.h>
#include <string.h>

/* The figure, to be asked where places are. */
typedef struct solid {
    const sunder_i_figure *figure;
    uint32_t *next;        /* [sides] */
    double (*xy)[2], most; /* [sides] where each begins, times 2^shift; the largest of these */
    long shift;
    sunder_i_strips strips;
} solid;

typedef struct stage {
    const sunder_i_figure *figure;
    const sunder_i_structuring_element *element;
    const sunder_sum_options *options;
    sunder_i_planar_map *bands;
    solid solid; /* the figure itself */
    sunder_i_arena scratch;
    uint64_t random;
    bool erode;
} stage;

/* The share of a stage's work that the current part has: from and to are fractions of the stage. */
typedef struct share {
    double from, to;
} share;

static const share of_bands = {0, 1};

static bool go_on(const sunder_sum_options *options, const share *s, uint64_t done, uint64_t all)
{
    return !options || !options->progress ||
           options->progress(s->from + (s->to - s->from) * ((double)done / (double)all), options->progress_user);
}

enum { ROUNDS = 64 };

/* In which round of how many does a thing go in? In the last one half of the things, in the one before a quarter. */
static unsigned round_of(uint64_t *random)
{
    unsigned heads = 0;
    for (uint64_t r = sunder_i_draw(random) | (uint64_t)1 << (ROUNDS - 1); !(r & 1); r >>= 1) heads++;
    return ROUNDS - 1 - heads;
}

/* An order of n things that follow each other along rings; NULL if memory is out. Rounds of twice as many things each
 * time, drawn at random, keep the expected costs of a random order within a factor. Within a round things stand in
 * their own order, so that the next one goes in near the last, where the map is at hand already [ACR03]. Half the time
 * of a random order on coasts of a hundred thousand vertices. */
static uint64_t *biased_order(uint64_t *random, uint64_t n)
{
    uint64_t *order = sunder_i_alloc(n, sizeof *order);
    uint8_t *round = sunder_i_alloc(n, sizeof *round);
    uint64_t at[ROUNDS + 1] = {0};
    for (uint64_t i = 0; order && round && i < n; i++) at[1 + (round[i] = (uint8_t)round_of(random))]++;
    for (unsigned r = 0; r < ROUNDS; r++) at[r + 1] += at[r];
    for (uint64_t i = 0; order && round && i < n; i++) order[at[round[i]]++] = i;
    if (!round) {
        sunder_i_free(order);
        order = NULL;
    }
    sunder_i_free(round);
    return order;
}

/* The two ends of what band i is made from: of a side, over all rings, then of a segment, then twice a point. */
static void ends_of(const sunder_i_figure *f, const uint32_t *next, uint64_t i, uint32_t ends[2])
{
    if (i < f->sides) {
        ends[0] = f->ring[i];
        ends[1] = f->ring[next[i]];
    } else if (i < f->sides + f->segments)
        memcpy(ends, f->segment + 2 * (i - f->sides), 2 * sizeof *ends);
    else
        ends[0] = ends[1] = f->point[i - f->sides - f->segments];
}

/* Where each side's successor stands. */
static uint32_t *successors(const sunder_i_figure *f)
{
    uint32_t *next = sunder_i_alloc(f->sides, sizeof *next);
    for (size_t r = 0; next && r < f->rings; r++) {
        const size_t first = r ? f->ring_end[r - 1] : 0, end = f->ring_end[r];
        for (size_t i = first; i < end; i++) next[i] = (uint32_t)(i + 1 < end ? i + 1 : first);
    }
    return next;
}

/* ---- The figure itself ---- */

/* Coordinates of the figure and of a place are at most this far from their doubles. */
static double margin(double most) { return most * 0x1p-50 + 0x1p-900; }

/* The figure's sides by height, corners as doubles in a power of two that all fit. */
static bool solid_init(solid *s, const sunder_i_figure *f, const sunder_i_lattice *lattice)
{
    *s = (solid){.figure = f, .shift = -(long)lattice->approx_shift};
    sunder_i_arena scratch = {0};
    double(*span)[2] = sunder_i_alloc(f->sides, sizeof *span);
    s->xy = sunder_i_alloc(f->sides, sizeof *s->xy);
    s->next = successors(f);
    for (size_t i = 0; span && s->xy && i < f->sides; i++) {
        const sunder_i_mark mark = sunder_i_arena_mark(&scratch);
        sunder_i_rational_doubles(&scratch, f->at[f->ring[i]], s->shift, &s->xy[i][0], &s->xy[i][1]);
        s->most = sunder_i_max(s->most, sunder_i_max(fabs(s->xy[i][0]), fabs(s->xy[i][1])));
        sunder_i_arena_release(&scratch, mark);
    }
    bool ok = span && s->xy && s->next && !scratch.failed;
    for (size_t i = 0; ok && i < f->sides; i++) {
        const double y[2] = {s->xy[i][1], s->xy[s->next[i]][1]};
        span[i][0] = sunder_i_min(y[0], y[1]) - 4 * margin(s->most);
        span[i][1] = sunder_i_max(y[0], y[1]) + 4 * margin(s->most);
    }
    ok = ok && sunder_i_strips_build(&s->strips, (const double(*)[2])span, f->sides, f->sides);
    sunder_i_arena_free(&scratch);
    sunder_i_free(span);
    return ok;
}

static void solid_free(solid *s)
{
    sunder_i_strips_free(&s->strips);
    sunder_i_free(s->xy);
    sunder_i_free(s->next);
}

/* Is corner i of the rings above the place? */
static bool is_above(const solid *s, sunder_i_arena *scratch, size_t i, const sunder_i_rational_point *at, double y)
{
    const double gap = s->xy[i][1] - y;
    if (fabs(gap) > margin(s->most) + margin(y < 0 ? -y : y)) return gap > 0;
    return sunder_i_rational_cmp(scratch, &s->figure->at[s->figure->ring[i]], at, 1) > 0;
}

/* Is a place inside the figure, off its boundary? A ray to the left crosses the sides that begin to its left and have
 * exactly one end above it. */
static bool is_in_figure(const solid *s, sunder_i_arena *scratch, sunder_i_rational_point at)
{
    bool odd = false;
    size_t from, to;
    double x, y;
    sunder_i_rational_doubles(scratch, at, s->shift, &x, &y);
    const double error = margin(s->most) + margin(fabs(x));
    sunder_i_strips_at(&s->strips, y, &from, &to);
    for (; from < to && !scratch->failed; from++) {
        const uint32_t a = s->strips.item[from], b = s->next[a];
        const sunder_i_mark mark = sunder_i_arena_mark(scratch);
        const bool up = is_above(s, scratch, b, &at, y);
        if (up != is_above(s, scratch, a, &at, y)) {
            const double left = sunder_i_min(s->xy[a][0], s->xy[b][0]), right = sunder_i_max(s->xy[a][0], s->xy[b][0]);
            bool crosses = right + error < x;
            if (!crosses && !(left - error > x)) {
                const sunder_i_figure *f = s->figure;
                const int side = sunder_i_rational_orient(scratch, f->at[f->ring[a]], f->at[f->ring[b]], at);
                crosses = up ? side < 0 : side > 0;
            }
            odd = odd != crosses;
        }
        sunder_i_arena_release(scratch, mark);
    }
    return odd;
}

/* ---- Bands ---- */

/* Band number k: of the sides, then the segments, then the points, each with all pieces. */
static sunder_status add_band(stage *g, const uint32_t *next, uint64_t k, sunder_error *err)
{
    const sunder_i_figure *f = g->figure;
    const sunder_i_structuring_element *p = g->element;
    const uint64_t piece = k % p->pieces, i = k / p->pieces;
    const size_t first = piece ? p->end[piece - 1] : 0, end = p->end[piece];
    const sunder_i_mark mark = sunder_i_arena_mark(&g->scratch);
    sunder_i_rational_point *corner = sunder_i_arena_alloc(&g->scratch, end - first + 2, sizeof *corner);
    sunder_i_point *along = sunder_i_arena_alloc(&g->scratch, end - first + 2, sizeof *along);
    if (!corner || !along) return sunder_i_no_memory(err);
    uint32_t ends[2];
    bool known;
    ends_of(f, next, i, ends);
    const size_t n = sunder_i_band(&g->scratch, p, first, end, f->at[ends[0]], f->at[ends[1]], corner, along, &known);
    if (g->scratch.failed) return sunder_i_no_memory(err);
    const sunder_status status = sunder_i_planar_map_unite_polygon(g->bands, corner, known ? along : NULL, n, err);
    sunder_i_arena_release(&g->scratch, mark);
    return status;
}

static sunder_status unite_bands(stage *g, sunder_error *err)
{
    const sunder_i_figure *f = g->figure;
    const uint64_t all = (f->sides + f->segments + f->points) * (uint64_t)g->element->pieces;
    uint32_t *next = successors(f);
    uint64_t *order = biased_order(&g->random, all);
    sunder_status status = next && order ? SUNDER_OK : sunder_i_no_memory(err);
    for (uint64_t i = 0; i < all && status == SUNDER_OK; i++)
        status = go_on(g->options, &of_bands, i, all) ? add_band(g, next, order[i], err) : sunder_i_cancelled(err);
    sunder_i_free(next);
    sunder_i_free(order);
    return status;
}

/* ---- Cells between the bands ---- */

/* Does a vertex that no band covers lie in F + c, for the inner point c of some piece (dilation) or of all (erosion)?
 * It is not on the boundary of any. */
static sunder_status is_inside(stage *g, uint32_t vertex, bool *in, sunder_error *err)
{
    const bool any = g->figure->rings > 0;
    *in = any && g->erode;
    if (!sunder_i_step()) return sunder_i_no_memory(err);
    for (uint32_t j = 0; any && j < g->element->pieces && *in == g->erode; j++) {
        const sunder_i_mark mark = sunder_i_arena_mark(&g->scratch);
        sunder_i_arena *s = &g->scratch;
        const sunder_i_rational_point at =
            sunder_i_rational_sub(s, *sunder_i_planar_map_vertex_point(g->bands, vertex), g->element->inner[j]);
        if (!s->failed) *in = is_in_figure(&g->solid, s, at);
        if (s->failed) return sunder_i_no_memory(err);
        sunder_i_arena_release(s, mark);
    }
    return SUNDER_OK;
}

static sunder_status sort_faces(stage *g, bool *face, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (uint32_t f = 1; f < sunder_i_planar_map_face_end(g->bands) && status == SUNDER_OK; f++) {
        const bool covered = sunder_i_planar_map_face_covered(g->bands, f) != 0;
        face[f] = covered && !g->erode;
        if (!covered)
            status = is_inside(g, sunder_i_planar_map_origin(g->bands, sunder_i_planar_map_face_outer(g->bands, f)),
                               &face[f], err);
    }
    return status;
}

/* Parts without area: edges and vertices between covered faces. Others belong to a face, and are asked in vain. */
static sunder_status sort_rest(stage *g, bool *edge, bool *vertex, sunder_error *err)
{
    const sunder_i_planar_map *map = g->bands;
    sunder_status status = SUNDER_OK;
    for (uint32_t e = 0; e < sunder_i_planar_map_edge_end(map) && status == SUNDER_OK; e++)
        if (sunder_i_planar_map_edge_alive(map, e) && sunder_i_planar_map_edge_covered(map, e) == 0 &&
            sunder_i_planar_map_left_covered(map, 2 * e) && sunder_i_planar_map_left_covered(map, 2 * e + 1))
            status = is_inside(g, sunder_i_planar_map_origin(map, 2 * e), &edge[e], err);
    for (uint32_t v = 0; v < sunder_i_planar_map_vertex_end(map) && status == SUNDER_OK; v++)
        if (sunder_i_planar_map_vertex_alive(map, v) && sunder_i_planar_map_vertex_covered(map, v) == 0 &&
            sunder_i_planar_map_vertex_out(map, v) == SUNDER_I_NOWHERE)
            status = is_inside(g, v, &vertex[v], err);
    return status;
}

static sunder_status read_cells(stage *g, sunder_sum *sum, sunder_error *err)
{
    sunder_status status = sunder_i_planar_map_faces(g->bands, err);
    if (status != SUNDER_OK) return status;
    bool *face = sunder_i_calloc(sunder_i_planar_map_face_end(g->bands), sizeof *face);
    bool *edge = sunder_i_calloc(sunder_i_planar_map_edge_end(g->bands), sizeof *edge);
    bool *vertex = sunder_i_calloc(sunder_i_planar_map_vertex_end(g->bands), sizeof *vertex);
    const sunder_i_inside inside = {face, g->erode ? edge : NULL, g->erode ? vertex : NULL};
    status = face && edge && vertex ? sort_faces(g, face, err) : sunder_i_no_memory(err);
    if (status == SUNDER_OK && g->erode) status = sort_rest(g, edge, vertex, err);
    if (status == SUNDER_OK) status = sunder_i_sum_from_cells(g->bands, &inside, sum, err);
    sunder_i_free(face);
    sunder_i_free(edge);
    sunder_i_free(vertex);
    return status;
}

static sunder_status dilate_or_erode(stage *g, sunder_sum *sum, sunder_error *err)
{
    static const sunder_sum_options defaults;
    if (!g->options) g->options = &defaults;
    g->random = g->options->seed;
    sunder_status status = sunder_i_planar_map_new(&sum->lattice, sunder_i_draw(&g->random), &g->bands, err);
    if (status == SUNDER_OK) status = unite_bands(g, err);
    if (status == SUNDER_OK && g->figure->rings && !solid_init(&g->solid, g->figure, &sum->lattice))
        status = sunder_i_no_memory(err);
    if (status == SUNDER_OK) status = read_cells(g, sum, err);
    sunder_i_planar_map_free(g->bands);
    solid_free(&g->solid);
    sunder_i_arena_free(&g->scratch);
    SUNDER_I_ASSERT(status != SUNDER_OK || !sunder_i_canonical_check(sum));
    return status;
}

sunder_status sunder_i_dilate_figure(const sunder_i_figure *figure, const sunder_i_structuring_element *element,
                                     const sunder_sum_options *options, sunder_sum *sum, sunder_error *err)
{
    stage g = {.figure = figure, .element = element, .options = options};
    return dilate_or_erode(&g, sum, err);
}

sunder_status sunder_i_erode_figure(const sunder_i_figure *figure, const sunder_i_structuring_element *element,
                                    const sunder_sum_options *options, sunder_sum *sum, sunder_error *err)
{
    stage g = {.figure = figure, .element = element, .options = options, .erode = true};
    return dilate_or_erode(&g, sum, err);
}
