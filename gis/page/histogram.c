/* histogram.c: the histogram of the lengths of moves. All bars have the same width, a round number. If a few moves are
 * far longer than the others, the last bar counts all of them and is labelled so. */
#include "page/pictures.h"

#include <math.h>
#include <string.h>

/* BARS: the approximate number of bars. seen_part: the share of the moves that are not counted in the last, open
 * bar. */
enum { BARS = 20 };
static const double seen_part = 0.98;

/* The size of the picture, its margins, which hold labels, and the least height of a bar with a count above 0. */
enum { WIDTH = 960, HEIGHT = 260, LEFT = 8, RIGHT = 30, TOP = 24, BOTTOM = 44, LEAST = 2 };

typedef struct bars {
    double width; /* of one bar, in units of the layer */
    size_t n;     /* the number of bars */
    size_t count[BARS + 1], most;
    bool open; /* the last bar counts all longer moves, too */
} bars;

/* Returns the least of the numbers 1, 2 and 5 times a power of ten that is not less than the value. */
static double round_up(double value)
{
    double power = pow(10, floor(log10(value)));
    for (int k = 0; k < 3; k++) {
        double round = power * (const double[]){1, 2, 5}[k];
        if (round >= value * (1 - 1e-9)) return round;
    }
    return power * 10;
}

static bars count_bars(const gis_page_model *model)
{
    bars all = {0};
    double longest = gis_page_length(&model->feature[model->moved[0]]);
    const size_t last_seen = (size_t)((1 - seen_part) * (double)model->n_moved);
    double usual = gis_page_length(&model->feature[model->moved[last_seen]]);
    all.open = longest > 2 * usual;
    all.width = round_up((all.open ? usual : longest) / (BARS - 1));
    if (!(all.width > 0) || isinf(all.width)) all.width = longest; /* the width exceeds the range of doubles or is 0 */
    for (size_t k = 0; k < model->n_moved; k++) {
        double at = floor(gis_page_length(&model->feature[model->moved[k]]) / all.width);
        size_t bar = at < BARS ? (size_t)at : BARS;
        all.count[bar]++;
        if (bar + 1 > all.n) all.n = bar + 1;
        if (all.count[bar] > all.most) all.most = all.count[bar];
    }
    return all;
}

static void add_bar(const gis_page_model *model, const bars *all, size_t k, double step, gis_text *to)
{
    double full = HEIGHT - TOP - BOTTOM, height = full * (double)all->count[k] / (double)all->most;
    if (all->count[k] == 0) return;
    if (height < LEAST) height = LEAST;
    bool last = k == BARS;
    double x = LEFT + (double)k * step, y = HEIGHT - BOTTOM - height;
    gis_text_print(to, "<g><rect class=\"%s\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>",
                   last ? "bar rest" : "bar", x + 1, y, step - 2, height);
    gis_text_print(to, "<text class=\"count\" x=\"%.1f\" y=\"%.1f\">", x + step / 2, y - 6);
    gis_print_count(to, all->count[k]);
    gis_text_add(to, "</text><title>");
    gis_print_count(to, all->count[k]);
    gis_text_add(to, all->count[k] == 1 ? " feature: " : " features: ");
    gis_print_number(to, (double)k * all->width, 4);
    if (!last) {
        gis_text_add(to, " to ");
        gis_print_length(to, (double)(k + 1) * all->width, &model->unit);
    } else {
        gis_text_print(to, "%s%s and more", *model->unit.length ? " " : "", model->unit.length);
    }
    gis_text_add(to, "</title></g>\n");
}

static void add_axis(const gis_page_model *model, const bars *all, double step, gis_text *to)
{
    int base = HEIGHT - BOTTOM;
    gis_text_print(to, "<path class=\"axis\" d=\"M%d %.1fH%.1f\"/>\n", LEFT, base + 0.5, LEFT + (double)all->n * step);
    size_t every = all->n > 12 ? 2 : 1;
    for (size_t k = 0; k <= all->n && k <= BARS; k += every) {
        double x = LEFT + (double)k * step;
        gis_text_print(to, "<path class=\"axis\" d=\"M%.1f %dv5\"/><text class=\"tick\" x=\"%.1f\" y=\"%d\">", x, base,
                       x, base + 19);
        if (k == BARS) gis_text_add(to, "\xE2\x89\xA5\xE2\x80\xAF");
        gis_print_number(to, (double)k * all->width, 4);
        gis_text_add(to, "</text>\n");
    }
    gis_text_print(to, "<text class=\"title\" x=\"%d\" y=\"%d\">length of the move%s%s</text>\n", LEFT, HEIGHT - 4,
                   *model->unit.length ? ", " : "", model->unit.length);
}

bool gis_page_add_histogram(const gis_page_model *model, gis_text *to, gis_error *error)
{
    (void)error;
    if (model->n_moved == 0) return true;
    bars all = count_bars(model);
    double step = fmin(80, (double)(WIDTH - LEFT - RIGHT) / (double)all.n);
    gis_text_print(to,
                   "<svg class=\"histogram\" viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"histogram of the "
                   "lengths of moves\">\n",
                   WIDTH, HEIGHT);
    for (size_t k = 0; k < all.n; k++) add_bar(model, &all, k, step, to);
    add_axis(model, &all, step, to);
    gis_text_add(to, "</svg>\n");
    return true;
}
