/* pictures.c: see pictures.h. Each class of features is one path with the class name of the style sheet; features that
 * did not move are at the bottom, those in conflict on top. The unit is a tenth of a pixel. */
#include "page/pictures.h"

#include "base/interrupt.h"
#include "page/page_words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The classes in the order of drawing, and their class names after and before the move. */
static const struct {
    sunder_feature_status status;
    const char *after, *before;
} classes[] = {
    {SUNDER_FEATURE_HIDDEN, "hidden", "unmoved"},   {SUNDER_FEATURE_SKIPPED, "skipped", "skipped"},
    {SUNDER_FEATURE_UNMOVED, "unmoved", "unmoved"}, {SUNDER_FEATURE_FIXED, "fixed", "fixed"},
    {SUNDER_FEATURE_MOVED, "moved", "stood"},       {SUNDER_FEATURE_BLOCKED, "blocked", "blocked"},
};
enum { CLASSES = sizeof classes / sizeof *classes };

typedef struct picture_writer {
    const gis_page_model *model;
    gis_picture picture;
    gis_corners scratch;
    gis_text *to;
} picture_writer;

static void begin_svg(picture_writer *writer, const char *class, const char *label)
{
    gis_text_print(writer->to, "<svg class=\"%s\" viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"%s\">\n", class,
                   writer->picture.width, writer->picture.height, label);
}

/* Adds a feature to the open path if its box meets the window. */
static bool add_feature(picture_writer *writer, size_t i, double part, gis_error *error)
{
    const gis_view_feature *feature = &writer->model->feature[i];
    const sunder_shape *shape;
    const double move[2] = {part * feature->move[0], part * feature->move[1]};
    double box[4];
    gis_page_box(feature, part, box);
    if (!feature->vertices || !gis_box_meets(box, writer->picture.window)) return true;
    return gis_page_shape(writer->model, i, part > 0 ? GIS_VIEW_NOW : GIS_VIEW_READ, &shape, error) &&
           gis_picture_add_shape(&writer->picture, shape, move, &writer->scratch, writer->to, error);
}

typedef bool add_one(picture_writer *writer, size_t feature, double part, gis_error *error);

/* Adds a path with all features of one status; none if no feature of it is visible. */
static bool add_path(picture_writer *writer, const char *class, double part, add_one *add, sunder_feature_status status,
                     gis_error *error)
{
    const gis_page_model *model = writer->model;
    size_t before = writer->to->length;
    gis_text_print(writer->to, "<path class=\"%s\" d=\"", class);
    size_t begin = writer->to->length;
    for (size_t i = 0; i < model->n; i++) {
        if (model->feature[i].status != status) continue;
        if (!gis_go_on(error) || !add(writer, i, part, error)) return false;
    }
    if (writer->to->length == begin)
        writer->to->length = before;
    else
        gis_text_add(writer->to, "\"/>\n");
    return true;
}

/* ---- Barriers ---------------------------------------------------------------------------------------------------- */

/* How barriers are drawn in one pass. */
typedef struct barrier_paint {
    const char *class, *wide_class; /* the class of lines that are at least `wide` wide; NULL: the same as `class` */
    double wide, more;              /* in units of the picture; `more` is added to the width of the barrier */
    bool own_width;                 /* the path has an attribute with its width */
    double least_size;              /* barriers smaller than this are not drawn */
} barrier_paint;

/* Adds the visible part of a barrier to the open path. */
static bool add_barrier(picture_writer *writer, const gis_view_barrier *barrier, gis_error *error)
{
    static const double still[2] = {0, 0};
    sunder_obstacle geometry;
    size_t begin = 0;
    if (!gis_page_geometry(writer->model, barrier, &geometry, error)) return false;
    for (size_t line = 0; line < geometry.lines; begin = geometry.line_end[line++])
        gis_picture_add_line(&writer->picture, geometry.xy + 2 * begin, geometry.line_end[line] - begin, writer->to);
    return !geometry.shape ||
           gis_picture_add_shape(&writer->picture, geometry.shape, still, &writer->scratch, writer->to, error);
}

