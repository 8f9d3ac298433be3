/* layer_spooling.c: see layer_spooling.h. Each batch passes through the stages of a layer that is read as a whole
 * (layer/layer_input.h). Values that depend on all features (weights relative to the median of areas, and the numbers
 * of blocks) are set at the end, when the spool is sorted. */
#include "shards/run/layer_spooling.h"

#include "base/array.h"
#include "base/core_error.h"
#include "base/message.h"
#include "base/remove_tree.h"
#include "disk/file.h"
#include "geometry/gis_box.h"
#include "layer/layer_checksum.h"
#include "layer/levels.h"
#include "layer/output.h"
#include "read/crs_units.h"
#include "shards/run/barrier_spooling.h"
#include "shards/run/spool_enlarging.h"

#include <cpl_conv.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Number of features in a batch: large enough that the cost of starting one does not matter. */
enum { BATCH = 8192 };

typedef struct spooling {
    gis_layer_input input;
    gis_layer_facts *facts;
    const char *directory;
    char *given; /* the directory of the spool before features become larger; NULL: they do not */
    gis_spool_writer *writer;
    gis_spool_writer *aside; /* the spool of features that conflict with nothing; NULL: not begun */
    gis_disk_file status;
    gis_block_keys keys, rows;
    double *areas, median; /* areas of the features that count, if weights depend on area */
    size_t n_areas, room;
    double shapes[4]; /* box of all shapes */
    bool *rigid;      /* of the current batch: which shapes never change; NULL: all may */
    gis_layer_checksums sums;
} spooling;

/* ---- One batch --------------------------------------------------------------------------------------------------- */

static bool by_area(const spooling *s) { return s->input.request->rules.weighting != GIS_WEIGHTING_EVEN; }

static bool weigh_batch(spooling *s, gis_error *error)
{
    gis_layer_input *input = &s->input;
    if (!by_area(s)) return gis_layer_weights(input, error);
    if (!gis_array_reserve(&s->areas, &s->room, s->n_areas + input->n, sizeof *s->areas)) return gis_no_memory(error);
    for (size_t i = 0; i < input->n; i++)
        if (!input->feature[i].ignored) s->areas[s->n_areas++] = sunder_shape_area(input->shape[i]);
    return gis_layer_weigh_by_field(input, error);
}

/* Finds which shapes of the batch never change. */
static bool take_rigid(spooling *s, gis_error *error)
{
    free(s->rigid);
    return gis_levels_rigid(&s->input, &s->rigid, error);
}

/* The stages of a batch up to the demands that do not depend on other batches. */
static bool take_demands(spooling *s, gis_error *error)
{
    gis_layer_input *input = &s->input;
    double box[4];
    if (!gis_layer_make_room(input, true, error) || !gis_layer_shapes(input, error)) return false;
    gis_layer_default_demands(input);
    gis_layer_box(input, box);
    gis_box_join(s->shapes, box);
    if (!gis_layer_marks(input, error) || !take_rigid(s, error) || !gis_class_gaps_read(input, error) ||
        !gis_layer_number_blocks(input, &s->keys, error) || !gis_layer_number_rows(input, &s->rows, error) ||
        !weigh_batch(s, error) || !gis_layer_limits(input, error))
        return false;
    gis_layer_box(input, box);
    gis_box_join(s->facts->box, box);
    return true;
}

static bool id_text(const gis_layer_input *input, size_t i, char **copy, char number[64], const char **text,
                    gis_error *error)
{
    gis_value id;
    *text = number;
    if (!gis_id_value(input, i, copy, &id, error)) return false;
    switch (id.kind) {
    case GIS_NULL: *text = NULL; break;
    case GIS_INTEGER: snprintf(number, 64, "%" PRId64, (int64_t)id.as.integer); break;
    case GIS_REAL: snprintf(number, 64, "%.17g", id.as.real); break;
    case GIS_TEXT: *text = id.as.text; break;
    }
    return true;
}

