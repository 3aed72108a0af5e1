/* SPDX-License-Identifier: Apache-2.0 */
/* The steps of the wavefront tracer in a scene with a medium; without one, detach and attenuate do nothing. */
#ifndef KOKSMA_RENDER_PIPELINES_WAVEFRONT_MEDIUM_H
#define KOKSMA_RENDER_PIPELINES_WAVEFRONT_MEDIUM_H

#include "render/pipelines/vertices.h"

/* Samples the medium along the rays of the paths, whose hits are known; the first number of each sample's pair
   selects the distance. Multiplies the weights of the paths, and replaces hits by points of the medium: their
   material is that of the medium, their normal is 0, and their primitive is 0 until koksma__wavefront_detach. */
void koksma__wavefront_travel(const koksma_scene *scene, const float *pairs, koksma__paths *paths,
                              koksma__vertices *v);

/* Sets the primitive of points in the medium to -1, because rays from there do not start on a primitive. */
void koksma__wavefront_detach(const koksma_scene *scene, koksma__vertices *v);

/* Multiplies light by the transmittance of the medium along the shadow rays. */
void koksma__wavefront_attenuate(const koksma_scene *scene, const koksma__vertices *v, const koksma__shadows *shadows,
                                 koksma__lanes light[3]);

#endif
