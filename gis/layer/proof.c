/* proof.c: see proof.h. */
#include "layer/proof.h"
#include "layer/gap_rules.h"
#include "layer/levels.h"

#include "layer/output.h"

#include <stdlib.h>

/* How the proof identifies a feature: by its FID or, if FIDs are not unique, by its place in the input. */
static int64_t call_feature(const void *of, size_t feature)
{
    const gis_layer_input *input = of;
    return gis_source_fids_unique(input->source) ? gis_source_fid(input->source, feature) : (int64_t)feature;
}

static int64_t call_barrier(const void *of, size_t thing, const char **layer)
{
    const gis_barrier_feature *barrier = gis_barrier_of(of, thing);
    *layer = gis_barrier_layer(of, barrier);
    return barrier->fid;
}

static const sunder_feature *demands_of(const void *of, size_t feature)
{
    return &((const gis_layer_input *)of)->feature[feature];
}

static uint32_t class_of(const void *of, size_t thing)
{
    const gis_layer_input *input = of;
    if (thing < input->n) return input->gap_class[thing];
    return gis_class_gaps_of_barrier(input->request->rules.classes, gis_barrier_of(input, thing)->request);
}

static gis_proof_gaps gaps_of(const gis_layer_input *input)
{
    const gis_gap_classes *classes = input->request->rules.classes;
    const gis_class_tables *tables = &input->class_tables;
    if (!classes) return (gis_proof_gaps){0};
    return (gis_proof_gaps){classes->classes, classes->name, tables->slack ? tables->gap : NULL, tables->full};
}

gis_proof_head gis_proof_head_of(const gis_layer_input *input, const sunder_layer_summary *summary)
{
    return (gis_proof_head){.layer = gis_source_name(input->source),
                            .sheet = input->request->sheet,
                            .how = gis_layer_core_options(input),
                            .max_shift = input->max_shift,
                            .gaps = gaps_of(input),
                            .summary = summary};
}

static void count_hiding(const gis_proof_lines *lines, const gis_layer_input *input, const gis_proof_choices *choices,
                         gis_proof_head *head)
{
    sunder_hiding_summary hiding;
    sunder_report_hiding(lines->report, &hiding);
    head->hide = true;
    head->hidden = hiding.hidden;
    head->enlarge = input->request->rules.enlarge;
    head->larger = input->enlarged;
    const gis_levels *levels = &input->levels;
    for (size_t k = 0; k < levels->features * levels->rungs; k++)
        head->shapes += levels->shape[k] && choices->told[k / levels->rungs];
    head->clauses = choices->clauses;
    head->choices = choices->trees;
    head->class = sunder_report_hiding_classes(lines->report, &head->classes);
}

static bool put_head(gis_proof_lines *lines, const gis_layer_input *input, const gis_proof_choices *choices, FILE *to,
                     gis_error *error)
{
    sunder_layer_summary summary;
    sunder_report_summary(lines->report, &summary);
    gis_proof_head head = gis_proof_head_of(input, &summary);
    sunder_report_conflicts(lines->report, &head.conflicts);
    sunder_report_bound_trees(lines->report, &head.trees);
    if (input->request->rules.hide || gis_levels_asked(&input->request->rules))
        count_hiding(lines, input, choices, &head);
    gis_proof_head_line(&lines->json, &head);
    return gis_proof_print(&lines->json, to, error);
}

static bool put_blocks(gis_proof_lines *lines, FILE *to, gis_error *error)
{
    const size_t n = lines->things.n;
    bool done = true;
    for (size_t first = 0; first < n && done; first++) {
        if (sunder_report_block(lines->report, first) != (int64_t)first) continue;
        gis_proof_block_begins(&lines->json);
        for (size_t i = lines->first[first]; i < n; i = lines->next[i])
            gis_json_signed(&lines->json, call_feature(lines->things.of, i));
        gis_proof_block_ends(&lines->json);
        done = gis_proof_print(&lines->json, to, error);
    }
    return done;
}

/* Writes the line that was made, preceded by its number. */
static bool put_line(gis_proof_lines *lines, const char *key, size_t number, gis_json *line, FILE *to, gis_error *error)
{
    const char *rest = gis_json_text(&lines->json);
    if (!rest) return gis_no_memory(error);
    gis_proof_line(line, key, number, rest);
    gis_text_empty(&lines->json.text);
    lines->json.need_comma = false;
    return gis_proof_print(line, to, error);
}

/* Writes a line for each hidden feature. */
static bool put_hidden(gis_proof_lines *lines, FILE *to, gis_error *error)
{
    bool done = true;
    size_t k = 0;
    for (size_t i = 0; i < lines->things.n && done; i++) {
        if (sunder_report_status(lines->report, i) != SUNDER_FEATURE_HIDDEN) continue;
        gis_proof_hidden_line(&lines->json, k++, call_feature(lines->things.of, i));
        done = gis_proof_print(&lines->json, to, error);
    }
    return done;
}

/* Writes a line for each larger shape. */
static bool put_larger(gis_proof_lines *lines, const gis_layer_input *input, gis_json *line, FILE *to, gis_error *error)
{
    bool done = true;
    size_t k = 0;
    for (size_t i = 0; i < input->n && input->given && done; i++) {
        if (!input->given[i]) continue;
        gis_proof_larger(lines, i, input->shape[i]);
        done = put_line(lines, "larger", k++, line, to, error);
    }
    return done;
}

