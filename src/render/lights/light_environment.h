/* SPDX-License-Identifier: Apache-2.0 */
/* The image of an environment as a density over directions. */
#ifndef KOKSMA_RENDER_LIGHTS_LIGHT_ENVIRONMENT_H
#define KOKSMA_RENDER_LIGHTS_LIGHT_ENVIRONMENT_H

#include "render/lights/lights.h"

typedef struct koksma__environment koksma__environment;

/* Tables of the light's image, if it has one; close also after a failure. Errors: MALFORMED (a pixel that is infinite
   or no number), MEMORY. */
koksma_status koksma__environment_open(const koksma__light *light, koksma__environment **out);
void koksma__environment_close(koksma__environment *environment);

/* A direction by importance; its density. */
float koksma__environment_sample(const koksma__environment *environment, const float u[2], float w[3]);
float koksma__environment_pdf(const koksma__environment *environment, const float w[3]);

/* Radiance along w from far away; the mean over all directions, as luminance. */
void koksma__environment_radiance(const koksma__environment *environment, const float w[3], float out[3]);
float koksma__environment_mean(const koksma__environment *environment);

#endif
