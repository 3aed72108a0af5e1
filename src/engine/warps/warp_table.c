/* SPDX-License-Identifier: Apache-2.0 */
/* The warps: maps of the unit square that preserve ratios of areas, or probabilities. Each has its formula and source above
   its map; the table at the end has them all. */
#include <koksma/warp.h>

#include <math.h>

#include "core/elementary.h"
#include "core/lookup.h"

/* ---- Maps of the square to the disk, and of the disk to the hemisphere --------------------------------------- */

/* cos and sin of |x| <= pi/4, the same bits as koksma__cos_sin's, which takes 1.3 times as long: below .78 its k is 0. */
static void cos_sin_of_eighth(double x, double *cosine, double *sine)
{
    if (fabs(x) < 0.78) {
        koksma__cos_sin_near(x, 0, cosine, sine);
    } else {
        koksma__cos_sin(x, cosine, sine);
    }
}

/* Maps squares about the centre to circles: a point (a, b) of [-1,1]^2 with |a| > |b| goes to radius a and angle
   (pi/4) b/a; one with |a| <= |b| goes to radius b and angle pi/2 - (pi/4) a/b. */
static void map_concentric(const double *u, double *x)
{
    const double a = 2 * u[0] - 1, b = 2 * u[1] - 1;
    if (a == 0 && b == 0) {
        x[0] = x[1] = 0;
    } else if (fabs(a) > fabs(b)) {
        cos_sin_of_eighth(M_PI / 4 * (b / a), &x[0], &x[1]);
        x[0] *= a;
        x[1] *= a;
    } else {
        cos_sin_of_eighth(M_PI / 4 * (a / b), &x[1], &x[0]);
        x[0] *= b;
        x[1] *= b;
    }
}

/* Maps (u, v) of the square to radius sqrt(u) and angle 2 pi v. */
static void map_polar(const double *u, double *x)
{
    const double r = sqrt(u[0]);
    koksma__cos_sin(2 * M_PI * u[1], &x[0], &x[1]);
    x[0] *= r;
    x[1] *= r;
}

/* Maps a point of the disk to the hemisphere at height z = 1 - r^2, uniform in solid angle (the inverse of Lambert's
   equal-area projection). */
static void lift_uniform(double *x)
{
    const double square = fmin(x[0] * x[0] + x[1] * x[1], 1), scale = sqrt(2 - square);
    x[0] *= scale;
    x[1] *= scale;
    x[2] = 1 - square;
}

/* Projects a point of the disk vertically onto the hemisphere: the density is proportional to z (Malley's method). */
static void lift_cosine(double *x)
{
    x[2] = sqrt(fmax(1 - x[0] * x[0] - x[1] * x[1], 0));
}

/* ---- Warps --------------------------------------------------------------------------------------------------- */

/*
 * concentric-disk: maps squares about the centre of the unit square to circles about the centre of the unit disk. The
 * map is continuous and preserves ratios of areas. With (a,b) = 2u - 1: if |a| > |b|, radius a and angle (pi/4)(b/a);
 * else radius b and angle pi/2 - (pi/4)(a/b). Source: Shirley & Chiu 1997. Known exactly: the centre of the square is
 * mapped to the centre of the disk, and its corners to the points of the circle on the diagonals.
 */
static const koksma_warp concentric_disk = {
    .name = "concentric-disk",
    .revision = 1,
    .title = "low-distortion map of concentric squares to concentric circles",
    .cite = "shirley1997",
    .domain = KOKSMA_DOMAIN_DISK,
    .dim = 2,
    .map = map_concentric,
};

/*
 * polar-disk: radius sqrt(u_0), angle 2 pi u_1. The map preserves ratios of areas but not distances: two sides of the
 * square meet along one radius of the disk, and a third side shrinks to the centre. Source: Shirley 1991, section
 * 5.5, which prefers another map to the disk.
 */
static const koksma_warp polar_disk = {
    .name = "polar-disk",
    .revision = 1,
    .title = "(u, v) to radius sqrt(u) and angle 2 pi v",
    .cite = "shirley1991",
    .domain = KOKSMA_DOMAIN_DISK,
    .dim = 2,
    .map = map_polar,
};

/*
 * triangle: maps (u_0, u_1) to (1 - sqrt u_0, u_1 sqrt u_0). Lines of constant u_0 become lines parallel to a side of
 * the triangle, and ratios of areas are preserved. The side u_0 = 0 of the square shrinks to a corner of the
 * triangle.
 * Source: Turk 1990.
 */
static void map_triangle(const double *u, double *x)
{
    const double root = sqrt(u[0]);
    x[0] = 1 - root;
    x[1] = u[1] * root;
}

static const koksma_warp triangle = {
    .name = "triangle",
    .title = "(u, v) to (1 - sqrt u, v sqrt u) in the triangle (0,0) (1,0) (0,1)",
    .cite = "turk1990",
    .domain = KOKSMA_DOMAIN_TRIANGLE,
    .dim = 2,
    .map = map_triangle,
};

/*
 * hemisphere: the polar map to the disk, followed by a lift that maps radius r to radius r sqrt(2 - r^2) at height z
 * = 1 - r^2. The height is thus 1 - u_0, the angle 2 pi u_1, and the directions are uniform in solid angle. Source:
 * Shirley 1991; the map from the disk to the hemisphere is the inverse of Lambert's equal-area projection.
 */
static void map_hemisphere(const double *u, double *x)
{
    map_polar(u, x);
    lift_uniform(x);
}

static const koksma_warp hemisphere = {
    .name = "hemisphere",
    .revision = 1,
    .title = "(u, v) to height 1 - u and angle 2 pi v; uniform directions",
    .cite = "shirley1991",
    .domain = KOKSMA_DOMAIN_HEMISPHERE,
    .dim = 3,
    .map = map_hemisphere,
};

