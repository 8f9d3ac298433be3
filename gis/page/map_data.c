/* map_data.c: see map_data.h.
 *
 * Numbers are integer multiples of a step, written as variable-length quantities in base 64, as in source maps
 * [ECMA-426]: each letter has five bits of the number, and its sixth bit says whether more letters follow; the lowest
 * bit of the number is its sign. A vertex takes about six bytes, and no letter has a meaning in HTML. The JSON object
 * has the members
 *
 *   box            the bounding box of all that is drawn; a coordinate is its minimum plus a multiple of the step
 *   step, unit     the length of a step; the unit of the layer
 *   label          the names of the drawn features, in the order of the features
 *   status         a digit for each feature, a sunder_feature_status
 *   move           dx, dy of each feature
 *   anchor         x, y of each feature whose move is not 0, as the difference from the previous one
 *   shape          the rings of each feature: the number of vertices, then each vertex as the difference from the
 *                  previous one, also across features; 0 ends a feature
 *   after          the rings of each feature that became larger or smaller, as the result has them, in the form of
 *                  shape; the others have none, and the column is empty if all have none
 *   barrier        of each barrier its width, its lines in the form of shape, and its rings in the same form
 *   conflict       of each listed conflict: 1 if it is proved, else 0; then the two ends of its link, each as the
 *                  difference from the previous point */
#include "page/map_data.h"

#include "base/interrupt.h"
#include "base/json.h"
#include "page/escape.h"
#include "page/page_words.h"

#include <math.h>
#include <stdlib.h>

/* The map shows at most this number of conflicts, the worst ones; the output layer has all of them. */
enum { MOST_CONFLICTS = 50000 };

/* The text that is written, and the previous point, from which differences are taken. */
typedef struct data_writer {
    const gis_page_model *model;
    const gis_thinning *thinning;
    gis_text *to;
    double step;
    long long last[2];
} data_writer;

static void add_integer(gis_text *to, long long value)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    unsigned long long rest = value < 0 ? (unsigned long long)-value << 1 | 1 : (unsigned long long)value << 1;
    char text[16];
    size_t n = 0;
    do {
        unsigned digit = rest & 31;
        rest >>= 5;
        text[n++] = letters[digit | (rest ? 32U : 0)];
    } while (rest);
    gis_text_add_bytes(to, text, n);
}

/* Converts a coordinate to steps from the minimum of the box. The operands are halved since the extent may exceed the
 * range of doubles. */
static long long coordinate_steps(const data_writer *writer, double value, int axis)
{
    return llround((value / 2 - writer->model->extent[axis] / 2) / (writer->step / 2));
}

static long long length_steps(const data_writer *writer, double value) { return llround(value / writer->step); }

static void add_corner(data_writer *writer, double x, double y)
{
    const long long at[2] = {coordinate_steps(writer, x, 0), coordinate_steps(writer, y, 1)};
    for (int k = 0; k < 2; k++) {
        add_integer(writer->to, at[k] - writer->last[k]);
        writer->last[k] = at[k];
    }
}

/* Returns the step: the power of ten that is at most 1/200 of the gap or of the mean move, whichever is smaller;
 * without both, of a tenth of the size of an average feature. It is not much less than 2^-40 of the extent. */
static double choose_step(const gis_page_model *model)
{
    const gis_page_request *request = model->request;
    double extent = fmax(model->extent[2] / 2 - model->extent[0] / 2, model->extent[3] / 2 - model->extent[1] / 2);
    double least = INFINITY;
    if (request->input->gap > 0) least = request->input->gap;
    if (request->summary->mean > 0) least = fmin(least, request->summary->mean);
    if (isinf(least)) least = 2 * extent / sqrt((double)model->n + 1) / 10;
    least = fmax(least / 200, extent * 0x1p-39);
    double step = least > 0 ? pow(10, floor(log10(least))) : 1;
    return step > 0 && isfinite(step) ? step : 1;
}

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

typedef bool add_cell(data_writer *writer, size_t feature, gis_error *error);

