#include "sum_text.h"

#include "failing.h"
#include "json.h"
#include "minkowski/minkowski.h"

#include <float.h>
#include <gmp.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Text of the library ---- */

/* Is d a double nearest to the rational r? Infinite from the midpoint of the greatest double and 2^1024 on. */
static bool is_nearest(double d, const mpq_t r)
{
    mpq_t x, gap, other;
    bool nearest = true;
    mpq_inits(x, gap, other, NULL);
    if (isinf(d)) {
        mpq_set_d(x, DBL_MAX);
        mpq_set_d(gap, 0x1p970);
        mpq_add(x, x, gap);
        mpq_abs(other, r);
        nearest = mpq_cmp(other, x) >= 0 && (mpq_sgn(r) < 0) == (d < 0);
        mpq_clears(x, gap, other, NULL);
        return nearest;
    }
    mpq_set_d(x, d);
    mpq_sub(gap, x, r);
    mpq_abs(gap, gap);
    for (int up = 0; up < 2; up++) {
        const double n = nextafter(d, up ? INFINITY : -INFINITY);
        if (!isfinite(n)) continue;
        mpq_set_d(other, n);
        mpq_sub(other, other, r);
        mpq_abs(other, other);
        if (mpq_cmp(other, gap) < 0) nearest = false;
    }
    mpq_clears(x, gap, other, NULL);
    return nearest;
}

/* Is `off` an upper bound of the distance of xy from the exact place, and not a much too large one? */
static bool is_bound(double off, const double xy[2], mpq_t place[2])
{
    const double ulp =
        fmax(nextafter(fabs(xy[0]), INFINITY) - fabs(xy[0]), nextafter(fabs(xy[1]), INFINITY) - fabs(xy[1]));
    const double less = off - ldexp(ulp, -30);
    mpq_t squared, d, bound;
    mpq_inits(squared, d, bound, NULL);
    for (int k = 0; k < 2; k++) {
        mpq_set_d(d, xy[k]);
        mpq_sub(d, d, place[k]);
        mpq_mul(d, d, d);
        mpq_add(squared, squared, d);
    }
    mpq_set_d(bound, off);
    mpq_mul(bound, bound, bound);
    bool good = mpq_cmp(bound, squared) >= 0 && (off == 0 || mpq_sgn(squared) > 0);
    if (less > 0) {
        mpq_set_d(bound, less * (1 - 0x1p-30));
        mpq_mul(bound, bound, bound);
        good = good && mpq_cmp(bound, squared) <= 0;
    }
    mpq_clears(squared, d, bound, NULL);
    return good;
}

/* The nearest doubles, computed by both functions, and their reported deviation. */
static bool doubles_are_right(const sunder_sum *sum, uint32_t v, mpq_t place[2])
{
    double one[2], all[2], off = 0;
    sunder_sum_vertex(sum, v, one);
    if (sunder_sum_vertices(sum, &v, 1, all, &off, NULL) != SUNDER_OK) return false;
    bool finite = true;
    for (int k = 0; k < 2; k++) {
        if (one[k] != all[k] || !is_nearest(one[k], place[k])) return false;
        finite = finite && isfinite(one[k]);
    }
    return finite ? is_bound(off, one, place) : isinf(off);
}

static bool put_vertex(FILE *f, const sunder_sum *sum, uint32_t v)
{
    char *text[2];
    if (sunder_sum_vertex_text(sum, v, &text[0], &text[1], NULL) != SUNDER_OK) return false;
    mpq_t place[2];
    mpq_inits(place[0], place[1], NULL);
    const bool ok = mpq_set_str(place[0], text[0], 10) == 0 && mpq_set_str(place[1], text[1], 10) == 0 &&
                    doubles_are_right(sum, v, place);
    mpq_clears(place[0], place[1], NULL);
    fprintf(f, "[\"%s\", \"%s\"]", text[0], text[1]);
    sunder_free(text[0]);
    sunder_free(text[1]);
    return ok;
}

static bool put_ring(FILE *f, const sunder_sum *sum, size_t polygon, size_t ring, size_t *vertices)
{
    size_t n;
    bool ok = true;
    const uint32_t *v = sunder_sum_ring(sum, polygon, ring, &n);
    fputc('[', f);
    for (size_t i = 0; i < n; i++) {
        if (i) fputs(", ", f);
        ok = put_vertex(f, sum, v[i]) && ok;
    }
    fputc(']', f);
    *vertices += n;
    return ok && n >= 3;
}

