/* gap_rules.h: gaps that depend on the classes of the two, as a specification gives them (../sheet/). */
#ifndef GIS_GAP_RULES_H
#define GIS_GAP_RULES_H

#include "layer/layer_input.h"

/* The greatest number of classes, with class 0. */
enum { GIS_MOST_CLASSES = 1024 };

/* Of a rule: all classes. */
#define GIS_EVERY_CLASS UINT32_MAX

/* A rule: the gap of two classes, in either order. A later rule replaces what it gives. */
typedef struct gis_gap_rule {
    uint32_t of[2];
    gis_optional_length gap, least; /* not given: as before */
} gis_gap_rule;

/* Everything is borrowed. Class 0 has the names that no rule mentions. */
typedef struct gis_gap_classes {
    const char *const *name; /* [classes] name[0] is NULL */
    size_t classes;
    const gis_gap_rule *rule; /* [rules] */
    size_t rules;
    const char *field;          /* the field with the classes of features; NULL: they all have one */
    uint32_t of_features;       /* that one */
    const uint32_t *of_barrier; /* [requests of barriers] */
} gis_gap_classes;

/* Finds the field of classes. */
bool gis_class_gaps_field(gis_layer_input *input, gis_error *error);
/* Computes the tables of gaps, in the layer's units, once the gaps of the options are known. */
bool gis_class_gaps_tables(gis_layer_input *input, gis_error *error);
/* Sets input->gap_class to the class of each feature that was read. */
bool gis_class_gaps_read(gis_layer_input *input, gis_error *error);
/* The tables for the core, borrowed; classes 0 if `classes` is NULL. */
sunder_gaps gis_class_gaps_core(const gis_gap_classes *classes, const gis_class_tables *tables);
/* The greatest gap of any pair, in units of the layer. */
double gis_class_gaps_most(const gis_layer_input *input);
/* The class of a barrier of this request. */
uint32_t gis_class_gaps_of_barrier(const gis_gap_classes *classes, size_t request);
/* Gives a layer of the core, with its barriers, the gaps. number: the index in `input` of each of its n features; NULL:
 * all of them in their order. */
bool gis_class_gaps_set(const gis_layer_input *input, const size_t *number, size_t n, sunder_layer *layer,
                        gis_error *error);
void gis_class_gaps_clear(gis_class_tables *tables);

#endif
