/* pair_calls.c: two shapes, or two rows of shapes pair by pair: overlaps, distances, least translations. */
#include "python/shapes_type.h"
#include "python/watched_call.h"

#include <stdio.h>
#include <stdlib.h>

/* ---- One pair ---------------------------------------------------------------------------------------------------- */

typedef enum question { SEPARATE, OVERLAP, APART, DISTANCE } question;

typedef struct pair_call {
    question asked;
    const sunder_shape *p, *q;
    double gap, distance, on_p[2], on_q[2];
    bool answer;
    sunder_separation least;
    sunder_status status;
    sunder_error why;
} pair_call;

static void ask(void *of, gis_py_watch *watch)
{
    pair_call *c = of;
    (void)watch;
    switch (c->asked) {
    case SEPARATE: c->status = sunder_pair_separate(c->p, c->q, c->gap, &c->least, &c->why); break;
    case OVERLAP: c->status = sunder_pair_overlap(c->p, c->q, &c->answer, &c->why); break;
    case APART: c->status = sunder_pair_apart(c->p, c->q, c->gap, &c->answer, &c->why); break;
    case DISTANCE: c->status = sunder_pair_distance(c->p, c->q, &c->distance, c->on_p, c->on_q, &c->why); break;
    }
}

/* Reads p, q and, for those questions, the gap; asks. False: an exception is set. */
static bool ask_pair(PyObject *module, PyObject *args, question asked, pair_call *c)
{
    PyObject *p, *q;
    *c = (pair_call){.asked = asked, .status = SUNDER_ECANCEL};
    if (!PyArg_ParseTuple(args, "OO|d", &p, &q, &c->gap)) return false;
    const gis_py_state *state = gis_py_state_of(module);
    if (!(c->p = gis_py_operand(state, p, "a")) || !(c->q = gis_py_operand(state, q, "b"))) return false;
    const bool ran = gis_py_run(ask, c, Py_None, false);
    if (ran && c->status == SUNDER_OK) return true;
    if (c->status == SUNDER_OK && asked == SEPARATE) sunder_separation_clear(&c->least);
    if (ran) gis_py_raise(state, NULL, &c->why);
    return false;
}

/* least_translation(p, q, gap) -> (dx, dy, distance, contact, dx, dy, squared distance as texts, overlap,
 * rounded_is_free, lower_bound) */
static PyObject *least_translation(PyObject *module, PyObject *args)
{
    pair_call c;
    if (!ask_pair(module, args, SEPARATE, &c)) return NULL;
    const sunder_separation *s = &c.least;
    PyObject *out = Py_BuildValue("dddssssOOd", s->dx, s->dy, s->distance, sunder_contact_string(s->contact),
                                  s->dx_text, s->dy_text, s->distance_squared_text, s->overlap ? Py_True : Py_False,
                                  s->rounded_is_free ? Py_True : Py_False, s->lower_bound);
    sunder_separation_clear(&c.least);
    return out;
}

static PyObject *overlap(PyObject *module, PyObject *args)
{
    pair_call c;
    return ask_pair(module, args, OVERLAP, &c) ? PyBool_FromLong(c.answer) : NULL;
}

static PyObject *apart(PyObject *module, PyObject *args)
{
    pair_call c;
    return ask_pair(module, args, APART, &c) ? PyBool_FromLong(c.answer) : NULL;
}

static PyObject *distance(PyObject *module, PyObject *args)
{
    pair_call c;
    if (!ask_pair(module, args, DISTANCE, &c)) return NULL;
    return Py_BuildValue("d(dd)(dd)", c.distance, c.on_p[0], c.on_p[1], c.on_q[0], c.on_q[1]);
}

/* ---- Many pairs -------------------------------------------------------------------------------------------------- */

/* Pairs, and the places of the results. */
typedef struct batch {
    const gis_py_shapes *p, *q;
    size_t n, at; /* `at`: the pair at fault */
    double gap, *move, *distance;
    unsigned char *contact;
    sunder_status status;
    sunder_error why;
} batch;

/* A row of one shape is the same shape in each pair. */
static const sunder_shape *item(const gis_py_shapes *shapes, size_t i) { return shapes->shape[shapes->n == 1 ? 0 : i]; }

