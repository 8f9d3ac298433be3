/* part_rows.c: see part_internal.h. */
#include "shards/parts/part_internal.h"

#include "base/array.h"
#include "geometry/gis_box.h"

/* Which requested features are in no world, and may have other neighbours in rows than the part gives them? */
static bool is_undecided(const gis_part *p, size_t k)
{
    return p->item[k].wanted && !p->decided[k] && sunder_report_world(p->report, k) == SIZE_MAX;
}

static void decide(gis_part *p)
{
    for (size_t k = 0; k < p->n; k++) {
        double reach[4];
        if (!is_undecided(p, k)) continue;
        sunder_report_row_reach(p->report, k, reach);
        p->decided[k] = gis_part_knows(p, reach);
    }
}

/* Adds a feature that is undecided to the world `to`, whose items are the last ones of the result. */
static bool add_undecided(gis_part *p, size_t k, gis_part_world *to, gis_error *error)
{
    gis_part_result *out = p->out;
    sunder_footprint footprint = {.world = SIZE_MAX};
    gis_box_clear(footprint.read);
    gis_box_clear(footprint.wrote);
    sunder_report_row_reach(p->report, k, footprint.seen);
    if (!GIS_PART_MORE(out, footprint, footprints, 1, error) || !gis_part_fill_row(p, k, error)) return false;
    out->footprint[out->footprints++] = footprint;
    if (to->rows == 0) to->first = gis_part_index_of(p, k);
    to->rows++;
    to->footprints++;
    return true;
}

/* Adds all features that are undecided as one incomplete world, so that they are separated again together with what
 * they lack. */
static bool add_undecided_world(gis_part *p, gis_error *error)
{
    gis_part_result *out = p->out;
    gis_part_world to = gis_part_world_at(out);
    to.run = p->run;
    for (size_t k = 0; k < p->n; k++)
        if (is_undecided(p, k) && !add_undecided(p, k, &to, error)) return false;
    if (to.rows == 0) return true;
    if (!GIS_PART_MORE(out, world, worlds, 1, error)) return false;
    out->world[out->worlds++] = to;
    return true;
}

/* Adds each pair that has a feature both requested and decided. */
static bool add_pairs(gis_part *p, const sunder_row_pair *pair, size_t n, bool hidden, gis_error *error)
{
    for (size_t k = 0; k < n; k++) {
        const size_t f = pair[k].feature[0], g = pair[k].feature[1];
        const bool first = p->item[f].wanted && p->decided[f], second = p->item[g].wanted && p->decided[g];
        if ((first || second) && !gis_part_fill_neighbours(p, &pair[k], hidden, error)) return false;
    }
    return true;
}

bool gis_part_fill_rows(gis_part *p, gis_error *error)
{
    size_t n, hidden;
    const sunder_row_pair *pair = sunder_report_row_pairs(p->report, &n);
    const sunder_row_pair *with_hidden = sunder_report_hidden_row_pairs(p->report, &hidden);
    if (!p->layout->how.rows) return true;
    decide(p);
    return add_pairs(p, pair, n, false, error) &&
           (!p->layout->how.keep_trees || add_pairs(p, with_hidden, hidden, true, error)) &&
           add_undecided_world(p, error);
}
