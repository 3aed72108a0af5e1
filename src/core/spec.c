/* SPDX-License-Identifier: Apache-2.0 */
/* Specs: "name" or "name:key=value,key=value", and the two public calls that check arguments for every member of
   the tables. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/points_io.h"
#include "core/random.h"
#include "core/spec.h"
#include "core/status.h"

static koksma_status parse_choice(const char *owner, const koksma_param *param, const char *text, double *value)
{
    char words[256] = "";
    for (int i = 0; param->choices[i]; i++) {
        if (!strcmp(param->choices[i], text)) {
            *value = i;
            return KOKSMA_OK;
        }
        snprintf(words + strlen(words), sizeof words - strlen(words), "%s%s", i ? ", " : "", param->choices[i]);
    }
    return koksma__fail(KOKSMA_ARGUMENT, "%s: %s=%s: it takes %s", owner, param->name, text, words);
}

static koksma_status check_range(const char *owner, const koksma_param *param, double value)
{
    if (param->whole && value != floor(value)) {
        return koksma__fail(KOKSMA_ARGUMENT, "%s: %s=%.17g: it takes whole numbers", owner, param->name, value);
    }
    if (!(value >= param->min && value <= param->max)) {
        return koksma__fail(KOKSMA_ARGUMENT, "%s: %s=%.17g: it takes %.9g to %.9g", owner, param->name, value,
                            param->min, param->max);
    }
    return KOKSMA_OK;
}

static koksma_status parse_value(const char *owner, const koksma_param *param, const char *text, double *value)
{
    if (param->choices) {
        return parse_choice(owner, param, text, value);
    }
    char *end;
    *value = koksma__strtod(text, &end);
    if (end == text || *end) {
        return koksma__fail(KOKSMA_ARGUMENT, "%s: %s=%s: not a number", owner, param->name, text);
    }
    return check_range(owner, param, *value);
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

static koksma_status fail_unknown_param(const char *owner, const koksma_param *params, const char *key)
{
    char names[256] = "";
    for (int i = 0; params && params[i].name; i++) {
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", i ? ", " : "", params[i].name);
    }
    return koksma__fail(KOKSMA_ARGUMENT, "%s: no parameter '%s'; it has %s", owner, key, *names ? names : "none");
}

koksma_status koksma__params_parse(const char *owner, const koksma_param *params, const char *text, double *values)
{
    for (int i = 0; params && params[i].name; i++) {
        values[i] = params[i].fallback;
    }
    unsigned seen = 0;
    while (text && *text) {
        char pair[128];
        const size_t length = strcspn(text, ",");
        if (length >= sizeof pair) {
            return koksma__fail(KOKSMA_ARGUMENT, "%s: parameter '%.20s...' is too long", owner, text);
        }
        memcpy(pair, text, length);
        pair[length] = '\0';
        text += length + (text[length] == ',');
        char *equals = strchr(pair, '=');
        if (!equals) {
            return koksma__fail(KOKSMA_ARGUMENT, "%s: '%s' is not of the form key=value", owner, pair);
        }
        *equals = '\0';
        const int i = find_param(params, pair);
        if (i < 0) {
            return fail_unknown_param(owner, params, pair);
        }
        if (seen & 1u << i) {
            return koksma__fail(KOKSMA_ARGUMENT, "%s: %s is given twice", owner, pair);
        }
        seen |= 1u << i;
        const koksma_status status = parse_value(owner, &params[i], equals + 1, &values[i]);
        if (status) {
            return status;
        }
    }
    return KOKSMA_OK;
}

static koksma_status split(const char *text, char *name, const char **rest)
{
    if (!text) {
        return koksma__fail(KOKSMA_ARGUMENT, "there is no text of a spec, such as name or name:key=value,key=value");
    }
    const size_t length = strcspn(text, ":");
    if (length == 0 || length >= 64) {
        return koksma__fail(KOKSMA_ARGUMENT, "'%.64s' is not of the form name or name:key=value,key=value", text);
    }
    memcpy(name, text, length);
    name[length] = '\0';
    *rest = text[length] == ':' ? text + length + 1 : "";
    return KOKSMA_OK;
}

/* Copies rest to own without the parameter that all patterns have, "shift=0" or "shift=1". */
static koksma_status take_shift(const char *name, const char *rest, char *own, bool *shift)
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
            memcpy(own + used + (used > 0), rest, length);
            if (used) {
                own[used++] = ',';
            }
            used += length;
        }
        rest += length + (rest[length] == ',');
    }
    own[used] = '\0';
    return KOKSMA_OK;
}

