/* SPDX-License-Identifier: Apache-2.0 */
/* Mutator: fuzz/mutate_json.c */
/* Fuzzes the parser of plans: any text gives a plan or an error. */
#include "study/plan/plan_read.h"
#include "target.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    koksma__plan plan = {0};
    const koksma__plan_trials trials = {0};
    fuzz_check_status(koksma__plan_parse("fuzz", (const char *)bytes, size, &trials, &plan));
    koksma__plan_fini(&plan);
    return 0;
}
