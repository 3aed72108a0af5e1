/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The discrete Fourier transform of one sequence.
 *
 * Lengths that are powers of two: radix 4 with decimation in frequency for the forward transform and in time for the
 * inverse, in place, O(n log n). The recursion is depth first, so that the parts of the sequence soon fit into a
 * cache, and every loop runs over adjacent numbers. A convolution multiplies two transforms entry by entry, so their
 * entries may be in any order that both share. This saves a permutation, or the second buffer that Stockham's
 * transform needs (kernels/fast_fourier.c, for 16 sequences at once).
 *
 * Any length, with the result in order: lengths up to 16 by the definition, longer ones by Bluestein's algorithm
 * (1970). Because jk = (j^2 + k^2 - (k - j)^2)/2, the transform is a product with the conjugate of the chirp exp(i pi
 * j^2 / length), a convolution with the chirp, and another product with the conjugate. The convolution can be padded
 * with zeros to a power of two. j^2 is taken modulo 2 length before it becomes an angle, so that long lengths lose no
 * digits.
 */
#include "core/dft.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/status.h"

enum { SHORT = 16 };

koksma_status koksma__fourier_init(koksma__fourier *f, size_t longest)
{
    const size_t count = longest < 4 ? 2 : longest / 2;
    f->cosines = malloc(2 * count * sizeof *f->cosines);
    KOKSMA__REQUIRE_MEMORY(f->cosines, 2 * count * sizeof *f->cosines);
    f->sines = f->cosines + count;
    const size_t last = count / 2;
    for (size_t p = 0; p < last; p++) {
        koksma__cos_sin(M_PI / 2 * (double)p / (double)last, &f->cosines[last + p], &f->sines[last + p]);
    }
    for (size_t q = last / 2; q; q /= 2) {
        for (size_t p = 0; p < q; p++) {
            f->cosines[q + p] = f->cosines[2 * q + 2 * p];
            f->sines[q + p] = f->sines[2 * q + 2 * p];
        }
    }
    return KOKSMA_OK;
}

void koksma__fourier_fini(koksma__fourier *f)
{
    free(f->cosines);
    *f = (koksma__fourier){0};
}

static void pair(double *x)
{
    const double sum = x[0] + x[1];
    x[1] = x[0] - x[1];
    x[0] = sum;
}

/* Does two steps of radix 2: the four quarters become the inputs of the transforms that give the frequencies 0, 2, 1
   and 3 modulo 4. */
static void split(const koksma__fourier *f, size_t quarter, double *re, double *im)
{
    const double *restrict cosines = f->cosines + quarter, *restrict sines = f->sines + quarter;
    double *restrict r0 = re, *restrict r1 = re + quarter, *restrict r2 = r1 + quarter, *restrict r3 = r2 + quarter;
    double *restrict i0 = im, *restrict i1 = im + quarter, *restrict i2 = i1 + quarter, *restrict i3 = i2 + quarter;
    for (size_t p = 0; p < quarter; p++) {
        const double c1 = cosines[p], s1 = sines[p];
        const double c2 = c1 * c1 - s1 * s1, s2 = 2 * c1 * s1, c3 = c1 * c2 - s1 * s2, s3 = c1 * s2 + s1 * c2;
        const double ar = r0[p] + r2[p], ai = i0[p] + i2[p], br = r1[p] + r3[p], bi = i1[p] + i3[p];
        const double cr = r0[p] - r2[p], ci = i0[p] - i2[p];
        const double dr = i1[p] - i3[p], di = r3[p] - r1[p]; /* -i (x1 - x3) */
        const double ur = ar - br, ui = ai - bi, vr = cr + dr, vi = ci + di, wr = cr - dr, wi = ci - di;
        r0[p] = ar + br;
        i0[p] = ai + bi;
        r1[p] = ur * c2 + ui * s2;
        i1[p] = ui * c2 - ur * s2;
        r2[p] = vr * c1 + vi * s1;
        i2[p] = vi * c1 - vr * s1;
        r3[p] = wr * c3 + wi * s3;
        i3[p] = wi * c3 - wr * s3;
    }
}

/* Applies the conjugate transpose of split(), which is 4 times its inverse. */
static void join(const koksma__fourier *f, size_t quarter, double *re, double *im)
{
    const double *restrict cosines = f->cosines + quarter, *restrict sines = f->sines + quarter;
    double *restrict r0 = re, *restrict r1 = re + quarter, *restrict r2 = r1 + quarter, *restrict r3 = r2 + quarter;
    double *restrict i0 = im, *restrict i1 = im + quarter, *restrict i2 = i1 + quarter, *restrict i3 = i2 + quarter;
    for (size_t p = 0; p < quarter; p++) {
        const double c1 = cosines[p], s1 = sines[p];
        const double c2 = c1 * c1 - s1 * s1, s2 = 2 * c1 * s1, c3 = c1 * c2 - s1 * s2, s3 = c1 * s2 + s1 * c2;
        const double ur = r1[p] * c2 - i1[p] * s2, ui = i1[p] * c2 + r1[p] * s2;
        const double vr = r2[p] * c1 - i2[p] * s1, vi = i2[p] * c1 + r2[p] * s1;
        const double wr = r3[p] * c3 - i3[p] * s3, wi = i3[p] * c3 + r3[p] * s3;
        const double ar = r0[p] + ur, ai = i0[p] + ui, br = r0[p] - ur, bi = i0[p] - ui;
        const double cr = vr + wr, ci = vi + wi;
        const double dr = wi - vi, di = vr - wr; /* i (v - w) */
        r0[p] = ar + cr;
        i0[p] = ai + ci;
        r1[p] = br + dr;
        i1[p] = bi + di;
        r2[p] = ar - cr;
        i2[p] = ai - ci;
        r3[p] = br - dr;
        i3[p] = bi - di;
    }
}

