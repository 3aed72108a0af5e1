/* SPDX-License-Identifier: Apache-2.0 */
/*
 * relmse: the relative mean square error over pixels and channels (Rousselle et al. 2011),
 *     sum (x - x_ref)^2 / (x_ref^2 + epsilon) / (3 n),   x: linear red, green, blue.
 * Epsilon keeps the terms finite where the reference is black: a term is x^2 / epsilon there. Most papers
 * use 0.01, and 0.001 or 0.0001 for dark scenes. Values with different epsilon cannot be compared.
 */
#include "image/metrics/metrics.h"

static koksma_status errors(const koksma_metric_input *in, double *out)
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

static const koksma_param params[] = {
    {"epsilon", "added to the square of the reference", 0.01, 1e-12, 1e12, NULL, false},
    {0},
};

const koksma_metric koksma__metric_relmse = {
    .name = "relmse",
    .title = "relative mean square error of linear RGB",
    .cite = "rousselle2011",
    .params = params,
    .channels = 3,
    .order = 2,
    .in_all_studies = true,
    .errors = errors,
};
