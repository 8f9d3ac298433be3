/* The convex program of a node, by a dual active set method [GI83], and the bound that its forces prove.
 *
 * For forces f >= 0 on cuts n.(t_j - t_i) >= d, every t that satisfies the cuts has
 *
 *     sum w |t - a|^2  >=  D(f) = sum f (d - n.(a_j - a_i)) - sum over bodies |g_i|^2 / (4 w_i),
 *
 * where g_i is the sum of the forces' vectors on body i, with the sign of its side [weak duality, BV04, section 5.2].
 * This holds for any f, so it does not matter how they were found: sunder_i_dual_value() evaluates D with a bound on
 * its own rounding. Moreover sum w |t - a|^2 >= D + sum w |t - t*|^2 with t* = a + g / (2 w); cuts by discs are based
 * on this (tree_cuts.c).
 *
 * The method: active cuts are equations with positive forces, and t is the minimiser for them. A cut that t violates
 * gets a growing force until it holds, or until the force of another cut vanishes, which is then released. D never
 * decreases. If the new cut is a combination of active ones and none can be released, no t satisfies them all. Then
 * forces along that combination prove any value, and they are made so large that evaluation proves `enough`. If that
 * fails the cut is ignored.
 *
 * The products of the active cuts are stored as a Cholesky factor, which grows by a row, and loses a row by rotations.
 *
 * Prices. What an eased pair lacks, s >= 0, is one more unknown, which costs linear s + square s^2. If L is the sum of
 * the forces on cuts that contain s, each times its share, that cost and -L s add up to at least
 *
 *     -max(0, L - linear)^2 / (4 square),
 *
 * which becomes a term of D. For the active set method s is like a body whose weight is `square`; the cut s >= 0
 * belongs to its cuts, but not to L. */
#include "displacement/prove/optimum/dual_program.h"

#include "base/extremes.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/* A cut is a combination of others if the part of its square that is orthogonal to them is a smaller share than
 * this. */
#define DEPENDENT 1e-11
/* The share for cuts that are solved anew after one could not be added. */
#define NEARLY_DEPENDENT 1e-8
#define NO_FACTOR 1e-9
#define FEWEST_ROWS 32

bool sunder_i_dual_init(sunder_i_dual_program *program, size_t bodies, size_t prices)
{
    memset(program, 0, sizeof *program);
    program->bodies = bodies;
    program->prices = prices;
    program->t = sunder_i_alloc(2 * bodies, sizeof *program->t);
    program->net = sunder_i_alloc(3 * bodies, sizeof *program->net);
    program->lacks = sunder_i_alloc(prices, sizeof *program->lacks);
    program->push = sunder_i_alloc(2 * prices, sizeof *program->push);
    return program->t && program->net && program->lacks && program->push;
}

void sunder_i_dual_free(sunder_i_dual_program *program)
{
    sunder_i_free_all(program->acting, program->before, program->factor, program->t, program->net, program->lacks,
                      program->push, program->scratch);
    memset(program, 0, sizeof *program);
}

/* Makes room for n rows, with a new layout of the factor. Returns false if memory is out. */
static bool reserve_rows(sunder_i_dual_program *p, size_t n)
{
    if (n <= p->capacity) return true;
    size_t capacity = p->capacity ? p->capacity : FEWEST_ROWS;
    while (capacity < n) capacity *= 2;
    sunder_i_cut_force *acting = sunder_i_realloc(p->acting, capacity, sizeof *acting);
    if (acting) p->acting = acting;
    sunder_i_cut_force *before = sunder_i_realloc(p->before, capacity, sizeof *before);
    if (before) p->before = before;
    double *scratch = sunder_i_realloc(p->scratch, 3 * capacity, sizeof *scratch);
    if (scratch) p->scratch = scratch;
    double *factor = sunder_i_alloc(capacity * capacity, sizeof *factor);
    if (!acting || !before || !scratch || !factor) {
        sunder_i_free(factor);
        return false;
    }
    for (size_t k = 0; k < p->acting_n; k++)
        memcpy(factor + k * capacity, p->factor + k * p->capacity, (k + 1) * sizeof *factor);
    sunder_i_free(p->factor);
    p->factor = factor;
    p->capacity = capacity;
    return true;
}

