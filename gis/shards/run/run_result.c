/* run_result.c: see layer/result.h. The results of a layer that was separated in parts are in sorted order on disk; the
 * features are read from the source a second time beside them. */
#include "shards/run/shard_run.h"

#include "base/array.h"
#include "base/interrupt.h"
#include "disk/file.h"
#include "layer/far_moves.h"
#include "layer/layer_checksum.h"
#include "layer/output.h"
#include "layer/result.h"

#include <cpl_conv.h>
#include <stdlib.h>
#include <string.h>

/* ---- The main layer ---------------------------------------------------------------------------------------------- */

/* The position in each list while the features are visited in input order. */
typedef struct passing {
    gis_shard_run *parts;
    const gis_layer_input *input;
    bool has_null;
    gis_feature_visit *visit; /* NULL: none */
    void *user;
    gis_disk_file status;
    unsigned char *alone; /* of the current batch: what the file `status` has of each feature, in so many bytes: */
    size_t room, bytes;
    bool any, any_larger; /* joined.rows, and joined.larger, have a current item */
    size_t block;
    gis_far_moves far_moves;
} passing;

/* The value of a feature's block in the output. own: its entry in joined.block; NULL: it is in no block. The block's
 * first feature must have been visited, so that its FID is known. */
static gis_value block_value(const gis_shard_run *p, bool has_null, const gis_part_link *own, size_t feature,
                             GIntBig fid)
{
    const gis_joined *j = &p->joined;
    const int64_t alone = has_null ? -1 : (int64_t)feature;
    if (!own) return gis_block_as_value(p->facts.source.fids_unique, alone, fid);
    return gis_block_as_value(p->facts.source.fids_unique, (int64_t)own->b,
                              p->block_fid[gis_joined_block(j, own->b) - j->block]);
}

/* What feature i of the batch is if it is alone. */
static gis_feature_row row_alone(const passing *at, size_t i)
{
    const unsigned char *alone = at->alone + i * at->bytes;
    gis_feature_row row = {.status = (sunder_feature_status)*alone};
    if (at->bytes > 1) memcpy(&row.size, alone + 1, sizeof row.size);
    return row;
}

/* Fills in the shape of feature i of the batch, if the item has one. *shape: the shape; the caller frees it. */
static bool fill_shape(const passing *at, size_t i, const gis_part_result *one, gis_feature_row *to,
                       sunder_shape **shape, gis_error *error)
{
    const gis_part_row *row = one->row;
    if (row->now.polygons == 0) return true;
    if (!gis_part_make_shape(one, &row->now, shape, error)) return false;
    to->other = *shape;
    to->multi = wkbFlatten(OGR_G_GetGeometryType(gis_source_geometry(at->input->source, i))) == wkbMultiPolygon;
    to->rung = row->rung;
    to->lost = row->lost;
    to->size = row->size;
    return true;
}

/* Fills in the result of feature i of the batch, and its shape. */
static bool fill_row(const passing *at, size_t i, const gis_part_result *one, gis_feature_row *to, sunder_shape **shape,
                     gis_error *error)
{
    const gis_part_row *row = one->row;
    to->dx = row->move[0];
    to->dy = row->move[1];
    to->status = row->status;
    gis_far_moves_warn(&at->far_moves, at->input, i, row->move);
    return fill_shape(at, i, one, to, shape, error);
}

/* Fills in the larger shape of feature i of the batch, if it has one and no smaller one, and is not hidden. */
static bool fill_larger(passing *at, size_t i, gis_feature_row *row, sunder_shape **shape, gis_error *error)
{
    gis_sorted_results *larger = &at->parts->joined.larger;
    if (!at->any_larger || larger->head.first != gis_source_first(at->input->source) + i) return true;
    const bool own = row->other || row->status == SUNDER_FEATURE_HIDDEN;
    return (own || fill_shape(at, i, &larger->one, row, shape, error)) &&
           gis_sorted_results_next(larger, &at->any_larger, error);
}

/* Visits a feature that is in this block, if it is in one. */
static bool visit_feature(const passing *at, size_t i, const gis_part_link *own, gis_feature_row *row, gis_error *error)
{
    const gis_source *source = at->input->source;
    if (!at->visit) return true;
    row->block = block_value(at->parts, at->has_null, own, gis_source_first(source) + i, gis_source_fid(source, i));
    return at->visit(at->user, i, row, error);
}

