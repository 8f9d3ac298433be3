/* part_result.c: see part_result.h. What is done alike for all lists uses a table of them. As bytes, a result is: the
 * number of items in each list, and whether it is unverified; then the lists, each padded to a multiple of 8 bytes. */
#include "shards/parts/part_result.h"

#include "base/array.h"
#include "base/padding.h"
#include "disk/checksum.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

static const gis_padding holes_of_world[] = {GIS_PADDING_BETWEEN(gis_part_world, loose, run)};
static const gis_padding holes_of_row[] = {GIS_PADDING_BEHIND(gis_part_row, rounded)};
static const gis_padding holes_of_conflict[] = {GIS_PADDING_BETWEEN(gis_part_conflict, is.inside_block, is.need_shift),
                                                GIS_PADDING_BETWEEN(gis_part_conflict, is.by_row, blocker),
                                                GIS_PADDING_BEHIND(gis_part_conflict, loose)};
static const gis_padding holes_of_component[] = {GIS_PADDING_BEHIND(sunder_hiding_component, best)};
static const gis_padding holes_of_class[] = {GIS_PADDING_BETWEEN(sunder_hiding_class, hierarchy, hidden)};
static const gis_padding holes_of_hidden[] = {GIS_PADDING_BETWEEN(gis_part_hidden, cost.hierarchy, cost.weight),
                                              GIS_PADDING_BEHIND(gis_part_hidden, forced)};
static const gis_padding holes_of_neighbours[] = {GIS_PADDING_BEHIND(gis_part_neighbours, hidden)};
static const gis_padding holes_of_still[] = {GIS_PADDING_BEHIND(gis_part_still, status)};

#define HOLES(list) list, sizeof list / sizeof *list
#define LIST(member, number, ...)                                                                                      \
    {                                                                                                                  \
        offsetof(gis_part_result, member), offsetof(gis_part_result, number), offsetof(gis_part_result, room.member),  \
            sizeof *((gis_part_result *)0)->member, __VA_ARGS__                                                        \
    }

static const struct list {
    size_t at, count, room, size;
    const gis_padding *hole;
    size_t holes;
} lists[] = {LIST(world, worlds, HOLES(holes_of_world)),
             LIST(row, rows, HOLES(holes_of_row)),
             LIST(footprint, footprints, NULL, 0),
             LIST(bound, bounds, NULL, 0),
             LIST(conflict, conflicts, HOLES(holes_of_conflict)),
             LIST(blocker, blockers, NULL, 0),
             LIST(push, pushes, NULL, 0),
             LIST(tree, trees, NULL, 0),
             LIST(component, components, HOLES(holes_of_component)),
             LIST(class, classes, HOLES(holes_of_class)),
             LIST(hidden, hiddens, HOLES(holes_of_hidden)),
             LIST(told, tolds, NULL, 0),
             LIST(name, names, NULL, 0),
             LIST(still, stills, HOLES(holes_of_still)),
             LIST(link, links, NULL, 0),
             LIST(neighbour, neighbours, HOLES(holes_of_neighbours)),
             LIST(corner, corners, NULL, 0),
             LIST(end, ends, NULL, 0),
             LIST(text, texts, NULL, 0),
             LIST(line, lines, NULL, 0)};

enum { LISTS = sizeof lists / sizeof *lists };

static void **array_of(gis_part_result *r, int k) { return (void **)((char *)r + lists[k].at); }
static size_t *count_of(gis_part_result *r, int k) { return (size_t *)((char *)r + lists[k].count); }
static size_t *room_of(gis_part_result *r, int k) { return (size_t *)((char *)r + lists[k].room); }

void gis_part_result_clear(gis_part_result *result)
{
    for (int k = 0; k < LISTS; k++) free(*array_of(result, k));
    *result = (gis_part_result){0};
}

void gis_part_result_empty(gis_part_result *result)
{
    for (int k = 0; k < LISTS; k++) *count_of(result, k) = 0;
    result->unverified = false;
}

