/* sunder-families: writes a pair of polygonal sets of a family, as two lines of WKT. */
#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "family.h"

/* mm: map-like coordinates may be any thousandths; they are eighths where an exact fit must survive as doubles. */
typedef struct family {
    const char *name, *operands;
    family_draw *draw;
    int64_t map_units;
} family;

static const family families[] = {
    {"convex", "convex + convex", family_convex, 1000},
    {"comb", "comb + convex", family_comb, 1000},
    {"fork", "two forks with teeth sideways and upwards", family_fork, 1000},
    {"slanted-fork", "the same with pointed teeth", family_slanted_fork, 1000},
    {"covered-fork", "two forks, and two triangles whose sum covers theirs", family_covered_fork, 1000},
    {"star", "star + star", family_star, 1000},
    {"random", "random simple polygons", family_random, 1000},
    {"robot", "star + convex obstacles", family_robot, 1000},
    {"fat-grid", "upright bars + lying bars: a grid of stout rectangles", family_fat_grid, 1000},
    {"fat-cover", "blocks and bars + plates: bars cover what stout squares leave", family_fat_cover, 1000},
    {"tight", "rooms behind passages exactly as wide as Q", family_tight, 8},
    {"buildings", "outlines of houses + a round brush", family_buildings, 1000},
    {"coast", "an island's shore + a round brush", family_coast, 1000},
    {"overlap", "two houses in each other's way", family_overlap, 1000}};

enum { FAMILIES = sizeof families / sizeof *families };

/* Where map-like coordinates have their origin, in metres. */
enum { MAP_X = 451234, MAP_Y = 5411234 };

typedef struct family_settings {
    const family *chosen;
    uint64_t m, n, seed, count;
    bool map, swap;
} family_settings;

static void usage(FILE *out)
{
    fputs("usage: sunder-families FAMILY [options]\n"
          "Prints P and Q, a line of WKT each: inputs of known difficulty for Minkowski sums.\n\n"
          "  --size N                     about N vertices each, at least 8 (20)\n"
          "  --size-q N                   another size for Q\n"
          "  --seed N                     which of them (1)\n"
          "  --count N                    N pairs, with this seed and the next ones (1)\n"
          "  --coordinates integer|map    map: like 451234.567 5411234.567 (integer)\n"
          "  --swap                       Q first\n\n",
          out);
    for (size_t i = 0; i < FAMILIES; i++) fprintf(out, "  %-13s %s\n", families[i].name, families[i].operands);
}

static bool parse_number(const char *text, uint64_t least, uint64_t most, uint64_t *out)
{
    char *end;
    errno = 0;
    const unsigned long long value = strtoull(text, &end, 10);
    *out = value;
    return text[0] >= '0' && text[0] <= '9' && *end == '\0' && errno == 0 && value >= least && value <= most;
}

static const family *find_family(const char *name)
{
    for (size_t i = 0; i < FAMILIES; i++)
        if (strcmp(families[i].name, name) == 0) return &families[i];
    return NULL;
}

static bool parse_option(family_settings *settings, const char *name, const char *value)
{
    /* A fork's sums of teeth are m n / 64 apart pitches wide: sizes below stay far from overflow. */
    const uint64_t most = 1000000;
    if (strcmp(name, "--size") == 0) return parse_number(value, FAMILY_LEAST, most, &settings->m);
    if (strcmp(name, "--size-q") == 0) return parse_number(value, FAMILY_LEAST, most, &settings->n);
    if (strcmp(name, "--count") == 0) return parse_number(value, 1, most, &settings->count);
    if (strcmp(name, "--seed") == 0) return parse_number(value, 0, UINT64_MAX, &settings->seed);
    if (strcmp(name, "--coordinates") != 0) return false;
    settings->map = strcmp(value, "map") == 0;
    return settings->map || strcmp(value, "integer") == 0;
}

static bool parse_arguments(int argc, char **argv, family_settings *settings)
{
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--swap") == 0) {
            settings->swap = true;
        } else if (strncmp(argv[i], "--", 2) != 0) {
            if (settings->chosen || !(settings->chosen = find_family(argv[i]))) return false;
        } else if (i + 1 == argc || !parse_option(settings, argv[i], argv[i + 1])) {
            return false;
        } else {
            i++;
        }
    }
    if (settings->n == 0) settings->n = settings->m;
    return settings->chosen != NULL;
}

static bool draw_pair(const family_settings *settings, uint64_t seed)
{
    const family *f = settings->chosen;
    const int64_t units = f->map_units;
    const family_place place =
        settings->map ? (family_place){units, MAP_X * units, MAP_Y * units} : (family_place){1, 0, 0};
    const uint64_t purpose = (uint64_t)(f - families);
    family_streams streams = {town_random_at(seed, 0, 0, purpose), town_random_at(seed, 1, 0, purpose)};
    family_set p = {0}, q = {0};
    f->draw(&p, &q, settings->m, settings->n, &streams);
    const bool done = family_print(settings->swap ? &q : &p, &place, stdout) &&
                      family_print(settings->swap ? &p : &q, &place, stdout);
    family_set_free(&p);
    family_set_free(&q);
    return done;
}

int main(int argc, char **argv)
{
    family_settings settings = {.m = 20, .seed = 1, .count = 1};
    if (argc == 2 && strcmp(argv[1], "--help") == 0) {
        usage(stdout);
        return 0;
    }
    if (!parse_arguments(argc, argv, &settings)) {
        usage(stderr);
        return 2;
    }
    bool done = true;
    for (uint64_t i = 0; done && i < settings.count; i++) done = draw_pair(&settings, settings.seed + i);
    if (done) done = fflush(stdout) == 0;
    if (!done) fputs("sunder-families: error: the output could not be written\n", stderr);
    return done ? 0 : 1;
}
