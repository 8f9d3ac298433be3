#include "bytes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_VERTICES = 64, MAX_RINGS = 8, MAX_VERTICES_ANY = 4 };

/* libFuzzer runs one input at a time; the library's own threads only read and decrease the count. */
static _Atomic unsigned allocations_left;
static _Atomic int failing;

static int is_refused(void) { return failing && (allocations_left == 0 || --allocations_left == 0); }

static void *allocate(size_t size) { return is_refused() ? NULL : malloc(size); }

static void *reallocate(void *memory, size_t size) { return is_refused() ? NULL : realloc(memory, size); }

void fuzz_fail_allocations(unsigned after)
{
    static int installed;
    if (!installed) {
        sunder_set_allocator(allocate, reallocate, free);
        installed = 1;
    }
    failing = after > 0;
    allocations_left = after;
}

/* Called by one thread at a time, which may be any. */
static _Atomic unsigned looks_left;
static _Atomic bool out_of_patience;

static bool go_on(void *user)
{
    (void)user;
    if (looks_left > 0) --looks_left;
    out_of_patience = looks_left == 0;
    return !out_of_patience;
}

void fuzz_patience(unsigned looks)
{
    looks_left = looks;
    out_of_patience = false;
    sunder_watch(looks ? go_on : NULL, NULL);
}

bool fuzz_is_out_of_patience(void) { return out_of_patience; }

_Noreturn void fuzz_complain(const char *file, int line, const char *statement)
{
    fprintf(stderr, "%s:%d: not so: %s\n", file, line, statement);
    abort();
}

unsigned fuzz_byte(fuzz_bytes *bytes)
{
    if (bytes->left == 0) return 0;
    --bytes->left;
    return *bytes->data++;
}

fuzz_scale fuzz_choose_scale(fuzz_bytes *bytes)
{
    unsigned byte = fuzz_byte(bytes), lot = byte % 8, of_doubles = byte / 8;
    if (lot < 7) return lot < 5 ? FUZZ_GRID : FUZZ_MAP;
    return of_doubles == 16 ? FUZZ_ANY : of_doubles % 16 == 8 ? FUZZ_FAR : FUZZ_NEAR;
}

/* The same number scaled to within this many binary orders of magnitude about one; zeros, infinities and NaN stay. */
static double fold(double value, int orders)
{
    if (value == 0 || !isfinite(value)) return value;
    int exponent;
    const double mantissa = frexp(value, &exponent);
    return ldexp(mantissa, (exponent % orders + orders) % orders - orders / 2 + 1);
}

double fuzz_coordinate(fuzz_bytes *bytes, fuzz_scale scale)
{
    if (scale == FUZZ_GRID) return (double)(fuzz_byte(bytes) % 12);
    if (scale == FUZZ_MAP) {
        unsigned high = fuzz_byte(bytes);
        return 451234.567 + (double)(high * 256 + fuzz_byte(bytes)) / 1000;
    }
    uint8_t raw[sizeof(double)];
    double value;
    for (size_t i = 0; i < sizeof raw; ++i) raw[i] = (uint8_t)fuzz_byte(bytes);
    memcpy(&value, raw, sizeof value);
    return scale == FUZZ_ANY ? value : fold(value, scale == FUZZ_NEAR ? 16 : 64);
}

sunder_shape *fuzz_shape(fuzz_bytes *bytes, fuzz_scale scale, size_t max_vertices)
{
    double xy[2 * MAX_VERTICES];
    size_t ring_end[MAX_RINGS], poly_end[MAX_RINGS], n = 0, rings = 0, polygons = 0;
    const size_t most = scale == FUZZ_ANY             ? MAX_VERTICES_ANY
                        : max_vertices < MAX_VERTICES ? max_vertices
                                                      : MAX_VERTICES;
    unsigned choices = fuzz_byte(bytes);
    size_t wanted = 1 + choices % 3;
    sunder_validity validity = choices & 8 ? SUNDER_VALIDITY_STRICT : SUNDER_VALIDITY_EVEN_ODD;
    for (size_t r = 0; r < wanted; ++r) {
        size_t count = fuzz_byte(bytes) % 11; /* also rings of zero, one and two vertices */
        if (choices & 16) {                   /* a rectangle, since random vertices seldom form a valid ring */
            double x0 = fuzz_coordinate(bytes, scale), y0 = fuzz_coordinate(bytes, scale);
            double x1 = fuzz_coordinate(bytes, scale), y1 = fuzz_coordinate(bytes, scale);
            const double corners[8] = {x0, y0, x1, y0, x1, y1, x0, y1};
            if (n + 4 > most) break;
            memcpy(xy + 2 * n, corners, sizeof corners);
            n += 4;
        } else {
            for (size_t i = 0; i < count && n < most; ++i, ++n) {
                xy[2 * n] = fuzz_coordinate(bytes, scale);
                xy[2 * n + 1] = fuzz_coordinate(bytes, scale);
            }
        }
        ring_end[rings++] = n;
        if (choices & 32) /* each ring becomes a polygon; otherwise a hole of the first */
            poly_end[polygons++] = rings;
    }
    if (!(choices & 32)) poly_end[polygons++] = rings;
    sunder_shape *shape = NULL;
    sunder_error error = {0};
    sunder_status status = sunder_shape_from_rings(xy, ring_end, poly_end, polygons, validity, &shape, &error);
    if (status != SUNDER_OK) {
        FUZZ_DEMAND(shape == NULL);
        FUZZ_DEMAND(status == SUNDER_EINVALID || status == SUNDER_ERANGE || status == SUNDER_ENOMEM ||
                    (status == SUNDER_ECANCEL && fuzz_is_out_of_patience()));
        FUZZ_DEMAND(error.status == status && error.message[0] != '\0');
        FUZZ_DEMAND(memchr(error.message, '\0', sizeof error.message) != NULL);
        return NULL;
    }
    FUZZ_DEMAND(shape != NULL);
    return shape;
}
