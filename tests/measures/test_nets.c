/* SPDX-License-Identifier: Apache-2.0 */
/* The quality t of nets in any base, by the measure t-value: against the definition, counted in
   every elementary interval with whole numbers; Faure's sequence and Hammersley's points, of which theory says t = 0.
 */
#include <koksma/verify.h>

#include <stdlib.h>

#include "test.h"

enum { MAX_DIM = 16, MAX_N = 20000 };

static unsigned long power(unsigned long base, int m)
{
    unsigned long result = 1;
    while (m-- > 0) {
        result *= base;
    }
    return result;
}

static double t_of(unsigned long base, const koksma_points *p)
{
    char text[64];
    snprintf(text, sizeof text, "t-value:base=%lu", base);
    return test_measure(text, p).value;
}

/* Points by whole numbers a: the fractions a/base^digits. */
typedef struct fractions {
    unsigned long base, *a;
    int dim, digits;
    size_t n;
} fractions;

/* Whether each interval prod [c_k/base^d_k, (c_k + 1)/base^d_k) holds n/(number of intervals) points. */
static bool shape_holds(const fractions *f, const int *d)
{
    unsigned long cells = 1, c[MAX_DIM] = {0};
    for (int k = 0; k < f->dim; k++) {
        cells *= power(f->base, d[k]);
    }
    for (unsigned long cell = 0; cell < cells; cell++) {
        unsigned long rest = cell;
        size_t count = 0;
        for (int k = 0; k < f->dim; k++) {
            c[k] = rest % power(f->base, d[k]);
            rest /= power(f->base, d[k]);
        }
        for (size_t i = 0; i < f->n; i++) {
            bool in = true;
            for (int k = 0; k < f->dim && in; k++) {
                const unsigned long x = f->a[i * (size_t)f->dim + (size_t)k],
                                    width = power(f->base, f->digits - d[k]);
                in = c[k] * width <= x && x < (c[k] + 1) * width;
            }
            count += in;
        }
        if (count * cells != f->n) {
            return false;
        }
    }
    return true;
}

static bool shapes_hold(const fractions *f, int *d, int k, int left)
{
    if (k == f->dim - 1) {
        d[k] = left;
        return shape_holds(f, d);
    }
    for (int here = 0; here <= left; here++) {
        d[k] = here;
        if (!shapes_hold(f, d, k + 1, left - here)) {
            return false;
        }
    }
    return true;
}

static int brute_t(const fractions *f)
{
    int m = 0, d[MAX_DIM];
    while (power(f->base, m) < f->n) {
        m++;
    }
    for (int t = 0; t < m; t++) {
        if (shapes_hold(f, d, 0, m - t)) {
            return t;
        }
    }
    return m;
}

static unsigned long draw(unsigned long below)
{
    static uint64_t state = 1;
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (unsigned long)((state >> 33) % below);
}

/* n = base^m points whose first m digits are random matrices times the digits of i, so that t is anything from 0 to
   m, and whose other digits are random. Some have a few points moved. */
static void random_net(fractions *f, int m)
{
    unsigned long matrices[4][8][8];
    for (int k = 0; k < f->dim; k++) {
        for (int r = 0; r < m; r++) {
            for (int c = 0; c < m; c++) {
                matrices[k][r][c] = k == 0 ? r + c == m - 1 : k == 1 && draw(2) ? r == c : draw(f->base);
            }
        }
    }
    for (size_t i = 0; i < f->n; i++) {
        for (int k = 0; k < f->dim; k++) {
            unsigned long a = 0;
            for (int r = 0; r < f->digits; r++) {
                unsigned long digit = r < m ? 0 : draw(f->base), index = i;
                for (int c = 0; c < m && r < m; c++, index /= f->base) {
                    digit += matrices[k][r][c] * (index % f->base);
                }
                a = a * f->base + digit % f->base;
            }
            f->a[i * (size_t)f->dim + (size_t)k] = a;
        }
    }
    for (unsigned long moves = draw(4); moves > 1; moves--) {
        f->a[draw(f->n) * (unsigned long)f->dim] = draw(power(f->base, f->digits));
    }
}

