/* SPDX-License-Identifier: Apache-2.0 */
/*
 * By the definition up to a length of 16, by Bluestein 1970 above: as jk = (j^2 + k^2 - (k - j)^2)/2, a transform is
 * a convolution with exp(i pi j^2 / length) between two products with its conjugate, and a convolution can be as long
 * as a power of two, with zeros behind.
 */
#include "patterns/shared/chirps.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"

enum { SHORT = 16 };

size_t koksma__chirps_padded(size_t length)
{
    size_t padded = 1;
    while (length > SHORT && padded < 2 * length - 1) {
        padded *= 2;
    }
    return length > SHORT ? padded : 0;
}

koksma_status koksma__chirps_init(koksma__chirps *chirps, const koksma__fourier *f, size_t length)
{
    const size_t padded = koksma__chirps_padded(length), count = 2 * (length + padded);
    *chirps = (koksma__chirps){.length = length, .padded = padded};
    double *memory = calloc(count, sizeof *memory);
    if (!memory) {
        return koksma__fail_memory(count * sizeof *memory);
    }
    chirps->re = memory;
    chirps->im = memory + length;
    chirps->filter_re = chirps->im + length;
    chirps->filter_im = chirps->filter_re + padded;
    const size_t halves = padded ? 2 * length : length;
    for (size_t j = 0; j < length; j++) {
        const double angle = 2 * M_PI * (double)((padded ? j * j : j) % halves) / (double)halves;
        chirps->re[j] = cos(angle);
        chirps->im[j] = -sin(angle);
    }
    if (padded) {
        for (size_t j = 0; j < length; j++) {
            const size_t mirrored = (padded - j) % padded;
            chirps->filter_re[j] = chirps->filter_re[mirrored] = chirps->re[j] / (double)padded;
            chirps->filter_im[j] = chirps->filter_im[mirrored] = -chirps->im[j] / (double)padded;
        }
        koksma__fourier_forward(f, padded, chirps->filter_re, chirps->filter_im);
    }
    return KOKSMA_OK;
}

void koksma__chirps_fini(koksma__chirps *chirps)
{
    free(chirps->re);
    *chirps = (koksma__chirps){0};
}

static void define(const koksma__chirps *c, size_t stride, double *re, double *im, double *room_re, double *room_im)
{
    for (size_t k = 0; k < c->length; k++) {
        double x = 0, y = 0;
        for (size_t j = 0, turn = 0; j < c->length; j++) {
            x += re[j * stride] * c->re[turn] - im[j * stride] * c->im[turn];
            y += im[j * stride] * c->re[turn] + re[j * stride] * c->im[turn];
            turn += k;
            turn -= turn >= c->length ? c->length : 0;
        }
        room_re[k] = x;
        room_im[k] = y;
    }
    for (size_t k = 0; k < c->length; k++) {
        re[k * stride] = room_re[k];
        im[k * stride] = room_im[k];
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

void koksma__chirps_transform(const koksma__chirps *c, const koksma__fourier *f, size_t stride, double *re,
                              double *im, double *room_re, double *room_im)
{
    if (!c->padded) {
        define(c, stride, re, im, room_re, room_im);
        return;
    }
    for (size_t j = 0; j < c->length; j++) {
        room_re[j] = re[j * stride];
        room_im[j] = im[j * stride];
    }
    memset(room_re + c->length, 0, (c->padded - c->length) * sizeof *room_re);
    memset(room_im + c->length, 0, (c->padded - c->length) * sizeof *room_im);
    multiply(c->length, c->re, c->im, room_re, room_im);
    koksma__fourier_forward(f, c->padded, room_re, room_im);
    multiply(c->padded, c->filter_re, c->filter_im, room_re, room_im);
    koksma__fourier_back(f, c->padded, room_re, room_im);
    multiply(c->length, c->re, c->im, room_re, room_im);
    for (size_t j = 0; j < c->length; j++) {
        re[j * stride] = room_re[j];
        im[j * stride] = room_im[j];
    }
}