static double product_of_cuts(const sunder_i_dual_program *p, const sunder_i_move_cut *a, const sunder_i_move_cut *b)
{
    double shared = 0;
    if (a->i == b->i && a->i != SUNDER_I_GROUND) shared += p->mass[a->i];
    if (a->j == b->j && a->j != SUNDER_I_GROUND) shared += p->mass[a->j];
    if (a->i == b->j && a->i != SUNDER_I_GROUND) shared -= p->mass[a->i];
    if (a->j == b->i && a->j != SUNDER_I_GROUND) shared -= p->mass[a->j];
    const double of_moves = shared != 0 ? shared * (a->n[0] * b->n[0] + a->n[1] * b->n[1]) : 0;
    if (a->share == 0 || b->share == 0 || a->eased != b->eased) return of_moves;
    return of_moves + a->share * b->share / (2 * p->price[a->eased].square);
}

/* What a pair lacks costs square (s - a)^2 less a constant, with this a. */
static double anchor_of_price(const sunder_i_price *price) { return -price->linear / (2 * price->square); }

static double moves_at_anchor(const sunder_i_dual_program *p, const sunder_i_move_cut *c)
{
    double v = 0;
    if (c->j != SUNDER_I_GROUND) v += c->n[0] * p->anchor[2 * c->j] + c->n[1] * p->anchor[2 * c->j + 1];
    if (c->i != SUNDER_I_GROUND) v -= c->n[0] * p->anchor[2 * c->i] + c->n[1] * p->anchor[2 * c->i + 1];
    return v;
}

static double at_anchor(const sunder_i_dual_program *p, const sunder_i_move_cut *c)
{
    const double v = moves_at_anchor(p, c);
    return c->share != 0 ? v + c->share * anchor_of_price(&p->price[c->eased]) : v;
}

double sunder_i_dual_missing(const sunder_i_dual_program *program, const sunder_i_move_cut *cut)
{
    double v = cut->share != 0 ? cut->d - cut->share * program->lacks[cut->eased] : cut->d;
    if (cut->j != SUNDER_I_GROUND) v -= cut->n[0] * program->t[2 * cut->j] + cut->n[1] * program->t[2 * cut->j + 1];
    if (cut->i != SUNDER_I_GROUND) v += cut->n[0] * program->t[2 * cut->i] + cut->n[1] * program->t[2 * cut->i + 1];
    return v;
}

bool sunder_i_dual_is_acting(const sunder_i_dual_program *program, uint32_t cut)
{
    for (size_t k = 0; k < program->acting_n; k++)
        if (program->acting[k].cut == cut) return true;
    return false;
}

/* ---- The factor -------------------------------------------------------------------------------------------------- */

/* Sets `row` to the row that cut c would have in the factor, and *square to the cut's own square. Returns the square of
 * the row's diagonal entry. */
static double make_row(sunder_i_dual_program *p, const sunder_i_move_cut *c, double *row, double *square)
{
    double left = *square = product_of_cuts(p, c, c) + c->give;
    for (size_t k = 0; k < p->acting_n; k++) {
        const double *l = p->factor + k * p->capacity;
        double v = product_of_cuts(p, c, &p->cut[p->acting[k].cut]);
        for (size_t m = 0; m < k; m++) v -= l[m] * row[m];
        row[k] = v / l[k];
        left -= row[k] * row[k];
    }
    p->steps += 1 + p->acting_n * p->acting_n / 16;
    return left;
}

/* Solves the transposed system: sets out so that sum over k of out_k L_km = row_m for each m. */
static void solve_back(const sunder_i_dual_program *p, const double *row, double *out)
{
    memcpy(out, row, p->acting_n * sizeof *out);
    for (size_t k = p->acting_n; k-- > 0;) {
        const double *l = p->factor + k * p->capacity;
        out[k] /= l[k];
        for (size_t m = 0; m < k; m++) out[m] -= out[k] * l[m];
    }
}