/* Makes a directory within that of the spool, whose path the caller frees; NULL: it cannot be made. */
static char *make_directory(const spooling *s, const char *name, gis_error *error)
{
    char *path = gis_disk_path(s->directory, name);
    if (!path) gis_no_memory(error);
    if (!path || mkdir(path, 0777) == 0 || errno == EEXIST) return path;
    gis_fail(error, "%s: it cannot be made: %s", path, strerror(errno));
    free(path);
    return NULL;
}

/* The writer for features that conflict with nothing; created for the first of them. */
static gis_spool_writer *open_aside(spooling *s, gis_error *error)
{
    if (s->aside) return s->aside;
    char *path = make_directory(s, GIS_SPOOL_ASIDE, error);
    if (path) gis_spool_create(path, gis_source_extent(s->input.source), &s->aside, error);
    free(path);
    return s->aside;
}

/* Opens the writer of the layer, in a directory of its own if features become larger. */
static bool open_writer(spooling *s, gis_error *error)
{
    if (s->input.request->rules.enlarge && !(s->given = make_directory(s, "given", error))) return false;
    return gis_spool_create(s->given ? s->given : s->directory, gis_source_extent(s->input.source), &s->writer, error);
}

static bool add_feature(spooling *s, size_t i, char **copy, gis_error *error)
{
    const gis_layer_input *input = &s->input;
    const bool aside = input->feature[i].ignored;
    gis_spool_writer *to = aside ? open_aside(s, error) : s->writer;
    char number[64];
    gis_spool_feature feature = {.index = gis_source_first(input->source) + i,
                                 .fid = gis_source_fid(input->source, i),
                                 .demands = input->feature[i],
                                 .start = {NAN, NAN},
                                 .area = by_area(s) ? sunder_shape_area(input->shape[i]) : 0,
                                 .row = input->row ? input->row[i] + 1 : 0,
                                 .rigid = s->rigid && s->rigid[i],
                                 .gap_class = input->gap_class ? input->gap_class[i] : 0};
    const gis_layer_rules *rules = &input->request->rules;
    if (rules->hide && !aside && !gis_layer_check_class(input, i, error)) return false;
    if ((rules->hide || gis_levels_asked(rules)) && !aside) feature.hiding = gis_layer_hiding_cost(input, i);
    feature.demands.shape = input->shape[i];
    s->facts->aside += aside;
    return to && (!input->points || gis_arrow_start(input, i, feature.start, error)) &&
           id_text(input, i, copy, number, &feature.id, error) && gis_spool_add(to, &feature, error);
}

/* Is the feature written to a spool? An ignored feature is written only if the page will draw all features and its
 * shape is not empty; it then goes to the separate spool GIS_SPOOL_ASIDE. */
static bool is_spooled(const spooling *s, size_t i)
{
    const gis_layer_input *input = &s->input;
    return !input->feature[i].ignored ||
           (input->request->drawn && input->shape[i] && !sunder_shape_is_empty(input->shape[i]));
}

static void note_feature(gis_layer_facts *facts, const gis_layer_input *input, size_t i, unsigned char *status)
{
    const sunder_feature *demands = &input->feature[i];
    const sunder_shape *shape = input->shape[i];
    *status = demands->ignored                            ? SUNDER_FEATURE_SKIPPED
              : demands->fixed || demands->max_shift == 0 ? SUNDER_FEATURE_FIXED
                                                          : SUNDER_FEATURE_UNMOVED;
    facts->skipped += demands->ignored;
    if (input->gap_class) facts->class_there[input->gap_class[i]] = true;
    facts->vertices += shape ? sunder_shape_vertices(shape) : 0;
    facts->multi = facts->multi || (shape && sunder_shape_polygons(shape) > 1);
    if (!demands->ignored && !demands->fixed) facts->longest_limit = fmax(facts->longest_limit, demands->max_shift);
}

size_t gis_layer_status_bytes(const gis_layer_rules *rules)
{
    return 1 + (gis_levels_asked(rules) ? sizeof(double) : 0);
}

