#include "generate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Boards of triangles ---- */

typedef struct side {
    int from, to; /* corners on the board, column + row * (columns + 1) */
    int part;     /* the edge-connected part that contains its triangle */
    bool done;
} side;

typedef struct tracer {
    const cells *c;
    side *s;
    int n;
    int *part; /* [triangles] union-find */
} tracer;

static int corner(const cells *c, int i, int j) { return i + j * (c->columns + 1); }

static int find(int *part, int t)
{
    while (part[t] != t) t = part[t] = part[part[t]];
    return t;
}

/* Corners of a triangle, counter-clockwise. */
static void triangle_corners(const cells *c, int i, int j, int upper, int out[3])
{
    const int a = corner(c, i, j), b = corner(c, i + 1, j), d = corner(c, i + 1, j + 1), e = corner(c, i, j + 1);
    const bool f = c->falling[i][j];
    const int t[4][3] = {{a, b, d}, {a, d, e}, {a, b, e}, {b, d, e}};
    memcpy(out, t[2 * f + upper], 3 * sizeof *out);
}

/* Adds the sides of a triangle; a side that is added from both triangles joins their parts and is not on the
 * outline. */
static void add_sides(tracer *t, int number, const int v[3])
{
    for (int k = 0; k < 3; k++) {
        const int from = v[k], to = v[(k + 1) % 3];
        int m = 0;
        while (m < t->n && !(t->s[m].from == to && t->s[m].to == from)) m++;
        if (m < t->n) {
            t->part[find(t->part, number)] = find(t->part, t->s[m].part);
            t->s[m] = t->s[--t->n];
        } else {
            t->s[t->n++] = (side){from, to, number, false};
        }
    }
}

/* The direction of a step on the board, in eighths of a turn: only the order of directions matters, and it is that of
 * the true slopes. */
static int octant(const tracer *t, int from, int to)
{
    const int w = t->c->columns + 1, dx = to % w - from % w, dy = to / w - from / w;
    static const int table[3][3] = {{5, 6, 7}, {4, -1, 0}, {3, 2, 1}};
    return table[dy + 1][dx + 1];
}

static int follow(const tracer *t, int e, bool pinched)
{
    const int back = octant(t, t->s[e].to, t->s[e].from);
    int best = -1, best_turn = 9;
    for (int f = 0; f < t->n; f++) {
        if (t->s[f].from != t->s[e].to || t->s[f].part != t->s[e].part) continue;
        int turn = (octant(t, t->s[f].from, t->s[f].to) - back + 8) % 8;
        if (pinched) turn = 8 - turn; /* clockwise: along the covered sector */
        if (turn < best_turn) best_turn = turn, best = f;
    }
    return best;
}

typedef struct walk {
    int *v;
    int n;
    double area;
} walk;

static double px(const cells *c, int v) { return c->x[v % (c->columns + 1)]; }
static double py(const cells *c, int v) { return c->y[v / (c->columns + 1)]; }

/* Area on the board with unit steps: its sign is that of the true area. */
static walk trace(tracer *t, int e, bool pinched, bool bends_only)
{
    const int w = t->c->columns + 1;
    walk r = {test_alloc((size_t)t->n, sizeof(int)), 0, 0};
    int f = e;
    do {
        const side *s = &t->s[f];
        t->s[f].done = true;
        r.area += (s->from % w) * (s->to / w) - (s->from / w) * (s->to % w);
        const int g = follow(t, f, pinched), d = octant(t, s->from, s->to), h = octant(t, t->s[g].from, t->s[g].to);
        /* the slopes of diagonals differ, unless steps are equal */
        if (!bends_only || d != h || d % 2) r.v[r.n++] = s->to;
        f = g;
    } while (f != e);
    return r;
}

static void put_walk(polyset *set, const cells *c, const walk *w)
{
    for (int i = 0; i < w->n; i++) polyset_vertex(set, px(c, w->v[i]), py(c, w->v[i]));
    polyset_end_ring(set);
}

