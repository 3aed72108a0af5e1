/* SPDX-License-Identifier: Apache-2.0 */
#include "measures/parts/sampled.h"

#include <math.h>

#include "core/sum.h"

void koksma__sample_root(size_t count, const double *squares, koksma_value *out)
{
    koksma__sum sum = {0}, spread = {0};
    for (size_t i = 0; i < count; i++) {
        koksma__sum_add(&sum, squares[i]);
    }
    const double mean = koksma__sum_value(&sum) / (double)count;
    for (size_t i = 0; i < count; i++) {
        koksma__sum_add(&spread, (squares[i] - mean) * (squares[i] - mean));
    }
    const double variance = koksma__sum_value(&spread) / (double)(count - 1);
    out->square = mean;
    out->value = sqrt(mean);
    out->standard_error = mean > 0 ? sqrt(variance / (double)count) / (2 * out->value) : 0;
    out->exact = false;
}