bool gis_part_add_text(gis_part_result *to, const char *text, size_t *at, gis_error *error)
{
    const size_t n = text ? strlen(text) + 1 : 0;
    *at = text ? to->texts : GIS_NO_TEXT;
    if (!text) return true;
    if (!GIS_PART_MORE(to, text, texts, n, error)) return false;
    memcpy(to->text + to->texts, text, n);
    to->texts += n;
    return true;
}

const char *gis_part_text(const gis_part_result *result, size_t at)
{
    return at == GIS_NO_TEXT ? NULL : result->text + at;
}

bool gis_part_add_line(gis_part_result *to, const char *line, size_t bytes, gis_part_line *at, gis_error *error)
{
    if (bytes > UINT32_MAX) return gis_fail(error, "a line of the proof is longer than 4 GB");
    if (!GIS_PART_MORE(to, line, lines, bytes, error)) return false;
    memcpy(to->line + to->lines, line, bytes);
    *at = (gis_part_line){to->lines, bytes, 0};
    to->lines += bytes;
    return true;
}

const char *gis_part_line_of(const gis_part_result *result, const gis_part_line *line)
{
    return result->line + line->from;
}

/* Copies a line into *to; a line that is in a file stays there. */
static bool copy_line(gis_part_result *to, const gis_part_result *from, gis_part_line *line, gis_error *error)
{
    if (line->file || line->bytes == 0) return true;
    return gis_part_add_line(to, gis_part_line_of(from, line), (size_t)line->bytes, line, error);
}

/* ---- Copies ------------------------------------------------------------------------------------------------------ */

bool gis_part_copy_row(gis_part_result *to, const gis_part_result *from, size_t row, gis_error *error)
{
    gis_part_row new = from->row[row];
    if (!gis_part_add_text(to, gis_part_text(from, new.id), &new.id, error) ||
        !gis_part_copy_shape(to, from, &new.now, error) || !GIS_PART_MORE(to, row, rows, 1, error))
        return false;
    to->row[to->rows++] = new;
    return true;
}

/* Copies n things from *blocker on, and `names` names from *name on, and sets the two to the places of the copies. */
static bool copy_things(gis_part_result *to, const gis_part_result *from, size_t n, size_t *blocker, size_t names,
                        size_t *name, gis_error *error)
{
    const size_t first = *name;
    if (!GIS_PART_MORE(to, blocker, blockers, n, error) || !GIS_PART_MORE(to, name, names, names, error)) return false;
    if (n) memcpy(to->blocker + to->blockers, from->blocker + *blocker, n * sizeof *to->blocker);
    *blocker = to->blockers;
    to->blockers += n;
    *name = to->names;
    for (size_t k = 0; k < names; k++) {
        gis_part_name one = from->name[first + k];
        if (!gis_part_add_text(to, gis_part_text(from, one.id), &one.id, error)) return false;
        to->name[to->names++] = one;
    }
    return true;
}

bool gis_part_copy_conflict(gis_part_result *to, const gis_part_result *from, size_t conflict, gis_error *error)
{
    gis_part_conflict new = from->conflict[conflict];
    if (!copy_things(to, from, new.is.n_blocked_by, &new.blocker, new.names, &new.name, error) ||
        !copy_line(to, from, &new.line, error) || !GIS_PART_MORE(to, conflict, conflicts, 1, error))
        return false;
    to->conflict[to->conflicts++] = new;
    return true;
}

bool gis_part_copy_hidden(gis_part_result *to, const gis_part_result *from, size_t hidden, gis_error *error)
{
    gis_part_hidden new = from->hidden[hidden];
    if (!copy_things(to, from, new.things, &new.blocker, new.names, &new.name, error) ||
        !GIS_PART_MORE(to, hidden, hiddens, 1, error))
        return false;
    to->hidden[to->hiddens++] = new;
    return true;
}

