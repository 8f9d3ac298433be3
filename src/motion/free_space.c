/* free_space.c: free space is the complement of the union of the parts.
 *
 * The obstacles, the robot rotated by half a turn, and a disc if there is a gap, are converted to lists of convex
 * pieces on one lattice that can represent the sums of all three. Directions are ranked once, so that pieces are summed
 * by merging. The sums of obstacle pieces and robot pieces are the parts. Their outline is computed by the stages of
 * outline/ in one run, and its stretches are kept: shortest paths can bend at their ends.
 *
 *   an obstacle without area   a line gives pieces of two corners, a point one of one corner: see diagonals.h
 *   no obstacles               no parts and no outline; every leg is free
 *   repaired shapes            corners may have denominators: the lattice can represent them */
#include "motion/free_space.h"

#include "morphology/morphology.h"
#include "motion/diagonals.h"
#include "outline/contained_parts.h"
#include "outline/outline.h"
#include "predicate/predicate.h"

#include "base/extremes.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* The number of sides of the disc by which a gap grows the robot; the public interface states it. */
#define GAP_SEGMENTS 64

typedef struct maker {
    const sunder_obstacle *obstacle;
    size_t n;
    const sunder_shape *robot, *disc; /* disc is NULL without a gap */
    const sunder_sum_options *options;
    sunder_i_lattice *lattice;
    sunder_i_free_space *out;
    sunder_i_convex_pieces obstacles, robots, discs;
    sunder_i_diagonals diagonals; /* empty if diagonals make no difference */
} maker;

/* ---- The lattice ---- */

static void join_extent(sunder_i_extent *all, const sunder_i_extent *e)
{
    if (!e->any) return;
    if (!all->any) {
        *all = *e;
        return;
    }
    for (int k = 0; k < 2; k++) {
        all->low[k] = sunder_i_min(all->low[k], e->low[k]);
        all->high[k] = sunder_i_max(all->high[k], e->high[k]);
    }
    if (e->low_bit < all->low_bit) all->low_bit = e->low_bit;
}

/* Widens *e by the extent of the disc, `by`, so that sums of two operands with extent *e represent the sums of all
 * three. */
static void grow_extent(sunder_i_extent *e, const sunder_i_extent *by)
{
    for (int k = 0; k < 2; k++) {
        e->low[k] = nextafter(e->low[k] + by->low[k], -INFINITY);
        e->high[k] = nextafter(e->high[k] + by->high[k], INFINITY);
    }
    if (by->low_bit < e->low_bit) e->low_bit = by->low_bit;
}

static bool clamp_extent(sunder_i_extent *e)
{
    bool inside = true;
    for (int k = 0; k < 2; k++) {
        inside = inside && isfinite(e->low[k]) && isfinite(e->high[k]);
        e->low[k] = sunder_i_max(sunder_i_min(e->low[k], DBL_MAX), -DBL_MAX);
        e->high[k] = sunder_i_max(sunder_i_min(e->high[k], DBL_MAX), -DBL_MAX);
    }
    return inside;
}

/* Chooses a lattice that represents all coordinates exactly, also those of repaired shapes, which may have
 * denominators. */
static void choose_lattice(maker *m)
{
    sunder_i_extent extent[3] = {{0}, {0}, {0}};
    bool rational = m->robot->rational;
    for (size_t i = 0; i < m->n; i++) {
        const sunder_obstacle *o = &m->obstacle[i];
        if (o->shape) {
            const sunder_i_extent one = sunder_i_shape_extent(o->shape);
            join_extent(&extent[0], &one);
            rational = rational || o->shape->rational;
        }
        for (size_t k = 0, from = 0; k < o->lines; from = o->line_end[k++])
            sunder_i_extent_add(&extent[0], o->xy + 2 * from, o->line_end[k] - from);
    }
    extent[1] = sunder_i_shape_extent(m->robot);
    extent[1].low_bit -= (int)m->diagonals.bits;
    if (m->disc) {
        extent[2] = sunder_i_shape_extent(m->disc);
        grow_extent(&extent[1], &extent[2]);
    }
    const bool inside = clamp_extent(&extent[1]);
    double origin[3][2];
    sunder_i_lattice *l = m->lattice;
    sunder_i_lattice_init(l, extent, 3, inside, origin, !inside);
    if (rational) sunder_i_lattice_admit_ratios(l);
    memcpy(m->out->sum->origin[0], origin[0], sizeof origin[0]);
    for (int k = 0; k < 2; k++) m->out->sum->origin[1][k] = origin[1][k] == 0 ? 0 : -origin[1][k];
}

