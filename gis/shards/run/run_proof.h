/* run_proof.h: the lines of --proof about what is hidden, larger or smaller in a layer that was separated in parts. */
#ifndef GIS_RUN_PROOF_H
#define GIS_RUN_PROOF_H

#include "layer/proof_lines.h"
#include "shards/run/shard_run.h"

/* Write a line for each larger shape, and for each hidden feature. */
bool gis_run_proof_larger(gis_shard_run *p, gis_json *json, FILE *to, gis_error *error);
bool gis_run_proof_hidden(gis_shard_run *p, gis_json *json, FILE *to, gis_error *error);

/* The lines about what is hidden or smaller, while they are written: all smaller shapes, and later all clauses, then
 * the choices. */
typedef struct gis_telling {
    gis_sorted_results *told;
    bool any;
    size_t *first; /* [clauses] the component of each clause written so far */
    size_t clauses;
} gis_telling;
/* Begins with the first line; the caller frees t->first, also after a failure. */
bool gis_telling_begin(gis_shard_run *p, gis_telling *t, gis_error *error);
/* Writes the lines of one kind, which come next. */
bool gis_run_proof_told(gis_telling *t, gis_part_told_kind kind, gis_json *json, FILE *to, gis_error *error);

#endif
