/* SPDX-License-Identifier: Apache-2.0 */
/*
 * distribution: distribution ray tracing. Places on luminaires, on the lens, in time, and ways in glossy lobes are
 * sampled; light between diffuse surfaces is the scene's ambient.
 *
 *     L(x, out) = E(x, out) + albedo ambient + sum over luminaires of f E_l cos cos' V A / d^2 + weight L(y, way)
 *
 * with one place on each luminaire, of area A, at distance d, seen (V = 1) or not; and y where the mirrored,
 * refracted or glossy way goes on. Source: Cook, Porter & Carpenter 1984; Shirley 1991, chapter 5.
 */
#include "render/integrators/integrators.h"

static const koksma__integrator_flags rules = {
    .followed = KOKSMA__LOBE_SPECULAR | KOKSMA__LOBE_GLOSSY, .areas = true, .shadows = true, .ambient = true};

const koksma_integrator koksma__integrator_distribution = {
    .name = "distribution",
    .title = "soft shadows, lens, motion, glossy reflection",
    .cite = "cook1984 shirley1991",
    .depth = 6,
    .rules = &rules,
};
