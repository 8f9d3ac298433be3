/* tables.c: the tables of the page: the remaining conflicts, and the certificate. The attribute data-value of a cell
 * has the number by which the table is sorted; cells with unknown values lack it and are sorted last. */
#include "base/json.h"
#include "page/escape.h"
#include "page/page_words.h"
#include "page/sections.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The largest number of rows of conflicts on the screen, so that the page has few nodes; and on paper, about two
 * sheets: the style sheet hides the others there. */
enum { MOST_ROWS = 100, MOST_ON_PAPER = 30 };

static void open_number(gis_text *to, double value)
{
    char text[GIS_NUMBER_MAX];
    gis_number_text(value, text);
    if (isfinite(value))
        gis_text_print(to, "<td class=\"number\" data-value=\"%s\">", text);
    else
        gis_text_add(to, "<td class=\"number\">");
}

static void add_length_cell(const gis_page_model *model, double value, gis_text *to)
{
    open_number(to, value);
    gis_print_length(to, value, &model->unit);
    gis_text_add(to, "</td>");
}

/* ---- Conflicts --------------------------------------------------------------------------------------------------- */

/* Writes a cell with the names of up to MOST_NAMED features that block the pair, and the number of the others. */
static bool add_blockers(const gis_page_model *model, const sunder_conflict *conflict, gis_text *to, gis_error *error)
{
    enum { MOST_NAMED = 6 };
    size_t n = conflict->n_blocked_by;
    gis_text_print(to, "<td data-value=\"%zu\">", n);
    for (size_t k = 0; k < n && k < MOST_NAMED; k++) {
        if (k) gis_text_add(to, ", ");
        if (!gis_page_add_name(model, conflict->blocked_by[k], to, error)) return false;
    }
    if (n > MOST_NAMED) gis_text_print(to, " and %zu more", n - MOST_NAMED);
    gis_text_add(to, n ? "</td>" : "\xE2\x80\x93</td>");
    return true;
}

/* Writes a cell with the changes of the request for which a solution of the conflict is known. */
static bool add_needs(const gis_page_model *model, const sunder_conflict *conflict, gis_text *to, gis_error *error)
{
    const char *separator = "";
    gis_text_add(to, "<td>");
    if (!isnan(conflict->need_shift)) {
        gis_text_add(to, "moves of up to ");
        gis_print_length_or_more(to, conflict->need_shift, &model->unit);
        separator = "; or ";
    }
    if (!isnan(conflict->need_gap)) {
        gis_text_print(to, "%sa gap of ", separator);
        gis_print_length_or_less(to, conflict->need_gap, &model->unit);
        separator = "; or ";
    }
    if (conflict->need_gone != SIZE_MAX) {
        gis_text_print(to, "%swithout ", separator);
        if (!gis_page_add_name(model, conflict->need_gone, to, error)) return false;
        separator = "; or ";
    }
    gis_text_add(to, *separator ? "</td>" : "\xE2\x80\x93</td>");
    return true;
}

static void conflict_link(const gis_page_model *model, const sunder_conflict *conflict, gis_text *to)
{
    double length = hypot(conflict->to[0] - conflict->from[0], conflict->to[1] - conflict->from[1]), box[4];
    gis_page_box(&model->feature[conflict->a], 1, box);
    double reach = fmax(6 * fmax(length, conflict->required), fmin(box[2] - box[0], box[3] - box[1]) * 2);
    double x = conflict->from[0] / 2 + conflict->to[0] / 2, y = conflict->from[1] / 2 + conflict->to[1] / 2;
    const double window[4] = {x - reach, y - reach, x + reach, y + reach};
    gis_page_open_link(window, to);
}

static bool add_row(const gis_page_model *model, const sunder_conflict *conflict, gis_text *to, gis_error *error)
{
    const size_t reason = gis_page_reason_of(conflict);
    gis_text_print(to, "<tr class=\"%s\"><td>", gis_page_is_proved(conflict) ? "proved" : "open");
    conflict_link(model, conflict, to);
    if (!gis_page_add_name(model, conflict->a, to, error)) return false;
    gis_text_add(to, "</a></td><td>");
    if (!gis_page_add_name(model, conflict->b, to, error)) return false;
    gis_text_print(to, "</td><td>%s</td><td title=\"%s\">%s</td>", gis_page_kind(conflict->kind),
                   gis_page_explanation(reason), gis_page_reason(reason));
    open_number(to, conflict->distance);
    gis_print_length_beside(to, conflict->distance, conflict->required, &model->unit);
    gis_text_add(to, "</td>");
    add_length_cell(model, conflict->depth, to);
    add_length_cell(model, conflict->required, to);
    add_length_cell(model, conflict->missing, to);
    if (!add_blockers(model, conflict, to, error) || !add_needs(model, conflict, to, error)) return false;
    gis_text_add(to, "</tr>\n");
    return true;
}

