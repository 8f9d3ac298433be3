/* hidden_section.c: the section about hidden features: how much is hidden and has to be, by class; what is hidden and
 * why; and close-ups of the most important ones. */
#include "base/interrupt.h"
#include "layer/output.h"
#include "page/escape.h"
#include "page/sections.h"
#include "sunder_hiding.h"

#include <stdlib.h>

enum { HIDDEN_ROWS = 100, HIDDEN_PLACES = 4, MOST_NAMED = 6 };

/* ---- What is hidden ---------------------------------------------------------------------------------------------- */

/* The most important class comes first, and in it the greatest weight. */
static int most_important_first(const void *left, const void *right)
{
    const gis_hidden_row *a = left, *b = right;
    if (a->cost.hierarchy != b->cost.hierarchy) return a->cost.hierarchy < b->cost.hierarchy ? -1 : 1;
    if (a->cost.weight != b->cost.weight) return a->cost.weight > b->cost.weight ? -1 : 1;
    return (a->feature > b->feature) - (a->feature < b->feature);
}

/* ---- Its sums ---------------------------------------------------------------------------------------------------- */

static void add_class(uint32_t hierarchy, gis_text *to)
{
    if (hierarchy == GIS_LAST_CLASS)
        gis_text_add(to, "the last");
    else
        gis_text_print(to, "%u", hierarchy);
}

static void add_weight(int64_t weight, gis_text *to)
{
    gis_text_print(to, "<td class=\"number\">%.6g</td>", (double)weight / GIS_HIDING_UNIT);
}

static void add_sums(const gis_page_model *model, gis_text *to)
{
    const sunder_hiding_summary hiding = model->request->hiding->sum;
    const sunder_hiding_class *class = model->request->hiding->class;
    gis_text_add(to, "<p class=\"note\">");
    gis_page_add_number_of(to, hiding.hidden, "feature is", "features are");
    gis_text_add(to, " left out, since not all can be given room. They form ");
    gis_page_add_number_of(to, hiding.components, "group", "groups");
    gis_text_add(to, "; ");
    gis_print_count(to, hiding.components_best);
    gis_text_add(to, " are proved to be the best choice.</p>\n<table class=\"counts\"><caption>What is hidden, by class"
                     "</caption><thead><tr><th scope=\"col\">class</th><th scope=\"col\">features</th>"
                     "<th scope=\"col\">weight</th><th scope=\"col\">at least</th></tr></thead><tbody>\n");
    for (size_t k = 0; k < model->request->hiding->classes; k++) {
        gis_text_add(to, "<tr><th scope=\"row\">");
        add_class(class[k].hierarchy, to);
        gis_text_print(to, "</th><td class=\"number\">%zu</td>", class[k].hidden);
        add_weight(class[k].weight, to);
        add_weight(class[k].least, to);
        gis_text_add(to, "</tr>\n");
    }
    gis_text_add(to, "</tbody></table>\n");
}

/* ---- The table, and close-ups ------------------------------------------------------------------------------------ */

static gis_page_place place_of(const gis_page_model *model, const gis_hidden_row *of)
{
    gis_page_place place = {.feature = of->feature};
    double box[4];
    gis_page_box(&model->feature[of->feature], 0, box);
    gis_page_frame(box, place.window);
    return place;
}

static bool add_things(const gis_page_model *model, const gis_hidden_row *of, gis_text *to, gis_error *error)
{
    size_t named = 0;
    for (size_t k = 0; k < of->things && named < MOST_NAMED; k++) {
        if (of->thing[k] == of->feature) continue;
        if (named++) gis_text_add(to, ", ");
        if (!gis_page_add_name(model, of->thing[k], to, error)) return false;
    }
    if (of->things > named + 1) gis_text_print(to, " and %zu more", of->things - named - 1);
    return true;
}

static bool add_row(const gis_page_model *model, const gis_hidden_row *of, gis_text *to, gis_error *error)
{
    const gis_page_place place = place_of(model, of);
    gis_text_print(to, "<tr class=\"%s\"><td>", of->proved ? "proved" : "open");
    gis_page_open_link(place.window, to);
    if (!gis_page_add_name(model, of->feature, to, error)) return false;
    gis_text_print(to, "</a></td><td data-value=\"%u\">", of->cost.hierarchy);
    add_class(of->cost.hierarchy, to);
    gis_text_add(to, "</td>");
    add_weight(of->cost.weight, to);
    gis_text_print(to, "<td>%s</td><td>", of->proved ? "proved" : "assumed");
    if (!add_things(model, of, to, error)) return false;
    gis_text_add(to, "</td></tr>\n");
    return true;
}

static bool add_caption(const gis_page_model *model, const gis_page_place *place, gis_text *to, gis_error *error)
{
    gis_page_open_link(place->window, to);
    if (!gis_page_add_name(model, place->feature, to, error)) return false;
    gis_text_add(to, "</a><span class=\"what\">hidden</span>");
    return true;
}

static bool add_table(const gis_page_model *model, const gis_hidden_row *list, size_t n, gis_text *to, gis_error *error)
{
    gis_text_add(to, "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Hidden features. Arrow keys go "
                     "through the table.\"><table class=\"sortable\"><thead><tr><th scope=\"col\">feature</th>"
                     "<th scope=\"col\">class</th><th scope=\"col\" class=\"number\">weight</th><th scope=\"col\">that "
                     "not all can stay</th><th scope=\"col\">beside</th></tr></thead><tbody>\n");
    for (size_t k = 0; k < n && k < HIDDEN_ROWS; k++)
        if (!add_row(model, &list[k], to, error)) return false;
    gis_text_add(to, "</tbody></table></div>\n");
    if (n <= HIDDEN_ROWS) return true;
    gis_text_print(to, "<p class=\"note\">The %d most important ones of %zu; all are in the layer <bdi>", HIDDEN_ROWS,
                   n);
    gis_escape_markup(to, model->request->main_layer);
    gis_text_add(to, "_hidden</bdi> of the output.</p>\n");
    return true;
}

static bool add_places(const gis_page_model *model, const gis_hidden_row *list, size_t n, gis_text *to,
                       gis_error *error)
{
    gis_text_add(to, "<ol class=\"places\">\n");
    for (size_t k = 0; k < n && k < HIDDEN_PLACES; k++) {
        const gis_page_place place = place_of(model, &list[k]);
        if (!gis_go_on(error) || !gis_page_add_place(model, &place, add_caption, to, error)) return false;
    }
    gis_text_add(to, "</ol>\n");
    return true;
}

bool gis_page_hidden(const gis_page_model *model, const gis_thinning *thinning, gis_text *to, gis_error *error)
{
    const gis_result_view *view = model->request->view;
    gis_hidden_row *list = NULL;
    size_t n = 0;
    (void)thinning;
    if (!model->request->hiding) return true;
    bool ok = view->hidden(view->of, &list, &n, error);
    if (ok && n) qsort(list, n, sizeof *list, most_important_first);
    if (ok && n) {
        gis_text_add(to, "<section id=\"hidden\"><h2>What is left out, and why</h2>\n");
        add_sums(model, to);
        ok = add_table(model, list, n, to, error) && add_places(model, list, n, to, error);
        gis_text_add(to, "</section>\n");
    }
    free(list);
    return ok;
}
