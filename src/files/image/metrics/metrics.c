/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The table of metrics, their specs, and the code that all metrics share. A metric gives every pixel an error of at
 * least 0; its value is the mean of the pixels' errors, or the root of the mean. Two more numbers are computed with
 * the value:
 *
 *     top_share  the share of the sum of all errors that comes from the 0.1 % of the pixels with the largest
 *                errors, rounded down: 0 for fewer than 1000 pixels
 *     robust     the value without these pixels, which is a one-sided trimmed mean
 *
 * Where top_share is large, the value says more about a few pixels (fireflies) than about the image, and ranking
 * images by the value is unreliable. Quickselect (Hoare 1961) finds the largest errors in O(n).
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/lookup.h"
#include "core/spec.h"
#include "core/status.h"
#include "core/sum.h"
#include "image/formats.h"
#include "image/image.h"
#include "image/metrics/metrics.h"

enum { BLOCK = 512 };

static const koksma_metric *const table[] = {
#define METRIC(name) &koksma__metric_##name,
#include "image/metrics/metrics.def"
#undef METRIC
};

KOKSMA__LOOKUP(koksma_metric, table)
KOKSMA__NAME_AT(koksma_metric)

koksma_status koksma_metric_parse(const char *text, koksma_metric_spec *spec)
{
    KOKSMA__REQUIRE(text, spec);
    char name[64];
    const char *rest = "";
    *spec = (koksma_metric_spec){0};
    KOKSMA__TRY(koksma__spec_split(text, name, &rest));
    spec->metric = koksma_metric_find(name);
    if (!spec->metric) {
        return koksma__fail_unknown("metric", name, koksma_metric_name_at, NULL, "'koksma list metrics' names them");
    }
    return koksma__params_parse(name, spec->metric->params, rest, spec->params);
}

koksma_status koksma__metric_spec_check(const koksma_metric_spec *spec)
{
    KOKSMA__FAIL_IF(!spec->metric, KOKSMA_ARGUMENT, "a spec without a metric: koksma_metric_parse makes one");
    KOKSMA__FAIL_IF(!spec->metric->name || !spec->metric->errors, KOKSMA_ARGUMENT,
                    "the metric has no %s: koksma_metric_find has metrics", spec->metric->name ? "errors" : "name");
    return koksma__params_check(spec->metric->name, spec->metric->params, spec->params);
}

void koksma_metric_text(const koksma_metric_spec *spec, char *text)
{
    KOKSMA__REQUIRE_OR(, spec, text);
    *text = '\0';
    if (spec->metric) {
        snprintf(text, KOKSMA_MAX_SPEC, "%s", spec->metric->name);
        koksma__params_text(spec->metric->params, spec->params, text, KOKSMA_MAX_SPEC);
    }
}

void koksma__metric_values(const koksma_metric *metric, const koksma_image *image, double *out)
{
    const size_t n = (size_t)image->width * (size_t)image->height, channels = (size_t)image->channels;
    for (size_t p = 0; p < n; p++) {
        if (metric->channels == 1) {
            out[p] = koksma__luminance(image, p);
        }
        for (size_t c = 0; c < 3 && metric->channels == 3; c++) {
            out[3 * p + c] = (double)image->pixels[p * channels + (channels == 3 ? c : 0)];
        }
    }
}

double koksma__metric_mean(const koksma_metric *metric, const double *errors, size_t n)
{
    koksma__sum sum = {0};
    for (size_t first = 0; first < n; first += BLOCK) { /* SIMD adds a block to eight partial sums */
        const size_t end = n - first < BLOCK ? n : first + BLOCK;
        double part[8] = {0};
        for (size_t p = first; p < end; p++) {
            part[p & 7] += errors[p];
        }
        for (int i = 0; i < 8; i++) {
            koksma__sum_add(&sum, part[i]);
        }
    }
    const double mean = koksma__sum_value(&sum) / (double)n;
    return metric->root ? sqrt(mean) : mean;
}

/* A number above which about four times k of n numbers are, and with few exceptions at least k: the quantile of a
   sample. The first partition by it has branches that are nearly always the same. */
static double guess(const double *x, size_t n, size_t k)
{
    enum { SAMPLE = 256, LARGEST = 8 };
    double largest[LARGEST] = {0}; /* of the sample, in falling order; errors are at least 0 */
    const size_t rank = 1 + 4 * k * SAMPLE / n;
    for (size_t i = 0; i < SAMPLE; i++) {
        double v = x[i * (n / SAMPLE)];
        for (size_t j = 0; j < LARGEST; j++) {
            const double kept = largest[j];
            largest[j] = v > kept ? v : kept;
            v = v > kept ? kept : v;
        }
    }
    return largest[rank < LARGEST ? rank : LARGEST - 1];
}

