/* row_section.c: the section about rows of neighbours: how much the moves bend the rows, and close-ups of the rows with
 * the greatest bend. */
#include "base/interrupt.h"
#include "page/sections.h"

#include <stdlib.h>

enum { ROW_PLACES = 4 };

/* ---- The rows that are bent most --------------------------------------------------------------------------------- */

static double bend_of(const sunder_row *row) { return row->kink_after - row->kink_before; }

/* Rows that are bent more come first; ties keep the order of the rows. */
static int more_bent_first(const void *left, const void *right)
{
    const sunder_row *a = *(const sunder_row *const *)left, *b = *(const sunder_row *const *)right;
    const int order = (bend_of(a) < bend_of(b)) - (bend_of(a) > bend_of(b));
    return order ? order : (a > b) - (a < b);
}

/* Returns the rows with a bend above `least`, the most bent first, and sets *bent to their number. */
static const sunder_row **most_bent(const sunder_row *row, size_t n, double least, size_t *bent)
{
    const sunder_row **out = malloc((n + 1) * sizeof *out);
    *bent = 0;
    if (!out) return NULL;
    for (size_t k = 0; k < n; k++)
        if (bend_of(&row[k]) > least) out[(*bent)++] = &row[k];
    if (*bent) qsort(out, *bent, sizeof *out, more_bent_first);
    return out;
}

static gis_page_place place_of(const gis_page_model *model, const sunder_row *row)
{
    gis_page_place place = {.row = row, .feature = row->feature[0]};
    double box[4], all[4];
    gis_box_clear(all);
    for (size_t k = 0; k < row->features; k++)
        for (int after = 0; after < 2; after++) {
            gis_page_box(&model->feature[row->feature[k]], after, box);
            gis_box_join(all, box);
        }
    gis_page_frame(all, place.window);
    return place;
}

/* ---- The text ---------------------------------------------------------------------------------------------------- */

static bool add_caption(const gis_page_model *model, const gis_page_place *place, gis_text *to, gis_error *error)
{
    const sunder_row *row = place->row;
    gis_page_open_link(place->window, to);
    if (!gis_page_add_name(model, row->feature[0], to, error)) return false;
    gis_text_add(to, " to ");
    if (!gis_page_add_name(model, row->feature[row->features - 1], to, error)) return false;
    gis_text_add(to, "</a><span class=\"what\">");
    gis_page_add_number_of(to, row->bodies, "house", "houses");
    gis_text_add(to, "; greatest offset of neighbours ");
    gis_print_length(to, row->kink_before, &model->unit);
    gis_text_add(to, " before, ");
    gis_print_length(to, row->kink_after, &model->unit);
    gis_text_add(to, " after</span>");
    return true;
}

static void add_figures(const gis_page_model *model, double least, gis_text *to)
{
    const sunder_layer_summary *summary = model->request->summary;
    gis_text_add(to, "<p class=\"note\">");
    gis_page_add_number_of(to, summary->rows, "row", "rows");
    gis_text_add(to, " of neighbours with ");
    gis_page_add_number_of(to, summary->row_features, "house", "houses");
    gis_text_add(to,
                 " (a block counts as one). A kink is a move of one neighbour relative to the other at right angles "
                 "to the row. Kinks are ");
    gis_print_length(to, summary->kink_mean, &model->unit);
    gis_text_add(to, " on average, and 95\xC2\xA0% of them at most ");
    gis_print_length(to, summary->kink_p95, &model->unit);
    gis_text_add(to, "; ");
    gis_print_share_or_more(to, summary->kink_share);
    gis_text_add(to, " are above ");
    gis_print_length(to, least, &model->unit);
    gis_text_add(to, model->request->input->request->scale > 0 ? ", 0.1\xC2\xA0mm on the sheet." : ".");
    gis_text_add(to, " Their spacing along the row changes by ");
    gis_print_length(to, summary->spacing_mean, &model->unit);
    gis_text_add(to, " on average, 95\xC2\xA0% at most by ");
    gis_print_length(to, summary->spacing_p95, &model->unit);
    gis_text_print(to,
                   "; the line between their middles turns by %.2g\xC2\xB0 on average, 95\xC2\xA0%% at most by "
                   "%.2g\xC2\xB0.</p>\n",
                   summary->turn_mean, summary->turn_p95);
}

static bool add_places(const gis_page_model *model, const sunder_row **bent, size_t n, gis_text *to, gis_error *error)
{
    if (n == 0) return true;
    gis_text_add(to,
                 "<p class=\"note\">The rows that are bent most, before on the left and after on the right; the line "
                 "joins the neighbours.</p>\n<ol class=\"places\">\n");
    for (size_t k = 0; k < n && k < ROW_PLACES; k++) {
        const gis_page_place place = place_of(model, bent[k]);
        if (!gis_go_on(error) || !gis_page_add_place(model, &place, add_caption, to, error)) return false;
    }
    gis_text_add(to, "</ol>\n");
    return true;
}

bool gis_page_rows(const gis_page_model *model, const gis_thinning *thinning, gis_text *to, gis_error *error)
{
    const gis_result_view *view = model->request->view;
    const double least = gis_layer_kink(model->request->input);
    const sunder_row *row;
    size_t n, n_bent;
    (void)thinning;
    if (!view->rows(view->of, &row, &n, error)) return false;
    if (n == 0) return true;
    const sunder_row **bent = most_bent(row, n, least, &n_bent);
    if (!bent) return gis_no_memory(error);
    gis_text_add(to, "<section id=\"rows\"><h2>Rows of houses</h2>\n");
    add_figures(model, least, to);
    const bool done = add_places(model, bent, n_bent, to, error);
    gis_text_add(to, "</section>\n");
    free(bent);
    return done;
}
