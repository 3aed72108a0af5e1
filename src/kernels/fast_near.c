/* SPDX-License-Identifier: Apache-2.0 */
/* The two questions of maximal Poisson disk sampling, for a row of the grid at a time without branches. The extra
   three columns hold points too; they are never nearer by mistake. */
#include "kernels/kernels.h"

bool KERNEL_NAME(near)(const double *gx, const double *gy, size_t stride, double x, double y, double d2);
bool KERNEL_NAME(covers)(const double *gx, const double *gy, size_t stride, double x, double y, double h, double d2);

bool KERNEL_NAME(near)(const double *gx, const double *gy, size_t stride, double x, double y, double d2)
{
    double least[8];
    for (int c = 0; c < 8; c++) {
        least[c] = d2;
    }
    for (int r = 0; r < 5; r++, gx += stride, gy += stride) {
        for (int c = 0; c < 8; c++) {
            const double a = gx[c] - x, b = gy[c] - y, square = a * a + b * b;
            least[c] = square < least[c] ? square : least[c];
        }
    }
    bool found = false;
    for (int c = 0; c < 8; c++) {
        found |= least[c] < d2;
    }
    return found;
}

static inline double size_of(double a)
{
    return a < 0 ? -a : a;
}

bool KERNEL_NAME(covers)(const double *gx, const double *gy, size_t stride, double x, double y, double h, double d2)
{
    double least[8];
    for (int c = 0; c < 8; c++) {
        least[c] = d2;
    }
    for (int r = 0; r < 5; r++, gx += stride, gy += stride) {
        for (int c = 0; c < 8; c++) {
            const double a = size_of(gx[c] - x) + h, b = size_of(gy[c] - y) + h, square = a * a + b * b;
            least[c] = square < least[c] ? square : least[c];
        }
    }
    bool found = false;
    for (int c = 0; c < 8; c++) {
        found |= least[c] < d2;
    }
    return found;
}