koksma_status koksma_pattern_spec(const char *text, koksma_spec *spec)
{
    char name[64];
    const char *rest = "";
    *spec = (koksma_spec){0};
    const koksma_status status = split(text, name, &rest);
    if (status) {
        return status;
    }
    const koksma_pattern *pattern = koksma_pattern_find(name);
    if (!pattern) {
        return koksma__fail(KOKSMA_UNKNOWN, "no pattern '%s'; 'koksma list patterns' names them", name);
    }
    spec->pattern = pattern = pattern->alias_of ? koksma_pattern_find(pattern->alias_of) : pattern;
    if (!pattern->takes_path) {
        char own[KOKSMA_MAX_SPEC];
        const koksma_status taken = take_shift(name, rest, own, &spec->shift);
        return taken ? taken : koksma__params_parse(name, pattern->params, own, spec->params);
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
    char name[64];
    const char *rest = "";
    *spec = (koksma_spec){0};
    const koksma_status status = split(text, name, &rest);
    if (status) {
        return status;
    }
    spec->measure = koksma_measure_find(name);
    if (!spec->measure) {
        return koksma__fail(KOKSMA_UNKNOWN, "no measure '%s'; 'koksma list measures' names them", name);
    }
    return koksma__params_parse(name, spec->measure->params, rest, spec->params);
}

/* The shortest decimal that reads back to the same double; whole numbers without an exponent. */
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
    char separator = ':';
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
    const bool is_pattern = spec->pattern != NULL;
    if (!is_pattern && !spec->measure) {
        *text = '\0';
        return;
    }
    snprintf(text, KOKSMA_MAX_SPEC, "%s", is_pattern ? spec->pattern->name : spec->measure->name);
    if (is_pattern && spec->pattern->takes_path) {
        const size_t used = strlen(text);
        snprintf(text + used, KOKSMA_MAX_SPEC - used, ":%.*s%s", KOKSMA_MAX_SPEC - 80, spec->path,
                 spec->shift ? ",shift=1" : "");
        return;
    }
    koksma__params_text(is_pattern ? spec->pattern->params : spec->measure->params, spec->params, text,
                        KOKSMA_MAX_SPEC);
    if (is_pattern && spec->shift) {
        const size_t used = strlen(text);
        snprintf(text + used, KOKSMA_MAX_SPEC - used, "%sshift=1", strchr(text, ':') ? "," : ":");
    }
}

static koksma_status check_params(const char *owner, const koksma_param *params, const double *values)
{
    koksma_status status = KOKSMA_OK;
    for (int i = 0; !status && params && params[i].name; i++) {
        status = check_range(owner, &params[i], values[i]);
    }
    return status;
}

static koksma_status check_dim(const char *owner, int dim, int min_dim, int max_dim)
{
    if (dim >= min_dim && dim <= max_dim) {
        return KOKSMA_OK;
    }
    if (min_dim == max_dim) {
        return koksma__fail(KOKSMA_DIM, "%s: it has no %d-dimensional form, only dim = %d", owner, dim, min_dim);
    }
    return koksma__fail(KOKSMA_DIM, "%s: it has no %d-dimensional form, only dim = %d to %d", owner, dim, min_dim,
                        max_dim);
}

static koksma_args arguments_of(const koksma_spec *spec, const koksma_run *run)
{
    koksma_args args = {.run = run, .path = spec->path};
    memcpy(args.params, spec->params, sizeof args.params);
    return args;
}