static bool pass_feature(passing *at, const gis_source *source, size_t i, gis_error *error)
{
    gis_shard_run *p = at->parts;
    const gis_joined *j = &p->joined;
    const size_t feature = gis_source_first(source) + i;
    gis_feature_row row = row_alone(at, i);
    gis_sorted_results *rows = &p->joined.rows;
    sunder_shape *shape = NULL;
    bool done = true;
    if (at->any && rows->head.first == feature) {
        if (rows->one.rows)
            done = fill_row(at, i, &rows->one, &row, &shape, error);
        else
            row.status = gis_joined_status(j, rows->one.still);
        done = done && gis_sorted_results_next(rows, &at->any, error);
    }
    const gis_part_link *own = at->block < j->blocks && j->block[at->block].a == feature ? &j->block[at->block] : NULL;
    if (own) p->block_fid[at->block++] = gis_source_fid(source, i);
    done = done && fill_larger(at, i, &row, &shape, error) && visit_feature(at, i, own, &row, error);
    sunder_shape_free(shape);
    return done;
}

/* Fails because the source differs from what was read the first time: the results do not fit its features any more. */
static bool input_changed(const gis_source *source, gis_error *error)
{
    return gis_fail(
        error,
        "%s: since the layer was read, features were changed, added or removed, or field values that the options use",
        gis_source_path(source));
}

static bool begin_batch(passing *at, const gis_layer_input *input, gis_layer_checksums *sums, gis_error *error)
{
    const gis_source *source = input->source;
    const size_t first = gis_source_first(source), n = gis_source_count(source);
    if (first + n > at->parts->facts.source.features) return input_changed(source, error);
    if (!gis_layer_checksums_add(sums, input, error)) return false;
    if (!gis_array_reserve(&at->alone, &at->room, n, at->bytes)) return gis_no_memory(error);
    return gis_disk_file_read(&at->status, first * at->bytes, at->alone, n * at->bytes, error);
}

static bool add_box(void *user, const gis_spool_feature *feature, const double box[4], size_t vertices,
                    gis_error *error)
{
    (void)feature;
    (void)vertices;
    (void)error;
    gis_far_moves_add(user, box);
    return true;
}

/* Collects the boxes of all features for warnings about far moves; only needed if a cell has a feature with corrupt
 * coordinates. */
static bool find_sound_part(gis_spool *spool, gis_far_moves *of, gis_error *error)
{
    const size_t cells = gis_spool_cells(spool);
    bool any = false, done = true;
    for (size_t k = 0; k < cells && !any; k++) any = gis_far_moves_may_warn(gis_spool_cell_at(spool, k)->box);
    for (size_t k = 0; k < cells && any && done; k++) done = gis_spool_skim(spool, k, add_box, of, error);
    return done;
}

/* Visits all features in order, even without a visitor, since blocks are identified by FIDs that become known then. */
static bool visit_features(const gis_result *r, bool has_null, gis_feature_visit *visit, void *user, gis_error *error)
{
    gis_shard_run *p = r->of;
    const gis_layer_input *input = r->input;
    gis_source *source = input->source;
    gis_layer_checksums sums = {0};
    passing at = {.parts = p,
                  .input = input,
                  .has_null = has_null,
                  .visit = visit,
                  .user = user,
                  .bytes = gis_layer_status_bytes(&p->request->rules)};
    bool any = true;
    p->block_fid = malloc((p->joined.blocks + 1) * sizeof *p->block_fid);
    if (!p->block_fid) return gis_no_memory(error);
    gis_sorted_results_rewind(&p->joined.rows);
    gis_sorted_results_rewind(&p->joined.larger);
    bool done = find_sound_part(p->spool, &at.far_moves, error) &&
                gis_disk_file_open(&at.status, p->directory, "status", error) &&
                gis_sorted_results_next(&p->joined.larger, &at.any_larger, error) &&
                gis_sorted_results_next(&p->joined.rows, &at.any, error);
    while (done && any) {
        done = begin_batch(&at, input, &sums, error);
        for (size_t i = 0; i < gis_source_count(source) && done; i++) done = pass_feature(&at, source, i, error);
        any = !p->whole;
        if (any) done = done && gis_source_next(source, &any, error);
    }
    gis_disk_file_close(&at.status);
    free(at.alone);
    if (done && gis_layer_checksums_end(&sums) != p->facts.checksum) return input_changed(source, error);
    return done;
}

/* ---- The others -------------------------------------------------------------------------------------------------- */

static gis_value id_value(const gis_shard_run *p, const char *text)
{
    if (!text || !p->facts.has_id) return (gis_value){.kind = GIS_NULL};
    if (p->facts.id_type == OFTInteger64) return (gis_value){GIS_INTEGER, {.integer = strtoll(text, NULL, 10)}};
    if (p->facts.id_type == OFTReal) return (gis_value){GIS_REAL, {.real = CPLAtof(text)}};
    return (gis_value){GIS_TEXT, {.text = text}};
}

