/* SPDX-License-Identifier: Apache-2.0 */
/* Specs of patterns, measures, integrands and adaptive methods, and the patterns of a renderer's uses: what parses has a
   canonical text, which parses to the same. */
#include <koksma/adaptive.h>
#include <koksma/integrate.h>

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

static void check_adaptive(const char *text)
{
    char first[KOKSMA_MAX_SPEC], second[KOKSMA_MAX_SPEC];
    koksma_adaptive_options options;
    const koksma_status status = koksma_adaptive_parse(text, &options);
    fuzz_check_status(status);
    if (!status) {
        koksma_adaptive_text(&options, first);
        if (koksma_adaptive_parse(first, &options)) {
            abort();
        }
        koksma_adaptive_text(&options, second);
        if (strcmp(first, second)) {
            abort();
        }
    }
}

static void check_uses(const char *text)
{
    char first[KOKSMA_MAX_PATTERNS_TEXT], second[KOKSMA_MAX_PATTERNS_TEXT];
    koksma_render_options options = {0}, again = {0};
    const koksma_status status = koksma_render_patterns(text, &options);
    fuzz_check_status(status);
    if (!status && options.pattern.pattern) {
        koksma_render_patterns_text(&options, first);
        if (koksma_render_patterns(first, &again)) {
            abort();
        }
        koksma_render_patterns_text(&again, second);
        if (strcmp(first, second)) {
            abort();
        }
    }
}

/* An integrand's canonical text opens again, as the same. */
static void check_integrand(const char *text)
{
    koksma_integral *integral;
    koksma_integral_facts first, second;
    const koksma_status status = koksma_integral_open(text, 2, &integral);
    fuzz_check_status(status);
    if (status) {
        return;
    }
    koksma_integral_about(integral, &first);
    koksma_integral_close(integral);
    if (koksma_integral_open(first.text, 2, &integral)) {
        abort();
    }
    koksma_integral_about(integral, &second);
    koksma_integral_close(integral);
    if (strcmp(first.text, second.text)) {
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
    check_adaptive(text);
    check_integrand(text);
    check_uses(text);
    free(text);
    return 0;
}
