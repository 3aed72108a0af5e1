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

/* Converts the pixels to what the metric compares: metric->channels doubles for each pixel. */
void koksma__metric_values(const koksma_metric *metric, const koksma_image *image, double *out);

/* Computes the metric's value from the errors of n pixels, and changes the order of the errors. */
koksma_metric_value koksma__metric_pool(const koksma_metric *metric, double *errors, size_t n);

/* Computes only the value, not the other members that koksma__metric_pool computes; adds the errors in the order of
   the pixels. */
double koksma__metric_mean(const koksma_metric *metric, const double *errors, size_t n);

/* Evaluates n metrics of one image, each as koksma_metric_evaluate does, but converts the pixels only once for all
   metrics with the same number of channels. Errors: those of koksma_metric_evaluate. */
koksma_status koksma__metrics_evaluate(const koksma_metric_spec *specs, size_t n, const koksma_image *image,
                                       const koksma_image *reference, koksma_metric_value *out);

#define METRIC(name) extern const koksma_metric koksma__metric_##name;
#include "image/metrics/metrics.def"
#undef METRIC
#undef METRIC_OF

#endif
