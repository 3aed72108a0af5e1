/* SPDX-License-Identifier: Apache-2.0 */
/* When a search has found the best strip, the functions of this file find the best box of this strip again, with all
   its sides and the value that is reported. */
#include "measures/extreme/extreme.h"

void koksma__extreme_of_strip(size_t n, const double *x, const double *y, double left, double right, bool closed,
                              koksma_value *out)
{
    double low = 0, low_at = 0;
    size_t inside = 0, low_inside = 0;
    bool any = !closed;
    out->value = -1;
    for (size_t i = 0; i < n + !closed; i++) {
        const double up = i < n ? y[i] : 1, area = (right - left) * up;
        const bool in = i < n && (closed ? x[i] >= left && x[i] <= right : x[i] > left && x[i] < right);
        if (closed && in && (!any || (double)inside / (double)n - area < low)) {
            low = (double)inside / (double)n - area;
            low_at = up;
            low_inside = inside;
            any = true;
        }
        inside += closed && in;
        const size_t count = inside - low_inside;
        const double volume = (right - left) * (up - low_at), share = (double)count / (double)n;
        const double value = closed ? share - volume : volume - share;
        if (any && value > out->value) {
            out->value = value;
            out->witness = (koksma_witness){.kind = KOKSMA_WITNESS_BOX,
                                            .dim = 2,
                                            .closed = closed,
                                            .count = count,
                                            .volume = volume,
                                            .lo = {left, low_at},
                                            .hi = {right, up}};
        }
        inside += !closed && in;
        if (!closed && area - (double)inside / (double)n < low) {
            low = area - (double)inside / (double)n;
            low_at = up;
            low_inside = inside;
        }
    }
}
