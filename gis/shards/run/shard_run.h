/* shard_run.h: separates a layer that memory does not hold, part by part (parts/), in one process or in many.
 *
 *  gis_shard_run_begin        reads the layer into a directory on disk; or gis_shard_run_resume, if it is there
 *  gis_shard_run_separate     separates one shard, part by part; writes its results to a file in the directory
 *  gis_shard_run_open_source  opens the layer again, to be read in batches while the output is written
 *  gis_shard_run_join         joins all shards; separates again what crosses their borders
 *  gis_shard_run_result       the result: the same bytes as those of a layer that is separated whole */
#ifndef GIS_SHARD_RUN_H
#define GIS_SHARD_RUN_H

#include "base/interrupt.h"
#include "base/progress.h"
#include "layer/result.h"
#include "shards/parts/join.h"
#include "shards/run/layer_spooling.h"

/* A zeroed struct is empty. */
typedef struct gis_shard_run {
    const gis_layer_input_request *request;
    char *directory;
    char *scratch;    /* a directory that is removed at the end: within `directory`, or `directory` itself */
    int scratch_lock; /* its lock, if scratch is set: see disk/temporary.h */
    gis_leftover *leftover;
    gis_layer_facts facts;
    gis_rung_lengths lengths; /* of the rules for smaller shapes */
    gis_class_tables tables;  /* gaps by classes, if they depend on them */
    gis_spool *spool;
    gis_spooled_barriers barriers;
    unsigned shards;  /* number of shards; the spool has a multiple of that number of parts */
    bool whole;       /* the source was opened to be held in memory as a whole */
    unsigned at_once; /* number of the spool's parts that are separated as one */
    gis_layout layout;
    gis_joined joined;
    double explain, verify; /* seconds that this process spent in these stages */
    GIntBig *block_fid;     /* [joined.blocks] FIDs of the features there, set while features are visited */
} gis_shard_run;

/* Estimated bytes of a process: while it separates a part with these numbers of features and vertices; and while it
 * joins the parts and writes or draws the layer, when no part is in memory. */
double gis_shard_run_bytes(const gis_layer_rules *rules, double features, double vertices);
double gis_shard_run_bytes_written(const gis_layer_input_request *request, double features);

/* Reads the layer onto disk. directory == NULL: into a directory of its own, which is removed at the end. memory:
 * approximate bytes that a process may take; a contact group that needs far more gets a warning. */
bool gis_shard_run_begin(const gis_layer_input_request *request, const char *directory, unsigned shards, double memory,
                         gis_shard_run *out, gis_error *error);
/* Continues with a directory that gis_shard_run_begin() has filled; facts are copied. */
bool gis_shard_run_resume(const gis_layer_input_request *request, const char *directory, const gis_layer_facts *facts,
                          unsigned shards, double memory, gis_shard_run *out, gis_error *error);
/* Repeats the warning about the largest contact group, for a process that will separate it. */
void gis_shard_run_warn_of_group(const gis_shard_run *parts);

/* Separates shard k (from 1 to shards) and writes its file in the directory, in place of an existing one. options:
 * checksum of the command line, for the file's stamp. */
bool gis_shard_run_separate(gis_shard_run *parts, unsigned k, uint64_t options, gis_progress *progress,
                            gis_error *error);
/* The state of a shard's file: missing, complete and of this plan, or wrong (then *why says what is wrong). */
typedef enum gis_shard_state { GIS_SHARD_MISSING, GIS_SHARD_DONE, GIS_SHARD_WRONG } gis_shard_state;
bool gis_shard_run_state(const gis_shard_run *parts, unsigned k, uint64_t options, gis_shard_state *state,
                         gis_error *why, gis_error *error);

/* Like gis_layer_input_read(), but without shapes, demands and the core's layer. whole: hold the source in memory
 * instead of reading batches. */
bool gis_shard_run_open_source(gis_shard_run *parts, bool whole, gis_layer_input *out, gis_error *error);
/* Reads the barriers again, and warns if they differ from those of the plan, on which the moves depend. False: a signal
 * arrived, or no temporary directory can be made. */
bool gis_shard_run_compare_barriers(gis_shard_run *parts, const gis_layer_input *input, gis_error *error);
/* The directory for temporary files, made if it does not exist; NULL: it cannot be made. */
const char *gis_shard_run_scratch(gis_shard_run *parts, gis_error *error);
/* Joins the results of all shards, whose files must exist. */
bool gis_shard_run_join(gis_shard_run *parts, uint64_t options, sunder_layer_summary *summary, gis_error *error);
/* The result of a joined run (run_result.c). The run and the input, which gis_shard_run_open_source() filled in, are
 * borrowed. */
gis_result gis_shard_run_result(gis_shard_run *parts, const gis_layer_input *input);
/* The content of the page (run_view.c); see layer/result_view.h. */
bool gis_shard_run_view(const gis_result *result, gis_result_view *out, gis_error *error);
/* Writes the file of --proof (run_proof.c). It fails as gis_proof_print() does. */
bool gis_shard_run_proof(gis_shard_run *parts, const gis_layer_input *input, const sunder_layer_summary *summary,
                         FILE *to, gis_error *error);
void gis_shard_run_clear(gis_shard_run *parts);

#endif
