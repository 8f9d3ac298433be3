/* layer_input.h: reads the features of a source as the core's layer, for separate and check; or their shapes alone, for
 * buffer. */
#ifndef GIS_LAYER_INPUT_H
#define GIS_LAYER_INPUT_H

#include "base/progress.h"
#include "layer/barriers/barrier.h"
#include "layer/block_keys.h"
#include "layer/layer_rules.h"
#include "layer/links/links.h"
#include "layer/rungs.h"
#include "read/read_shape.h"
#include "sunder_hiding.h"

/* What to read, and by which rules. Strings and lists are borrowed until the input is cleared; zeroed members mean "not
 * given". */
typedef struct gis_layer_input_request {
    gis_source_request source; /* its member `takes` is filled in by gis_layer_begin() */
    const char *output;        /* path of the output, to recognise the order OUTPUT INPUT, and so that it does not
                                * replace an input */
    bool update;               /* the output is updated, so it may be an input's dataset */
    gis_invalid_policy invalid;
    double scale; /* N of the scale 1:N */
    const char *id_field;
    const char *previous;              /* the result of an earlier run, whose moves are preferred */
    bool previous_stays;               /* also beside places that are empty now */
    gis_links_request links;           /* owned; lines from old places to new ones, whose moves are preferred */
    const char *symbol, *symbol_field; /* if one of them is given, features are points at which symbols are drawn */
    const char *symbol_size_field;     /* field with a factor for each symbol */
    bool may_have_symbols;             /* the command has --symbol, so a hint is given for points without one */
    gis_barrier_request *barrier;      /* [barriers] owned */
    size_t barriers;
    const double *also; /* a further box near which barriers matter; NULL: none */
    bool wound;         /* orient all rings alike, since vertices of two layers will be compared */
    bool compared;      /* another layer will be compared with it; its shapes become larger or smaller then */
    bool moves;         /* features will be moved, so barriers within reach of their limits are read */
    bool drawn;         /* everything will be drawn, features that conflict with nothing as well */
    gis_layer_rules rules;
    const char *written; /* the name that the layer has in results, if it is given */
    const char *name;    /* in the output, if several layers move together */
    const char *title;   /* of all of them */
    const char *sheet;   /* the specification of the run, as JSON; NULL: there is none */
    /* [more] the other layers that move together with this one, each with rules of its own for its features; what
     * concerns the whole run is taken from this one. Owned. */
    struct gis_layer_input_request *with;
    size_t more;
    /* With others: this one, with the rules of its features, while `rules` here are those of the run. Owned, but for
     * what it has in common with this one. */
    struct gis_layer_input_request *alone;
} gis_layer_input_request;

void gis_layer_input_request_clear(gis_layer_input_request *request);

typedef struct gis_layer_shaping gis_layer_shaping; /* in shapes.c */

/* What the result of an earlier run says of the features; zeroed: there is none. */
typedef struct gis_previous {
    double *move;  /* [2 n] the former moves; 0 for features that are new */
    size_t *of;    /* [n] the number of the feature in that result; SIZE_MAX: it is new */
    bool *edited;  /* [n] its geometry has changed since that result */
    bool *relaxed; /* [n] it was edited or stood near a place that is empty now, and is free to go back */
    size_t gone;   /* the number of its features that the layer does not have */
} gis_previous;

/* The gaps of each two classes, in units of the layer; zeroed: all pairs have the gap. */
typedef struct gis_class_tables {
    double *gap, *full; /* [classes * classes] */
    double most, most_full;
    bool slack; /* some gap is less than the full one */
} gis_class_tables;