/* x + u on the torus; never 1. */
static void shift_points(uint64_t seed, koksma_points *out)
{
    double u[KOKSMA_MAX_DIM + 1];
    for (int k = 0; k < out->dim; k += 2) {
        koksma__random_pair(seed, KOKSMA__PURPOSE_SHIFT, 0, (uint32_t)k, u + k);
    }
    double *x = out->xs;
    for (size_t i = 0; i < out->n; i++) {
        for (int k = 0; k < out->dim; k++, x++) {
            *x += u[k];
            *x -= *x >= 1;
        }
    }
}

static koksma_status check_generate(const koksma_spec *spec, const koksma_pattern *p, int dim)
{
    const koksma_status status = check_dim(p->name, dim, p->min_dim, p->max_dim);
    return status ? status : check_params(p->name, p->params, spec->params);
}

static const koksma_pattern *pattern_of(const koksma_spec *spec)
{
    return spec->pattern && spec->pattern->alias_of ? koksma_pattern_find(spec->pattern->alias_of) : spec->pattern;
}

bool koksma__spec_is_deterministic(const koksma_spec *spec)
{
    const koksma_pattern *p = pattern_of(spec);
    bool deterministic = !spec->shift && p->claims & KOKSMA_CLAIM_DETERMINISTIC;
    for (int k = 0; p->params && p->params[k].name; k++) {
        if (!strcmp(p->params[k].name, "scramble") || !strcmp(p->params[k].name, "shuffle")) {
            deterministic = deterministic && spec->params[k] == 0;
        }
    }
    return deterministic;
}

koksma_status koksma_generate(const koksma_spec *spec, uint64_t seed, const koksma_run *run, koksma_points *out)
{
    const koksma_pattern *p = pattern_of(spec);
    if (!p || !out->xs || out->n == 0) {
        return koksma__fail(KOKSMA_ARGUMENT,
                            "koksma_generate: it takes the spec of a pattern and initialised points");
    }
    koksma_status status = check_generate(spec, p, out->dim);
    status = status ? status : koksma__points_fit(out->n, out->dim);
    const koksma_args args = arguments_of(spec, run);
    if (!status) {
        status = p->generate(seed, &args, out);
    }
    if (!status && spec->shift) {
        shift_points(seed, out);
    }
    return status;
}

koksma_status koksma_generate_whole(const koksma_spec *spec, uint64_t seed, const koksma_run *run, int dim,
                                    koksma_points *out)
{
    const koksma_pattern *p = pattern_of(spec);
    *out = (koksma_points){.dim = dim};
    if (!p) {
        return koksma__fail(KOKSMA_ARGUMENT, "koksma_generate_whole: it takes the spec of a pattern");
    }
    if (!p->whole) {
        return koksma__fail(KOKSMA_N, "%s: the number of points is missing", p->name);
    }
    koksma_status status = dim || !p->takes_path ? check_generate(spec, p, dim) : KOKSMA_OK;
    const koksma_args args = arguments_of(spec, run);
    if (!status) {
        status = p->whole(seed, &args, out);
    }
    if (!status && spec->shift) {
        shift_points(seed, out);
    }
    return status;
}

koksma_status koksma__evaluate_check(const char *caller, const koksma_spec *spec, const koksma_points *points)
{
    const koksma_measure *m = spec->measure;
    if (!m || !points->xs || points->n == 0) {
        return koksma__fail(KOKSMA_ARGUMENT, "%s: it takes the spec of a measure and at least 1 point", caller);
    }
    koksma_status status = check_dim(m->name, points->dim, m->min_dim, m->max_dim);
    status = status ? status : check_params(m->name, m->params, spec->params);
    return status ? status : koksma__points_check(points);
}

koksma_status koksma_evaluate(const koksma_spec *spec, const koksma_points *points, const koksma_run *run,
                              koksma_value *out)
{
    *out = (koksma_value){.value = NAN, .square = NAN, .lower = NAN, .upper = NAN, .exact = true};
    koksma_status status = koksma__evaluate_check("koksma_evaluate", spec, points);
    const koksma_args args = arguments_of(spec, run);
    if (!status) {
        status = spec->measure->eval(points, &args, out);
    }
    if (!status && out->exact) {
        out->lower = out->upper = out->value;
    }
    return status;
}
