/* shard_run.c: see shard_run.h. */
#include "shards/run/shard_run.h"

#include "base/interrupt.h"
#include "base/message.h"
#include "base/path.h"
#include "base/remove_tree.h"
#include "base/resources.h"
#include "disk/temporary.h"
#include "shards/parts/part_memory.h"

#include <cpl_conv.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The spool is divided into at least LEAST_PARTS parts; a process separates as many neighbouring parts at once as
 * memory allows. */
enum { LEAST_PARTS = 4096 };
enum { BATCH = 16384 };

static const double bytes_anyway = GIS_PART_BYTES_ANYWAY;
/* Bytes while the layer is written: for each feature, and for what is sorted and written at once, which grows with the
 * first million features up to bytes_full. */
static const double bytes_written = 32, bytes_filled = 30, bytes_full = 30e6;
/* Bytes for each feature of the layer while rows of houses are joined, if half of the features are in rows. */
static const double bytes_of_rows = 120;
/* Bytes while the layer is drawn: for each feature its place and block; and the data of the page. */
static const double bytes_drawn = 90, bytes_of_page = 60e6;
/* Bytes for barriers: their pieces, and the shapes of their parts. */
static const double bytes_a_barrier = 1000, bytes_a_barrier_vertex = 300;

/* ---- Onto the disk ----------------------------------------------------------------------------------------------- */

static unsigned parts_of(unsigned shards) { return shards * ((LEAST_PARTS + shards - 1) / shards); }

static bool make_directory(gis_shard_run *p, const char *where, gis_error *error)
{
    p->scratch = gis_path_join(where, "parts" GIS_OWN_LETTERS);
    p->scratch_lock = gis_make_directory(p->scratch);
    if (p->scratch_lock < 0) {
        gis_fail(error, "%s: a directory for the parts of the layer cannot be made: %s", p->scratch, strerror(errno));
        CPLFree(p->scratch);
        p->scratch = NULL;
        return false;
    }
    p->leftover = gis_leftover_temporary(p->scratch);
    return true;
}

static double bytes_of_barriers(const gis_spooled_barriers *b)
{
    if (!b->all) return 0;
    return bytes_a_barrier * (double)gis_spool_features(b->all) +
           bytes_a_barrier_vertex * (double)gis_spool_vertices(b->all);
}

double gis_shard_run_bytes(const gis_layer_rules *rules, double features, double vertices)
{
    return gis_part_bytes(rules->core.keep_trees, rules->core.effort, features, vertices);
}

double gis_shard_run_bytes_written(const gis_layer_input_request *request, double features)
{
    const double rows = request->rules.core.rows ? bytes_of_rows * features : 0,
                 written = fmin(bytes_full, bytes_filled * features) + bytes_written * features + rows,
                 page =
                     request->drawn ? fmin(bytes_of_page, bytes_of_page / 1e5 * features) + bytes_drawn * features : 0;
    return bytes_anyway + fmax(written, page);
}

/* Chooses how many parts are separated at once in the memory that is left; fails if even one does not fit. */
static bool choose_parts(gis_shard_run *p, double memory, gis_error *error)
{
    const unsigned parts = gis_spool_parts(p->spool);
    const double features = (double)gis_spool_features(p->spool), vertices = (double)gis_spool_vertices(p->spool),
                 all = gis_shard_run_bytes(&p->request->rules, features, vertices) - bytes_anyway +
                       bytes_of_barriers(&p->barriers),
                 written = gis_shard_run_bytes_written(p->request, (double)p->facts.source.features),
                 least = fmax(bytes_anyway + all / parts, written);
    if (!(memory > least))
        return gis_fail(error, "--max-memory: %zu features need %.0f MB at least", p->facts.source.features,
                        ceil(least / 1e6) + 1);
    const double left = memory - bytes_anyway;
    p->at_once = (unsigned)fmin(parts, fmax(1, floor(parts * left / fmax(all, 1))));
    return true;
}

/* The layer, as far as it is known without its features. */
static gis_layer_input known_input(const gis_shard_run *p)
{
    return (gis_layer_input){.request = p->request,
                             .points = p->facts.points,
                             .units = p->facts.units,
                             .gap = p->facts.gap,
                             .least_gap = p->facts.least_gap,
                             .max_shift = p->facts.max_shift,
                             .tolerance = p->facts.tolerance,
                             .class_tables = p->tables,
                             .blocks_given = p->request->rules.enlarge,
                             .barrier_reach = p->facts.barrier_reach};
}

