/* SPDX-License-Identifier: Apache-2.0 */
/* Sums of outer products in registers, and Stockham's fast Fourier transform of length 2^m (radix 4, with one step of
   radix 2 for odd m) of 16 interleaved sequences, so that every inner loop runs over lanes. */
#include "kernels/kernels.h"
#include "kernels/lanes64.h"

enum { LANES = 16, ROWS = 8 };

/* outer_sums works on GROUP rows at a time, which is the number that fits into the registers. Type `loose` is an
   unaligned vector. */
enum { VECTORS = LANES / LANES64, GROUP = LANES64 == 8 ? 8 : LANES64 / 2 };
typedef double loose __attribute__((vector_size(8 * LANES64), aligned(8), may_alias));

void KERNEL_NAME(outer_sums)(size_t count, const double *a, const double *b, double sums[8][16])
{
    for (size_t first = 0; first < ROWS; first += GROUP) {
        lanes64_d local[GROUP][VECTORS];
        for (int i = 0; i < GROUP * VECTORS; i++) {
            local[i / VECTORS][i % VECTORS] = ((const loose *)sums[first])[i];
        }
        for (size_t j = 0; j < count; j++) {
            const loose *row = (const loose *)(b + LANES * j);
            for (int v = 0; v < VECTORS; v++) {
                for (size_t r = 0; r < GROUP; r++) {
                    local[r][v] += a[ROWS * j + first + r] * row[v];
                }
            }
        }
        for (int i = 0; i < GROUP * VECTORS; i++) {
            ((loose *)sums[first])[i] = local[i / VECTORS][i % VECTORS];
        }
    }
}

typedef struct stage {
    size_t quarter, stride, step; /* quarter: length / 4 (radix 4) or length / 2 (radix 2); step: distance of
                                     the twiddle factors in their table */
    const double *twiddles;
    const double *re, *im;
    double *to_re, *to_im;
} stage;

static void radix4(const stage *s, size_t p)
{
    const double *w = s->twiddles;
    const double c1 = w[2 * p * s->step], s1 = -w[2 * p * s->step + 1];
    const double c2 = w[4 * p * s->step], s2 = -w[4 * p * s->step + 1];
    const double c3 = c1 * c2 - s1 * s2, s3 = c1 * s2 + s1 * c2;
    for (size_t q = 0; q < s->stride; q++) {
        const size_t from = LANES * (q + s->stride * p), jump = VECTORS * s->stride * s->quarter;
        const size_t to = LANES * (q + s->stride * 4 * p), hop = VECTORS * s->stride;
        const loose *re = (const loose *)(s->re + from), *im = (const loose *)(s->im + from);
        loose *to_re = (loose *)(s->to_re + to), *to_im = (loose *)(s->to_im + to);
        for (size_t v = 0; v < VECTORS; v++) {
            const lanes64_d ar = re[v], ai = im[v], br = re[jump + v], bi = im[jump + v];
            const lanes64_d cr = re[2 * jump + v], ci = im[2 * jump + v], dr = re[3 * jump + v],
                            di = im[3 * jump + v];
            const lanes64_d apc_r = ar + cr, apc_i = ai + ci, amc_r = ar - cr, amc_i = ai - ci;
            const lanes64_d bpd_r = br + dr, bpd_i = bi + di, jr = -(bi - di), ji = br - dr; /* i (b - d) */
            to_re[v] = apc_r + bpd_r;
            to_im[v] = apc_i + bpd_i;
            const lanes64_d x1 = amc_r - jr, y1 = amc_i - ji, x2 = apc_r - bpd_r, y2 = apc_i - bpd_i;
            const lanes64_d x3 = amc_r + jr, y3 = amc_i + ji;
            to_re[hop + v] = c1 * x1 - s1 * y1;
            to_im[hop + v] = c1 * y1 + s1 * x1;
            to_re[2 * hop + v] = c2 * x2 - s2 * y2;
            to_im[2 * hop + v] = c2 * y2 + s2 * x2;
            to_re[3 * hop + v] = c3 * x3 - s3 * y3;
            to_im[3 * hop + v] = c3 * y3 + s3 * x3;
        }
    }
}

static void radix2(const stage *s)
{
    for (size_t q = 0; q < LANES * s->stride; q++) {
        const size_t other = q + LANES * s->stride;
        s->to_re[q] = s->re[q] + s->re[other];
        s->to_im[q] = s->im[q] + s->im[other];
        s->to_re[other] = s->re[q] - s->re[other];
        s->to_im[other] = s->im[q] - s->im[other];
    }
}

bool KERNEL_NAME(fourier16)(size_t n, const double *twiddles, double *re, double *im, double *spare_re,
                            double *spare_im)
{
    bool in_spare = false;
    size_t length = n, stride = 1;
    while (length > 1) {
        const stage s = {length / 4,
                         stride,
                         n / length,
                         twiddles,
                         in_spare ? spare_re : re,
                         in_spare ? spare_im : im,
                         in_spare ? re : spare_re,
                         in_spare ? im : spare_im};
        if (length == 2) {
            radix2(&s);
            length = 1;
        } else {
            for (size_t p = 0; p < s.quarter; p++) {
                radix4(&s, p);
            }
            length /= 4;
            stride *= 4;
        }
        in_spare = !in_spare;
    }
    return in_spare;
}
