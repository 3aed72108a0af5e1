/* SPDX-License-Identifier: Apache-2.0 */
/* The kernels of disks against their plain twins, and the bits of the instruction sets against each
   other. */
#include "kernels/kernels.h"
#include "sets.h"

enum { MAX = 150 };

static const char *const isas[] = {"baseline", "avx2", "avx512"};

static double xs[3 * MAX];

static void fill(size_t count)
{
    for (size_t i = 0; i < 3 * MAX; i++) {
        const double u = sets_unit(count, i);
        xs[i] = i % 5 == 0 ? floor(u * 8) / 8 : i % 7 == 0 ? xs[i > MAX ? i - MAX : 0] : u;
    }
}

TEST_CASE(overlaps_agree)
{
    static const double radii[] = {0.5, 0.3, 0.25, 0.07, 1e-3};
    const koksma__kernel_table *ref = koksma__kernels_find("ref"), *base = koksma__kernels_find("baseline");
    for (size_t count = 0; count <= MAX; count += 1 + count / 5) {
        fill(count);
        for (int c = 0; c < 15; c++) {
            const double r = radii[c / 3], x = c % 2 ? xs[0] : 0.3, y = c % 2 ? xs[MAX] : 0.9;
            const double plain = ref->disk_overlaps(c % 3, r, x, y, count, xs, xs + MAX);
            const double one = base->disk_overlaps(c % 3, r, x, y, count, xs, xs + MAX);
            assert_near(one, plain, 1e-14 * (double)count * r * r);
            for (size_t isa = 0; isa < 3; isa++) {
                const koksma__kernel_table *fast = koksma__kernels_find(isas[isa]);
                if (fast) {
                    assert_true(fast->disk_overlaps(c % 3, r, x, y, count, xs, xs + MAX) == one);
                }
            }
        }
    }
}

/* The overlap at every distance: the arc cosine and the logarithm of the fast form. */
TEST_CASE(functions_agree)
{
    const koksma__kernel_table *ref = koksma__kernels_find("ref"), *base = koksma__kernels_find("baseline");
    for (int i = 0; i <= 20000; i++) {
        const double u = i / 20000.0, x = 0.5 * (i % 2 ? u : u * u * u * u * u * u * u * u), y = 0;
        for (int law = 0; law < 3; law++) {
            assert_near(base->disk_overlaps(law, 0.25, 0, 0, 1, &x, &y),
                        ref->disk_overlaps(law, 0.25, 0, 0, 1, &x, &y), 2e-16);
        }
    }
}

/* phi - sin phi cos phi, half of it where it is small: without cancelling. */
static double segment(double one_less_cosine)
{
    const double phi = 2 * asin(sqrt(one_less_cosine / 2)), x = 2 * phi;
    double term = x * x * x / 6, sum = 0;
    for (int k = 4; fabs(term) > 1e-20 * sum; k += 2) {
        sum += term;
        term *= -x * x / (k * (k + 1));
    }
    return sum / 2;
}

/* Disks that barely meet, as those of r = 1/2 about crowded points do around the torus. They are a distance of
   2 r (1 - e) apart, and share 2 r^2 (phi - sin phi cos phi) with cos phi = 1 - e; for the other laws this is
   averaged over the radius or the area. Every form keeps the last bits. */
TEST_CASE(disks_that_touch)
{
    static const char *const all[] = {"ref", "baseline", "avx2", "avx512"};
    for (int i = 0; i < 4; i++) {
        const koksma__kernel_table *kernels = koksma__kernels_find(all[i]);
        for (int k = 0; kernels && k < 60; k++) {
            const double r = 0.25, x = 0.5 * (1 - pow(10, -1 - 0.25 * k)), y = 0, e = 1 - 2 * x;
            assert_near(kernels->disk_overlaps(0, r, 0, 0, 1, &x, &y), 2 * r * r * segment(e), 1e-16);
            for (int law = 1; law < 3 && e < 1e-5; law++) {
                double mean = 0;
                enum { STEPS = 1000 };
                for (int j = 0; j < STEPS; j++) { /* radii rho = r (1 - e u) */
                    const double u = (j + 0.5) / STEPS, rho = r * (1 - e * u), part = 2 * rho * rho;
                    mean += part * segment(e * (1 - u) / (1 - e * u)) * (law == 1 ? e : 2 * e * (1 - e * u)) / STEPS;
                }
                assert_near(kernels->disk_overlaps(law, r, 0, 0, 1, &x, &y), mean, 1e-16);
            }
        }
    }
}