void cells_outline(polyset *set, const cells *c, bool pinched, bool bends_only)
{
    const int triangles = 2 * c->columns * c->rows;
    tracer t = {c, test_alloc((size_t)(3 * triangles), sizeof(side)), 0, test_alloc((size_t)triangles, sizeof(int))};
    for (int k = 0; k < triangles; k++) t.part[k] = k;
    for (int k = 0; k < triangles; k++) {
        const int i = k / 2 % c->columns, j = k / 2 / c->columns;
        int v[3];
        if (!c->on[i][j][k % 2]) continue;
        triangle_corners(c, i, j, k % 2, v);
        add_sides(&t, k, v);
    }
    for (int e = 0; e < t.n; e++) t.s[e].part = find(t.part, t.s[e].part);
    for (int p = 0; p < triangles; p++) {
        walk *rings = NULL;
        size_t n = 0, outer = 0;
        for (int e = 0; e < t.n; e++) {
            if (t.s[e].done || t.s[e].part != p) continue;
            rings = test_resize(rings, n + 1, sizeof *rings);
            rings[n] = trace(&t, e, pinched, bends_only);
            if (rings[n].area > 0) outer = n;
            n++;
        }
        if (n) put_walk(set, c, &rings[outer]);
        for (size_t i = 0; i < n; i++) {
            if (i != outer) put_walk(set, c, &rings[i]);
            free(rings[i].v);
        }
        if (n) polyset_end_polygon(set);
        free(rings);
    }
    free(t.s);
    free(t.part);
}

static void lines(double *v, int n, rng *r, spacing kind, double base)
{
    static const double huge[] = {-1e300, -3e150, -1, -1e-150, -1e-300, 0, 2e-300, 1e-7, 1, 12345.75, 7e200, 1e300};
    double at = 0;
    for (int i = 0, k = 0; i <= n; i++) {
        switch (kind) {
        case SPACING_UNIT: v[i] = i; break;
        case SPACING_SMALL:
            v[i] = at;
            at += (double)rng_int(r, 1, 3);
            break;
        case SPACING_MAP:
            v[i] = rint((base + at) * 1000) / 1000;
            at += rng_once_in(r, 2) ? 4 : (double)rng_int(r, 500, 30000) / 1000;
            break;
        case SPACING_RAGGED:
            v[i] = at - 3;
            at += 0.1 + rng_unit(r);
            break;
        case SPACING_HUGE:
            k += (int)rng_int(r, 0, 11 - n + i - k);
            v[i] = huge[k++];
            break;
        }
    }
}

void random_cells(cells *c, rng *r, int columns, int rows, spacing kind, bool triangles, int percent)
{
    memset(c, 0, sizeof *c);
    c->columns = columns;
    c->rows = rows;
    lines(c->x, columns, r, kind, 451234.567);
    lines(c->y, rows, r, kind, 5411234.567);
    for (int i = 0; i < columns; i++)
        for (int j = 0; j < rows; j++) {
            c->falling[i][j] = rng_once_in(r, 2);
            c->on[i][j][0] = rng_int(r, 1, 100) <= percent;
            c->on[i][j][1] = triangles && rng_once_in(r, 2) ? rng_int(r, 1, 100) <= percent : c->on[i][j][0];
        }
    bool any = false;
    for (int i = 0; i < columns; i++)
        for (int j = 0; j < rows; j++) any = any || c->on[i][j][0] || c->on[i][j][1];
    if (!any) c->on[0][0][0] = true;
}

void pocket_for(cells *board, rng *r, const cells *peg, int slide)
{
    memset(board, 0, sizeof *board);
    board->columns = peg->columns + slide + 2;
    board->rows = peg->rows + 2;
    for (int i = 0; i <= board->columns; i++) board->x[i] = i;
    for (int j = 0; j <= board->rows; j++) board->y[j] = j;
    for (int i = 0; i < board->columns; i++)
        for (int j = 0; j < board->rows; j++) {
            board->falling[i][j] = rng_once_in(r, 2);
            board->on[i][j][0] = board->on[i][j][1] = true;
        }
    /* After a half turn a lower triangle is an upper one, and diagonals keep their direction. A square that triangles
     * of both kinds sweep over is emptied as a whole: there the pocket is wider than the peg. */
    for (int s = 0; s <= slide; s++)
        for (int i = 0; i < peg->columns; i++)
            for (int j = 0; j < peg->rows; j++)
                for (int u = 0; u < 2; u++) {
                    if (!peg->on[i][j][u]) continue;
                    const int x = 1 + s + peg->columns - 1 - i, y = 1 + peg->rows - 1 - j;
                    const bool fresh = board->on[x][y][0] && board->on[x][y][1];
                    if (fresh) board->falling[x][y] = peg->falling[i][j];
                    if (board->falling[x][y] == peg->falling[i][j])
                        board->on[x][y][1 - u] = false;
                    else
                        board->on[x][y][0] = board->on[x][y][1] = false;
                }
}

void polyset_map(polyset *set, double a, double b, double c, double d)
{
    for (size_t i = 0; i < set->vertices; i++) {
        const double x = set->xy[2 * i], y = set->xy[2 * i + 1];
        set->xy[2 * i] = a * x + b * y;
        set->xy[2 * i + 1] = c * x + d * y;
    }
}