static bool add_column(data_writer *writer, const char *name, add_cell *cell, gis_error *error)
{
    gis_text_print(writer->to, ",\n\"%s\": \"", name);
    writer->last[0] = writer->last[1] = 0;
    for (size_t i = 0; i < writer->model->n; i++)
        if (writer->thinning->drawn[i] && (!gis_go_on(error) || !cell(writer, i, error))) return false;
    gis_text_add(writer->to, "\"");
    return true;
}

static bool add_status(data_writer *writer, size_t i, gis_error *error)
{
    (void)error;
    gis_text_print(writer->to, "%d", (int)writer->model->feature[i].status);
    return true;
}

static bool add_move(data_writer *writer, size_t i, gis_error *error)
{
    (void)error;
    for (int k = 0; k < 2; k++) add_integer(writer->to, length_steps(writer, writer->model->feature[i].move[k]));
    return true;
}

static bool add_anchor(data_writer *writer, size_t i, gis_error *error)
{
    const gis_view_feature *feature = &writer->model->feature[i];
    const sunder_shape *shape;
    double at[2];
    if (length_steps(writer, feature->move[0]) == 0 && length_steps(writer, feature->move[1]) == 0) return true;
    if (!gis_page_shape(writer->model, i, GIS_VIEW_FIRST, &shape, error)) return false;
    sunder_shape_anchor(shape, at);
    add_corner(writer, at[0], at[1]);
    return true;
}

/* Adds the rings of a shape of feature i as they are drawn, without rings that the simplification removes. */
static bool add_rings(data_writer *writer, size_t i, const sunder_shape *shape, gis_error *error)
{
    double tolerance = writer->thinning->drawn[i] == GIS_DRAWN_SIMPLER ? writer->thinning->tolerance : 0;
    gis_corners scratch = {0};
    bool ok = true;
    for (size_t p = 0; ok && p < sunder_shape_polygons(shape); p++)
        for (size_t r = 0; ok && r < sunder_shape_rings(shape, p); r++) {
            size_t n;
            const double *ring = sunder_shape_ring(shape, p, r, &n);
            if (tolerance > 0) {
                ok = gis_corners_simplify(&scratch, ring, n, tolerance, error);
                ring = scratch.xy;
                n = scratch.n;
            }
            if (!ok || n == 0) continue;
            add_integer(writer->to, (long long)n);
            for (size_t k = 0; k < n; k++) add_corner(writer, ring[2 * k], ring[2 * k + 1]);
        }
    gis_corners_clear(&scratch);
    return ok;
}

/* The end of a feature; no ring has 0 vertices. */
static void end_feature(data_writer *writer) { add_integer(writer->to, 0); }

static bool add_shape(data_writer *writer, size_t i, gis_error *error)
{
    const sunder_shape *shape;
    if (!gis_page_shape(writer->model, i, GIS_VIEW_READ, &shape, error) || !add_rings(writer, i, shape, error))
        return false;
    end_feature(writer);
    return true;
}

static bool add_shape_after(data_writer *writer, size_t i, gis_error *error)
{
    const sunder_shape *shape;
    if (writer->model->feature[i].changed &&
        (!gis_page_shape(writer->model, i, GIS_VIEW_NOW, &shape, error) || !add_rings(writer, i, shape, error)))
        return false;
    if (writer->model->changed) end_feature(writer);
    return true;
}

static bool add_labels(data_writer *writer, gis_error *error)
{
    gis_text name = {0};
    const char *separator = "";
    bool ok = true;
    gis_text_add(writer->to, ",\n\"label\": [");
    for (size_t i = 0; i < writer->model->n && ok; i++) {
        if (writer->thinning->drawn[i] == GIS_DRAWN_NOT) continue;
        name.length = 0;
        ok = gis_page_name(writer->model, i, &name, error) && (gis_text_get(&name) || gis_no_memory(error));
        if (!ok) break;
        gis_text_add(writer->to, separator);
        gis_escape_script(writer->to, gis_text_get(&name));
        separator = ",";
    }
    gis_text_add(writer->to, "]");
    gis_text_clear(&name);
    return ok;
}