/* Writes the reasons that occur, their numbers and explanations. */
static void add_reasons(const gis_page_model *model, gis_text *to)
{
    gis_text_add(to, "<dl class=\"reasons\">\n");
    for (size_t reason = 0; reason < gis_page_reasons(); reason++) {
        size_t n = 0;
        for (size_t k = 0; k < model->n_conflicts; k++) n += gis_page_reason_of(model->conflict[k]) == reason;
        if (!n) continue;
        gis_text_print(to, "<div><dt>%s</dt><dd><span class=\"number\">", gis_page_reason(reason));
        gis_print_count(to, n);
        gis_text_print(to, "</span> %s</dd></div>\n", gis_page_explanation(reason));
    }
    gis_text_add(to, "</dl>\n");
}

/* Writes how many conflicts there are, if only `shown` of them are listed. */
static void add_rest(const gis_page_model *model, size_t shown, const char *class, gis_text *to)
{
    if (model->n_conflicts <= shown) return;
    gis_text_print(to, "<p class=\"note %s\">The worst %zu of ", class, shown);
    gis_print_count(to, model->n_conflicts);
    gis_text_add(to, "; all are in the layer <bdi>");
    gis_escape_markup(to, model->request->main_layer);
    gis_text_add(to, "_conflicts</bdi> of the output.</p>\n");
}

bool gis_page_blocked(const gis_page_model *model, const gis_thinning *thinning, gis_text *to, gis_error *error)
{
    static const struct {
        const char *words, *class;
    } heads[] = {{"feature", ""},        {"and", ""},
                 {"kind", ""},           {"reason", ""},
                 {"distance", "number"}, {"depth", "number"},
                 {"required", "number"}, {"missing", "number"},
                 {"in the way", ""},     {"would be free with", ""}};
    (void)thinning;
    if (model->n_conflicts == 0) return true;
    gis_text_add(to, "<section id=\"blocked\"><h2>What is blocked, and why</h2>\n");
    add_reasons(model, to);
    gis_text_add(to, "<div class=\"scroll\" tabindex=\"0\" role=\"region\" "
                     "aria-label=\"Conflicts that remain. Arrow keys go through the table.\">"
                     "<table class=\"sortable\"><thead><tr>");
    for (size_t k = 0; k < sizeof heads / sizeof *heads; k++)
        gis_text_print(to, "<th scope=\"col\" class=\"%s\">%s</th>", heads[k].class, heads[k].words);
    gis_text_add(to, "</tr></thead><tbody>\n");
    bool ok = true;
    for (size_t k = 0; ok && k < model->n_conflicts && k < MOST_ROWS; k++)
        ok = add_row(model, model->conflict[k], to, error);
    gis_text_add(to, "</tbody></table></div>\n");
    add_rest(model, MOST_ROWS, "on-screen", to);
    add_rest(model, MOST_ON_PAPER, "on-paper", to);
    gis_text_add(to, "</section>\n");
    return ok;
}

/* ---- The certificate --------------------------------------------------------------------------------------------- */

static void add_counts(const gis_page_model *model, gis_text *to)
{
    const sunder_conflict_counts *before = &model->request->summary->before, *after = &model->request->summary->after;
    const struct {
        const char *name;
        size_t before, after;
    } rows[] = {{gis_page_kind(SUNDER_CONFLICT_OVERLAP), before->overlap, after->overlap},
                {gis_page_kind(SUNDER_CONFLICT_TOO_CLOSE), before->too_close, after->too_close},
                {gis_page_kind(SUNDER_CONFLICT_BARRIER), before->barrier, after->barrier},
                {gis_page_kind(SUNDER_CONFLICT_BARRIER_DRAWN), before->barrier_drawn, after->barrier_drawn},
                {gis_page_kind(SUNDER_CONFLICT_BARRIER_NEAR), before->barrier_near, after->barrier_near},
                {gis_page_kind(SUNDER_CONFLICT_CONTAINED), before->contained, after->contained},
                {gis_page_kind(SUNDER_CONFLICT_DUPLICATE), before->duplicate, after->duplicate},
                {"within blocks", before->inside_blocks, after->inside_blocks}};
    gis_text_add(to, "<table class=\"counts\"><caption>Pairs in conflict</caption><thead><tr><td></td>"
                     "<th scope=\"col\">before</th><th scope=\"col\">after</th></tr></thead><tbody>\n");
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        gis_text_print(to, "<tr><th scope=\"row\">%s</th><td class=\"number\">", rows[k].name);
        gis_print_count(to, rows[k].before);
        gis_text_add(to, "</td><td class=\"number\">");
        gis_print_count(to, rows[k].after);
        gis_text_add(to, "</td></tr>\n");
    }
    gis_text_add(to, "</tbody></table>\n");
    const size_t tight = model->request->summary->tight;
    if (tight == 0) return;
    gis_text_add(to, "<p class=\"note\">");
    gis_print_count(to, tight);
    gis_text_print(to, " more %s tight: between the least gap and the gap.</p>\n",
                   tight == 1 ? "pair is" : "pairs are");
}