static void open_barriers(picture_writer *writer, const gis_view_barrier *barrier, const barrier_paint *paint)
{
    const double width = gis_picture_length(&writer->picture, barrier->width);
    const bool wide = paint->wide_class && !barrier->area && width >= paint->wide;
    gis_text_print(writer->to, "<path class=\"%s %s\"", wide ? paint->wide_class : paint->class,
                   barrier->area ? "area" : "line");
    if (paint->own_width) gis_text_print(writer->to, " stroke-width=\"%.0f\"", width + paint->more);
    gis_text_add(writer->to, " d=\"");
}

/* Adds a path for each group of consecutive barriers of equal type and width; none if nothing of the group is
 * visible. */
static bool paint_barriers(picture_writer *writer, const barrier_paint *paint, gis_error *error)
{
    const gis_page_model *model = writer->model;
    for (size_t k = 0; k < model->n_barriers;) {
        const gis_view_barrier *first = &model->barrier[k];
        const size_t before = writer->to->length;
        open_barriers(writer, first, paint);
        const size_t empty = writer->to->length;
        for (; k < model->n_barriers; k++) {
            const gis_view_barrier *each = &model->barrier[k];
            const double size = fmax(each->box[2] - each->box[0], each->box[3] - each->box[1]);
            if (each->area != first->area || each->width != first->width) break;
            if (!gis_box_meets(each->box, writer->picture.window) ||
                gis_picture_length(&writer->picture, size) < paint->least_size)
                continue;
            if (!gis_go_on(error) || !add_barrier(writer, each, error)) return false;
        }
        if (writer->to->length == empty)
            writer->to->length = before;
        else
            gis_text_add(writer->to, "\"/>\n");
    }
    return true;
}

/* Draws the outlines of all barriers first, so that roads that meet are not separated by an outline. */
static bool add_barriers(picture_writer *writer, double rim, double least_size, gis_error *error)
{
    const barrier_paint rims = {"rim", NULL, 0, rim, true, least_size}, roads = {"road", NULL, 0, 0, true, least_size};
    return paint_barriers(writer, &rims, error) && paint_barriers(writer, &roads, error);
}

/* Marks barriers under features by a dashed line along the centre line, or along the boundary of an area. Its colour is
 * that of the barriers, so that it is visible on features only. */
static bool add_underpasses(picture_writer *writer, gis_error *error)
{
    enum { WIDE = 60 };
    const barrier_paint under = {"under", "under wide", WIDE, 0, false, 0};
    return paint_barriers(writer, &under, error);
}

/* ---- Close-ups --------------------------------------------------------------------------------------------------- */

enum { CLOSE_UP_WIDTH = 4000, CLOSE_UP_HEIGHT = 3000, CLOSE_UP_RIM = 30 };

static bool has_moved(const picture_writer *writer, const gis_view_feature *feature)
{
    return gis_picture_length(&writer->picture, gis_page_length(feature)) >= 20;
}

static bool add_ghost(picture_writer *writer, size_t i, double part, gis_error *error)
{
    return !has_moved(writer, &writer->model->feature[i]) || add_feature(writer, i, part, error);
}

static void add_line(picture_writer *writer, const char *class, const double from[2], const double to[2])
{
    double a[2], b[2];
    gis_picture_place(&writer->picture, from[0], from[1], a);
    gis_picture_place(&writer->picture, to[0], to[1], b);
    gis_text_print(writer->to, "<path class=\"%s\" d=\"M%.0f %.0fL%.0f %.0f\"/>\n", class, a[0], a[1], b[0], b[1]);
}

/* Draws the original positions of the features that moved, and an arrow from there to the new position. */
static bool add_moves(picture_writer *writer, gis_error *error)
{
    const gis_page_model *model = writer->model;
    for (int status = SUNDER_FEATURE_MOVED; status <= SUNDER_FEATURE_BLOCKED; status++)
        if (!add_path(writer, "ghost", 0, add_ghost, (sunder_feature_status)status, error)) return false;
    for (size_t i = 0; i < model->n; i++) {
        const gis_view_feature *feature = &model->feature[i];
        const sunder_shape *shape;
        double box[4], from[2];
        gis_page_box(feature, 1, box);
        gis_box_join(box, feature->box);
        if (!feature->vertices || !gis_box_meets(box, writer->picture.window) || !has_moved(writer, feature)) continue;
        if (!gis_page_shape(model, i, GIS_VIEW_FIRST, &shape, error)) return false;
        sunder_shape_anchor(shape, from);
        const double to[2] = {from[0] + feature->move[0], from[1] + feature->move[1]};
        add_line(writer, "arrow", from, to);
    }
    return true;
}

