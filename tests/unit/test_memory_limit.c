/* Real memory running out, in a process of its own: huge operands under a limit of the address space. With any limit a
 * function returns an error, or succeeds; no underlying library ends the process. */
#include "polyset.h"
#include "random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

/* gcc defines a macro, clang has a feature test. */
#if defined(__has_feature)
#if __has_feature(address_sanitizer) && !defined(__SANITIZE_ADDRESS__)
#define __SANITIZE_ADDRESS__ 1
#endif
#endif

enum { DONE = 0, NO_MEMORY = 1, WRONG = 2 };

/* A closed random polyline that uses all bits of doubles: its corners are crossings, whose exact texts are long. */
static sunder_status scribble(rng *g, int n, double reach, sunder_shape **out)
{
    double xy[2 * 64];
    const size_t ring_end = (size_t)n, poly_end = 1;
    for (int i = 0; i < 2 * n; i++) xy[i] = reach * rng_unit(g);
    return sunder_shape_from_rings(xy, &ring_end, &poly_end, 1, SUNDER_VALIDITY_EVEN_ODD, out, NULL);
}

static sunder_status read_all(const sunder_sum *sum)
{
    char *text;
    sunder_status status = sunder_sum_area_text(sum, &text, NULL);
    if (status == SUNDER_OK) sunder_free(text);
    for (size_t p = 0; p < 1 && status == SUNDER_OK; p++) {
        size_t n;
        const uint32_t *ring = sunder_sum_ring(sum, p, 0, &n);
        for (size_t i = 0; i < n && status == SUNDER_OK; i++) {
            char *x, *y;
            double xy[2];
            sunder_sum_vertex(sum, ring[i], xy);
            status = sunder_sum_vertex_text(sum, ring[i], &x, &y, NULL);
            if (status == SUNDER_OK) {
                sunder_free(x);
                sunder_free(y);
            }
        }
    }
    return status;
}

static sunder_status everything(uint64_t seed)
{
    rng g = rng_start(seed, 71);
    sunder_shape *p = NULL, *q = NULL;
    sunder_status status = scribble(&g, 18, 100, &p);
    if (status == SUNDER_OK) status = scribble(&g, 7, 0x1p-300, &q);
    for (int road = SUNDER_ALGORITHM_CONVOLUTION; road <= SUNDER_ALGORITHM_DIVIDE && status == SUNDER_OK; road++) {
        const sunder_sum_options options = {.size = sizeof options, .algorithm = (sunder_algorithm)road};
        sunder_sum *sum;
        status = sunder_minkowski_sum(p, q, &options, &sum, NULL);
        if (status == SUNDER_OK) {
            status = read_all(sum);
            sunder_sum_free(sum);
        }
    }
    if (status == SUNDER_OK) {
        sunder_separation s;
        status = sunder_pair_separate(p, q, 0, &s, NULL);
        if (status == SUNDER_OK) sunder_separation_clear(&s);
    }
    sunder_shape_free(p);
    sunder_shape_free(q);
    return status;
}

static size_t pages_now(void)
{
    size_t pages = 0;
    FILE *f = fopen("/proc/self/statm", "r");
    if (f) {
        if (fscanf(f, "%zu", &pages) != 1) pages = 0;
        fclose(f);
    }
    return pages;
}

/* Runs in a child process that may allocate this many more bytes. */
static int under_limit(size_t bytes, uint64_t seed)
{
    fflush(NULL);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        const rlim_t limit = (rlim_t)(pages_now() * (size_t)sysconf(_SC_PAGESIZE) + bytes);
        const struct rlimit most = {limit, limit}, no_core = {0, 0};
        setrlimit(RLIMIT_CORE, &no_core);
        if (setrlimit(RLIMIT_AS, &most) != 0) _exit(WRONG);
        const sunder_status status = everything(seed);
        _exit(status == SUNDER_OK ? DONE : status == SUNDER_ENOMEM ? NO_MEMORY : WRONG);
    }
    int how;
    assert_true(waitpid(child, &how, 0) == child);
    if (!WIFEXITED(how))
        fail_msg("SUNDER_SEED=%llu: ended by signal %d with %zu bytes", (unsigned long long)seed, WTERMSIG(how), bytes);
    return WEXITSTATUS(how);
}

static void test_limits(void **state)
{
    (void)state;
#if defined(__SANITIZE_ADDRESS__)
    skip(); /* the sanitizer needs more address space than the limit, and would end the process itself */
#endif
    if (pages_now() == 0) skip();
    int seen[3] = {0, 0, 0};
    for (size_t bytes = 1 << 16; bytes < (size_t)1 << 34; bytes += bytes / 2) {
        const int end = under_limit(bytes, test_seed());
        assert_true(end != WRONG);
        seen[end]++;
        if (end == DONE && seen[DONE] == 3) break;
    }
    print_message("out of memory %d times, done %d times\n", seen[NO_MEMORY], seen[DONE]);
    assert_true(seen[NO_MEMORY] > 0 && seen[DONE] > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_limits)};
    return cmocka_run_group_tests_name("memory limit", tests, NULL, NULL);
}
