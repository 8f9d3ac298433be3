/* run_proof_hiding.c: see run_proof.h. */
#include "shards/run/run_proof.h"

#include <stdlib.h>
#include <string.h>

static int64_t name_larger(const void *of, size_t feature)
{
    (void)feature;
    return *(const int64_t *)of;
}

/* Writes a line for each larger shape. */
bool gis_run_proof_larger(gis_shard_run *p, gis_json *json, FILE *to, gis_error *error)
{
    gis_sorted_results *larger = &p->joined.larger;
    gis_proof_lines lines = {0};
    bool any = p->request->rules.enlarge, done = true;
    if (!any) return true;
    gis_sorted_results_rewind(larger);
    for (size_t k = 0; done && gis_sorted_results_next(larger, &any, error) && any; k++) {
        const gis_part_row *row = larger->one.row;
        const int64_t name = p->facts.source.fids_unique ? row->fid : (int64_t)row->index;
        sunder_shape *shape = NULL;
        lines.things = (gis_proof_things){.of = &name, .n = SIZE_MAX, .feature = name_larger};
        done = gis_part_make_shape(&larger->one, &row->now, &shape, error);
        if (done) gis_proof_larger(&lines, row->index, shape);
        sunder_shape_free(shape);
        const char *rest = done ? gis_json_text(&lines.json) : NULL;
        if (rest) gis_proof_line(json, "larger", k, rest);
        gis_text_empty(&lines.json.text);
        lines.json.need_comma = false;
        done = done && (rest || gis_no_memory(error)) && gis_proof_print(json, to, error);
    }
    gis_json_clear(&lines.json);
    return done && !any;
}

/* Writes a line for each hidden feature. */
bool gis_run_proof_hidden(gis_shard_run *p, gis_json *json, FILE *to, gis_error *error)
{
    gis_sorted_results *hidden = &p->joined.hidden;
    bool any = true;
    gis_sorted_results_rewind(hidden);
    for (size_t k = 0; gis_sorted_results_next(hidden, &any, error) && any; k++) {
        const gis_part_result *one = &hidden->one;
        int64_t name = (int64_t)one->hidden->index;
        for (size_t i = 0; p->facts.source.fids_unique && i < one->names; i++)
            if (one->name[i].index == one->hidden->index) name = one->name[i].fid;
        gis_proof_hidden_line(json, k, name);
        if (!gis_proof_print(json, to, error)) return false;
    }
    return !any;
}

/* The number of the first clause of a component; these are sorted. */
static size_t first_clause(const gis_telling *t, size_t component)
{
    size_t low = 0, high = t->clauses;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (t->first[middle] < component)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Makes the line of a choice with the numbers that clauses have in the file. */
static void number_choice(const gis_telling *t, size_t component, const char *line, gis_text *out)
{
    const size_t base = first_clause(t, component);
    for (const char *mark; (mark = strchr(line, GIS_PROOF_MARK)) != NULL;) {
        char *end;
        gis_text_add_bytes(out, line, (size_t)(mark - line));
        gis_text_print(out, "%zu", base + (size_t)strtoull(mark + 1, &end, 10));
        line = end;
    }
    gis_text_add(out, line);
}

static bool put_told(gis_telling *t, const char *word, gis_json *json, FILE *to, size_t number, gis_error *error)
{
    const gis_part_told *told = t->told->one.told;
    const char *line = gis_part_line_of(&t->told->one, &told->line);
    gis_text text = {0};
    if (told->kind == GIS_TOLD_CLAUSE) t->first[t->clauses++] = told->first;
    if (told->kind == GIS_TOLD_CHOICE) {
        number_choice(t, told->first, line, &text);
        line = gis_text_get(&text);
    }
    if (line) gis_proof_line(json, word, number, line);
    gis_text_clear(&text);
    return (line || gis_no_memory(error)) && gis_proof_print(json, to, error) &&
           gis_sorted_results_next(t->told, &t->any, error);
}

/* Writes the lines of one kind, which come next in the list. */
bool gis_run_proof_told(gis_telling *t, gis_part_told_kind kind, gis_json *json, FILE *to, gis_error *error)
{
    static const char *const word[] = {"shape", "clause", "choice"};
    bool done = true;
    for (size_t k = 0; done && t->any && t->told->one.told->kind == kind; k++)
        done = put_told(t, word[kind], json, to, k, error);
    return done;
}

bool gis_telling_begin(gis_shard_run *p, gis_telling *t, gis_error *error)
{
    *t = (gis_telling){.told = &p->joined.told};
    t->first = malloc((p->joined.tolds[GIS_TOLD_CLAUSE] + 1) * sizeof *t->first);
    gis_sorted_results_rewind(t->told);
    return (t->first || gis_no_memory(error)) && gis_sorted_results_next(t->told, &t->any, error);
}
