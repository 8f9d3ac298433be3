/* rectilinear_union.c: the contours along both axes are joined at their ends and traced like all outlines
 * (outline/boundary.h). Ends on rows are sorted by y, then x, ends on columns by x, then y; a counting sort converts
 * the former order to the latter, and the vertices are then numbered lexicographically in one pass over both. */
#include "rectilinear/rectilinear_union.h"

#include "base/watch.h"
#include "outline/boundary.h"
#include "rectilinear/contour.h"

enum { ROWS, COLUMNS, KINDS }; /* rows: lines along x, perpendicular to the y axis; columns: lines along y */

typedef struct place {
    uint32_t x, y;
} place;

typedef struct joiner {
    const sunder_i_ranked_rectangles *in;
    sunder_i_contour contour[KINDS];
    place *end[KINDS]; /* the ends of stretches, each once along its line */
    uint32_t ends[KINDS];
    uint32_t *order;  /* [ends[ROWS]] the ends on rows, sorted by column */
    uint32_t *vertex; /* [ends[ROWS]] the vertex of each */
} joiner;

static place place_at(int kind, uint32_t line, uint32_t at)
{
    return kind == ROWS ? (place){at, line} : (place){line, at};
}

/* Returns true if stretch i begins where the previous one ends. */
static bool goes_on(const sunder_i_contour *c, size_t i)
{
    return i > 0 && c->stretch[i - 1].line == c->stretch[i].line && c->stretch[i - 1].to == c->stretch[i].from;
}

static bool list_ends(joiner *j, int kind)
{
    const sunder_i_contour *c = &j->contour[kind];
    if (c->stretches > UINT32_MAX / 4) return sunder_i_too_many();
    place *end = j->end[kind] = sunder_i_alloc(2 * c->stretches, sizeof *end);
    if (!end) return false;
    uint32_t n = 0;
    for (size_t i = 0; i < c->stretches; i++) {
        const sunder_i_contour_stretch *s = &c->stretch[i];
        if (!goes_on(c, i)) end[n++] = place_at(kind, s->line, s->from);
        end[n++] = place_at(kind, s->line, s->to);
    }
    j->ends[kind] = n;
    return true;
}

/* Sorts the ends on rows by column. Returns false if out of memory. */
static bool sort_rows(joiner *j)
{
    const uint32_t n = j->ends[ROWS], columns = j->in->places[0];
    uint32_t *start = sunder_i_calloc((size_t)columns + 1, sizeof *start);
    j->order = sunder_i_alloc(n, sizeof *j->order);
    if (start && j->order) {
        for (uint32_t i = 0; i < n; i++) start[j->end[ROWS][i].x + 1]++;
        for (uint32_t x = 0; x < columns; x++) start[x + 1] += start[x];
        for (uint32_t i = 0; i < n; i++) j->order[start[j->end[ROWS][i].x]++] = i;
    }
    sunder_i_free(start);
    return start && j->order && sunder_i_steps(n / 16 + 1);
}

static bool add_vertex(const joiner *j, sunder_i_coverage *to, sunder_i_lattice *lattice, place at)
{
    const sunder_i_point p = {j->in->at[0][at.x], j->in->at[1][at.y]};
    const sunder_i_hpoint h = sunder_i_hpoint_of(lattice, p);
    return sunder_i_vertex_table_append(&to->vertices, &h) != SUNDER_I_NO_VERTEX;
}

static bool place_before(place p, place q) { return p.x != q.x ? p.x < q.x : p.y < q.y; }

/* Sets the vertex of every end: ends on rows in j->vertex, ends on columns, in their order, in `column`. Returns false
 * if out of memory. */
static bool number_vertices(joiner *j, sunder_i_coverage *to, sunder_i_lattice *lattice, uint32_t *column)
{
    const uint32_t rows = j->ends[ROWS], columns = j->ends[COLUMNS];
    for (uint32_t i = 0, k = 0; i < rows || k < columns;) {
        const uint32_t row = i < rows ? j->order[i] : 0, vertex = (uint32_t)to->vertices.n;
        const bool first = i < rows && (k == columns || !place_before(j->end[COLUMNS][k], j->end[ROWS][row]));
        const bool second = k < columns && (i == rows || !place_before(j->end[ROWS][row], j->end[COLUMNS][k]));
        if (!add_vertex(j, to, lattice, first ? j->end[ROWS][row] : j->end[COLUMNS][k])) return false;
        if (first) j->vertex[row] = vertex, i++;
        if (second) column[k++] = vertex;
        lattice->counts.segment_intersections += first && second;
    }
    return true;
}

/* The region before a row is on its right, below it; the region before a column is on its left. */
static uint8_t banks_of(int kind, uint32_t sides)
{
    const bool left = sides & (kind == ROWS ? SUNDER_I_COVERED_AFTER : SUNDER_I_COVERED_BEFORE);
    const bool right = sides & (kind == ROWS ? SUNDER_I_COVERED_BEFORE : SUNDER_I_COVERED_AFTER);
    return (uint8_t)((left ? SUNDER_I_BANK_LEFT : 0) | (right ? SUNDER_I_BANK_RIGHT : 0));
}

