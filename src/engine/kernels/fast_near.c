/* SPDX-License-Identifier: Apache-2.0 */
/* Distances to nearby points, for several positions at a time and without branches. They tell whether disks cover a
   square (maximal Poisson disks) and how far the nearest point is (pmj02bn), and count pairs by distance. */
#include <string.h>

#include "kernels/kernels.h"
#include "kernels/lanes64.h"

static inline bool any(lanes64_i mask)
{
    int64_t sum = 0;
    for (int l = 0; l < LANES64; l++) {
        sum |= mask[l];
    }
    return sum != 0;
}

/* Returns the squared distance from `from` to the far end of the interval (at - h, at + h). */
static inline lanes64_d reach(lanes64_d from, lanes64_d at, lanes64_d h)
{
    const lanes64_d t = lanes64_abs(from - at) + h;
    return t * t;
}

unsigned KERNEL_NAME(covers)(size_t count, const double *xs, const double *ys, double x, double y, double step,
                             double h, double d2)
{
    const lanes64_d x0 = lanes64_splat_d(x - step), x1 = lanes64_splat_d(x + step), y0 = lanes64_splat_d(y - step),
                    y1 = lanes64_splat_d(y + step);
    const lanes64_d half = lanes64_splat_d(h), limit = lanes64_splat_d(d2);
    lanes64_i found[4] = {{0}, {0}, {0}, {0}};
    for (size_t i = 0; i < count; i += LANES64) {
        const lanes64_d px = lanes64_load_d(xs + i), py = lanes64_load_d(ys + i);
        const lanes64_d a0 = reach(px, x0, half), a1 = reach(px, x1, half);
        const lanes64_d b0 = reach(py, y0, half), b1 = reach(py, y1, half);
        found[0] |= (lanes64_i)(a0 + b0 < limit);
        found[1] |= (lanes64_i)(a1 + b0 < limit);
        found[2] |= (lanes64_i)(a0 + b1 < limit);
        found[3] |= (lanes64_i)(a1 + b1 < limit);
    }
    return (unsigned)any(found[0]) | (unsigned)any(found[1]) << 1 | (unsigned)any(found[2]) << 2 |
           (unsigned)any(found[3]) << 3;
}

void KERNEL_NAME(nearest_offset)(size_t near, const double *dx, const double *dy, size_t count, const double *pairs,
                                 double scale, double *least)
{
    enum { CHAINS = 4, LANES = CHAINS * LANES64 };
    for (size_t first = 0; first < count; first += LANES) {
        const size_t some = count - first < LANES ? count - first : LANES;
        double own[2][LANES] = {{0}}, found[LANES];
        lanes64_d x[CHAINS], y[CHAINS], best[CHAINS];
        for (size_t i = 0; i < some; i++) {
            own[0][i] = scale * pairs[2 * (first + i)];
            own[1][i] = scale * pairs[2 * (first + i) + 1];
        }
        memcpy(x, own[0], sizeof x);
        memcpy(y, own[1], sizeof y);
        for (int c = 0; c < CHAINS; c++) {
            best[c] = lanes64_splat_d(1);
        }
        for (size_t j = 0; j < near; j++) {
            for (int c = 0; c < CHAINS; c++) {
                const lanes64_d a = lanes64_splat_d(dx[j]) - x[c], b = lanes64_splat_d(dy[j]) - y[c];
                best[c] = lanes64_min(a * a + b * b, best[c]);
            }
        }
        memcpy(found, best, sizeof found);
        memcpy(least + first, found, some * sizeof *found);
    }
}

/* Points that are too far away, and the padding of the last vector, are counted after the bins. Each lane has its own
   counter for them, because successive increments of one counter would wait for each other. */
void KERNEL_NAME(pair_counts)(size_t count, const double *xs, const double *ys, double x, double y, double r2,
                              double scale, size_t bins, uint64_t *counts)
{
    const lanes64_d last = lanes64_splat_d((double)(bins - 1)), none = (double)bins + lanes64_whole(lanes64_count());
    for (size_t i = 0; i < count; i += LANES64) {
        lanes64_d px = lanes64_splat_d(INFINITY), py = px;
        if (count - i >= LANES64) {
            px = lanes64_load_d(xs + i);
            py = lanes64_load_d(ys + i);
        } else {
            memcpy(&px, xs + i, (count - i) * sizeof *xs);
            memcpy(&py, ys + i, (count - i) * sizeof *ys);
        }
        const lanes64_d a = lanes64_abs(x - px), b = lanes64_abs(y - py);
        const lanes64_d dx = lanes64_min(a, 1 - a), dy = lanes64_min(b, 1 - b), d2 = dx * dx + dy * dy;
        const lanes64_d bin = lanes64_min(lanes64_floor(lanes64_sqrt(d2) * scale), last);
        const lanes64_d chosen = lanes64_chosen((lanes64_i)(d2 < r2), bin, none) + 0x1p52;
        uint64_t at[LANES64];
        memcpy(at, &chosen, sizeof at);
        for (int l = 0; l < LANES64; l++) {
            counts[at[l] & 0xfffffffffffffu]++;
        }
    }
}