static void append_row(sunder_i_dual_program *p, uint32_t cut, double force, const double *row, double diagonal)
{
    double *l = p->factor + p->acting_n * p->capacity;
    memcpy(l, row, p->acting_n * sizeof *l);
    l[p->acting_n] = diagonal;
    p->acting[p->acting_n++] = (sunder_i_cut_force){cut, force};
}

/* Removes row `at` from the factor; rotations make the rows after it triangular again. */
static void take_out(sunder_i_dual_program *p, size_t at)
{
    for (size_t k = at + 1; k < p->acting_n; k++) {
        memcpy(p->factor + (k - 1) * p->capacity, p->factor + k * p->capacity, (k + 1) * sizeof *p->factor);
        p->acting[k - 1] = p->acting[k];
    }
    p->acting_n--;
    for (size_t k = at; k < p->acting_n; k++) {
        double *l = p->factor + k * p->capacity;
        const double a = l[k], b = l[k + 1], length = sqrt(a * a + b * b), c = a / length, s = b / length;
        for (size_t m = k; m < p->acting_n; m++) {
            double *r = p->factor + m * p->capacity;
            const double x = r[k], y = r[k + 1];
            r[k] = c * x + s * y;
            r[k + 1] = c * y - s * x;
        }
    }
    p->steps += 1 + p->acting_n * p->acting_n / 16;
}

/* ---- Forces ------------------------------------------------------------------------------------------------------ */

void sunder_i_dual_place(sunder_i_dual_program *program)
{
    memcpy(program->t, program->anchor, 2 * program->bodies * sizeof *program->t);
    for (size_t k = 0; k < program->prices; k++) program->lacks[k] = anchor_of_price(&program->price[k]);
    for (size_t k = 0; k < program->acting_n; k++) {
        const sunder_i_move_cut *c = &program->cut[program->acting[k].cut];
        if (c->share != 0)
            program->lacks[c->eased] += program->acting[k].force * c->share / (2 * program->price[c->eased].square);
        for (int e = 0; e < 2; e++) {
            const uint32_t b = e ? c->j : c->i;
            if (b == SUNDER_I_GROUND) continue;
            const double push = (e ? program->acting[k].force : -program->acting[k].force) * program->mass[b];
            program->t[2 * b] += push * c->n[0];
            program->t[2 * b + 1] += push * c->n[1];
        }
    }
}

/* Computes the forces for which all active cuts hold with equality. */
static void balance_forces(sunder_i_dual_program *p)
{
    double *y = p->scratch;
    for (size_t k = 0; k < p->acting_n; k++) {
        const sunder_i_move_cut *c = &p->cut[p->acting[k].cut];
        const double *l = p->factor + k * p->capacity;
        double v = c->d - at_anchor(p, c);
        for (size_t m = 0; m < k; m++) v -= l[m] * y[m];
        y[k] = v / l[k];
    }
    solve_back(p, y, p->scratch + p->capacity);
    for (size_t k = 0; k < p->acting_n; k++) p->acting[k].force = p->scratch[p->capacity + k];
    p->steps += 1 + p->acting_n * p->acting_n / 8;
}

/* Starts from n active cuts. Those are dropped whose part orthogonal to those before is a smaller share of their square
 * than `dependent`. */
static void load_cuts(sunder_i_dual_program *program, const sunder_i_cut_force *acting, size_t n, double dependent)
{
    program->acting_n = 0;
    for (size_t k = 0; k < n; k++) {
        double square;
        const double left = make_row(program, &program->cut[acting[k].cut], program->scratch, &square);
        if (left > dependent * square)
            append_row(program, acting[k].cut, acting[k].force, program->scratch, sqrt(left));
    }
    for (;;) {
        size_t worst = 0;
        balance_forces(program);
        for (size_t k = 1; k < program->acting_n; k++)
            if (program->acting[k].force < program->acting[worst].force) worst = k;
        if (program->acting_n == 0 || program->acting[worst].force >= 0) break;
        take_out(program, worst);
    }
    sunder_i_dual_place(program);
}

bool sunder_i_dual_load(sunder_i_dual_program *program, const sunder_i_cut_force *acting, size_t n)
{
    if (!reserve_rows(program, n + 1)) return false;
    load_cuts(program, acting, n, DEPENDENT);
    return true;
}