static sunder_i_point put_double(sunder_i_lattice *l, const double xy[2], const double origin[2])
{
    return (sunder_i_point){sunder_i_lattice_int(l, xy[0], origin[0]), sunder_i_lattice_int(l, xy[1], origin[1])};
}

static sunder_i_point put_vertex(sunder_i_lattice *l, const sunder_shape *shape, uint32_t v, const double origin[2])
{
    if (shape->rational && shape->form->numbers->exact[v].den.size)
        return sunder_i_place_exact(l, &shape->form->numbers->exact[v], NULL, origin);
    return put_double(l, shape->xy + 2 * (size_t)v, origin);
}

/* ---- Pieces ---- */

/* Returns the lattice points of all vertices of a shape, rotated by half a turn if `reflect`. The caller frees the
 * array. Returns NULL if out of memory. */
static sunder_i_point *put_vertices(sunder_i_lattice *l, const sunder_shape *shape, const double origin[2],
                                    bool reflect)
{
    sunder_i_point *at = sunder_i_alloc(shape->vertices, sizeof *at);
    for (uint32_t v = 0; at && v < shape->vertices; v++) {
        at[v] = put_vertex(l, shape, v, origin);
        if (reflect) at[v] = sunder_i_point_neg(l, at[v]);
    }
    return at;
}

static bool add_shape(sunder_i_lattice *l, const sunder_shape *shape, const double origin[2],
                      sunder_i_convex_pieces *list)
{
    sunder_i_point *at = put_vertices(l, shape, origin, false);
    if (at) sunder_i_convex_pieces_add_shape(list, shape, at);
    sunder_i_free(at);
    return at != NULL;
}

/* Appends the pieces of a line of an obstacle: its segments without those of length 0, or, if there are no others, its
 * point. */
static void add_line(sunder_i_lattice *l, const double *xy, size_t n, const double origin[2],
                     sunder_i_convex_pieces *list)
{
    const uint32_t before = list->n;
    for (size_t i = 0; i + 1 < n; i++) {
        const double *a = xy + 2 * i, *b = a + 2;
        if (a[0] == b[0] && a[1] == b[1]) continue;
        sunder_i_convex_pieces_add_corner(list, put_double(l, a, origin), true);
        sunder_i_convex_pieces_add_corner(list, put_double(l, b, origin), true);
        list->end[list->n++] = list->corners;
    }
    if (n == 0 || list->n > before) return;
    sunder_i_convex_pieces_add_corner(list, put_double(l, xy, origin), true);
    list->end[list->n++] = list->corners;
}

/* Adds the pieces of the robot rotated by half a turn, and the quadrilaterals of its diagonals. */
static bool add_robot(maker *m)
{
    const double origin[2] = {-m->out->sum->origin[1][0], -m->out->sum->origin[1][1]};
    sunder_i_point *at = put_vertices(m->lattice, m->robot, origin, true);
    if (!at) return false;
    sunder_i_convex_pieces_add_shape(&m->robots, m->robot, at);
    sunder_i_diagonals_add(&m->diagonals, m->lattice, at, &m->robots);
    sunder_i_free(at);
    return true;
}

