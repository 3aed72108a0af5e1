/* SPDX-License-Identifier: Apache-2.0 */
/* The images of other renderers' environments. */
#ifndef KOKSMA_SCENE_IMPORT_SKY_H
#define KOKSMA_SCENE_IMPORT_SKY_H

#include <koksma/image.h>

/* Resamples an environment to a latitude-longitude image with Koksma's axes. octahedral: `from` is one of pbrt, in the
   equal-area octahedral map; otherwise one of Mitsuba, in latitude and longitude. inverse: the inverse of the
   environment's matrix. Errors: MALFORMED (its shape), MEMORY. */
koksma_status koksma__sky_turn(const koksma_image *from, bool octahedral, const double inverse[12],
                               koksma_image *out);

#endif
