/* SPDX-License-Identifier: Apache-2.0 */
/*
 * checker: Lambert surfaces of two albedos, in squares of a flat shape's own coordinates or of a mesh's texture
 * coordinates (render/description.h has the formula). The caller selects the square's albedo before it evaluates the
 * material.
 */
#include "render/materials/lobes.h"

const koksma__bsdf koksma__bsdf_checker = {
    .kind = {.name = "checker", .title = "diffuse, in squares of two albedos", .cite = "pharr2016"},
    .lobes = KOKSMA__LOBE_DIFFUSE,
    .diffuse = KOKSMA__CHECKER,
    .is_lambert = true,
    .reciprocal = true,
    .form = KOKSMA__FORM_LAMBERT,
    .value = koksma__lambert_bsdf_value,
    .sample = koksma__lambert_bsdf_sample,
};
