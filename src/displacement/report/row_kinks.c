/* Lists the rows that pairs of neighbours form, and measures how much their moves bend them. */
#include "displacement/report/report.h"
#include "displacement/report/row_chains.h"

#include "base/extremes.h"
#include "base/sized_struct.h"

#include <math.h>
#include <stdlib.h>

/* The number of pairs is divided by this, rounded up, for the rank from the top of the value that 95 % do not
 * exceed. */
#define TWENTIETH 20

/* Returns the move of the second one across the row relative to the first one, towards the left seen along the row. */
static double bend_of(const sunder_row_pair *p)
{
    const double *s = p->move[0], *t = p->move[1];
    return (t[1] - s[1]) * p->along[0] - (t[0] - s[0]) * p->along[1];
}

static int by_size(const void *x, const void *y)
{
    const double a = *(const double *)x, b = *(const double *)y;
    return a < b ? -1 : a > b;
}

/* Returns the move of the second one along the row relative to the first one: by how much the two come apart. */
static double slide_of(const sunder_row_pair *p)
{
    const double *s = p->move[0], *t = p->move[1];
    return (t[0] - s[0]) * p->along[0] + (t[1] - s[1]) * p->along[1];
}

/* Returns by how much the line from the middle of the first to that of the second turns, in degrees. */
static double turn_of(const sunder_row_pair *p)
{
    const double *d = p->middle, e[2] = {d[0] + slide_of(p), d[1] + bend_of(p)};
    return fabs(atan2(d[0] * e[1] - d[1] * e[0], d[0] * e[0] + d[1] * e[1])) * 180 / acos(-1);
}

/* Sorts n > 0 values, and sets their mean and the value that 95 % do not exceed. */
static void summarise(double *value, size_t n, double *mean, double *p95)
{
    sunder_total total = {0};
    for (size_t k = 0; k < n; k++) sunder_total_add(&total, value[k]);
    qsort(value, n, sizeof *value, by_size);
    *mean = sunder_total_nearest(&total) / (double)n;
    *p95 = value[n - 1 - n / TWENTIETH];
}

/* Measures the kinks, the changes of spacing, the turns, and the cost of the springs of n > 0 pairs. */
static sunder_status measure_pairs(const sunder_row_pair *pair, size_t n, const sunder_i_row_figures *how,
                                   sunder_layer_summary *summary, sunder_error *err)
{
    sunder_total cost = {0};
    size_t above = 0;
    double *kink = sunder_i_alloc(3 * n, sizeof *kink);
    if (!kink) return sunder_i_failure_cause(err);
    double *slide = kink + n, *turn = slide + n;
    for (size_t k = 0; k < n; k++) {
        const sunder_row_pair *p = &pair[k];
        const sunder_i_row_side side = {
            .along = {p->along[0], p->along[1]}, .weight = p->weight, .rest = {p->rest[0], p->rest[1]}};
        kink[k] = fabs(bend_of(p));
        slide[k] = fabs(slide_of(p));
        turn[k] = turn_of(p);
        above += kink[k] > how->kink;
        sunder_total_add(&cost, sunder_i_spring_cost_with(how->stiffness, &side, p->move[0], p->move[1]));
    }
    summarise(kink, n, &summary->kink_mean, &summary->kink_p95);
    summarise(slide, n, &summary->spacing_mean, &summary->spacing_p95);
    summarise(turn, n, &summary->turn_mean, &summary->turn_p95);
    summary->kink_share = (double)above / (double)n;
    summary->cost_rows = sunder_total_nearest(&cost);
    sunder_i_free(kink);
    return SUNDER_OK;
}

/* ---- Lines ------------------------------------------------------------------------------------------------------- */

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

/* Makes the row begin with its lower end, or with the least of its features if it is a ring. */
static void begin_at_least(size_t *feature, size_t n, bool ring)
{
    size_t least = 0;
    for (size_t k = 1; k < n; k++)
        if (feature[k] < feature[least]) least = k;
    if (ring) rotate(feature, n, least);
    if (ring && feature[n - 1] < feature[1]) reverse(feature + 1, n - 1);
    if (!ring && feature[n - 1] < feature[0]) reverse(feature, n);
}

