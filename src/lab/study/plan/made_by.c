/* SPDX-License-Identifier: Apache-2.0 */
/* Lists the revisions of the code that makes a row of the store: "random 0" for points, "renderer 0, n-rooks 0,
   sobol 0" for an image with two patterns. Each pattern, measure, metric or warp is listed once. When one of their
   revisions changes, so does the text, and with it the key of the row. Filters and integrators have no revisions:
   the renderer's revision covers them. */
#include "study/plan/made_by.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/image.h>
#include <koksma/integrate.h>
#include <koksma/warp.h>

#include "core/status.h"
#include "study/plan/image_patterns.h"
#include "study/plan/plan.h"

/* Appends "name revision" unless the text contains it already. The text has capacity for the patterns of all uses of
   an image (KOKSMA_MAX_PATTERNS_TEXT). */
static void add(char text[KOKSMA__MADE_BY], const char *name, int revision)
{
    char word[KOKSMA_MAX_SPEC + 16];
    const size_t used = strlen(text), size = (size_t)snprintf(word, sizeof word, "%s %d", name, revision);
    for (const char *at = text; (at = strstr(at, word)); at++) {
        if ((at == text || at[-1] == ' ') && (!at[size] || at[size] == ',')) {
            return;
        }
    }
    snprintf(text + used, KOKSMA__MADE_BY - used, "%s%s", used ? ", " : "", word);
}

static void add_pattern(char text[KOKSMA__MADE_BY], const koksma_spec *spec)
{
    if (spec->pattern) {
        add(text, spec->pattern->name, spec->pattern->revision);
    }
}

static koksma_status of_integrand(const char *measure, koksma__made_by *out)
{
    char name[KOKSMA_MAX_SPEC];
    const char *spec = koksma__integrand_of(measure);
    snprintf(name, sizeof name, "%.*s", (int)strcspn(spec, ":"), spec);
    const koksma_integrand *integrand = koksma_integrand_find(name);
    KOKSMA__FAIL_IF(!integrand, KOKSMA_UNKNOWN, "no integrand '%.64s'", name);
    snprintf(name, sizeof name, "error of %s", integrand->name);
    add(out->value, name, integrand->revision);
    return KOKSMA_OK;
}

static koksma_status of_points(const char *pattern, const char *warp_name, const char *measure, koksma__made_by *out)
{
    koksma_spec spec;
    koksma_status status = koksma_pattern_spec(pattern, &spec);
    if (!status) {
        add_pattern(out->points, &spec);
        if (koksma__integrand_of(measure)) {
            return of_integrand(measure, out);
        }
        status = koksma_measure_spec(measure, &spec);
    }
    if (status) {
        return status;
    }
    add(out->value, spec.measure->name, spec.measure->revision);
    const koksma_warp *warp = koksma_warp_find(warp_name);
    if (warp) {
        add(out->value, warp->name, warp->revision);
    }
    return warp || !warp_name[0] ? KOKSMA_OK : koksma__fail(KOKSMA_UNKNOWN, "no warp '%s'", warp_name);
}

static koksma_status of_image(const char *pattern, char text[KOKSMA__MADE_BY])
{
    koksma_render_options options = {0};
    const koksma_spec *spec;
    KOKSMA__TRY(koksma__image_pattern_set(pattern, &options));
    add(text, "renderer", KOKSMA__RENDERER_REVISION);
    for (size_t i = 0; (spec = koksma__image_pattern_at(&options, i)); i++) {
        add_pattern(text, spec);
    }
    return KOKSMA_OK;
}

static koksma_status of_metric(const char *text, char made_by[KOKSMA__MADE_BY])
{
    koksma_metric_spec spec;
    const koksma_status status = koksma_metric_parse(text, &spec);
    if (!status) {
        add(made_by, spec.metric->name, spec.metric->revision);
    }
    return status;
}

koksma_status koksma__find_made_by(bool image, const char *pattern, const char *options, const char *what,
                                   const char *metric, koksma__made_by *out)
{
    char name[KOKSMA_MAX_SPEC], of_reference[KOKSMA_MAX_SPEC];
    long long spp, replicates;
    *out = (koksma__made_by){0};
    if (!image) {
        return of_points(pattern, options, what, out);
    }
    koksma_status status = pattern[0] ? of_image(pattern, out->points) : KOKSMA_OK;
    status = status || !metric[0] ? status : of_metric(metric, out->value);
    status = status ? status : koksma__reference_parse(what, name, of_reference, &spp, &replicates);
    return status ? status : of_image(of_reference, out->value);
}

koksma_status koksma__reference_parse(const char *text, char name[KOKSMA_MAX_SPEC], char pattern[KOKSMA_MAX_SPEC],
                                      long long *spp, long long *replicates)
{
    const char *colon = strchr(text, ':'), *at = strrchr(text, '@');
    int end = 0;
    const bool fits = colon && at && at > colon && colon - text < KOKSMA_MAX_SPEC && at - colon - 1 < KOKSMA_MAX_SPEC;
    KOKSMA__FAIL_IF(!fits || sscanf(at, "@%18lldx%18lld%n", spp, replicates, &end) != 2 || at[end] || *spp < 1 ||
                        *replicates < 1,
                    KOKSMA_MALFORMED, "'%.100s' is not the text of a reference", text);
    snprintf(name, KOKSMA_MAX_SPEC, "%.*s", (int)(colon - text), text);
    snprintf(pattern, KOKSMA_MAX_SPEC, "%.*s", (int)(at - colon - 1), colon + 1);
    return KOKSMA_OK;
}