static void separate_pairs(void *of, gis_py_watch *watch)
{
    batch *b = of;
    b->status = SUNDER_OK;
    for (size_t i = 0; b->status == SUNDER_OK && i < b->n; i++) {
        sunder_separation least = {0};
        const sunder_shape *p = item(b->p, i), *q = item(b->q, i);
        b->at = i;
        if (i % 1024 == 0 && !gis_py_progress((double)i / (double)b->n, watch)) {
            b->status = b->why.status = SUNDER_ECANCEL;
            return;
        }
        if (p && q) b->status = sunder_pair_separate(p, q, b->gap, &least, &b->why);
        if (b->status != SUNDER_OK) return;
        b->move[2 * i] = least.dx;
        b->move[2 * i + 1] = least.dy;
        b->distance[i] = least.distance;
        b->contact[i] = (unsigned char)least.contact;
        if (p && q) sunder_separation_clear(&least);
    }
}

/* Checks that the rows of shapes fit together, and sets b->n. */
static bool pair_up(batch *b)
{
    b->n = b->p->n == 1 ? b->q->n : b->p->n;
    return b->n == b->q->n || b->q->n == 1 ||
           gis_py_wrong("b", "%zu geometries; a has %zu, and both need the same number, or one", b->q->n, b->p->n);
}

/* least_translations(p, q, gap, progress) -> (moves, distances, contacts) */
static PyObject *least_translations(PyObject *module, PyObject *args)
{
    PyObject *p, *q, *progress, *moves = NULL, *distances = NULL, *contacts = NULL, *out = NULL;
    void *move, *length, *contact;
    batch b = {.status = SUNDER_ECANCEL};
    if (!PyArg_ParseTuple(args, "OOdO", &p, &q, &b.gap, &progress)) return NULL;
    const gis_py_state *state = gis_py_state_of(module);
    if (!(b.p = gis_py_shapes_of(state, p)) || !(b.q = gis_py_shapes_of(state, q)) || !pair_up(&b)) return NULL;
    moves = gis_py_array("d", sizeof(double), b.n, 2, &move);
    distances = moves ? gis_py_array("d", sizeof(double), b.n, 1, &length) : NULL;
    contacts = distances ? gis_py_array("B", 1, b.n, 1, &contact) : NULL;
    if (contacts) {
        b.move = move;
        b.distance = length;
        b.contact = contact;
        char name[60];
        const bool ran = gis_py_run(separate_pairs, &b, progress, false);
        snprintf(name, sizeof name, "pair %zu", b.at);
        if (ran && b.status == SUNDER_OK)
            out = PyTuple_Pack(3, moves, distances, contacts);
        else if (ran)
            gis_py_raise(state, name, &b.why);
    }
    Py_XDECREF(moves);
    Py_XDECREF(distances);
    Py_XDECREF(contacts);
    return out;
}

/* contact_words() -> the words for the numbers that least_translations() returns */
static PyObject *contact_words(PyObject *module, PyObject *unused)
{
    (void)module, (void)unused;
    PyObject *out = PyList_New(0);
    for (unsigned k = 0; out && k <= SUNDER_CONTACT_DEGENERATE_POINT; k++) {
        PyObject *word = PyUnicode_FromString(sunder_contact_string((sunder_contact)k));
        if (!word || PyList_Append(out, word) < 0) Py_CLEAR(out);
        Py_XDECREF(word);
    }
    return out;
}

PyMethodDef gis_py_pair_functions[] = {
    {"least_translation", least_translation, METH_VARARGS,
     "least_translation(p, q, gap) -> (dx, dy, distance, contact, dx, dy, distance squared, overlap, free, bound)."},
    {"least_translations", least_translations, METH_VARARGS,
     "least_translations(p, q, gap, progress) -> (moves, distances, contacts), pair by pair."},
    {"contact_words", contact_words, METH_NOARGS, "The words for numbers of contacts."},
    {"overlap", overlap, METH_VARARGS, "overlap(p, q) -> bool."},
    {"apart", apart, METH_VARARGS, "apart(p, q, gap) -> bool."},
    {"distance", distance, METH_VARARGS, "distance(p, q) -> (distance, (x, y) on p, (x, y) on q)."},
    {NULL, NULL, 0, NULL},
};