/* Writes what the file `status` has of feature i. */
static bool write_status(spooling *s, size_t i, gis_error *error)
{
    unsigned char status;
    double centre[2], radius;
    sunder_error why;
    note_feature(s->facts, &s->input, i, &status);
    if (!gis_disk_file_write(&s->status, &status, sizeof status, error)) return false;
    if (!gis_levels_asked(&s->input.request->rules)) return true;
    if (sunder_shape_largest_disc(s->input.shape[i], centre, &radius, &why) != SUNDER_OK)
        return gis_core_failed(error, "sunder_siz", &why);
    return gis_disk_file_write(&s->status, &(double){2 * radius}, sizeof(double), error);
}

static bool add_batch(spooling *s, gis_error *error)
{
    char *copy = NULL;
    bool done = true;
    for (size_t i = 0; done && i < s->input.n; i++)
        done = write_status(s, i, error) && (!is_spooled(s, i) || add_feature(s, i, &copy, error)) && gis_go_on(error);
    free(copy);
    return done;
}

/* ---- Values that depend on all features -------------------------------------------------------------------------- */

static bool settle_feature(void *user, gis_spool_feature *feature, gis_error *error)
{
    const spooling *s = user;
    sunder_feature *demands = &feature->demands;
    if (demands->block >= 0) demands->block = s->keys.rank[demands->block];
    if (!by_area(s)) return true;
    demands->weight *= gis_layer_area_weight(s->input.request->rules.weighting, feature->area, s->median);
    if (gis_layer_is_weight(demands->weight)) return true;
    char who[GIS_WHO_SIZE];
    gis_name_subject(&(gis_subject){NULL, gis_source_name(s->input.source), feature->fid != OGRNullFID, feature->fid,
                                    feature->index, feature->id},
                     who, sizeof who);
    return gis_layer_wrong_weight(who, demands->weight, error);
}

static void fill_facts(spooling *s)
{
    const gis_layer_input *input = &s->input;
    gis_layer_facts *facts = s->facts;
    facts->name = CPLStrdup(gis_source_name(input->source));
    facts->units = input->units;
    facts->gap = input->gap;
    facts->least_gap = input->least_gap;
    facts->max_shift = input->max_shift;
    facts->tolerance = input->tolerance;
    facts->points = input->points;
    facts->has_id = input->id_field >= 0;
    facts->id_type = gis_id_type(input);
    facts->invalid = input->invalid;
    facts->null = input->null;
    facts->other = input->other;
}

static void say_what_is_known(const spooling *s)
{
    const gis_source *source = s->input.source;
    gis_say_warnings(GIS_MESSAGE_INPUT, gis_source_warnings(source));
    gis_crs_units_warn(gis_source_crs(source), gis_source_name(source),
                       s->shapes[0] <= s->shapes[2] ? s->shapes : NULL);
    gis_layer_warn_of_others(&s->input, s->facts->source.content[GIS_POINTS] > 0);
}

/* ---- The layer --------------------------------------------------------------------------------------------------- */

/* Reads all batches. *again is set if FIDs turned out not to be unique while conditions were evaluated by FIDs; then
 * the layer must be read again. */
static bool read_batches(spooling *s, const gis_layer_input_request *request, const char *directory, bool *again,
                         gis_error *error)
{
    gis_layer_input *input = &s->input;
    if (!gis_layer_begin(request, true, input, error) || !gis_layer_lengths(input, error) || !open_writer(s, error) ||
        !gis_disk_file_create(&s->status, directory, "status.part", error))
        return false;
    for (bool any = true; any;)
        if (!gis_layer_checksums_add(&s->sums, input, error) || !take_demands(s, error) || !add_batch(s, error) ||
            !gis_source_next(input->source, &any, error))
            return false;
    s->facts->checksum = gis_layer_checksums_end(&s->sums);
    if (!gis_source_find_facts(input->source, &s->facts->source, error)) return false;
    *again = (request->rules.ignore_where || request->rules.fixed_where || request->rules.rigid_where) &&
             !s->facts->source.fids_unique && !request->source.fids_mean_nothing &&
             !gis_source_is_result(input->source);
    return true;
}