typedef struct gis_layer_input {
    const gis_layer_input_request *request;
    gis_source *source;
    size_t n;       /* number of features; if the source is read in batches, of the current one (layer_spooling.h) */
    bool points;    /* features are points, and the shapes are their symbols */
    bool as_chords; /* arcs are replaced by their polylines, and shapes are not enlarged to contain the arcs */
    gis_crs_units units;
    double gap, max_shift; /* in units of the layer; max_shift = INFINITY: no limit */
    double least_gap;      /* in units of the layer, if the rules have one */
    double tolerance;      /* in units of the layer; negative: the default */
    sunder_shape **shape;  /* [n] NULL: the feature cannot conflict */
    sunder_shape **given;  /* [n] the shape as read of each enlarged feature, NULL for others; NULL: none */
    sunder_shape **read;   /* [n] borrowed: all shapes as read, if some may become larger; NULL: they are in shape[] */
    size_t enlarged;       /* the number of features made larger */
    bool blocks_given;     /* feature[].block decides alone; no blocks are formed by touching */
    gis_rung_lengths lengths; /* of the rules for other shapes */
    gis_levels levels;        /* the smaller shapes that features may have, if they are to be moved */
    sunder_feature *feature;  /* [n] */
    gis_barriers barriers;
    double barrier_reach; /* barriers are known within this distance of each feature */
    sunder_layer *layer;
    gis_layer_shaping *shaping;
    uint32_t *gap_class; /* [n] the class of each feature for gaps; NULL: the gap is the same for all */
    /* [parts] the layers that move together, whose features these are, one layer after the other; NULL: the features of
     * one source. With them `source` and `request` are those of the first, and fields and previous are not set. */
    struct gis_layer_input *part;
    size_t parts, first; /* first: of a part: the number of its first feature among all */
    int64_t *row;        /* [n] the row of each feature by --rows FIELD, -1 for none; NULL: none are given */
    gis_previous previous;
    gis_class_tables class_tables;
    int class_field;     /* index of the field with the classes for gaps; -1: not given */
    int prefer_field[2]; /* index of each field; -1: not given */
    int id_field, block_field, limit_field, weight_field, rows_field, hierarchy_field,
        hidden_field;     /* index of each field; -1: not given */
    size_t invalid, null; /* number of features with an invalid geometry; with none, or an empty one */
    size_t other;         /* number of features with another kind of geometry */
} gis_layer_input;

/* Reads everything; layers that move together are joined to one (joined_layers.c). Call gis_layer_input_clear() also
 * after a failure. */
bool gis_layer_input_read(const gis_layer_input_request *request, gis_layer_input *out, gis_error *error);
/* Returns the layer that feature *i belongs to, and sets *i to its number in it. */
const gis_layer_input *gis_layer_own(const gis_layer_input *input, size_t *i);
/* The number of sources: those of layers that move together, or one; and each of them. */
size_t gis_layer_sources(const gis_layer_input *input);
const gis_source *gis_layer_source(const gis_layer_input *input, size_t k);
/* The name of the layer in the output, if several move together; else that of its source. */
const char *gis_layer_name(const gis_layer_input *input);
/* What the layer is called in messages and figures: the name of its source, or the title of layers that move
 * together. */
const char *gis_layer_title(const gis_layer_input *input);
/* Reads the source and its shapes alone, arcs as chords, for a command without conflicts. */
bool gis_layer_shapes_read(const gis_layer_input_request *request, gis_layer_input *out, gis_error *error);
/* The shape of feature i as it was read. */
static inline const sunder_shape *gis_layer_original(const gis_layer_input *input, size_t i)
{
    return input->given && input->given[i] ? input->given[i] : input->shape[i];
}
/* The distance around features within which barriers are read, for this longest limit. */
double gis_layer_barrier_reach(const gis_layer_input *input, double longest_limit);
/* Sets xy to the point of feature i; of a multipoint, the smallest by x, then y. *any is false if it has none. */
bool gis_layer_point(const gis_layer_input *input, size_t i, double xy[2], bool *any, gis_error *error);
/* Sets `box` to the box around all shapes; after features were made, around those that are not ignored. box[0] > box[2]
 * if there are none. */
void gis_layer_box(const gis_layer_input *input, double box[4]);
/* Warns if the layer's units are not lengths on the ground; gis_layer_input_read() calls it. */
void gis_layer_warn_of_crs(const gis_layer_input *input);
void gis_layer_input_clear(gis_layer_input *input);
/* Frees the demands on features, of which the core has a copy. */
void gis_layer_forget_demands(gis_layer_input *input);

/* Writes "layer buildings, FID 12", with the value of --id-field if there is one. */
void gis_feature_name(const gis_layer_input *input, size_t i, char *text, size_t size);

/* Fails with an error about the feature, the field and its value: "the WHAT in FIELD is 7; it must be NEEDED". In
 * layer_rules.c. */
bool gis_layer_wrong_number(const gis_layer_input *input, size_t i, int field, const char *what, const char *needed,
                            gis_error *error); /* layer_rules.c */

/* gis_layer_begin() opens the source; gis_layer_make_room() allocates shapes (and with `demands`, features) for the
 * current features, in place of those of an earlier batch. */
bool gis_layer_begin(const gis_layer_input_request *request, bool packed, gis_layer_input *out, gis_error *error);
bool gis_layer_make_room(gis_layer_input *input, bool demands, gis_error *error);
void gis_layer_drop_features(gis_layer_input *input);
/* Sets the demands that features have without any rule. */
void gis_layer_default_demands(gis_layer_input *input);
void gis_layer_warn_of_others(const gis_layer_input *input, bool any_points);
void gis_layer_shaping_free(gis_layer_shaping *shaping);

