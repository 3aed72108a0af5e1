/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Points whose density follows an image, and points on the surface of a model. Part of libkoksma-lab. Four patterns
 * support both functions below:
 *
 *     random                   independent points that follow the density or area: the baseline
 *     sample-elimination       weighted sample elimination of `factor` candidates a point (Yuksel 2015)
 *     progressive-elimination  the same, in an order whose prefixes are blue noise
 *     poisson-disk             dart throwing: no two points closer than d
 *
 * The candidates are independent random points with the wanted density. Where the density is p times its mean,
 * distances are divided by 1/sqrt(p); for a pair of points the smaller of the two values 1/sqrt(p) is used ("smaller
 * disks", Mitchell et al. 2012). Distances on a surface are measured straight through space, as in Yuksel's paper.
 * The points are the same for any number of threads.
 */
#ifndef KOKSMA_DENSITY_H
#define KOKSMA_DENSITY_H

#include <koksma/image.h>
#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Generates out->n points in the unit square whose density is in proportion to the luminance of an image. The image
   fills the square; its bottom row is at y = 0. Distances are measured on the torus, but for poisson-disk only with
   torus=1. The parameter d of poisson-disk is the smallest distance where the density equals its mean.
     spec  one of the four patterns, without modifiers
     map   an image with finite luminance that is nowhere negative and somewhere positive
     out   points initialised by koksma_points_init, in 2 dimensions
   Cost: O(factor n log n) if the density varies by a factor of less than about 100; more for wide ranges.
   Errors: UNSUPPORTED (not one of the four patterns), ARGUMENT, MALFORMED (the image), DIM, N, IMPOSSIBLE
   (poisson-disk found no room; the message has the number of points that fit), MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_generate_density(const koksma_spec *spec, uint64_t seed, const koksma_image *map,
                                                 const koksma_run *run, koksma_points *out);

/* Generates out->n points on the triangles of a model, uniform in area, in the coordinates of its file.
     spec  one of the four patterns; the d of poisson-disk is in the units of the model
     path  a model file: .obj, .ply, .off, .gltf or .glb
     out   points initialised by koksma_points_init, with dim 3 (x, y, z), 6 (also the unit normal of the triangle,
           whose corners are counterclockwise seen from outside) or 7 (also the number of the triangle, from 0)
   Errors: those of koksma_generate_density; also MISSING, MALFORMED (the model). */
KOKSMA_API koksma_status koksma_generate_on(const koksma_spec *spec, uint64_t seed, const char *path,
                                            const koksma_run *run, koksma_points *out);

#ifdef __cplusplus
}
#endif

#endif
