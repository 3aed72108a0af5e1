/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The autocorrelation of a filter, A(d) = sum over x of f(x) f(x + d), and the error of a mask by its definition
 * (koksma/mask.h). The variance of the filtered indicators is the quadratic form of A, so the search needs A alone.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "masks/masks.h"

enum { PAIRS = 1 << 28 };

koksma_status koksma_mask_filter_check(koksma_mask_filter *f)
{
    KOKSMA__REQUIRE(f);
    KOKSMA__FAIL_IF(f->width < 1 || f->height < 1 || f->width > KOKSMA_MASK_MAX_SIDE ||
                        f->height > KOKSMA_MASK_MAX_SIDE,
                    KOKSMA_ARGUMENT, "mask: a filter of %d x %d pixels; filters have 1 to %d a side", f->width,
                    f->height, KOKSMA_MASK_MAX_SIDE);
    const size_t count = (size_t)f->width * (size_t)f->height;
    double sum = 0, size = 0;
    size_t used = 0;
    for (size_t i = 0; i < count; i++) {
        KOKSMA__FAIL_IF(!(fabs(f->weights[i]) <= 1e100), KOKSMA_ARGUMENT,
                        "mask: weight %zu of row %zu of the filter is not a finite number of at most 1e100",
                        i % (size_t)f->width, i / (size_t)f->width);
        sum += f->weights[i];
        size += fabs(f->weights[i]);
        used += f->weights[i] != 0;
    }
    KOKSMA__FAIL_IF(!(fabs(sum) > 1e-6 * size), KOKSMA_ARGUMENT,
                    "mask: the weights of the filter sum to 0; a filter keeps the mean of the image");
    KOKSMA__FAIL_IF(used < 2, KOKSMA_ARGUMENT,
                    "mask: the filter has a single weight: it leaves the image as it is, and all masks are equal");
    for (size_t i = 0; i < count; i++) {
        f->weights[i] /= sum;
    }
    return KOKSMA_OK;
}

/* Returns A at an offset of at most the filter's size. */
static double correlation(const koksma_mask_filter *f, int dx, int dy)
{
    double sum = 0;
    for (int y = dy < 0 ? -dy : 0; y < f->height && y + dy < f->height; y++) {
        for (int x = dx < 0 ? -dx : 0; x < f->width && x + dx < f->width; x++) {
            sum += f->weights[y * f->width + x] * f->weights[(y + dy) * f->width + x + dx];
        }
    }
    return sum;
}

/* Whether all weights of the outermost rows and columns at distance d along an axis are below the limit. */
static bool is_low(const koksma__mask_window *w, int axis, int d, double limit)
{
    const int other = 1 - axis;
    for (int side = -d; side <= d; side += 2 * d) {
        for (int t = -w->before[other]; t <= w->after[other] && side >= -w->before[axis] && side <= w->after[axis];
             t++) {
            const int x = axis ? t : side, y = axis ? side : t;
            const double weight = w->weights[(size_t)(y + w->before[1]) * w->columns + (size_t)(x + w->before[0])];
            if (fabs(weight) >= limit) {
                return false;
            }
        }
    }
    return true;
}

/* Cuts the rows and columns at the edge that have low weights. */
static void cut(koksma__mask_window *w, double least)
{
    const double limit = least * w->weights[(size_t)w->before[1] * w->columns + (size_t)w->before[0]];
    int reach[2];
    for (int axis = 0; axis < 2; axis++) {
        reach[axis] = w->before[axis] > w->after[axis] ? w->before[axis] : w->after[axis];
        while (reach[axis] > 1 && is_low(w, axis, reach[axis], limit)) {
            reach[axis]--;
        }
    }
    koksma__mask_window out = {.weights = w->weights};
    for (int axis = 0; axis < 2; axis++) {
        out.before[axis] = w->before[axis] < reach[axis] ? w->before[axis] : reach[axis];
        out.after[axis] = w->after[axis] < reach[axis] ? w->after[axis] : reach[axis];
    }
    out.columns = (size_t)(out.before[0] + out.after[0] + 1);
    out.rows = (size_t)(out.before[1] + out.after[1] + 1);
    for (size_t y = 0; y < out.rows; y++) {
        memmove(out.weights + y * out.columns,
                w->weights + (y + (size_t)(w->before[1] - out.before[1])) * w->columns +
                    (size_t)(w->before[0] - out.before[0]),
                out.columns * sizeof *out.weights);
    }
    *w = out;
}

/* Returns d modulo size as an offset from -before on. */
static int fold(int d, int size, int before)
{
    return ((d + before) % size + size) % size;
}