static bool put_sum(FILE *f, const sunder_sum *sum)
{
    sunder_sum_size c;
    size_t holes = 0, vertices = 0;
    bool ok = true;
    sunder_sum_get_size(sum, &c);
    fputs("{\"polygons\": [", f);
    for (size_t p = 0; p < c.polygons; p++) {
        const size_t rings = sunder_sum_rings(sum, p);
        fputs(p ? ", {\"outer\": " : "{\"outer\": ", f);
        ok = rings > 0 && put_ring(f, sum, p, 0, &vertices) && ok;
        fputs(", \"holes\": [", f);
        for (size_t r = 1; r < rings; r++) {
            if (r > 1) fputs(", ", f);
            ok = put_ring(f, sum, p, r, &vertices) && ok;
        }
        fputs("]}", f);
        holes += rings - 1;
    }
    fputs("], \"degenerate_segments\": [", f);
    for (size_t i = 0; i < c.degenerate_segments; i++) {
        uint32_t ends[2];
        sunder_sum_segment(sum, i, ends);
        fputs(i ? ", [" : "[", f);
        ok = put_vertex(f, sum, ends[0]) && ok;
        fputs(", ", f);
        ok = put_vertex(f, sum, ends[1]) && ok;
        fputc(']', f);
    }
    fputs("], \"degenerate_points\": [", f);
    for (size_t i = 0; i < c.degenerate_points; i++) {
        if (i) fputs(", ", f);
        ok = put_vertex(f, sum, sunder_sum_point(sum, i)) && ok;
    }
    fputs("]}", f);
    if (holes != c.holes || vertices != c.vertices) {
        fprintf(stderr, "counts: %zu holes, %zu vertices; the rings have %zu, %zu\n", c.holes, c.vertices, holes,
                vertices);
        return false;
    }
    return ok;
}

char *sum_text(const sunder_sum *sum)
{
    char *text = NULL;
    size_t size;
    FILE *f = open_memstream(&text, &size);
    if (!f) abort();
    const bool ok = put_sum(f, sum);
    fclose(f);
    if (ok) return text;
    fprintf(stderr, "a sum whose getters do not agree: %s\n", text);
    free(text);
    return NULL;
}

static char *sum_text_of(const polyset *p, const polyset *q, bool wide)
{
    sunder_shape *a = polyset_shape(p), *b = a ? polyset_shape(q) : NULL;
    sunder_sum *sum = NULL;
    sunder_error err;
    char *text = NULL;
    if (a && b) {
        if (sunder_i_minkowski_sum(a, b, wide, NULL, &sum, &err) == SUNDER_OK)
            text = sum_text(sum);
        else
            fprintf(stderr, "no sum: %s\n", err.message);
    }
    sunder_sum_free(sum);
    sunder_shape_free(a);
    sunder_shape_free(b);
    return text;
}

char *library_sum_text(const polyset *p, const polyset *q) { return sum_text_of(p, q, false); }

char *library_sum_text_wide(const polyset *p, const polyset *q) { return sum_text_of(p, q, true); }

static sunder_status make_shape(const polyset *s, sunder_shape **out)
{
    return sunder_shape_from_rings(s->xy, s->ring_end, s->poly_end, s->polygons, SUNDER_VALIDITY_STRICT, out, NULL);
}

static bool make_sum(void *context)
{
    const polyset *operand = context;
    sunder_shape *a = NULL, *b = NULL;
    sunder_sum *sum = NULL;
    sunder_status status = make_shape(&operand[0], &a);
    if (!status) status = make_shape(&operand[1], &b);
    if (!status) status = sunder_minkowski_sum(a, b, NULL, &sum, NULL);
    sunder_sum_free(sum);
    sunder_shape_free(a);
    sunder_shape_free(b);
    return status == SUNDER_OK;
}

bool library_sum_survives(const polyset operand[2]) { return failing_loop(make_sum, (void *)operand, false); }

/* ---- Laws ---- */

static void put_rational(FILE *f, const mpq_t r)
{
    char *text = mpq_get_str(NULL, 10, r);
    fprintf(f, "\"%s\"", text);
    free(text);
}

static void read_rational(mpq_t r, const json *text)
{
    if (mpq_set_str(r, json_text(text), 10)) abort();
    mpq_canonicalize(r);
}

/* Multiplied by factor * 2^scale, plus (by[0], by[1]). */
typedef struct motion {
    long factor, scale;
    double by[2];
} motion;

/* Copies a text and transforms its coordinates, which are the strings; the position in a pair determines the axis. */
static void put_moved(FILE *f, const json *v, const motion *m, int axis)
{
    mpq_t r, d;
    switch (v->kind) {
    case JSON_OBJECT:
        fputc('{', f);
        for (size_t i = 0; i < v->n; i++) {
            fprintf(f, "%s\"%s\": ", i ? ", " : "", v->item[i].name);
            put_moved(f, &v->item[i], m, 0);
        }
        fputc('}', f);
        break;
    case JSON_ARRAY:
        fputc('[', f);
        for (size_t i = 0; i < v->n; i++) {
            if (i) fputs(", ", f);
            put_moved(f, &v->item[i], m, (int)(i & 1));
        }
        fputc(']', f);
        break;
    default:
        mpq_inits(r, d, NULL);
        read_rational(r, v);
        if (m->scale >= 0)
            mpq_mul_2exp(r, r, (mp_bitcnt_t)m->scale);
        else
            mpq_div_2exp(r, r, (mp_bitcnt_t)-m->scale);
        mpq_set_si(d, m->factor, 1);
        mpq_mul(r, r, d);
        mpq_set_d(d, m->by[axis]);
        mpq_add(r, r, d);
        put_rational(f, r);
        mpq_clears(r, d, NULL);
    }
}

