/* part_result.h: results of parts of layers, as plain lists, which a file can hold as they are. Features are identified
 * by their places in the input, barriers by numbers behind the last of these. */
#ifndef GIS_PART_RESULT_H
#define GIS_PART_RESULT_H

#include "base/gis_error.h"
#include "sunder_parts.h"

#include <stdint.h>

/* Where a text begins among those of the result; this: there is none. */
#define GIS_NO_TEXT SIZE_MAX

/* What --proof says of a thing, as layer/proof_lines.h makes it, with its NUL. */
typedef struct gis_part_line {
    uint64_t from, bytes; /* bytes 0: nothing is wanted */
    uint64_t file;        /* 0: it is among the result's own; else in the file of that shard */
} gis_part_line;

/* A feature of a world. */
typedef struct gis_part_row {
    size_t index;
    int64_t fid;
    size_t id; /* a text */
    double move[2], from[2], weight;
    sunder_feature_status status;
    bool rounded;
} gis_part_row;

typedef struct gis_part_world {
    size_t first;        /* the first of its features */
    bool complete, gone; /* gone: another world has its features now */
    bool loose;          /* no world: conflicts inside a block that did not move, with `first` as a member */
    unsigned run;        /* the run it belongs to */
    size_t row, rows;    /* in those of the result; likewise: */
    size_t footprint, footprints, bound, bounds, conflict, conflicts, push, pushes, tree, trees;
    sunder_conflict_counts before, after;
    size_t thin, clusters, clusters_optimal;
} gis_part_world;

/* A feature or a barrier that is named by a conflict. */
typedef struct gis_part_name {
    size_t index;
    int64_t fid;
    size_t id; /* a text; of a barrier the name of its layer */
} gis_part_name;

typedef struct gis_part_conflict {
    sunder_conflict is; /* blocked_by: not here, but this many numbers, from this one on: */
    size_t blocker;
    size_t name, names; /* of all features that it names */
    gis_part_line line;
    bool loose;
} gis_part_conflict;

/* A tree of the bound, where --proof is wanted. */
typedef struct gis_part_tree {
    size_t first, among; /* of its group the first feature that moves; its place in that */
    gis_part_line line;
} gis_part_tree;

typedef struct gis_part_push {
    sunder_push is;
    int64_t fid[2];
    double from[2], to[2]; /* where the two features stand; of a barrier its nearest corner */
    size_t layer;          /* a text: of a barrier the name of its layer */
} gis_part_push;

/* A requested feature that is in no world, and not as it is by itself: it is in a block, or the first of one with
 * conflicts inside it. */
typedef struct gis_part_still {
    size_t index, inside; /* pairs inside its block that are not the gap apart, if it is the block's first feature */
    sunder_feature_status status;
} gis_part_still;

/* Two features of one block. */
typedef struct gis_part_link {
    size_t a, b;
} gis_part_link;

/* Of one part, or of several, one behind the other. Zeroed: of none. */
typedef struct gis_part_result {
    gis_part_world *world;
    gis_part_row *row;
    sunder_footprint *footprint;
    sunder_world_bound *bound;
    gis_part_conflict *conflict;
    size_t *blocker;
    gis_part_push *push;
    gis_part_tree *tree;
    gis_part_name *name;
    gis_part_still *still;
    gis_part_link *link;
    char *text;
    char *line; /* bytes of lines */
    size_t worlds, rows, footprints, bounds, conflicts, blockers, pushes, trees, names, stills, links, texts, lines;
    struct {
        size_t world, row, footprint, bound, conflict, blocker, push, tree, name, still, link, text, line;
    } room;
    bool unverified; /* the core did not verify some part */
} gis_part_result;

void gis_part_result_clear(gis_part_result *result);
/* The lists end, but their room stays. */
void gis_part_result_empty(gis_part_result *result);

/* Room for n more of one of the result's lists. */
#define GIS_PART_MORE(out, array, count, n, error)                                                                     \
    (gis_array_reserve(&(out)->array, &(out)->room.array, (out)->count + (n), sizeof *(out)->array) ||                 \
     gis_no_memory(error))

/* A text at the end of those that are there; NULL: none. */
bool gis_part_add_text(gis_part_result *to, const char *text, size_t *at, gis_error *error);
const char *gis_part_text(const gis_part_result *result, size_t at);

/* Appends a line. */
bool gis_part_add_line(gis_part_result *to, const char *line, size_t bytes, gis_part_line *at, gis_error *error);
/* Clears one that the result owns. */
const char *gis_part_line_of(const gis_part_result *result, const gis_part_line *line);

/* Copies of one thing of another result, at the end of what is there. */
bool gis_part_copy_row(gis_part_result *to, const gis_part_result *from, size_t row, gis_error *error);
bool gis_part_copy_conflict(gis_part_result *to, const gis_part_result *from, size_t conflict, gis_error *error);
bool gis_part_copy_push(gis_part_result *to, const gis_part_result *from, size_t push, gis_error *error);
bool gis_part_copy_tree(gis_part_result *to, const gis_part_result *from, size_t tree, gis_error *error);
bool gis_part_copy_still(gis_part_result *to, const gis_part_result *from, size_t still, gis_error *error);
bool gis_part_copy_link(gis_part_result *to, const gis_part_result *from, size_t link, gis_error *error);
/* ... of a world with all that is of it. */
bool gis_part_copy_world(gis_part_result *to, const gis_part_result *from, size_t world, gis_error *error);
/* ... of everything. */
bool gis_part_copy_all(gis_part_result *to, const gis_part_result *from, gis_error *error);

/* As bytes, a multiple of 8 of them. */
size_t gis_part_result_size(const gis_part_result *result);
void gis_part_result_store(const gis_part_result *result, unsigned char *to);
/* In place of what `to` held. False, with no error said: it is no result. */
bool gis_part_result_load(gis_part_result *to, const unsigned char *from, size_t size, bool *sound, gis_error *error);
/* Changes with the layout of the structs: files of another layout cannot be loaded. */
uint64_t gis_part_result_form(void);

#endif
