/* Lists the rows, and measures how the moves of the result bend them. */
#include "displacement/report/report.h"

#include "base/extremes.h"

#include <math.h>
#include <stdlib.h>

/* The number of pairs is divided by this, rounded up, for the rank from the top of the value that 95 % do not
 * exceed. */
#define TWENTIETH 20

/* Returns the move of g across the row relative to f, towards the left seen along the row. */
static double bend_of(const sunder_i_model *model, const sunder_i_row_edge *e)
{
    const double *s = model->move + 2 * (size_t)e->i, *t = model->move + 2 * (size_t)e->j;
    return (t[1] - s[1]) * e->along[0] - (t[0] - s[0]) * e->along[1];
}

static int by_size(const void *x, const void *y)
{
    const double a = *(const double *)x, b = *(const double *)y;
    return a < b ? -1 : a > b;
}

/* Fills the kinks of the summary from those of n > 0 pairs, which are sorted. */
static void summarise(const double *kink, size_t n, double counted, sunder_layer_summary *summary)
{
    sunder_total total = {0};
    size_t above = 0;
    for (size_t k = 0; k < n; k++) {
        sunder_total_add(&total, kink[k]);
        above += kink[k] > counted;
    }
    summary->kink_mean = sunder_total_nearest(&total) / (double)n;
    summary->kink_p95 = kink[n - 1 - n / TWENTIETH];
    summary->kink_share = (double)above / (double)n;
}

static sunder_status measure_kinks(const sunder_i_model *model, const sunder_i_rows *rows, size_t edges,
                                   sunder_layer_summary *summary, sunder_error *err)
{
    double *kink = sunder_i_alloc(edges, sizeof *kink);
    if (!kink) return sunder_i_failure_cause(err);
    for (size_t e = 0; e < edges; e++) kink[e] = fabs(bend_of(model, &rows->edge[e]));
    qsort(kink, edges, sizeof *kink, by_size);
    summarise(kink, edges, model->rules.kink, summary);
    sunder_i_free(kink);
    return SUNDER_OK;
}

/* Counts the bodies of each row and of all rows. A body that a row passes twice, such as a block at a corner, is
 * counted once, and so is a body of two rows. */
static sunder_status count_bodies(sunder_report *report, const sunder_i_model *model, const sunder_i_rows *rows,
                                  sunder_error *err)
{
    size_t *last = sunder_i_calloc(model->bodies, sizeof *last); /* each body's last row, from 1; 0: none */
    if (!last) return sunder_i_failure_cause(err);
    for (size_t r = 0, e = 0; r < rows->rows; r++)
        for (; e < rows->row_end[r]; e++)
            for (int side = 0; side < 2; side++) {
                size_t *row = &last[side ? rows->edge[e].j : rows->edge[e].i];
                report->row[r].bodies += *row != r + 1;
                report->summary.row_features += *row == 0;
                *row = r + 1;
            }
    sunder_i_free(last);
    return SUNDER_OK;
}

/* Fills a row from its n edges, and appends its features to the report's. */
static void fill_row(sunder_report *report, const sunder_i_model *model, const sunder_i_row_edge *edge, size_t n,
                     size_t *features)
{
    size_t *feature = report->row_feature + *features, k = 0;
    const bool ring = edge[n - 1].j == edge[0].i;
    sunder_row row = {.feature = feature, .ring = ring};
    for (size_t e = 0; e < n; e++) {
        if (k == 0 || feature[k - 1] != edge[e].f) feature[k++] = edge[e].f;
        feature[k++] = edge[e].g;
        row.kink_before = sunder_i_max(row.kink_before, fabs(edge[e].offset));
        row.kink_after = sunder_i_max(row.kink_after, fabs(edge[e].offset + bend_of(model, &edge[e])));
    }
    if (ring && feature[k - 1] == feature[0]) k--;
    row.features = k;
    report->row[report->rows++] = row;
    *features += k;
}

sunder_status sunder_i_report_rows(sunder_report *report, const sunder_i_model *model, const sunder_i_rows *rows,
                                   sunder_error *err)
{
    const size_t edges = rows->rows ? rows->row_end[rows->rows - 1] : 0;
    sunder_layer_summary *summary = &report->summary;
    size_t features = 0;
    summary->rows = rows->rows;
    summary->row_pairs = edges;
    if (edges == 0) return SUNDER_OK;
    report->row = sunder_i_alloc(rows->rows, sizeof *report->row);
    report->row_feature = sunder_i_alloc(2 * edges, sizeof *report->row_feature);
    if (!report->row || !report->row_feature) return sunder_i_failure_cause(err);
    for (size_t r = 0, e = 0; r < rows->rows; e = rows->row_end[r++])
        fill_row(report, model, rows->edge + e, rows->row_end[r] - e, &features);
    const sunder_status status = count_bodies(report, model, rows, err);
    return status ? status : measure_kinks(model, rows, edges, summary, err);
}

/* ---- In the caller's numbers ------------------------------------------------------------------------------------- */

static void reverse(size_t *feature, size_t n)
{
    for (size_t k = 0; 2 * k + 1 < n; k++) {
        const size_t f = feature[k];
        feature[k] = feature[n - 1 - k];
        feature[n - 1 - k] = f;
    }
}

/* Turns n numbers so that the one at `first` becomes the first one. */
static void rotate(size_t *feature, size_t n, size_t first)
{
    reverse(feature, first);
    reverse(feature + first, n - first);
    reverse(feature, n);
}

static int by_features(const void *x, const void *y)
{
    const sunder_row *p = x, *q = y;
    for (size_t k = 0; k < p->features && k < q->features; k++)
        if (p->feature[k] != q->feature[k]) return p->feature[k] < q->feature[k] ? -1 : 1;
    return p->features < q->features ? -1 : p->features > q->features;
}

void sunder_i_report_number_rows(sunder_report *report, const uint32_t *number)
{
    for (size_t r = 0; r < report->rows; r++) {
        const sunder_row *row = &report->row[r];
        size_t *feature = report->row_feature + (row->feature - report->row_feature), n = row->features, least = 0;
        for (size_t k = 0; k < n; k++) {
            feature[k] = number[feature[k]];
            if (feature[k] < feature[least]) least = k;
        }
        if (row->ring) rotate(feature, n, least);
        if (row->ring && feature[n - 1] < feature[1]) reverse(feature + 1, n - 1);
        if (!row->ring && feature[n - 1] < feature[0]) reverse(feature, n);
    }
    if (report->rows) qsort(report->row, report->rows, sizeof *report->row, by_features);
}

const sunder_row *sunder_report_rows(const sunder_report *report, size_t *n)
{
    *n = report->rows;
    return report->row;
}
