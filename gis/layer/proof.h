/* proof.h: the file of --proof, of a layer that is held. */
#ifndef GIS_LAYER_PROOF_H
#define GIS_LAYER_PROOF_H

#include "layer/layer_input.h"
#include "layer/proof_lines.h"

/* The first line, but for the counts. */
gis_proof_head gis_proof_head_of(const gis_layer_input *input, const sunder_layer_summary *summary);

/* False: see gis_proof_print(). */
bool gis_proof_write(const gis_layer_input *input, const sunder_report *report, FILE *to, gis_error *error);

#endif
