/* SPDX-License-Identifier: Apache-2.0 */
/* What bounds of errors need of integrands of the line and the plane: integrals, ranges, variations, by definition. */
#include <math.h>

#include "integrands/integrands.h"
#include "test.h"

/* Every integrand that depends on all of one or two coordinates. */
typedef struct function {
    const koksma_integral *integral;
    const char *name;
    int dim;
    double value, variation, range;
} function;

static function functions[64];
static size_t n_functions;

static int open_functions(void **state)
{
    (void)state;
    const koksma_integrand *member;
    for (size_t i = 0; (member = koksma_integrand_at(i)); i++) {
        for (int dim = 1; dim <= 2; dim++) {
            koksma_integral *f;
            if (dim >= member->min_dim && (member->axes == 0 || member->axes == dim)) {
                assert_ok(koksma_integral_open(member->name, dim, &f));
                functions[n_functions++] =
                    (function){f, member->name, dim, f->value, f->variation, f->highest - f->lowest};
            }
        }
    }
    assert_true(n_functions >= 12 + 5 + 2 * 8);
    return 0;
}

static int close_functions(void **state)
{
    (void)state;
    for (size_t i = 0; i < n_functions; i++) {
        koksma_integral_close((koksma_integral *)functions[i].integral);
    }
    return 0;
}

static double at(const function *f, const double *x)
{
    return f->integral->integrand->at(f->integral, x);
}

/* The largest sum of differences over grids of m cells, ends included: Hardy and Krause's variation anchored at 1 is
   what it goes to. offset moves the inner lines, so that steps are between lines. */
static double variation_on_grid(const function *f, int m)
{
    double lines[513], total = 0;
    for (int i = 0; i <= m; i++) {
        lines[i] = i == 0 ? 0 : i == m ? 1 : (i + 0.013) / m;
    }
    for (int axis = 0; axis < f->dim; axis++) { /* the sides where the other coordinate is 1 */
        for (int i = 0; i < m; i++) {
            double a[2] = {1, 1}, b[2] = {1, 1};
            a[axis] = lines[i];
            b[axis] = lines[i + 1];
            total += fabs(at(f, b) - at(f, a));
        }
    }
    for (int c = 0; f->dim == 2 && c < m * m; c++) {
        const double *x = lines + c % m, *y = lines + c / m;
        total += fabs(at(f, (double[2]){x[1], y[1]}) - at(f, (double[2]){x[0], y[1]}) -
                      at(f, (double[2]){x[1], y[0]}) + at(f, (double[2]){x[0], y[0]}));
    }
    return total;
}

TEST_CASE(variations_are_sums_of_differences)
{
    for (size_t i = 0; i < n_functions; i++) {
        const function *f = &functions[i];
        const double missed = f->integral->integrand->axes ? 1e-4 : 0.05; /* of a peak between two lines */
        const double coarse = variation_on_grid(f, 128), fine = variation_on_grid(f, 512);
        if (isnan(f->variation) || isinf(f->range)) {
            continue; /* not known, or of the range */
        }
        if (isinf(f->variation)) {
            assert_that(fine > 3 * coarse, "%s: %g with 128 lines, %g with 512", f->name, coarse, fine);
            continue;
        }
        assert_that(fine <= f->variation * (1 + 1e-12) && fine >= f->variation * (1 - missed),
                    "%s: variation %.10g, on a grid %.10g", f->name, f->variation, fine);
        assert_true(coarse <= f->variation * (1 + 1e-12));
    }
}

/* The midpoint rule on a fine grid; steps cost it no more than a row of cells along each edge. */
TEST_CASE(integrals_and_ranges_hold)
{
    enum { SIDE = 1000 };
    for (size_t i = 0; i < n_functions; i++) {
        const function *f = &functions[i];
        double sum = 0, low = HUGE_VAL, high = -HUGE_VAL;
        for (int c = 0; c < SIDE * SIDE; c++) {
            const double y = at(f, (double[2]){(c % SIDE + 0.5) / SIDE, (c / SIDE + 0.5) / SIDE});
            sum += y / (SIDE * SIDE);
            low = fmin(low, y);
            high = fmax(high, y);
        }
        const double scale = isinf(f->range) ? high - low : fmax(f->range, 1);
        assert_that(fabs(sum - f->value) <= 6e-4 * scale && high - low <= f->range * (1 + 1e-14) &&
                        (isinf(f->range) || high - low >= 0.97 * f->range),
                    "%s: integral %.10g, on a grid %.10g; range %g of %g", f->name, f->value, sum, high - low,
                    f->range);
    }
}

TEST_GROUP(open_functions, close_functions)