static bool find_tables(gis_shard_run *p, gis_error *error)
{
    gis_layer_input input = known_input(p);
    const bool done = gis_class_gaps_tables(&input, error);
    p->tables = input.class_tables;
    return done;
}

/* Sets the options for the core, as gis_layer_core_options() does for a layer that is held in memory. */
static void choose_options(gis_shard_run *p)
{
    const gis_layer_input input = known_input(p);
    p->layout.how = gis_layer_core_options(&input);
    p->layout.rules = &p->request->rules;
    p->layout.lengths = &p->lengths;
}

/* If rows of houses are wanted, the distance up to which features around a part are read is larger by this number of
 * gaps. The neighbours of a house depend on all features within four gaps of the house, of its neighbours, and of their
 * neighbours. */
static const double row_gaps = 9;

static bool open_spool(gis_shard_run *p, double memory, gis_error *error)
{
    const gis_layer_rules *rules = &p->request->rules;
    const bool numbered = rules->block_field || rules->rows_field || rules->enlarge;
    if (!find_tables(p, error)) return false;
    const gis_layer_input input = known_input(p);
    const double gap = gis_class_gaps_most(&input);
    const bool done =
        gis_rung_lengths_read(rules, &p->facts.units, &p->lengths, error) &&
        gis_spool_open(p->directory, &p->spool, error) &&
        (gis_spool_parts(p->spool) == parts_of(p->shards) ||
         gis_fail(error, "%s: its cells are assigned to other shards; make the plan anew", p->directory)) &&
        (p->request->barriers == 0 || gis_barriers_open(p->directory, &p->barriers, error)) &&
        choose_parts(p, memory, error) && gis_layout_make(p->spool, gap, numbered, &p->layout, error);
    if (rules->core.rows) p->layout.halo += row_gaps * gap;
    p->layout.gaps = gis_class_gaps_core(rules->classes, &p->tables);
    p->layout.gaps.there = p->facts.class_there;
    p->layout.barriers = p->barriers;
    p->layout.features = p->facts.source.features;
    p->layout.memory = memory;
    p->layout.name = p->facts.name;
    p->layout.by_places = !p->facts.source.fids_unique;
    return done;
}

/* Features are in the same contact group within the gap plus this fraction of a metre (or of a unit, if its length is
 * unknown). */
static const double next_to_nothing = 1e-6;

static bool find_group(gis_shard_run *p, gis_error *error)
{
    const gis_layer_input input = known_input(p);
    const double metres = p->facts.units.unit_metres, reach = fmax(gis_class_gaps_most(&input), p->facts.tolerance) +
                                                              next_to_nothing / (metres > 0 ? metres : 1);
    choose_options(p);
    if (!gis_contact_group_find(&p->layout, reach, p->layout.memory, &p->facts.group, error)) return false;
    gis_shard_run_warn_of_group(p);
    return true;
}

/* Warns if the largest contact group takes more memory than allowed. It is separated as one piece, whatever its size;
 * the warning comes before hours are spent on the rest. */
void gis_shard_run_warn_of_group(const gis_shard_run *parts)
{
    const gis_contact_group *t = &parts->facts.group;
    const double bytes = gis_shard_run_bytes(&parts->request->rules, (double)t->features, (double)t->vertices);
    if (bytes > GIS_PART_LARGE * parts->layout.memory)
        gis_say_warning(
            GIS_MESSAGE_MEMORY,
            "%zu features form one connected group, from (%.12g, %.12g) to (%.12g, %.12g), which is separated "
            "as one piece: it takes about %.0f MB, more than --max-memory",
            t->features, t->box[0], t->box[1], t->box[2], t->box[3], ceil(bytes / 1e6));
}

bool gis_shard_run_begin(const gis_layer_input_request *request, const char *directory, unsigned shards, double memory,
                         gis_shard_run *out, gis_error *error)
{
    const char *where = getenv("TMPDIR");
    *out = (gis_shard_run){.request = request, .shards = shards};
    if (!directory && !make_directory(out, where && *where ? where : "/tmp", error)) return false;
    out->directory = CPLStrdup(directory ? directory : out->scratch);
    return gis_layer_spool(request, parts_of(shards), out->directory, &out->facts, error) &&
           open_spool(out, memory, error) && find_group(out, error);
}

