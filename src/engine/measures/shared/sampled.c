/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Computes the root mean square of samples and its standard error, which is the standard error of the mean square
 * divided by twice the root (delta method).
 */
#include "measures/shared/shared.h"

#include <math.h>

#include "core/sum.h"

/* Takes two passes, so that no digits are lost: first the mean, then the sum of squared differences from the mean. */
void koksma__sampled_root(const double *squares, size_t count, koksma_value *out)
{
    koksma__sum sum = {0}, spread = {0};
    const double n = (double)count;
    for (size_t i = 0; i < count; i++) {
        koksma__sum_add(&sum, squares[i]);
    }
    out->square = koksma__sum_value(&sum) / n;
    out->value = sqrt(out->square);
    for (size_t i = 0; i < count; i++) {
        koksma__sum_add(&spread, (squares[i] - out->square) * (squares[i] - out->square));
    }
    const double error = count > 1 ? sqrt(koksma__sum_value(&spread) / n / (n - 1)) : (double)NAN;
    out->standard_error = out->value > 0 ? error / (2 * out->value) : error;
    out->exact = false;
}
