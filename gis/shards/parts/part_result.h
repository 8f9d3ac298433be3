/* part_result.h: results of parts of a layer, as plain lists that can be stored in a file without conversion. Features
 * are identified by their places in the input, barriers by numbers behind those of all features. */
#ifndef GIS_PART_RESULT_H
#define GIS_PART_RESULT_H

#include "base/gis_error.h"
#include "layer/rungs.h"

#include <stdint.h>

/* A text is given by its offset in the result's `text`; this value means that there is none. */
#define GIS_NO_TEXT SIZE_MAX

/* A line of the proof, made by layer/proof_lines.h, with its NUL. */
typedef struct gis_part_line {
    uint64_t from, bytes; /* bytes = 0: no line was requested */
    uint64_t file;        /* 0: the line is in the result's `line`; else in the file of the shard with this number */
} gis_part_line;

/* A shape, as the rings that it was made of: 2 * `vertices` numbers of the list `corner`, and the ends of the rings,
 * then those of the polygons, in the list `end`. */
typedef struct gis_part_shape {
    size_t corner, vertices, end, rings, polygons; /* polygons = 0: there is none */
} gis_part_shape;

/* The result of one feature of a world. */
typedef struct gis_part_row {
    size_t index;
    int64_t fid;
    size_t id; /* offset of a text */
    double move[2], from[2], weight;
    gis_part_shape now; /* the shape that the feature has instead of its own */
    double lost, size;  /* ... with what gis_feature_row says of it */
    uint32_t rung;      /* ... which is this rung, from 1 on; 0: it has its own */
    gis_rung kind;      /* of the rung */
    sunder_feature_status status;
    bool rounded;
} gis_part_row;

typedef struct gis_part_world {
    size_t first;        /* its first feature */
    bool complete, gone; /* gone: its features are in another world now */
    bool loose;          /* not a world: a conflict inside a block that did not move; `first` is a member of the
                          * block */
    unsigned run;        /* number of the separation that found it */
    size_t row, rows;    /* its items in the result's lists: `rows` of them, from `row` on; the same for: */
    size_t footprint, footprints, bound, bounds, conflict, conflicts, push, pushes, tree, trees, component, components,
        class, classes, hidden, hiddens, told, tolds;
    sunder_conflict_counts before, after;
    size_t thin, clusters, clusters_optimal;
} gis_part_world;

/* A feature or barrier that a conflict names. */
typedef struct gis_part_name {
    size_t index;
    int64_t fid;
    size_t id; /* offset of a text: the feature's id; for a barrier the name of its layer */
} gis_part_name;

typedef struct gis_part_conflict {
    sunder_conflict is; /* its blocked_by is not used; instead n_blocked_by numbers of the list `blocker`, beginning
                         * at: */
    size_t blocker;
    size_t name, names; /* all features and barriers that it names */
    gis_part_line line;
    bool loose;
} gis_part_conflict;

/* A tree of the lower bound, if --proof is given. */
typedef struct gis_part_tree {
    size_t first, among; /* the group's first feature that moves, and the tree's place in the group */
    gis_part_line line;
} gis_part_tree;

/* A line of the proof about what is hidden or smaller: a smaller shape of a feature, at a level; a proved clause, or a
 * tree of the bound, with the least feature of its component, and its number there. */
typedef enum gis_part_told_kind { GIS_TOLD_SHAPE, GIS_TOLD_CLAUSE, GIS_TOLD_CHOICE, GIS_TOLD_KINDS } gis_part_told_kind;
typedef struct gis_part_told {
    size_t first, among;
    gis_part_line line;
    size_t kind; /* a gis_part_told_kind */
} gis_part_told;

typedef struct gis_part_push {
    sunder_push is;
    int64_t fid[2];
    double from[2], to[2]; /* where the two features stand after their moves; for a barrier, its nearest corner */
    size_t layer;          /* offset of a text: for a barrier the name of its layer */
} gis_part_push;

/* A hidden feature, and the set of things that says why (gis_hidden_row): `things` numbers of the list `blocker`, from
 * `blocker` on. */
typedef struct gis_part_hidden {
    size_t index;
    sunder_hiding_cost cost;
    size_t blocker, things;
    size_t name, names; /* all features and barriers that it names */
    bool proved, forced;
} gis_part_hidden;

/* A requested feature that is in no world, but differs from a feature alone: it is in a block, or is the first of a
 * block with conflicts inside. */
typedef struct gis_part_still {
    size_t index, inside; /* number of pairs inside its block that are closer than the gap, if it is the block's first
                           * feature */
    sunder_feature_status status;
} gis_part_still;

/* Two features of the same block. */
typedef struct gis_part_link {
    size_t a, b;
} gis_part_link;

/* Two neighbours in a row of houses, with their FIDs, and the anchors of their shapes before the moves. The moves are
 * those in the part, and the blocks are those that it knows. */
typedef struct gis_part_neighbours {
    sunder_row_pair is;
    int64_t fid[2];
    double anchor[2][2];
    bool hidden; /* one of the two is hidden: no neighbours in the result, but proofs may name them */
} gis_part_neighbours;

