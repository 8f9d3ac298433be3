/* surd_point.c: points whose coordinates are fractions of sums of square roots: their order, and their digits. Each
 * point has at most two roots; those of two points are joined for a comparison. Signs are exact (number/surd), and
 * digits are computed to any number. */
#include "separation/gap/gap.h"

#include <math.h>

sunder_i_surd_point sunder_i_surd_point_rational(sunder_i_operands *operands, sunder_i_rational_point at)
{
    sunder_i_arena *a = &operands->placed.lattice.arena;
    return (sunder_i_surd_point){{.n = 0}, sunder_i_surd_big(a, at.x), sunder_i_surd_big(a, at.y), at.w};
}

sunder_i_surd_point sunder_i_surd_point_doubles(sunder_i_operands *operands, double dx, double dy)
{
    return sunder_i_surd_point_rational(operands, sunder_i_doubles_point(operands, dx, dy));
}

bool sunder_i_surd_point_is_rational(const sunder_i_surd_point *exact) { return exact->roots.n == 0; }

/* ---- Order, and digits ---- */

static sunder_i_surd surd_norm(sunder_i_arena *a, const sunder_i_roots *roots, sunder_i_surd x, sunder_i_surd y)
{
    return sunder_i_surd_add(a, sunder_i_surd_mul(a, roots, x, x), sunder_i_surd_mul(a, roots, y, y));
}

/* Returns the squared distance of a point from the origin, in ball arithmetic. */
static sunder_i_ball rough_norm(const sunder_i_surd_point *u)
{
    const sunder_i_ball x = sunder_i_surd_ball(&u->roots, u->x), y = sunder_i_surd_ball(&u->roots, u->y);
    const sunder_i_ball w = sunder_i_ball_big(u->w);
    return sunder_i_ball_div(sunder_i_ball_add(sunder_i_ball_mul(x, x), sunder_i_ball_mul(y, y)),
                             sunder_i_ball_mul(w, w));
}

int sunder_i_surd_point_cmp(sunder_i_operands *operands, const sunder_i_surd_point *u, const sunder_i_surd_point *v)
{
    const int rough = sunder_i_ball_sign(sunder_i_ball_sub(rough_norm(u), rough_norm(v)));
    if (rough) return rough;
    sunder_i_arena *a = &operands->placed.lattice.arena;
    const sunder_i_mark mark = sunder_i_arena_mark(a);
    sunder_i_roots roots = u->roots;
    int place[SUNDER_I_SURD_ROOTS];
    sunder_i_roots_join(a, &roots, &v->roots, place); /* at most two roots each, and there is room for four */
    const sunder_i_surd ux = sunder_i_surd_scale(a, u->x, v->w), uy = sunder_i_surd_scale(a, u->y, v->w);
    const sunder_i_surd vx = sunder_i_surd_scale(a, sunder_i_surd_lift(a, v->x, place), u->w);
    const sunder_i_surd vy = sunder_i_surd_scale(a, sunder_i_surd_lift(a, v->y, place), u->w);
    int c =
        sunder_i_surd_sign(a, &roots, sunder_i_surd_sub(a, surd_norm(a, &roots, ux, uy), surd_norm(a, &roots, vx, vy)));
    if (!c) c = sunder_i_surd_sign(a, &roots, sunder_i_surd_sub(a, ux, vx));
    if (!c) c = sunder_i_surd_sign(a, &roots, sunder_i_surd_sub(a, uy, vy));
    sunder_i_arena_release(a, mark);
    return c;
}

void sunder_i_surd_point_scaled(sunder_i_operands *operands, const sunder_i_surd_point *at, unsigned long bits,
                                sunder_i_big xy[2])
{
    sunder_i_arena *a = &operands->placed.lattice.arena;
    xy[0] = sunder_i_big_div_floor(a, sunder_i_surd_scaled(a, &at->roots, at->x, bits), at->w);
    xy[1] = sunder_i_big_div_floor(a, sunder_i_surd_scaled(a, &at->roots, at->y, bits), at->w);
}

unsigned long sunder_i_surd_point_digits(sunder_i_operands *operands, const sunder_i_surd_point *at, double about,
                                         sunder_i_big xy[2])
{
    sunder_i_lattice *l = &operands->placed.lattice;
    const long size = about > 0 && about < INFINITY ? ilogb(about) + l->approx_shift : 0;
    for (unsigned long bits = size < 76 ? (unsigned long)(76 - size) : 0;; bits = 2 * bits + 1) {
        sunder_i_surd_point_scaled(operands, at, bits, xy);
        if (sunder_i_big_bits(xy[0]) >= 72 || sunder_i_big_bits(xy[1]) >= 72 || l->arena.failed) return bits;
    }
}

double sunder_i_surd_point_length_down(sunder_i_operands *operands, const sunder_i_big xy[2], unsigned long bits)
{
    sunder_i_lattice *l = &operands->placed.lattice;
    sunder_i_arena *a = &l->arena;
    const sunder_i_big off = sunder_i_big_i64(a, 3), one = sunder_i_big_i64(a, 1);
    sunder_i_big square = {NULL, 0};
    for (int k = 0; k < 2; k++) {
        const sunder_i_big v = sunder_i_big_sign(xy[k]) < 0 ? sunder_i_big_neg(xy[k]) : xy[k];
        const sunder_i_big least = sunder_i_big_sub(a, v, off);
        if (sunder_i_big_sign(least) > 0) square = sunder_i_big_add(a, square, sunder_i_big_mul(a, least, least));
    }
    return sunder_i_big_ratio_down(a, sunder_i_big_sqrt_floor(a, square), one, -(long)bits - l->approx_shift);
}
