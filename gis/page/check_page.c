/* check_page.c: see check_page.h. A finding is as bad as the share of the required length that is missing; for areas
 * that of the root, so that both are shares of a length. */
#include "page/check_page.h"

#include "page/escape.h"
#include "page/number.h"
#include "page/page_words.h"
#include "page/sections.h"

#include <math.h>
#include <stdlib.h>

/* Rows on the page, and corners of a shape that is drawn: the output layer has the rest. */
enum { MOST_ROWS = 1000, MOST_CORNERS = 5000 };
/* A picture has this many units on each side. */
#define SIDE 1200

typedef struct page_row {
    const gis_layer_input *input; /* whose features and barriers these are: the layer, or the original of --before */
    const char *kind;
    size_t a, b; /* features; from the number of features on a barrier; SIZE_MAX: none */
    double has, required, share;
    double from[2], to[2];
    size_t order;
    bool area;
    bool broken, measured; /* a broken rule; it has lengths */
} page_row;

static int by_share(const void *a, const void *b)
{
    const page_row *p = a, *q = b;
    if (p->broken != q->broken) return p->broken ? -1 : 1;
    if (p->share != q->share) return p->share < q->share ? -1 : 1;
    return p->order < q->order ? -1 : p->order > q->order;
}

static const char *word_of(sunder_illegible_kind kind)
{
    static const char *const word[SUNDER_ILLEGIBLE_KINDS] = {"too narrow", "too small", "neck", "gap within",
                                                             "short edge"};
    return word[kind];
}

static page_row row_of(const gis_layer_input *input, const sunder_conflict *c, const char *kind, size_t order)
{
    return (page_row){.input = input,
                      .kind = kind,
                      .a = c->a,
                      .b = c->b,
                      .has = c->distance,
                      .required = c->required,
                      .from = {c->from[0], c->from[1]},
                      .to = {c->to[0], c->to[1]},
                      .order = order,
                      .measured = true};
}

static page_row row_of_move(const gis_moves *moves, size_t k)
{
    bool lost, drawn;
    const sunder_conflict c = gis_moves_finding(moves, k, &lost, &drawn);
    page_row row = row_of(&moves->original, &c, lost ? "lost" : gis_page_kind(c.kind), k);
    row.broken = true;
    row.measured = drawn && isfinite(c.distance) && isfinite(c.required) && (c.distance != 0 || c.required != 0);
    return row;
}

static page_row row_of_size(const gis_layer_input *input, const gis_legible *legible, size_t k, size_t order)
{
    const sunder_illegible *is = &legible->item[k].is;
    return (page_row){.input = input,
                      .kind = word_of(is->kind),
                      .a = legible->item[k].feature,
                      .b = SIZE_MAX,
                      .has = is->has,
                      .required = is->required,
                      .from = {is->from[0], is->from[1]},
                      .to = {is->to[0], is->to[1]},
                      .order = order,
                      .area = is->kind == SUNDER_ILLEGIBLE_SMALL,
                      .measured = true};
}

/* Returns the rows, the worst first, which the caller frees; NULL if out of memory. */
static page_row *collect_rows(const gis_findings *found, size_t *n)
{
    size_t conflicts;
    const sunder_conflict *c = sunder_report_conflicts(found->report, &conflicts);
    const size_t moves = gis_moves_rows(found->moves);
    page_row *row = calloc(conflicts + moves + found->legible->n + 1, sizeof *row);
    *n = 0;
    for (size_t k = 0; row && k < conflicts; k++, c++)
        if (!c->inside_block) row[(*n)++] = row_of(found->input, c, gis_page_kind(c->kind), k);
    for (size_t k = 0; row && k < moves; k++) row[(*n)++] = row_of_move(found->moves, k);
    for (size_t k = 0; row && k < found->legible->n; k++)
        row[(*n)++] = row_of_size(found->input, found->legible, k, conflicts + k);
    for (size_t k = 0; row && k < *n; k++) {
        const double share = row[k].required > 0 && row[k].measured ? row[k].has / row[k].required : 0;
        row[k].share = row[k].area ? sqrt(share) : row[k].broken ? 0 : share;
    }
    if (row) qsort(row, *n, sizeof *row, by_share);
    return row;
}

/* ---- Pictures ---------------------------------------------------------------------------------------------------- */

/* The square of the plane that a picture shows. */
typedef struct window {
    double middle[2], half;
} window;

static window window_of(const page_row *row)
{
    const double length = hypot(row->to[0] - row->from[0], row->to[1] - row->from[1]);
    const double least = row->area ? 0 : 2 * row->required;
    const double half = fmax(fmax(0.8 * length, least), 1e-9 * (fabs(row->from[0]) + fabs(row->from[1])));
    return (window){{row->from[0] / 2 + row->to[0] / 2, row->from[1] / 2 + row->to[1] / 2}, half > 0 ? half : 1};
}

/* Adds a point in units of the picture; those far outside are drawn at its surroundings. */
static void add_point(const window *w, const double *xy, gis_text *to)
{
    const double limit = 50 * SIDE;
    const double x = SIDE / 2.0 * (1 + (xy[0] - w->middle[0]) / w->half);
    const double y = SIDE / 2.0 * (1 - (xy[1] - w->middle[1]) / w->half);
    gis_text_print(to, "%ld %ld", lround(fmax(-limit, fmin(limit, x))), lround(fmax(-limit, fmin(limit, y))));
}

