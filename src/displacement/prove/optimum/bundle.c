/* A proximal bundle method for a sum over blocks [Lem75; HUL93, chapter XV].
 *
 * The bound of blocks.c is a sum over blocks of concave functions of x (places times shares). Each is the minimum of
 * linear functions, one for every layout of the block. Layouts that were found are cuts: each bounds the block's value
 * from above everywhere. The next evaluation is at the x where the sum of the cuts promises most, less a multiple of
 * the squared distance, since cuts are unreliable far away.
 *
 * This is solved in the dual. Mix the cuts of each block with shares that add up to 1. Let T be the mix of their
 * positions of the copies, and D of each copy its T less the mean over its body's copies. The promise is the least over
 * all shares of
 *
 *     sum of shares (at_rest - 2 centre.t)  +  2 stride |D|^2,        at  x = centre - 2 stride D:
 *
 * the cuts are mixed so that copies agree. Shares are transferred from the worst cut of a block that has a share to its
 * best, by a least squares step, block after block. This decides nothing: a bound is what trees prove at x. */
#include "displacement/prove/optimum/bundle.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/extremes.h"
#include "base/watch.h"

#include <math.h>
#include <string.h>

#define NO_CUT UINT32_MAX

bool sunder_i_bundle_init(sunder_i_bundle *bundle)
{
    bundle->mix = sunder_i_alloc(2 * bundle->copies, sizeof *bundle->mix);
    bundle->mean = sunder_i_alloc(2 * bundle->members, sizeof *bundle->mean);
    bundle->last = sunder_i_alloc(bundle->blocks, sizeof *bundle->last);
    for (size_t k = 0; bundle->last && k < bundle->blocks; k++) bundle->last[k] = NO_CUT;
    return bundle->mix && bundle->mean && bundle->last;
}

void sunder_i_bundle_free(sunder_i_bundle *bundle)
{
    sunder_i_free_all(bundle->cut, bundle->t, bundle->mix, bundle->mean, bundle->last);
    *bundle = (sunder_i_bundle){0};
}

static double scalar_product(const double *a, const double *b, size_t n)
{
    double sum = 0;
    for (size_t k = 0; k < n; k++) sum += a[k] * b[k];
    return sum;
}

bool sunder_i_bundle_add(sunder_i_bundle *bundle, size_t block, double value, const double *x, const double *t)
{
    const size_t from = bundle->first[block], n = 2 * (bundle->first[block + 1] - from);
    if (!sunder_i_reserve(&bundle->cut, &bundle->cut_capacity, bundle->cuts + 1, sizeof *bundle->cut) ||
        !sunder_i_reserve(&bundle->t, &bundle->capacity, bundle->numbers + n, sizeof *bundle->t))
        return false;
    bundle->cut[bundle->cuts] = (sunder_i_bundle_cut){.block = (uint32_t)block,
                                                      .before = bundle->last[block],
                                                      .at_rest = value + 2 * scalar_product(x, t, n),
                                                      .t = bundle->numbers,
                                                      .share = bundle->last[block] == NO_CUT};
    bundle->last[block] = (uint32_t)bundle->cuts++;
    memcpy(bundle->t + bundle->numbers, t, n * sizeof *t);
    bundle->numbers += n;
    return true;
}

/* Computes mix and mean for the present shares. */
static void mix_all(sunder_i_bundle *b)
{
    memset(b->mix, 0, 2 * b->copies * sizeof *b->mix);
    memset(b->mean, 0, 2 * b->members * sizeof *b->mean);
    for (size_t k = 0; k < b->cuts; k++) {
        const sunder_i_bundle_cut *cut = &b->cut[k];
        const size_t from = b->first[cut->block], n = b->first[cut->block + 1] - from;
        for (size_t m = 0; m < 2 * n && cut->share > 0; m++) b->mix[2 * from + m] += cut->share * b->t[cut->t + m];
    }
    for (size_t m = 0; m < b->copies; m++)
        for (size_t c = 0; c < 2; c++) b->mean[2 * (size_t)b->member[m] + c] += (1 - b->others[m]) * b->mix[2 * m + c];
}

/* Returns coordinate c of the difference between the mix of copy m and the mean over its body's copies. */
static double difference_of(const sunder_i_bundle *b, size_t m, size_t c)
{
    return b->others[m] > 0 ? b->mix[2 * m + c] - b->mean[2 * (size_t)b->member[m] + c] : 0;
}