/* Handles contradicting cuts: while the force of the new cut, now `force`, grows by 1, each active force decreases by
 * r, and the violation `missing` stays, so D grows without bound. Returns CLOSED if such forces prove `enough`. */
static sunder_i_dual_outcome prove_contradiction(sunder_i_dual_program *p, uint32_t cut, double force, double missing,
                                                 const double *r, double enough)
{
    const size_t n = p->acting_n;
    double *before = p->scratch + 2 * p->capacity, scale = fabs(enough) / missing;
    for (size_t k = 0; k < n; k++) before[k] = p->acting[k].force;
    p->acting[n].cut = cut;
    p->acting_n = n + 1;
    for (int attempt = 0; attempt < 24; attempt++, scale *= 2) {
        for (size_t k = 0; k < n; k++) p->acting[k].force = sunder_i_max(0, before[k] - scale * r[k]);
        p->acting[n].force = force + scale;
        if (sunder_i_dual_value(p) >= enough) return SUNDER_I_DUAL_CLOSED;
    }
    for (size_t k = 0; k < n; k++) p->acting[k].force = before[k];
    p->acting_n = n;
    return SUNDER_I_DUAL_STUCK;
}

/* Returns the active cut whose force vanishes first as each decreases by r[k] per unit of the new force, among those
 * with r[k] > least; SIZE_MAX if there is none. *step is the growth of the new force at which it vanishes. */
static size_t find_leaving(const sunder_i_dual_program *p, const double *r, double least, double *step)
{
    size_t leaves = SIZE_MAX;
    *step = INFINITY;
    for (size_t k = 0; k < p->acting_n; k++) {
        if (!(r[k] > least) || !(p->acting[k].force / r[k] < *step)) continue;
        *step = p->acting[k].force / r[k];
        leaves = k;
    }
    return leaves;
}

/* Returns the bound for find_leaving() if the new cut is a combination of active ones: smaller factors are rounding
 * errors, and release no cut; otherwise the new force could grow without bound. */
static double least_factor(const sunder_i_dual_program *p, const double *r)
{
    double most = 0;
    for (size_t k = 0; k < p->acting_n; k++) most = sunder_i_max(most, fabs(r[k]));
    return NO_FACTOR * most;
}

static sunder_i_dual_outcome add_cut(sunder_i_dual_program *program, uint32_t cut, double enough)
{
    const sunder_i_move_cut *c = &program->cut[cut];
    double force = 0;
    for (size_t round = 0; round < 4 * program->acting_n + 64; round++) {
        double *row = program->scratch, *r = program->scratch + program->capacity, square;
        const double left = make_row(program, c, row, &square);
        const bool dependent = !(left > DEPENDENT * square);
        sunder_i_dual_place(program);
        /* `missing` is the violation at the t without the new force, reduced by the effect of that force. */
        double missing = c->d - at_anchor(program, c);
        if (c->share != 0)
            missing -= c->share * (program->lacks[c->eased] - anchor_of_price(&program->price[c->eased]));
        for (int e = 0; e < 2; e++) {
            const uint32_t b = e ? c->j : c->i;
            if (b == SUNDER_I_GROUND) continue;
            const double v = c->n[0] * (program->t[2 * b] - program->anchor[2 * b]) +
                             c->n[1] * (program->t[2 * b + 1] - program->anchor[2 * b + 1]);
            missing -= e ? v : -v;
        }
        missing -= force * square;
        solve_back(program, row, r);
        double longest;
        const size_t leaves =
            find_leaving(program, r, dependent ? least_factor(program, r) : 1e-13 * fabs(square), &longest);
        if (dependent && leaves == SIZE_MAX) {
            if (!(missing > 0)) break;
            return prove_contradiction(program, cut, force, missing, r, enough);
        }
        const double whole = dependent ? INFINITY : sunder_i_max(0, missing) / left,
                     step = sunder_i_min(whole, longest);
        for (size_t k = 0; k < program->acting_n; k++)
            program->acting[k].force = sunder_i_max(0, program->acting[k].force - step * r[k]);
        force += step;
        if (whole <= longest) {
            append_row(program, cut, force, row, sqrt(left));
            sunder_i_dual_place(program);
            return SUNDER_I_DUAL_SOLVED;
        }
        take_out(program, leaves);
    }
    return SUNDER_I_DUAL_STUCK;
}

