/* run_corpus CORPUS [--most STEPS] [--list]: separates each item of a corpus, and prints one line each; with a library
 * whose constants and stages are set by the environment variable SUNDER_TUNING (tuning.h).
 *
 *   NAME, features, conflicts left, cost, lower bound, steps, allocations, digest    with tabs between them
 *
 * Steps are those of the library's watch (base/watch.h): an allocation, a node of a search, a comparison of two sides.
 * The digest covers all moves and conflicts of the report. An item that fails has its status in place of the numbers;
 * so has one that takes more than STEPS. --list: after all items the constants, and the stages that were asked for
 * (tuning_list()). */
#include "corpus.h"
#include "tuning.h"

#include "base/watch.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- Work -------------------------------------------------------------------------------------------------------- */

static uint64_t allocations, polls, most_polls = UINT64_MAX;

static void *allocate(size_t n)
{
    allocations++;
    return malloc(n);
}

static void *reallocate(void *old, size_t n)
{
    allocations++;
    return realloc(old, n);
}

static bool poll(void *user)
{
    (void)user;
    return ++polls <= most_polls;
}

/* ---- Digests ----------------------------------------------------------------------------------------------------- */

/* FNV-1a. */
static void add_bytes(uint64_t *hash, const void *bytes, size_t n)
{
    for (size_t k = 0; k < n; k++) *hash = (*hash ^ ((const unsigned char *)bytes)[k]) * UINT64_C(0x100000001b3);
}

static void add_number(uint64_t *hash, double value)
{
    value = value == 0 ? 0 : value; /* maps both zeros to one */
    if (value != value) value = -1; /* maps every NAN to one; distances are not negative */
    add_bytes(hash, &value, sizeof value);
}

static void add_count(uint64_t *hash, size_t value)
{
    const uint64_t count = value;
    add_bytes(hash, &count, sizeof count);
}

static void add_conflict(uint64_t *hash, const sunder_conflict *c)
{
    const double number[] = {c->distance, c->before, c->depth, c->required,   c->missing, c->from[0],
                             c->from[1],  c->to[0],  c->to[1], c->need_shift, c->need_gap};
    const size_t count[] = {c->a, c->b, (size_t)c->kind, (size_t)c->reason, c->inside_block, c->need_gone, c->crowded};
    for (size_t k = 0; k < sizeof number / sizeof *number; k++) add_number(hash, number[k]);
    for (size_t k = 0; k < sizeof count / sizeof *count; k++) add_count(hash, count[k]);
    for (size_t k = 0; k < c->n_blocked_by; k++) add_count(hash, c->blocked_by[k]);
}

static uint64_t digest_of(const sunder_report *report, const sunder_layer_summary *s)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    size_t n;
    for (size_t f = 0; f < s->features; f++) {
        double dx, dy;
        sunder_report_move(report, f, &dx, &dy);
        add_number(&hash, dx);
        add_number(&hash, dy);
        add_count(&hash, (size_t)sunder_report_status(report, f));
    }
    const sunder_conflict *conflict = sunder_report_conflicts(report, &n);
    for (size_t k = 0; k < n; k++) add_conflict(&hash, &conflict[k]);
    add_number(&hash, s->lower_bound);
    add_number(&hash, s->pair_bound);
    add_count(&hash, s->clusters_optimal);
    add_count(&hash, s->verified);
    return hash;
}

/* ---- Items ------------------------------------------------------------------------------------------------------- */

static sunder_status separate(const corpus_item *item, sunder_report **report, sunder_error *err)
{
    sunder_layer *layer = NULL;
    sunder_status status = sunder_layer_new(item->feature, item->features, &layer, err);
    if (!status) status = sunder_layer_set_side_anchors(layer, item->side_anchor, err);
    if (!status) status = sunder_layer_set_barriers(layer, item->barrier, item->barriers, err);
    if (!status) status = sunder_layer_separate(layer, &item->options, report, err);
    sunder_layer_free(layer);
    return status;
}

static void run(const corpus_item *item)
{
    sunder_report *report = NULL;
    sunder_error err = {0};
    allocations = polls = 0;
    sunder_watch(poll, NULL);
    const sunder_status status = separate(item, &report, &err);
    sunder_watch(NULL, NULL);
    printf("%s\t%zu\t", item->name, item->features);
    if (status) {
        printf("%s: %s\n", sunder_status_string(status), err.message);
        return;
    }
    sunder_layer_summary s;
    size_t left;
    sunder_report_summary(report, &s);
    sunder_report_conflicts(report, &left);
    printf("%zu\t%.17g\t%.17g\t%" PRIu64 "\t%" PRIu64 "\t%016" PRIx64 "\n", left, s.cost, s.lower_bound,
           polls * SUNDER_I_STEPS, allocations, digest_of(report, &s));
    sunder_report_free(report);
}

int main(int argc, char **argv)
{
    const char *wrong = tuning_change(getenv("SUNDER_TUNING"));
    FILE *from = argc > 1 ? fopen(argv[1], "r") : NULL;
    bool list = false;
    corpus_item item;
    if (wrong || !from) {
        fprintf(stderr, "run_corpus: %s: %s\n",
                wrong      ? wrong
                : argc > 1 ? argv[1]
                           : "no corpus",
                wrong ? "names no constant" : "cannot be read");
        return 1;
    }
    for (int k = 2; k < argc; k++) {
        if (strcmp(argv[k], "--list") == 0) list = true;
        if (strcmp(argv[k], "--most") == 0 && k + 1 < argc) most_polls = strtoull(argv[++k], NULL, 10) / SUNDER_I_STEPS;
    }
    sunder_set_allocator(allocate, reallocate, free);
    while (corpus_read(from, &item)) {
        run(&item);
        fflush(stdout);
        corpus_item_free(&item);
    }
    fclose(from);
    if (list) {
        tuning_list(stdout);
        tuning_list_versions(stdout);
        printf("\n");
    }
    return 0;
}
