/* follow_layers.c: writes the layer with its features at their new places, and what became of each. */
#include "follow/follow_inner.h"

#include "base/interrupt.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *gis_follow_status_string(gis_follow_status status)
{
    static const char *const word[GIS_FOLLOW_STATUSES + 1] = {
        [GIS_FOLLOW_MOVED] = "moved",     [GIS_FOLLOW_UNMOVED] = "unmoved", [GIS_FOLLOW_FREE] = "free",
        [GIS_FOLLOW_SEVERAL] = "several", [GIS_FOLLOW_HIDDEN] = "hidden",   [GIS_FOLLOW_OUTSIDE] = "outside",
        [GIS_FOLLOW_EMPTY] = "empty",     [GIS_FOLLOW_STATUSES] = ""};
    return word[status < GIS_FOLLOW_STATUSES ? status : GIS_FOLLOW_STATUSES];
}

/* ---- Vertices that are shared ------------------------------------------------------------------------------------ */

/* A vertex before and after. */
typedef struct trip {
    double from[2], to[2];
} trip;

typedef struct trips {
    trip *list;
    size_t n, capacity;
} trips;

static bool note_trip(trips *all, const double from[2], const double to[2], gis_error *error)
{
    if (all->n == all->capacity) {
        const size_t more = all->capacity ? 2 * all->capacity : 1024;
        trip *list = realloc(all->list, more * sizeof *list);
        if (!list) return gis_no_memory(error);
        all->list = list;
        all->capacity = more;
    }
    all->list[all->n++] = (trip){{from[0], from[1]}, {to[0], to[1]}};
    return true;
}

static int by_place(const void *a, const void *b)
{
    const trip *p = a, *q = b;
    const double u[4] = {p->from[0], p->from[1], p->to[0], p->to[1]},
                 v[4] = {q->from[0], q->from[1], q->to[0], q->to[1]};
    for (int k = 0; k < 4; k++)
        if (u[k] != v[k]) return u[k] < v[k] ? -1 : 1;
    return 0;
}

/* Returns the number of places that had one vertex before and have several now. Sorts the list. */
static size_t count_torn(trips *all)
{
    size_t torn = 0;
    qsort(all->list, all->n, sizeof *all->list, by_place);
    for (size_t i = 0, j; i < all->n; i = j) {
        bool apart = false;
        const trip *t = all->list;
        for (j = i + 1; j < all->n && t[j].from[0] == t[i].from[0] && t[j].from[1] == t[i].from[1]; j++)
            apart = apart || t[j].to[0] != t[i].to[0] || t[j].to[1] != t[i].to[1];
        torn += apart;
    }
    return torn;
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

typedef struct carrying {
    gis_follow *follow;
    size_t target; /* n: the feature stays */
    bool kept;
    trips *all;
} carrying;

static bool carry_vertex(void *user, double xy[2], gis_error *error)
{
    carrying *c = user;
    double to[2] = {xy[0], xy[1]};
    const gis_follow_targets *targets = c->follow->targets;
    if (c->target < targets->n && !gis_follow_carry(targets, c->target, xy, to, &c->kept, error)) return false;
    if (!note_trip(c->all, xy, to, error)) return false;
    memcpy(xy, to, sizeof to);
    return true;
}

static gis_value fid_of_target(const gis_follow *f, const gis_follow_place *place)
{
    return gis_fid_as_value(place->target < f->targets->n ? f->targets->target[place->target].fid : OGRNullFID);
}

static gis_value layer_of_target(const gis_follow *f, const gis_follow_place *place)
{
    const char *layer = place->target < f->targets->n ? f->targets->target[place->target].layer : NULL;
    return layer ? (gis_value){GIS_TEXT, {.text = layer}} : (gis_value){.kind = GIS_NULL};
}

static bool write_feature(gis_sink_layer *layer, gis_follow *f, size_t i, trips *all, gis_error *error)
{
    gis_follow_place *place = &f->place[i];
    const bool moves = place->status == GIS_FOLLOW_MOVED;
    carrying c = {f, moves ? place->target : f->targets->n, true, all};
    OGRGeometryH old = gis_source_geometry(f->input, i), geometry = old ? OGR_G_Clone(old) : NULL;
    if (old && !geometry) return gis_no_memory(error);
    if (!gis_geometry_change(geometry, carry_vertex, &c, error)) {
        OGR_G_DestroyGeometry(geometry);
        return false;
    }
    if (!c.kept) place->status = GIS_FOLLOW_OUTSIDE;
    f->count[place->status]++;
    const double *move = moves ? f->targets->target[place->target].move : (const double[2]){0, 0};
    const gis_value values[] = {{GIS_REAL, {.real = move[0]}},
                                {GIS_REAL, {.real = move[1]}},
                                {GIS_TEXT, {.text = gis_follow_status_string(place->status)}},
                                fid_of_target(f, place),
                                layer_of_target(f, place)};
    return gis_sink_write(layer, gis_source_feature(f->input, i), geometry, values, error);
}

bool gis_follow_write(gis_sink *sink, size_t main, gis_follow *follow, gis_error *error)
{
    static const gis_field fields[] = {{"sunder_dx", OFTReal, 0},
                                       {"sunder_dy", OFTReal, 0},
                                       {"sunder_st", OFTString, 7},
                                       {"sunder_to", OFTInteger64, 0},
                                       {"sunder_lay", OFTString, 0}};
    const gis_sink_layer_request request = {.suffix = "",
                                            .main = main,
                                            .like_source = true,
                                            .as_source = true,
                                            .fields = fields,
                                            .n_fields = sizeof fields / sizeof *fields - (follow->layers ? 0 : 1),
                                            .style = GIS_STYLE_NONE};
    gis_sink_layer *layer;
    trips all = {0};
    bool ok = gis_sink_add(sink, &request, &layer, error);
    for (size_t i = 0; ok && i < gis_source_count(follow->input); i++)
        ok = gis_go_on(error) && write_feature(layer, follow, i, &all, error);
    if (ok) follow->torn = count_torn(&all);
    free(all.list);
    return ok;
}