/* Appends row r of the chains to the list, and its features to the list's. */
static void append_row(const sunder_row_pair *pair, const sunder_i_row_chains *chains, size_t r, sunder_row_list *list,
                       size_t *features)
{
    const size_t begin = r ? chains->row_end[r - 1] : 0, end = chains->row_end[r];
    const sunder_i_chained_pair *first = &chains->link[begin], *last = &chains->link[end - 1];
    size_t *feature = list->feature + *features, k = 0;
    sunder_row row = {.feature = feature,
                      .ring = chains->block[2 * first->pair + first->turned] ==
                              chains->block[2 * last->pair + !last->turned]};
    for (size_t e = begin; e < end; e++) {
        const sunder_row_pair *p = &pair[chains->link[e].pair];
        const bool turned = chains->link[e].turned;
        if (k == 0 || feature[k - 1] != p->feature[turned]) feature[k++] = p->feature[turned];
        feature[k++] = p->feature[!turned];
        row.kink_before = sunder_i_max(row.kink_before, fabs(p->offset));
        row.kink_after = sunder_i_max(row.kink_after, fabs(p->offset + bend_of(p)));
    }
    if (row.ring && feature[k - 1] == feature[0]) k--;
    begin_at_least(feature, k, row.ring);
    row.features = k;
    list->row[list->rows++] = row;
    *features += k;
}

/* Counts the blocks of each row and of all rows. A block that a row passes twice, such as one at a corner, is counted
 * once, and so is a block of two rows. */
static sunder_status count_blocks(const sunder_i_row_chains *chains, sunder_row_list *list, sunder_error *err)
{
    size_t *last = sunder_i_calloc(chains->blocks, sizeof *last); /* each block's last row, from 1; 0: none */
    if (!last) return sunder_i_failure_cause(err);
    for (size_t r = 0, e = 0; r < chains->rows; r++)
        for (; e < chains->row_end[r]; e++)
            for (int side = 0; side < 2; side++) {
                size_t *row = &last[chains->block[2 * chains->link[e].pair + (size_t)side]];
                list->row[r].bodies += *row != r + 1;
                *row = r + 1;
            }
    sunder_i_free(last);
    return SUNDER_OK;
}

static int by_features(const void *x, const void *y)
{
    const sunder_row *p = x, *q = y;
    for (size_t k = 0; k < p->features && k < q->features; k++)
        if (p->feature[k] != q->feature[k]) return p->feature[k] < q->feature[k] ? -1 : 1;
    return p->features < q->features ? -1 : p->features > q->features;
}

static sunder_status list_rows(const sunder_row_pair *pair, size_t n, const sunder_i_row_chains *chains,
                               sunder_row_list *list, sunder_error *err)
{
    size_t features = 0;
    list->row = sunder_i_alloc(chains->rows, sizeof *list->row);
    list->feature = sunder_i_alloc(2 * n, sizeof *list->feature);
    if (!list->row || !list->feature) return sunder_i_failure_cause(err);
    for (size_t r = 0; r < chains->rows; r++) append_row(pair, chains, r, list, &features);
    const sunder_status status = count_blocks(chains, list, err);
    if (!status) qsort(list->row, list->rows, sizeof *list->row, by_features);
    return status;
}

/* ---- Pairs and rows ---------------------------------------------------------------------------------------------- */

/* Joins n pairs to rows; see sunder_rows_make(). */
static sunder_status make_rows(const sunder_row_pair *pair, size_t n, const sunder_i_row_figures *how,
                               sunder_row_list *list, sunder_layer_summary *summary, sunder_error *err)
{
    sunder_i_row_chains chains;
    *list = (sunder_row_list){0};
    summary->rows = summary->row_features = summary->row_pairs = 0;
    summary->kink_mean = summary->kink_p95 = summary->kink_share = summary->cost_rows = 0;
    summary->spacing_mean = summary->spacing_p95 = summary->turn_mean = summary->turn_p95 = 0;
    if (n == 0) return SUNDER_OK;
    sunder_status status = sunder_i_row_chains_make(pair, n, &chains, err);
    if (!status) status = list_rows(pair, n, &chains, list, err);
    if (!status) status = measure_pairs(pair, n, how, summary, err);
    summary->rows = chains.rows;
    summary->row_features = chains.blocks;
    summary->row_pairs = n;
    summary->cost += summary->cost_rows;
    sunder_i_row_chains_free(&chains);
    return status;
}

sunder_status sunder_rows_make(const sunder_row_pair *pair, size_t n, const sunder_layer_options *options,
                               sunder_row_list *out, sunder_layer_summary *summary, sunder_error *err)
{
    sunder_layer_options o;
    sunder_i_rules rules;
    sunder_layer_options_init(&o);
    sunder_status status = sunder_i_options_read(&o, sizeof o, options, err);
    if (!status) status = sunder_i_rules_of(&o, &rules, err);
    if (status) return status;
    const sunder_i_row_figures how = {rules.kink, {o.row_stiffness[0], o.row_stiffness[1]}};
    sunder_row_list list;
    status = make_rows(pair, n, &how, &list, summary, err);
    if (status)
        sunder_row_list_free(&list);
    else
        *out = list;
    return status;
}