static void add_shape(const window *w, const sunder_shape *shape, gis_text *to)
{
    if (!shape || sunder_shape_vertices(shape) > MOST_CORNERS) return;
    gis_text_add(to, "<path class=\"shape\" d=\"");
    for (size_t p = 0; p < sunder_shape_polygons(shape); p++)
        for (size_t r = 0; r < sunder_shape_rings(shape, p); r++) {
            size_t n;
            const double *xy = sunder_shape_ring(shape, p, r, &n);
            for (size_t k = 0; k < n; k++) {
                gis_text_add(to, k ? "L" : "M");
                add_point(w, xy + 2 * k, to);
            }
            gis_text_add(to, "Z");
        }
    gis_text_add(to, "\"/>");
}

static void add_picture(const page_row *row, gis_text *to)
{
    const gis_layer_input *input = row->input;
    const window w = window_of(row);
    gis_text_print(to, "<svg viewBox=\"0 0 %d %d\" role=\"img\">", SIDE, SIDE);
    add_shape(&w, gis_layer_original(input, row->a), to);
    if (row->b < input->n) add_shape(&w, gis_layer_original(input, row->b), to);
    gis_text_add(to, "<path class=\"link\" d=\"M");
    add_point(&w, row->from, to);
    gis_text_add(to, "L");
    add_point(&w, row->to, to);
    gis_text_add(to, "\"/></svg>");
}

/* ---- The table --------------------------------------------------------------------------------------------------- */

static void add_thing(const gis_layer_input *input, size_t thing, gis_text *to)
{
    char name[256];
    const gis_barrier_feature *barrier = gis_barrier_of(input, thing);
    if (barrier) {
        gis_escape_markup(to, gis_barrier_layer(input, barrier));
        gis_text_print(to, " " CPL_FRMT_GIB, barrier->fid);
    } else if (thing < input->n) {
        gis_feature_name(input, thing, name, sizeof name);
        gis_escape_markup(to, name);
    }
}

static void add_row(const page_row *row, gis_text *to)
{
    const gis_layer_input *input = row->input;
    const gis_page_unit unit = gis_page_unit_of(input->units.unit_metres == 1 ? "metre" : "");
    const double size[2] = {row->has, row->required};
    gis_text_add(to, "<tr><td>");
    add_picture(row, to);
    gis_text_print(to, "</td><td>%s</td><td>", row->kind);
    add_thing(input, row->a, to);
    if (row->b != SIZE_MAX) gis_text_add(to, "<br>");
    add_thing(input, row->b, to);
    for (int k = 0; k < 2; k++) {
        gis_text_add(to, "</td><td class=\"number\">");
        if (!row->measured) continue;
        if (row->area)
            gis_print_area(to, size[k], &unit);
        else
            gis_print_length_beside(to, size[k], size[!k], &unit);
    }
    gis_text_add(to, "</td></tr>\n");
}

static const char head[] =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n"
    "<style>body{font:16px/1.4 sans-serif;margin:2em auto;max-width:60em;padding:0 1em}table{border-collapse:collapse}"
    "th,td{border-bottom:1px solid #ccc;padding:.4em .8em;text-align:left;vertical-align:middle}"
    ".number{text-align:right}svg{width:120px;height:120px;background:#f4f4f1}"
    ".shape{fill:#c9c5b8;stroke:#555;stroke-width:8;fill-rule:evenodd}"
    ".link{stroke:#c2185b;stroke-width:24;stroke-linecap:round}</style>\n<title>";

bool gis_check_page_write(const gis_findings *found, gis_text *to, gis_error *error)
{
    const gis_layer_input *input = found->input;
    size_t n;
    page_row *row = collect_rows(found, &n);
    if (!row) return gis_no_memory(error);
    gis_text_add(to, head);
    gis_escape_markup(to, gis_layer_title(input));
    gis_text_add(to, ": what check found</title></head><body>\n<h1>");
    gis_escape_markup(to, gis_layer_title(input));
    gis_text_add(to, "</h1>\n<p>");
    gis_print_count(to, n);
    gis_text_add(to, n == 1 ? " finding in " : " findings in ");
    gis_print_count(to, input->n);
    gis_text_print(to, " features, the worst first: %sthat with the least share of what is required.",
                   found->moves->report ? "rules that were broken since the original, then " : "");
    if (n > MOST_ROWS) gis_text_print(to, " The first %d are shown; the output layer has all.", MOST_ROWS);
    gis_text_add(to, "</p>\n<table><thead><tr><th></th><th>kind</th><th>features</th><th>has</th><th>required</th></tr>"
                     "</thead><tbody>\n");
    for (size_t k = 0; k < n && k < MOST_ROWS; k++) add_row(&row[k], to);
    gis_text_add(to, "</tbody></table>\n");
    const bool ok = gis_page_add_sheet(input->request->sheet, to, error);
    gis_text_add(to, "</body></html>\n");
    free(row);
    return ok && (gis_text_get(to) || gis_no_memory(error));
}