/*
 * concentric-hemisphere: the concentric map to the disk, followed by a lift that maps radius r to radius r sqrt(2 -
 * r^2) at height z = 1 - r^2. The directions are uniform in solid angle. Source: Shirley & Chiu 1997.
 */
static void map_concentric_hemisphere(const double *u, double *x)
{
    map_concentric(u, x);
    lift_uniform(x);
}

static const koksma_warp concentric_hemisphere = {
    .name = "concentric-hemisphere",
    .revision = 1,
    .title = "concentric map to the disk, lifted to uniform directions",
    .cite = "shirley1997",
    .domain = KOKSMA_DOMAIN_HEMISPHERE,
    .dim = 3,
    .map = map_concentric_hemisphere,
};

/*
 * cosine-hemisphere: the concentric map to the disk, then a vertical projection up to z = sqrt(1 - r^2): the
 * directions have the density z/pi. Source: Shirley & Chiu 1997; the projection onto the hemisphere is known as
 * Malley's method.
 */
static void map_cosine_hemisphere(const double *u, double *x)
{
    map_concentric(u, x);
    lift_cosine(x);
}

static const koksma_warp cosine_hemisphere = {
    .name = "cosine-hemisphere",
    .revision = 1,
    .title = "concentric map to the disk, projected up: density proportional to the cosine",
    .cite = "shirley1997",
    .domain = KOKSMA_DOMAIN_HEMISPHERE_COSINE,
    .dim = 3,
    .map = map_cosine_hemisphere,
};

/*
 * triangle-heitz: moves the corner (1,1) of the square to the middle of the diagonal from (1,0) to (0,1). The map
 * preserves ratios of areas, and no side of the square shrinks to a point. (u, v) is mapped to (u/2, v - u/2) if v >=
 * u, else to (u - v/2, v/2). Source: Heitz 2019.
 */
static void map_triangle_heitz(const double *u, double *x)
{
    const double a = u[0], b = u[1]; /* copied because x may be the same array as u */
    x[0] = b > a ? a / 2 : a - b / 2;
    x[1] = b > a ? b - a / 2 : b / 2;
}

static const koksma_warp triangle_heitz = {
    .name = "triangle-heitz",
    .title = "low-distortion map to a triangle",
    .cite = "heitz2019",
    .domain = KOKSMA_DOMAIN_TRIANGLE,
    .dim = 2,
    .map = map_triangle_heitz,
};

/*
 * sphere: height 1 - 2 u_0, angle 2 pi u_1; the directions are uniform in solid angle (the inverse of Lambert's
 * cylindrical equal-area projection). The sides u_0 = 0 and u_0 = 1 of the square shrink to the poles. Source: Brauchart
 * & Dick 2012, who lift (0,m,2)-nets to the sphere by this map.
 */
static void map_sphere(const double *u, double *x)
{
    const double height = u[0], radius = 2 * sqrt(height * (1 - height)); /* copied because x may be the same array */
    koksma__cos_sin(2 * M_PI * u[1], &x[0], &x[1]);
    x[0] *= radius;
    x[1] *= radius;
    x[2] = 1 - 2 * height;
}

static const koksma_warp sphere = {
    .name = "sphere",
    .title = "(u, v) to height 1 - 2u and angle 2 pi v on the whole sphere; uniform directions",
    .cite = "brauchart2012",
    .domain = KOKSMA_DOMAIN_SPHERE,
    .dim = 3,
    .map = map_sphere,
};

/*
 * ggx-visible-normals: normals of the microfacets that a viewer sees, as a renderer samples rough metal. Warps have no
 * parameters, so the surface is one example: slopes of the GGX law with alpha = 1/2 (a `roughness` of sqrt(1/2) in scene
 * files), seen from v = (sqrt(3)/2, 0, 1/2), 60 degrees from the surface's normal. The density at h is
 *     D(h) G1(v) max(v.h, 0) / v.z
 *
 * Stretching by alpha makes the surface a hemisphere, of which v sees a half-disk and a half-ellipse: the polar map to the
 * disk across v, with the half y < 0 compressed to the ellipse, lifted to the hemisphere, and stretched back. Source:
 * Heitz 2018, listing 1; the renderer's materials sample by the same map.
 */

static void map_ggx_visible_normals(const double *u, double *x)
{
    const double alpha = 0.5, length = sqrt(7), vx = sqrt(3) / length,
                 vz = 2 / length; /* (alpha v.x, 0, v.z), normalised */
    double disk[2];
    map_polar(u, disk);
    const double seen = (1 + vz) / 2, across = disk[0], half = sqrt(fmax(1 - across * across, 0));
    const double along = (1 - seen) * half + seen * disk[1];
    const double towards = sqrt(fmax(1 - across * across - along * along, 0));
    const double h[3] = {alpha * (towards * vx - along * vz), alpha * across, fmax(along * vx + towards * vz, 0)};
    const double norm = sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
    for (int k = 0; k < 3; k++) {
        x[k] = h[k] / norm;
    }
}

static const koksma_warp ggx_visible_normals = {
    .name = "ggx-visible-normals",
    .title = "GGX microfacet normals of alpha 1/2 that are visible at 60 degrees",
    .cite = "heitz2018",
    .domain = KOKSMA_DOMAIN_GGX_VISIBLE,
    .dim = 3,
    .map = map_ggx_visible_normals,
};

static const koksma_warp *const warps[] = {
    &concentric_disk,   &polar_disk,     &triangle, &hemisphere,          &concentric_hemisphere,
    &cosine_hemisphere, &triangle_heitz, &sphere,   &ggx_visible_normals,
};

KOKSMA__LOOKUP(koksma_warp, warps)
