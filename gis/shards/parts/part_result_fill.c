/* part_result_fill.c: see part_internal.h. Features and barriers are identified by their places in the input; lines of
 * the proof are stored with the conflict or tree that they belong to. */
#include "shards/parts/part_internal.h"

#include "base/array.h"
#include "base/core_error.h"
#include "layer/barriers/barrier.h"
#include "layer/output.h"

#include <math.h>
#include <stdint.h>

static const gis_spooled_barrier *barrier_of(const gis_part *p, size_t thing)
{
    return thing >= p->n && thing != SIZE_MAX ? &p->barriers.item[thing - p->n] : NULL;
}

size_t gis_part_index_of(const gis_part *p, size_t thing)
{
    const gis_spooled_barrier *barrier = barrier_of(p, thing);
    if (barrier) return p->layout->features + barrier->number;
    return thing < p->n ? p->item[thing].feature.index : SIZE_MAX;
}

/* Adds the name of a thing, unless it is SIZE_MAX, and counts it in *names. */
static bool add_name(gis_part *p, size_t *names, size_t thing, gis_error *error)
{
    gis_part_name name = {.index = gis_part_index_of(p, thing)};
    if (name.index == SIZE_MAX) return true;
    const gis_spooled_barrier *barrier = barrier_of(p, thing);
    name.fid = barrier ? barrier->fid : p->item[thing].feature.fid;
    const char *text = barrier ? barrier->layer : p->item[thing].feature.id;
    if (!gis_part_add_text(p->out, text, &name.id, error) || !GIS_PART_MORE(p->out, name, names, 1, error))
        return false;
    p->out->name[p->out->names++] = name;
    ++*names;
    return true;
}

/* Fills in the shape that feature k of the part has instead of its own, if it does. */
static bool fill_level(gis_part *p, size_t k, gis_part_row *row, gis_error *error)
{
    const size_t level = sunder_report_level(p->report, k);
    double centre[2], radius;
    sunder_error why;
    if (!level || row->status == SUNDER_FEATURE_HIDDEN) return true;
    const size_t rung = gis_levels_rung(&p->levels, k, level);
    const sunder_shape *shape = gis_levels_shape(&p->levels, k, rung);
    if (sunder_shape_largest_disc(shape, centre, &radius, &why) != SUNDER_OK)
        return gis_core_failed(error, "sunder_siz", &why);
    row->rung = (uint32_t)rung + 1;
    row->kind = p->levels.kind[rung];
    row->lost = 1 - sunder_shape_area(shape) / sunder_shape_area(p->item[k].feature.demands.shape);
    row->size = 2 * radius;
    return gis_part_add_shape(p->out, shape, &row->now, error);
}

bool gis_part_fill_row(gis_part *p, size_t k, gis_error *error)
{
    const gis_spool_feature *f = &p->item[k].feature;
    gis_part_row row = {.index = f->index,
                        .fid = f->fid,
                        .from = {f->start[0], f->start[1]},
                        .weight = f->demands.weight,
                        .status = sunder_report_status(p->report, k),
                        .rounded = sunder_report_rounded(p->report, k)};
    sunder_report_move(p->report, k, &row.move[0], &row.move[1]);
    if (isnan(row.from[0])) sunder_shape_anchor(f->demands.shape, row.from);
    if (!fill_level(p, k, &row, error) || !gis_part_add_text(p->out, f->id, &row.id, error) ||
        !GIS_PART_MORE(p->out, row, rows, 1, error))
        return false;
    p->out->row[p->out->rows++] = row;
    return true;
}

static bool take_line(gis_part *p, gis_part_line *to, gis_error *error)
{
    gis_text *made = &p->lines.json.text;
    const char *line = gis_text_get(made);
    const bool done = line ? gis_part_add_line(p->out, line, made->length + 1, to, error) : gis_no_memory(error);
    gis_text_empty(made);
    p->lines.json.need_comma = false;
    return done;
}

bool gis_part_fill_conflict(gis_part *p, size_t number, bool loose, gis_error *error)
{
    size_t n;
    gis_part_result *out = p->out;
    const sunder_conflict *c = &sunder_report_conflicts(p->report, &n)[number];
    gis_part_conflict to = {.is = *c, .blocker = out->blockers, .name = out->names, .loose = loose};
    if (p->lines.report) {
        gis_proof_conflict(&p->lines, number);
        if (!take_line(p, &to.line, error)) return false;
    }
    if (!GIS_PART_MORE(out, conflict, conflicts, 1, error) ||
        !GIS_PART_MORE(out, blocker, blockers, c->n_blocked_by, error))
        return false;
    to.is.a = gis_part_index_of(p, c->a);
    to.is.b = gis_part_index_of(p, c->b);
    to.is.need_gone = gis_part_index_of(p, c->need_gone);
    to.is.blocked_by = NULL;
    bool done = add_name(p, &to.names, c->a, error) && add_name(p, &to.names, c->b, error) &&
                add_name(p, &to.names, c->need_gone, error);
    for (size_t k = 0; k < c->n_blocked_by && done; k++) {
        out->blocker[out->blockers++] = gis_part_index_of(p, c->blocked_by[k]);
        done = add_name(p, &to.names, c->blocked_by[k], error);
    }
    out->conflict[out->conflicts++] = to;
    return done;
}

/* Sets `at` to the anchor of a feature after its move, and returns its FID. */
static int64_t moved_anchor(const gis_part *p, size_t thing, double at[2])
{
    double move[2];
    sunder_report_move(p->report, thing, &move[0], &move[1]);
    sunder_shape_anchor(p->item[thing].feature.demands.shape, at);
    for (int c = 0; c < 2; c++) at[c] += move[c];
    return p->item[thing].feature.fid;
}