bool gis_part_copy_push(gis_part_result *to, const gis_part_result *from, size_t push, gis_error *error)
{
    gis_part_push new = from->push[push];
    if (!gis_part_add_text(to, gis_part_text(from, new.layer), &new.layer, error) ||
        !GIS_PART_MORE(to, push, pushes, 1, error))
        return false;
    to->push[to->pushes++] = new;
    return true;
}

bool gis_part_copy_tree(gis_part_result *to, const gis_part_result *from, size_t tree, gis_error *error)
{
    gis_part_tree new = from->tree[tree];
    if (!copy_line(to, from, &new.line, error) || !GIS_PART_MORE(to, tree, trees, 1, error)) return false;
    to->tree[to->trees++] = new;
    return true;
}

bool gis_part_copy_told(gis_part_result *to, const gis_part_result *from, size_t told, gis_error *error)
{
    gis_part_told new = from->told[told];
    if (!copy_line(to, from, &new.line, error) || !GIS_PART_MORE(to, told, tolds, 1, error)) return false;
    to->told[to->tolds++] = new;
    return true;
}

bool gis_part_copy_still(gis_part_result *to, const gis_part_result *from, size_t still, gis_error *error)
{
    if (!GIS_PART_MORE(to, still, stills, 1, error)) return false;
    to->still[to->stills++] = from->still[still];
    return true;
}

bool gis_part_copy_link(gis_part_result *to, const gis_part_result *from, size_t link, gis_error *error)
{
    if (!GIS_PART_MORE(to, link, links, 1, error)) return false;
    to->link[to->links++] = from->link[link];
    return true;
}

bool gis_part_copy_neighbours(gis_part_result *to, const gis_part_result *from, size_t neighbours, gis_error *error)
{
    if (!GIS_PART_MORE(to, neighbour, neighbours, 1, error)) return false;
    to->neighbour[to->neighbours++] = from->neighbour[neighbours];
    return true;
}

gis_part_world gis_part_world_at(const gis_part_result *result)
{
    return (gis_part_world){.row = result->rows,
                            .footprint = result->footprints,
                            .bound = result->bounds,
                            .conflict = result->conflicts,
                            .push = result->pushes,
                            .tree = result->trees,
                            .component = result->components,
                            .class = result->classes,
                            .hidden = result->hiddens,
                            .told = result->tolds};
}

bool gis_part_copy_world(gis_part_result *to, const gis_part_result *from, size_t world, gis_error *error)
{
    const gis_part_world *w = &from->world[world];
    gis_part_world new = *w;
    bool done = true;
    const gis_part_world at = gis_part_world_at(to);
    new.row = at.row;
    new.footprint = at.footprint;
    new.bound = at.bound;
    new.conflict = at.conflict;
    new.push = at.push;
    new.tree = at.tree;
    new.component = at.component;
    new.class = at.class;
    new.hidden = at.hidden;
    new.told = at.told;
    for (size_t k = 0; k < w->rows && done; k++) done = gis_part_copy_row(to, from, w->row + k, error);
    for (size_t k = 0; k < w->conflicts && done; k++) done = gis_part_copy_conflict(to, from, w->conflict + k, error);
    for (size_t k = 0; k < w->pushes && done; k++) done = gis_part_copy_push(to, from, w->push + k, error);
    for (size_t k = 0; k < w->trees && done; k++) done = gis_part_copy_tree(to, from, w->tree + k, error);
    for (size_t k = 0; k < w->hiddens && done; k++) done = gis_part_copy_hidden(to, from, w->hidden + k, error);
    for (size_t k = 0; k < w->tolds && done; k++) done = gis_part_copy_told(to, from, w->told + k, error);
    if (!done || !GIS_PART_MORE(to, footprint, footprints, w->footprints, error) ||
        !GIS_PART_MORE(to, bound, bounds, w->bounds, error) ||
        !GIS_PART_MORE(to, component, components, w->components, error) ||
        !GIS_PART_MORE(to, class, classes, w->classes, error) || !GIS_PART_MORE(to, world, worlds, 1, error))
        return false;
    for (size_t k = 0; k < w->footprints; k++) to->footprint[to->footprints++] = from->footprint[w->footprint + k];
    for (size_t k = 0; k < w->bounds; k++) to->bound[to->bounds++] = from->bound[w->bound + k];
    for (size_t k = 0; k < w->components; k++) to->component[to->components++] = from->component[w->component + k];
    for (size_t k = 0; k < w->classes; k++) to->class[to->classes++] = from->class[w->class + k];
    to->world[to->worlds++] = new;
    return true;
}

