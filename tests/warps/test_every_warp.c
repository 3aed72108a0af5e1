/* SPDX-License-Identifier: Apache-2.0 */
/* Walks the table of warps: images lie in the domain, the Jacobian is the domain's measure over its density
   everywhere, and equal parts of the domain, by coordinates of their own, get equal shares of a fine grid: a map that
   covers half of the domain twice has the right Jacobian. */
#include <string.h>

#include <koksma/warp.h>

#include "sets.h"

enum { SIDE = 512, CELLS = 8, SAMPLES = 2000 };

static void fail_domain(const koksma_warp *w)
{
    fail_msg("%s: its domain %d has no test here", w->name, (int)w->domain);
}

/* The direction from which ggx-visible-normals looks, and its alpha; sqrt(1 - z^2) = sqrt(3/4). */
static const double view[3] = {0.86602540378443864676, 0, 0.5}, alpha = 0.5;

static double dot(const double *x, const double *y)
{
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/* The density of visible normals D G1 (v.h) / v.z: D by Walter et al. 2007 (33), Smith's G1 by (34). */
static double visible_density(const double *h)
{
    const double tangent = (1 - h[2] * h[2]) / (h[2] * h[2]), part = alpha * alpha + tangent;
    const double d = alpha * alpha / (M_PI * pow(h[2], 4) * part * part);
    const double g1 = 2 / (1 + sqrt(1 + alpha * alpha * (1 - view[2] * view[2]) / (view[2] * view[2])));
    return d * g1 * fmax(dot(view, h), 0) / view[2];
}

/* Dupuy & Benyoub 2023: if the surface is stretched to a hemisphere, the view's mirror images at visible normals are
   uniform on a spherical cap. Returns the image's share of the cap's height, and its angle in turns. */
static void mirror_view(const double *h, double *height, double *turns)
{
    double v[3], m[3], image[3];
    for (int k = 0; k < 3; k++) {
        v[k] = k < 2 ? alpha * view[k] : view[k];
        m[k] = k < 2 ? h[k] / alpha : h[k];
    }
    const double v_norm = sqrt(dot(v, v)), twice = 2 * dot(v, m) / dot(m, m);
    for (int k = 0; k < 3; k++) {
        image[k] = (twice * m[k] - v[k]) / v_norm;
    }
    *height = (image[2] + v[2] / v_norm) / (1 + v[2] / v_norm);
    *turns = atan2(image[1], image[0]) / (2 * M_PI);
    *turns += *turns < 0 ? 1 : 0;
}

static bool is_inside(const koksma_warp *w, const double *x)
{
    const double e = 1e-12;
    switch (w->domain) {
    case KOKSMA_DOMAIN_DISK:
        return x[0] * x[0] + x[1] * x[1] <= 1 + e;
    case KOKSMA_DOMAIN_TRIANGLE:
        return x[0] >= -e && x[1] >= -e && x[0] + x[1] <= 1 + e;
    case KOKSMA_DOMAIN_HEMISPHERE:
    case KOKSMA_DOMAIN_HEMISPHERE_COSINE:
        return fabs(x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - 1) <= e && x[2] >= 0;
    case KOKSMA_DOMAIN_GGX_VISIBLE:
        return fabs(dot(x, x) - 1) <= e && x[2] >= 0 && dot(view, x) >= -e;
    case KOKSMA_DOMAIN_SPHERE:
        return fabs(x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - 1) <= e;
    }
    fail_domain(w);
    return false;
}

/* The area that a unit of the square becomes, at x: 1 over the density. */
static double area_at(const koksma_warp *w, const double *x)
{
    switch (w->domain) {
    case KOKSMA_DOMAIN_DISK:
        return M_PI;
    case KOKSMA_DOMAIN_TRIANGLE:
        return 0.5;
    case KOKSMA_DOMAIN_HEMISPHERE:
        return 2 * M_PI;
    case KOKSMA_DOMAIN_HEMISPHERE_COSINE:
        return M_PI / x[2];
    case KOKSMA_DOMAIN_SPHERE:
        return 4 * M_PI;
    case KOKSMA_DOMAIN_GGX_VISIBLE:
        return 1 / visible_density(x);
    }
    fail_domain(w);
    return 0;
}

/* Coordinates in [0,1]^2 in which the domain's measure is uniform: cylinders, or lines through a corner. */
static void straighten(const koksma_warp *w, const double *x, double *a, double *b)
{
    const double angle = atan2(x[1], x[0]) / (2 * M_PI), sum = x[0] + x[1];
    *b = angle < 0 ? angle + 1 : angle;
    switch (w->domain) {
    case KOKSMA_DOMAIN_DISK:
    case KOKSMA_DOMAIN_HEMISPHERE_COSINE:
        *a = x[0] * x[0] + x[1] * x[1];
        return;
    case KOKSMA_DOMAIN_TRIANGLE:
        *a = sum * sum;
        *b = sum > 0 ? x[1] / sum : 0;
        return;
    case KOKSMA_DOMAIN_HEMISPHERE:
        *a = x[2];
        return;
    case KOKSMA_DOMAIN_SPHERE:
        *a = (1 + x[2]) / 2; /* Archimedes: the area between two heights is proportional to their distance */
        return;
    case KOKSMA_DOMAIN_GGX_VISIBLE:
        mirror_view(x, a, b);
        return;
    }
    fail_domain(w);
}

TEST_CASE(the_jacobian_is_the_area)
{
    const double h = 1e-6;
    const koksma_warp *w;
    for (size_t i = 0; (w = koksma_warp_at(i)); i++) {
        for (uint64_t s = 0; s < SAMPLES; s++) {
            const double u[2] = {0.001 + 0.998 * sets_unit(40, s), 0.001 + 0.998 * sets_unit(41, s)};
            double x[3] = {0}, sides[2][2][3] = {{{0}}}, d[2][3];
            w->map(u, x);
            assert_that(is_inside(w, x), "%s: (%g, %g) goes to (%g, %g, %g)", w->name, u[0], u[1], x[0], x[1], x[2]);
            for (int k = 0; k < 2; k++) {
                for (int side = 0; side < 2; side++) {
                    double moved[2] = {u[0], u[1]};
                    moved[k] += side ? h : -h;
                    w->map(moved, sides[k][side]);
                }
                for (int c = 0; c < 3; c++) {
                    d[k][c] = (sides[k][1][c] - sides[k][0][c]) / (2 * h);
                }
            }
            const double nx = d[0][1] * d[1][2] - d[0][2] * d[1][1], ny = d[0][2] * d[1][0] - d[0][0] * d[1][2];
            const double nz = d[0][0] * d[1][1] - d[0][1] * d[1][0], area = sqrt(nx * nx + ny * ny + nz * nz);
            assert_that(fabs(area / area_at(w, x) - 1) < 1e-4, "%s: at (%g, %g) the square's unit becomes %g, not %g",
                        w->name, u[0], u[1], area, area_at(w, x));
        }
    }
}

TEST_CASE(equal_parts_get_equal_shares)
{
    const koksma_warp *w;
    for (size_t i = 0; (w = koksma_warp_at(i)); i++) {
        double counts[CELLS][CELLS] = {{0}};
        for (int k = 0; k < SIDE * SIDE; k++) {
            double x[3] = {0}, a = 0, b = 0;
            w->map((double[2]){(k % SIDE + 0.5) / SIDE, (k / SIDE + 0.5) / SIDE}, x);
            straighten(w, x, &a, &b);
            counts[(int)fmin(a * CELLS, CELLS - 1)][(int)fmin(b * CELLS, CELLS - 1)] += 1;
        }
        for (int c = 0; c < CELLS * CELLS; c++) {
            const double share = counts[c / CELLS][c % CELLS] * CELLS * CELLS / SIDE / SIDE;
            assert_that(fabs(share - 1) < 0.05, "%s: a part of the domain gets %.3f times its share", w->name, share);
        }
    }
}
