/* SPDX-License-Identifier: Apache-2.0 */
/* Spearman's rank correlation by its definition in O(n^2), which is fast because n is the number of patterns and thus
   small. Values that koksma__compare finds equal are ties, so that rounding does not decide an order. */
#include "stats/stats.h"

#include <math.h>

/* Returns the mean rank of value i minus the middle rank (n + 1) / 2. The mean rank is b + (e + 1) / 2, with b the
   number of smaller values and e the number of equal values, i included. Spearman's rho is Pearson's correlation of
   these ranks (Spearman 1904). */
static double centred_rank(const double *values, size_t n, size_t i)
{
    double rank = -0.5 * (double)n;
    for (size_t j = 0; j < n; j++) {
        rank += 0.5 * (koksma__compare(values[i], values[j]) + 1);
    }
    return rank;
}

double koksma__spearman(const double *x, const double *y, size_t n)
{
    double xx = 0, yy = 0, xy = 0;
    for (size_t i = 0; i < n; i++) {
        const double a = centred_rank(x, n, i), b = centred_rank(y, n, i);
        xx += a * a;
        yy += b * b;
        xy += a * b;
    }
    return xx > 0 && yy > 0 ? xy / sqrt(xx * yy) : (double)NAN;
}

enum { EXACT = 10, MOST_SQUARES = EXACT * (EXACT * EXACT - 1) / 3 };

/* Counts the orders of n ranks that begin with k given ones (a bit of `taken` each) by their sums of squares. */
static void count_orders(size_t n, size_t k, unsigned taken, size_t squares, double counts[MOST_SQUARES + 1])
{
    counts[squares] += k == n;
    for (size_t i = 0; i < n; i++) {
        if (!(taken >> i & 1)) {
            const size_t d = i > k ? i - k : k - i;
            count_orders(n, k + 1, taken | 1U << i, squares + d * d, counts);
        }
    }
}

double koksma__spearman_limit(size_t n, double alpha)
{
    double counts[MOST_SQUARES + 1] = {0}, orders = 1, tail = 0, limit = NAN;
    const double size = (double)n;
    if (n > EXACT) {
        const double t = koksma__student_quantile(1 - alpha, size - 2);
        return t / sqrt(size - 2 + t * t);
    }
    for (size_t i = 2; i <= n; i++) {
        orders *= (double)i;
    }
    if (n < 2) {
        return NAN;
    }
    count_orders(n, 0, 0, 0, counts);
    for (size_t squares = 0; (tail += counts[squares]) <= alpha * orders; squares++) {
        limit = counts[squares] > 0 ? 1 - 6 * (double)squares / (size * (size * size - 1)) : limit; /* none is odd */
    }
    return limit;
}