bool gis_shard_run_resume(const gis_layer_input_request *request, const char *directory, const gis_layer_facts *facts,
                          unsigned shards, double memory, gis_shard_run *out, gis_error *error)
{
    *out = (gis_shard_run){.request = request, .shards = shards, .facts = *facts};
    out->facts.name = CPLStrdup(facts->name);
    out->directory = CPLStrdup(directory);
    return open_spool(out, memory, error);
}

bool gis_shard_run_open_source(gis_shard_run *parts, bool whole, gis_layer_input *out, gis_error *error)
{
    gis_layer_input_request again = *parts->request;
    parts->whole = whole;
    again.source.batch = whole ? 0 : BATCH;
    again.source.facts = &parts->facts.source;
    const bool done = gis_layer_begin(&again, true, out, error) &&
                      gis_rung_lengths_read(&parts->request->rules, &parts->facts.units, &out->lengths, error);
    out->request = parts->request;
    out->n = parts->facts.source.features;
    out->gap = parts->facts.gap;
    out->least_gap = parts->facts.least_gap;
    out->max_shift = parts->facts.max_shift;
    out->tolerance = parts->facts.tolerance;
    out->barrier_reach = parts->facts.barrier_reach;
    out->enlarged = parts->facts.enlarged;
    out->invalid = parts->facts.invalid;
    out->null = parts->facts.null;
    out->other = parts->facts.other;
    return done && gis_class_gaps_tables(out, error);
}

/* ---- Shards ------------------------------------------------------------------------------------------------------ */

static gis_part_stamp stamp_of(const gis_shard_run *p, unsigned k, uint64_t options)
{
    gis_part_stamp stamp = {.options = options, .spool = gis_spool_checksum(p->spool), .shard = k, .shards = p->shards};
    if (p->barriers.all) stamp.spool = stamp.spool * 31 + gis_spool_checksum(p->barriers.all);
    snprintf(stamp.version, sizeof stamp.version, "%s", sunder_version());
    return stamp;
}

/* Per-part progress is not shown; the callback only polls for signals. */
static void begin_listening(gis_shard_run *p, gis_progress *silent)
{
    choose_options(p);
    *silent = gis_progress_new(GIS_PROGRESS_NONE);
    p->layout.how.progress = gis_progress_call;
    p->layout.how.progress_user = silent;
    p->layout.explain = &p->explain;
    p->layout.verify = &p->verify;
}

static void end_listening(gis_shard_run *p)
{
    p->layout.how.progress = NULL;
    p->layout.how.progress_user = NULL;
}

static bool separate_parts(gis_shard_run *p, unsigned k, gis_part_file *file, gis_progress *progress, gis_error *error)
{
    const unsigned parts = gis_spool_parts(p->spool) / p->shards, last = k * parts;
    gis_part_result result = {0};
    bool done = true;
    for (unsigned first = last - parts; first < last && done; first += p->at_once) {
        const unsigned end = first + p->at_once < last ? first + p->at_once : last;
        gis_part_result_empty(&result);
        done = gis_parts_separate(&p->layout, first, end, &result, error) && gis_part_file_add(file, &result, error);
        gis_progress_call((double)(end + parts - last) / parts, progress);
        done = done && gis_go_on(error);
    }
    gis_part_result_clear(&result);
    gis_memory_back();
    return done;
}

bool gis_shard_run_separate(gis_shard_run *parts, unsigned k, uint64_t options, gis_progress *progress,
                            gis_error *error)
{
    gis_progress silent;
    gis_part_file file;
    const gis_part_stamp stamp = stamp_of(parts, k, options);
    begin_listening(parts, &silent);
    const bool done = gis_part_file_create(&file, parts->directory, &stamp, error) &&
                      separate_parts(parts, k, &file, progress, error) &&
                      gis_part_file_place(&file, parts->directory, error);
    gis_part_file_close(&file);
    end_listening(parts);
    return done;
}

static bool open_shard(const gis_shard_run *p, const gis_part_stamp *stamp, gis_part_file *file, gis_error *error)
{
    const bool done = gis_part_file_open(file, p->directory, stamp, error);
    file->places = p->facts.source.features + (p->barriers.all ? gis_spool_features(p->barriers.all) : 0);
    return done;
}

static bool is_sound(gis_part_file *file, gis_error *error)
{
    gis_part_result one = {0};
    bool done = true;
    for (size_t k = 0; k < file->chunks && done; k++) done = gis_part_file_check(file, k, &one, error);
    gis_part_result_clear(&one);
    return done;
}

