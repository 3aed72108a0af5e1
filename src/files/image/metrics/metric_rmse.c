/* SPDX-License-Identifier: Apache-2.0 */
/* rmse: the root mean square error in luminance, sqrt(sum (Y - Y_ref)^2 / n). Errors are squared, so that a few
   fireflies can contribute most of the value. */
#include "image/metrics/metrics.h"

static koksma_status errors(const koksma_metric_input *in, double *out)
{
    for (size_t p = 0; p < koksma__metric_pixels(in); p++) {
        const double e = in->image[p] - in->reference[p];
        out[p] = e * e;
    }
    return KOKSMA_OK;
}

const koksma_metric koksma__metric_rmse = {
    .name = "rmse",
    .title = "root mean square error in luminance",
    .cite = "shirley1991",
    .channels = 1,
    .root = true,
    .order = 1,
    .in_all_studies = true,
    .errors = errors,
};
