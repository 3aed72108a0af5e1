/* SPDX-License-Identifier: Apache-2.0 */
/*
 * smape: the symmetric mean absolute percentage error over pixels and channels, as a fraction (Vogels et al. 2018,
 * section 4.2),
 *     sum |x - x_ref| / (|x| + |x_ref| + epsilon) / (3 n),   x: linear red, green, blue, epsilon = 0.01.
 * The error of a pixel is at most 1, so that fireflies contribute little: this is the most robust of the relative
 * metrics.
 */
#include <math.h>

#include "image/metrics/metrics.h"

static koksma_status errors(const koksma_metric_input *in, double *out)
{
    for (size_t p = 0; p < koksma__metric_pixels(in); p++) {
        double sum = 0;
        for (size_t c = 3 * p; c < 3 * p + 3; c++) {
            const double x = in->image[c], y = in->reference[c];
            sum += fabs(x - y) / (fabs(x) + fabs(y) + in->params[0]);
        }
        out[p] = sum / 3;
    }
    return KOKSMA_OK;
}

static const koksma_param params[] = {
    {"epsilon", "added to the sum of both values", 0.01, 1e-12, 1e12, NULL, false},
    {0},
};

const koksma_metric koksma__metric_smape = {
    .name = "smape",
    .title = "symmetric mean absolute percentage error of linear RGB, 0 to 1",
    .cite = "vogels2018",
    .params = params,
    .channels = 3,
    .order = 1,
    .in_all_studies = true,
    .errors = errors,
};