/* If the cut cannot be added, the cuts that were active before are solved anew, with a fresh factor and without those
 * that nearly depend on others, and it is tried once more; then it is left out. Otherwise forces that rounding has made
 * great would move bodies far away. */
sunder_i_dual_outcome sunder_i_dual_add(sunder_i_dual_program *program, uint32_t cut, double enough, bool *failed)
{
    const size_t before = program->acting_n;
    sunder_i_dual_outcome outcome = SUNDER_I_DUAL_STUCK;
    *failed = !reserve_rows(program, before + 2);
    if (!*failed && before) memcpy(program->before, program->acting, before * sizeof *program->before);
    for (int attempt = 0; attempt < 2 && outcome == SUNDER_I_DUAL_STUCK && !*failed; attempt++) {
        outcome = add_cut(program, cut, enough);
        if (outcome == SUNDER_I_DUAL_STUCK) load_cuts(program, program->before, before, NEARLY_DEPENDENT);
    }
    return outcome;
}

/* ---- The bound that the forces prove ----------------------------------------------------------------------------- */

/* Rounding errors, with e = 2^-53 and N forces. A term f (d - n.a) has an error of at most 8 e of the sum of its parts'
 * magnitudes. The sum of N terms adds N e of the sum of magnitudes: (N + 9) e of it suffices, and summing the
 * magnitudes adds as much again. A component of g has an error of (N + 1) e of the sum of |f n|, which is net[3 b + 2]
 * below, and |g|^2 / (4 w) takes four roundings. Four times all of this is used, so that these sums may be rounded
 * themselves; and 2^-900 for underflow. So it is for prices, with the sum of |f share|. */
double sunder_i_dual_value(sunder_i_dual_program *program)
{
    const double unit = 4 * ((double)(program->acting_n + program->bodies) + 16) * 0x1p-53;
    double value = 0, magnitude = 0, taken = 0, *net = program->net;
    memset(net, 0, 3 * program->bodies * sizeof *net);
    for (size_t k = 0; k < 2 * program->prices; k++) program->push[k] = 0;
    for (size_t k = 0; k < program->acting_n; k++) {
        const sunder_i_move_cut *c = &program->cut[program->acting[k].cut];
        const double f = program->acting[k].force;
        double part = fabs(c->d);
        if (sunder_i_is_lack_above_0(c)) continue;
        if (c->share != 0) {
            program->push[2 * c->eased] += f * c->share;
            program->push[2 * c->eased + 1] += f * fabs(c->share);
        }
        for (int e = 0; e < 2; e++) {
            const uint32_t b = e ? c->j : c->i;
            if (b == SUNDER_I_GROUND) continue;
            part += fabs(c->n[0] * program->anchor[2 * b]) + fabs(c->n[1] * program->anchor[2 * b + 1]);
            net[3 * b] += e ? f * c->n[0] : -f * c->n[0];
            net[3 * b + 1] += e ? f * c->n[1] : -f * c->n[1];
            net[3 * b + 2] += f * (fabs(c->n[0]) + fabs(c->n[1]));
        }
        value += f * (c->d - moves_at_anchor(program, c));
        magnitude += f * part;
        taken += f * f * c->give / 2;
    }
    for (size_t b = 0; b < program->bodies; b++) {
        if (!(program->mass[b] > 0) || !(net[3 * b + 2] > 0)) continue;
        const double x = fabs(net[3 * b]) + unit * net[3 * b + 2], y = fabs(net[3 * b + 1]) + unit * net[3 * b + 2];
        taken += (x * x + y * y) / (4 * program->weight[b]);
    }
    for (size_t k = 0; k < program->prices; k++) {
        const double above = program->push[2 * k] + unit * program->push[2 * k + 1] - program->price[k].linear;
        if (above > 0) taken += above * above / (4 * program->price[k].square);
    }
    return value - taken - unit * (magnitude + fabs(value) + taken) - 0x1p-900;
}
