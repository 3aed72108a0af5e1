/* SPDX-License-Identifier: Apache-2.0 */
/* The tree of names: each of 100,000 is found, the last thing of a name counts, and what was not put is not there. Names
   that are made to have hashes alike are found in at most 65 steps, too. */
#include <stdio.h>
#include <string.h>

#include "core/hash.h"
#include "meshes/names.h"
#include "test.h"

TEST_CASE(names_are_found)
{
    koksma__names names = {0};
    char name[32];
    size_t index;
    assert_false(koksma__names_find(&names, "", 0, &index));
    for (size_t round = 0; round < 2; round++) {
        for (size_t i = 0; i < 100000; i++) {
            snprintf(name, sizeof name, "name %zu", i);
            assert_ok(koksma__names_put(&names, name, strlen(name), i + round * (i % 3)));
        }
    }
    for (size_t i = 0; i < 100000; i++) {
        snprintf(name, sizeof name, "name %zu", i);
        assert_true(koksma__names_find(&names, name, strlen(name), &index));
        assert_int_equal(index, i + i % 3);
    }
    assert_false(koksma__names_find(&names, "name 100000", 11, &index));
    assert_false(koksma__names_find(&names, "", 0, &index));
    koksma__names_fini(&names);
}

/* The number of nodes on the longest way down from a node. */
static size_t steps_from(const koksma__names *names, size_t at, size_t depth)
{
    size_t most = 0;
    assert_true(depth <= 64);
    for (int side = 0; side < 2; side++) {
        const size_t next = names->nodes[at].next[side];
        const size_t steps = next ? steps_from(names, next, depth + 1) : 0;
        most = steps > most ? steps : most;
    }
    return most + 1;
}

/* Puts `n` names whose hashes have the same bits under `mask`; returns the most steps to one of them. */
static size_t steps_of_alike(uint64_t mask, size_t n)
{
    koksma__names names = {0};
    char name[32];
    size_t index;
    for (uint64_t i = 0; names.n < n; i++) {
        snprintf(name, sizeof name, "%llx", (unsigned long long)i);
        if (!(koksma__hash(name, strlen(name)) & mask)) {
            assert_ok(koksma__names_put(&names, name, strlen(name), (size_t)i));
        }
    }
    for (size_t i = 0, found = 0; found < n; i++) {
        snprintf(name, sizeof name, "%llx", (unsigned long long)i);
        const bool is_alike = !(koksma__hash(name, strlen(name)) & mask);
        assert_int_equal(koksma__names_find(&names, name, strlen(name), &index), is_alike);
        assert_int_equal(index, is_alike ? i : 0);
        found += is_alike;
    }
    const size_t steps = steps_from(&names, 0, 0);
    koksma__names_fini(&names);
    return steps;
}

TEST_CASE(names_alike_take_few_steps)
{
    /* 10 equal bits lengthen the ways of 2,000 names, which are 11 nodes at least, by 10 if the tree reads these bits */
    const size_t even = steps_of_alike(0, 2000), low = steps_of_alike(1023, 2000);
    assert_in_range(even, 11, 30);
    assert_in_range(low, 21, 40);
    assert_in_range(steps_of_alike((uint64_t)1023 << 54, 2000), 11, 30);
    assert_in_range(steps_of_alike((uint64_t)1023 << 1, 2000), 20, 40);
}