bool gis_shard_run_state(const gis_shard_run *parts, unsigned k, uint64_t options, gis_shard_state *state,
                         gis_error *why, gis_error *error)
{
    char name[GIS_PART_FILE_NAME];
    gis_part_file file;
    const gis_part_stamp stamp = stamp_of(parts, k, options);
    gis_part_file_name(k, name);
    *state = GIS_SHARD_MISSING;
    char *path = gis_path_join(parts->directory, name);
    const bool missing = access(path, F_OK) != 0 && errno == ENOENT;
    CPLFree(path);
    if (missing) return true;
    *state = open_shard(parts, &stamp, &file, why) && is_sound(&file, why) ? GIS_SHARD_DONE : GIS_SHARD_WRONG;
    gis_part_file_close(&file);
    return gis_go_on(error);
}

/* ---- Joining ----------------------------------------------------------------------------------------------------- */

static bool join_files(gis_shard_run *p, uint64_t options, gis_error *error)
{
    gis_part_file *file = calloc(p->shards, sizeof *file);
    bool done = file || gis_no_memory(error);
    for (unsigned k = 0; k < p->shards && done; k++) {
        const gis_part_stamp stamp = stamp_of(p, k + 1, options);
        done = open_shard(p, &stamp, &file[k], error);
    }
    done = done && gis_parts_join(&p->layout, file, p->shards, p->scratch, &p->joined, error);
    for (unsigned k = 0; k < p->shards && file; k++) gis_part_file_close(&file[k]);
    free(file);
    return done;
}

const char *gis_shard_run_scratch(gis_shard_run *parts, gis_error *error)
{
    if (parts->scratch) return parts->scratch;
    gis_remove_abandoned(parts->directory, "parts");
    gis_remove_abandoned(parts->directory, "shard-");
    return make_directory(parts, parts->directory, error) ? parts->scratch : NULL;
}

/* Spools the barriers again; the two spools have the same checksum if the barriers are the same. */
bool gis_shard_run_compare_barriers(gis_shard_run *parts, const gis_layer_input *input, gis_error *error)
{
    if (parts->request->barriers == 0) return true;
    if (!gis_shard_run_scratch(parts, error)) return false;
    gis_spooled_barriers now = {0};
    gis_error why = {0};
    const bool read = gis_layer_spool_barriers(input, parts->facts.barrier_reach, parts->spool, parts->scratch, &why) &&
                      gis_barriers_open(parts->scratch, &now, &why);
    if (!read)
        gis_say_warning(GIS_MESSAGE_INPUT, "it is not known whether barriers have changed since the plan was made: %s",
                        why.message);
    else if (gis_spool_checksum(now.all) != gis_spool_checksum(parts->barriers.all))
        gis_say_warning(GIS_MESSAGE_INPUT,
                        "barriers have changed since the plan was made (%s%s); moves and conflicts are for the "
                        "barriers as they were then; make the plan anew for the present ones",
                        parts->request->barrier[0].dataset, parts->request->barriers > 1 ? ", or another of them" : "");
    gis_barriers_close(&now);
    return gis_go_on(error);
}

bool gis_shard_run_join(gis_shard_run *parts, uint64_t options, sunder_layer_summary *summary, gis_error *error)
{
    gis_progress silent;
    begin_listening(parts, &silent);
    const bool done =
        gis_shard_run_scratch(parts, error) && join_files(parts, options, error) &&
        (!parts->request->rules.enlarge || gis_joined_larger_make(&parts->joined, parts->spool, parts->scratch, error));
    end_listening(parts);
    gis_layout_clear(&parts->layout); /* writing needs the memory */
    gis_memory_back();
    *summary = parts->joined.summary;
    summary->features = parts->facts.source.features;
    summary->vertices = parts->facts.vertices;
    summary->skipped = parts->facts.skipped;
    summary->seconds_explain = parts->explain;
    summary->seconds_verify = parts->verify;
    return done;
}

void gis_shard_run_clear(gis_shard_run *parts)
{
    gis_joined_clear(&parts->joined);
    gis_layout_clear(&parts->layout);
    gis_spool_close(parts->spool);
    gis_barriers_close(&parts->barriers);
    gis_layer_facts_clear(&parts->facts);
    gis_rung_lengths_clear(&parts->lengths);
    gis_class_gaps_clear(&parts->tables);
    free(parts->block_fid);
    if (parts->scratch) {
        gis_remove_tree(parts->scratch);
        close(parts->scratch_lock);
    }
    gis_leftover_forget(parts->leftover);
    CPLFree(parts->directory);
    CPLFree(parts->scratch);
    *parts = (gis_shard_run){0};
}
