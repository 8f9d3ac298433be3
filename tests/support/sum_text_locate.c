/* Locates a point relative to a canonical sum, from the text of the sum alone. */
#include "json.h"
#include "sum_text.h"

#include <gmp.h>
#include <stdlib.h>

typedef struct place {
    mpq_t x, y;
} place;

static void place_read(place *p, const json *xy)
{
    mpq_inits(p->x, p->y, NULL);
    if (mpq_set_str(p->x, json_text(&xy->item[0]), 10) || mpq_set_str(p->y, json_text(&xy->item[1]), 10)) abort();
}

static void place_clear(place *p) { mpq_clears(p->x, p->y, NULL); }

/* Sign of cross(b - a, p - a). */
static int side(const place *a, const place *b, const place *p)
{
    mpq_t s, t, u;
    mpq_inits(s, t, u, NULL);
    mpq_sub(s, b->x, a->x);
    mpq_sub(u, p->y, a->y);
    mpq_mul(s, s, u);
    mpq_sub(t, b->y, a->y);
    mpq_sub(u, p->x, a->x);
    mpq_mul(t, t, u);
    const int sign = mpq_cmp(s, t);
    mpq_clears(s, t, u, NULL);
    return sign;
}

static bool between(const mpq_t a, const mpq_t b, const mpq_t v)
{
    const int s = mpq_cmp(a, v), t = mpq_cmp(b, v);
    return (s <= 0 && t >= 0) || (s >= 0 && t <= 0);
}

static bool on_segment(const json *from, const json *to, const place *p)
{
    place a, b;
    place_read(&a, from);
    place_read(&b, to);
    const bool on = side(&a, &b, p) == 0 && between(a.x, b.x, p->x) && between(a.y, b.y, p->y);
    place_clear(&a);
    place_clear(&b);
    return on;
}

/* Returns +1 inside, 0 on, -1 outside. */
static int locate(const json *ring, const place *p)
{
    bool in = false;
    for (size_t i = 0; i < json_count(ring); i++) {
        const json *from = &ring->item[i], *to = &ring->item[i + 1 < ring->n ? i + 1 : 0];
        if (on_segment(from, to, p)) return 0;
        place a, b;
        place_read(&a, from);
        place_read(&b, to);
        const bool up = mpq_cmp(a.y, p->y) <= 0, vp = mpq_cmp(b.y, p->y) <= 0;
        if (up != vp && (up ? side(&a, &b, p) > 0 : side(&a, &b, p) < 0)) in = !in;
        place_clear(&a);
        place_clear(&b);
    }
    return in ? 1 : -1;
}

static bool covers(const json *sum, const place *p)
{
    const json *segments = json_get(sum, "degenerate_segments"), *points = json_get(sum, "degenerate_points");
    for (size_t i = 0; i < json_count(segments); i++)
        if (on_segment(&segments->item[i].item[0], &segments->item[i].item[1], p)) return false;
    for (size_t i = 0; i < json_count(points); i++)
        if (on_segment(&points->item[i], &points->item[i], p)) return false;
    const json *polygons = json_get(sum, "polygons");
    for (size_t i = 0; i < json_count(polygons); i++) {
        const json *holes = json_get(&polygons->item[i], "holes");
        if (locate(json_get(&polygons->item[i], "outer"), p) <= 0) continue;
        bool in = true;
        for (size_t h = 0; h < json_count(holes) && in; h++) in = locate(&holes->item[h], p) < 0;
        if (in) return true;
    }
    return false;
}

bool sum_text_covers(const char *text, const char *x, const char *y)
{
    json *sum = json_read(text);
    place p;
    mpq_inits(p.x, p.y, NULL);
    if (!sum || mpq_set_str(p.x, x, 10) || mpq_set_str(p.y, y, 10)) abort();
    mpq_canonicalize(p.x);
    mpq_canonicalize(p.y);
    const bool in = covers(sum, &p);
    place_clear(&p);
    json_free(sum);
    return in;
}
