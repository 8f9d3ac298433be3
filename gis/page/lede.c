/* lede.c: the first sentences of the page: the request as it was typed, and its result. A length appears as it was
 * typed ("0.2 mm"), followed by its value in units of the layer. */
#include "base/path.h"
#include "page/escape.h"
#include "page/sections.h"

#include <cpl_conv.h>
#include <math.h>
#include <string.h>

/* Writes a length as it was typed, with a space before the unit. A number without a unit has the unit of the layer. */
static void add_typed(const gis_page_model *model, const gis_optional_length *typed, gis_text *to)
{
    const size_t digits = strspn(typed->text, "0123456789.+-eE");
    gis_text_add_bytes(to, typed->text, digits);
    const char *unit = typed->text[digits] ? typed->text + digits : model->unit.length;
    if (*unit) gis_text_add(to, "\xC2\xA0");
    gis_escape_markup(to, unit);
}

/* Writes a length as it was typed, and its value in units of the layer if it was typed in another unit. */
static void add_length(const gis_page_model *model, const gis_optional_length *typed, double value, gis_text *to)
{
    if (!typed->text || typed->length.unit == GIS_LAYER_UNIT) {
        gis_print_length(to, value, &model->unit);
        return;
    }
    add_typed(model, typed, to);
    if (typed->length.unit == GIS_METRE && strcmp(model->unit.length, "m") == 0) return;
    gis_text_add(to, " (");
    gis_print_length(to, value, &model->unit);
    gis_text_add(to, ")");
}

/* ---- The request ------------------------------------------------------------------------------------------------- */

/* Writes a barrier: "roads where class = 'main', drawn 0.3 mm wide, with a gap of 0.1 mm" */
static void add_barrier(const gis_page_model *model, const gis_barrier_request *barrier, gis_text *to)
{
    gis_text_add(to, "<b><bdi>");
    char *stem = gis_path_stem(barrier->dataset);
    gis_escape_markup(to, barrier->layer ? barrier->layer : stem);
    CPLFree(stem);
    gis_text_add(to, "</bdi></b>");
    if (barrier->where) {
        gis_text_add(to, " where <bdi>");
        gis_escape_markup(to, barrier->where);
        gis_text_add(to, "</bdi>");
    }
    if (barrier->width.text) {
        gis_text_add(to, ", drawn ");
        add_typed(model, &barrier->width, to);
        gis_text_add(to, " wide");
    } else if (barrier->width_field) {
        gis_text_add(to, ", drawn as wide as the field <bdi>");
        gis_escape_markup(to, barrier->width_field);
        gis_text_add(to, "</bdi> says");
    }
    if (barrier->gap.text) {
        gis_text_add(to, ", with a gap of ");
        add_typed(model, &barrier->gap, to);
    }
}

static void add_barriers(const gis_page_model *model, gis_text *to)
{
    enum { MOST_NAMED = 4 };
    const gis_layer_input_request *request = model->request->input->request;
    for (size_t k = 0; k < request->barriers && k < MOST_NAMED; k++) {
        gis_text_add(to, k ? "; and from " : ". They are kept off ");
        add_barrier(model, &request->barrier[k], to);
    }
    if (request->barriers <= MOST_NAMED) return;
    gis_text_add(to, "; and from ");
    gis_page_add_number_of(to, request->barriers - MOST_NAMED, "more layer", "more layers");
}

static void add_limits(const gis_page_model *model, gis_text *to)
{
    const gis_layer_input *input = model->request->input;
    const gis_layer_rules *rules = &input->request->rules;
    if (isfinite(input->max_shift)) {
        gis_text_add(to, ". No move is longer than ");
        add_length(model, &rules->max_shift, input->max_shift, to);
    }
    if (rules->max_shift_field) {
        gis_text_add(to, isfinite(input->max_shift) ? ", or than the field <bdi>"
                                                    : ". No move is longer than the field <bdi>");
        gis_escape_markup(to, rules->max_shift_field);
        gis_text_add(to, "</bdi> says");
    }
    if (rules->fixed_where) {
        gis_text_add(to, isfinite(input->max_shift) || rules->max_shift_field ? "; what stays is <bdi>"
                                                                              : ". What stays is <bdi>");
        gis_escape_markup(to, rules->fixed_where);
        gis_text_add(to, "</bdi>");
    }
}

static void add_task(const gis_page_model *model, gis_text *to)
{
    const gis_layer_input *input = model->request->input;
    gis_page_add_number_of(to, model->n, "feature", "features");
    if (input->request->scale > 0) {
        gis_text_add(to, " for a map at 1:");
        gis_print_number(to, input->request->scale, 12);
    }
    if (input->gap > 0) {
        gis_text_add(to, ", to stand at least ");
        add_length(model, &input->request->rules.gap, input->gap, to);
        gis_text_add(to, " apart");
    } else {
        gis_text_add(to, ", not to overlap");
    }
    add_barriers(model, to);
    add_limits(model, to);
    gis_text_add(to, ". ");
}

/* ---- The result -------------------------------------------------------------------------------------------------- */

static void add_solved(size_t before, size_t after, gis_text *to)
{
    if (before == 1) {
        gis_text_add(to, after == 0 ? "The one conflict is solved" : "The one conflict remains");
    } else if (after == 0) {
        gis_text_add(to, "All ");
        gis_print_count(to, before);
        gis_text_add(to, " conflicts are solved");
    } else {
        gis_text_add(to, "Of ");
        gis_print_count(to, before);
        gis_text_add(to, " conflicts, ");
        gis_print_count(to, after);
        gis_text_add(to, after == 1 ? " remains" : " remain");
    }
}

static void add_enlarged(const gis_page_model *model, gis_text *to)
{
    const gis_layer_input *input = model->request->input;
    if (!input->request->rules.enlarge) return;
    gis_page_add_number_of(to, input->enlarged, "feature", "features");
    gis_text_add(to, input->enlarged == 1 ? " was" : " were");
    gis_text_add(to, " made larger first, so that ");
    add_length(model, &input->request->rules.min_size, input->lengths.min_size, to);
    gis_text_add(to, " fit into each. ");
}

bool gis_page_lede(const gis_page_model *model, const gis_thinning *thinning, gis_text *to, gis_error *error)
{
    (void)thinning, (void)error;
    const sunder_layer_summary *summary = model->request->summary;
    const size_t before = gis_page_conflict_count(&summary->before), after = gis_page_conflict_count(&summary->after);
    add_task(model, to);
    add_enlarged(model, to);
    if (before == 0) {
        gis_text_add(to, "There was nothing to do: no two were in conflict.");
        return true;
    }
    add_solved(before, after, to);
    if (model->n_moved > 0) {
        gis_text_add(to, "; ");
        gis_page_add_number_of(to, model->n_moved, "feature moved, by ", "features moved, by ");
        gis_print_length(to, summary->mean, &model->unit);
        gis_text_add(to, model->n_moved == 1 ? "" : " on average");
    }
    gis_text_add(to, ".");
    return true;
}
