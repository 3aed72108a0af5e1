/* SPDX-License-Identifier: Apache-2.0 */
/* koksma_pattern_spec and koksma_measure_spec: a text becomes a member of the tables of patterns or measures with its
   parameters. Beside its own, every pattern takes shift=0 or shift=1; an alias becomes the pattern that it names. */
#include <stdio.h>
#include <string.h>

#include "core/lookup.h"
#include "core/spec.h"
#include "core/status.h"
#include "core/suggestion.h"

/* Copies rest to others without the parameter that all patterns have, "shift=0" or "shift=1". */
static koksma_status take_shift(const char *name, const char *rest, char *others, bool *shift)
{
    size_t used = 0;
    bool seen = false;
    if (strlen(rest) >= KOKSMA_MAX_SPEC) {
        return koksma__fail(KOKSMA_ARGUMENT, "%s: its parameters are longer than %d characters", name,
                            KOKSMA_MAX_SPEC - 1);
    }
    while (*rest) {
        const size_t length = strcspn(rest, ",");
        if (!strncmp(rest, "shift=", 6)) {
            if (length != 7 || (rest[6] != '0' && rest[6] != '1')) {
                return koksma__fail(KOKSMA_ARGUMENT, "%s: %.*s: it takes 0 or 1", name, (int)length, rest);
            }
            if (seen) {
                return koksma__fail(KOKSMA_ARGUMENT, "%s: shift is given twice", name);
            }
            seen = true;
            *shift = rest[6] == '1';
        } else {
            memcpy(others + used + (used > 0), rest, length);
            if (used) {
                others[used++] = ',';
            }
            used += length;
        }
        rest += length + (rest[length] == ',');
    }
    others[used] = '\0';
    return KOKSMA_OK;
}

KOKSMA__NAME_AT(koksma_pattern)
KOKSMA__NAME_AT(koksma_measure)

koksma_status koksma_pattern_spec(const char *text, koksma_spec *spec)
{
    KOKSMA__REQUIRE(text, spec);
    char name[64];
    const char *rest = "";
    *spec = (koksma_spec){0};
    const koksma_status status = koksma__spec_split(text, name, &rest);
    if (status) {
        return status;
    }
    const koksma_pattern *pattern = koksma_pattern_find(name);
    if (!pattern) {
        return koksma__fail_unknown("pattern", name, koksma_pattern_name_at, NULL,
                                    "'koksma list patterns' names them");
    }
    spec->pattern = pattern = pattern->alias_of ? koksma_pattern_find(pattern->alias_of) : pattern;
    if (!pattern->takes_path) {
        char others[KOKSMA_MAX_SPEC];
        const koksma_status taken = take_shift(name, rest, others, &spec->shift);
        return taken ? taken : koksma__params_parse(name, pattern->params, others, spec->params);
    }
    const char *end = strrchr(rest, ',');
    spec->shift = end && !strcmp(end, ",shift=1");
    const size_t length = strlen(rest) - (spec->shift ? strlen(",shift=1") : 0);
    if (length == 0 || length >= KOKSMA_MAX_SPEC - 80) {
        return koksma__fail(KOKSMA_ARGUMENT, "%s: it takes a path of 1 to %d characters, as in %s:PATH", name,
                            KOKSMA_MAX_SPEC - 81, name);
    }
    memcpy(spec->path, rest, length);
    return KOKSMA_OK;
}

koksma_status koksma_measure_spec(const char *text, koksma_spec *spec)
{
    KOKSMA__REQUIRE(text, spec);
    char name[64];
    const char *rest = "";
    *spec = (koksma_spec){0};
    const koksma_status status = koksma__spec_split(text, name, &rest);
    if (status) {
        return status;
    }
    spec->measure = koksma_measure_find(name);
    if (!spec->measure) {
        return koksma__fail_unknown("measure", name, koksma_measure_name_at, NULL,
                                    "'koksma list measures' names them");
    }
    return koksma__params_parse(name, spec->measure->params, rest, spec->params);
}