/* Adds the stretches. Lines are numbered by their ranks, columns after rows. */
static void add_stretches(const joiner *j, int kind, const uint32_t *vertex, sunder_i_coverage *to)
{
    const sunder_i_contour *c = &j->contour[kind];
    const uint32_t first_line = kind == ROWS ? 0 : j->in->places[1];
    uint32_t n = 0;
    for (size_t i = 0; i < c->stretches; i++, n++) {
        const sunder_i_contour_stretch *s = &c->stretch[i];
        n += !goes_on(c, i);
        to->stretch[to->stretches++] =
            (sunder_i_outline_stretch){first_line + s->line, vertex[n - 1], vertex[n], banks_of(kind, s->sides)};
    }
}

static bool join_ends(joiner *j, sunder_i_lattice *lattice, sunder_i_coverage *to)
{
    if (!list_ends(j, ROWS) || !list_ends(j, COLUMNS) || !sort_rows(j)) return false;
    const size_t stretches = j->contour[ROWS].stretches + j->contour[COLUMNS].stretches;
    const size_t vertices = (size_t)j->ends[ROWS] + j->ends[COLUMNS] + j->contour[ROWS].points;
    if (vertices > UINT32_MAX / 2) return sunder_i_too_many();
    uint32_t *column = sunder_i_alloc(j->ends[COLUMNS], sizeof *column);
    j->vertex = sunder_i_alloc(j->ends[ROWS], sizeof *j->vertex);
    to->vertices.lattice = lattice;
    to->sorted = true;
    bool ok = column && j->vertex &&
              sunder_i_reserve(&to->stretch, &to->stretches_capacity, stretches, sizeof *to->stretch) &&
              sunder_i_reserve(&to->vertices.point, &to->vertices.capacity,
                               (size_t)(j->ends[ROWS] > j->ends[COLUMNS] ? j->ends[ROWS] : j->ends[COLUMNS]) + 1,
                               sizeof *to->vertices.point) &&
              number_vertices(j, to, lattice, column);
    if (ok) {
        add_stretches(j, ROWS, j->vertex, to);
        add_stretches(j, COLUMNS, column, to);
    }
    for (size_t i = 0; ok && i < j->contour[ROWS].points; i++) {
        const sunder_i_contour_point p = j->contour[ROWS].point[i];
        ok = add_vertex(j, to, lattice, place_at(ROWS, p.line, p.at));
    }
    sunder_i_free(column);
    return ok;
}

static const sunder_i_point along[KINDS] = {{1, 0}, {0, 1}};

/* One side represents each line: its beginning and the rank of its direction. */
typedef struct grid_lines {
    sunder_i_point *at;
    uint32_t *rank;
} grid_lines;

static void add_line(const grid_lines *g, sunder_i_lines *out, sunder_i_point at, uint32_t kind)
{
    g->at[out->n] = at;
    g->rank[out->n] = kind;
    out->side[out->n] = out->n;
    out->n++;
}

static bool make_lines(const sunder_i_ranked_rectangles *in, sunder_i_lines *out, grid_lines *g)
{
    const size_t n = (size_t)in->places[0] + in->places[1];
    g->at = sunder_i_alloc(n, sizeof *g->at);
    g->rank = sunder_i_alloc(n, sizeof *g->rank);
    *out = (sunder_i_lines){.side = sunder_i_alloc(n, sizeof *out->side),
                            .corner = g->at,
                            .rank = g->rank,
                            .direction = along,
                            .classes = KINDS};
    if (!out->side || !g->at || !g->rank) return false;
    for (uint32_t y = 0; y < in->places[1]; y++) add_line(g, out, (sunder_i_point){in->at[0][0], in->at[1][y]}, ROWS);
    for (uint32_t x = 0; x < in->places[0]; x++)
        add_line(g, out, (sunder_i_point){in->at[0][x], in->at[1][0]}, COLUMNS);
    return true;
}

sunder_status sunder_i_rectangles_unite(const sunder_i_ranked_rectangles *rectangles, sunder_sum *sum,
                                        sunder_error *err)
{
    joiner j = {.in = rectangles};
    sunder_i_coverage coverage = {0};
    sunder_i_lines lines = {0};
    grid_lines g = {0};
    const bool ok = sunder_i_contour_find(rectangles, 1, &j.contour[ROWS]) &&
                    sunder_i_contour_find(rectangles, 0, &j.contour[COLUMNS]) &&
                    join_ends(&j, &sum->lattice, &coverage) && make_lines(rectangles, &lines, &g);
    for (int kind = 0; kind < KINDS; kind++) {
        sunder_i_contour_free(&j.contour[kind]);
        sunder_i_free(j.end[kind]);
    }
    sunder_i_free_all(j.order, j.vertex);
    const sunder_status status =
        ok ? sunder_i_boundary_build(&sum->lattice, 2, &lines, &coverage, sum, err) : sunder_i_failure_cause(err);
    sunder_i_coverage_free(&coverage);
    sunder_i_lines_free(&lines);
    sunder_i_free_all(g.at, g.rank);
    return status;
}