koksma_status koksma__mask_window_init(const koksma_mask_options *o, double least, koksma__mask_window *w)
{
    const int sizes[2] = {o->width, o->height}, sides[2] = {o->filter.width - 1, o->filter.height - 1};
    for (int axis = 0; axis < 2; axis++) {
        const int half = (sizes[axis] - 1) / 2, other = sizes[axis] / 2, most = sizes[axis] - 1;
        w->before[axis] = o->open              ? (sides[axis] < most ? sides[axis] : most)
                          : sides[axis] < half ? sides[axis]
                                               : half;
        w->after[axis] = o->open ? w->before[axis] : sides[axis] < other ? sides[axis] : other;
    }
    w->columns = (size_t)(w->before[0] + w->after[0] + 1);
    w->rows = (size_t)(w->before[1] + w->after[1] + 1);
    w->weights = calloc(w->columns * w->rows, sizeof *w->weights);
    KOKSMA__REQUIRE_MEMORY(w->weights, w->columns * w->rows * sizeof *w->weights);
    for (int dy = -sides[1]; dy <= sides[1]; dy++) {
        for (int dx = -sides[0]; dx <= sides[0]; dx++) {
            const int x = o->open ? dx + w->before[0] : fold(dx, sizes[0], w->before[0]);
            const int y = o->open ? dy + w->before[1] : fold(dy, sizes[1], w->before[1]);
            if (x >= 0 && y >= 0 && (size_t)x < w->columns && (size_t)y < w->rows) {
                w->weights[(size_t)y * w->columns + (size_t)x] += correlation(&o->filter, dx, dy);
            }
        }
    }
    cut(w, least);
    return KOKSMA_OK;
}

static double distance(const koksma__mask_values *v, size_t i, size_t j)
{
    const size_t dim = (size_t)v->dim;
    double square = 0;
    for (size_t k = 0; k < dim; k++) {
        const double d = (double)v->search[i * dim + k] - (double)v->search[j * dim + k];
        square += d * d;
    }
    return sqrt(square);
}

koksma_status koksma__mask_distances(const koksma__mask_values *v, const koksma_run *run, double *h)
{
    if (v->dim == 1) { /* sorted: sum of |v_i - v_j| = (2 i - n) v_i - (sum below i) + (sum from i on) */
        double below = 0, all = 0;
        for (size_t i = 0; i < v->n; i++) {
            all += (double)v->search[i];
        }
        for (size_t i = 0; i < v->n; i++) {
            const double x = (double)v->search[i];
            h[i] = ((2 * (double)i - (double)v->n) * x + all - 2 * below) / (double)v->n;
            below += x;
        }
        return KOKSMA_OK;
    }
    const size_t step = (v->n * v->n + PAIRS - 1) / PAIRS;
    for (size_t i = 0; i < v->n; i++) {
        double sum = 0;
        size_t count = 0;
        for (size_t j = step / 2; j < v->n; j += step) {
            sum += distance(v, i, j);
            count++;
        }
        h[i] = sum / (double)count;
        KOKSMA__TRY(i % 64 ? KOKSMA_OK : koksma__ask(run));
    }
    return KOKSMA_OK;
}

/* Adds the terms of one row of pixels: sum over p, q of A(p - q) (h_p + h_q - |v_p - v_q| - mean). */
static double row_energy(const koksma_mask_options *o, const koksma__mask_window *w, const koksma__mask_values *v,
                         const double *h, double mean, int y)
{
    double sum = 0;
    for (int x = 0; x < o->width; x++) {
        const size_t p = v->value[(size_t)y * (size_t)o->width + (size_t)x];
        for (int dy = -w->before[1]; dy <= w->after[1]; dy++) {
            const int b = o->open ? y + dy : (y + dy + o->height) % o->height;
            for (int dx = -w->before[0]; dx <= w->after[0] && b >= 0 && b < o->height; dx++) {
                const int a = o->open ? x + dx : (x + dx + o->width) % o->width;
                if (a >= 0 && a < o->width) {
                    const size_t q = v->value[(size_t)b * (size_t)o->width + (size_t)a];
                    const double weight =
                        w->weights[(size_t)(dy + w->before[1]) * w->columns + (size_t)(dx + w->before[0])];
                    sum += weight * (h[p] + h[q] - distance(v, p, q) - mean);
                }
            }
        }
    }
    return sum;
}

koksma_status koksma__mask_energy(const koksma_mask_options *o, const koksma__mask_values *v, const double *h,
                                  const koksma_run *run, double *error)
{
    koksma__mask_window w;
    double mean = 0, sum = 0;
    koksma_status status = koksma__mask_window_init(o, 0, &w);
    for (size_t i = 0; i < v->n; i++) {
        mean += h[i] / (double)v->n;
    }
    for (int y = 0; y < o->height && !status; y++) {
        sum += row_energy(o, &w, v, h, mean, y);
        status = koksma__ask(run);
    }
    *error = sqrt(fmax(sum / (2 * (double)v->n), 0));
    free(w.weights);
    return status;
}
