/* SPDX-License-Identifier: Apache-2.0 */
/*
 * path: all light paths (Kajiya 1986), one way on from each vertex. Luminaires are sampled at each vertex and met by
 * chance, the two weighed by the power heuristic (Veach 1997, section 9.2); from the fifth vertex on a path whose
 * weight is below 1 goes on with that probability, which keeps the mean. Without bias but for the end of paths at
 * the depth limit, and for light that a mirror or glass throws on another surface from luminaires that rays don't
 * meet (points, directional ones, those that aren't `visible`): no path finds it.
 */
#include "render/integrators/integrators.h"

static const koksma__integrator_flags rules = {.followed =
                                                   KOKSMA__LOBE_SPECULAR | KOKSMA__LOBE_GLOSSY | KOKSMA__LOBE_DIFFUSE,
                                               .areas = true,
                                               .shadows = true,
                                               .roulette = true};

const koksma_integrator koksma__integrator_path = {
    .name = "path",
    .title = "path tracing with next-event estimation; caustics of visible lights only",
    .cite = "kajiya1986 veach1997",
    .depth = 16,
    .rules = &rules,
};