/* Writes a line for each smaller shape of the features that clauses name, and of their blocks. */
static bool put_shapes(gis_proof_lines *lines, const gis_layer_input *input, const bool *told, gis_json *line, FILE *to,
                       gis_error *error)
{
    bool done = true;
    size_t k = 0;
    const gis_levels *levels = &input->levels;
    for (size_t i = 0; i < levels->features; i++) {
        size_t level = 0;
        if (!told[i]) continue;
        for (size_t rung = 0; rung < levels->rungs && done; rung++) {
            const sunder_shape *shape = gis_levels_shape(levels, i, rung);
            if (!shape) continue;
            gis_proof_shape(lines, i, ++level, rung, shape);
            done = put_line(lines, "shape", k++, line, to, error);
        }
    }
    return done;
}

/* Writes the proved clauses, and the trees of the bound of what is hidden. */
static bool put_choices(gis_proof_lines *lines, const gis_proof_choices *choices, gis_json *line, FILE *to,
                        gis_error *error)
{
    size_t n;
    const sunder_clause *clause = sunder_report_clauses(lines->report, &n);
    size_t *number = malloc((n + 1) * sizeof *number);
    bool done = number || gis_no_memory(error);
    for (size_t k = 0; k < choices->clauses && done; k++) {
        number[choices->clause[k].tree] = k;
        gis_proof_clause(lines, &clause[choices->clause[k].tree]);
        done = put_line(lines, "clause", k, line, to, error);
    }
    for (size_t k = 0; k < choices->trees && done; k++) {
        gis_proof_choice(lines, choices->tree[k].tree, number, false);
        done = put_line(lines, "choice", k, line, to, error);
    }
    free(number);
    return done;
}

static bool put_row(gis_proof_lines *lines, size_t number, const sunder_row_pair *pair, FILE *to, gis_error *error)
{
    int64_t name[2];
    for (int c = 0; c < 2; c++) name[c] = call_feature(lines->things.of, pair->feature[c]);
    gis_proof_row_line(&lines->json, number, name, pair);
    return gis_proof_print(&lines->json, to, error);
}

/* Writes the neighbours in rows, those with a hidden end last. */
static bool put_rows(gis_proof_lines *lines, FILE *to, gis_error *error)
{
    size_t n, hidden;
    const sunder_row_pair *pair = sunder_report_row_pairs(lines->report, &n);
    const sunder_row_pair *with_hidden = sunder_report_hidden_row_pairs(lines->report, &hidden);
    bool done = true;
    for (size_t k = 0; k < n && done; k++) done = put_row(lines, k, &pair[k], to, error);
    for (size_t k = 0; k < hidden && done; k++) done = put_row(lines, n + k, &with_hidden[k], to, error);
    return done;
}

static bool put_conflicts(gis_proof_lines *lines, gis_json *line, FILE *to, gis_error *error)
{
    size_t n;
    bool done = true;
    sunder_report_conflicts(lines->report, &n);
    for (size_t k = 0; k < n && done; k++) {
        gis_proof_conflict(lines, k);
        done = put_line(lines, "conflict", k, line, to, error);
    }
    return done;
}

static int by_place(const void *a, const void *b)
{
    const gis_proof_place *p = a, *q = b;
    if (p->first != q->first) return p->first < q->first ? -1 : 1;
    return (p->among > q->among) - (p->among < q->among);
}

static bool put_trees(gis_proof_lines *lines, gis_json *line, FILE *to, gis_error *error)
{
    gis_proof_place *place = NULL;
    size_t n, group = 0;
    const sunder_bound_tree *tree = sunder_report_bound_trees(lines->report, &n);
    bool done = gis_proof_order(lines, &place, &n, error);
    if (done && n) qsort(place, n, sizeof *place, by_place);
    for (size_t k = 0; k < n && done; k++) {
        group += k > 0 && place[k].first != place[k - 1].first;
        done = gis_proof_tree(lines, &tree[place[k].tree], error) && put_line(lines, "group", group, line, to, error);
    }
    free(place);
    return done;
}

bool gis_proof_write(const gis_layer_input *input, const sunder_report *report, FILE *to, gis_error *error)
{
    const gis_proof_things things = {input,        input->n,   call_feature,
                                     call_barrier, demands_of, input->gap_class ? class_of : NULL};
    gis_proof_lines lines;
    gis_proof_choices choices = {0};
    gis_json line = {0};
    const bool done = gis_proof_lines_begin(&lines, &things, report, error) &&
                      gis_proof_choices_make(&lines, &choices, error) && put_head(&lines, input, &choices, to, error) &&
                      put_blocks(&lines, to, error) && put_larger(&lines, input, &line, to, error) &&
                      put_hidden(&lines, to, error) && put_shapes(&lines, input, choices.told, &line, to, error) &&
                      put_rows(&lines, to, error) && put_conflicts(&lines, &line, to, error) &&
                      put_trees(&lines, &line, to, error) && put_choices(&lines, &choices, &line, to, error);
    gis_proof_lines_clear(&lines);
    gis_proof_choices_clear(&choices);
    gis_json_clear(&line);
    return done;
}
