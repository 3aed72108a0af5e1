/* SPDX-License-Identifier: Apache-2.0 */
/*
 * utah: the local model. A surface reflects the scene's ambient light and what comes from the centre of each
 * luminaire, without shadows and without seeing other surfaces; mirrors and glass are black.
 *
 *     L(x, out) = E(x, out) + albedo ambient + sum over luminaires of f(in, out) cos(in) irradiance from its centre
 *
 * An environment has no centre: rays see it, and no surface has light from it; that is what ambient light stands for.
 *
 * Source: Phong 1975; Shirley 1991. Nothing in it is random but the place in the pixel, on the lens and in time.
 */
#include "render/integrators/integrators.h"

static const koksma__integrator_flags rules = {.ambient = true};

const koksma_integrator koksma__integrator_utah = {
    .name = "utah",
    .title = "local light and ambient light, no shadows",
    .cite = "phong1975 shirley1991",
    .depth = 0,
    .rules = &rules,
};
