/* legible.h: is each feature of a layer large enough to be read on the map? The audit of check --spec. */
#ifndef GIS_LEGIBLE_H
#define GIS_LEGIBLE_H

#include "layer/output.h"
#include "sunder_legible.h"

/* The least sizes that a sheet gives, by kind of finding; borrowed texts. What is not given is not asked. The least
 * area is `area` times the square of the length for it, which is 1 in the unit that was given. */
typedef struct gis_legible_rules {
    gis_optional_length least[SUNDER_ILLEGIBLE_KINDS];
    double area;
} gis_legible_rules;

/* The key of a kind in a sheet: "width", "area", "neck", "inner_gap", "edge". */
const char *gis_legible_key(sunder_illegible_kind kind);
/* Sets the rule of a kind to a text as in a sheet: a length, or for areas one with "2" after its unit, such as
 * "0.3mm2", or a number of square units of the layer. On failure *why is a short reason. */
bool gis_legible_rule_parse(const char *text, sunder_illegible_kind kind, gis_legible_rules *rules, const char **why);
bool gis_legible_any_rule(const gis_legible_rules *rules);

typedef struct gis_legible_finding {
    size_t feature;
    sunder_illegible is;
} gis_legible_finding;

/* What was found, in the order of features; a struct of zeros is empty. */
typedef struct gis_legible {
    gis_legible_finding *item; /* [n] owned */
    size_t n, capacity;
    size_t count[SUNDER_ILLEGIBLE_KINDS];
    bool asked[SUNDER_ILLEGIBLE_KINDS];
} gis_legible;

/* Examines the shapes of all features that are not ignored, as they were read, and adds what is found to *out, which
 * starts zeroed. input: a layer with one source. rules == NULL: finds nothing. The caller clears *out, on failure,
 * too. */
bool gis_legible_check(const gis_layer_input *input, const gis_legible_rules *rules, gis_legible *out,
                       gis_error *error);
void gis_legible_clear(gis_legible *legible);

/* The row of finding k, with the columns of a conflict. */
bool gis_legible_row(const gis_layer_input *input, const gis_legible *legible, size_t k, gis_conflict_texts *scratch,
                     gis_value values[N_CONFLICT_COLUMNS], gis_error *error);
/* Writes all rows into a layer of conflicts. */
bool gis_write_legible(gis_sink_layer *layer, const gis_layer_input *input, const gis_legible *legible,
                       gis_error *error);

#endif
