/* SPDX-License-Identifier: Apache-2.0 */
/* The two questions of maximal Poisson disk sampling, for a row of the grid at a time without branches. */
#include <string.h>

#include "kernels/kernels.h"
#include "kernels/lanes64.h"

typedef int64_t lanes64_i __attribute__((vector_size(8 * LANES64)));

void KERNEL_NAME(nearest_offset)(size_t near, const double *dx, const double *dy, size_t count, const double *pairs,
                                 double scale, double *least);
bool KERNEL_NAME(near)(const double *gx, const double *gy, size_t stride, double x, double y, double d2);
bool KERNEL_NAME(covers)(const double *gx, const double *gy, size_t stride, double x, double y, double h, double d2);

static inline lanes64_d splat(double x)
{
    return x - (lanes64_d){0};
}

static inline lanes64_d load(const double *from)
{
    lanes64_d v;
    memcpy(&v, from, sizeof v);
    return v;
}

static inline bool any(lanes64_i mask)
{
    int64_t sum = 0;
    for (int l = 0; l < LANES64; l++) {
        sum |= mask[l];
    }
    return sum != 0;
}

bool KERNEL_NAME(near)(const double *gx, const double *gy, size_t stride, double x, double y, double d2)
{
    const lanes64_d at_x = splat(x), at_y = splat(y), limit = splat(d2);
    lanes64_i found = {0};
    for (int r = 0; r < 5; r++, gx += stride, gy += stride) {
        for (int c = 0; c < 8; c += LANES64) {
            const lanes64_d a = load(gx + c) - at_x, b = load(gy + c) - at_y;
            found |= (lanes64_i)(a * a + b * b < limit);
        }
    }
    return any(found);
}

static inline lanes64_d size_of(lanes64_d a)
{
    return (lanes64_d)((lanes64_u)a & (0x7fffffffffffffffu - (lanes64_u){0}));
}

bool KERNEL_NAME(covers)(const double *gx, const double *gy, size_t stride, double x, double y, double h, double d2)
{
    const lanes64_d at_x = splat(x), at_y = splat(y), half = splat(h), limit = splat(d2);
    lanes64_i found = {0};
    for (int r = 0; r < 5; r++, gx += stride, gy += stride) {
        for (int c = 0; c < 8; c += LANES64) {
            const lanes64_d a = size_of(load(gx + c) - at_x) + half, b = size_of(load(gy + c) - at_y) + half;
            found |= (lanes64_i)(a * a + b * b < limit);
        }
    }
    return any(found);
}

void KERNEL_NAME(nearest_offset)(size_t near, const double *dx, const double *dy, size_t count, const double *pairs,
                                 double scale, double *least)
{
    enum { LANES = 16 };
    for (size_t first = 0; first < count; first += LANES) {
        const size_t some = count - first < LANES ? count - first : LANES;
        double x[LANES] = {0}, y[LANES] = {0}, best[LANES];
        for (size_t l = 0; l < LANES; l++) {
            best[l] = 1;
        }
        for (size_t l = 0; l < some; l++) {
            x[l] = scale * pairs[2 * (first + l)];
            y[l] = scale * pairs[2 * (first + l) + 1];
        }
        for (size_t j = 0; j < near; j++) {
            for (size_t l = 0; l < LANES; l++) {
                const double a = dx[j] - x[l], b = dy[j] - y[l], square = a * a + b * b;
                best[l] = square < best[l] ? square : best[l];
            }
        }
        memcpy(least + first, best, some * sizeof *best);
    }
}
