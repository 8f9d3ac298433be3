/* proof.h: what the lower bound and the verdicts stand on, as text for a checker: JSON lines, as docs/PROOF.md has
 * them. */
#ifndef GIS_LAYER_PROOF_H
#define GIS_LAYER_PROOF_H

#include "base/text.h"
#include "layer/input.h"

/* The report's trees were kept (sunder_layer_options.keep_trees). */
bool gis_proof_write(const gis_layer_input *input, const sunder_report *report, gis_text *out, gis_error *error);

#endif
