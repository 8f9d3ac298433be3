/* links.c: see links.h. */
#include "layer/links/links.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool gis_links_parse(const char *text, gis_links_request *out, gis_error *error)
{
    static const char key[] = ",layer=";
    out->dataset = malloc(strlen(text) + 1);
    if (!out->dataset) return gis_no_memory(error);
    strcpy(out->dataset, text);
    char *comma = strstr(out->dataset, key);
    if (!comma) return true;
    *comma = '\0';
    out->layer = comma + strlen(key);
    return true;
}

void gis_links_request_clear(gis_links_request *request)
{
    free(request->dataset);
    *request = (gis_links_request){0};
}

void gis_links_clear(gis_links *links)
{
    free(links->link);
    free(links->at);
    gis_triangulation_clear(&links->starts);
    *links = (gis_links){0};
}

/* ---- The grid ---------------------------------------------------------------------------------------------------- */

/* Places far outside are looked for at the edge of what the triangulation admits; they are beyond its boundary, too. */
static int64_t on_grid(double x, double origin, double cell)
{
    const double most = 2 * (double)GIS_GRID_CELLS, off = (x - origin) / cell;
    return llround(fmax(-most, fmin(most, off)));
}

static gis_grid_point place_of(const gis_links *links, const double at[2])
{
    return (gis_grid_point){on_grid(at[0], links->origin[0], links->cell),
                            on_grid(at[1], links->origin[1], links->cell)};
}

/* Chooses the least power of two as side of a cell with which all starts are on the grid. */
static void lay_grid(gis_links *links)
{
    double box[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    int exponent;
    for (size_t k = 0; k < links->n; k++)
        for (int c = 0; c < 2; c++) {
            box[c] = fmin(box[c], links->link[k].from[c]);
            box[c + 2] = fmax(box[c + 2], links->link[k].from[c]);
        }
    const double extent = fmax(box[2] - box[0], box[3] - box[1]);
    frexp(extent > 0 ? extent : 1, &exponent);
    links->cell = ldexp(1, exponent - 30);
    memcpy(links->origin, box, sizeof links->origin);
    for (size_t k = 0; k < links->n; k++) links->link[k].at = place_of(links, links->link[k].from);
}

static int by_place(const void *a, const void *b)
{
    const gis_link *p = a, *q = b;
    if (p->at.x != q->at.x) return p->at.x < q->at.x ? -1 : 1;
    if (p->at.y != q->at.y) return p->at.y < q->at.y ? -1 : 1;
    return (p->fid > q->fid) - (p->fid < q->fid);
}

static bool keep_different(gis_links *links, const char *who, gis_error *error)
{
    size_t kept = 0;
    for (size_t k = 0; k < links->n; k++) {
        const gis_link *last = kept ? &links->link[kept - 1] : NULL, *next = &links->link[k];
        if (!last || last->at.x != next->at.x || last->at.y != next->at.y)
            links->link[kept++] = *next;
        else if (last->move[0] != next->move[0] || last->move[1] != next->move[1])
            return gis_fail(error, "--links %s: FID %lld and FID %lld start at one place and end at different ones",
                            who, (long long)last->fid, (long long)next->fid);
    }
    links->n = kept;
    return true;
}

bool gis_links_begin(gis_links *links, const char *who, gis_error *error)
{
    if (links->n == 0) return true;
    lay_grid(links);
    qsort(links->link, links->n, sizeof *links->link, by_place);
    if (!keep_different(links, who, error)) return false;
    links->at = malloc(links->n * sizeof *links->at);
    if (!links->at) return gis_no_memory(error);
    for (size_t k = 0; k < links->n; k++) links->at[k] = links->link[k].at;
    return gis_triangulate(links->at, links->n, &links->starts) || gis_no_memory(error);
}

/* ---- Interpolation ----------------------------------------------------------------------------------------------- */

/* Adds the share of a link to a move. */
static void add_share(const gis_links *links, size_t k, double share, double move[2])
{
    for (int c = 0; c < 2; c++) move[c] += share * links->link[k].move[c];
}

static void move_in_triangle(const gis_links *links, size_t triangle, gis_grid_point p, double move[2])
{
    const size_t *corner = links->starts.triangle[triangle].corner;
    const gis_grid_point *at = links->at;
    const double all = gis_grid_area(at[corner[0]], at[corner[1]], at[corner[2]]);
    for (int k = 0; k < 3; k++)
        add_share(links, corner[k], gis_grid_area(p, at[corner[(k + 1) % 3]], at[corner[(k + 2) % 3]]) / all, move);
}

/* The share in [0, 1] of b in the point of the segment ab nearest to (x, y), and its squared distance from there. */
static double nearest_share(gis_grid_point a, gis_grid_point b, double x, double y, double *squared)
{
    const double ux = (double)(b.x - a.x), uy = (double)(b.y - a.y), vx = x - (double)a.x, vy = y - (double)a.y;
    const double length = ux * ux + uy * uy, s = length > 0 ? fmax(0, fmin(1, (ux * vx + uy * vy) / length)) : 0;
    const double dx = vx - s * ux, dy = vy - s * uy;
    *squared = dx * dx + dy * dy;
    return s;
}

/* The move of the nearest point of the boundary, or of the line that all starts are on. */
static void move_at_rim(const gis_links *links, double x, double y, double move[2])
{
    const gis_triangulation *t = &links->starts;
    const bool closed = t->triangles > 0;
    double least = INFINITY, share = 0;
    size_t a = t->rim[0], b = t->rim[0];
    for (size_t k = closed ? 0 : 1; k < t->rims; k++) {
        const size_t p = t->rim[k ? k - 1 : t->rims - 1], q = t->rim[k];
        double squared;
        const double s = nearest_share(links->at[p], links->at[q], x, y, &squared);
        if (!(squared < least)) continue;
        least = squared;
        share = s;
        a = p;
        b = q;
    }
    add_share(links, a, 1 - share, move);
    add_share(links, b, share, move);
}

/* The squared distance from (x, y), in cells, to the nearest start, if it is less than `most`; else `most`. The starts
 * are sorted by x: the search goes left and right from there. */
static double nearest_start(const gis_links *links, double x, double y, double most)
{
    size_t low = 0, high = links->n;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if ((double)links->at[middle].x < x)
            low = middle + 1;
        else
            high = middle;
    }
    for (int way = 0; way < 2; way++)
        for (size_t k = way ? low : low - 1; k < links->n; k += way ? 1 : SIZE_MAX) {
            const double dx = (double)links->at[k].x - x, dy = (double)links->at[k].y - y;
            if (dx * dx >= most) break;
            most = fmin(most, dx * dx + dy * dy);
        }
    return most;
}

void gis_links_move(gis_links *links, const double at[2], double move[2])
{
    move[0] = move[1] = 0;
    if (links->n == 0) return;
    const double x = (at[0] - links->origin[0]) / links->cell, y = (at[1] - links->origin[1]) / links->cell;
    double factor = 1;
    if (isfinite(links->radius)) {
        const double radius = links->radius / links->cell;
        const double off = sqrt(nearest_start(links, x, y, radius * radius));
        factor = off < radius ? fmin(1, 2 - 2 * off / radius) : 0;
    }
    if (!(factor > 0)) return;
    const gis_grid_point p = place_of(links, at);
    const size_t triangle = gis_triangulation_locate(&links->starts, p, &links->hint);
    if (triangle != GIS_NO_TRIANGLE)
        move_in_triangle(links, triangle, p, move);
    else
        move_at_rim(links, x, y, move);
    move[0] *= factor;
    move[1] *= factor;
}
