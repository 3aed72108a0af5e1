/* SPDX-License-Identifier: Apache-2.0 */
/* Specs as text, "name" or "name:key=value,key=value", are parsed with the table of parameters of a pattern or
   measure, and printed in a canonical form: parameters are in table order, those at their default are left out, and
   numbers are the shortest decimals that read back to the same double. api/specs.c looks up the names of patterns and
   measures. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/lookup.h"
#include "core/spec.h"
#include "core/status.h"

static const char *choice_at(const void *choices, size_t i)
{
    return ((const char *const *)choices)[i];
}

static koksma_status parse_choice(const char *member, const koksma_param *param, const char *text, double *value)
{
    char words[256] = "";
    for (int i = 0; param->choices[i]; i++) {
        if (!strcmp(param->choices[i], text)) {
            *value = i;
            return KOKSMA_OK;
        }
        snprintf(words + strlen(words), sizeof words - strlen(words), "%s%s", i ? ", " : "", param->choices[i]);
    }
    char meant[KOKSMA__MEANT];
    return koksma__fail(KOKSMA_ARGUMENT, "%s: %s=%s: %sit takes %s", member, param->name, text,
                        koksma__meant(text, choice_at, param->choices, meant), words);
}

/* Checks a value's range. The value 0 of a modifier, which may be below its range, means that the modifier is not
   applied. */
static koksma_status check_range(const char *member, const koksma_param *param, double value)
{
    if (param->whole && value != floor(value)) {
        return koksma__fail(KOKSMA_ARGUMENT, "%s: %s=%.17g: it takes whole numbers", member, param->name, value);
    }
    if (value != param->fallback && !(value >= param->min && value <= param->max)) {
        const bool below = param->fallback < param->min;
        return koksma__fail(KOKSMA_ARGUMENT,
                            below ? "%s: %s=%.17g: it takes 0 or %.9g to %.9g"
                                  : "%s: %s=%.17g: it takes %.9g to %.9g",
                            member, param->name, value, param->min, param->max);
    }
    return KOKSMA_OK;
}

static koksma_status parse_value(const char *member, const koksma_param *param, const char *text, double *value)
{
    if (param->choices) {
        return parse_choice(member, param, text, value);
    }
    char *end;
    *value = koksma__strtod(text, &end);
    if (end == text || *end) {
        return koksma__fail(KOKSMA_ARGUMENT, "%s: %s=%s: not a number", member, param->name, text);
    }
    return check_range(member, param, *value);
}

static int find_param(const koksma_param *params, const char *name)
{
    for (int i = 0; params && params[i].name; i++) {
        if (!strcmp(params[i].name, name)) {
            return i;
        }
    }
    return -1;
}

static const char *param_name(const void *params, size_t i)
{
    return params ? ((const koksma_param *)params)[i].name : NULL;
}

static koksma_status fail_unknown_param(const char *member, const koksma_param *params, const char *key)
{
    char names[256] = "";
    for (int i = 0; params && params[i].name; i++) {
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", i ? ", " : "", params[i].name);
    }
    char meant[KOKSMA__MEANT];
    return koksma__fail(KOKSMA_ARGUMENT, "%s: no parameter '%s'; %sit has %s", member, key,
                        koksma__meant(key, param_name, params, meant), *names ? names : "none");
}

/* Reports a word without '=': the name of a parameter, or a value without its name. */
static koksma_status fail_no_value(const char *member, const koksma_param *params, const char *word)
{
    for (int i = 0; params && params[i].name; i++) {
        const koksma_param *param = &params[i];
        for (int k = 0; param->choices && param->choices[k]; k++) {
            KOKSMA__FAIL_IF(!strcmp(word, param->choices[k]), KOKSMA_ARGUMENT, "%s: did you mean %s=%s?", member,
                            param->name, word);
        }
    }
    const int i = find_param(params, word);
    KOKSMA__FAIL_IF(i >= 0, KOKSMA_ARGUMENT, "%s: '%s' takes a value, as in %s=%s", member, word, word,
                    i >= 0 && params[i].choices ? params[i].choices[1] ? params[i].choices[1] : "" : "1");
    const bool alone = params && params[0].name && !params[1].name && !params[0].choices;
    KOKSMA__FAIL_IF(alone && *word && strspn(word, "0123456789.") == strlen(word), KOKSMA_ARGUMENT,
                    "%s: did you mean %s=%s?", member, params[0].name, word);
    return koksma__fail(KOKSMA_ARGUMENT, "%s: '%s' is not of the form key=value", member, word);
}

