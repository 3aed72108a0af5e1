/* SPDX-License-Identifier: Apache-2.0 */
/*
 * whitted: recursive ray tracing. A shadow ray to the centre of each luminaire; mirrors and glass send rays on, glass
 * both ways, so that rays make a tree. A branch that weighs less than 1/1000 is cut (Hall's depth control), which
 * leaves out that much of each. Many may be cut: a glass slab in a white furnace, which reflects 2 R / (1 + R) in
 * all, loses .08 % of that at 0.5 degrees, .25 % at 56 and .52 % at 89 (depth 40); path cuts none.
 *
 *     L(x, out) = local light, as utah has it, with V   +   R L(y, mirrored)   +   (1 - R) L(z, refracted)
 *
 * with V = 1 where the centre of the luminaire is seen and R a mirror's reflectance or Fresnel's share. An
 * environment has no centre: as in utah, rays see it and no surface has light from it. Source: Whitted 1980.
 */
#include "render/integrators/integrators.h"

static const koksma__integrator_flags rules = {
    .followed = KOKSMA__LOBE_SPECULAR, .shadows = true, .ambient = true, .branches = true};

const koksma_integrator koksma__integrator_whitted = {
    .name = "whitted",
    .title = "sharp shadows, mirrors and glass",
    .cite = "whitted1980",
    .depth = 6,
    .rules = &rules,
};
