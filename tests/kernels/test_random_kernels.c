/* SPDX-License-Identifier: Apache-2.0 */
/* The kernels of random numbers against their twins, which are Random123's own Philox: bit for bit. */
#include <string.h>

#include "core/random.h"
#include "kernels/kernels.h"
#include "test.h"

enum { MAX = 200 };

static const char *const isas[] = {"baseline", "avx2", "avx512"};

static void uniform_equals_reference(void **state)
{
    (void)state;
    const koksma__kernel_table *ref = koksma__kernels_find("ref");
    for (size_t isa = 0; isa < 3; isa++) {
        const koksma__kernel_table *fast = koksma__kernels_find(isas[isa]);
        for (size_t count = 0; fast && count <= MAX; count += 1 + count / 9) {
            double a[2 * MAX + 1] = {0}, b[2 * MAX + 1] = {0};
            ref->uniform(count * 77, 3, 0xfffffff0u + count, 5, count, a);
            fast->uniform(count * 77, 3, 0xfffffff0u + count, 5, count, b);
            assert_memory_equal(a, b, sizeof a);
        }
    }
}

static void words_equal_reference(void **state)
{
    (void)state;
    const koksma__kernel_table *ref = koksma__kernels_find("ref");
    for (size_t isa = 0; isa < 3; isa++) {
        const koksma__kernel_table *fast = koksma__kernels_find(isas[isa]);
        for (size_t count = 0; fast && count <= MAX; count += 1 + count / 9) {
            uint32_t a[4 * MAX + 1] = {0}, b[4 * MAX + 1] = {0};
            ref->words(~count, 9, 0xfffffffffull, 1, count, a);
            fast->words(~count, 9, 0xfffffffffull, 1, count, b);
            assert_memory_equal(a, b, sizeof a);
        }
    }
}

/* Random123's known-answer vector for philox4x32-10 with counter and key of all ones. */
static void philox_known_answer(void **state)
{
    (void)state;
    const koksma__words r = koksma__random(UINT64_MAX, UINT32_MAX, UINT64_MAX, UINT32_MAX);
    const uint32_t expected[4] = {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd};
    assert_memory_equal(r.w, expected, sizeof expected);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(uniform_equals_reference),
        cmocka_unit_test(words_equal_reference),
        cmocka_unit_test(philox_known_answer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
