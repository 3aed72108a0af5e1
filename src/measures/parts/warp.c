/* SPDX-License-Identifier: Apache-2.0 */
/* The maps themselves. Sources: the concentric map Shirley and Chiu 1997; the others are folklore (Shirley 1991). */
#include <math.h>
#include <string.h>

#include <koksma/warp.h>

static void concentric_disk(const double in[2], double *out)
{
    const double a = 2 * in[0] - 1, b = 2 * in[1] - 1;
    if (a == 0 && b == 0) {
        out[0] = out[1] = 0;
        return;
    }
    const bool wide = fabs(a) > fabs(b);
    const double r = wide ? a : b, angle = wide ? M_PI_4 * (b / a) : M_PI_2 - M_PI_4 * (a / b);
    out[0] = r * cos(angle);
    out[1] = r * sin(angle);
}

static void polar_disk(const double in[2], double *out)
{
    out[0] = sqrt(in[0]) * cos(2 * M_PI * in[1]);
    out[1] = sqrt(in[0]) * sin(2 * M_PI * in[1]);
}

static void triangle(const double in[2], double *out)
{
    const double s = sqrt(in[0]);
    out[0] = 1 - s;
    out[1] = in[1] * s;
}

static void hemisphere(const double in[2], double *out)
{
    const double r = sqrt(in[0] * (2 - in[0]));
    out[0] = r * cos(2 * M_PI * in[1]);
    out[1] = r * sin(2 * M_PI * in[1]);
    out[2] = 1 - in[0];
}

static void concentric_hemisphere(const double in[2], double *out)
{
    double p[2];
    concentric_disk(in, p);
    const double r2 = p[0] * p[0] + p[1] * p[1], stretch = sqrt(fmax(2 - r2, 0));
    out[0] = p[0] * stretch;
    out[1] = p[1] * stretch;
    out[2] = 1 - r2;
}

static const koksma_warp warps[] = {
    {"concentric-disk", "squares about the centre become circles", "shirley1997", 2, concentric_disk},
    {"polar-disk", "r = sqrt u, angle 2 pi v", "shirley1991", 2, polar_disk},
    {"triangle", "(1 - sqrt u, v sqrt u) in the triangle (0,0) (1,0) (0,1)", "shirley1991", 2, triangle},
    {"hemisphere", "height 1 - u, angle 2 pi v; uniform directions", "shirley1991", 3, hemisphere},
    {"concentric-hemisphere", "the concentric disk, lifted; uniform directions", "shirley1997", 3,
     concentric_hemisphere},
};

const koksma_warp *koksma_warp_at(size_t i)
{
    return i < sizeof warps / sizeof *warps ? &warps[i] : NULL;
}

const koksma_warp *koksma_warp_find(const char *name)
{
    for (size_t i = 0; i < sizeof warps / sizeof *warps; i++) {
        if (!strcmp(warps[i].name, name)) {
            return &warps[i];
        }
    }
    return NULL;
}