static bool visit_arrows(const gis_result *r, bool has_null, gis_arrow_visit *visit, void *user, gis_error *error)
{
    gis_shard_run *p = r->of;
    gis_sorted_results *rows = &p->joined.rows;
    bool any = true;
    gis_sorted_results_rewind(rows);
    while (gis_sorted_results_next(rows, &any, error) && any) {
        const gis_part_row *own = rows->one.row;
        if (!rows->one.rows || (own->move[0] == 0 && own->move[1] == 0)) continue;
        const gis_arrow_row row = {
            .fid = gis_fid_as_value(own->fid),
            .id = id_value(p, gis_part_text(&rows->one, own->id)),
            .block = block_value(p, has_null, gis_joined_block(&p->joined, own->index), own->index, own->fid),
            .from = {own->from[0], own->from[1]},
            .move = {own->move[0], own->move[1]}};
        if (!visit(user, &row, error)) return false;
    }
    return !any;
}

/* The things that an item of a sorted list names. */
typedef struct named {
    const gis_shard_run *parts;
    const gis_part_result *one; /* the item */
} named;

/* The name of a feature or barrier in the current item. */
static const gis_part_name *name_of(const named *n, size_t feature)
{
    for (size_t k = 0; k < n->one->names; k++)
        if (n->one->name[k].index == feature) return &n->one->name[k];
    return NULL;
}

static GIntBig part_fid(const void *of, size_t feature)
{
    const gis_part_name *name = name_of(of, feature);
    return name ? name->fid : OGRNullFID;
}

static bool part_id(const void *of, size_t feature, char **copy, gis_value *value, gis_error *error)
{
    const named *n = of;
    const gis_part_name *name = name_of(n, feature);
    (void)copy;
    (void)error;
    *value = id_value(n->parts, name ? gis_part_text(n->one, name->id) : NULL);
    return true;
}

static GIntBig part_barrier(const void *of, size_t thing, const char **layer)
{
    const named *n = of;
    const gis_part_name *name = name_of(n, thing);
    *layer = name ? gis_part_text(n->one, name->id) : "";
    return name ? name->fid : OGRNullFID;
}

static bool visit_conflicts(const gis_result *r, gis_conflict_visit *visit, void *user, gis_error *error)
{
    gis_shard_run *p = r->of;
    gis_sorted_results *conflicts = &p->joined.conflicts;
    const named names = {p, &conflicts->one};
    const gis_things things = {&names, p->facts.source.features, part_fid, part_id, part_barrier, NULL};
    bool any = true;
    gis_sorted_results_rewind(conflicts);
    while (gis_sorted_results_next(conflicts, &any, error) && any) {
        gis_part_conflict *c = conflicts->one.conflict;
        c->is.blocked_by = conflicts->one.blocker;
        if (!visit(user, &c->is, &things, error)) return false;
    }
    return !any;
}

/* Visits the hidden features of the current batch of the source. *any: the sorted list has a current item. */
static bool visit_hidden_batch(const gis_result *r, bool *any, gis_hidden_visit *visit, void *user, gis_error *error)
{
    gis_shard_run *p = r->of;
    gis_sorted_results *hidden = &p->joined.hidden;
    const named names = {p, &hidden->one};
    const gis_things things = {&names, p->facts.source.features, part_fid, part_id, part_barrier, NULL};
    const gis_source *source = r->input->source;
    const size_t first = gis_source_first(source), end = first + gis_source_count(source);
    while (*any && hidden->head.first < end) {
        const gis_part_hidden *h = hidden->one.hidden;
        const gis_hidden_row row = {h->index, h->cost, hidden->one.blocker, h->things, h->proved, h->forced};
        if (!visit(user, &row, &things, gis_source_geometry(source, h->index - first), error) ||
            !gis_sorted_results_next(hidden, any, error))
            return false;
    }
    return true;
}

static bool visit_hidden(const gis_result *r, gis_hidden_visit *visit, void *user, gis_error *error)
{
    gis_shard_run *p = r->of;
    gis_source *source = r->input->source;
    bool any = true, more = true;
    gis_sorted_results_rewind(&p->joined.hidden);
    if (!gis_sorted_results_next(&p->joined.hidden, &any, error)) return false;
    if (any && !p->whole && !gis_source_again(source, &more, error)) return false;
    while (any && more) {
        if (!visit_hidden_batch(r, &any, visit, user, error)) return false;
        more = !p->whole;
        if (any && more && !gis_source_next(source, &more, error)) return false;
    }
    return true;
}

