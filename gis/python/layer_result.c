/* layer_result.c: the report on a layer as Python's values. */
#include "python/layer_calls.h"

#include <stddef.h>

/* Sets an item and drops the reference to the value. False: an exception is set. */
static bool put(PyObject *dict, const char *name, PyObject *value)
{
    const bool done = value && PyDict_SetItemString(dict, name, value) == 0;
    Py_XDECREF(value);
    return done;
}

/* ---- The summary ------------------------------------------------------------------------------------------------- */

typedef enum kind { COUNT, REAL, TRUTH } kind;

typedef struct member {
    const char *name;
    size_t at;
    kind of;
} member;

#define COUNT_OF(name) #name, offsetof(sunder_layer_summary, name), COUNT
#define REAL_OF(name) #name, offsetof(sunder_layer_summary, name), REAL

static const member members[] = {
    {COUNT_OF(features)},
    {COUNT_OF(vertices)},
    {COUNT_OF(blocks)},
    {COUNT_OF(clusters)},
    {COUNT_OF(clusters_optimal)},
    {COUNT_OF(pairs_tested)},
    {COUNT_OF(moved)},
    {COUNT_OF(blocked)},
    {COUNT_OF(skipped)},
    {COUNT_OF(rounded)},
    {COUNT_OF(rows)},
    {COUNT_OF(short_pairs)},
    {COUNT_OF(tight)},
    {REAL_OF(total)},
    {REAL_OF(mean)},
    {REAL_OF(max)},
    {REAL_OF(cost)},
    {REAL_OF(lower_bound)},
    {REAL_OF(cost_moves)},
    {REAL_OF(cost_rows)},
    {REAL_OF(cost_shortfall)},
    {REAL_OF(cost_alone)},
    {REAL_OF(shortfall)},
    {REAL_OF(kink_mean)},
    {REAL_OF(kink_p95)},
    {REAL_OF(kink_share)},
    {REAL_OF(seconds_solve)},
    {REAL_OF(seconds_explain)},
    {REAL_OF(seconds_verify)},
    {"verified", offsetof(sunder_layer_summary, verified), TRUTH},
};

static PyObject *counts_of(const sunder_conflict_counts *counts)
{
    return Py_BuildValue("{snsnsnsnsnsnsnsn}", "overlap", (Py_ssize_t)counts->overlap, "too_close",
                         (Py_ssize_t)counts->too_close, "barrier", (Py_ssize_t)counts->barrier, "barrier_drawn",
                         (Py_ssize_t)counts->barrier_drawn, "barrier_near", (Py_ssize_t)counts->barrier_near,
                         "contained", (Py_ssize_t)counts->contained, "duplicate", (Py_ssize_t)counts->duplicate,
                         "inside_blocks", (Py_ssize_t)counts->inside_blocks);
}

static PyObject *summary_of(const sunder_report *report)
{
    sunder_layer_summary summary;
    sunder_report_summary(report, &summary);
    PyObject *out = PyDict_New();
    bool done = out != NULL;
    for (size_t k = 0; done && k < sizeof members / sizeof *members; k++) {
        const char *at = (const char *)&summary + members[k].at;
        PyObject *value = members[k].of == COUNT  ? PyLong_FromSize_t(*(const size_t *)(const void *)at)
                          : members[k].of == REAL ? PyFloat_FromDouble(*(const double *)(const void *)at)
                                                  : PyBool_FromLong(*(const bool *)(const void *)at);
        done = put(out, members[k].name, value);
    }
    done = done && put(out, "before", counts_of(&summary.before)) && put(out, "after", counts_of(&summary.after));
    if (!done) Py_CLEAR(out);
    return out;
}

/* ---- Conflicts --------------------------------------------------------------------------------------------------- */

static PyObject *thing(size_t number) { return number == SIZE_MAX ? Py_NewRef(Py_None) : PyLong_FromSize_t(number); }

static PyObject *blockers(const sunder_conflict *c)
{
    PyObject *out = PyTuple_New((Py_ssize_t)c->n_blocked_by);
    for (size_t k = 0; out && k < c->n_blocked_by; k++) {
        PyObject *one = PyLong_FromSize_t(c->blocked_by[k]);
        if (!one || PyTuple_SetItem(out, (Py_ssize_t)k, one) < 0) Py_CLEAR(out);
    }
    return out;
}

/* (a, b, kind, reason, distance, before, depth, required, missing, from, to, blocked_by, need_shift, need_gap,
 * need_gone, inside_block, by_row) */
static PyObject *conflict_of(const sunder_conflict *c)
{
    return Py_BuildValue("nNssddddd(dd)(dd)NddNOO", (Py_ssize_t)c->a, thing(c->b), sunder_conflict_kind_string(c->kind),
                         sunder_reason_string(c->reason), c->distance, c->before, c->depth, c->required, c->missing,
                         c->from[0], c->from[1], c->to[0], c->to[1], blockers(c), c->need_shift, c->need_gap,
                         thing(c->need_gone), c->inside_block ? Py_True : Py_False, c->by_row ? Py_True : Py_False);
}

static PyObject *conflicts_of(const sunder_report *report)
{
    size_t n;
    const sunder_conflict *conflict = sunder_report_conflicts(report, &n);
    PyObject *out = PyList_New((Py_ssize_t)n);
    for (size_t k = 0; out && k < n; k++) {
        PyObject *one = conflict_of(&conflict[k]);
        if (!one || PyList_SetItem(out, (Py_ssize_t)k, one) < 0) Py_CLEAR(out);
    }
    return out;
}

/* ---- Features ---------------------------------------------------------------------------------------------------- */

static bool put_features(PyObject *out, const sunder_report *report, size_t n)
{
    void *moves, *blocks, *statuses;
    if (!put(out, "moves", gis_py_array("d", sizeof(double), n, 2, &moves)) ||
        !put(out, "blocks", gis_py_array("q", sizeof(int64_t), n, 1, &blocks)) ||
        !put(out, "statuses", gis_py_array("B", 1, n, 1, &statuses)))
        return false;
    for (size_t i = 0; i < n; i++) {
        double *move = (double *)moves + 2 * i;
        sunder_report_move(report, i, &move[0], &move[1]);
        ((int64_t *)blocks)[i] = sunder_report_block(report, i);
        ((unsigned char *)statuses)[i] = (unsigned char)sunder_report_status(report, i);
    }
    return true;
}

/* The numbers of barriers as a list. */
static PyObject *numbers_of(const int64_t *barrier, size_t barriers)
{
    PyObject *out = PyList_New((Py_ssize_t)barriers);
    for (size_t k = 0; out && k < barriers; k++) {
        PyObject *one = PyLong_FromLongLong(barrier[k]);
        if (!one || PyList_SetItem(out, (Py_ssize_t)k, one) < 0) Py_CLEAR(out);
    }
    return out;
}

PyObject *gis_py_report(const sunder_report *report, size_t n, const int64_t *barrier, size_t barriers)
{
    PyObject *out = PyDict_New();
    if (out && !(put_features(out, report, n) && put(out, "conflicts", conflicts_of(report)) &&
                 put(out, "summary", summary_of(report)) && put(out, "barriers", numbers_of(barrier, barriers))))
        Py_CLEAR(out);
    return out;
}
