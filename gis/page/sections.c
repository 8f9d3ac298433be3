/* sections.c: see sections.h; the tables are in tables.c. */
#include "page/sections.h"

#include "base/json.h"
#include "page/escape.h"
#include "page/page_words.h"
#include "page/pictures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

size_t gis_page_conflict_count(const sunder_conflict_counts *counts)
{
    return counts->overlap + counts->too_close + counts->barrier + counts->barrier_drawn + counts->barrier_near +
           counts->contained + counts->duplicate;
}

void gis_page_open_link(const double window[4], gis_text *to)
{
    char x[GIS_NUMBER_MAX], y[GIS_NUMBER_MAX], width[GIS_NUMBER_MAX];
    gis_number_text(window[0] / 2 + window[2] / 2, x);
    gis_number_text(window[1] / 2 + window[3] / 2, y);
    gis_number_text(window[2] - window[0], width);
    gis_text_print(to, "<a class=\"show\" href=\"#at=%s,%s,%s\">", x, y, width);
}

bool gis_page_title(const gis_page_model *model, const gis_thinning *thinning, gis_text *to, gis_error *error)
{
    (void)thinning, (void)error;
    gis_escape_markup(to, gis_layer_title(model->request->input));
    return true;
}

void gis_page_add_number_of(gis_text *to, size_t n, const char *one, const char *many)
{
    gis_print_count(to, n);
    gis_text_print(to, " %s", n == 1 ? one : many);
}

/* ---- Key figures ------------------------------------------------------------------------------------------------- */

static void open_figure(gis_text *to, const char *class, const char *name)
{
    gis_text_print(to, "<div class=\"figure%s\"><dt>%s</dt><dd>", class, name);
}

static void close_figure(gis_text *to, const char *detail)
{
    gis_text_print(to, "</dd>%s%s%s</div>\n", *detail ? "<dd class=\"detail\">" : "", detail, *detail ? "</dd>" : "");
}

bool gis_page_figures(const gis_page_model *model, const gis_thinning *thinning, gis_text *to, gis_error *error)
{
    (void)thinning;
    const sunder_layer_summary *summary = model->request->summary;
    size_t before = gis_page_conflict_count(&summary->before), after = gis_page_conflict_count(&summary->after);
    gis_text detail = {0};
    open_figure(to, after ? " bad" : " good", "conflicts");
    gis_print_count(to, before);
    gis_text_add(to, " <span class=\"to\">\xE2\x86\x92</span> ");
    gis_print_count(to, after);
    close_figure(to, after == 0 ? "none is left" : "are left, each with its reason");

    open_figure(to, "", "moved");
    gis_print_count(to, summary->moved);
    gis_text_add(&detail, "of ");
    gis_page_add_number_of(&detail, model->n, "feature", "features");
    if (summary->blocked_moved) {
        gis_text_add(&detail, "; besides, ");
        gis_page_add_number_of(&detail, summary->blocked_moved, "still in conflict", "still in conflict");
    }
    close_figure(to, detail.failed ? "" : gis_text_get(&detail));

    open_figure(to, "", "longest move");
    gis_print_length(to, summary->max, &model->unit);
    detail.length = 0;
    if (model->n_moved > 0) {
        gis_text_add(&detail, "mean ");
        gis_print_length(&detail, summary->mean, &model->unit);
    }
    close_figure(to, detail.failed || !detail.length ? "" : gis_text_get(&detail));

    open_figure(to, "", "of the cost could be saved, at most");
    gis_print_share_or_more(to, model->request->optimality_gap);
    detail.length = 0;
    gis_text_add(&detail, "cost ");
    gis_print_area(&detail, summary->cost, &model->unit);
    gis_text_add(&detail, ", proved bound ");
    gis_print_area_or_less(&detail, summary->lower_bound, &model->unit);
    close_figure(to, detail.failed ? "" : gis_text_get(&detail));

    open_figure(to, model->request->verified ? " good" : " bad", "verified");
    gis_text_add(to, model->request->verified ? "yes" : "no");
    close_figure(to,
                 model->request->verified ? "on the coordinates as written" : "the file was not checked completely");
    bool ok = !detail.failed || gis_no_memory(error);
    gis_text_clear(&detail);
    return ok;
}

/* ---- The map and the close-ups ----------------------------------------------------------------------------------- */

bool gis_page_legend(const gis_page_model *model, const gis_thinning *thinning, gis_text *to, gis_error *error)
{
    size_t i = 0;
    (void)thinning, (void)error;
    while (i < model->n && model->feature[i].status != SUNDER_FEATURE_HIDDEN) i++;
    if (i < model->n) gis_text_add(to, "<li><i class=\"hidden\"></i>hidden</li>\n");
    if (model->n_barriers > 0) gis_text_add(to, "<li><i class=\"barrier\"></i>barrier</li>\n");
    return true;
}

static void add_barrier_note(const gis_page_model *model, const gis_thinning *thinning, gis_text *to)
{
    if (model->n_barriers == 0) return;
    gis_text_add(to, " ");
    gis_page_add_number_of(to, model->n_barriers, "barrier lies", "barriers lie");
    gis_text_add(to, " about them");
    if (thinning->barrier_tolerance > 0) {
        gis_text_add(to, ", drawn simplified by up to ");
        gis_print_length(to, thinning->barrier_tolerance, &model->unit);
    }
    gis_text_add(to, ".");
}