static void sum_hiding(const gis_result *r, gis_hiding *hiding)
{
    const gis_shard_run *p = r->of;
    *hiding = p->joined.hiding;
    hiding->enlarged = p->facts.enlarged;
}

/* The FID of one of the two features or barriers of the current push. */
static GIntBig push_fid(const void *of, size_t feature)
{
    const gis_part_push *push = ((const gis_part_result *)of)->push;
    return push->fid[feature != push->is.a];
}

static GIntBig push_barrier(const void *of, size_t thing, const char **layer)
{
    const gis_part_result *one = of;
    (void)thing;
    *layer = gis_part_text(one, one->push->layer);
    return one->push->fid[1];
}

static bool visit_pushes(const gis_result *r, gis_push_visit *visit, void *user, gis_error *error)
{
    gis_shard_run *p = r->of;
    gis_sorted_results *pushes = &p->joined.pushes;
    bool any = true;
    while (gis_sorted_results_next(pushes, &any, error) && any) {
        const gis_part_push *push = pushes->one.push;
        const gis_things things = {&pushes->one, p->facts.source.features, push_fid, NULL, push_barrier, NULL};
        if (!visit(user, &push->is, &things, push->from, push->to, error)) return false;
    }
    return !any;
}

/* The moves of features that are asked for in ascending order, as the rows are sorted. */
typedef struct moving {
    gis_sorted_results *rows;
    bool any;
} moving;

static bool move_of(void *user, size_t feature, double move[2], gis_error *error)
{
    moving *m = user;
    move[0] = move[1] = 0;
    if (!m->any || m->rows->head.first != feature) return true;
    if (m->rows->one.rows) memcpy(move, m->rows->one.row->move, 2 * sizeof *move);
    return gis_sorted_results_next(m->rows, &m->any, error);
}

/* Visits one row of houses; xy has room for the anchors of its features. */
static bool visit_row(const gis_joined *j, const sunder_row *row, double *xy, gis_house_row_visit *visit, void *user,
                      gis_error *error)
{
    GIntBig least = OGRNullFID;
    for (size_t k = 0; k < row->features; k++) {
        const gis_row_place *place = gis_joined_row_place(j, row->feature[k]);
        if (k == 0 || place->fid < least) least = place->fid;
        memcpy(xy + 2 * k, place->at, sizeof place->at);
    }
    return visit(user, row, least, xy, error);
}

static bool visit_rows(const gis_result *r, gis_house_row_visit *visit, void *user, gis_error *error)
{
    const gis_joined *j = &((const gis_shard_run *)r->of)->joined;
    size_t longest = 0;
    for (size_t k = 0; k < j->row_list.rows; k++)
        if (j->row_list.row[k].features > longest) longest = j->row_list.row[k].features;
    double *xy = malloc((2 * longest + 1) * sizeof *xy);
    bool done = xy || gis_no_memory(error);
    for (size_t k = 0; k < j->row_list.rows && done; k++)
        done = visit_row(j, &j->row_list.row[k], xy, visit, user, error);
    free(xy);
    return done;
}

static bool write_symbols(const gis_result *r, gis_sink *sink, gis_error *error)
{
    gis_shard_run *p = r->of;
    moving m = {.rows = &p->joined.rows};
    gis_sorted_results_rewind(m.rows);
    return gis_sorted_results_next(m.rows, &m.any, error) &&
           gis_write_symbols_anew(sink, r->input, p->facts.multi, !p->whole, move_of, &m, error);
}

static bool write_proof(const gis_result *r, const sunder_layer_summary *summary, FILE *to, gis_error *error)
{
    return gis_shard_run_proof(r->of, r->input, summary, to, error);
}

static GIntBig longest_fid(const gis_result *r, size_t feature)
{
    (void)feature;
    return ((const gis_shard_run *)r->of)->joined.longest_fid;
}

static OGRFieldType id_type(const gis_result *r) { return ((const gis_shard_run *)r->of)->facts.id_type; }

gis_result gis_shard_run_result(gis_shard_run *parts, const gis_layer_input *input)
{
    static const gis_result_kind kind = {visit_features, visit_arrows,       visit_conflicts, visit_pushes,
                                         visit_rows,     write_symbols,      visit_hidden,    sum_hiding,
                                         write_proof,    gis_shard_run_view, longest_fid,     id_type};
    return (gis_result){&kind, input, parts};
}