void sunder_row_list_free(sunder_row_list *list)
{
    sunder_i_free_all(list->row, list->feature);
    *list = (sunder_row_list){0};
}

sunder_status sunder_i_report_row_pairs(sunder_report *report, const sunder_i_model *model, const sunder_i_rows *rows,
                                        sunder_error *err)
{
    report->row_figures =
        (sunder_i_row_figures){model->rules.kink, {model->rules.row_stiffness[0], model->rules.row_stiffness[1]}};
    const size_t n = rows->edges + rows->hidden;
    if (n == 0) return SUNDER_OK;
    report->row_pair = sunder_i_alloc(n, sizeof *report->row_pair);
    if (!report->row_pair) return sunder_i_failure_cause(err);
    report->row_pairs = rows->edges;
    report->hidden_row_pairs = rows->hidden;
    for (size_t e = 0; e < n; e++) {
        const sunder_i_row_edge *edge = &rows->edge[e];
        const double *s = model->move + 2 * (size_t)edge->i, *t = model->move + 2 * (size_t)edge->j,
                     *a = sunder_i_preferred(model, edge->i), *b = sunder_i_preferred(model, edge->j);
        report->row_pair[e] =
            (sunder_row_pair){.feature = {edge->f, edge->g},
                              .side = {edge->side[0], edge->side[1]},
                              .along = {edge->along[0], edge->along[1]},
                              .apart = edge->apart,
                              .offset = edge->offset,
                              .middle = {edge->middle[0], edge->middle[1]},
                              .weight = sunder_i_min(sunder_i_weight_below(model, &model->body[edge->i]),
                                                     sunder_i_weight_below(model, &model->body[edge->j])),
                              .move = {{s[0], s[1]}, {t[0], t[1]}},
                              .rest = {b[0] - a[0], b[1] - a[1]}};
    }
    return SUNDER_OK;
}

/* Exchanges the two of a pair. */
static sunder_row_pair turned(const sunder_row_pair *p)
{
    return (sunder_row_pair){.feature = {p->feature[1], p->feature[0]},
                             .block = {p->block[1], p->block[0]},
                             .side = {p->side[1], p->side[0]},
                             .along = {-p->along[0], -p->along[1]},
                             .apart = p->apart,
                             .offset = p->offset,
                             .middle = {p->middle[0], p->middle[1]},
                             .weight = p->weight,
                             .move = {{p->move[1][0], p->move[1][1]}, {p->move[0][0], p->move[0][1]}},
                             .rest = {-p->rest[0], -p->rest[1]}};
}

static int by_feature_pair(const void *x, const void *y)
{
    const sunder_row_pair *p = x, *q = y;
    for (int k = 0; k < 2; k++)
        if (p->feature[k] != q->feature[k]) return p->feature[k] < q->feature[k] ? -1 : 1;
    return 0;
}

sunder_status sunder_i_report_number_rows(sunder_report *report, const uint32_t *number, sunder_error *err)
{
    const size_t n = report->row_pairs, hidden = report->hidden_row_pairs;
    for (size_t k = 0; k < n + hidden; k++) {
        sunder_row_pair *p = &report->row_pair[k];
        for (int c = 0; c < 2; c++) {
            p->feature[c] = number[p->feature[c]];
            const int64_t block = report->block[p->feature[c]];
            p->block[c] = block < 0 ? p->feature[c] : (size_t)block;
        }
        if (p->feature[0] > p->feature[1]) *p = turned(p);
    }
    if (n) qsort(report->row_pair, n, sizeof *report->row_pair, by_feature_pair);
    if (hidden) qsort(report->row_pair + n, hidden, sizeof *report->row_pair, by_feature_pair);
    return make_rows(report->row_pair, report->row_pairs, &report->row_figures, &report->row_list, &report->summary,
                     err);
}

/* ---- Getters ----------------------------------------------------------------------------------------------------- */

const sunder_row_pair *sunder_report_hidden_row_pairs(const sunder_report *report, size_t *n)
{
    *n = report->hidden_row_pairs;
    return report->row_pair + report->row_pairs;
}

const sunder_row *sunder_report_rows(const sunder_report *report, size_t *n)
{
    *n = report->row_list.rows;
    return report->row_list.row;
}

const sunder_row_pair *sunder_report_row_pairs(const sunder_report *report, size_t *n)
{
    *n = report->row_pairs;
    return report->row_pair;
}