/* Draws a line along a row, through the anchors of its features after the fraction `part` of their moves. */
static bool add_row(picture_writer *writer, const sunder_row *row, double part, gis_error *error)
{
    const size_t n = row->features + row->ring;
    gis_text_add(writer->to, "<path class=\"row\" d=\"");
    for (size_t k = 0; k < n; k++) {
        const size_t i = row->feature[k % row->features];
        const double *move = writer->model->feature[i].move;
        const sunder_shape *shape;
        double anchor[2], at[2];
        if (!gis_page_shape(writer->model, i, GIS_VIEW_FIRST, &shape, error)) return false;
        sunder_shape_anchor(shape, anchor);
        gis_picture_place(&writer->picture, anchor[0] + part * move[0], anchor[1] + part * move[1], at);
        gis_text_print(writer->to, "%c%.0f %.0f", k ? 'L' : 'M', at[0], at[1]);
    }
    gis_text_add(writer->to, "\"/>\n");
    return true;
}

/* Draws the link of a conflict, and a disc if the link is too short to be visible; the disc is open if the conflict is
 * not proved. */
static void add_link(picture_writer *writer, const sunder_conflict *conflict)
{
    enum { SHORT = 120, RADIUS = 50 };
    double at[2];
    double length = hypot(conflict->to[0] - conflict->from[0], conflict->to[1] - conflict->from[1]);
    add_line(writer, "link", conflict->from, conflict->to);
    if (gis_picture_length(&writer->picture, length) >= SHORT) return;
    gis_picture_place(&writer->picture, conflict->from[0], conflict->from[1], at);
    gis_text_print(writer->to, "<circle class=\"%s\" cx=\"%.0f\" cy=\"%.0f\" r=\"%d\"/>\n",
                   gis_page_is_proved(conflict) ? "spot" : "spot open", at[0], at[1], RADIUS);
}

static void add_links(picture_writer *writer)
{
    const gis_page_model *model = writer->model;
    for (size_t k = 0; k < model->n_conflicts; k++) {
        const sunder_conflict *each = model->conflict[k];
        const double box[4] = {fmin(each->from[0], each->to[0]), fmin(each->from[1], each->to[1]),
                               fmax(each->from[0], each->to[0]), fmax(each->from[1], each->to[1])};
        if (gis_box_meets(box, writer->picture.window)) add_link(writer, each);
    }
}

bool gis_page_add_close_up(const gis_page_model *model, const gis_page_place *place, bool after, gis_text *to,
                           gis_error *error)
{
    picture_writer writer = {model, {.width = CLOSE_UP_WIDTH, .height = CLOSE_UP_HEIGHT}, {0}, to};
    memcpy(writer.picture.window, place->window, sizeof place->window);
    begin_svg(&writer, "close-up", after ? "after" : "before");
    bool ok = add_barriers(&writer, CLOSE_UP_RIM, 0, error);
    for (int k = 0; ok && k < CLASSES; k++)
        ok = add_path(&writer, after ? classes[k].after : classes[k].before, after, add_feature, classes[k].status,
                      error);
    ok = ok && add_underpasses(&writer, error);
    ok = ok && (!after || add_moves(&writer, error));
    if (ok && after) add_links(&writer);
    if (ok && place->row) ok = add_row(&writer, place->row, after, error);
    gis_text_add(to, "</svg>\n");
    gis_corners_clear(&writer.scratch);
    return ok;
}

/* ---- The whole layer --------------------------------------------------------------------------------------------- */

/* OVERVIEW_SIDE is the longer side of a picture. Tiny features are thinned: in each square of SQUARE units
 * (LARGE_SQUARE for a layer of more than MANY features) only one is drawn, as a box, so that the picture of a large
 * layer stays small. Features in conflict and those that moved take precedence. */