/* Transfers share from cut `from` to cut `to` of the same block, as far as that lowers the promise. */
static void trade_share(sunder_i_bundle *b, sunder_i_bundle_cut *from, sunder_i_bundle_cut *to, double stride)
{
    const size_t first = b->first[from->block], n = b->first[from->block + 1] - first;
    double square = 0;
    for (size_t m = 0; m < n; m++)
        for (size_t c = 0; c < 2; c++) {
            const double step = b->t[to->t + 2 * m + c] - b->t[from->t + 2 * m + c];
            square += b->others[first + m] * step * step;
        }
    const double gain = from->slope - to->slope,
                 share = square > 0 ? sunder_i_min(from->share, gain / (4 * stride * square)) : from->share;
    from->share -= share;
    to->share += share;
    for (size_t m = 0; m < n; m++)
        for (size_t c = 0; c < 2; c++) {
            const double step = share * (b->t[to->t + 2 * m + c] - b->t[from->t + 2 * m + c]);
            b->mix[2 * (first + m) + c] += step;
            b->mean[2 * (size_t)b->member[first + m] + c] += (1 - b->others[first + m]) * step;
        }
}

/* Makes one transfer between the cuts of a block. Returns the difference of their slopes; 0 if there was none. */
static double trade_in_block(sunder_i_bundle *b, size_t block, const double *centre, double stride)
{
    const size_t first = b->first[block], n = b->first[block + 1] - first;
    double pull[2 * MOST_IN_BLOCK];
    sunder_i_bundle_cut *worst = NULL, *best = NULL;
    if (n > MOST_IN_BLOCK) return 0;
    for (size_t m = 0; m < n; m++)
        for (size_t c = 0; c < 2; c++)
            pull[2 * m + c] = 4 * stride * difference_of(b, first + m, c) - 2 * centre[2 * (first + m) + c];
    for (uint32_t k = b->last[block]; k != NO_CUT; k = b->cut[k].before) {
        sunder_i_bundle_cut *cut = &b->cut[k];
        cut->slope = cut->at_rest + scalar_product(pull, b->t + cut->t, 2 * n);
        if (!best || cut->slope < best->slope) best = cut;
        if (cut->share > 0 && (!worst || cut->slope > worst->slope)) worst = cut;
    }
    if (!best || best == worst || !(worst->slope > best->slope)) return 0;
    const double gain = worst->slope - best->slope;
    trade_share(b, worst, best, stride);
    return gain;
}

/* Makes transfers until, in each block, all cuts with a share are nearly as good as the best. Returns false if stopped
 * on request. */
static bool settle_shares(sunder_i_bundle *b, const double *centre, double stride)
{
    double whole = 0;
    for (size_t k = 0; k < b->cuts; k++) whole = sunder_i_max(whole, fabs(b->cut[k].at_rest));
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        double most = 0;
        for (size_t k = 0; k < b->blocks; k++) most = sunder_i_max(most, trade_in_block(b, k, centre, stride));
        b->steps += b->cuts + b->copies;
        if (!sunder_i_steps(1 + b->cuts / 16)) return false;
        if (most <= SWEPT * whole) break;
    }
    return true;
}

bool sunder_i_bundle_propose(sunder_i_bundle *bundle, const double *centre, double stride, double *x, double *promise)
{
    double square = 0;
    mix_all(bundle);
    if (!settle_shares(bundle, centre, stride)) return false;
    *promise = 0;
    for (size_t k = 0; k < bundle->cuts; k++) {
        const sunder_i_bundle_cut *cut = &bundle->cut[k];
        const size_t from = bundle->first[cut->block], n = bundle->first[cut->block + 1] - from;
        *promise += cut->share * (cut->at_rest - 2 * scalar_product(centre + 2 * from, bundle->t + cut->t, 2 * n));
    }
    for (size_t m = 0; m < bundle->copies; m++)
        for (size_t c = 0; c < 2; c++) {
            const double off = difference_of(bundle, m, c);
            x[2 * m + c] = centre[2 * m + c] - 2 * stride * off;
            square += off * off;
        }
    *promise += 2 * stride * square;
    return true;
}
