/* SPDX-License-Identifier: Apache-2.0 */
/* The reference kernels of the measures: plain loops and compensated sums, without intrinsics or blocking. Tests
   compare fast_*.c with them. */
#define KOKSMA_ISA ref
#include <math.h>

#include <koksma/sampler.h>

#include "core/double_double.h"
#include "core/elementary.h"
#include "core/random.h"
#include "core/sum.h"
#include "kernels/kernels.h"

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

void KERNEL_NAME(draws)(uint64_t seed, uint32_t purpose, uint64_t first, uint32_t lane, size_t count, uint32_t *out)
{
    for (size_t i = 0; i < count; i++) {
        const koksma__words r = koksma__random_draw(seed, purpose, first + i, lane);
        for (int k = 0; k < 4; k++) {
            out[4 * i + (size_t)k] = r.w[k];
        }
    }
}

void KERNEL_NAME(permutation)(uint64_t seed, uint32_t lane, uint32_t n, uint32_t *out)
{
    koksma__random_permutation(seed, lane, n, out);
}

void KERNEL_NAME(l2_linear)(size_t count, int dim, const double *u, size_t stride, const double f[4], double *hi,
                            double *lo)
{
    for (size_t i = 0; i < count; i++) {
        koksma__dd product = {1, 0};
        for (size_t k = 0; k < (size_t)dim; k++) {
            const double z = u[k * stride + i] - 0.5;
            koksma__dd a = {f[0], 0};
            a = f[1] != 0 ? koksma__dd_add(a, koksma__dd_product(f[1], z)) : a;
            a = f[2] != 0 ? koksma__dd_add(a, koksma__dd_scale(koksma__dd_product(z, z), f[2])) : a;
            a = f[3] != 0 ? koksma__dd_add(a, koksma__dd_product(f[3], fabs(z))) : a;
            product = koksma__dd_mul(product, koksma__dd_divide(a, 24));
        }
        hi[i] = product.hi;
        lo[i] = product.lo;
    }
}

void KERNEL_NAME(l2_pairs)(size_t first, size_t end, size_t n, int dim, const double *u, const double *g, double q,
                           double r, double sum[2])
{
    koksma__sum pairs = {0};
    for (size_t i = first; i < end; i++) {
        for (size_t j = 0; j < i; j++) {
            double product = 1;
            for (size_t k = 0; k < (size_t)dim; k++) {
                const double t = fabs(u[k * n + i] - u[k * n + j]);
                product *= g[k * n + i] + g[k * n + j] + q * t + r * t * t;
            }
            koksma__sum_add(&pairs, product);
        }
    }
    sum[0] = pairs.total;
    sum[1] = pairs.lost;
}

void KERNEL_NAME(star_sweep)(size_t n, const double *x, const uint32_t *rank, const double *y, double *count,
                             double best[2], size_t at[2])
{
    for (size_t j = 0; j <= n; j++) {
        count[j] = 0; /* count[j] is the number of points so far whose rank is below j */
    }
    best[0] = best[1] = -INFINITY;
    at[0] = at[1] = 0;
    for (size_t i = 0; i <= n; i++) {
        const double scale = (double)n * (i < n ? x[i] : 1);
        for (size_t j = 0; j <= n; j++) {
            if (scale * y[j] - count[j] > best[1]) {
                best[1] = scale * y[j] - count[j];
                at[1] = i;
            }
        }
        for (size_t j = 0; j < n && i < n; j++) {
            count[j + 1] += rank[i] <= j;
        }
        for (size_t j = 0; j < n && i < n; j++) {
            if (count[j + 1] - scale * y[j] > best[0]) {
                best[0] = count[j + 1] - scale * y[j];
                at[0] = i;
            }
        }
    }
}

size_t KERNEL_NAME(far_corners)(size_t count, const int16_t *counts, const float *xs, float sign, float y,
                                float limit, uint32_t *out)
{
    size_t found = 0;
    for (size_t k = 0; k < count; k++) {
        if (sign * counts[k] - xs[k] * y > limit) {
            out[found++] = (uint32_t)k;
        }
    }
    return found;
}

void KERNEL_NAME(star_extremes)(size_t na, const double *a, size_t nb, const double *b, bool smallest, double *out)
{
    for (size_t c = 0; c < na + nb - 1; c++) {
        out[c] = smallest;
    }
    for (size_t i = 0; i < na; i++) {
        for (size_t j = 0; j < nb; j++) {
            const double product = a[i] * b[j];
            out[i + j] = smallest ? fmin(out[i + j], product) : fmax(out[i + j], product);
        }
    }
}

double KERNEL_NAME(star_pairs)(size_t na, const double *a, size_t nb, const double *b, bool smallest, double n,
                               double inside)
{
    double best = -1;
    for (size_t i = 0; i < na; i++) {
        for (size_t j = 0; j < nb; j++) {
            const double share = (inside + (double)(i + j)) / n;
            best = fmax(best, smallest ? share - a[i] * b[j] : a[i] * b[j] - share);
        }
    }
    return best;
}