bool gis_part_fill_push(gis_part *p, const sunder_push *push, gis_error *error)
{
    const gis_spooled_barrier *barrier = barrier_of(p, push->b);
    gis_part_push to = {.is = *push};
    to.fid[0] = moved_anchor(p, push->a, to.from);
    if (barrier)
        gis_barrier_corner(&barrier->demands.geometry, to.from, to.to);
    else
        to.fid[1] = moved_anchor(p, push->b, to.to);
    if (barrier) to.fid[1] = barrier->fid;
    to.is.a = gis_part_index_of(p, push->a);
    to.is.b = gis_part_index_of(p, push->b);
    if (!gis_part_add_text(p->out, barrier ? barrier->layer : NULL, &to.layer, error) ||
        !GIS_PART_MORE(p->out, push, pushes, 1, error))
        return false;
    p->out->push[p->out->pushes++] = to;
    return true;
}

bool gis_part_fill_tree(gis_part *p, const gis_proof_place *place, gis_error *error)
{
    size_t n;
    gis_part_tree to = {gis_part_index_of(p, place->first), place->among, {0}};
    if (!gis_proof_tree(&p->lines, &sunder_report_bound_trees(p->report, &n)[place->tree], error) ||
        !take_line(p, &to.line, error) || !GIS_PART_MORE(p->out, tree, trees, 1, error))
        return false;
    p->out->tree[p->out->trees++] = to;
    return true;
}

bool gis_part_fill_hidden(gis_part *p, size_t k, const sunder_clause *why, gis_error *error)
{
    gis_part_result *out = p->out;
    const gis_hidden_row row = gis_hidden_row_of(k, p->item[k].feature.hiding, why);
    gis_part_hidden to = {.index = gis_part_index_of(p, k),
                          .cost = row.cost,
                          .blocker = out->blockers,
                          .things = row.things,
                          .name = out->names,
                          .proved = row.proved,
                          .forced = row.forced};
    if (!GIS_PART_MORE(out, hidden, hiddens, 1, error) || !GIS_PART_MORE(out, blocker, blockers, row.things, error) ||
        !add_name(p, &to.names, k, error))
        return false;
    for (size_t m = 0; m < row.things; m++) {
        out->blocker[out->blockers++] = gis_part_index_of(p, row.thing[m]);
        if (row.thing[m] != k && !add_name(p, &to.names, row.thing[m], error)) return false;
    }
    out->hidden[out->hiddens++] = to;
    return true;
}

/* Adds the line that was made. */
static bool add_told(gis_part *p, gis_part_told_kind kind, size_t first, size_t among, gis_error *error)
{
    gis_part_told to = {.first = gis_part_index_of(p, first), .among = among, .kind = kind};
    if (!take_line(p, &to.line, error) || !GIS_PART_MORE(p->out, told, tolds, 1, error)) return false;
    p->out->told[p->out->tolds++] = to;
    return true;
}

bool gis_part_fill_shapes(gis_part *p, size_t k, gis_error *error)
{
    size_t level = 0;
    bool ok = true;
    if (!p->choices.told || !p->choices.told[k]) return true;
    for (size_t rung = 0; rung < p->levels.rungs && ok; rung++) {
        const sunder_shape *shape = gis_levels_shape(&p->levels, k, rung);
        if (!shape) continue;
        gis_proof_shape(&p->lines, k, ++level, rung, shape);
        ok = add_told(p, GIS_TOLD_SHAPE, k, level, error);
    }
    return ok;
}

bool gis_part_fill_clause(gis_part *p, const gis_proof_place *place, gis_error *error)
{
    size_t n;
    gis_proof_clause(&p->lines, &sunder_report_clauses(p->report, &n)[place->tree]);
    return add_told(p, GIS_TOLD_CLAUSE, place->first, place->among, error);
}

bool gis_part_fill_choice(gis_part *p, const gis_proof_place *place, gis_error *error)
{
    gis_proof_choice(&p->lines, place->tree, p->choices.number, true);
    return add_told(p, GIS_TOLD_CHOICE, place->first, place->among, error);
}

bool gis_part_fill_component(gis_part *p, size_t number, gis_error *error)
{
    gis_part_result *out = p->out;
    size_t n;
    sunder_hiding_component to = sunder_report_hiding_components(p->report, &n)[number];
    const sunder_hiding_class *class = sunder_report_component_classes(p->report, &n) + to.first_class;
    if (!GIS_PART_MORE(out, component, components, 1, error) || !GIS_PART_MORE(out, class, classes, to.classes, error))
        return false;
    for (size_t k = 0; k < to.classes; k++) out->class[out->classes++] = class[k];
    to.feature = gis_part_index_of(p, to.feature);
    to.first_class = 0; /* the classes of all components of the world are summed */
    out->component[out->components++] = to;
    return true;
}

bool gis_part_fill_neighbours(gis_part *p, const sunder_row_pair *pair, bool hidden, gis_error *error)
{
    gis_part_neighbours to = {.is = *pair, .hidden = hidden};
    for (int c = 0; c < 2; c++) {
        const gis_spool_feature *f = &p->item[pair->feature[c]].feature;
        sunder_shape_anchor(f->demands.shape, to.anchor[c]);
        to.fid[c] = f->fid;
        to.is.feature[c] = gis_part_index_of(p, pair->feature[c]);
        to.is.block[c] = gis_part_index_of(p, pair->block[c]);
    }
    if (!GIS_PART_MORE(p->out, neighbour, neighbours, 1, error)) return false;
    p->out->neighbour[p->out->neighbours++] = to;
    return true;
}