static char *moved(const char *text, const motion *m)
{
    json *v = json_read(text);
    char *out = NULL;
    size_t size;
    FILE *f = open_memstream(&out, &size);
    if (!f || !v) abort();
    put_moved(f, v, m, 0);
    fclose(f);
    json_free(v);
    return out;
}

char *sum_text_moved(const char *text, long scale, double dx, double dy)
{
    const motion m = {1, scale, {dx, dy}};
    return moved(text, &m);
}

char *sum_text_times(const char *text, long k)
{
    const motion m = {k, 0, {0, 0}};
    return moved(text, &m);
}

/* ---- Hulls: Andrew's monotone chain in rationals ---- */

typedef struct spot {
    mpq_t x, y;
    size_t number;
} spot;

static int spot_cmp(const void *l, const void *r)
{
    const spot *a = l, *b = r;
    const int c = mpq_cmp(a->x, b->x);
    return c ? c : mpq_cmp(a->y, b->y);
}

static int turn(const spot *a, const spot *b, const spot *c)
{
    mpq_t s, t, u;
    mpq_inits(s, t, u, NULL);
    mpq_sub(s, b->x, a->x);
    mpq_sub(t, c->y, a->y);
    mpq_mul(s, s, t);
    mpq_sub(t, b->y, a->y);
    mpq_sub(u, c->x, a->x);
    mpq_mul(t, t, u);
    const int sign = mpq_cmp(s, t);
    mpq_clears(s, t, u, NULL);
    return sign;
}

/* The corners of the hull, counter-clockwise from the smallest; returns their number. The spots are sorted. */
static size_t hull(spot *s, size_t n, size_t *corner)
{
    size_t k = 0, low = 0;
    qsort(s, n, sizeof *s, spot_cmp);
    for (size_t pass = 0; pass < 2; pass++) {
        for (size_t i = 0; i < n; i++) {
            const size_t c = pass ? n - 1 - i : i;
            while (k >= low + 2 && turn(&s[corner[k - 2]], &s[corner[k - 1]], &s[c]) <= 0) k--;
            if (k && spot_cmp(&s[corner[k - 1]], &s[c]) == 0) continue;
            corner[k++] = c;
        }
        low = k - 1;
    }
    return k - 1;
}

static void clear_spots(spot *s, size_t n)
{
    for (size_t i = 0; i < n; i++) mpq_clears(s[i].x, s[i].y, NULL);
    free(s);
}

void polyset_hull(polyset *out, const polyset *set)
{
    spot *s = test_alloc(set->vertices, sizeof *s);
    size_t *corner = test_alloc(2 * set->vertices + 2, sizeof *corner);
    for (size_t i = 0; i < set->vertices; i++) {
        mpq_inits(s[i].x, s[i].y, NULL);
        mpq_set_d(s[i].x, set->xy[2 * i]);
        mpq_set_d(s[i].y, set->xy[2 * i + 1]);
        s[i].number = i;
    }
    const size_t n = hull(s, set->vertices, corner);
    polyset_init(out);
    for (size_t i = 0; i < n; i++)
        polyset_vertex(out, set->xy[2 * s[corner[i]].number], set->xy[2 * s[corner[i]].number + 1]);
    polyset_end_ring(out);
    polyset_end_polygon(out);
    free(corner);
    clear_spots(s, set->vertices);
}

char *sum_text_hull(const char *text)
{
    json *v = json_read(text);
    const json *polygons = json_get(v, "polygons");
    spot *s = NULL;
    size_t n = 0, size;
    for (size_t p = 0; p < json_count(polygons); p++) {
        const json *outer = json_get(&polygons->item[p], "outer");
        s = test_resize(s, n + json_count(outer), sizeof *s);
        for (size_t i = 0; i < json_count(outer); i++, n++) {
            mpq_inits(s[n].x, s[n].y, NULL);
            read_rational(s[n].x, &outer->item[i].item[0]);
            read_rational(s[n].y, &outer->item[i].item[1]);
        }
    }
    json_free(v);
    size_t *corner = test_alloc(2 * n + 2, sizeof *corner);
    const size_t k = n ? hull(s, n, corner) : 0;
    char *ring = NULL;
    FILE *f = open_memstream(&ring, &size);
    if (!f) abort();
    fputc('[', f);
    for (size_t i = 0; i < k; i++) {
        fputs(i ? ", [" : "[", f);
        put_rational(f, s[corner[i]].x);
        fputs(", ", f);
        put_rational(f, s[corner[i]].y);
        fputc(']', f);
    }
    fputc(']', f);
    fclose(f);
    free(corner);
    clear_spots(s, n);
    return ring;
}

char *sum_text_only_ring(const char *text)
{
    json *v = json_read(text);
    const json *polygons = json_get(v, "polygons");
    const bool one = json_count(polygons) == 1 && json_count(json_get(&polygons->item[0], "holes")) == 0;
    json_free(v);
    const char *start = strstr(text, "\"outer\": "), *end = strstr(text, ", \"holes\"");
    if (!one || !start || !end) return NULL;
    start += strlen("\"outer\": ");
    return test_format("%.*s", (int)(end - start), start);
}