bool gis_part_copy_all(gis_part_result *to, const gis_part_result *from, gis_error *error)
{
    bool done = true;
    for (size_t k = 0; k < from->worlds && done; k++) done = gis_part_copy_world(to, from, k, error);
    for (size_t k = 0; k < from->stills && done; k++) done = gis_part_copy_still(to, from, k, error);
    for (size_t k = 0; k < from->links && done; k++) done = gis_part_copy_link(to, from, k, error);
    for (size_t k = 0; k < from->neighbours && done; k++) done = gis_part_copy_neighbours(to, from, k, error);
    to->unverified = to->unverified || from->unverified;
    return done;
}

/* ---- Bytes ------------------------------------------------------------------------------------------------------- */

typedef struct stored_head {
    uint64_t unverified;
    uint32_t count[(LISTS + 1) / 2 * 2];
} stored_head;

_Static_assert(sizeof(stored_head) % 8 == 0, "lists are aligned");

static size_t padded_size(size_t bytes) { return (bytes + 7) & ~(size_t)7; }

static const void *read_array(const gis_part_result *r, int k) { return *array_of((gis_part_result *)r, k); }
static size_t read_count(const gis_part_result *r, int k) { return *count_of((gis_part_result *)r, k); }

size_t gis_part_result_size(const gis_part_result *result)
{
    size_t bytes = sizeof(stored_head);
    for (int k = 0; k < LISTS; k++) bytes += padded_size(read_count(result, k) * lists[k].size);
    return bytes;
}

void gis_part_result_store(const gis_part_result *result, unsigned char *to)
{
    stored_head head = {.unverified = result->unverified};
    for (int k = 0; k < LISTS; k++) head.count[k] = (uint32_t)read_count(result, k);
    memcpy(to, &head, sizeof head);
    to += sizeof head;
    for (int k = 0; k < LISTS; k++) {
        const size_t bytes = read_count(result, k) * lists[k].size, room = padded_size(bytes);
        if (room) memset(to + room - 8, 0, 8);
        if (bytes) memcpy(to, read_array(result, k), bytes);
        gis_clear_padding(to, read_count(result, k), lists[k].size, lists[k].hole, lists[k].holes);
        to += room;
    }
}

bool gis_part_result_load(gis_part_result *to, const unsigned char *from, size_t size, bool *sound, gis_error *error)
{
    stored_head head;
    *sound = false;
    if (size < sizeof head) return true;
    memcpy(&head, from, sizeof head);
    size_t left = size - sizeof head;
    from += sizeof head;
    gis_part_result_empty(to);
    to->unverified = head.unverified != 0;
    for (int k = 0; k < LISTS; k++) {
        if (head.count[k] > left / lists[k].size) return true;
        const size_t n = head.count[k], bytes = n * lists[k].size, room = padded_size(bytes);
        if (room > left) return true;
        if (!gis_array_reserve(array_of(to, k), room_of(to, k), n + 1, lists[k].size)) return gis_no_memory(error);
        if (bytes) memcpy(*array_of(to, k), from, bytes);
        *count_of(to, k) = n;
        from += room;
        left -= room;
    }
    *sound = left == 0;
    return true;
}

uint64_t gis_part_result_form(void)
{
    uint64_t form = 7; /* version: raise it when the meaning of a member changes */
    for (int k = 0; k < LISTS; k++) form = gis_checksum_of(form, &lists[k].size, sizeof lists[k].size);
    return form;
}