TEST_CASE(any_base_equals_the_definition)
{
    static const unsigned long bases[] = {2, 3, 4, 5, 6, 7, 9, 10, 11, 13};
    int seen[8] = {0};
    for (size_t b = 0; b < sizeof bases / sizeof *bases; b++) {
        for (int s = 0; s < 60; s++) {
            fractions f = {.base = bases[b], .dim = 1 + s % 4};
            int m = 1 + s % 3;
            while (s % 5 == 0 && power(f.base, m + 1) <= 128 && m < 6) {
                m++;
            }
            f.n = power(f.base, m);
            while (f.n > 400) {
                f.n = power(f.base, --m);
            }
            f.digits = m + s % 6;
            f.a = malloc(f.n * (size_t)f.dim * sizeof *f.a);
            koksma_points p;
            assert_ok(koksma_points_init(&p, f.n, f.dim));
            random_net(&f, m);
            for (size_t i = 0; i < f.n * (size_t)f.dim; i++) {
                p.xs[i] = (double)f.a[i] / (double)power(f.base, f.digits); /* rounded once */
            }
            const int t = brute_t(&f);
            seen[t]++;
            assert_near(t_of(f.base, &p), t, 0);
            koksma_points_fini(&p);
            free(f.a);
        }
    }
    assert_true(seen[0] > 50 && seen[1] > 50 && seen[2] > 20 && seen[3] > 5);
}

/* Every fraction with this many digits is in the interval that its digits name, in no other. */
TEST_CASE(every_fraction_is_where_its_digits_say)
{
    for (unsigned long base = 2; base <= 50; base++) {
        for (int m = 1; power(base, m) <= 4096; m++) {
            koksma_points p;
            assert_ok(koksma_points_init(&p, power(base, m), 1));
            for (size_t i = 0; i < p.n; i++) {
                p.xs[i] = (double)i / (double)p.n;
            }
            assert_near(t_of(base, &p), 0, 0);
            if (m > 1) {
                p.xs[1] = 0; /* one interval of base^-m has two, a neighbour none; larger ones are as before */
                assert_near(t_of(base, &p), 1, 0);
            }
            koksma_points_fini(&p);
        }
    }
}

/* Shapes times points times coordinates. */
static double work(double n, int m, int dim)
{
    double count = n * dim;
    for (int k = 1; k < dim; k++) {
        count *= (double)(m + k) / k;
    }
    return count;
}

/* Faure 1982: the first b^m points, and each aligned block of as many, are (0,m,s)-nets for every s <= b. */
TEST_CASE(faure_has_t_zero)
{
    static const struct {
        unsigned long base;
        int least_dim;
    } of[] = {{2, 1}, {3, 3}, {5, 4}, {7, 6}, {11, 8}, {13, 12}};
    for (size_t b = 0; b < sizeof of / sizeof *of; b++) {
        const unsigned long base = of[b].base;
        for (int dim = of[b].least_dim; dim <= (int)base; dim++) {
            for (int m = 1; power(base, m) <= MAX_N && work((double)power(base, m), m, dim) <= 2e7; m++) {
                const size_t n = power(base, m);
                koksma_points p = test_points("faure", 2 * n, dim, 0);
                for (size_t block = 0; block < 2; block++) {
                    assert_near(t_of(base, &(koksma_points){n, dim, p.xs + block * n * (size_t)dim}), 0, 0);
                }
                koksma_points_fini(&p);
            }
        }
    }
}

/* i/n and the radical inverse in the base: Hammersley's points, t = 0. The inverses are those of the pattern halton,
   whose coordinate k is in the prime number k. */
TEST_CASE(hammersley_of_each_prime_has_t_zero)
{
    static const unsigned long primes[] = {2, 3, 5, 7, 11, 13, 17, 19};
    enum { DIM = sizeof primes / sizeof *primes };
    koksma_points halton = test_points("halton", MAX_N, DIM, 0);
    for (int k = 0; k < DIM; k++) {
        for (int m = 1; power(primes[k], m) <= MAX_N; m++) {
            koksma_points p;
            assert_ok(koksma_points_init(&p, power(primes[k], m), 2));
            for (size_t i = 0; i < p.n; i++) {
                p.xs[2 * i] = (double)i / (double)p.n;
                p.xs[2 * i + 1] = halton.xs[i * DIM + (size_t)k];
            }
            assert_near(t_of(primes[k], &p), 0, 0);
            p.xs[1] = p.xs[3]; /* two points in a stratum of 1/n */
            assert_true(t_of(primes[k], &p) > 0);
            koksma_points_fini(&p);
        }
    }
    koksma_points_fini(&halton);
}
