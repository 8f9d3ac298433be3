/* buffers.c: see buffers.h. Elements are copied one by one through their strides, so that arrays that are reversed,
 * transposed, read-only, of another byte order or not contiguous need no case of their own. */
#include "python/buffers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The largest integers that all are doubles. */
static const int64_t exact_integers = INT64_C(1) << 53;

bool gis_py_is_bytes(PyObject *object)
{
    Py_buffer view;
    if (PyBytes_Check(object)) return true;
    if (!PyObject_CheckBuffer(object)) return false;
    if (PyObject_GetBuffer(object, &view, PyBUF_RECORDS_RO) < 0) {
        PyErr_Clear();
        return false;
    }
    const char *format = view.format;
    const bool bytes = view.ndim == 1 && view.itemsize == 1 && (!format || strchr("Bbc", *format));
    PyBuffer_Release(&view);
    return bytes;
}

/* ---- One element ------------------------------------------------------------------------------------------------- */

/* An element as a double, or an integer if it is one. */
typedef struct element {
    double real;
    int64_t integer;
    bool is_integer;
} element;

/* How elements are stored: the letter of the struct module, and whether their bytes are in the other order. */
typedef struct storage {
    char letter;
    size_t size;
    bool swapped;
} storage;

static bool find_storage(const Py_buffer *view, const char *who, storage *out)
{
    const char *format = view->format ? view->format : "B";
    const bool little = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;
    out->swapped = (*format == '<' && !little) || ((*format == '>' || *format == '!') && little);
    if (strchr("@=<>!", *format)) format++;
    out->letter = *format;
    out->size = (size_t)view->itemsize;
    const bool real = (*format == 'd' && out->size == 8) || (*format == 'f' && out->size == 4);
    const bool integer = *format && strchr("bBhHiIlLqQnN", *format) && out->size <= 8 &&
                         (out->size & (out->size - 1)) == 0 && out->size > 0;
    if (!(real || integer) || format[1])
        return gis_py_wrong(who, "an array of numbers of the type '%.20s'; float64 is needed",
                            view->format ? view->format : "");
    return true;
}

static int64_t read_integer(const unsigned char bytes[8], const storage *how)
{
    uint64_t number = 0;
    const bool little = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;
    for (size_t k = 0; k < how->size; k++) number = number << 8 | bytes[little ? how->size - 1 - k : k];
    const unsigned shift = (unsigned)(64 - 8 * how->size);
    const bool with_sign = strchr("bhilqn", how->letter) != NULL;
    if (with_sign) return (int64_t)(number << shift) >> shift;
    return number > INT64_MAX ? INT64_MAX : (int64_t)number; /* too large for all that is asked */
}

static element read_element(const char *from, const storage *how)
{
    unsigned char bytes[8];
    for (size_t k = 0; k < how->size; k++) bytes[k] = (unsigned char)from[how->swapped ? how->size - 1 - k : k];
    element e = {0};
    float single;
    if (how->letter == 'd') {
        memcpy(&e.real, bytes, sizeof e.real);
    } else if (how->letter == 'f') {
        memcpy(&single, bytes, sizeof single);
        e.real = single;
    } else {
        e.is_integer = true;
        e.integer = read_integer(bytes, how);
        e.real = (double)e.integer;
    }
    return e;
}

static bool to_double(const element *e, const char *who, size_t at, double *out)
{
    if (e->is_integer && (e->integer > exact_integers || e->integer < -exact_integers))
        return gis_py_wrong(who, "element %zu is an integer that no double holds", at);
    *out = e->real;
    return true;
}

/* ---- Whole buffers ----------------------------------------------------------------------------------------------- */

static bool open_buffer(PyObject *object, const char *who, Py_buffer *view, storage *how)
{
    if (PyObject_GetBuffer(object, view, PyBUF_RECORDS_RO) < 0) {
        PyErr_Clear();
        return gis_py_wrong(who, "an array whose buffer cannot be read");
    }
    if (find_storage(view, who, how)) return true;
    PyBuffer_Release(view);
    return false;
}

/* Frees an array that a caller will not get; always false. */
static bool drop(void *array)
{
    void *memory;
    memcpy(&memory, array, sizeof memory);
    free(memory);
    memory = NULL;
    memcpy(array, &memory, sizeof memory);
    return false;
}

static void *allocate(size_t n, size_t size)
{
    void *memory = n < SIZE_MAX / size ? malloc((n + 1) * size) : NULL;
    if (!memory) PyErr_NoMemory();
    return memory;
}

/* Are the elements those of an array in C, of this letter, one after the other? */
static bool is_plain(const Py_buffer *view, const storage *how, const char *letters)
{
    return how->size == 8 && !how->swapped && strchr(letters, how->letter) && PyBuffer_IsContiguous(view, 'C');
}

/* Copies x and y of each row; ndim is 2, or 1 for pairs in sequence. */
static bool copy_rows(const Py_buffer *view, const storage *how, const char *who, size_t n, double *xy)
{
    if (is_plain(view, how, "d") && (view->ndim == 1 || view->shape[1] == 2)) {
        if (n > 0) memcpy(xy, view->buf, 2 * n * sizeof *xy);
        return true;
    }
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < 2; k++) {
            const Py_ssize_t offset = view->ndim == 2
                                          ? (Py_ssize_t)i * view->strides[0] + (Py_ssize_t)k * view->strides[1]
                                          : (Py_ssize_t)(2 * i + k) * view->strides[0];
            const element e = read_element((const char *)view->buf + offset, how);
            if (!to_double(&e, who, 2 * i + k, &xy[2 * i + k])) return false;
        }
    return true;
}

