/* plan.h: a separation that is cut into shards, as it lies on disk. See README.md. */
#ifndef GIS_SHARDS_PLAN_H
#define GIS_SHARDS_PLAN_H

#include "base/json.h"
#include "shards/run/shard_run.h"

/* More shards than this want their files another way. */
enum { GIS_PLAN_MOST_SHARDS = 100000 };

/* Zeroed: none. */
typedef struct gis_plan {
    char **argument; /* [arguments] of separate: options, then "--" and INPUT. Owned, as all that is pointed to */
    size_t arguments;
    unsigned shards;
    double memory; /* bytes that a process may take */
    gis_layer_facts facts;
    uint64_t spool, status; /* checksums of the layer's files */
    uint64_t stamp;         /* of all of this: what the results of shards are told apart by */
} gis_plan;

bool gis_plan_add_argument(gis_plan *plan, const char *name, const char *value, gis_error *error);
void gis_plan_clear(gis_plan *plan);

/* ---- file.c: the file `plan` of the directory -------------------------------------------------------------------- */

bool gis_plan_write(const gis_plan *plan, const char *directory, gis_error *error);
/* Fails, naming the directory, where there is no plan, or one that another version made, or that was altered. */
bool gis_plan_read(const char *directory, gis_plan *plan, gis_error *error);
/* Are two of them equal? */
bool gis_plan_same_call(const gis_plan *a, const gis_plan *b);

/* ---- plan_checks.c: are the files that lie beside it those that it is about? ------------------------------------- */

bool gis_plan_status_checksum(const char *directory, uint64_t *checksum, gis_error *error);
/* For a plan that was read, and parts that were resumed. status: check the file `status`, too? It is read entirely for
 * that. */
bool gis_plan_check(const gis_plan *plan, const gis_shard_run *parts, bool status, gis_error *error);

/* ---- plan_description.c: the file `plan.json` -------------------------------------------------------------------- */

bool gis_plan_describe(const gis_plan *plan, const gis_shard_run *parts, const char *directory, gis_error *error);

/* ---- shard_estimates.c: what a scheduler wants to be told beforehand --------------------------------------------- */

typedef struct gis_plan_load {
    size_t features, vertices;
} gis_plan_load;

typedef struct gis_plan_estimate {
    double bytes, seconds; /* of memory; on one core */
} gis_plan_estimate;

gis_plan_estimate gis_plan_estimate_shard(const gis_plan *plan, const gis_plan_load *shard,
                                          const gis_layer_rules *rules);
/* The largest contact group is taken for one that crosses borders: then it is the merge's. */
gis_plan_estimate gis_plan_estimate_group(const gis_shard_run *parts);
gis_plan_estimate gis_plan_estimate_merge(const gis_plan *plan, const gis_shard_run *parts);

/* ---- plan_place.c: the directory appears whole, or not at all ---------------------------------------------------- */

typedef struct gis_plan_place {
    char *path; /* hidden, beside the directory */
    int lock;   /* of that: disk/temporary.h */
    gis_leftover *leftover;
} gis_plan_place;

bool gis_plan_place_begin(const char *directory, gis_plan_place *place, gis_error *error);
/* *taken: something is there by that name already; else all of it is on the disk, under its name. */
bool gis_plan_place_end(gis_plan_place *place, const char *directory, bool *taken, gis_error *error);
/* Removes unfinished work. */
void gis_plan_place_clear(gis_plan_place *place);

/* ---- absolute_paths.c: paths that hold from wherever they are used ----------------------------------------------- */

/* For a file or a data source that is read: unchanged, if it is not recognised as a file. Freed with CPLFree(). */
char *gis_plan_absolute_source(const char *source);
/* Of the DATASET of a --barrier, with its keys; of a SHAPE; of a file that is written. */
char *gis_plan_absolute_barrier(const char *barrier);
char *gis_plan_absolute_shape(const char *shape);
char *gis_plan_absolute_output(const char *path);

#endif
