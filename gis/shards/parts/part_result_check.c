/* part_result_check.c: see part_result_check.h. Checksums detect accidental changes, but a forger can write matching
 * checksums. So every number that is used as an index is checked against the number of items. */
#include "shards/parts/part_result_check.h"

#include <string.h>

static bool range_is_within(size_t from, size_t n, size_t all) { return from <= all && n <= all - from; }

/* Is the byte of a stored bool 0 or 1? Reading any other value as a bool is undefined behaviour. */
static bool is_flag(const bool *flag)
{
    unsigned char byte;
    memcpy(&byte, flag, sizeof byte);
    return byte <= 1;
}

static bool is_text(const gis_part_result *r, size_t at) { return at == GIS_NO_TEXT || at < r->texts; }

static bool is_line(const gis_part_result *r, const gis_part_line *line)
{
    return line->file != 0 || line->bytes == 0 || range_is_within((size_t)line->from, (size_t)line->bytes, r->lines);
}

static bool is_place(size_t index, uint64_t places) { return places == 0 || index < places; }

/* Is it the kind of a pair in a layer, not of a breach of rules by moves? */
static bool is_kind(sunder_conflict_kind kind)
{
    return (unsigned)kind <= SUNDER_CONFLICT_DUPLICATE || kind == SUNDER_CONFLICT_TIGHT;
}

static bool is_status(sunder_feature_status status) { return (unsigned)status <= SUNDER_FEATURE_HIDDEN; }

static bool are_worlds(const gis_part_result *r, uint64_t places)
{
    for (size_t k = 0; k < r->worlds; k++) {
        const gis_part_world *w = &r->world[k];
        if (!is_place(w->first, places) || !is_flag(&w->complete) || !is_flag(&w->gone) || !is_flag(&w->loose) ||
            !range_is_within(w->row, w->rows, r->rows) ||
            !range_is_within(w->footprint, w->footprints, r->footprints) ||
            !range_is_within(w->bound, w->bounds, r->bounds) ||
            !range_is_within(w->conflict, w->conflicts, r->conflicts) ||
            !range_is_within(w->push, w->pushes, r->pushes) || !range_is_within(w->tree, w->trees, r->trees) ||
            !range_is_within(w->component, w->components, r->components) ||
            !range_is_within(w->class, w->classes, r->classes) || !range_is_within(w->hidden, w->hiddens, r->hiddens) ||
            !range_is_within(w->told, w->tolds, r->tolds))
            return false;
    }
    return true;
}

static bool are_rows(const gis_part_result *r, uint64_t places)
{
    for (size_t k = 0; k < r->rows; k++)
        if (!is_place(r->row[k].index, places) || !is_text(r, r->row[k].id) || !is_status(r->row[k].status) ||
            !is_flag(&r->row[k].rounded) || !gis_part_shape_is_sound(r, &r->row[k].now) ||
            (unsigned)r->row[k].kind >= GIS_RUNGS)
            return false;
    for (size_t k = 0; k < r->stills; k++)
        if (!is_place(r->still[k].index, places) || !is_status(r->still[k].status)) return false;
    for (size_t k = 0; k < r->links; k++)
        if (!is_place(r->link[k].a, places) || !is_place(r->link[k].b, places)) return false;
    return true;
}

/* Do the `names` names from `name` on contain that of this feature or barrier? */
static bool is_named(const gis_part_result *r, size_t name, size_t names, size_t index)
{
    for (size_t k = 0; k < names; k++)
        if (r->name[name + k].index == index) return true;
    return false;
}

static bool conflict_names(const gis_part_result *r, const gis_part_conflict *c, size_t index)
{
    return is_named(r, c->name, c->names, index);
}

static bool are_hidden(const gis_part_result *r)
{
    for (size_t k = 0; k < r->hiddens; k++) {
        const gis_part_hidden *h = &r->hidden[k];
        if (!is_flag(&h->proved) || !is_flag(&h->forced) || !range_is_within(h->blocker, h->things, r->blockers) ||
            !range_is_within(h->name, h->names, r->names) || !is_named(r, h->name, h->names, h->index))
            return false;
        for (size_t m = 0; m < h->things; m++)
            if (!is_named(r, h->name, h->names, r->blocker[h->blocker + m])) return false;
    }
    for (size_t k = 0; k < r->components; k++)
        if (!is_flag(&r->component[k].best)) return false;
    return true;
}

/* Is the conflict sound, and does its list of names contain all features and barriers that it mentions? */
static bool is_conflict(const gis_part_result *r, const gis_part_conflict *c, uint64_t places)
{
    const sunder_conflict *is = &c->is;
    bool sound = is_place(is->a, places) && is_place(is->b, places) && is_flag(&is->inside_block) &&
                 is_flag(&is->crowded) && is_flag(&is->by_row) && is_flag(&c->loose) && is_line(r, &c->line) &&
                 is_kind(is->kind) && (unsigned)is->reason <= SUNDER_REASON_ROW &&
                 range_is_within(c->blocker, is->n_blocked_by, r->blockers) &&
                 range_is_within(c->name, c->names, r->names) && conflict_names(r, c, is->a) &&
                 conflict_names(r, c, is->b) && (is->need_gone == SIZE_MAX || conflict_names(r, c, is->need_gone));
    for (size_t k = 0; sound && k < is->n_blocked_by; k++) sound = conflict_names(r, c, r->blocker[c->blocker + k]);
    return sound;
}

static bool are_conflicts(const gis_part_result *r, uint64_t places)
{
    for (size_t k = 0; k < r->names; k++)
        if (!is_place(r->name[k].index, places) || !is_text(r, r->name[k].id)) return false;
    for (size_t k = 0; k < r->conflicts; k++)
        if (!is_conflict(r, &r->conflict[k], places)) return false;
    return true;
}

static bool are_others(const gis_part_result *r, uint64_t places)
{
    for (size_t k = 0; k < r->pushes; k++)
        if (!is_place(r->push[k].is.a, places) || !is_place(r->push[k].is.b, places) || !is_text(r, r->push[k].layer))
            return false;
    for (size_t k = 0; k < r->neighbours; k++)
        if (!(r->neighbour[k].is.feature[0] < r->neighbour[k].is.feature[1]) ||
            !is_place(r->neighbour[k].is.feature[1], places) || !is_flag(&r->neighbour[k].hidden))
            return false;
    for (size_t k = 0; k < r->trees; k++)
        if (!is_line(r, &r->tree[k].line)) return false;
    for (size_t k = 0; k < r->tolds; k++)
        if (!is_line(r, &r->told[k].line) || r->told[k].kind >= GIS_TOLD_KINDS) return false;
    return true;
}

bool gis_part_result_is_sound(const gis_part_result *result, uint64_t places)
{
    return (result->texts == 0 || result->text[result->texts - 1] == '\0') && are_worlds(result, places) &&
           are_rows(result, places) && are_conflicts(result, places) && are_hidden(result) &&
           are_others(result, places);
}
