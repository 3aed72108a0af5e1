/* SPDX-License-Identifier: Apache-2.0 */
/* A homogeneous medium: the part of a ray inside it, and its phase function in the form of a material. medium.c has the
   formulas, batch_medium.c samples them. */
#ifndef KOKSMA_RENDER_MEDIUM_H
#define KOKSMA_RENDER_MEDIUM_H

#include "render/materials/materials.h"

/* Makes a medium from its coefficients and g; the box is infinite. */
void koksma__medium_init(koksma__medium *medium, const double absorption[3], const double scattering[3], double g);

/* Fails if a medium without bounds would let no light of the background or of distant lights through. Errors:
   MALFORMED. */
koksma_status koksma__medium_check(const koksma_scene *scene);

/* The part of a ray o + t d inside the medium: it begins at t = first and has the given length; `speed` is the length
   of d. */
typedef struct koksma__stretch {
    double first, length, speed;
} koksma__stretch;

koksma__stretch koksma__medium_stretch(const koksma__medium *medium, const float o[3], const float d[3], double end);

static inline double koksma__medium_extinction(const koksma__medium *m, int k)
{
    return m->absorption[k] + m->scattering[k];
}

/* Whether the medium takes equal parts of all channels. */
static inline bool koksma__medium_is_grey(const koksma__medium *m)
{
    const double first = koksma__medium_extinction(m, 0);
    return first == koksma__medium_extinction(m, 1) && first == koksma__medium_extinction(m, 2);
}

/* The phase function of Henyey & Greenstein as a material without a normal; parameter 0 is g. Scene files cannot name
   this material. */
extern const koksma__bsdf koksma__phase_function;

#endif
