/* SPDX-License-Identifier: Apache-2.0 */
/*
 * lambert: reflects the fraction `albedo` of the incident light, with equal radiance in all directions.
 *
 *     f = albedo / pi;   directions with density cos / pi, so that the weight of each is albedo
 */
#include "render/materials/lobes.h"

const koksma__bsdf koksma__bsdf_lambert = {
    .kind = {.name = "lambert", .title = "diffuse: equally bright from every side", .cite = "pharr2016"},
    .lobes = KOKSMA__LOBE_DIFFUSE,
    .diffuse = KOKSMA__ALBEDO | KOKSMA__IMAGE,
    .is_lambert = true,
    .reciprocal = true,
    .form = KOKSMA__FORM_LAMBERT,
    .value = koksma__lambert_bsdf_value,
    .sample = koksma__lambert_bsdf_sample,
};
