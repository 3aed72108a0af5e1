/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Points in a rectangle, points whose density follows an image, and points on the surface of a model. Part of
 * libkoksma-lab. These patterns support the functions below:
 *
 *     random                   independent points that follow the density or area: the baseline
 *     sample-elimination       weighted sample elimination of `factor` candidates a point (Yuksel 2015)
 *     progressive-elimination  sample elimination, in an order whose prefixes are blue noise
 *     poisson-disk             dart throwing: no two points closer than d
 *     poisson-disk-maximal     dart throwing until nothing fits, with the given d or the d that gives n points
 *     dart-throwing            dart throwing: n points, no two closer than f times the distance in the densest packing
 *     best-candidate           each point is the candidate furthest from all points before it (Mitchell 1991)
 *     gaussian-blue-noise      points that repel each other and are drawn to the density (Ahmed, Ren & Wonka 2022)
 *
 * All patterns but the last choose from independent random points of the wanted density. Where the density is p times
 * its mean, the wanted distance between points is divided by sqrt(p); for a pair of points the smaller of their two
 * values of 1/sqrt(p) counts ("smaller disks", Mitchell et al. 2012). gaussian-blue-noise has the least error at low
 * frequencies, because it moves the points until their sum of Gaussians approximates the density smoothed by a
 * Gaussian. On a surface distances are straight-line distances in space, as in Yuksel's paper, not distances along
 * the surface. The points are the same for any number of threads.
 */
#ifndef KOKSMA_DENSITY_H
#define KOKSMA_DENSITY_H

#include <koksma/image.h>
#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Generates points whose density is in proportion to the luminance of an image. Distances are those of the picture, with
   pixels that are square, and wrap around its edges (those of poisson-disk only with torus=1). The coordinates are
   fractions of the picture: x in [0,1) of its width from the left, y in [0,1) of its height from the bottom. The d of
   poisson-disk and poisson-disk-maximal is the smallest distance where the density equals its mean, in units of the
   picture's height.
     spec  one of the patterns above, without modifiers
     map   an image whose luminance is finite, nowhere negative and somewhere positive
     out   points initialised by koksma_points_init, in 2 dimensions. Or n = 0 and xs = NULL with dim = 2, for
           poisson-disk-maximal with d: then d decides how many points there are, and koksma_points_fini frees them
   Cost: O(factor n log n) if the density varies by a factor of less than about 100; more for wide ranges. In a second
   one processor makes about 5,000 points by poisson-disk-maximal or 300 by gaussian-blue-noise.
   Errors: UNSUPPORTED (a pattern not listed above), ARGUMENT, MALFORMED (the image), DIM, N, IMPOSSIBLE (poisson-disk
   found no room for n points, or poisson-disk-maximal found no d that gives n points; the message says what would
   work), MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_generate_density(const koksma_spec *spec, uint64_t seed, const koksma_image *map,
                                                 const koksma_run *run, koksma_points *out);

/* Generates points in the rectangle [0,width) x [0,height), in its coordinates. Distances and d are in the same units, and
   distances wrap around the edges (those of poisson-disk only with torus=1).
     width, height  above 0; one is at most 10,000 times the other
     map            NULL: uniform points; or an image that fills the rectangle and gives the density
     spec, out      as for koksma_generate_density
   Errors: those of koksma_generate_density. */
KOKSMA_API koksma_status koksma_generate_rectangle(const koksma_spec *spec, uint64_t seed, double width,
                                                   double height, const koksma_image *map, const koksma_run *run,
                                                   koksma_points *out);

/* Generates points on the triangles of a model, uniform in area, in the coordinates of its file.
     spec  one of the patterns above except gaussian-blue-noise, without modifiers; d is in the model's units
     path  a model: .obj, .ply, .ply.gz, .off, .gltf, .glb or .serialized
     out   points initialised by koksma_points_init, in 3 dimensions: x y z; or in 6: also the triangle's unit normal,
           on the side from which its corners are in counterclockwise order; or in 7: also the number of the triangle,
           from 0. Or n = 0 and xs = NULL, as for koksma_generate_density
   Errors: those of koksma_generate_density, but MISSING and MALFORMED concern the model. */
KOKSMA_API koksma_status koksma_generate_on(const koksma_spec *spec, uint64_t seed, const char *path,
                                            const koksma_run *run, koksma_points *out);

#ifdef __cplusplus
}
#endif

#endif