/* The results of one part, or of several, concatenated. A zeroed struct is empty. */
typedef struct gis_part_result {
    gis_part_world *world;
    gis_part_row *row;
    sunder_footprint *footprint;
    sunder_world_bound *bound;
    gis_part_conflict *conflict;
    size_t *blocker;
    gis_part_push *push;
    gis_part_tree *tree;
    sunder_hiding_component *component;
    sunder_hiding_class *class; /* what the components of a world hide, class by class */
    gis_part_hidden *hidden;
    gis_part_told *told;
    gis_part_name *name;
    gis_part_still *still;
    gis_part_link *link;
    gis_part_neighbours *neighbour;
    double *corner; /* of shapes */
    size_t *end;
    char *text;
    char *line; /* the bytes of all lines of the proof */
    size_t worlds, rows, footprints, bounds, conflicts, blockers, pushes, trees, components, classes, hiddens, tolds,
        names, stills, links, neighbours, corners, ends, texts, lines;
    struct {
        size_t world, row, footprint, bound, conflict, blocker, push, tree, component, class, hidden, told, name, still,
            link, neighbour, corner, end, text, line;
    } room;
    bool unverified; /* the core did not verify the result of some part */
} gis_part_result;

void gis_part_result_clear(gis_part_result *result);
/* Returns a world without items: each of its lists begins where the one of *result ends. */
gis_part_world gis_part_world_at(const gis_part_result *result);
/* Empties all lists, but keeps their memory. */
void gis_part_result_empty(gis_part_result *result);

/* Makes room for n more items in one of the result's lists; fails if memory is out. */
#define GIS_PART_MORE(out, array, count, n, error)                                                                     \
    (gis_array_reserve(&(out)->array, &(out)->room.array, (out)->count + (n), sizeof *(out)->array) ||                 \
     gis_no_memory(error))

/* Appends a text (NULL: none) and sets *at to its offset, or GIS_NO_TEXT. */
bool gis_part_add_text(gis_part_result *to, const char *text, size_t *at, gis_error *error);
const char *gis_part_text(const gis_part_result *result, size_t at);

/* Appends a line of the proof and sets *at to its place. */
bool gis_part_add_line(gis_part_result *to, const char *line, size_t bytes, gis_part_line *at, gis_error *error);
/* The text of a line that is stored in the result itself. */
const char *gis_part_line_of(const gis_part_result *result, const gis_part_line *line);

/* Appends a shape, which must have corners that are doubles, and sets *at to its place (part_shape.c). */
bool gis_part_add_shape(gis_part_result *to, const sunder_shape *shape, gis_part_shape *at, gis_error *error);
/* Makes *at the place of a copy of the shape that it names in `from`. */
bool gis_part_copy_shape(gis_part_result *to, const gis_part_result *from, gis_part_shape *at, gis_error *error);
/* Makes the shape anew; NULL if there is none. Fails, naming it as damaged, if the rings are not valid. */
bool gis_part_make_shape(const gis_part_result *from, const gis_part_shape *at, sunder_shape **out, gis_error *error);
bool gis_part_shape_is_sound(const gis_part_result *of, const gis_part_shape *at);

/* Each appends a copy of one item of another result, with the texts and lines that belong to it. */
bool gis_part_copy_row(gis_part_result *to, const gis_part_result *from, size_t row, gis_error *error);
bool gis_part_copy_conflict(gis_part_result *to, const gis_part_result *from, size_t conflict, gis_error *error);
bool gis_part_copy_push(gis_part_result *to, const gis_part_result *from, size_t push, gis_error *error);
bool gis_part_copy_tree(gis_part_result *to, const gis_part_result *from, size_t tree, gis_error *error);
bool gis_part_copy_hidden(gis_part_result *to, const gis_part_result *from, size_t hidden, gis_error *error);
bool gis_part_copy_told(gis_part_result *to, const gis_part_result *from, size_t told, gis_error *error);
bool gis_part_copy_still(gis_part_result *to, const gis_part_result *from, size_t still, gis_error *error);
bool gis_part_copy_link(gis_part_result *to, const gis_part_result *from, size_t link, gis_error *error);
bool gis_part_copy_neighbours(gis_part_result *to, const gis_part_result *from, size_t neighbours, gis_error *error);
/* Appends a copy of a world with all its items. */
bool gis_part_copy_world(gis_part_result *to, const gis_part_result *from, size_t world, gis_error *error);
/* Appends a copy of all items. */
bool gis_part_copy_all(gis_part_result *to, const gis_part_result *from, gis_error *error);

/* Stores a result as bytes; their number is a multiple of 8. */
size_t gis_part_result_size(const gis_part_result *result);
void gis_part_result_store(const gis_part_result *result, unsigned char *to);
/* Loads a result from bytes, in place of what *to held. *sound is false if the bytes are not a result; the function
 * fails only if memory is out. */
bool gis_part_result_load(gis_part_result *to, const unsigned char *from, size_t size, bool *sound, gis_error *error);
/* A number that changes with the layout of the structs; files with another number cannot be loaded. */
uint64_t gis_part_result_form(void);

#endif