bool gis_py_coordinates(PyObject *object, const char *who, bool flat, double **xy, size_t *n)
{
    Py_buffer view;
    storage how;
    if (!open_buffer(object, who, &view, &how)) return false;
    const bool pairs = view.ndim == 2 && view.shape[1] >= 2, sequence = flat && view.ndim == 1;
    bool done = true;
    if (!pairs && !(sequence && view.shape[0] % 2 == 0))
        done = view.ndim == 2
                   ? gis_py_wrong(who, "an array of the shape (%zd, %zd); coordinates have the shape (n, 2)",
                                  view.shape[0], view.shape[1])
                   : gis_py_wrong(who, "an array of %d dimensions; coordinates have the shape (n, 2)", view.ndim);
    *n = !done ? 0 : pairs ? (size_t)view.shape[0] : (size_t)view.shape[0] / 2;
    *xy = done ? allocate(*n, 2 * sizeof **xy) : NULL;
    done = *xy && copy_rows(&view, &how, who, *n, *xy);
    PyBuffer_Release(&view);
    return done || drop(xy);
}

/* ---- Numbers from buffers and sequences -------------------------------------------------------------------------- */

/* Numbers one by one, from a buffer or a sequence. */
typedef struct numbers {
    Py_buffer view;
    storage how;
    PyObject *sequence; /* NULL: the buffer */
    size_t n;
} numbers;

static bool open_numbers(PyObject *object, const char *who, size_t n, numbers *out)
{
    out->sequence = NULL;
    if (PyObject_CheckBuffer(object) && !PyBytes_Check(object)) {
        if (!open_buffer(object, who, &out->view, &out->how)) return false;
        if (out->view.ndim != 1) {
            const int dimensions = out->view.ndim;
            PyBuffer_Release(&out->view);
            return gis_py_wrong(who, "an array of %d dimensions; one is needed", dimensions);
        }
        out->n = (size_t)out->view.shape[0];
    } else {
        out->sequence = PySequence_Fast(object, "");
        if (!out->sequence) {
            PyErr_Clear();
            return gis_py_wrong(who, "neither an array nor a sequence of numbers");
        }
        out->n = (size_t)PySequence_Size(out->sequence);
    }
    if (n == SIZE_MAX || out->n == n) return true;
    const size_t held = out->n;
    if (out->sequence)
        Py_CLEAR(out->sequence);
    else
        PyBuffer_Release(&out->view);
    return gis_py_wrong(who, "%zu values; %zu are needed", held, n);
}

static void close_numbers(numbers *from)
{
    if (from->sequence)
        Py_CLEAR(from->sequence);
    else
        PyBuffer_Release(&from->view);
}

static bool next_number(const numbers *from, const char *who, size_t i, bool integer, element *out)
{
    if (!from->sequence) {
        *out = read_element((const char *)from->view.buf + (Py_ssize_t)i * from->view.strides[0], &from->how);
        return true;
    }
    PyObject *item = PySequence_GetItem(from->sequence, (Py_ssize_t)i);
    if (!item) return false;
    *out = (element){.is_integer = PyLong_Check(item) || integer};
    if (out->is_integer) {
        PyObject *whole = PyNumber_Index(item);
        out->integer = whole ? PyLong_AsLongLong(whole) : -1;
        out->real = (double)out->integer;
        Py_XDECREF(whole);
    } else {
        out->real = PyFloat_AsDouble(item);
    }
    Py_DECREF(item);
    if (!PyErr_Occurred()) return true;
    PyErr_Clear();
    return gis_py_wrong(who, "element %zu is not a%s", i, integer ? "n integer of 64 bits" : " number");
}

bool gis_py_doubles(PyObject *object, const char *who, size_t n, double **out, size_t *count)
{
    numbers from;
    if (!open_numbers(object, who, n, &from)) return false;
    *count = from.n;
    *out = allocate(from.n, sizeof **out);
    bool done = *out != NULL;
    for (size_t i = 0; done && i < from.n; i++) {
        element e;
        done = next_number(&from, who, i, false, &e) && to_double(&e, who, i, &(*out)[i]);
    }
    close_numbers(&from);
    return done || drop(out);
}

bool gis_py_integers(PyObject *object, const char *who, size_t n, int64_t **out, size_t *count)
{
    numbers from;
    if (!open_numbers(object, who, n, &from)) return false;
    *count = from.n;
    *out = allocate(from.n, sizeof **out);
    bool done = *out != NULL;
    const bool plain = done && !from.sequence && is_plain(&from.view, &from.how, "lq");
    if (plain && from.n > 0) memcpy(*out, from.view.buf, from.n * sizeof **out);
    for (size_t i = 0; done && !plain && i < from.n; i++) {
        element e;
        done = next_number(&from, who, i, true, &e);
        if (done && !e.is_integer) done = gis_py_wrong(who, "element %zu is not an integer", i);
        if (done) (*out)[i] = e.integer;
    }
    close_numbers(&from);
    return done || drop(out);
}
