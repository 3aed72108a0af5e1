/* SPDX-License-Identifier: Apache-2.0 */
/* The table of names: each of 100,000 is found, the last thing of a name counts, and what was not put is not there. */
#include <stdio.h>

#include "scene/names.h"
#include "test.h"

static void names_are_found(void **state)
{
    koksma__names names = {0};
    char name[32];
    size_t index;
    (void)state;
    assert_false(koksma__names_find(&names, "", &index));
    for (size_t round = 0; round < 2; round++) {
        for (size_t i = 0; i < 100000; i++) {
            snprintf(name, sizeof name, "name %zu", i);
            assert_ok(koksma__names_put(&names, name, i + round * (i % 3)));
        }
    }
    for (size_t i = 0; i < 100000; i++) {
        snprintf(name, sizeof name, "name %zu", i);
        assert_true(koksma__names_find(&names, name, &index));
        assert_int_equal(index, i + i % 3);
    }
    assert_false(koksma__names_find(&names, "name 100000", &index));
    assert_false(koksma__names_find(&names, "", &index));
    koksma__names_fini(&names);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(names_are_found)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
