/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The weights of filters of masks, by name (koksma/maskfile.h). Those of pixel filters are rounded to multiples of 2^-30,
 * so that masks keep their bits where the last digits of a filter change.
 */
#include <koksma/maskfile.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/elementary.h"
#include "core/files.h"
#include "core/lookup.h"
#include "core/spec.h"
#include "core/status.h"
#include "render/filters/filters.h"

enum { MOST = KOKSMA_MASK_MAX_SIDE, PARTS = 256 };

static const koksma_param box_params[] = {{"size", "pixels a side", 2, 2, MOST, NULL, true}, {0}};
static const koksma_param binomial_params[] = {{"size", "pixels a side", 3, 2, MOST, NULL, true}, {0}};
static const koksma_param gaussian_params[] = {{"sigma", "standard deviation in pixels", 1, 0.1, 8, NULL, false},
                                               {0}};

/* Makes the square filter with this profile of n weights along each axis. */
static koksma_status square(int n, const double *profile, koksma_mask_filter *out)
{
    out->width = out->height = n;
    for (int i = 0; i < n * n; i++) {
        out->weights[i] = profile[i / n] * profile[i % n];
    }
    return koksma_mask_filter_check(out);
}

static koksma_status box(double size, koksma_mask_filter *out)
{
    double profile[MOST];
    for (int i = 0; i < (int)size; i++) {
        profile[i] = 1;
    }
    return square((int)size, profile, out);
}

static koksma_status binomial(double size, koksma_mask_filter *out)
{
    double profile[MOST] = {1};
    for (int i = 1; i < (int)size; i++) {
        profile[i] = profile[i - 1] * ((int)size - i) / i;
    }
    return square((int)size, profile, out);
}

static koksma_status gaussian(double sigma, koksma_mask_filter *out)
{
    const int radius = (int)(4 * sigma + 0.5);
    double profile[MOST];
    for (int i = -radius; i <= radius; i++) {
        profile[i + radius] = koksma__exp(-i * i / (2 * sigma * sigma));
    }
    return square(2 * radius + 1, profile, out);
}

/* The integrals of a pixel filter over the pixels about a sample in the middle of one, by the midpoint rule. */
static koksma_status pixel_filter(const koksma_filter *filter, koksma_mask_filter *out)
{
    const int radius = (int)ceil(filter->radius - 0.5);
    double profile[MOST], sum = 0;
    for (int i = -radius; i <= radius; i++) {
        profile[i + radius] = 0;
        for (int k = 0; k < PARTS; k++) {
            const double x = i - 0.5 + (k + 0.5) / PARTS;
            profile[i + radius] += fabs(x) < filter->radius ? filter->value(x) : 0;
        }
        sum += profile[i + radius];
    }
    for (int i = 0; i <= 2 * radius; i++) {
        profile[i] = ldexp(nearbyint(ldexp(profile[i] / sum, 30)), -30);
    }
    return square(2 * radius + 1, profile, out);
}

/* Reads the numbers of a line. Returns how many there are, or -1 where one is no number or there are too many. */
static int read_row(char *line, double *row)
{
    int n = 0;
    line[strcspn(line, "#")] = '\0';
    for (char *at = line + strspn(line, " \t\r,"); *at; at += strspn(at, " \t\r,")) {
        char *end;
        const double x = koksma__strtod(at, &end);
        if (end == at || n == MOST) {
            return -1;
        }
        row[n++] = x;
        at = end;
    }
    return n;
}

static koksma_status parse_rows(char *text, koksma_mask_filter *out)
{
    int line = 1;
    for (char *at = text, *next; at; at = next, line++) {
        double row[MOST];
        next = strchr(at, '\n');
        if (next) {
            *next++ = '\0';
        }
        const int n = read_row(at, row);
        KOKSMA__FAIL_IF(n < 0, KOKSMA_MALFORMED, "line %d: not up to %d numbers, separated by blanks or commas", line,
                        MOST);
        if (n == 0) {
            continue;
        }
        KOKSMA__FAIL_IF(out->height && n != out->width, KOKSMA_MALFORMED,
                        "line %d: %d numbers, and %d in the rows before", line, n, out->width);
        KOKSMA__FAIL_IF(out->height == MOST, KOKSMA_MALFORMED, "line %d: more than %d rows", line, MOST);
        out->width = n;
        memcpy(out->weights + out->height++ * n, row, (size_t)n * sizeof *row);
    }
    KOKSMA__FAIL_IF(!out->height, KOKSMA_MALFORMED, "no numbers; a filter is a row of numbers a line");
    return koksma_mask_filter_check(out) ? koksma__fail(KOKSMA_MALFORMED, "%s", koksma_error_text()) : KOKSMA_OK;
}

static koksma_status from_file(const char *path, koksma_mask_filter *out)
{
    unsigned char *bytes;
    size_t size;
    KOKSMA__TRY(koksma__read_file(path, KOKSMA__FILE_PARAMETERS, KOKSMA__BY_USER, koksma__check_text, &bytes, &size));
    const koksma_status status = parse_rows((char *)bytes, out);
    free(bytes);
    return status ? koksma__fail_in(status, path) : KOKSMA_OK;
}

static const char *filter_name(const void *table, size_t i)
{
    static const char *const ours[] = {"binomial", "file"};
    const koksma_filter *filter = i < 2 ? NULL : koksma_filter_at(i - 2);
    (void)table;
    return i < 2 ? ours[i] : filter ? filter->name : NULL;
}

koksma_status koksma_mask_filter_parse(const char *text, koksma_mask_filter *out)
{
    static const struct {
        const char *name;
        const koksma_param *params;
        koksma_status (*make)(double value, koksma_mask_filter *out);
    } sized[] = {
        {"box", box_params, box}, {"binomial", binomial_params, binomial}, {"gaussian", gaussian_params, gaussian}};
    KOKSMA__REQUIRE(text, out);
    char name[64], meant[KOKSMA__MEANT];
    const char *rest;
    double values[KOKSMA_MAX_PARAMS];
    *out = (koksma_mask_filter){0};
    KOKSMA__TRY(koksma__spec_split(text, name, &rest));
    if (!strcmp(name, "file")) {
        return from_file(rest, out);
    }
    for (size_t i = 0; i < sizeof sized / sizeof *sized; i++) {
        if (!strcmp(name, sized[i].name)) {
            if (!*rest && koksma_filter_find(name)) {
                break; /* without a size, the pixel filter of this name */
            }
            KOKSMA__TRY(koksma__params_parse(name, sized[i].params, rest, values));
            return sized[i].make(values[0], out);
        }
    }
    const koksma_filter *filter = koksma_filter_find(name);
    KOKSMA__FAIL_IF(!filter, KOKSMA_UNKNOWN,
                    "no filter '%s'; %sit takes box:size=K, binomial:size=K, gaussian:sigma=S, file:PATH, or one of "
                    "'koksma list filters'",
                    name, koksma__meant(name, filter_name, NULL, meant));
    KOKSMA__TRY(koksma__params_parse(name, NULL, rest, values));
    return pixel_filter(filter, out);
}