/* The stages of reading, in this order; gis_layer_begin() calls the first. */
bool gis_layer_fields(gis_layer_input *input, gis_error *error);  /* layer_rules.c: finds the fields that rules name */
bool gis_layer_lengths(gis_layer_input *input, gis_error *error); /* layer_rules.c */
bool gis_layer_shapes(gis_layer_input *input, gis_error *error);  /* shapes.c */
bool gis_layer_marks(gis_layer_input *input, gis_error *error);   /* layer_rules.c: ignored and fixed features */
bool gis_layer_blocks(gis_layer_input *input, gis_error *error);
bool gis_layer_weights(gis_layer_input *input, gis_error *error);
bool gis_layer_limits(gis_layer_input *input, gis_error *error);
bool gis_layer_rows(gis_layer_input *input, gis_error *error);
/* Is the class of feature i, if it has one, a whole number? Otherwise fails with an error that names the feature. */
bool gis_layer_check_class(const gis_layer_input *input, size_t i, gis_error *error);
/* What it costs to hide feature i, and the same for all of them. */
sunder_hiding_cost gis_layer_hiding_cost(const gis_layer_input *input, size_t i);
/* Has what is hidden in a result ignored, except for features of class 0. */
bool gis_layer_mark_hidden(gis_layer_input *input, gis_error *error);
bool gis_layer_set_hiding(gis_layer_input *input, gis_error *error); /* hiding_costs.c: once there is a layer */
/* The two steps of reading: the features of one source with its rules; what needs all features that move. */
bool gis_layer_read_features(const gis_layer_input_request *request, gis_layer_input *out, gis_error *error);
bool gis_layer_complete(gis_layer_input *input, gis_error *error);
/* Once the layer is read: the places that features prefer (preferred_moves.c). The former moves among them are those of
 * the result of an earlier run, if there is one (previous.c). */
bool gis_layer_set_preferred(gis_layer_input *input, gis_error *error);
bool gis_previous_read(gis_layer_input *input, gis_error *error);

/* Numbers blocks in the order of first appearance; they are ranked when all keys are known. */
bool gis_layer_number_blocks(gis_layer_input *input, gis_block_keys *keys, gis_error *error);
/* Numbers the rows of --rows FIELD likewise, in input->row; their numbers stay. */
bool gis_layer_number_rows(gis_layer_input *input, gis_block_keys *keys, gis_error *error);
/* The steps of weighting, which layer_spooling.c needs separately: the median of all areas (sorts them), the weight of
 * an area relative to the median, and the factor from a field. */
double gis_layer_median(double *areas, size_t n);
double gis_layer_area_weight(gis_weighting by, double area, double median);
bool gis_layer_weigh_by_field(gis_layer_input *input, gis_error *error);
bool gis_layer_is_weight(double weight);
bool gis_layer_wrong_weight(const char *who, double weight, gis_error *error);

/* If the touch tolerance is 0, overlaps thinner than this are reported: a hundredth of a metre, or of a unit if the
 * layer has no CRS. 0: nothing is reported, since this value could not be given as a tolerance. In run_core.c. */
double gis_layer_thin(const gis_layer_input *input);

/* The least kink of a row that is counted, in units of the layer: 0.1 mm on the sheet, or without a scale a tenth of
 * the gap (run_core.c). */
double gis_layer_kink(const gis_layer_input *input);
/* The core's options according to the rules, without progress (run_core.c). */
sunder_layer_options gis_layer_core_options(const gis_layer_input *input);

/* Either sunder_layer_separate or sunder_layer_check. */
typedef sunder_status gis_layer_work(const sunder_layer *layer, const sunder_layer_options *options,
                                     sunder_report **out, sunder_error *err);
struct gis_trace;
/* Calls `work` on the layer by the rules (run_core.c); a number that the core rejects is wrong usage. trace: receives
 * trace events (trace_file.h), or NULL. */
bool gis_layer_run(const gis_layer_input *input, gis_layer_work *work, gis_progress *progress, struct gis_trace *trace,
                   sunder_report **report, sunder_layer_summary *summary, gis_error *error);
/* Has the core find the rules that were broken between two layers, by the rules of `input`. number: the index in
 * `input` of each feature of the layers. */
bool gis_layer_run_moves(const gis_layer_input *input, const sunder_layer *before, const sunder_layer *after,
                         const size_t *number, gis_progress *progress, sunder_report **report, gis_error *error);

#endif
