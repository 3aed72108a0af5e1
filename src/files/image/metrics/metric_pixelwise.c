/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The metrics whose error of a pixel is a formula of that pixel alone, over n pixels; x is linear red, green, blue and
 * Y the luminance.
 *
 *   mae     the mean absolute error in luminance, sum |Y - Y_ref| / n (Shirley 1991, section 5.5.6). Bright parts
 *           of an image usually have larger errors than dark parts, and so contribute more to the mean
 *   rmse    the root mean square error in luminance, sqrt(sum (Y - Y_ref)^2 / n). Errors are squared, so that a few
 *           fireflies can contribute most of the value
 *   relmse  the relative mean square error over pixels and channels, sum (x - x_ref)^2 / (x_ref^2 + epsilon) / (3 n)
 *           (Rousselle et al. 2011). Epsilon keeps the terms finite where the reference is black: a term is x^2 / epsilon
 *           there. Most papers use 0.01, and 0.001 or 0.0001 for dark scenes. Values with different epsilon cannot be
 *           compared
 *   smape   the symmetric mean absolute percentage error over pixels and channels, as a fraction,
 *           sum |x - x_ref| / (|x| + |x_ref| + epsilon) / (3 n), epsilon = 0.01 (Vogels et al. 2018, section 4.2). The
 *           error of a pixel is at most 1, so that fireflies contribute little: this is the most robust of the relative
 *           metrics
 *
 * With blur > 0, mae and rmse are those of Y - Y_ref after convolution with a Gaussian of that standard deviation: what is
 * left of an error where eyes, or a filter of both images, do not resolve single pixels.
 */
#include <math.h>

#include "image/blur.h"
#include "image/metrics/metrics.h"

static const koksma_param blur_params[] = {
    {"blur", "standard deviation in pixels of a Gaussian that blurs both images before", 0, 0, KOKSMA__MOST_BLUR,
     NULL, false},
    {0},
};

/* The differences of the pixels, blurred, and their squares or sizes: in one pass where nothing is blurred. */
static koksma_status differences(const koksma_metric_input *in, bool squared, double *out)
{
    const size_t n = koksma__metric_pixels(in);
    const double sd = in->params[0];
    for (size_t p = 0; p < n; p++) {
        const double e = in->image[p] - in->reference[p];
        out[p] = sd > 0 ? e : squared ? e * e : fabs(e);
    }
    if (!(sd > 0)) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma__blur(in->width, in->height, sd, out);
    for (size_t p = 0; p < n; p++) {
        out[p] = squared ? out[p] * out[p] : fabs(out[p]);
    }
    return status;
}

static koksma_status mae_errors(const koksma_metric_input *in, double *out)
{
    return differences(in, false, out);
}

const koksma_metric koksma__metric_mae = {
    .name = "mae",
    .title = "mean absolute error in luminance",
    .cite = "shirley1991",
    .params = blur_params,
    .channels = 1,
    .order = 1,
    .in_all_studies = true,
    .errors = mae_errors,
};

static koksma_status rmse_errors(const koksma_metric_input *in, double *out)
{
    return differences(in, true, out);
}

const koksma_metric koksma__metric_rmse = {
    .name = "rmse",
    .title = "root mean square error in luminance",
    .cite = "shirley1991",
    .params = blur_params,
    .channels = 1,
    .root = true,
    .order = 1,
    .in_all_studies = true,
    .errors = rmse_errors,
};

static koksma_status relmse_errors(const koksma_metric_input *in, double *out)
{
    for (size_t p = 0; p < koksma__metric_pixels(in); p++) {
        double sum = 0;
        for (size_t c = 3 * p; c < 3 * p + 3; c++) {
            const double e = in->image[c] - in->reference[c];
            sum += e * e / (in->reference[c] * in->reference[c] + in->params[0]);
        }
        out[p] = sum / 3;
    }
    return KOKSMA_OK;
}

static const koksma_param relmse_params[] = {
    {"epsilon", "added to the square of the reference", 0.01, 1e-12, 1e12, NULL, false},
    {0},
};

const koksma_metric koksma__metric_relmse = {
    .name = "relmse",
    .title = "relative mean square error of linear RGB",
    .cite = "rousselle2011",
    .params = relmse_params,
    .channels = 3,
    .order = 2,
    .in_all_studies = true,
    .errors = relmse_errors,
};

static koksma_status smape_errors(const koksma_metric_input *in, double *out)
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

static const koksma_param smape_params[] = {
    {"epsilon", "added to the sum of both values", 0.01, 1e-12, 1e12, NULL, false},
    {0},
};

const koksma_metric koksma__metric_smape = {
    .name = "smape",
    .title = "symmetric mean absolute percentage error of linear RGB, 0 to 1",
    .cite = "vogels2018",
    .params = smape_params,
    .channels = 3,
    .order = 1,
    .in_all_studies = true,
    .errors = smape_errors,
};