static size_t piece_corners(const sunder_shape *s) { return s->pieces ? s->piece_end[s->pieces - 1] : 0; }

static bool make_pieces(maker *m)
{
    size_t pieces = 0, corners = 0;
    for (size_t i = 0; i < m->n; i++) {
        const sunder_obstacle *o = &m->obstacle[i];
        const size_t points = o->lines ? o->line_end[o->lines - 1] : 0;
        pieces += (o->shape ? o->shape->pieces : 0) + points;
        corners += (o->shape ? piece_corners(o->shape) : 0) + 2 * points;
    }
    sunder_i_free_space *out = m->out;
    out->piece_obstacle = sunder_i_alloc(pieces, sizeof *out->piece_obstacle);
    if (!out->piece_obstacle || !sunder_i_convex_pieces_init(&m->obstacles, pieces, corners) ||
        !sunder_i_convex_pieces_init(&m->robots, m->robot->pieces + m->diagonals.n,
                                     piece_corners(m->robot) + 4 * m->diagonals.n))
        return false;
    sunder_i_lattice *l = m->lattice;
    const double *origin = out->sum->origin[0];
    for (size_t i = 0; i < m->n; i++) {
        const sunder_obstacle *o = &m->obstacle[i];
        uint32_t before = m->obstacles.n;
        if (o->shape && !add_shape(l, o->shape, origin, &m->obstacles)) return false;
        for (size_t k = 0, from = 0; k < o->lines; from = o->line_end[k++])
            add_line(l, o->xy + 2 * from, o->line_end[k] - from, origin, &m->obstacles);
        for (; before < m->obstacles.n; before++) out->piece_obstacle[before] = (uint32_t)i;
    }
    if (!add_robot(m)) return false;
    if (m->disc) {
        static const double zero[2] = {0, 0};
        if (!sunder_i_convex_pieces_init(&m->discs, m->disc->pieces, piece_corners(m->disc))) return false;
        if (!add_shape(l, m->disc, zero, &m->discs)) return false;
    }
    return !l->arena.failed;
}

static bool make_parts(maker *m)
{
    sunder_i_convex_pieces *list[3] = {&m->obstacles, &m->robots, &m->discs};
    if (!sunder_i_convex_pieces_rank(m->lattice, list, m->disc ? 3 : 2, &m->out->directions)) return false;
    if (m->disc) {
        sunder_i_convex_pieces grown;
        if (!sunder_i_convex_pieces_sum(&m->robots, &m->discs, &grown)) return false;
        sunder_i_convex_pieces_free(&m->robots);
        m->robots = grown;
    }
    m->out->robot_pieces = m->robots.n;
    return sunder_i_convex_pieces_sum(&m->obstacles, &m->robots, &m->out->part);
}

/* Sets the approximate doubles of the corners of parts, and the error bound of the filter. Returns false if out of
 * memory. */
static bool measure_parts(maker *m)
{
    sunder_i_lattice *l = m->lattice;
    const sunder_i_convex_pieces *part = &m->out->part;
    double most = 1;
    m->out->corner = sunder_i_alloc(part->corners, sizeof *m->out->corner);
    if (!m->out->corner) return false;
    for (uint32_t i = 0; i < part->corners; i++) {
        double *at = m->out->corner[i];
        at[0] = sunder_i_approx(l, part->corner[i].x);
        at[1] = sunder_i_approx(l, part->corner[i].y);
        most = sunder_i_max(most, sunder_i_max(fabs(at[0]), fabs(at[1])));
    }
    /* The vertices of the outline are in the convex hull of the corners of parts; the double of a vertex has an error
     * of at most 2^-49 of its size (predicate/hpoint.c), that of a lattice point one of 2^-53. */
    m->out->filter = (sunder_i_filter){l, 0x1p-48 * most};
    return true;
}

/* ---- The outline ---- */

