/* attach.c: the group of each feature of INPUT: the one that held all its vertices, the nearest one, or the one that a
 * field names. */
#include "follow/follow.h"

#include "base/interrupt.h"
#include "follow/geometry_distance.h"
#include "read/fields.h"

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
    const int side = gis_follow_side(&h->targets->target[target], &h->at);
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

/* Visible before hidden; then the one with the most vertices in its interior; then the first in MOVED. */
static bool is_better(const holders *h, const candidate *a, const candidate *b)
{
    const bool p = h->targets->target[a->target].hidden, q = h->targets->target[b->target].hidden;
    if (p != q) return q;
    if (a->interior != b->interior) return a->interior > b->interior;
    return a->target < b->target;
}

static bool attach_inside(gis_follow *f, const double *xy, size_t n, gis_follow_place *out, gis_error *error)
{
    holders h = {.targets = &f->targets, .any = true};
    bool ok = true;
    for (; ok && h.any && h.vertex < n; h.vertex++) {
        const double *at = xy + 2 * h.vertex, box[4] = {at[0], at[1], at[0], at[1]};
        h.at = (sunder_point){at[0], at[1]};
        h.any = false;
        ok = gis_follow_near(&f->targets, box, 0, look_for_holders, &h, error) && (!h.failed || gis_no_memory(error));
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
    const gis_follow_targets *targets;
    OGRGeometryH geometry;
    double least;
    size_t target;
} nearest;

/* Distances are computed in doubles; of equal ones the first in MOVED counts. */
static bool look_for_nearest(void *user, size_t i)
{
    nearest *n = user;
    const gis_follow_target *target = &n->targets->target[i];
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
    nearest n = {&f->targets, geometry, nextafter(f->within, INFINITY), f->targets.n};
    if (!gis_follow_near(&f->targets, box, f->within, look_for_nearest, &n, error)) return false;
    if (n.target < f->targets.n) *out = (gis_follow_place){GIS_FOLLOW_MOVED, n.target};
    return true;
}

/* ---- By a field -------------------------------------------------------------------------------------------------- */

typedef struct named {
    char *key; /* owned */
    size_t target;
} named;

typedef struct names {
    int field;   /* of INPUT */
    named *list; /* [n] sorted by key */
    size_t n;
} names;

static int by_key(const void *a, const void *b) { return strcmp(((const named *)a)->key, ((const named *)b)->key); }

static char *fid_key(const gis_source *source, size_t i)
{
    char text[32];
    snprintf(text, sizeof text, CPL_FRMT_GIB, gis_source_fid(source, i));
    char *copy = malloc(strlen(text) + 1);
    return copy ? strcpy(copy, text) : NULL;
}

static bool find_names(const gis_follow *f, names *out, gis_error *error)
{
    const gis_source *moved = f->targets.source;
    int id = -1;
    *out = (names){.field = -1};
    if (f->request->by != GIS_FOLLOW_FIELD) return true;
    if (!gis_field_find(f->input, "--by field", f->request->field, &out->field, error) ||
        !gis_field_find(moved, "--id-field", f->request->id_field, &id, error))
        return false;
    out->list = calloc(f->targets.n + 1, sizeof *out->list);
    if (!out->list) return gis_no_memory(error);
    for (size_t i = 0; i < f->targets.n; i++) {
        OGRFeatureH feature = gis_source_feature(moved, i);
        if (id >= 0 && gis_field_is_blank(feature, id)) continue;
        out->list[out->n] = (named){id >= 0 ? gis_field_key(feature, id) : fid_key(moved, i), i};
        if (!out->list[out->n++].key) return gis_no_memory(error);
    }
    qsort(out->list, out->n, sizeof *out->list, by_key);
    for (size_t k = 1; k < out->n; k++)
        if (by_key(&out->list[k - 1], &out->list[k]) == 0)
            return gis_fail(error, "MOVED: two features have the key %s; give an --id-field with unique values",
                            out->list[k].key);
    return true;
}

static void clear_names(names *list)
{
    for (size_t k = 0; k < list->n; k++) free(list->list[k].key);
    free(list->list);
}

static bool attach_named(const gis_follow *f, const names *list, size_t i, gis_follow_place *out, gis_error *error)
{
    OGRFeatureH feature = gis_source_feature(f->input, i);
    if (gis_field_is_blank(feature, list->field)) return true;
    const named wanted = {gis_field_key(feature, list->field), 0};
    if (!wanted.key) return gis_no_memory(error);
    const named *found = bsearch(&wanted, list->list, list->n, sizeof *list->list, by_key);
    if (found) *out = (gis_follow_place){GIS_FOLLOW_MOVED, found->target};
    free(wanted.key);
    return true;
}

/* ------------------------------------------------------------------------------------------------------------------ */

static bool attach(gis_follow *f, const names *list, size_t i, gis_error *error)
{
    gis_follow_place *out = &f->place[i];
    OGRGeometryH geometry = gis_source_geometry(f->input, i);
    double *xy;
    size_t n;
    *out = (gis_follow_place){GIS_FOLLOW_FREE, f->targets.n};
    if (!gis_geometry_points(geometry, &xy, &n, error)) return false;
    bool ok = true;
    if (n == 0)
        out->status = GIS_FOLLOW_EMPTY;
    else if (f->request->by == GIS_FOLLOW_INSIDE)
        ok = attach_inside(f, xy, n, out, error);
    else if (f->request->by == GIS_FOLLOW_NEAREST)
        ok = attach_nearest(f, geometry, out, error);
    else
        ok = attach_named(f, list, i, out, error);
    CPLFree(xy);
    if (!ok || out->status != GIS_FOLLOW_MOVED) return ok;
    const gis_follow_target *target = &f->targets.target[out->target];
    if (target->hidden)
        out->status = GIS_FOLLOW_HIDDEN;
    else if (target->move[0] == 0 && target->move[1] == 0)
        out->status = GIS_FOLLOW_UNMOVED;
    return true;
}

bool gis_follow_attach(gis_follow *follow, gis_progress *progress, gis_error *error)
{
    const size_t n = gis_source_count(follow->input);
    names list;
    follow->place = calloc(n + 1, sizeof *follow->place);
    bool ok = (follow->place != NULL || gis_no_memory(error)) && find_names(follow, &list, error);
    for (size_t i = 0; ok && i < n; i++)
        ok = gis_go_on(error) && gis_progress_call((double)i / (double)n, progress) && attach(follow, &list, i, error);
    if (follow->place) clear_names(&list);
    return ok;
}
