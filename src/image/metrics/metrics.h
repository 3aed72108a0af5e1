/* SPDX-License-Identifier: Apache-2.0 */
/* Metrics for those who have pixels as doubles, and many references for one image (the ranking's jackknife). */
#ifndef KOKSMA_IMAGE_METRICS_METRICS_H
#define KOKSMA_IMAGE_METRICS_METRICS_H

#include <koksma/image.h>

static inline size_t koksma__metric_pixels(const koksma_metric_input *in)
{
    return (size_t)in->width * (size_t)in->height;
}

/* Whether there is a metric, with parameters that it takes. Errors: ARGUMENT. */
koksma_status koksma__metric_spec_check(const koksma_metric_spec *spec);

/* The pixels as the metric takes them: metric->channels doubles a pixel. */
void koksma__metric_values(const koksma_metric *metric, const koksma_image *image, double *out);

/* The metric's value from the errors of n pixels, which are put in another order. */
koksma_metric_value koksma__metric_pool(const koksma_metric *metric, double *errors, size_t n);

/* The value alone, in the order of the pixels, as koksma__metric_pool has it. */
double koksma__metric_mean(const koksma_metric *metric, const double *errors, size_t n);

#define METRIC(name) extern const koksma_metric koksma__metric_##name;
#include "image/metrics/metrics.def"
#undef METRIC
#undef METRIC_OF

#endif