void KERNEL_NAME(extreme_strips)(size_t count, const double *x, const double *y, const double sides[6][16],
                                 double excess[16], double deficit[16])
{
    for (int l = 0; l < 16; l++) {
        double inside = 0, low = HUGE_VAL, low_open = 0, inside_open = 0;
        excess[l] = deficit[l] = -1;
        for (size_t i = 0; i <= count; i++) {
            const double top = i < count ? y[i] : 1;
            deficit[l] = fmax(deficit[l], sides[5][l] * top - inside_open - low_open);
            if (i < count) {
                low = fmin(low, inside - sides[2][l] * top);
                inside += x[i] >= sides[0][l] && x[i] <= sides[1][l];
                excess[l] = fmax(excess[l], inside - sides[2][l] * top - low);
                inside_open += x[i] > sides[3][l] && x[i] < sides[4][l];
                low_open = fmin(low_open, sides[5][l] * top - inside_open);
            }
        }
    }
}

void KERNEL_NAME(extreme_runs)(size_t count, const double *x, const double *y, const double (*lines)[9],
                               const double sides[6][16], double excess[16], double deficit[16])
{
    for (int l = 0; l < 16; l++) {
        const double w = sides[2][l], wide = sides[5][l];
        double inside = 0, low = HUGE_VAL, low_open = 0, inside_open = 0;
        excess[l] = deficit[l] = -1;
        for (size_t i = 0; i < count; i++) {
            const double *run = lines[i];
            excess[l] = fmax(excess[l], fmax(run[4] + w * run[5], inside + (run[0] + w * run[1]) - low));
            low = fmin(low, inside - (run[2] + w * run[3]));
            inside += run[8];
            low = fmin(low, inside - w * y[i]);
            inside += x[i] >= sides[0][l] && x[i] <= sides[1][l];
            excess[l] = fmax(excess[l], inside - w * y[i] - low);

            deficit[l] =
                fmax(deficit[l], fmax(run[6] + wide * run[7], run[2] + wide * run[3] - inside_open - low_open));
            low_open = fmin(low_open, -(run[0] + wide * run[1]) - inside_open);
            inside_open += run[8];
            deficit[l] = fmax(deficit[l], wide * y[i] - inside_open - low_open);
            inside_open += x[i] > sides[3][l] && x[i] < sides[4][l];
            low_open = fmin(low_open, wide * y[i] - inside_open);
        }
    }
}

void KERNEL_NAME(pair_counts)(size_t count, const double *xs, const double *ys, double x, double y, double r2,
                              double scale, size_t bins, uint64_t *counts)
{
    for (size_t i = 0; i < count; i++) {
        const double a = fabs(x - xs[i]), b = fabs(y - ys[i]), dx = a < 1 - a ? a : 1 - a, dy = b < 1 - b ? b : 1 - b;
        const double d2 = dx * dx + dy * dy;
        if (d2 < r2) {
            const size_t bin = (size_t)(sqrt(d2) * scale);
            counts[bin < bins ? bin : bins - 1]++;
        }
    }
}

double KERNEL_NAME(distances)(size_t n, const double *x, const double *y, double x0, double y0)
{
    koksma__sum sum = {0};
    for (size_t i = 0; i < n; i++) {
        koksma__sum_add(&sum, sqrt((x[i] - x0) * (x[i] - x0) + (y[i] - y0) * (y[i] - y0)));
    }
    return koksma__sum_value(&sum);
}

void KERNEL_NAME(count_below)(size_t n, const double *x, const double *y, const double a[16], const double b[16],
                              const double c[16], double counts[16])
{
    for (int l = 0; l < 16; l++) {
        counts[l] = 0;
        for (size_t i = 0; i < n; i++) {
            counts[l] += a[l] * x[i] + b[l] * y[i] <= c[l];
        }
    }
}

void KERNEL_NAME(outer_sums)(size_t count, const double *a, const double *b, double sums[8][16])
{
    for (size_t r = 0; r < 8; r++) {
        for (size_t c = 0; c < 16; c++) {
            for (size_t j = 0; j < count; j++) {
                sums[r][c] += a[8 * j + r] * b[16 * j + c];
            }
        }
    }
}

bool KERNEL_NAME(fourier16)(size_t n, const double *twiddles, double *re, double *im, double *spare_re,
                            double *spare_im)
{
    for (size_t k = 0; k < n; k++) {
        for (size_t l = 0; l < 16; l++) {
            koksma__sum x = {0}, y = {0};
            for (size_t j = 0; j < n; j++) {
                const double c = twiddles[2 * (k * j % n)], s = -twiddles[2 * (k * j % n) + 1];
                koksma__sum_add(&x, c * re[16 * j + l] - s * im[16 * j + l]);
                koksma__sum_add(&y, c * im[16 * j + l] + s * re[16 * j + l]);
            }
            spare_re[16 * k + l] = koksma__sum_value(&x);
            spare_im[16 * k + l] = koksma__sum_value(&y);
        }
    }
    return true;
}

static double overlap(int law, double r, double distance)
{
    const double h = distance / 2;
    if (h >= r) {
        return 0;
    }
    const double s = sqrt((r - h) * (r + h)),
                 angle = koksma__atan2(s, h); /* factored, because r * r - h * h would lose digits near h = r */
    switch (law) {
    case 0:
        return 2 * r * r * angle - 2 * h * s;
    case 1:
        return (2 * r * r * r * angle - 4 * h * r * s + (h > 0 ? 2 * h * h * h * koksma__log((r + s) / h) : 0)) /
               (3 * r);
    default:
        return (r * r * r * r * angle - (5 * h * s * s * s) / 3 - h * h * h * s) / (r * r);
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
