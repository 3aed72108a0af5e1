/* SPDX-License-Identifier: Apache-2.0 */
/*
 * asian: the discounted payoff exp(-R T) max(G - K, 0) of an Asian call option on the geometric mean G of the prices
 * at d equal steps up to T = 1 (Kemna & Vorst 1990; Glasserman 2004, 3.2), with the initial price S = 100, rate R =
 * .05 and prices S exp((R - v^2 / 2) t + v W(t)). Each x_k is mapped to a normal number z_k, and the z_k to the
 * Brownian motion W: by steps in time (path=steps), or by the Brownian bridge (Caflisch, Morokoff & Owen 1997). The
 * bridge computes W at the last time first, and then always in the middle of the widest gap between known times, so
 * that the first coordinates cause most of the variance.
 *
 * log G = mu + sum a_k z_k, where the weights a_k depend on the path and sum a_k^2 = s^2. With h = (mu - log K) / s,
 *
 *     integral / discount            exp(mu + s^2 / 2) Phi(h + s) - K Phi(h)
 *     mean square / discount^2       exp(2 mu + 2 s^2) Phi(h + 2 s) - 2 K exp(mu + s^2 / 2) Phi(h + s) + K^2 Phi(h)
 *
 * where discount = exp(-R T), and Phi is the distribution function of the standard normal distribution. The payoff is
 * unbounded, and its variation is infinite.
 */
#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/status.h"
#include "integrands/integrands.h"

static const double initial = 100, rate = 0.05;

static double normal(double h)
{
    return koksma__erfc(-h * M_SQRT1_2) / 2;
}

/* Computes mu and s, the mean and standard deviation of log G. */
static double log_mean(const koksma_integral *f)
{
    const double v = f->params[1], mean_time = (f->dim + 1.0) / (2.0 * f->dim);
    return koksma__log(initial) + (rate - v * v / 2) * mean_time;
}

static double deviation(const koksma_integral *f)
{
    double square = 0;
    for (int i = 0; i < f->dim; i++) {
        square += f->a[i] * f->a[i];
    }
    return sqrt(square);
}

/* Computes the weights of the Brownian bridge. A middle m between times l and r has W_m = ((r - m) W_l + (m - l) W_r)
   / (r - l) + sqrt((m - l) (r - m) / ((r - l) d)) z. For each gap, from the last to the first, the weight of W_m in
   the mean is distributed to z, W_l and W_r. */
static koksma_status bridge_weights(koksma_integral *f)
{
    const size_t d = (size_t)f->dim;
    /* the gaps as pairs l, r; the middle of a gap divides it into two gaps */
    size_t *gaps = malloc(4 * d * sizeof *gaps), n = 1, z = d;
    double *weight = malloc((d + 1) * sizeof *weight);
    if (!gaps || !weight) {
        free(gaps);
        free(weight);
        return koksma__fail_memory(4 * d * sizeof *gaps);
    }
    gaps[0] = 0;
    gaps[1] = d;
    for (size_t i = 0; i < n; i++) {
        const size_t l = gaps[2 * i], r = gaps[2 * i + 1], m = l + (r - l) / 2;
        if (r - l > 1) {
            gaps[2 * n] = l;
            gaps[2 * n + 1] = gaps[2 * n + 2] = m;
            gaps[2 * n + 3] = r;
            n += 2;
        }
    }
    for (size_t j = 0; j <= d; j++) {
        weight[j] = f->params[1] / (double)d;
    }
    for (size_t i = n; i-- > 0;) {
        const size_t l = gaps[2 * i], r = gaps[2 * i + 1], m = l + (r - l) / 2;
        const double left = (double)(m - l), right = (double)(r - m), both = left + right;
        if (r - l > 1) {
            f->a[--z] = weight[m] * sqrt(left * right / (both * (double)d));
            weight[l] += weight[m] * right / both;
            weight[r] += weight[m] * left / both;
        }
    }
    f->a[0] = weight[d];
    free(gaps);
    free(weight);
    return KOKSMA_OK;
}

static koksma_status prepare(koksma_integral *f)
{
    const double K = f->params[0];
    f->a = malloc((size_t)f->dim * sizeof *f->a);
    KOKSMA__REQUIRE_MEMORY(f->a, (size_t)f->dim * sizeof *f->a);
    if (f->params[2] == 1) {
        KOKSMA__TRY(bridge_weights(f));
    } else {
        for (int k = 0; k < f->dim; k++) {
            f->a[k] = f->params[1] * (f->dim - k) / (f->dim * sqrt(f->dim));
        }
    }
    const double mu = log_mean(f), s = deviation(f), h = (mu - koksma__log(K)) / s;
    f->value = koksma__exp(-rate) * (koksma__exp(mu + s * s / 2) * normal(h + s) - K * normal(h));
    const double square = koksma__exp(2 * mu + s * s * 2) * normal(h + s * 2) -
                          2 * K * (koksma__exp(mu + s * s / 2) * normal(h + s)) + K * K * normal(h);
    f->variance = koksma__exp(-2 * rate) * square - f->value * f->value;
    f->variation = HUGE_VAL;
    f->lowest = 0;
    f->highest = HUGE_VAL;
    return KOKSMA_OK;
}

static double at(const koksma_integral *f, const double *x)
{
    double sum = log_mean(f);
    for (int k = 0; k < f->dim; k++) {
        sum += f->a[k] * M_SQRT2 * koksma__inverse_erf(2 * x[k] - 1);
    }
    return koksma__exp(-rate) * fmax(koksma__exp(sum) - f->params[0], 0);
}

static const char *const paths[] = {"steps", "bridge", NULL};

static const koksma_param params[] = {
    {"strike", "strike price K; the initial price is 100", 100, 1, 10000, NULL, false},
    {"volatility", "volatility v: standard deviation of the logarithm of the price after a year", 0.2, 0.001, 5, NULL,
     false},
    {"path", "construction of the path from normal numbers", 0, 0, 1, paths, true},
    {0},
};

const koksma_integrand koksma__integrand_asian = {
    .name = "asian",
    .title = "payoff of an Asian option on the geometric mean of d prices",
    .cite = "kemna1990 glasserman2004 caflisch1997",
    .known = "closed form",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .params = params,
    .prepare = prepare,
    .at = at,
    .revision = 1, /* own elementary functions, inverse erf by polynomials alone */
};