bool gis_page_map_note(const gis_page_model *model, const gis_thinning *thinning, gis_text *to, gis_error *error)
{
    (void)error;
    if (model->empty) {
        gis_text_add(to, "The layer has nothing to draw.");
        return true;
    }
    if (thinning->tolerance == 0) {
        gis_page_add_number_of(to, thinning->whole, "feature is drawn", "features are drawn");
        gis_text_add(to, ", with every corner.");
        add_barrier_note(model, thinning, to);
        return true;
    }
    gis_text_add(to, "The layer is large, so the map is thinned: ");
    gis_page_add_number_of(to, thinning->whole, "feature is", "features are");
    gis_text_add(to, " drawn with every corner, those in conflict and the longest moves before all others; ");
    gis_print_count(to, thinning->simpler);
    gis_text_add(to, " others are simplified by up to ");
    gis_print_length(to, thinning->tolerance, &model->unit);
    gis_text_add(to, ", and ");
    gis_print_count(to, thinning->left_out);
    gis_text_add(to, " no larger than that are left out. Only the drawing is simplified: the separation and the proofs "
                     "are about the original features.");
    add_barrier_note(model, thinning, to);
    return true;
}

bool gis_page_add_name(const gis_page_model *model, size_t thing, gis_text *to, gis_error *error)
{
    gis_text name = {0};
    bool ok = gis_page_name(model, thing, &name, error) && (gis_text_get(&name) || gis_no_memory(error));
    if (ok) {
        gis_text_add(to, "<bdi>");
        gis_escape_markup(to, gis_text_get(&name));
        gis_text_add(to, "</bdi>");
    }
    gis_text_clear(&name);
    return ok;
}

static bool add_place_caption(const gis_page_model *model, const gis_page_place *place, gis_text *to, gis_error *error)
{
    const sunder_conflict *conflict = place->conflict;
    gis_page_open_link(place->window, to);
    bool ok = gis_page_add_name(model, place->feature, to, error);
    if (ok && conflict) {
        gis_text_add(to, " \xC2\xB7 ");
        ok = gis_page_add_name(model, conflict->b, to, error);
    }
    gis_text_add(to, "</a><span class=\"what\">");
    if (!conflict) {
        gis_text_add(to, "moved by ");
        gis_print_length(to, gis_page_length(&model->feature[place->feature]), &model->unit);
    } else {
        gis_text_print(to, "%s, ", gis_page_kind(conflict->kind));
        gis_print_length_beside(to, conflict->depth > 0 ? conflict->depth : conflict->distance, conflict->required,
                                &model->unit);
        gis_text_print(to, " %s: %s", conflict->depth > 0 ? "deep" : "apart",
                       gis_page_reason(gis_page_reason_of(conflict)));
    }
    if (place->others > 0) {
        gis_text_add(to, "; ");
        gis_print_count(to, place->others);
        gis_text_add(to, " more here");
    }
    gis_text_add(to, "</span>");
    return ok;
}

bool gis_page_add_place(const gis_page_model *model, const gis_page_place *place, gis_page_caption *caption,
                        gis_text *to, gis_error *error)
{
    gis_text_add(to, "<li><figure><div class=\"pair\">\n");
    if (!gis_page_add_close_up(model, place, false, to, error) || !gis_page_add_close_up(model, place, true, to, error))
        return false;
    gis_text_add(to, "</div><figcaption>");
    if (!caption(model, place, to, error)) return false;
    gis_text_add(to, "<span class=\"wide\">");
    gis_print_length(to, place->window[2] - place->window[0], &model->unit);
    gis_text_add(to, " wide</span></figcaption></figure></li>\n");
    return true;
}

bool gis_page_places(const gis_page_model *model, const gis_thinning *thinning, gis_text *to, gis_error *error)
{
    (void)thinning;
    if (model->n_places == 0) return true;
    gis_text_add(to,
                 "<section id=\"places\"><h2>Closer looks, the worst first</h2>\n"
                 "<p class=\"note\">Before on the left, after on the right. A name leads to its place on the map.</p>\n"
                 "<ol class=\"places\">\n");
    for (size_t k = 0; k < model->n_places; k++)
        if (!gis_page_add_place(model, &model->place[k], add_place_caption, to, error)) return false;
    gis_text_add(to, "</ol></section>\n");
    return true;
}

bool gis_page_moves(const gis_page_model *model, const gis_thinning *thinning, gis_text *to, gis_error *error)
{
    (void)thinning;
    if (model->n_moved == 0) return true;
    gis_text_add(to, "<section id=\"moves\"><h2>How far features moved</h2>\n");
    if (!gis_page_add_histogram(model, to, error)) return false;
    gis_text_add(to, "<p class=\"note\">");
    gis_page_add_number_of(to, model->n_moved, "move", "moves");
    gis_text_add(to, ", together ");
    gis_print_length(to, model->request->summary->total, &model->unit);
    gis_text_add(to, "; half of them no longer than ");
    gis_print_length(to, gis_page_length(&model->feature[model->moved[model->n_moved / 2]]), &model->unit);
    gis_text_add(to, ".</p></section>\n");
    return true;
}

/* ---- The footer -------------------------------------------------------------------------------------------------- */

bool gis_page_colophon(const gis_page_model *model, const gis_thinning *thinning, gis_text *to, gis_error *error)
{
    (void)model, (void)thinning, (void)error;
    const char *epoch = getenv("SOURCE_DATE_EPOCH");
    time_t now = epoch && *epoch ? (time_t)strtoll(epoch, NULL, 10) : time(NULL);
    struct tm day;
    char date[64] = "";
    if (gmtime_r(&now, &day)) strftime(date, sizeof date, ", %Y-%m-%d", &day);
    gis_text_print(to, "sunder %s%s. This page is one file and loads nothing from elsewhere.", sunder_version(), date);
    return true;
}
