/* proof.h: writes the file of --proof for a layer in memory. */
#ifndef GIS_LAYER_PROOF_H
#define GIS_LAYER_PROOF_H

#include "layer/layer_input.h"
#include "layer/proof_lines.h"

/* The content of the first line, except the counts. */
gis_proof_head gis_proof_head_of(const gis_layer_input *input, const sunder_layer_summary *summary);

/* Writes the file. It fails as gis_proof_print() does. */
bool gis_proof_write(const gis_layer_input *input, const sunder_report *report, FILE *to, gis_error *error);

#endif
