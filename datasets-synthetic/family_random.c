/* Random simple polygons by space partitioning (Auer and Held, "Heuristics for the generation of random polygons", CCCG
 * 1996).
 *
 * A chain from a to b has to visit a set S that lies in a convex region with a and b on its rim. Pick c in S and a line
 * through c that crosses the segment ab and meets no other point: the points on a's side go between a and c, those on
 * b's between c and b. Both lie in convex regions again, which meet only in the line, so chains never cross. Ragged,
 * simple by construction, and found in O(n log n) steps on average. */
#include "family.h"

#include <stdlib.h>

typedef struct place {
    int64_t x, y;
} place;

typedef struct chain {
    place a, b;
    size_t low, high; /* S: places low..high-1 */
} chain;

enum { STEPS = 64 }; /* a line crosses ab at one of STEPS - 1 places */

/* Side of p to the line through c and the point of ab that divides it as step to STEPS - step. Products stay below 2^63
 * for spans up to 2^28. */
static int side(const place *p, const place *c, const place *a, const place *b, int64_t step)
{
    const int64_t dx = a->x * (STEPS - step) + b->x * step - c->x * STEPS;
    const int64_t dy = a->y * (STEPS - step) + b->y * step - c->y * STEPS;
    const int64_t left = dx * (p->y - c->y), right = dy * (p->x - c->x);
    return (left > right) - (left < right);
}

static void swap(place *a, place *b)
{
    const place t = *a;
    *a = *b;
    *b = t;
}

/* Orders places low..high-1 by their side to the line, those with side `first` before the others; the number of them in
 * *split. False if one lies on the line. */
static bool part(place *places, size_t low, size_t high, const place *c, const place *a, const place *b, int64_t step,
                 int first, size_t *split)
{
    size_t end = low;
    for (size_t i = low; i < high; i++) {
        const int s = side(&places[i], c, a, b, step);
        if (s == 0) return false;
        if (s == first) swap(&places[i], &places[end++]);
    }
    *split = end;
    return true;
}

/* Divides a chain with S not empty: c, now at places[low], S's parts in low+1..split-1 and split..high-1. */
static place divide(place *places, const chain *t, town_random *random, size_t *split)
{
    for (;;) {
        swap(&places[t->low], &places[t->low + (size_t)family_integer(random, 0, (int64_t)(t->high - t->low) - 1)]);
        const place c = places[t->low];
        const int64_t step = family_integer(random, 1, STEPS - 1);
        const int first = side(&t->a, &c, &t->a, &t->b, step);
        if (first != 0 && part(places, t->low + 1, t->high, &c, &t->a, &t->b, step, first, split)) return c;
    }
}

static void visit(family_set *set, place *places, chain *stack, chain whole, town_random *random)
{
    size_t depth = 0;
    stack[depth++] = whole;
    while (depth) {
        const chain t = stack[--depth];
        if (t.low == t.high) {
            family_vertex(set, t.b.x, t.b.y);
            continue;
        }
        size_t split;
        const place c = divide(places, &t, random, &split);
        stack[depth++] = (chain){c, t.b, split, t.high};
        stack[depth++] = (chain){t.a, c, t.low + 1, split};
    }
}

/* No two places have the same x, so a line through one of them misses the others sooner or later. */
static void draw_places(place *places, size_t n, town_random *random)
{
    const int64_t share = 1000000 / (int64_t)n > 100 ? 1000000 / (int64_t)n : 100, span = share * (int64_t)n;
    for (size_t i = 0; i < n; i++)
        places[i] =
            (place){(int64_t)i * share + family_integer(random, 0, share - 1), family_integer(random, 0, span - 1)};
    for (size_t i = n; i > 1; i--) swap(&places[i - 1], &places[(size_t)family_integer(random, 0, (int64_t)i - 1)]);
}

static void random_member(family_set *set, size_t n, town_random *random)
{
    place *places = family_room(NULL, n, sizeof *places);
    chain *stack = family_room(NULL, n + 1, sizeof *stack); /* a chain for each place not yet visited, and one */
    size_t split;
    do draw_places(places, n, random);
    while (!part(places, 2, n, &places[0], &places[1], &places[1], 0, -1, &split));
    const place a = places[0], b = places[1];
    visit(set, places, stack, (chain){a, b, 2, split}, random); /* right of ab on the way there, left on the way back */
    visit(set, places, stack, (chain){b, a, split, n}, random);
    family_end_member(set);
    free(places);
    free(stack);
}

/* random + random: the arrangement beneath is enormous and nearly all of it covered. */
void family_random(family_set *p, family_set *q, size_t m, size_t n, family_streams *streams)
{
    random_member(p, m, &streams->p);
    random_member(q, n, &streams->q);
}
