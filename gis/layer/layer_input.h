/* layer_input.h: a source's features as the core's layer, for separate and check; their shapes alone, for buffer. */
#ifndef GIS_LAYER_INPUT_H
#define GIS_LAYER_INPUT_H

#include "base/progress.h"
#include "layer/barriers/barrier.h"
#include "layer/block_keys.h"
#include "layer/layer_rules.h"
#include "read/read_shape.h"

/* What to read, and by which rules. Strings and lists are borrowed until the input is cleared; zeroed members mean "not
 * given". */
typedef struct gis_layer_input_request {
    gis_source_request source; /* what it takes is filled in */
    const char *output;        /* to detect OUTPUT INPUT, which gets a message; and no input may be replaced by it */
    bool update;               /* ... which adding to it does not */
    gis_invalid_policy invalid;
    double scale; /* N of 1:N */
    const char *id_field;
    const char *symbol, *symbol_field; /* one of them given: the features are points, and these are drawn there */
    const char *symbol_size_field;     /* a factor for each of them */
    bool may_have_symbols;             /* the command has --symbol: points without it get a message about it */
    gis_barrier_request *barrier;      /* [barriers] owned */
    size_t barriers;
    const double *also; /* a box that barriers can be in the way of, besides that of the features; NULL: none */
    bool wound;         /* rings are to run one way in all formats: places of vertices are to be compared */
    bool moves;         /* features are to be moved: what is within reach of their limits counts */
    bool drawn;         /* all is to be drawn, what conflicts with nothing, too */
    gis_layer_rules rules;
} gis_layer_input_request;

void gis_layer_input_request_clear(gis_layer_input_request *request);

typedef struct gis_layer_shaping gis_layer_shaping; /* shapes.c */

typedef struct gis_layer_input {
    const gis_layer_input_request *request;
    gis_source *source;
    size_t n;       /* features; of a source that is read by batches, those of the batch (layer_spooling.h) */
    bool points;    /* the features are points, and the shapes the symbols at them */
    bool as_chords; /* arcs are taken as their polylines, and not grown to contain the arcs */
    gis_crs_units units;
    double gap, max_shift;   /* in units of the layer; INFINITY: no limit */
    double tolerance;        /* negative: the default */
    sunder_shape **shape;    /* [n] NULL: nothing that could conflict */
    sunder_feature *feature; /* [n] */
    gis_barriers barriers;
    double barrier_reach; /* a feature that moves no farther only comes near these */
    sunder_layer *layer;
    gis_layer_shaping *shaping;
    int id_field, block_field, limit_field, weight_field; /* -1: none */
    size_t invalid, null; /* features whose geometry is invalid; that have none, or an empty one */
    size_t other;         /* features of another kind of geometry than the one that is looked at */
} gis_layer_input;

/* Reads everything. On failure what was read can be released all the same. */
bool gis_layer_input_read(const gis_layer_input_request *request, gis_layer_input *out, gis_error *error);
/* The source and the shapes alone, arcs as chords: for a command that asks for no conflicts. */
bool gis_layer_shapes_read(const gis_layer_input_request *request, gis_layer_input *out, gis_error *error);
/* How far about features barriers are known, where that is the longest limit. */
double gis_layer_barrier_reach(double longest_limit);
/* The point of a feature of points; of several the smallest by x, then y. *any: there is one. */
bool gis_layer_point(const gis_layer_input *input, size_t i, double xy[2], bool *any, gis_error *error);
/* Sets `box` to the box around all shapes or, once features are made, around those that are not ignored. If there is
 * none, box[0] > box[2]. */
void gis_layer_box(const gis_layer_input *input, double box[4]);
/* Warns where the layer's units are no lengths on the ground; gis_layer_input_read() does. */
void gis_layer_warn_of_crs(const gis_layer_input *input);
void gis_layer_input_clear(gis_layer_input *input);
/* Frees the demands on features, which the core has a copy of, once they are no longer needed. */
void gis_layer_forget_demands(gis_layer_input *input);

/* "layer buildings, FID 12", with the user's own id if there is one. */
void gis_feature_name(const gis_layer_input *input, size_t i, char *text, size_t size);

/* False, with an error about the feature, the field and what it holds: "the WHAT in FIELD is 7; it must be NEEDED". */
bool gis_layer_wrong_number(const gis_layer_input *input, size_t i, int field, const char *what, const char *needed,
                            gis_error *error); /* layer_rules.c */

/* Opens the source; room for what is known of each feature of it, in place of what was known of others. */
bool gis_layer_begin(const gis_layer_input_request *request, bool packed, gis_layer_input *out, gis_error *error);
bool gis_layer_make_room(gis_layer_input *input, bool demands, gis_error *error);
void gis_layer_drop_features(gis_layer_input *input);
/* Demands on features without a rule. */
void gis_layer_default_demands(gis_layer_input *input);
void gis_layer_warn_of_others(const gis_layer_input *input, bool any_points);
void gis_layer_shaping_free(gis_layer_shaping *shaping);

/* The stages, in this order; gis_layer_begin() asks the first. */
bool gis_layer_fields(gis_layer_input *input, gis_error *error);  /* layer_rules.c: looks for those that rules name */
bool gis_layer_lengths(gis_layer_input *input, gis_error *error); /* layer_rules.c */
bool gis_layer_shapes(gis_layer_input *input, gis_error *error);  /* shapes.c */
bool gis_layer_marks(gis_layer_input *input, gis_error *error);   /* layer_rules.c: ignored and fixed features */
bool gis_layer_blocks(gis_layer_input *input, gis_error *error);
bool gis_layer_weights(gis_layer_input *input, gis_error *error);
bool gis_layer_limits(gis_layer_input *input, gis_error *error);

/* Block numbers by the order of first appearance; they are ranked once all keys are known. */
bool gis_layer_number_blocks(gis_layer_input *input, gis_block_keys *keys, gis_error *error);
/* The parts of weighing that layer_spooling.c needs apart: of an area beside the median of all (which sorts them), and
 * the factor of a field. */
double gis_layer_median(double *areas, size_t n);
double gis_layer_area_weight(gis_weighting by, double area, double median);
bool gis_layer_weigh_by_field(gis_layer_input *input, gis_error *error);
bool gis_layer_is_weight(double weight);
bool gis_layer_wrong_weight(const char *who, double weight, gis_error *error);

/* So thin an overlap is told of where the tolerance is 0: a hundredth of a metre, or of the unit of a layer without a
 * CRS. 0: nothing is to be told, for that is no tolerance that could be given. */
double gis_layer_thin(const gis_layer_input *input); /* run_core.c */

/* What the rules ask of the core, without anybody to tell how far it is (run_core.c). */
sunder_layer_options gis_layer_core_options(const gis_layer_input *input);

/* sunder_layer_separate or sunder_layer_check. */
typedef sunder_status gis_layer_work(const sunder_layer *layer, const sunder_layer_options *options,
                                     sunder_report **out, sunder_error *err);
struct gis_trace;
/* Has the core do one of the two, by the rules (run_core.c); a number that it refuses is wrong usage. trace: NULL,
 * or what takes its events (trace_file.h). */
bool gis_layer_run(const gis_layer_input *input, gis_layer_work *work, gis_progress *progress, struct gis_trace *trace,
                   sunder_report **report, sunder_layer_summary *summary, gis_error *error);
/* The same for what broke a rule between two layers, by the rules of `input`. */
bool gis_layer_run_moves(const gis_layer_input *input, const sunder_layer *before, const sunder_layer *after,
                         gis_progress *progress, sunder_report **report, gis_error *error);

#endif
