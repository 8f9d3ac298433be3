/* attach.c: the group of each feature of the layer: the one that held all its vertices, the nearest one, or the one
 * that a field names. */
#include "follow/follow_inner.h"

#include "base/interrupt.h"
#include "follow/geometry_distance.h"

#include <cpl_conv.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Inside ------------------------------------------------------------------------------------------------------ */

/* A group that held vertices. */
typedef struct candidate {
    size_t target;   /* the member that held the first vertex: one that had it in its interior before others */
    size_t seen;     /* 1 + the last vertex that was held */
    size_t interior; /* the number of vertices that were in the interior of a member */
    size_t last;     /* 1 + the last vertex in an interior */
} candidate;

typedef struct holders {
    const gis_follow *follow;
    const gis_follow_targets *targets;
    candidate *list;
    size_t n, capacity;
    size_t vertex;
    sunder_point at;
    bool any, failed; /* any: something holds this vertex; failed: memory is out */
} holders;

static candidate *candidate_of(holders *h, size_t target)
{
    for (size_t k = 0; k < h->n; k++)
        if (h->targets->target[h->list[k].target].group == h->targets->target[target].group) return &h->list[k];
    if (h->vertex > 0) return NULL;
    if (h->n == h->capacity) {
        const size_t more = h->capacity ? 2 * h->capacity : 8;
        candidate *list = realloc(h->list, more * sizeof *list);
        if (!list) {
            h->failed = true;
            return NULL;
        }
        h->list = list;
        h->capacity = more;
    }
    h->list[h->n] = (candidate){.target = target};
    return &h->list[h->n++];
}

static bool look_for_holders(void *user, size_t target)
{
    holders *h = user;
    const bool taken = gis_follow_takes(h->follow, target);
    const int side = taken ? gis_follow_side(&h->targets->target[target], &h->at) : -1;
    if (side < 0) return true;
    h->any = true;
    candidate *c = candidate_of(h, target);
    if (!c) return !h->failed;
    if (c->seen == h->vertex) c->seen++; /* held all vertices before */
    if (side > 0 && c->last <= h->vertex) {
        if (h->vertex == 0) c->target = target;
        c->last = h->vertex + 1;
        c->interior++;
    }
    return true;
}

/* Visible before hidden; then the one with the most vertices in its interior; then the first. */
static bool is_better(const holders *h, const candidate *a, const candidate *b)
{
    const bool p = h->targets->target[a->target].hidden, q = h->targets->target[b->target].hidden;
    if (p != q) return q;
    if (a->interior != b->interior) return a->interior > b->interior;
    return a->target < b->target;
}

static bool attach_inside(gis_follow *f, const double *xy, size_t n, gis_follow_place *out, gis_error *error)
{
    holders h = {.follow = f, .targets = f->targets, .any = true};
    bool ok = true;
    for (; ok && h.any && h.vertex < n; h.vertex++) {
        const double *at = xy + 2 * h.vertex, box[4] = {at[0], at[1], at[0], at[1]};
        h.at = (sunder_point){at[0], at[1]};
        h.any = false;
        ok = gis_follow_near(f->targets, box, 0, look_for_holders, &h, error) && (!h.failed || gis_no_memory(error));
    }
    const candidate *best = NULL;
    for (size_t k = 0; k < h.n; k++)
        if (h.list[k].seen == n && (!best || is_better(&h, &h.list[k], best))) best = &h.list[k];
    out->status = h.any ? GIS_FOLLOW_SEVERAL : GIS_FOLLOW_FREE;
    if (best && h.any) *out = (gis_follow_place){GIS_FOLLOW_MOVED, best->target};
    free(h.list);
    return ok;
}

/* ---- Nearest ----------------------------------------------------------------------------------------------------- */

typedef struct nearest {
    const gis_follow *follow;
    OGRGeometryH geometry;
    double least;
    size_t target;
} nearest;

/* Distances are computed in doubles; of equal ones the first target counts. */
static bool look_for_nearest(void *user, size_t i)
{
    nearest *n = user;
    const gis_follow_target *target = &n->follow->targets->target[i];
    if (!gis_follow_takes(n->follow, i)) return true;
    const double off = target->home ? gis_follow_distance(n->geometry, target->home)
                                    : gis_follow_distance_to_points(n->geometry, target->point, target->points);
    if (off < n->least) {
        n->least = off;
        n->target = i;
    }
    return true;
}

static bool attach_nearest(gis_follow *f, OGRGeometryH geometry, gis_follow_place *out, gis_error *error)
{
    OGREnvelope e;
    OGR_G_GetEnvelope(geometry, &e);
    const double box[4] = {e.MinX, e.MinY, e.MaxX, e.MaxY};
    nearest n = {f, geometry, nextafter(f->within, INFINITY), f->targets->n};
    if (!gis_follow_near(f->targets, box, f->within, look_for_nearest, &n, error)) return false;
    if (n.target < f->targets->n) *out = (gis_follow_place){GIS_FOLLOW_MOVED, n.target};
    return true;
}

/* ------------------------------------------------------------------------------------------------------------------ */

static bool attach(gis_follow *f, const gis_names *names, size_t i, gis_error *error)
{
    gis_follow_place *out = &f->place[i];
    OGRGeometryH geometry = gis_source_geometry(f->input, i);
    double *xy;
    size_t n;
    *out = (gis_follow_place){GIS_FOLLOW_FREE, f->targets->n};
    if (!gis_geometry_points(geometry, &xy, &n, error)) return false;
    bool ok = true;
    if (n == 0)
        out->status = GIS_FOLLOW_EMPTY;
    else if (f->request->by == GIS_FOLLOW_INSIDE)
        ok = attach_inside(f, xy, n, out, error);
    else if (f->request->by == GIS_FOLLOW_NEAREST)
        ok = attach_nearest(f, geometry, out, error);
    else
        ok = gis_follow_attach_named(f, names, i, out, error);
    CPLFree(xy);
    if (!ok || out->status != GIS_FOLLOW_MOVED) return ok;
    const gis_follow_target *target = &f->targets->target[out->target];
    if (target->hidden)
        out->status = GIS_FOLLOW_HIDDEN;
    else if (target->move[0] == 0 && target->move[1] == 0)
        out->status = GIS_FOLLOW_UNMOVED;
    return true;
}

bool gis_follow_attach(gis_follow *follow, gis_progress *progress, gis_error *error)
{
    const size_t n = gis_source_count(follow->input);
    gis_names names = {0};
    follow->place = calloc(n + 1, sizeof *follow->place);
    bool ok = (follow->place != NULL || gis_no_memory(error)) && gis_follow_find_names(follow, &names, error);
    for (size_t i = 0; ok && i < n; i++)
        ok = gis_go_on(error) && (!progress || gis_progress_call((double)i / (double)n, progress)) &&
             attach(follow, &names, i, error);
    free(names.list);
    return ok;
}
