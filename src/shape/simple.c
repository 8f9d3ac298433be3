/* simple.c: a sweep over the edges of a polygon that tests whether any two meet except at a common vertex [SH76]. It
 * takes time n log n whatever the boxes of the edges, even if all of them meet, as with long thin spikes; but it only
 * proves that nothing meets: if something does, the pairs must be tested.
 *
 * Vertices are processed in lexicographic order, which is that of a sweep line turned by an infinitely small angle, so
 * that vertical edges are no special case. The edges that the line crosses are sorted from bottom to top, in a
 * randomised search tree (a treap [SA96]) that is also a linked list in that order. Edges that become neighbours are
 * compared. If some edges meet, those through the first point where some do are neighbours just before it, or a vertex
 * is found on an edge when its position is searched; the order is correct until then. */
#include "shape/build.h"

#include "base/random.h"
#include "base/sort.h"
#include "base/watch.h"

typedef struct node {
    uint32_t edge, up, low, high; /* links of the tree; NONE: none */
    uint32_t below, above;        /* the neighbours in the order */
    uint32_t rank;                /* the priority: not greater than those of the nodes below it */
} node;

typedef struct sweep {
    const sunder_i_rings *r;
    uint32_t first;   /* the first vertex */
    uint32_t *order;  /* the vertices in the order of the sweep */
    uint32_t *turn;   /* [vertices, relative to the first one] the position of each in that order */
    node *node;       /* [edges] indexed by the number of the first edge that a node had */
    uint32_t *holder; /* [edges] the node that contains an edge now */
    uint32_t root;
} sweep;

static int by_place(void *context, uint32_t a, uint32_t b)
{
    const sweep *s = context;
    return sunder_i_rings_cmp(s->r, s->first + a, s->first + b);
}

/* Sets *a and *b to the ends of an edge, *a being the first one in the sweep. */
static void edge_ends(const sweep *s, uint32_t edge, uint32_t *a, uint32_t *b)
{
    const uint32_t next = s->r->next[edge];
    const bool forwards = s->turn[edge - s->first] < s->turn[next - s->first];
    *a = forwards ? edge : next;
    *b = forwards ? next : edge;
}

/* Returns whether two edges meet except at a common vertex; true for all collinear edges. */
static bool edges_meet(const sweep *s, uint32_t e, uint32_t f)
{
    const sunder_i_rings *r = s->r;
    const uint32_t a = e, b = r->next[e], g = f, h = r->next[f];
    if (b == g || h == a) return false;
    const int og = sunder_i_rings_orient(r, a, b, g), oh = sunder_i_rings_orient(r, a, b, h);
    if (og * oh > 0) return false;
    if (og == 0 && oh == 0) return true;
    return sunder_i_rings_orient(r, g, h, a) * sunder_i_rings_orient(r, g, h, b) <= 0;
}

static bool neighbours_meet(const sweep *s, uint32_t below, uint32_t above)
{
    return below != SUNDER_I_NONE && above != SUNDER_I_NONE && edges_meet(s, s->node[below].edge, s->node[above].edge);
}

/* ---- The tree ---- */

static void hang_node(sweep *s, uint32_t up, uint32_t old, uint32_t n)
{
    if (up == SUNDER_I_NONE)
        s->root = n;
    else if (s->node[up].low == old)
        s->node[up].low = n;
    else
        s->node[up].high = n;
    if (n != SUNDER_I_NONE) s->node[n].up = up;
}

/* Rotates node n above its parent. */
static void rotate_up(sweep *s, uint32_t n)
{
    node *x = s->node + n;
    const uint32_t up = x->up, over = s->node[up].up;
    node *y = s->node + up;
    uint32_t *inner = y->low == n ? &x->high : &x->low, *outer = y->low == n ? &y->low : &y->high;
    *outer = *inner;
    if (*inner != SUNDER_I_NONE) s->node[*inner].up = up;
    *inner = up;
    y->up = n;
    x->up = over;
    if (over == SUNDER_I_NONE)
        s->root = n;
    else if (s->node[over].low == up)
        s->node[over].low = n;
    else
        s->node[over].high = n;
}

/* Inserts a node for the edge between two neighbours. */
static uint32_t insert_edge(sweep *s, uint32_t edge, uint32_t below, uint32_t above)
{
    const uint32_t n = edge - s->first;
    node *x = s->node + n;
    uint64_t seed = n;
    *x = (node){edge, SUNDER_I_NONE, SUNDER_I_NONE, SUNDER_I_NONE, below, above, (uint32_t)sunder_i_draw(&seed)};
    s->holder[n] = n;
    if (below != SUNDER_I_NONE) s->node[below].above = n;
    if (above != SUNDER_I_NONE) s->node[above].below = n;
    /* of two neighbours one is below the other in the tree and has a free place for the node */
    if (below != SUNDER_I_NONE && s->node[below].high == SUNDER_I_NONE) {
        s->node[below].high = n;
        x->up = below;
    } else if (above != SUNDER_I_NONE) {
        s->node[above].low = n;
        x->up = above;
    } else
        s->root = n;
    while (x->up != SUNDER_I_NONE && s->node[x->up].rank > x->rank) rotate_up(s, n);
    return n;
}

