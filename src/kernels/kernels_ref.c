/* SPDX-License-Identifier: Apache-2.0 */
/* The reference twins: plain loops and compensated sums, no intrinsics, no blocking. The judge of fast_*.c. */
#define KOKSMA_ISA ref
#include <math.h>

#include "core/random.h"
#include "core/sum.h"
#include "kernels/kernels.h"

#define KERNEL(result, name, arguments) result KERNEL_NAME(name) arguments;
#include "kernels/kernels.def"
#undef KERNEL

void KERNEL_NAME(uniform)(uint64_t seed, uint32_t purpose, uint64_t first, uint32_t lane, size_t count, double *out)
{
    for (size_t i = 0; i < count; i++) {
        koksma__random_pair(seed, purpose, first + i, lane, out + 2 * i);
    }
}

void KERNEL_NAME(words)(uint64_t seed, uint32_t purpose, uint64_t first, uint32_t lane, size_t count, uint32_t *out)
{
    for (size_t i = 0; i < count; i++) {
        const koksma__words r = koksma__random(seed, purpose, first + i, lane);
        for (int k = 0; k < 4; k++) {
            out[4 * i + (size_t)k] = r.w[k];
        }
    }
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
        for (size_t j = 0; j < i; j++) {
            const double *y = xs + j * (size_t)dim;
            double pair = 2;
            for (int k = 0; k < dim; k++) {
                pair *= 1 - (x[k] > y[k] ? x[k] : y[k]);
            }
            koksma__sum_add(&pairs, pair);
        }
    }
    const double count = (double)n;
    koksma__sum square = {0};
    koksma__sum_add(&square, pow(3, -dim));
    koksma__sum_add(&square, -2 * koksma__sum_value(&linear) / count);
    koksma__sum_add(&square, koksma__sum_value(&pairs) / count / count);
    return koksma__sum_value(&square);
}

static double overlap(int law, double r, double distance)
{
    const double h = distance / 2;
    if (h >= r) {
        return 0;
    }
    const double s = sqrt(r * r - h * h), angle = acos(h / r);
    switch (law) {
    case 0: return 2 * r * r * angle - 2 * h * s;
    case 1: return (2 * r * r * r * angle - 4 * h * r * s + (h > 0 ? 2 * h * h * h * log((r + s) / h) : 0)) / (3 * r);
    default: return (r * r * r * r * angle - (5 * h * s * s * s) / 3 - h * h * h * s) / (r * r);
    }
}

double KERNEL_NAME(disk_overlaps)(int law, double r, double x, double y, size_t count, const double *xs,
                                  const double *ys)
{
    koksma__sum sum = {0};
    for (size_t j = 0; j < count; j++) {
        for (int image = 0; image < 9; image++) {
            const double dx = x - xs[j] + image % 3 - 1, dy = y - ys[j] + image / 3 - 1;
            koksma__sum_add(&sum, overlap(law, r, sqrt(dx * dx + dy * dy)));
        }
    }
    return koksma__sum_value(&sum);
}

size_t KERNEL_NAME(disk_count)(double r, double x, double y, size_t count, const double *xs, const double *ys)
{
    size_t inside = 0;
    for (size_t j = 0; j < count; j++) {
        const double dx = fabs(x - xs[j]), dy = fabs(y - ys[j]);
        const double a = dx < 1 - dx ? dx : 1 - dx, b = dy < 1 - dy ? dy : 1 - dy;
        inside += a * a + b * b <= r * r;
    }
    return inside;
}

double KERNEL_NAME(distances)(int dim, const double *x, size_t count, size_t stride, const double *xs)
{
    koksma__sum sum = {0};
    for (size_t j = 0; j < count; j++) {
        double square = 0;
        for (int k = 0; k < dim; k++) {
            const double d = x[k] - xs[(size_t)k * stride + j];
            square += d * d;
        }
        koksma__sum_add(&sum, sqrt(square));
    }
    return koksma__sum_value(&sum);
}
