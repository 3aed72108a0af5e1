/* SPDX-License-Identifier: Apache-2.0 */
/* The limits of what the blocks of a plan have together: lists that have lengths only, as the check looks at nothing
   else, exactly at each limit and one above it. */
#include <string.h>

#include "core/status.h"
#include "study/run/tasks.h"
#include "test.h"

/* A block of sets of points and one of images; both count. */
static koksma_status check(const koksma__discrepancy_block *sets, const koksma__image_block *images,
                           const koksma__sink *sink)
{
    koksma__discrepancy_block discrepancies[] = {*sets};
    koksma__image_block pictures[] = {*images};
    char name[] = "p";
    const koksma_study study = {.plan = {.name = name,
                                         .n_discrepancies = 1,
                                         .discrepancies = discrepancies,
                                         .n_images = 1,
                                         .images = pictures},
                                .sink = sink};
    return koksma__task_limits_check(&study);
}

static void expect(const koksma__discrepancy_block *sets, const koksma__image_block *images, const char *reason)
{
    const koksma__sink audit = {0};
    assert_ok(check(sets, images, &audit)); /* the plan of an audit is as long as its store */
    if (!reason) {
        assert_ok(check(sets, images, NULL));
        return;
    }
    assert_int_equal(check(sets, images, NULL), KOKSMA_ARGUMENT);
    assert_string_equal(koksma_error_text(), reason);
}

static void sums_of_blocks(void **state)
{
    (void)state;
    koksma__discrepancy_block sets = {
        .patterns.n = 256, .n.n = 512, .measures.n = 1}; /* 2^17 tasks; no warps count as one */
    koksma__image_block images = {
        .patterns.n = 64, .spp.n = 64, .scenes.n = 8, .variants.n = 4, .n_references = 2, .metrics.n = 5};
    static const char tasks[] =
        "plan 'p': more than 262144 combinations of patterns, sizes, warps, scenes and options",
                      series[] =
                          "plan 'p': more than 2097152 combinations of these with measures, references and metrics",
                      references[] = "plan 'p': more than 65536 images for reference";
    expect(&sets, &images, NULL);
    images.variants.n = 5;
    expect(&sets, &images, tasks);
    images.variants.n = 4;
    sets.warps.n = 2;
    expect(&sets, &images, tasks);
    sets.warps.n = 0;
    sets.measures.n = 8; /* 2^20 series of each block */
    expect(&sets, &images, NULL);
    images.metrics.n = 6;
    expect(&sets, &images, series);
    sets = (koksma__discrepancy_block){0};
    images = (koksma__image_block){.patterns.n = 1, .spp.n = 1, .scenes.n = 128, .variants.n = 8, .n_references = 64};
    expect(&sets, &images, NULL);
    images.n_references = 65;
    expect(&sets, &images, references);
    images.patterns.n = images.spp.n = images.scenes.n = images.variants.n = images.n_references = (size_t)1 << 30;
    expect(&sets, &images, tasks); /* a product above that of any integer */
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sums_of_blocks)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
