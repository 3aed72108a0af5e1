/* SPDX-License-Identifier: Apache-2.0 */
/* Finds the boxes of largest discrepancy in 16 vertical strips at once, in one pass over the points in order of y. A
   point outside a strip does not change the count of the strip; its y only becomes another candidate for a side of a
   box. This does not change the largest value, because a side through a point of the strip is at least as good. */
#include <math.h>
#include <string.h>

#include "kernels/kernels.h"

enum { LANES = 16 };

void KERNEL_NAME(extreme_strips)(size_t count, const double *x, const double *y, const double sides[6][16],
                                 double excess[16], double deficit[16])
{
    double inside[LANES], low[LANES], best[LANES], inside_open[LANES], low_open[LANES], best_open[LANES];
    double lo[LANES], hi[LANES], width[LANES], lo_open[LANES], hi_open[LANES], width_open[LANES];
    for (int l = 0; l < LANES; l++) {
        inside[l] = inside_open[l] = low_open[l] = 0;
        low[l] = INFINITY;
        best[l] = best_open[l] = -1;
        lo[l] = sides[0][l];
        hi[l] = sides[1][l];
        width[l] = sides[2][l];
        lo_open[l] = sides[3][l];
        hi_open[l] = sides[4][l];
        width_open[l] = sides[5][l];
    }
    for (size_t i = 0; i < count; i++) {
        const double at = x[i], height = y[i];
        for (int l = 0; l < LANES; l++) {
            const double area = width[l] * height, start = inside[l] - area;
            low[l] = start < low[l] ? start : low[l];
            inside[l] += ((at >= lo[l]) & (at <= hi[l])) ? 1.0 : 0.0;
            const double value = inside[l] - area - low[l];
            best[l] = value > best[l] ? value : best[l];
        }
        for (int l = 0; l < LANES; l++) {
            const double area = width_open[l] * height, value = area - inside_open[l] - low_open[l];
            best_open[l] = value > best_open[l] ? value : best_open[l];
            inside_open[l] += ((at > lo_open[l]) & (at < hi_open[l])) ? 1.0 : 0.0;
            const double start = area - inside_open[l];
            low_open[l] = start < low_open[l] ? start : low_open[l];
        }
    }
    for (int l = 0; l < LANES; l++) {
        const double value = width_open[l] - inside_open[l] - low_open[l];
        best_open[l] = value > best_open[l] ? value : best_open[l];
    }
    memcpy(excess, best, sizeof best);
    memcpy(deficit, best_open, sizeof best_open);
}

void KERNEL_NAME(extreme_runs)(size_t count, const double *x, const double *y, const double (*lines)[9],
                               const double sides[6][16], double excess[16], double deficit[16])
{
    double inside[LANES], low[LANES], best[LANES], inside_open[LANES], low_open[LANES], best_open[LANES];
    double side[6][LANES];
    memcpy(side, sides, sizeof side);
    for (int l = 0; l < LANES; l++) {
        inside[l] = inside_open[l] = low_open[l] = 0;
        low[l] = INFINITY;
        best[l] = best_open[l] = -1;
    }
    for (size_t i = 0; i < count; i++) {
        const double at = x[i], height = y[i], *run = lines[i];
        for (int l = 0; l < LANES; l++) {
            const double w = side[2][l], area = w * height, within = run[4] + w * run[5];
            const double reach = inside[l] + (run[0] + w * run[1]) - low[l],
                         under = inside[l] - (run[2] + w * run[3]);
            const double core = inside[l] + run[8], start = core - area;
            const double higher = reach > within ? reach : within, lower = under < low[l] ? under : low[l];
            low[l] = start < lower ? start : lower;
            inside[l] = core + (((at >= side[0][l]) & (at <= side[1][l])) ? 1.0 : 0.0);
            const double value = inside[l] - area - low[l], most = higher > value ? higher : value;
            best[l] = most > best[l] ? most : best[l];
        }
        for (int l = 0; l < LANES; l++) {
            const double w = side[5][l], area = w * height, within = run[6] + w * run[7];
            const double reach = run[2] + w * run[3] - inside_open[l] - low_open[l];
            const double under = -(run[0] + w * run[1]) - inside_open[l], core = inside_open[l] + run[8];
            const double higher = reach > within ? reach : within, lower = under < low_open[l] ? under : low_open[l];
            const double value = area - core - lower, most = higher > value ? higher : value;
            best_open[l] = most > best_open[l] ? most : best_open[l];
            inside_open[l] = core + (((at > side[3][l]) & (at < side[4][l])) ? 1.0 : 0.0);
            const double start = area - inside_open[l];
            low_open[l] = start < lower ? start : lower;
        }
    }
    memcpy(excess, best, sizeof best);
    memcpy(deficit, best_open, sizeof best_open);
}
