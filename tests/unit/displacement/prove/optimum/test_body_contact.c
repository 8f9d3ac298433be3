/* displacement/prove/optimum/body_contact: the contact of bodies with many pieces that were moved far is found as for
 * others. */
#include "scene_model.h"

#include "displacement/prove/optimum/body_contact.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* A body of many pieces in the box 0..80 by 0..4: it has more pairs of pieces with another body than a tree
 * examines. */
enum { TEETH = 80 };

static const double gap = 3;

static char *comb(void)
{
    const size_t room = 64 * 4 * TEETH;
    char *wkt = malloc(room);
    size_t n = (size_t)snprintf(wkt, room, "POLYGON ((0 0, %d 0", TEETH);
    for (int k = TEETH - 1; k >= 0; k--) {
        n += (size_t)snprintf(wkt + n, room - n, ", %s%d.75 4, %d.25 4", k == TEETH - 1 ? "80 4, " : "", k, k);
        if (k > 0) n += (size_t)snprintf(wkt + n, room - n, ", %d 2", k);
    }
    snprintf(wkt + n, room - n, ", 0 0))");
    return wkt;
}

static void test_far(void **state)
{
    (void)state;
    scene s;
    scene_model m;
    char *wkt = comb();
    scene_begin(&s, gap);
    s.options.allow_jumps = true;
    scene_add(&s, wkt);
    scene_add(&s, wkt);
    scene_model_begin(&m, &s);
    assert_true(m.model.bodies == 2 && m.model.body[0].pieces * m.model.body[1].pieces > 4096);
    for (int k = 0; k < 6; k++) {
        /* Side by side: they are in contact at the right distance, and not at a smaller or greater one. */
        const double side = k < 3 ? 1 : -1, t[2] = {-40 * side, 0}, v[2] = {side * (43 + 0.25 * (k % 3 - 1)), 0};
        bool contact;
        assert_true(sunder_i_are_in_contact(&m.model, 0, 1, t, v, &contact));
        if (k % 3 != 0) assert_true(contact == (k % 3 == 1));
        sunder_i_contact_list list = {0};
        assert_true(sunder_i_contacts_of_pair(&m.model, &(sunder_i_waived){0}, 0, 1, t, v, 0x1p-20, &list, NULL));
        assert_true((list.n > 0) == (k % 3 == 1));
        for (size_t i = 0; i < list.n; i++) assert_true(side * list.item[i].n[0] > 0.999);
        sunder_i_free(list.item);
    }
    scene_model_end(&m);
    scene_end(&s);
    free(wkt);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_far)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