static void take_out(sweep *s, uint32_t n)
{
    node *x = s->node + n;
    while (x->low != SUNDER_I_NONE && x->high != SUNDER_I_NONE)
        rotate_up(s, s->node[x->low].rank < s->node[x->high].rank ? x->low : x->high);
    hang_node(s, x->up, n, x->low != SUNDER_I_NONE ? x->low : x->high);
    if (x->below != SUNDER_I_NONE) s->node[x->below].above = x->above;
    if (x->above != SUNDER_I_NONE) s->node[x->above].below = x->below;
}

/* Finds the neighbours of a vertex at which no edge has ended. Returns false if the vertex is on an edge. */
static bool locate_vertex(const sweep *s, uint32_t v, uint32_t *below, uint32_t *above)
{
    *below = *above = SUNDER_I_NONE;
    for (uint32_t n = s->root; n != SUNDER_I_NONE;) {
        uint32_t a, b;
        edge_ends(s, s->node[n].edge, &a, &b);
        const int side = sunder_i_rings_orient(s->r, a, b, v);
        if (side == 0) return false;
        *(side > 0 ? below : above) = n;
        n = side > 0 ? s->node[n].high : s->node[n].low;
    }
    return true;
}

/* ---- Vertices: each function returns false if edges meet ---- */

/* Both edges of the vertex begin. */
static bool open_corner(sweep *s, uint32_t v)
{
    uint32_t below, above;
    const int turn = sunder_i_rings_orient(s->r, v, s->r->prev[v], s->r->next[v]);
    if (turn == 0 || !locate_vertex(s, v, &below, &above)) return false;
    const uint32_t low = insert_edge(s, turn > 0 ? s->r->prev[v] : v, below, above);
    const uint32_t high = insert_edge(s, turn > 0 ? v : s->r->prev[v], low, above);
    return !neighbours_meet(s, below, low) && !neighbours_meet(s, high, above);
}

/* Both edges of the vertex end. */
static bool close_corner(sweep *s, uint32_t v)
{
    uint32_t low = s->holder[s->r->prev[v] - s->first], high = s->holder[v - s->first];
    if (s->node[low].above != high) {
        const uint32_t swap = low;
        low = high;
        high = swap;
    }
    if (s->node[low].above != high) return false;
    const uint32_t below = s->node[low].below, above = s->node[high].above;
    take_out(s, low);
    take_out(s, high);
    return !neighbours_meet(s, below, above);
}

/* One edge ends and the other continues from it. */
static bool pass_corner(sweep *s, uint32_t old, uint32_t edge)
{
    const uint32_t n = s->holder[old - s->first];
    s->node[n].edge = edge;
    s->holder[edge - s->first] = n;
    return !neighbours_meet(s, s->node[n].below, n) && !neighbours_meet(s, n, s->node[n].above);
}

static bool sweep_corner(sweep *s, uint32_t v)
{
    const uint32_t p = s->r->prev[v], at = s->turn[v - s->first];
    const bool in_begins = s->turn[p - s->first] > at, out_begins = s->turn[s->r->next[v] - s->first] > at;
    if (in_begins && out_begins) return open_corner(s, v);
    if (!in_begins && !out_begins) return close_corner(s, v);
    return in_begins ? pass_corner(s, v, p) : pass_corner(s, p, v);
}

bool sunder_i_rings_simple(const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi, sunder_i_arena *arena)
{
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    sweep s = {.r = r, .first = ring_lo ? r->ring_end[ring_lo - 1] : 0, .root = SUNDER_I_NONE};
    const uint32_t n = r->ring_end[ring_hi - 1] - s.first;
    s.order = sunder_i_arena_alloc(arena, 3 * (size_t)n, sizeof *s.order);
    s.node = sunder_i_arena_alloc(arena, n, sizeof *s.node);
    if (arena->failed) return false;
    s.turn = s.order + n;
    s.holder = s.turn + n;
    for (uint32_t i = 0; i < n; i++) s.order[i] = i;
    if (!sunder_i_sort_indices(s.order, n, by_place, &s)) {
        arena->failed = true;
        return false;
    }
    bool simple = true;
    for (uint32_t i = 0; simple && i < n; i++) {
        s.turn[s.order[i]] = i;
        simple = i == 0 || by_place(&s, s.order[i - 1], s.order[i]) != 0; /* two vertices at one position */
    }
    for (uint32_t i = 0; simple && i < n; i++) {
        simple = sweep_corner(&s, s.first + s.order[i]);
        if (!sunder_i_steps(8)) {
            arena->failed = true;
            return false;
        }
    }
    sunder_i_arena_release(arena, mark);
    return simple;
}
