/* The cases of this folder: the library's sum, computed with each kind of numbers in turn, and the oracle's, compared
 * byte for byte. With file names as arguments it prints the oracle's results instead. */
#include "minkowski/minkowski.h"
#include "oracle.h"
#include "sum_text.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct golden {
    polyset p, q;
    char *want;
} golden;

static bool read_golden(golden *g, const char *folder, const char *file)
{
    char *path = test_format("%s/%s", folder, file), *text = test_read_file(path);
    char *answer = test_format("%s/%.*s.json", folder, (int)strlen(file) - 4, file);
    const char *end;
    bool ok = text && polyset_read_wkt(&g->p, text, &end) && polyset_read_wkt(&g->q, end, NULL);
    g->want = test_read_file(answer);
    ok = ok && g->want;
    if (ok) g->want[strcspn(g->want, "\n")] = '\0';
    free(path);
    free(text);
    free(answer);
    return ok;
}

static char *on_rung(const golden *g, bool force_wide)
{
    sunder_shape *p = polyset_shape(&g->p), *q = polyset_shape(&g->q);
    sunder_sum *sum = NULL;
    char *text = NULL;
    if (p && q && sunder_i_minkowski_sum(p, q, force_wide, NULL, &sum, NULL) == SUNDER_OK) text = sum_text(sum);
    sunder_sum_free(sum);
    sunder_shape_free(p);
    sunder_shape_free(q);
    return text;
}

/* Compares and frees. */
static bool expect(const char *file, const char *who, char *got, const char *want)
{
    const bool same = got && strcmp(got, want) == 0;
    if (!same) print_message("%s: %s says\n  %s\nnot\n  %s\n", file, who, got ? got : "nothing", want);
    free(got);
    return same;
}

static bool check(const char *folder, const char *file)
{
    golden g;
    if (!read_golden(&g, folder, file)) {
        print_message("%s: cannot be read\n", file);
        return false;
    }
    bool ok = expect(file, "the oracle", oracle_sum_text(&g.p, &g.q, true), g.want);
    ok = expect(file, "the library", on_rung(&g, false), g.want) && ok;
    ok = expect(file, "the library on big integers", on_rung(&g, true), g.want) && ok;
    polyset_free(&g.p);
    polyset_free(&g.q);
    free(g.want);
    return ok;
}

static void test_all(void **state)
{
    (void)state;
    const char *source = getenv("SUNDER_SOURCE");
    char *folder = test_format("%s/tests/golden", source ? source : SUNDER_SOURCE);
    size_t n = 0, bad = 0;
    DIR *dir = opendir(folder);
    assert_non_null(dir);
    for (struct dirent *e; (e = readdir(dir));) {
        const size_t length = strlen(e->d_name);
        if (length < 5 || strcmp(e->d_name + length - 4, ".wkt")) continue;
        n++;
        if (!check(folder, e->d_name)) bad++;
    }
    closedir(dir);
    free(folder);
    print_message("%zu of %zu cases agree\n", n - bad, n);
    assert_true(n > 20);
    assert_int_equal(bad, 0);
}

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        char *text = test_read_file(argv[i]);
        const char *end;
        polyset p, q;
        if (!text || !polyset_read_wkt(&p, text, &end) || !polyset_read_wkt(&q, end, NULL)) return 2;
        char *sum = oracle_sum_text(&p, &q, true);
        puts(sum);
        free(sum);
        free(text);
        polyset_free(&p);
        polyset_free(&q);
    }
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_all)};
    return argc > 1 ? 0 : cmocka_run_group_tests_name("golden", tests, NULL, NULL);
}