koksma_status koksma__params_parse(const char *member, const koksma_param *params, const char *text, double *values)
{
    for (int i = 0; params && params[i].name; i++) {
        values[i] = params[i].fallback;
    }
    unsigned seen = 0;
    while (text && *text) {
        char pair[128];
        const size_t length = strcspn(text, ",");
        if (length >= sizeof pair) {
            return koksma__fail(KOKSMA_ARGUMENT, "%s: parameter '%.20s...' is too long", member, text);
        }
        memcpy(pair, text, length);
        pair[length] = '\0';
        text += length + (text[length] == ',');
        char *equals = strchr(pair, '=');
        if (!equals) {
            return fail_no_value(member, params, pair);
        }
        *equals = '\0';
        const int i = find_param(params, pair);
        if (i < 0) {
            return fail_unknown_param(member, params, pair);
        }
        if (seen & 1u << i) {
            return koksma__fail(KOKSMA_ARGUMENT, "%s: %s is given twice", member, pair);
        }
        seen |= 1u << i;
        const koksma_status status = parse_value(member, &params[i], equals + 1, &values[i]);
        if (status) {
            return status;
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma__spec_split(const char *text, char *name, const char **rest)
{
    if (!text) {
        return koksma__fail(KOKSMA_ARGUMENT,
                            "the spec is empty; it takes a text such as name or name:key=value,key=value");
    }
    const size_t length = strcspn(text, ":");
    KOKSMA__FAIL_IF(length == 0 && !*text, KOKSMA_ARGUMENT,
                    "a name is empty; commas and @ stand without blanks, as in star,extreme or sobol@16");
    if (length == 0 || length >= 64) {
        return koksma__fail(KOKSMA_ARGUMENT, "'%.64s' is not of the form name or name:key=value,key=value", text);
    }
    memcpy(name, text, length);
    name[length] = '\0';
    *rest = text[length] == ':' ? text + length + 1 : "";
    return KOKSMA_OK;
}

/* Writes the shortest decimal that reads back to the same double; whole numbers below 1e15 have no
   exponent. */
static void shortest(double value, char *text, size_t size)
{
    if (value == floor(value) && fabs(value) < 1e15) {
        koksma__snprintf(text, size, "%.0f", value);
        return;
    }
    for (int digits = 1; digits <= 17; digits++) {
        koksma__snprintf(text, size, "%.*g", digits, value);
        if (koksma__strtod(text, NULL) == value) {
            return;
        }
    }
}

void koksma__params_text(const koksma_param *params, const double *values, char *text, size_t size)
{
    char separator = strchr(text, ':') ? ',' : ':';
    for (int i = 0; params && params[i].name; i++) {
        if (values[i] == params[i].fallback) {
            continue;
        }
        char number[40];
        shortest(values[i], number, sizeof number);
        const bool chosen = params[i].choices && values[i] >= params[i].min && values[i] <= params[i].max;
        const size_t used = strlen(text);
        snprintf(text + used, size - used, "%c%s=%s", separator, params[i].name,
                 chosen ? params[i].choices[(int)values[i]] : number);
        separator = ',';
    }
}

void koksma_spec_text(const koksma_spec *spec, char *text)
{
    KOKSMA__REQUIRE_OR(, spec, text);
    const bool is_pattern = spec->pattern != NULL;
    const char *name = is_pattern ? spec->pattern->name : spec->measure ? spec->measure->name : NULL;
    *text = '\0';
    if (!name) {
        return;
    }
    snprintf(text, KOKSMA_MAX_SPEC, "%s", name);
    if (!is_pattern) {
        koksma__params_text(spec->measure->params, spec->params, text, KOKSMA_MAX_SPEC);
        return;
    }
    koksma__all_params all;
    koksma__all_params_init(&all, spec->pattern->params);
    double values[KOKSMA_MAX_PARAMS + KOKSMA_MAX_MODIFIERS];
    memcpy(values, spec->params, all.own * sizeof *values);
    memcpy(values + all.own, spec->modifiers, sizeof spec->modifiers);
    if (spec->pattern->operand) {
        const size_t used = strlen(text);
        snprintf(text + used, KOKSMA_MAX_SPEC - used, ":%.*s", KOKSMA_MAX_SPEC - 80, spec->path);
    }
    koksma__params_text(all.params, values, text, KOKSMA_MAX_SPEC);
}

koksma_status koksma__params_check(const char *member, const koksma_param *params, const double *values)
{
    koksma_status status = KOKSMA_OK;
    for (int i = 0; !status && params && params[i].name; i++) {
        status = check_range(member, &params[i], values[i]);
    }
    return status;
}

koksma_status koksma__modifiers_check(const char *pattern, const double *values)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; koksma_modifier_at(i) && !status; i++) {
        if (values[i] == 0) { /* 0 means not applied and is always accepted */
            continue;
        }
        const koksma_param params[] = {koksma__modifier_param(i), {0}};
        status = koksma__params_check(pattern, params, &values[i]);
    }
    return status;
}

koksma_status koksma__dim_check(const char *member, int dim, int min_dim, int max_dim)
{
    if (dim >= min_dim && dim <= max_dim) {
        return KOKSMA_OK;
    }
    if (min_dim == max_dim) {
        return koksma__fail(KOKSMA_DIM, "%s: it has no %d-dimensional form, only dim = %d", member, dim, min_dim);
    }
    return koksma__fail(KOKSMA_DIM, "%s: it has no %d-dimensional form, only dim = %d to %d", member, dim, min_dim,
                        max_dim);
}

koksma_args koksma__spec_arguments(const koksma_spec *spec, const koksma_run *run)
{
    koksma_args args = {.run = run, .path = spec->path};
    memcpy(args.params, spec->params, sizeof args.params);
    return args;
}
