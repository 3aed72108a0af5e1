/* SPDX-License-Identifier: Apache-2.0 */
/* Specs: what parses has a canonical text, which parses to the same; and small sets of it can be made. */
#include "target.h"

static void check_round_trip(const koksma_spec *spec, koksma_status (*parse)(const char *, koksma_spec *))
{
    char first[KOKSMA_MAX_SPEC], second[KOKSMA_MAX_SPEC];
    koksma_spec again;
    koksma_spec_text(spec, first);
    if (parse(first, &again)) {
        abort();
    }
    koksma_spec_text(&again, second);
    if (strcmp(first, second)) {
        abort();
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    koksma_spec spec;
    char *text = malloc(size + 1);
    if (!text) {
        return 0;
    }
    memcpy(text, bytes, size);
    text[size] = '\0';
    koksma_status status = koksma_pattern_spec(text, &spec);
    fuzz_check_status(status);
    if (!status) {
        check_round_trip(&spec, koksma_pattern_spec);
    }
    status = koksma_measure_spec(text, &spec);
    fuzz_check_status(status);
    if (!status) {
        check_round_trip(&spec, koksma_measure_spec);
    }
    free(text);
    return 0;
}