bool gis_layer_spool_barriers(const gis_layer_input *input, double reach, gis_spool *features, const char *directory,
                              gis_error *error)
{
    const gis_layer_input_request *request = input->request;
    /* The side of a point is where it stands, so barriers beyond the reach of its moves do not matter. */
    gis_barrier_targets *targets = gis_barrier_targets_of_spool(features, input->points ? INFINITY : reach);
    const gis_barrier_surroundings around = {
        .crs = gis_source_crs(input->source),
        .units = &input->units,
        .targets = targets,
        .reach = reach,
        .gap = gis_class_gaps_most(input),
        .least_gap = request->rules.least_gap.text ? input->least_gap : -1,
        .invalid = request->invalid,
        .output = request->output,
        .update = request->update,
    };
    const bool done = (targets || gis_no_memory(error)) && gis_barriers_spool(input, &around, directory, error);
    gis_barrier_targets_free(targets);
    return done;
}

/* Spools the barriers within reach of the spooled features. */
static bool spool_barriers(spooling *s, const char *directory, gis_error *error)
{
    const gis_layer_input_request *request = s->input.request;
    gis_spool *spool = NULL;
    s->facts->barrier_reach = INFINITY;
    if (request->barriers == 0) return true;
    if (!gis_spool_open(directory, &spool, error)) return false;
    s->facts->barrier_reach = gis_layer_barrier_reach(&s->input, request->moves ? s->facts->longest_limit : 0);
    const bool done = gis_layer_spool_barriers(&s->input, s->facts->barrier_reach, spool, directory, error);
    gis_spool_close(spool);
    return done;
}

static bool finish_spools(spooling *s, unsigned shards, const char *directory, gis_error *error)
{
    const bool settles = by_area(s) || s->keys.n > 0;
    gis_layer_drop_features(&s->input);
    if (!gis_block_keys_rank(&s->keys, error)) return false;
    s->median = gis_layer_median(s->areas, s->n_areas);
    free(s->areas);
    s->areas = NULL;
    fill_facts(s);
    say_what_is_known(s);
    return gis_spool_finish(s->writer, shards, settles ? settle_feature : NULL, s, error) &&
           (!s->given || gis_spool_enlarge(&s->input, s->given, directory, &s->facts->enlarged, error)) &&
           (!s->aside || gis_spool_finish(s->aside, 1, NULL, NULL, error)) &&
           gis_disk_file_place(&s->status, directory, "status", error) && spool_barriers(s, directory, error);
}

static void clear_spooling(spooling *s)
{
    gis_spool_writer_free(s->writer);
    gis_spool_writer_free(s->aside);
    if (s->given) gis_remove_tree(s->given);
    free(s->given);
    gis_disk_file_close(&s->status);
    gis_block_keys_clear(&s->keys);
    gis_block_keys_clear(&s->rows);
    free(s->areas);
    free(s->rigid);
    gis_layer_input_clear(&s->input);
}

static bool spool_once(const gis_layer_input_request *request, unsigned shards, const char *directory,
                       gis_layer_facts *facts, bool *again, gis_error *error)
{
    spooling s = {.directory = directory, .facts = facts};
    *facts = (gis_layer_facts){0};
    *again = false;
    gis_box_clear(facts->box);
    gis_box_clear(s.shapes);
    const bool done =
        read_batches(&s, request, directory, again, error) && (*again || finish_spools(&s, shards, directory, error));
    clear_spooling(&s);
    return done;
}

bool gis_layer_spool(const gis_layer_input_request *request, unsigned shards, const char *directory,
                     gis_layer_facts *facts, gis_error *error)
{
    gis_layer_input_request by_batches = *request;
    bool again;
    by_batches.source.batch = BATCH;
    if (!spool_once(&by_batches, shards, directory, facts, &again, error)) return false;
    if (!again) return true;
    by_batches.source.fids_mean_nothing = true;
    return spool_once(&by_batches, shards, directory, facts, &again, error);
}

void gis_layer_facts_clear(gis_layer_facts *facts)
{
    CPLFree(facts->name);
    facts->name = NULL;
}
