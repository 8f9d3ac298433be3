/* Conflicts that are proved to have no room: of a block with many parts, and in a courtyard without a limit. */
#include "random.h"
#include "scene.h"
#include "sunder_proof.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

enum { MEMBERS = 15, PARTS = 16, FIELD = 100 };

/* A unit square at a random place of the field, away from all others. */
static sunder_feature *add_strewn(scene *s, rng *r)
{
    char wkt[PARTS * 120 + 20];
    double at[2 * PARTS];
    int n = snprintf(wkt, sizeof wkt, "MULTIPOLYGON (");
    for (int k = 0; k < PARTS; k++) {
        bool apart;
        do {
            for (int c = 0; c < 2; c++) at[2 * k + c] = FIELD * rng_unit(r);
            apart = true;
            for (int l = 0; l < k; l++)
                apart = apart && fmax(fabs(at[2 * k] - at[2 * l]), fabs(at[2 * k + 1] - at[2 * l + 1])) > 2;
        } while (!apart);
        const double x = at[2 * k], y = at[2 * k + 1];
        n += snprintf(wkt + n, sizeof wkt - (size_t)n, "%s((%.3f %.3f, %.3f %.3f, %.3f %.3f, %.3f %.3f, %.3f %.3f))",
                      k ? ", " : "", x, y, x + 1, y, x + 1, y + 1, x, y + 1, x, y);
    }
    snprintf(wkt + n, sizeof wkt - (size_t)n, ")");
    return scene_add(s, wkt);
}

/* Hundreds of squares that move as one block, among as many fixed ones: in every position some of them overlap. Each
 * conflict needs its own proof, with hundreds of squares. */
static void check_strewn_block(void **state)
{
    rng r = rng_start(7, 0);
    scene s;
    size_t n, proved = 0;
    scene_begin(&s, 0.5);
    s.options.effort = 0;
    s.options.touch_tolerance = 0;
    for (int k = 0; k < 2 * MEMBERS; k++) {
        sunder_feature *f = add_strewn(&s, &r);
        f->max_shift = 10;
        f->block = k < MEMBERS ? 0 : -1;
        f->fixed = k >= MEMBERS;
    }
    scene_separate(&s);
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    for (size_t k = 0; k < n; k++) {
        if (c[k].inside_block) continue;
        assert_int_not_equal(c[k].reason, SUNDER_REASON_UNRESOLVED);
        proved += c[k].reason == SUNDER_REASON_NO_ROOM;
    }
    assert_true(proved > 40);
    scene_end(&s);
}

/* A hut in a courtyard of four walls, without a limit: beside each of two opposite walls there would be room if it were
 * not for the other, and jumping out is forbidden. */
static void check_tight_yard(void **state)
{
    scene s;
    size_t n;
    scene_begin(&s, 3);
    s.options.effort = 0;
    scene_add_box(&s, 0, 0, 30, 5);
    scene_add_box(&s, 0, 25, 30, 5);
    scene_add_box(&s, 0, 5, 5, 20);
    scene_add_box(&s, 25, 5, 5, 20);
    scene_add_box(&s, 7, 10, 16, 10);
    for (int dropped = 0; dropped < 2; dropped++) { /* the features that a proof names are known even if it is not
                                                     * stored */
        s.options.drop_proofs = dropped;
        scene_separate(&s);
        const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
        assert_int_equal(scene_left(&s), 2);
        for (size_t k = 0; k < n; k++) {
            if (c[k].inside_block) continue;
            const sunder_proof *proof = sunder_report_proof(s.report, k);
            assert_int_equal(c[k].reason, SUNDER_REASON_NO_ROOM);
            assert_int_equal(c[k].n_blocked_by, 3); /* the opposite wall, and the walls over which it would leave */
            assert_true(dropped ? !proof : proof && proof->within > 0);
        }
    }
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_strewn_block), cmocka_unit_test(check_tight_yard)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