/* Moves the k largest of n numbers to the end. */
static void select_largest(double *x, size_t n, size_t k)
{
    size_t first = 0, end = n;
    const size_t target = n - k;
    if (!k) {
        return;
    }
    double pivot = n >= BLOCK ? guess(x, n, k) : x[n / 2];
    while (end - first > 1) {
        size_t less = first, same = first, more = end;
        /* partition into smaller, equal and larger numbers, because many errors are equal, for example 0 */
        while (same < more) {
            const double v = x[same];
            if (v < pivot) {
                x[same++] = x[less];
                x[less++] = v;
            } else if (v > pivot) {
                x[same] = x[--more];
                x[more] = v;
            } else {
                same++;
            }
        }
        if (target >= less && target < more) {
            return;
        }
        first = target < less ? first : more;
        end = target < less ? less : end;
        pivot = x[first + (end - first) / 2];
    }
}

/* A sum that does not depend on the order, except where the exact one is all but between two numbers. The errors of the
   additions are found without a branch (Knuth's two-sum), so that lanes are those of SIMD. */
static double exact_sum(const double *x, size_t n)
{
    enum { LANES = 4 };
    double total[LANES] = {0}, lost[LANES] = {0};
    const size_t whole = n - n % LANES;
    for (size_t i = 0; i < whole; i += LANES) {
        for (size_t k = 0; k < LANES; k++) {
            const double next = total[k] + x[i + k], added = next - total[k];
            lost[k] += (total[k] - (next - added)) + (x[i + k] - added);
            total[k] = next;
        }
    }
    koksma__sum sum = {0};
    for (size_t k = 0; k < LANES; k++) {
        koksma__sum_add(&sum, total[k]);
        sum.lost += lost[k];
    }
    for (size_t i = whole; i < n; i++) {
        koksma__sum_add(&sum, x[i]);
    }
    return koksma__sum_value(&sum);
}

koksma_metric_value koksma__metric_pool(const koksma_metric *metric, double *errors, size_t n)
{
    koksma_metric_value out = {.value = koksma__metric_mean(metric, errors, n), .top = n / 1000};
    select_largest(errors, n, out.top);
    const double of_rest = exact_sum(errors, n - out.top), of_top = exact_sum(errors + n - out.top, out.top);
    const double mean = of_rest / (double)(n - out.top);
    out.robust = !out.top ? out.value : metric->root ? sqrt(mean) : mean;
    out.top_share = of_top > 0 ? of_top / (of_rest + of_top) : 0;
    return out;
}

/* Evaluates those of n metrics that compare this number of channels. buffer: has space for the values of both images
   and for one error a pixel. */
static koksma_status evaluate(const koksma_metric_spec *specs, size_t n, int channels, const koksma_image *image,
                              const koksma_image *reference, double *buffer, koksma_metric_value *out)
{
    const size_t pixels = (size_t)image->width * (size_t)image->height, values = pixels * (size_t)channels;
    double *const errors = buffer + 2 * values;
    koksma_status status = KOKSMA_OK;
    bool converted = false;
    for (size_t m = 0; !status && m < n; m++) {
        const koksma_metric *metric = specs[m].metric;
        if (metric->channels != channels) {
            continue;
        }
        if (!converted) {
            koksma__metric_values(metric, image, buffer);
            koksma__metric_values(metric, reference, buffer + values);
            converted = true;
        }
        const koksma_metric_input in = {.params = specs[m].params,
                                        .width = image->width,
                                        .height = image->height,
                                        .image = buffer,
                                        .reference = buffer + values};
        const char kept = koksma__call_begin();
        status = koksma__call_end(kept, metric->errors(&in, errors), "koksma_metric.errors");
        if (!status) {
            out[m] = koksma__metric_pool(metric, errors, pixels);
            out[m].caveat = metric->caveat ? metric->caveat(&in) : NULL;
        }
    }
    return status;
}

koksma_status koksma__metrics_evaluate(const koksma_metric_spec *specs, size_t n, const koksma_image *image,
                                       const koksma_image *reference, koksma_metric_value *out)
{
    size_t channels = 1;
    for (size_t m = 0; m < n; m++) {
        KOKSMA__TRY(koksma__metric_spec_check(&specs[m]));
        channels = specs[m].metric->channels == 3 ? 3 : channels;
    }
    KOKSMA__TRY(koksma__image_check_sizes(image, reference));
    const size_t size = (2 * channels + 1) * (size_t)image->width * (size_t)image->height * sizeof(double);
    double *buffer = malloc(size);
    KOKSMA__REQUIRE_MEMORY(buffer, size);
    koksma_status status = KOKSMA_OK;
    for (int c = 1; !status && c <= 3; c += 2) {
        status = evaluate(specs, n, c, image, reference, buffer, out);
    }
    free(buffer);
    return status;
}

koksma_status koksma_metric_evaluate(const koksma_metric_spec *spec, const koksma_image *image,
                                     const koksma_image *reference, koksma_metric_value *out)
{
    KOKSMA__REQUIRE(spec, image, reference, out);
    return koksma__metrics_evaluate(spec, 1, image, reference, out);
}
