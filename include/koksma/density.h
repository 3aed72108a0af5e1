/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Points whose density follows an image, and points on the surface of a model. Part of libkoksma-lab. Six patterns
 * support both functions below:
 *
 *     random                   independent points that follow the density or area: the baseline
 *     sample-elimination       weighted sample elimination of `factor` candidates a point (Yuksel 2015)
 *     progressive-elimination  the same, in an order whose prefixes are blue noise
 *     poisson-disk             dart throwing: no two points closer than d
 *     poisson-disk-maximal     dart throwing until nothing fits, at the d that gives n points or at the given one
 *     gaussian-blue-noise      points that repel each other and are drawn to the density (Ahmed, Ren & Wonka 2022)
 *
 * The first four choose among independent candidates of the wanted density. Where the density is p times its mean,
 * distances are divided by sqrt(p); of the two points of a pair the smaller 1/sqrt(p) counts ("smaller disks", Mitchell
 * et al. 2012). gaussian-blue-noise has the cleanest low frequencies: its smoothed points come as close as they can to
 * the smoothed density. On a surface distances are those of space, as in Yuksel's paper, not those along the surface.
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
   fills the square; its bottom row is at y = 0. Distances are measured on the torus (by poisson-disk only with
   torus=1); the d of poisson-disk and poisson-disk-maximal is the smallest distance where the density is its mean.
     spec  one of the patterns above, without modifiers
     map   luminance: finite, nowhere negative, somewhere positive
     out   points initialised by koksma_points_init, in 2 dimensions
   Cost: O(factor n log n) if the density varies by a factor of less than about 100; more for wide ranges. A second of
   one processor makes about 5,000 points by poisson-disk-maximal and 300 by gaussian-blue-noise.
   Errors: UNSUPPORTED (a pattern without this form), ARGUMENT, MALFORMED (the image), DIM, N, IMPOSSIBLE (poisson-disk
   found no space for n points, or poisson-disk-maximal no distance that gives n points; the message has a number that
   would do), MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_generate_density(const koksma_spec *spec, uint64_t seed, const koksma_image *map,
                                                 const koksma_run *run, koksma_points *out);

/* Generates out->n points on the triangles of a model, uniform in area, in the coordinates of its file.
     spec  as above; d is in the model's units
     path  a model: .obj, .ply, .ply.gz, .off, .gltf, .glb or .serialized
     out   points initialised by koksma_points_init, in 3 dimensions: x y z; or in 6: also the triangle's unit normal,
           counterclockwise corners seen from outside; or in 7: also the number of the triangle, from 0
   Errors: as above; MISSING, MALFORMED (the model). */
KOKSMA_API koksma_status koksma_generate_on(const koksma_spec *spec, uint64_t seed, const char *path,
                                            const koksma_run *run, koksma_points *out);

#ifdef __cplusplus
}
#endif

#endif
