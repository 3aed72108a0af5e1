/* SPDX-License-Identifier: Apache-2.0 */
/* koksma_pattern_spec and koksma_measure_spec: parse a text into a pattern or measure with its parameters. Every
   pattern also accepts the modifiers; an alias is replaced by the pattern that it stands for. */
#include <stdio.h>
#include <string.h>

#include "core/lookup.h"
#include "core/spec.h"
#include "core/status.h"

KOKSMA__NAME_AT(koksma_pattern)
KOKSMA__NAME_AT(koksma_measure)

koksma_status koksma_pattern_spec(const char *text, koksma_spec *spec)
{
    KOKSMA__REQUIRE(text, spec);
    char name[64];
    const char *rest = "";
    *spec = (koksma_spec){0};
    KOKSMA__TRY(koksma__spec_split(text, name, &rest));
    const koksma_pattern *pattern = koksma_pattern_find(name);
    if (!pattern) {
        char hint[sizeof name + 64] = "'koksma list patterns' names them", head[sizeof name];
        snprintf(head, sizeof head, "%.*s", (int)strcspn(name, ", "), name);
        if (strpbrk(name, "./{")) { /* no pattern's name contains these characters */
            snprintf(hint, sizeof hint, "points in a file are a pattern, as in file:%s", name);
        } else if (strpbrk(name, "()[]?") || (koksma_pattern_find(head) && strchr(name, '='))) {
            strcpy(hint, "parameters follow a colon, as in sobol:scramble=owen");
        }
        return koksma__fail_unknown("pattern", name, koksma_pattern_name_at, NULL, hint);
    }
    spec->pattern = pattern = pattern->alias_of ? koksma_pattern_find(pattern->alias_of) : pattern;
    koksma__all_params all;
    double values[KOKSMA_MAX_PARAMS + KOKSMA_MAX_MODIFIERS] = {0};
    koksma__all_params_init(&all, pattern->params);
    if (pattern->operand) {
        const char *end = koksma__modifiers_of_path(rest);
        const size_t length = (size_t)(end - rest);
        KOKSMA__FAIL_IF(length == 0 || length >= KOKSMA_MAX_SPEC - 80, KOKSMA_ARGUMENT,
                        "%s: the text after the colon must have 1 to %d characters, as in %s:%s", name,
                        KOKSMA_MAX_SPEC - 81, name, pattern->operand);
        memcpy(spec->path, rest, length);
        rest = end + (*end == ',');
    }
    KOKSMA__TRY(koksma__params_parse(name, all.params, rest, values));
    memcpy(spec->params, values, all.own * sizeof *values);
    memcpy(spec->modifiers, values + all.own, sizeof spec->modifiers);
    return KOKSMA_OK;
}

koksma_status koksma_measure_spec(const char *text, koksma_spec *spec)
{
    KOKSMA__REQUIRE(text, spec);
    char name[64];
    const char *rest = "";
    *spec = (koksma_spec){0};
    KOKSMA__TRY(koksma__spec_split(text, name, &rest));
    spec->measure = koksma_measure_find(name);
    if (!spec->measure) {
        return koksma__fail_unknown("measure", name, koksma_measure_name_at, NULL,
                                    "'koksma list measures' names them");
    }
    return koksma__params_parse(name, spec->measure->params, rest, spec->params);
}