void koksma__fourier_forward(const koksma__fourier *f, size_t n, double *re, double *im)
{
    if (n == 2) {
        pair(re);
        pair(im);
    } else if (n > 2) {
        split(f, n / 4, re, im);
        for (size_t part = 0; part < n && n > 4; part += n / 4) {
            koksma__fourier_forward(f, n / 4, re + part, im + part);
        }
    }
}

void koksma__fourier_back(const koksma__fourier *f, size_t n, double *re, double *im)
{
    if (n == 2) {
        pair(re);
        pair(im);
    } else if (n > 2) {
        for (size_t part = 0; part < n && n > 4; part += n / 4) {
            koksma__fourier_back(f, n / 4, re + part, im + part);
        }
        join(f, n / 4, re, im);
    }
}

size_t koksma__dft_padded(size_t length)
{
    size_t padded = 1;
    while (length > SHORT && padded < 2 * length - 1) {
        padded *= 2;
    }
    return length > SHORT ? padded : 0;
}

koksma_status koksma__dft_init(koksma__dft *dft, const koksma__fourier *f, size_t length)
{
    const size_t padded = koksma__dft_padded(length), count = 2 * (length + padded);
    *dft = (koksma__dft){.length = length, .padded = padded};
    double *memory = calloc(count, sizeof *memory);
    KOKSMA__REQUIRE_MEMORY(memory, count * sizeof *memory);
    dft->re = memory;
    dft->im = memory + length;
    dft->filter_re = dft->im + length;
    dft->filter_im = dft->filter_re + padded;
    const size_t halves = padded ? 2 * length : length;
    for (size_t j = 0; j < length; j++) {
        const double angle = 2 * M_PI * (double)((padded ? j * j : j) % halves) / (double)halves;
        koksma__cos_sin(-angle, &dft->re[j], &dft->im[j]);
    }
    if (padded) {
        for (size_t j = 0; j < length; j++) {
            const size_t mirrored = (padded - j) % padded;
            dft->filter_re[j] = dft->filter_re[mirrored] = dft->re[j] / (double)padded;
            dft->filter_im[j] = dft->filter_im[mirrored] = -dft->im[j] / (double)padded;
        }
        koksma__fourier_forward(f, padded, dft->filter_re, dft->filter_im);
    }
    return KOKSMA_OK;
}

void koksma__dft_fini(koksma__dft *dft)
{
    free(dft->re);
    *dft = (koksma__dft){0};
}

static void define(const koksma__dft *c, size_t stride, double *re, double *im, double *scratch_re,
                   double *scratch_im)
{
    for (size_t k = 0; k < c->length; k++) {
        double x = 0, y = 0;
        for (size_t j = 0, turn = 0; j < c->length; j++) {
            x += re[j * stride] * c->re[turn] - im[j * stride] * c->im[turn];
            y += im[j * stride] * c->re[turn] + re[j * stride] * c->im[turn];
            turn += k;
            turn -= turn >= c->length ? c->length : 0;
        }
        scratch_re[k] = x;
        scratch_im[k] = y;
    }
    for (size_t k = 0; k < c->length; k++) {
        re[k * stride] = scratch_re[k];
        im[k * stride] = scratch_im[k];
    }
}

static void multiply(size_t n, const double *by_re, const double *by_im, double *re, double *im)
{
    for (size_t j = 0; j < n; j++) {
        const double x = re[j] * by_re[j] - im[j] * by_im[j];
        im[j] = im[j] * by_re[j] + re[j] * by_im[j];
        re[j] = x;
    }
}

void koksma__dft_transform(const koksma__dft *c, const koksma__fourier *f, size_t stride, double *re, double *im,
                           double *scratch_re, double *scratch_im)
{
    if (!c->padded) {
        define(c, stride, re, im, scratch_re, scratch_im);
        return;
    }
    for (size_t j = 0; j < c->length; j++) {
        scratch_re[j] = re[j * stride];
        scratch_im[j] = im[j * stride];
    }
    memset(scratch_re + c->length, 0, (c->padded - c->length) * sizeof *scratch_re);
    memset(scratch_im + c->length, 0, (c->padded - c->length) * sizeof *scratch_im);
    multiply(c->length, c->re, c->im, scratch_re, scratch_im);
    koksma__fourier_forward(f, c->padded, scratch_re, scratch_im);
    multiply(c->padded, c->filter_re, c->filter_im, scratch_re, scratch_im);
    koksma__fourier_back(f, c->padded, scratch_re, scratch_im);
    multiply(c->length, c->re, c->im, scratch_re, scratch_im);
    for (size_t j = 0; j < c->length; j++) {
        re[j * stride] = scratch_re[j];
        im[j * stride] = scratch_im[j];
    }
}
