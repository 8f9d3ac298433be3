/* history.c: the history: all trapezoids that have existed, and which trapezoids replaced them [Mul90, Sei91; BKOS08,
 * section 6.2].
 *
 * A leaf is a trapezoid that exists. When one is removed, its leaf becomes a node that distinguishes its successors: by
 * a vertex whose wall was inserted (AT), or by the line of an edge that was drawn through it (BY). If several
 * trapezoids were merged, several nodes lead to one leaf. Removals extend the history, too: a trapezoid along a removed
 * edge is succeeded by a row of trapezoids, which are distinguished by the vertices between them; one that lost a wall
 * is succeeded by its union with the neighbour (ALIAS). Nodes refer to lines and vertices, never to edges: an edge may
 * be split or removed before the node is evaluated, but its line does not change.
 *
 * A query point is treated as if it were moved up by an infinitesimal, and right by an infinitesimal of higher order:
 * so a point on a line is above it, a point at a vertex is right of it, and both are the same symbolic point
 * everywhere. */
#include "planar_map/map.h"

static uint32_t add_node(sunder_i_planar_map *map, unsigned kind, uint32_t of, uint32_t a, uint32_t b)
{
    map->node[map->nodes] = (sunder_i_history_node){.kind = kind & 3, .of = of & 0x3fffffff, .a = a, .b = b};
    return map->nodes++;
}

static void set_node(sunder_i_planar_map *map, uint32_t node, unsigned kind, uint32_t of, uint32_t a, uint32_t b)
{
    map->node[node] = (sunder_i_history_node){.kind = kind & 3, .of = of & 0x3fffffff, .a = a, .b = b};
}

uint32_t sunder_i_history_leaf(sunder_i_planar_map *map, uint32_t trapezoid)
{
    return map->trapezoid[trapezoid].node = add_node(map, SUNDER_I_LEAF, 0, trapezoid, NOWHERE);
}

void sunder_i_history_at(sunder_i_planar_map *map, uint32_t node, uint32_t vertex, uint32_t smaller, uint32_t greater)
{
    set_node(map, node, SUNDER_I_AT, vertex, smaller, greater);
}

void sunder_i_history_by(sunder_i_planar_map *map, uint32_t node, uint32_t line, uint32_t below, uint32_t above)
{
    set_node(map, node, SUNDER_I_BY, line, below, above);
}

void sunder_i_history_alias(sunder_i_planar_map *map, uint32_t node, uint32_t to)
{
    set_node(map, node, SUNDER_I_ALIAS, 0, to, NOWHERE);
}

/* A tree over t[low .. high): its root is `node`; a half that is a single trapezoid is that trapezoid's leaf. Pending
 * ranges are on a stack, which is never larger than the depth of the tree. */
void sunder_i_history_row(sunder_i_planar_map *map, uint32_t node, const uint32_t *t, size_t n)
{
    typedef struct range {
        uint32_t node;
        size_t low, high;
    } range;
    range stack[64], *top = stack;
    if (n == 1) {
        sunder_i_history_alias(map, node, map->trapezoid[t[0]].node);
        return;
    }
    *top++ = (range){node, 0, n};
    while (top > stack) {
        top--;
        const uint32_t root = top->node;
        const size_t low = top->low, high = top->high, middle = low + (high - low) / 2;
        const bool left_single = middle - low == 1, right_single = high - middle == 1;
        const uint32_t left =
            left_single ? map->trapezoid[t[low]].node : add_node(map, SUNDER_I_LEAF, 0, NOWHERE, NOWHERE);
        const uint32_t right =
            right_single ? map->trapezoid[t[middle]].node : add_node(map, SUNDER_I_LEAF, 0, NOWHERE, NOWHERE);
        sunder_i_history_at(map, root, map->trapezoid[t[middle]].left, left, right);
        if (!left_single) *top++ = (range){left, low, middle};
        if (!right_single) *top++ = (range){right, middle, high};
    }
}

uint32_t sunder_i_history_find(sunder_i_planar_map *map, const sunder_i_site *p)
{
    uint32_t n = 0;
    for (;;) {
        const sunder_i_history_node *node = &map->node[n];
        switch (node->kind) {
        case SUNDER_I_LEAF: return node->a;
        case SUNDER_I_ALIAS: n = node->a; break;
        case SUNDER_I_AT: n = sunder_i_site_cmp(map, p, &map->vertex[node->of].site) < 0 ? node->a : node->b; break;
        default: n = sunder_i_site_side(map, &map->line[node->of], p) < 0 ? node->a : node->b; break;
        }
    }
}
