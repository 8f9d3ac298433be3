#include "outline/outline.h"

#include "outline/boundary.h"
#include "outline/cells.h"

typedef struct stages {
    const sunder_i_pieces *parts;
    const sunder_sum_options *options;
    sunder_status (*keep)(const sunder_i_coverage *coverage, void *user, sunder_error *err);
    void *user;
    sunder_sum *sum;
} stages;

static sunder_status run_along(const stages *s, const sunder_i_lines *lines, sunder_error *err)
{
    sunder_i_cell_pairs pairing;
    sunder_i_coverage coverage;
    sunder_status status = sunder_i_cells_pair(s->parts, lines, s->options, &pairing, err);
    if (status != SUNDER_OK) return status;
    status = sunder_i_coverage_find(s->parts, lines, &pairing, &coverage, err);
    sunder_i_cell_pairs_free(&pairing);
    if (status != SUNDER_OK) return status;
    if (s->keep) status = s->keep(&coverage, s->user, err);
    if (status == SUNDER_OK) status = sunder_i_boundary_build(s->parts, lines, &coverage, s->sum, err);
    sunder_i_coverage_free(&coverage);
    return status;
}

sunder_status sunder_i_stages_run(const sunder_i_pieces *parts, const sunder_sum_options *options,
                                  sunder_status (*keep)(const sunder_i_coverage *coverage, void *user,
                                                        sunder_error *err),
                                  void *user, sunder_sum *sum, sunder_error *err)
{
    const stages s = {parts, options, keep, user, sum};
    sunder_i_lines lines;
    sunder_status status = sunder_i_lines_group(parts, &lines, err);
    if (status != SUNDER_OK) return status;
    status = run_along(&s, &lines, err);
    sunder_i_lines_free(&lines);
    return status;
}
