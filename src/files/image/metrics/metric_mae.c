/* SPDX-License-Identifier: Apache-2.0 */
/* mae: the mean absolute error in luminance, sum |Y - Y_ref| / n (Shirley 1991, section 5.5.6). Bright parts of an
   image usually have larger errors than dark parts, and so contribute more to the mean. */
#include <math.h>

#include "image/metrics/metrics.h"

static koksma_status errors(const koksma_metric_input *in, double *out)
{
    for (size_t p = 0; p < koksma__metric_pixels(in); p++) {
        out[p] = fabs(in->image[p] - in->reference[p]);
    }
    return KOKSMA_OK;
}

const koksma_metric koksma__metric_mae = {
    .name = "mae",
    .title = "mean absolute error in luminance",
    .cite = "shirley1991",
    .channels = 1,
    .order = 1,
    .in_all_studies = true,
    .errors = errors,
};
