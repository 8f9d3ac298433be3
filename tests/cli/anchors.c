/* Reads lines "NAME POLYGONS { RINGS { CORNERS { x y } } }" and prints "NAME x y" of each anchor. The rule says "an
 * interior point", and the library chooses; rules.py asks for its choice here, and sees for itself that it is one. */
#include "sunder.h"

#include <stdio.h>
#include <stdlib.h>

enum { MOST = 1 << 18 };

typedef struct reader {
    char *at;
    double xy[2 * MOST];
    size_t ring_end[MOST], poly_end[MOST];
} reader;

static size_t read_count(reader *r) { return (size_t)strtoul(r->at, &r->at, 10); }

/* False where there is too much of it. */
static bool read_set(reader *r, size_t *polygons)
{
    size_t rings = 0, corners = 0;
    *polygons = read_count(r);
    for (size_t p = 0; p < *polygons; p++) {
        const size_t more = read_count(r);
        for (size_t k = 0; k < more; k++) {
            const size_t n = read_count(r);
            if (n + corners > MOST || rings == MOST || *polygons > MOST) return false;
            for (size_t c = 0; c < 2 * n; c++) r->xy[2 * corners + c] = strtod(r->at, &r->at);
            corners += n;
            r->ring_end[rings++] = corners;
        }
        r->poly_end[p] = rings;
    }
    return true;
}

int main(void)
{
    static reader r;
    char *line = NULL;
    size_t room = 0;
    while (getline(&line, &room, stdin) > 0) {
        size_t polygons;
        sunder_shape *shape = NULL;
        sunder_error err;
        double anchor[2];
        const unsigned long name = strtoul(line, &r.at, 10);
        if (!read_set(&r, &polygons)) {
            fprintf(stderr, "anchors: %lu is too large\n", name);
            return 2;
        }
        if (sunder_shape_from_rings(r.xy, r.ring_end, r.poly_end, polygons, SUNDER_VALIDITY_EVEN_ODD, &shape, &err)) {
            fprintf(stderr, "anchors: %lu: %s\n", name, err.message);
            return 2;
        }
        sunder_shape_anchor(shape, anchor);
        printf("%lu %a %a\n", name, anchor[0], anchor[1]);
        sunder_shape_free(shape);
    }
    free(line);
    return 0;
}
