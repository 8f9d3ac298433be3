/* plan.h: a separation that is divided into shards, as it is stored on disk. See README.md. */
#ifndef GIS_SHARDS_PLAN_H
#define GIS_SHARDS_PLAN_H

#include "base/json.h"
#include "shards/run/shard_run.h"

/* The largest number of shards; each has a file in one directory. */
enum { GIS_PLAN_MOST_SHARDS = 100000 };

/* A plan. A zeroed struct is empty. */
typedef struct gis_plan {
    char **argument; /* [arguments] of separate: the options, then "--" and INPUT. Owned, as everything that is pointed
                      * to */
    size_t arguments;
    char *gaps;  /* gaps by classes, as gis_sheet_put_gaps() has them; empty or NULL: there are none */
    char *sheet; /* the specification of the run, as JSON; empty or NULL: there is none */
    unsigned shards;
    double memory; /* bytes that a process may take */
    gis_layer_facts facts;
    uint64_t spool, status; /* checksums of the layer's files */
    uint64_t stamp;         /* checksum of the plan: marks the results of shards as those of this plan */
} gis_plan;

bool gis_plan_add_argument(gis_plan *plan, const char *name, const char *value, gis_error *error);
void gis_plan_clear(gis_plan *plan);

/* ---- plan_file.c: the file `plan` of the directory --------------------------------------------------------------- */

bool gis_plan_write(const gis_plan *plan, const char *directory, gis_error *error);
/* Reads the plan of a directory. Fails, naming the directory, if there is none, if the plan was made by another version
 * or changed, or if the directory belongs to a user other than this one or root or may be written by all users. */
bool gis_plan_read(const char *directory, gis_plan *plan, gis_error *error);
/* Do both plans have the same arguments, specification, number of shards and memory? */
bool gis_plan_same_call(const gis_plan *a, const gis_plan *b);

/* ---- plan_checks.c: do the files beside the plan belong to it? --------------------------------------------------- */

bool gis_plan_status_checksum(const char *directory, uint64_t *checksum, gis_error *error);
/* Checks that the files of a resumed run are those of the plan that was read. status: check the file `status` as well,
 * which must be read entirely. */
bool gis_plan_check(const gis_plan *plan, const gis_shard_run *parts, bool status, gis_error *error);

/* ---- plan_description.c: the file `plan.json` -------------------------------------------------------------------- */

bool gis_plan_describe(const gis_plan *plan, const gis_shard_run *parts, const char *directory, gis_error *error);

/* ---- shard_estimates.c: memory and time for a scheduler ---------------------------------------------------------- */

typedef struct gis_plan_load {
    size_t features, vertices;
} gis_plan_load;

typedef struct gis_plan_estimate {
    double bytes, seconds; /* of memory; of time on one core */
} gis_plan_estimate;

gis_plan_estimate gis_plan_estimate_shard(const gis_plan *plan, const gis_plan_load *shard,
                                          const gis_layer_rules *rules);
/* The estimate for the largest contact group. It is assumed to cross borders of shards, so that the merge separates
 * it. */
gis_plan_estimate gis_plan_estimate_group(const gis_shard_run *parts);
gis_plan_estimate gis_plan_estimate_merge(const gis_plan *plan, const gis_shard_run *parts);

/* ---- plan_place.c: makes the directory appear complete, or not at all
 * --------------------------------------------- */

typedef struct gis_plan_place {
    char *path; /* of the hidden directory beside the final one */
    int lock;   /* lock of the hidden directory: see disk/temporary.h */
    gis_leftover *leftover;
} gis_plan_place;

bool gis_plan_place_begin(const char *directory, gis_plan_place *place, gis_error *error);
/* Renames the hidden directory to `directory` and syncs the directory in which it is. If something else has that name
 * already, *taken is set and the function succeeds. */
bool gis_plan_place_end(gis_plan_place *place, const char *directory, bool *taken, gis_error *error);
/* Removes the hidden directory, if it was not renamed. */
void gis_plan_place_clear(gis_plan_place *place);

/* ---- absolute_paths.c: paths that are valid from any directory
 * ---------------------------------------------------- */

/* The absolute form of a data source that is read; a copy of `source` if it is not recognised as a file. CPLFree(). */
char *gis_plan_absolute_source(const char *source);
/* The absolute form of the value of --barrier (its DATASET), of a SHAPE (@FILE), and of a file that is written;
 * CPLFree(). */
char *gis_plan_absolute_barrier(const char *barrier);
char *gis_plan_absolute_shape(const char *shape);
char *gis_plan_absolute_output(const char *path);

#endif
