/* SPDX-License-Identifier: Apache-2.0 */
/* Scrambled Faure points on Genz's integrands, against the shifted sequence and a peer's numbers. */
#include <string.h>

#include "core/random.h"
#include "test.h"

/* Genz's (1984) integrands in five dimensions: all a are 1; places u are random, the
   wave has phase 0, as errors are relative to the integral. */
enum { GENZ = 6, D = 5 };

typedef struct genz {
    double a[GENZ][D], u[D], exact[GENZ];
} genz;

static void genz_init(genz *g, uint64_t seed)
{
    const double pi = 3.14159265358979323846;
    for (int k = 0; k < D; k++) {
        double pair[2];
        koksma__random_pair(seed, KOKSMA__PURPOSE_TEST, (uint64_t)k, 7, pair);
        g->u[k] = 0.3 + 0.7 * pair[0];
        for (int j = 0; j < GENZ; j++) {
            g->a[j][k] = 1;
        }
    }
    double phase = 0, value[GENZ] = {1, 1, 0, 1, 1, 1}, volume = 120;
    for (int k = 0; k < D; k++) {
        const double u = g->u[k], *a = &g->a[0][k];
        phase += a[0] / 2;
        value[0] *= 2 * sin(a[0] / 2) / a[0];
        value[1] *= a[D] * (atan(a[D] * (1 - u)) + atan(a[D] * u));
        volume *= a[2 * D];
        value[3] *= sqrt(pi) / (2 * a[3 * D]) * (erf(a[3 * D] * (1 - u)) + erf(a[3 * D] * u));
        value[4] *= (2 - exp(-a[4 * D] * u) - exp(-a[4 * D] * (1 - u))) / a[4 * D];
        value[5] *= (exp(a[5 * D] * (k < 2 ? u : 1)) - 1) / a[5 * D];
    }
    value[0] *= cos(phase);
    for (int corner = 0; corner < 1 << D; corner++) {
        double sum = 1, sign = 1;
        for (int k = 0; k < D; k++) {
            sum += corner >> k & 1 ? g->a[2][k] : 0;
            sign = corner >> k & 1 ? -sign : sign;
        }
        value[2] += sign / sum / volume;
    }
    memcpy(g->exact, value, sizeof value);
}

static void genz_errors(const genz *g, const koksma_points *points, double errors[GENZ])
{
    double sums[GENZ] = {0};
    for (size_t i = 0; i < points->n; i++) {
        const double *x = points->xs + D * i;
        double phase = 0, product = 1, corner = 1, square = 0, absolute = 0, ramp = 0;
        for (int k = 0; k < D; k++) {
            const double t = x[k] - g->u[k];
            phase += g->a[0][k] * x[k];
            product *= 1 / (1 / (g->a[1][k] * g->a[1][k]) + t * t);
            corner += g->a[2][k] * x[k];
            square += g->a[3][k] * g->a[3][k] * t * t;
            absolute += g->a[4][k] * fabs(t);
            ramp += g->a[5][k] * x[k];
        }
        sums[0] += cos(phase);
        sums[1] += product;
        sums[2] += 1 / (corner * corner * corner * corner * corner * corner);
        sums[3] += exp(-square);
        sums[4] += exp(-absolute);
        sums[5] += x[0] < g->u[0] && x[1] < g->u[1] ? exp(ramp) : 0;
    }
    for (int j = 0; j < GENZ; j++) {
        errors[j] = (sums[j] / (double)points->n - g->exact[j]) / g->exact[j];
    }
}

/* Errors relative to the integral with n = 4096 points, root mean squares: at most those that were measured for
   Helmer's program with Owen scrambling in base 5 on integrands of this kind, whose shifted sequence
   had 3.9e-3, 3.2e-4, 5.7e-2, 6.3e-4, 5.0e-4, 1.4e-2. As its places and difficulties are not known, a tenth more is
   allowed. And at n = 1024 and 4096 at most three quarters of the shifted sequence's error here, of the corner peak
   nine tenths. */
static void genz_errors_are_a_peers(void **state)
{
    (void)state;
    enum { FUNCTIONS = 3, SEEDS = 80 };
    static const double peers[GENZ] = {1.1e-3, 1.6e-4, 3.2e-2, 2.8e-4, 2.7e-4, 6.0e-3};
    genz functions[FUNCTIONS];
    for (uint64_t f = 0; f < FUNCTIONS; f++) {
        genz_init(&functions[f], f);
    }
    for (size_t n = 1024; n <= 4096; n *= 4) {
        double squares[2][GENZ] = {{0}};
        for (uint64_t seed = 0; seed < 2 * SEEDS; seed++) {
            koksma_points points = test_points(seed % 2 ? "faure:scramble=owen" : "faure:shift=1", n, D, seed);
            for (size_t f = 0; f < FUNCTIONS; f++) {
                double errors[GENZ];
                genz_errors(&functions[f], &points, errors);
                for (int j = 0; j < GENZ; j++) {
                    squares[seed % 2][j] += errors[j] * errors[j] / SEEDS / FUNCTIONS;
                }
            }
            koksma_points_fini(&points);
        }
        for (int j = 0; j < GENZ; j++) {
            const double shifted = sqrt(squares[0][j]), owen = sqrt(squares[1][j]);
            if (!(owen < (j == 2 ? 0.9 : 0.75) * shifted && (n == 1024 || owen < 1.1 * peers[j]))) {
                fail_msg("n = %zu, integrand %d: %.2e, shifted %.2e, a peer's %.2e", n, j, owen, shifted, peers[j]);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(genz_errors_are_a_peers)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
