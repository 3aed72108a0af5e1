/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Points in a rectangle, points whose density follows an image, and points on the surface of a model. Part of
 * libkoksma-lab. These patterns support the functions below:
 *
 *     random                   independent points that follow the density or area: the baseline
 *     sample-elimination       weighted sample elimination of `factor` candidates a point (Yuksel 2015)
 *     progressive-elimination  sample elimination, in an order whose prefixes are blue noise
 *
 * They choose from independent random points of the wanted density. Where the density is p times
 * its mean, the wanted distance between points is divided by sqrt(p); for a pair of points the smaller of their two
 * values of 1/sqrt(p) counts ("smaller disks", Mitchell et al. 2012).
 * On a surface distances are straight-line distances in space, as in Yuksel's paper, not distances along
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
   pixels that are square, and wrap around its edges. The coordinates are
   fractions of the picture: x in [0,1) of its width from the left, y in [0,1) of its height from the bottom.
     spec  one of the patterns above, without modifiers
     map   an image whose luminance is finite, nowhere negative and somewhere positive
     out   points initialised by koksma_points_init, in 2 dimensions
   Cost: O(factor n log n) if the density varies by a factor of less than about 100; more for wide ranges.
   Errors: UNSUPPORTED (a pattern not listed above), ARGUMENT, MALFORMED (the image), DIM, N, MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_generate_density(const koksma_spec *spec, uint64_t seed, const koksma_image *map,
                                                 const koksma_run *run, koksma_points *out);

/* Generates points in the rectangle [0,width) x [0,height), in its coordinates. Distances wrap around
   the edges.
     width, height  above 0; one is at most 10,000 times the other
     map            NULL: uniform points; or an image that fills the rectangle and gives the density
     spec, out      as for koksma_generate_density
   Errors: those of koksma_generate_density. */
KOKSMA_API koksma_status koksma_generate_rectangle(const koksma_spec *spec, uint64_t seed, double width,
                                                   double height, const koksma_image *map, const koksma_run *run,
                                                   koksma_points *out);

/* Generates points on the triangles of a model, uniform in area, in the coordinates of its file.
     spec  one of the patterns above, without modifiers
     path  a model: .obj, .ply, .ply.gz, .off, .gltf, .glb or .serialized
     out   points initialised by koksma_points_init, in 3 dimensions: x y z; or in 6: also the triangle's unit normal,
           on the side from which its corners are in counterclockwise order; or in 7: also the number of the triangle,
           from 0
   Errors: those of koksma_generate_density, but MISSING and MALFORMED concern the model. */
KOKSMA_API koksma_status koksma_generate_on(const koksma_spec *spec, uint64_t seed, const char *path,
                                            const koksma_run *run, koksma_points *out);

#ifdef __cplusplus
}
#endif

#endif