enum { OVERVIEW_SIDE = 10000, OVERVIEW_RIM = 12, SQUARE = 30, LARGE_SQUARE = 80, MANY = 10000 };
enum { SQUARES = OVERVIEW_SIDE / SQUARE + 1 };

typedef struct overview_writer {
    picture_writer writer;
    double square, part; /* part: 0 before, 1 after */
    bool *taken;         /* [SQUARES][SQUARES] whether a square has a feature */
} overview_writer;

/* Draws a feature that is not larger than a square, unless its square is taken. Returns false if the feature is
 * larger. */
static bool add_tiny(overview_writer *whole, const gis_view_feature *feature)
{
    const gis_picture *picture = &whole->writer.picture;
    double box[4], at[2];
    gis_page_box(feature, whole->part, box);
    double width = gis_picture_length(picture, box[2] - box[0]), height = gis_picture_length(picture, box[3] - box[1]);
    if (fmax(width, height) > whole->square) return false;
    gis_picture_place(picture, box[0], box[3], at);
    size_t x = (size_t)fmin(SQUARES - 1, fmax(0, at[0] / whole->square));
    size_t y = (size_t)fmin(SQUARES - 1, fmax(0, at[1] / whole->square));
    if (whole->taken[y * SQUARES + x]) return true;
    whole->taken[y * SQUARES + x] = true;
    gis_text_print(whole->writer.to, "M%.0f %.0fh%.0fv%.0fh-%.0fz", at[0], at[1], fmax(1, width), fmax(1, height),
                   fmax(1, width));
    return true;
}

static bool add_for_overview(picture_writer *writer, size_t i, double part, gis_error *error)
{
    overview_writer *whole = (overview_writer *)writer; /* writer is the first member of the struct */
    const gis_view_feature *feature = &writer->model->feature[i];
    return !feature->vertices || add_tiny(whole, feature) || add_feature(writer, i, part, error);
}

static gis_picture whole_picture(const gis_page_model *model)
{
    double width = model->extent[2] - model->extent[0], height = model->extent[3] - model->extent[1];
    double size = fmax(width, height), rim = 0.02 * size;
    gis_picture picture = {{0, 0, 1, 1}, OVERVIEW_SIDE, OVERVIEW_SIDE / 2};
    if (!(size > 0) || isinf(size)) return picture;
    picture.window[0] = model->extent[0] - rim;
    picture.window[1] = model->extent[1] - rim;
    picture.window[2] = model->extent[2] + rim;
    picture.window[3] = model->extent[3] + rim;
    double longest = OVERVIEW_SIDE / (size + 2 * rim);
    picture.width = (int)fmax(1, longest * (width + 2 * rim));
    picture.height = (int)fmax(1, longest * (height + 2 * rim));
    return picture;
}

bool gis_page_add_overview(const gis_page_model *model, bool after, gis_text *to, gis_error *error)
{
    overview_writer whole = {{model, whole_picture(model), {0}, to},
                             model->n > MANY ? LARGE_SQUARE : SQUARE,
                             after,
                             calloc((size_t)SQUARES * SQUARES, sizeof(bool))};
    if (!whole.taken) return gis_no_memory(error);
    begin_svg(&whole.writer, "overview", after ? "the whole layer, after" : "the whole layer, before");
    /* the paths are made in order of precedence for the squares, and written in the order of drawing */
    gis_text paths[CLASSES] = {0};
    bool ok = add_barriers(&whole.writer, OVERVIEW_RIM, 4 * whole.square, error);
    for (int k = CLASSES - 1; ok && k >= 0; k--) {
        whole.writer.to = &paths[k];
        ok = add_path(&whole.writer, after ? classes[k].after : classes[k].before, after, add_for_overview,
                      classes[k].status, error) &&
             (gis_text_get(&paths[k]) || gis_no_memory(error));
    }
    for (int k = 0; k < CLASSES; k++) {
        if (ok) gis_text_add_bytes(to, gis_text_get(&paths[k]), paths[k].length);
        gis_text_clear(&paths[k]);
    }
    gis_text_add(to, "</svg>\n");
    gis_corners_clear(&whole.writer.scratch);
    free(whole.taken);
    return ok;
}
