/* input.h: a source's features as the core's layer, after the options of separate and check. */
#ifndef GIS_LAYER_INPUT_H
#define GIS_LAYER_INPUT_H

#include "options/progress.h"
#include "read/operand.h"
#include "sunder.h"

typedef struct gis_layer_input {
    const gis_options *options;
    gis_source *source;
    size_t n;                 /* features */
    bool points;              /* the features are points, and the shapes the symbols at them */
    bool as_chords;           /* arcs are taken as their polylines, and not grown to contain the arcs */
    gis_ruler rule;
    double gap, max_shift;    /* in units of the layer; INFINITY: no limit */
    double tolerance;         /* negative: the default */
    sunder_shape **shape;     /* [n] NULL: nothing that could conflict */
    sunder_feature *feature;  /* [n] */
    sunder_layer *layer;
    int id_field;             /* -1: none */
    size_t invalid, null;     /* features with invalid, with no geometry */
    size_t other;             /* features with geometries that are not looked at */
} gis_layer_input;

/* Reads everything. On failure what was read can be released all the same. */
bool gis_layer_input_read(const gis_options *options, gis_layer_input *out, gis_error *error);
/* The source and the shapes alone, arcs as chords: for commands to which features are not in conflict. */
bool gis_layer_shapes_read(const gis_options *options, gis_layer_input *out, gis_error *error);
/* Warns where the layer's units are no lengths on the ground; gis_layer_input_read() does. */
void gis_layer_warn_of_crs(const gis_layer_input *input);
void gis_layer_input_clear(gis_layer_input *input);

/* "layer buildings, FID 12", with the user's own id if there is one. */
void gis_feature_name(const gis_layer_input *input, size_t i, char *text, size_t size);

/* Null, or a text that says nothing: formats without nulls have empty texts in their place. */
bool gis_field_is_blank(OGRFeatureH feature, int field);

/* A copy of a field's value as text, freed by the caller: equal for equal values, and different for different ones.
 * NULL: memory is out. Not for lists, whose texts are cut. */
char *gis_field_key(OGRFeatureH feature, int field);

/* The field that an option names; *field is -1 where it is not given. A field that is not there is an error that knows
 * which one was probably meant. */
bool gis_layer_field(const gis_layer_input *input, gis_option_id option, int *field, gis_error *error);

/* The stages, in this order: shapes (shapes.c) and rules (rules.c). */
bool gis_layer_lengths(gis_layer_input *input, gis_error *error);
bool gis_layer_marks(gis_layer_input *input, gis_error *error);   /* --ignore-where, --fixed-where */
bool gis_layer_blocks(gis_layer_input *input, gis_error *error);  /* --block-field */
bool gis_layer_weights(gis_layer_input *input, gis_error *error); /* --weight, --weight-field */

/* sunder_layer_separate or sunder_layer_check. */
typedef sunder_status gis_layer_work(const sunder_layer *layer, const sunder_layer_options *options,
                                     sunder_report **out, sunder_error *err);
/* Has the core do it, after the options; a call that it refuses as wrong is wrong usage. */
bool gis_layer_run(const gis_layer_input *input, gis_layer_work *work, gis_progress *progress, sunder_report **report,
                   sunder_layer_summary *summary, gis_error *error);

#endif
