#include "family.h"

#include <inttypes.h>
#include <stdlib.h>

void *family_room(void *old, size_t n, size_t size)
{
    void *grown = n <= SIZE_MAX / size ? realloc(old, n * size) : NULL;
    if (!grown) {
        fputs("sunder-families: error: out of memory\n", stderr);
        exit(1);
    }
    return grown;
}

void family_vertex(family_set *set, int64_t x, int64_t y)
{
    if (set->vertices == set->vertex_room) {
        set->vertex_room = 2 * set->vertex_room + 16;
        set->xy = family_room(set->xy, 2 * set->vertex_room, sizeof *set->xy);
    }
    set->xy[2 * set->vertices] = x;
    set->xy[2 * set->vertices + 1] = y;
    set->vertices++;
}

void family_end_member(family_set *set)
{
    if (set->members == set->member_room) {
        set->member_room = 2 * set->member_room + 4;
        set->end = family_room(set->end, set->member_room, sizeof *set->end);
    }
    set->end[set->members++] = set->vertices;
}

void family_rectangle(family_set *set, int64_t x0, int64_t y0, int64_t x1, int64_t y1)
{
    family_vertex(set, x0, y0);
    family_vertex(set, x1, y0);
    family_vertex(set, x1, y1);
    family_vertex(set, x0, y1);
    family_end_member(set);
}

void family_set_free(family_set *set)
{
    free(set->xy);
    free(set->end);
    *set = (family_set){0};
}

/* units is 1, or a power of two or ten up to a thousand: three decimals hold it exactly. */
static void print_coordinate(int64_t v, int64_t units, FILE *out)
{
    if (units == 1) {
        fprintf(out, "%" PRId64, v);
        return;
    }
    const int64_t size = v < 0 ? -v : v;
    fprintf(out, "%s%" PRId64 ".%03" PRId64, v < 0 ? "-" : "", size / units, size % units * 1000 / units);
}

static void print_vertex(const family_set *set, size_t i, const family_place *place, FILE *out)
{
    print_coordinate(place->x + set->xy[2 * i], place->units, out);
    putc(' ', out);
    print_coordinate(place->y + set->xy[2 * i + 1], place->units, out);
}

bool family_print(const family_set *set, const family_place *place, FILE *out)
{
    fputs("MULTIPOLYGON(", out);
    for (size_t m = 0, start = 0; m < set->members; start = set->end[m++]) {
        fputs(m ? ",((" : "((", out);
        for (size_t i = start; i < set->end[m]; i++) {
            print_vertex(set, i, place, out);
            putc(',', out);
        }
        print_vertex(set, start, place, out);
        fputs("))", out);
    }
    fputs(")\n", out);
    return !ferror(out);
}

void family_direction(double turn, double *x, double *y)
{
    const double quarters = 4 * turn;
    const int q = (int)quarters;
    const double s = quarters - q;
    const double t = s * (0.7854 + 0.2146 * s * s); /* close to the tangent of s / 8 of a turn, and as increasing */
    const double d = 1 + t * t, c = (1 - t * t) / d, e = 2 * t / d;
    *x = q == 0 ? c : q == 1 ? -e : q == 2 ? -c : e;
    *y = q == 0 ? e : q == 1 ? c : q == 2 ? -e : -c;
}

int64_t family_integer(town_random *random, int64_t low, int64_t high)
{
    return low + (int64_t)(town_random_next(random) % (uint64_t)(high - low + 1));
}
