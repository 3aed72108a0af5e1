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
 *     E(E(f | x_u)^2) / discount^2   the mean of the product of two payoffs whose log G have the correlation
 *                                    rho = sum_u a^2 / s^2:
 *                                    exp(2 mu + s^2 (1 + rho)) Phi2(h + s (1 + rho), h + s (1 + rho))
 *                                    - 2 K exp(mu + s^2 / 2) Phi2(h + s, h + rho s) + K^2 Phi2(h, h)
 *
 * where discount = exp(-R T), and Phi and Phi2 are the distribution functions of the standard normal distribution on
 * the line and, with correlation rho, in the plane. The payoff is unbounded, and its variation is infinite.
 */
#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/status.h"
#include "integrands/integrands.h"

enum { NODES = 52 };
static const double initial = 100, rate = 0.05;

static double normal(double h)
{
    return koksma__erfc(-h * M_SQRT1_2) / 2;
}

/* Phi2(h, k; rho) = Phi(h) Phi(k) + 1 / (2 pi) times the integral of exp(-(h^2 + k^2 - 2 h k sin t) / (2 cos^2 t))
   over t from 0 to asin(rho) (Drezner & Wesolowsky 1990), by the tanh-sinh rule, for rho >= 0. */
static double normal_plane(double h, double k, double rho)
{
    if (rho >= 1 - 1e-15) {
        return normal(fmin(h, k));
    }
    const double half = koksma__asin(rho) / 2, step = 1.0 / 16;
    double sum = 0;
    for (int i = -NODES; i <= NODES; i++) {
        const double u = M_PI_2 * koksma__sinh(i * step), t = half * (1 + koksma__tanh(u)), c = koksma__cos(t);
        sum += M_PI_2 * koksma__cosh(i * step) / (koksma__cosh(u) * koksma__cosh(u)) *
               koksma__exp(-((h - k) * (h - k) + 2 * h * k * (1 - koksma__sin(t))) / (2 * c * c));
    }
    return normal(h) * normal(k) + half * step * sum / (2 * M_PI);
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

/* Returns E(E(f | x_u)^2), where rho is the share of x_u in the variance of log G. */
static double explained_square(const koksma_integral *f, double rho)
{
    const double mu = log_mean(f), s = deviation(f), K = f->params[0], h = (mu - koksma__log(K)) / s;
    const double both = koksma__exp(2 * mu + s * s * (1 + rho)) *
                        normal_plane(h + s * (1 + rho), h + s * (1 + rho), rho),
                 one = koksma__exp(mu + s * s / 2) * normal_plane(h + s, h + rho * s, rho);
    return koksma__exp(-2 * rate) * (both - 2 * K * one + K * K * normal_plane(h, h, rho));
}

static double explained(const koksma_integral *f, const bool *held)
{
    double square = 0, all = 0;
    for (int i = 0; i < f->dim; i++) {
        square += held[i] ? f->a[i] * f->a[i] : 0;
        all += f->a[i] * f->a[i];
    }
    return explained_square(f, square / all) - f->value * f->value;
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
    f->variance = explained_square(f, 1) - f->value * f->value;
    f->variation = HUGE_VAL;
    f->lowest = 0;
    f->highest = HUGE_VAL;
    f->explained = explained;
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
