/* SPDX-License-Identifier: Apache-2.0 */
/* Metrics for callers that have pixels as doubles, and that compare one image with many references (the jackknife of
   `koksma rank`). */
#ifndef KOKSMA_IMAGE_METRICS_METRICS_H
#define KOKSMA_IMAGE_METRICS_METRICS_H

#include <koksma/image.h>

static inline size_t koksma__metric_pixels(const koksma_metric_input *in)
{
    return (size_t)in->width * (size_t)in->height;
}

/* Checks that the metric exists and its parameters are valid. Errors: ARGUMENT. */
koksma_status koksma__metric_spec_check(const koksma_metric_spec *spec);

/* The pixels as the metric needs them: metric->channels doubles for each pixel. */
void koksma__metric_values(const koksma_metric *metric, const koksma_image *image, double *out);

/* Computes the metric's value from the errors of n pixels, and changes the order of the errors. */
koksma_metric_value koksma__metric_pool(const koksma_metric *metric, double *errors, size_t n);

/* Computes the same value as koksma__metric_pool and nothing else; adds the errors in the order of the pixels. */
double koksma__metric_mean(const koksma_metric *metric, const double *errors, size_t n);

#define METRIC(name) extern const koksma_metric koksma__metric_##name;
#include "image/metrics/metrics.def"
#undef METRIC
#undef METRIC_OF

#endif
