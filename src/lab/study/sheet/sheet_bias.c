/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Whether the sampler is unbiased over its sets (koksma_verify_sets): the first that a datasheet tells, since the errors of
 * a biased sampler do not fall with more sets, whatever the means of measures say about single sets. The boxes are tested
 * with up to SETS sets of the largest size up to POINTS. Of a sampler without different sets, or with fewer than the test
 * takes, nothing is known.
 */
#include "study/sheet/sheet.h"

#include <stdlib.h>
#include <string.h>

#include <koksma/verify.h>

#include "core/status.h"

enum { SETS = 128, POINTS = 64, PROPERTY = 0 /* unbiased, the first finding */ };

static bool all_equal(const koksma_points *sets, size_t count)
{
    bool equal = true;
    for (size_t i = 1; i < count; i++) {
        equal = equal && !memcmp(sets[i].xs, sets->xs, sets->n * (size_t)sets->dim * sizeof *sets->xs);
    }
    return equal;
}

static koksma_status test(koksma__sheet_bias *bias, const koksma_points *sets, size_t count, const koksma_run *run)
{
    koksma_findings findings = {0};
    if (all_equal(sets, count)) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma_verify_sets(sets, count, run, &findings);
    if (!status) {
        const koksma_finding *found = &findings.items[PROPERTY];
        bias->sets = count;
        bias->biased = !found->holds;
        memcpy(bias->detail, found->detail, sizeof bias->detail);
    }
    koksma_findings_fini(&findings);
    return status;
}

koksma_status koksma__sheet_look_for_bias(koksma__sheet *sheet)
{
    const koksma__sheet_sampler *sampler = sheet->samplers[0];
    const size_t count = koksma__sheet_trials(sampler, SETS);
    sheet->bias.n = koksma__sheet_size(sheet, POINTS);
    if (count < KOKSMA_VERIFY_SETS) {
        return KOKSMA_OK;
    }
    const koksma_run run = koksma__sheet_part(sheet, 0.01, 1), one_set = koksma__sheet_one_set(sheet);
    koksma_points *sets = calloc(count, sizeof *sets);
    KOKSMA__REQUIRE_MEMORY(sets, count * sizeof *sets);
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < count && !status; i++) {
        status = koksma__sheet_points(sampler, sheet->bias.n, 2, i, &one_set, &sets[i]);
    }
    status = status ? status : test(&sheet->bias, sets, count, &run);
    for (size_t i = 0; i < count; i++) {
        koksma_points_fini(&sets[i]);
    }
    free(sets);
    return status;
}

void koksma__sheet_put_bias(koksma__sheet *sheet, koksma__document *d)
{
    const koksma__sheet_bias *bias = &sheet->bias;
    const koksma__sheet_sampler *sampler = sheet->samplers[0];
    char source[2 * KOKSMA_MAX_SPEC];
    koksma__doc_paragraph_begin(d);
    if (bias->biased) {
        koksma__doc_say(
            d,
            "*Biased*: over %zu sets of %zu points the mean share of the points in a box is not its volume "
            "(%s). No number of sets averages this error away, so that this sheet calls the sampler best in "
            "nothing, and its gains are no gains.",
            bias->sets, bias->n, bias->detail);
    } else if (bias->sets) {
        koksma__doc_say(
            d,
            "Unbiased, as far as %zu sets of %zu points show: the mean share of the points agrees with the "
            "volume in every box that `koksma verify --seeds` tests.",
            bias->sets, bias->n);
    } else {
        koksma__doc_say(
            d, "Whether the sampler is unbiased is not known: that takes %d different sets, one for each seed.",
            KOKSMA_VERIFY_SETS);
    }
    koksma__doc_paragraph_end(d);
    if (bias->sets) {
        koksma__sheet_source(sampler, bias->n, 2, source, sizeof source);
        koksma__sheet_command(sheet, "verify %s --seeds %zu --seed %llu", source, bias->sets,
                              (unsigned long long)sampler->seed);
        koksma__sheet_put_commands(sheet, d);
    }
}