static bool add_line(data_writer *writer, const double *xy, size_t n, bool closed, gis_corners *scratch,
                     gis_error *error)
{
    double tolerance = writer->thinning->barrier_tolerance;
    if (tolerance > 0) {
        if (!(closed ? gis_corners_simplify : gis_corners_simplify_line)(scratch, xy, n, tolerance, error))
            return false;
        xy = scratch->xy;
        n = scratch->n;
    }
    if (n > 0) add_integer(writer->to, (long long)n);
    for (size_t i = 0; i < n; i++) add_corner(writer, xy[2 * i], xy[2 * i + 1]);
    return true;
}

static bool add_barrier(data_writer *writer, const gis_view_barrier *barrier, gis_corners *scratch, gis_error *error)
{
    sunder_obstacle geometry;
    size_t begin = 0;
    bool ok = gis_page_geometry(writer->model, barrier, &geometry, error);
    if (!ok) return false;
    add_integer(writer->to, length_steps(writer, barrier->width));
    for (size_t line = 0; ok && line < geometry.lines; begin = geometry.line_end[line++])
        ok = add_line(writer, geometry.xy + 2 * begin, geometry.line_end[line] - begin, false, scratch, error);
    add_integer(writer->to, 0);
    for (size_t p = 0; ok && geometry.shape && p < sunder_shape_polygons(geometry.shape); p++)
        for (size_t r = 0; ok && r < sunder_shape_rings(geometry.shape, p); r++) {
            size_t n;
            const double *ring = sunder_shape_ring(geometry.shape, p, r, &n);
            ok = add_line(writer, ring, n, true, scratch, error);
        }
    add_integer(writer->to, 0);
    return ok;
}

static bool add_barriers(data_writer *writer, gis_error *error)
{
    const gis_page_model *model = writer->model;
    double tolerance = writer->thinning->barrier_tolerance;
    gis_corners scratch = {0};
    bool ok = true;
    gis_text_add(writer->to, ",\n\"barrier\": \"");
    writer->last[0] = writer->last[1] = 0;
    for (size_t k = 0; ok && k < model->n_barriers; k++) {
        const double *box = model->barrier[k].box;
        if (tolerance > 0 && fmax(box[2] - box[0], box[3] - box[1]) <= tolerance) continue;
        ok = gis_go_on(error) && add_barrier(writer, &model->barrier[k], &scratch, error);
    }
    gis_text_add(writer->to, "\"");
    gis_corners_clear(&scratch);
    return ok;
}

static void add_conflicts(data_writer *writer)
{
    const gis_page_model *model = writer->model;
    gis_text_add(writer->to, ",\n\"conflict\": \"");
    writer->last[0] = writer->last[1] = 0;
    for (size_t k = 0; k < model->n_conflicts && k < MOST_CONFLICTS; k++) {
        const sunder_conflict *each = model->conflict[k];
        add_integer(writer->to, gis_page_is_proved(each));
        add_corner(writer, each->from[0], each->from[1]);
        add_corner(writer, each->to[0], each->to[1]);
    }
    gis_text_add(writer->to, "\"");
}

bool gis_map_data_write(const gis_page_model *model, const gis_thinning *thinning, gis_text *to, gis_error *error)
{
    data_writer writer = {.model = model, .thinning = thinning, .to = to, .step = choose_step(model)};
    gis_json head = {0};
    gis_json_open(&head, '{');
    gis_json_put_double(&head, "step", writer.step);
    gis_json_put_string(&head, "unit", model->unit.length);
    gis_json_key(&head, "box");
    gis_json_open(&head, '[');
    for (int k = 0; k < 4; k++) gis_json_double(&head, model->extent[k]);
    gis_json_close(&head, ']');
    bool ok = gis_json_text(&head) || gis_no_memory(error);
    if (ok) gis_text_add(to, gis_json_text(&head));
    gis_json_clear(&head);
    ok = ok && add_labels(&writer, error) && add_column(&writer, "status", add_status, error) &&
         add_column(&writer, "move", add_move, error) && add_column(&writer, "anchor", add_anchor, error) &&
         add_column(&writer, "shape", add_shape, error) && add_column(&writer, "after", add_shape_after, error) &&
         add_barriers(&writer, error);
    if (ok) add_conflicts(&writer);
    gis_text_add(to, "}\n");
    return ok;
}
