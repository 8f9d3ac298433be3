#include "expect.h"

#include <gmp.h>
#include <stdlib.h>
#include <string.h>

typedef struct point {
    mpq_t x, y;
} point;

/* A list of directed segments; points are segments of length zero. */
typedef struct pieces {
    point (*end)[2];
    size_t n;
} pieces;

static void read_point(point *p, const json *xy)
{
    mpq_inits(p->x, p->y, NULL);
    if (json_count(xy) != 2 || mpq_set_str(p->x, json_text(&xy->item[0]), 10) ||
        mpq_set_str(p->y, json_text(&xy->item[1]), 10))
        abort();
    mpq_canonicalize(p->x);
    mpq_canonicalize(p->y);
}

static void clear_point(point *p) { mpq_clears(p->x, p->y, NULL); }

static void add_piece(pieces *list, const json *from, const json *to)
{
    list->end = test_resize(list->end, list->n + 1, sizeof *list->end);
    read_point(&list->end[list->n][0], from);
    read_point(&list->end[list->n][1], to);
    list->n++;
}

static void free_pieces(pieces *list)
{
    for (size_t i = 0; i < list->n; i++) {
        clear_point(&list->end[i][0]);
        clear_point(&list->end[i][1]);
    }
    free(list->end);
}

static int point_cmp(const point *a, const point *b)
{
    const int c = mpq_cmp(a->x, b->x);
    return c ? c : mpq_cmp(a->y, b->y);
}

static int piece_cmp(const void *l, const void *r)
{
    const point *a = l, *b = r;
    const int c = point_cmp(&a[0], &b[0]);
    return c ? c : point_cmp(&a[1], &b[1]);
}

static bool same_pieces(pieces *a, pieces *b)
{
    if (a->n != b->n) return false;
    if (a->n) qsort(a->end, a->n, sizeof *a->end, piece_cmp);
    if (b->n) qsort(b->end, b->n, sizeof *b->end, piece_cmp);
    for (size_t i = 0; i < a->n; i++)
        if (piece_cmp(a->end[i], b->end[i])) return false;
    return true;
}

static void add_ring(pieces *list, const json *ring)
{
    for (size_t i = 0; i < json_count(ring); i++)
        add_piece(list, &ring->item[i], &ring->item[i + 1 < ring->n ? i + 1 : 0]);
}

/* A record does not determine the order of the ends of degenerate segments. */
static void put_in_order(pieces *list)
{
    for (size_t i = 0; i < list->n; i++)
        if (point_cmp(&list->end[i][0], &list->end[i][1]) > 0) {
            const point t = list->end[i][0];
            list->end[i][0] = list->end[i][1];
            list->end[i][1] = t;
        }
}

static void twice_area(mpq_t sum, const pieces *boundary)
{
    mpq_t s, t;
    mpq_inits(s, t, NULL);
    mpq_set_ui(sum, 0, 1);
    for (size_t i = 0; i < boundary->n; i++) {
        const point *e = boundary->end[i];
        mpq_mul(s, e[0].x, e[1].y);
        mpq_mul(t, e[0].y, e[1].x);
        mpq_sub(s, s, t);
        mpq_add(sum, sum, s);
    }
    mpq_clears(s, t, NULL);
}

static void boundary_of(pieces *list, const json *sum, size_t *rings)
{
    const json *polygons = json_get(sum, "polygons");
    for (size_t i = 0; i < json_count(polygons); i++) {
        const json *holes = json_get(&polygons->item[i], "holes");
        add_ring(list, json_get(&polygons->item[i], "outer"));
        for (size_t h = 0; h < json_count(holes); h++) add_ring(list, &holes->item[h]);
        *rings += 1 + json_count(holes);
    }
}

char *expect_area(const json *sum)
{
    pieces boundary = {NULL, 0};
    size_t rings = 0;
    mpq_t area;
    mpq_init(area);
    boundary_of(&boundary, sum, &rings);
    twice_area(area, &boundary);
    mpq_div_2exp(area, area, 1);
    char *text = mpq_get_str(NULL, 10, area), *own = test_format("%s", text);
    free(text);
    mpq_clear(area);
    free_pieces(&boundary);
    return own;
}

static bool same_number(const char *a, const char *b)
{
    mpq_t x, y;
    mpq_inits(x, y, NULL);
    if (mpq_set_str(x, a, 10) || mpq_set_str(y, b, 10)) abort();
    mpq_canonicalize(x);
    mpq_canonicalize(y);
    const bool same = mpq_equal(x, y) != 0;
    mpq_clears(x, y, NULL);
    return same;
}

static char *compare_boundary(const json *sum, const json *record)
{
    pieces ours = {NULL, 0}, theirs = {NULL, 0};
    size_t rings = 0;
    char *complaint = NULL;
    boundary_of(&ours, sum, &rings);
    const json *list = json_get(record, "result_rings");
    for (size_t i = 0; i < json_count(list); i++) add_ring(&theirs, json_get(&list->item[i], "pts"));
    const bool touching = atoi(json_text(json_get(record, "touch_vertices"))) > 0;
    const size_t known = strtoul(json_text(json_get(record, "outer")), NULL, 10) +
                         strtoul(json_text(json_get(record, "holes")), NULL, 10);
    /* For a very large number of rings a record only gives the number. */
    if (json_count(list) && !same_pieces(&ours, &theirs))
        complaint = test_format("boundary: %zu edges, not the same as the %zu known", ours.n, theirs.n);
    else if (!touching && rings != known)
        complaint = test_format("%zu rings, not %zu", rings, known);
    free_pieces(&ours);
    free_pieces(&theirs);
    return complaint;
}

static char *compare_degenerate(const json *sum, const json *record)
{
    pieces ours = {NULL, 0}, theirs = {NULL, 0}, our_points = {NULL, 0}, their_points = {NULL, 0};
    char *complaint = NULL;
    const json *s = json_get(sum, "degenerate_segments"), *t = json_get(record, "segments");
    const json *p = json_get(sum, "degenerate_points"), *q = json_get(record, "points");
    for (size_t i = 0; i < json_count(s); i++) add_piece(&ours, &s->item[i].item[0], &s->item[i].item[1]);
    for (size_t i = 0; i < json_count(t); i++)
        add_piece(&theirs, json_get(&t->item[i], "a"), json_get(&t->item[i], "b"));
    for (size_t i = 0; i < json_count(p); i++) add_piece(&our_points, &p->item[i], &p->item[i]);
    for (size_t i = 0; i < json_count(q); i++) add_piece(&their_points, &q->item[i], &q->item[i]);
    put_in_order(&theirs);
    if (!same_pieces(&ours, &theirs))
        complaint = test_format("degenerate segments: %zu, not the %zu known", ours.n, theirs.n);
    else if (!same_pieces(&our_points, &their_points))
        complaint = test_format("degenerate points: %zu, not the %zu known", our_points.n, their_points.n);
    free_pieces(&ours);
    free_pieces(&theirs);
    free_pieces(&our_points);
    free_pieces(&their_points);
    return complaint;
}

char *expect_compare(const char *sum_text, const json *record)
{
    json *sum = json_read(sum_text);
    if (!sum) return test_format("not JSON: %.60s", sum_text);
    char *area = expect_area(sum), *complaint = NULL;
    const char *known = json_text(json_get(record, "area"));
    if (!same_number(area, known)) complaint = test_format("area %s, not %s", area, known);
    if (!complaint) complaint = compare_boundary(sum, record);
    if (!complaint) complaint = compare_degenerate(sum, record);
    free(area);
    json_free(sum);
    return complaint;
}
