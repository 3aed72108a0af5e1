/* SPDX-License-Identifier: Apache-2.0 */
/* Pair sums of the L2 discrepancies. Rows are summed in a fixed number of lanes, so that the order of the additions,
   and with it every bit, is the same for every instruction set; the row sums are added with compensation. */
#include <math.h>

#include "core/sum.h"
#include "kernels/kernels.h"

enum { LANES = 8 };

double KERNEL_NAME(l2_star)(size_t n, int dim, const double *xs);

static double prod_complement_max(int dim, const double *x, const double *y)
{
    double pair = 1;
    for (int k = 0; k < dim; k++) {
        pair *= 1 - (x[k] > y[k] ? x[k] : y[k]);
    }
    return pair;
}

/* sum_{j < i} prod_k (1 - max(x_ik, x_jk)) */
static double row(int dim, const double *xs, size_t i)
{
    const double *x = xs + i * (size_t)dim;
    double lanes[LANES] = {0};
    size_t j = 0;
    if (dim == 2) {
        for (; j + LANES <= i; j += LANES) {
            for (int l = 0; l < LANES; l++) {
                const double *y = xs + 2 * (j + (size_t)l);
                const double a = x[0] > y[0] ? x[0] : y[0], b = x[1] > y[1] ? x[1] : y[1];
                lanes[l] += (1 - a) * (1 - b);
            }
        }
    }
    for (; j < i; j++) {
        lanes[j % LANES] += prod_complement_max(dim, x, xs + j * (size_t)dim);
    }
    return ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) + ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7]));
}

double KERNEL_NAME(l2_star)(size_t n, int dim, const double *xs)
{
    koksma__sum linear = {0}, pairs = {0};
    for (size_t i = 0; i < n; i++) {
        const double *x = xs + i * (size_t)dim;
        double product = 1, self = 1;
        for (int k = 0; k < dim; k++) {
            product *= (1 - x[k] * x[k]) / 2;
            self *= 1 - x[k];
        }
        koksma__sum_add(&linear, product);
        koksma__sum_add(&pairs, self);
        koksma__sum_add(&pairs, 2 * row(dim, xs, i));
    }
    const double count = (double)n;
    koksma__sum square = {0};
    koksma__sum_add(&square, pow(3, -dim));
    koksma__sum_add(&square, -2 * koksma__sum_value(&linear) / count);
    koksma__sum_add(&square, koksma__sum_value(&pairs) / count / count);
    return koksma__sum_value(&square);
}