static void open_term(gis_text *to, const char *name) { gis_text_print(to, "<div><dt>%s</dt><dd>", name); }
static void close_term(gis_text *to) { gis_text_add(to, "</dd></div>\n"); }

/* Writes the times of the stages, as in --stats; not with SOURCE_DATE_EPOCH, for which the page must be
 * reproducible. */
static void add_seconds(const gis_page_request *request, gis_text *to)
{
    const char *epoch = getenv("SOURCE_DATE_EPOCH");
    const struct {
        const char *stage;
        double seconds;
    } stages[] = {{"read", request->seconds_read},
                  {"solve", request->summary->seconds_solve},
                  {"explain", request->summary->seconds_explain},
                  {"verify", request->summary->seconds_verify},
                  {"write", request->seconds_write}};
    if (epoch && *epoch) return;
    open_term(to, "seconds");
    for (size_t k = 0; k < sizeof stages / sizeof *stages; k++) {
        gis_text_print(to, "%s%s ", k ? ", " : "", stages[k].stage);
        gis_print_number(to, stages[k].seconds, 2);
    }
    close_term(to);
}

static void add_proof(const gis_page_model *model, gis_text *to)
{
    const gis_page_request *request = model->request;
    const sunder_layer_summary *summary = request->summary;
    const gis_layer_rules *rules = &request->input->request->rules;
    gis_text_add(to, "<dl class=\"terms\">\n");
    open_term(to, "cost");
    gis_print_area(to, summary->cost, &model->unit);
    gis_text_print(to, " <span class=\"aside\">the sum of squared moves%s",
                   rules->weighting != GIS_WEIGHTING_EVEN || rules->weight_field ? ", each by its weight" : "");
    if (summary->rows) {
        gis_text_add(to, " (");
        gis_print_area(to, summary->cost_moves, &model->unit);
        gis_text_add(to, "), and of the springs of rows (");
        gis_print_area(to, summary->cost_rows, &model->unit);
        gis_text_add(to, ")");
    }
    gis_text_add(to, "</span>");
    close_term(to);
    open_term(to, "proved lower bound");
    gis_print_area_or_less(to, summary->lower_bound, &model->unit);
    gis_text_add(
        to,
        " <span class=\"aside\">any layout that solves the same pairs, and makes no remaining conflict worse, costs "
        "at least this much</span>");
    close_term(to);
    open_term(to, "optimality gap");
    gis_print_share_or_more(to, request->optimality_gap);
    close_term(to);
    open_term(to, "groups");
    gis_print_count(to, summary->clusters);
    gis_text_add(to, " <span class=\"aside\">of features that had to be placed together</span>");
    close_term(to);
    open_term(to, "proved optimal");
    gis_print_count(to, summary->clusters_optimal);
    gis_text_add(to, " <span class=\"aside\">of the groups: no layout costs less</span>");
    close_term(to);
    open_term(to, "verified");
    gis_text_print(to, "%s <span class=\"aside\">%s</span>", request->verified ? "yes" : "no",
                   request->verified ? "every pair not listed was checked exactly, on the coordinates as written"
                                     : "not all coordinates were checked as written");
    close_term(to);
    open_term(to, "blocks");
    gis_print_count(to, summary->blocks);
    gis_text_add(to, " <span class=\"aside\">features that touch and move as one</span>");
    close_term(to);
    open_term(to, "left aside");
    gis_print_count(to, summary->skipped);
    gis_text_add(to, " <span class=\"aside\">ignored, without geometry, or of another kind</span>");
    close_term(to);
    add_seconds(request, to);
    for (size_t k = 0; k < request->losses->n; k++) {
        open_term(to, "loss");
        gis_escape_markup(to, request->losses->items[k]);
        close_term(to);
    }
    gis_text_add(to, "</dl>\n");
}

static void add_call(const gis_page_model *model, gis_text *to)
{
    const gis_page_request *request = model->request;
    gis_text_add(to, "<dl class=\"terms call\">\n");
    open_term(to, "input");
    gis_escape_markup(to, gis_source_path(request->input->source));
    for (size_t k = 1; k < request->input->parts; k++) {
        gis_text_add(to, ", ");
        gis_escape_markup(to, gis_source_path(request->input->part[k].source));
    }
    close_term(to);
    open_term(to, "output");
    gis_escape_markup(to, request->output);
    close_term(to);
    for (size_t k = 0; k < request->n_options; k++) {
        gis_text_print(to, "<div><dt><code>%s</code></dt><dd>", request->options[k].name);
        gis_escape_markup(to, request->options[k].value);
        close_term(to);
    }
    gis_text_add(to, "</dl>\n");
}

bool gis_page_certificate(const gis_page_model *model, const gis_thinning *thinning, gis_text *to, gis_error *error)
{
    (void)thinning, (void)error;
    gis_text_add(to, "<div class=\"columns\"><div>");
    add_proof(model, to);
    gis_text_add(to, "</div><div>");
    add_counts(model, to);
    gis_text_add(to, "</div></div>\n<h3>The run</h3>\n");
    add_call(model, to);
    return true;
}