static sunder_status keep_stretches(sunder_i_coverage *coverage, void *user, sunder_error *err)
{
    sunder_i_free_space *out = user;
    out->stretch = sunder_i_alloc(coverage->stretches, sizeof *out->stretch);
    if (!out->stretch) return sunder_i_failure_cause(err);
    memcpy(out->stretch, coverage->stretch, coverage->stretches * sizeof *out->stretch);
    out->stretches = coverage->stretches;
    return SUNDER_OK;
}

static sunder_status find_outline(maker *m, sunder_error *err)
{
    sunder_i_convex_pieces *part = &m->out->part;
    if (part->n == 0) return SUNDER_OK;
    const sunder_status status = sunder_i_drop_contained_sides(part, err);
    if (status != SUNDER_OK) return status;
    return sunder_i_outline_find(part, m->options, keep_stretches, m->out, m->out->sum, err);
}

static sunder_status make_space(maker *m, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    choose_lattice(m);
    if (!make_pieces(m) || !make_parts(m) || !measure_parts(m)) status = sunder_i_failure_cause(err);
    if (status == SUNDER_OK) status = find_outline(m, err);
    if (status == SUNDER_OK && (!sunder_i_part_tree_build(m->out) || m->lattice->arena.failed))
        status = sunder_i_failure_cause(err);
    return status;
}

static sunder_status build_space(maker *m, sunder_error *err)
{
    m->out->sum = sunder_i_calloc(1, sizeof *m->out->sum);
    if (!m->out->sum) return sunder_i_failure_cause(err);
    m->out->sum->method.algorithm = SUNDER_ALGORITHM_CONVOLUTION;
    m->lattice = &m->out->sum->lattice;
    const sunder_status status = make_space(m, err);
    sunder_i_convex_pieces_free(&m->obstacles);
    sunder_i_convex_pieces_free(&m->robots);
    sunder_i_convex_pieces_free(&m->discs);
    return status;
}

/* Builds free space for obstacles without area. For these the diagonals make a difference, and so do common boundaries
 * of the robot's polygons. (With a disc they make none, and this function is not called.) */
static sunder_status build_with_lines(maker *m, sunder_error *err)
{
    sunder_shape *whole;
    sunder_status status = sunder_i_without_seams(m->robot, &whole, err);
    if (status != SUNDER_OK) return status;
    if (whole) m->robot = whole;
    status = sunder_i_diagonals_find(m->robot, &m->diagonals) ? build_space(m, err) : sunder_i_failure_cause(err);
    sunder_i_diagonals_free(&m->diagonals);
    sunder_shape_free(whole);
    return status;
}

sunder_status sunder_i_free_space_build(const sunder_obstacle *obstacles, size_t n, const sunder_shape *robot,
                                        double gap, const sunder_sum_options *options, sunder_i_free_space *out,
                                        sunder_error *err)
{
    sunder_shape *disc = NULL;
    memset(out, 0, sizeof *out);
    if (gap > 0) {
        const sunder_status status = sunder_shape_disc(gap, GAP_SEGMENTS, false, &disc, err);
        if (status != SUNDER_OK) return status;
    }
    maker m = {.obstacle = obstacles, .n = n, .robot = robot, .disc = disc, .options = options, .out = out};
    bool lines = false;
    for (size_t i = 0; i < n && !lines; i++) lines = obstacles[i].lines > 0;
    const sunder_status status = lines && !disc ? build_with_lines(&m, err) : build_space(&m, err);
    sunder_shape_free(disc);
    if (status != SUNDER_OK) sunder_i_free_space_free(out);
    return status;
}

void sunder_i_free_space_free(sunder_i_free_space *space)
{
    sunder_sum_free(space->sum);
    sunder_i_convex_pieces_free(&space->part);
    sunder_i_directions_free(&space->directions);
    sunder_i_free_all(space->corner, space->piece_obstacle, space->stretch, space->tree.part, space->tree.boxes.box);
    memset(space, 0, sizeof *space);
}
