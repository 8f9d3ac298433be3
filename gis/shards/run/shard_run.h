/* shard_run.h: a layer that memory does not hold, separated a part at a time (parts/), by one process or by many.
 *
 *   gis_shard_run_begin   reads the layer onto the disk, into a directory; or gis_shard_run_resume: it is there
 *   gis_shard_run_separate   one of the shards to which it is dealt, part by part; what is told of it, to a file there
 *   gis_shard_run_open_source    opens the layer again, to be read by batches as it is written
 *   gis_shard_run_join   joins all shards, with what borders cut
 *   gis_shard_run_result  what came of it: the same bytes as of a layer that is separated whole */
#ifndef GIS_SHARD_RUN_H
#define GIS_SHARD_RUN_H

#include "base/interrupt.h"
#include "base/progress.h"
#include "layer/result.h"
#include "shards/parts/join.h"
#include "shards/run/layer_spooling.h"

/* Zeroed: nothing. */
typedef struct gis_shard_run {
    const gis_layer_input_request *request;
    char *directory;
    char *scratch;    /* within it, or itself: what goes in the end */
    int scratch_lock; /* while there is scratch: disk/temporary.h */
    gis_leftover *leftover;
    gis_layer_facts facts;
    gis_spool *spool;
    gis_spooled_barriers barriers;
    unsigned shards;  /* of the layer; the spool has a multiple of that number of parts */
    bool whole;       /* the source was opened to be held whole */
    unsigned at_once; /* parts of the spool that are separated as one */
    gis_layout layout;
    gis_joined joined;
    double explain, verify; /* seconds that parts took for these stages, in this process */
    GIntBig *block_fid;     /* [joined.blocks] of the features there, from when they are written */
} gis_shard_run;

/* Approximate bytes of a process: for a part of this size; and for a layer while it is written, or drawn, when no part
 * is in memory. */
double gis_shard_run_bytes(const gis_layer_rules *rules, double features, double vertices);
double gis_shard_run_bytes_written(double features, bool drawn);

/* directory: NULL: one of its own, which goes in the end. memory: bytes that a process may take, about. What will be
 * one piece of work and wants far more than that is told of. */
bool gis_shard_run_begin(const gis_layer_input_request *request, const char *directory, unsigned shards, double memory,
                         gis_shard_run *out, gis_error *error);
/* As after gis_shard_run_begin() with a directory, which is as that left it; facts are copied. */
bool gis_shard_run_resume(const gis_layer_input_request *request, const char *directory, const gis_layer_facts *facts,
                          unsigned shards, double memory, gis_shard_run *out, gis_error *error);
/* Once more, for the caller that reaches that piece of work. */
void gis_shard_run_warn_of_group(const gis_shard_run *parts);

/* Shard k, 1 to shards, to its file in the directory, in place of one that is there. options: of the call, for the
 * file's stamp. */
bool gis_shard_run_separate(gis_shard_run *parts, unsigned k, uint64_t options, gis_progress *progress,
                            gis_error *error);
/* Is its file there? Sound, and of this plan? *why says what is wrong, if it is there and not that. */
typedef enum gis_shard_state { GIS_SHARD_MISSING, GIS_SHARD_DONE, GIS_SHARD_WRONG } gis_shard_state;
bool gis_shard_run_state(const gis_shard_run *parts, unsigned k, uint64_t options, gis_shard_state *state,
                         gis_error *why, gis_error *error);

/* As gis_layer_input_read(), but for shapes, demands and the layer. whole: the source is not read by batches. */
bool gis_shard_run_open_source(gis_shard_run *parts, bool whole, gis_layer_input *out, gis_error *error);
/* Reads the barriers once more, and warns where they are not what the plan was made of, which its moves heed. False: a
 * signal has come, or the directory for it cannot be made. */
bool gis_shard_run_compare_barriers(gis_shard_run *parts, const gis_layer_input *input, gis_error *error);
/* The directory for what goes in the end, made if it is not there; NULL: it cannot be. */
const char *gis_shard_run_scratch(gis_shard_run *parts, gis_error *error);
/* Of all shards, whose files are there. */
bool gis_shard_run_join(gis_shard_run *parts, uint64_t options, sunder_layer_summary *summary, gis_error *error);
/* run_result.c: what came of it, once it is joined. The run and the input, which gis_shard_run_open_source() filled in,
 * are borrowed. */
gis_result gis_shard_run_result(gis_shard_run *parts, const gis_layer_input *input);
/* run_view.c */
bool gis_shard_run_view(const gis_result *result, gis_result_view *out, gis_error *error);
/* run_proof.c: of what was written, the file of --proof. False: see gis_proof_print(). */
bool gis_shard_run_proof(gis_shard_run *parts, const gis_layer_input *input, const sunder_layer_summary *summary,
                         FILE *to, gis_error *error);
void gis_shard_run_clear(gis_shard_run *parts);

#endif
