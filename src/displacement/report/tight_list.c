/* Pairs that are tight: they keep the distance that they have to keep, but not the full one. They are no conflicts, so
 * they are kept apart from these until all is known about them. */
#include "displacement/report/report.h"

#include <math.h>
#include <string.h>

/* Is the pair listed as a conflict? *at: the index of the first conflict that does not come before it; these and the
 * pairs asked about have the same order. */
static bool is_conflict(const sunder_report *report, uint32_t a, uint32_t b, size_t *at)
{
    const sunder_conflict *c = report->conflict;
    while (*at < report->conflicts && (c[*at].a < a || (c[*at].a == a && c[*at].b < b))) ++*at;
    return *at < report->conflicts && c[*at].a == a && c[*at].b == b;
}

/* Lists the pairs that are in conflict with the full distances, but are no conflicts. */
static bool list_tight(sunder_report *report, const sunder_i_model *model, const sunder_i_relations *full)
{
    size_t capacity = 0, at = 0, n = 0;
    for (size_t k = 0; k < full->n;) {
        sunder_conflict pair;
        uint32_t a, b;
        if (!sunder_i_next_conflict(model, full, &k, &a, &b, &pair) || pair.inside_block ||
            is_conflict(report, a, b, &at))
            continue;
        if (!sunder_i_reserve(&report->tight, &capacity, n + 1, sizeof *report->tight)) return false;
        report->tight[n++] = (sunder_conflict){.a = a,
                                               .b = b,
                                               .kind = SUNDER_CONFLICT_TIGHT,
                                               .required = sunder_i_full_above(model, a, b),
                                               .need_shift = NAN,
                                               .need_gap = NAN,
                                               .need_gone = SIZE_MAX,
                                               .need_gap_most = NAN};
    }
    report->summary.tight = n;
    return true;
}

sunder_status sunder_i_report_tight(sunder_report *report, const sunder_i_model *model,
                                    const sunder_i_placement *placement, bool reasons, sunder_error *err)
{
    if (!sunder_i_has_slack(model)) return SUNDER_OK;
    sunder_i_relations full = {0};
    sunder_status status = sunder_i_placement_relate_fully(model, placement, &full, err);
    if (!status && !list_tight(report, model, &full)) status = sunder_i_failure_cause(err);
    sunder_i_free(full.pair);
    if (status) return status;
    return sunder_i_report_measure(model, placement, report->tight, report->summary.tight, NULL, reasons, err);
}

sunder_status sunder_i_report_add_tight(sunder_report *report, const sunder_i_model *model, sunder_error *err)
{
    const size_t n = report->conflicts, more = report->summary.tight;
    if (!sunder_i_has_slack(model)) return SUNDER_OK;
    for (size_t k = 0; k < n; k++) {
        sunder_conflict *c = &report->conflict[k];
        const uint32_t a = (uint32_t)c->a, b = (uint32_t)c->b;
        c->missing += sunder_i_full_above(model, a, b) - sunder_i_owed_above(model, a, b);
        c->required = sunder_i_full_above(model, a, b);
    }
    if (more == 0) return SUNDER_OK;
    sunder_conflict *conflict = sunder_i_realloc(report->conflict, n + more, sizeof *conflict);
    if (conflict) report->conflict = conflict;
    sunder_proof **proof = report->proof ? sunder_i_realloc(report->proof, n + more, sizeof(sunder_proof *)) : NULL;
    if (proof) report->proof = proof;
    if (!conflict || (report->proof && !proof)) return sunder_i_failure_cause(err);
    memcpy(conflict + n, report->tight, more * sizeof *conflict);
    for (size_t k = n; proof && k < n + more; k++) proof[k] = NULL;
    report->conflicts = n + more;
    return SUNDER_OK;
}
