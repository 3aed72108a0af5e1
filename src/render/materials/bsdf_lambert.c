/* SPDX-License-Identifier: Apache-2.0 */
/*
 * lambert: reflects a share `albedo` of what comes, as bright from every side.
 *
 *     f = albedo / pi;   directions with density cos / pi, so that each weighs albedo
 */
#include "render/materials/lobes.h"

float koksma__lambert_bsdf_value(const koksma__surface *s, const float w[3], unsigned lobes, float value_out[3])
{
    return lobes & KOKSMA__LOBE_DIFFUSE ? koksma__lambert_value(s, w, value_out) : 0;
}

bool koksma__lambert_bsdf_sample(const koksma__surface *s, unsigned lobes, const float u[2], float choice,
                                 koksma__scatter *out)
{
    (void)choice;
    if (!(lobes & KOKSMA__LOBE_DIFFUSE)) {
        return false;
    }
    koksma__cosine_direction(s->n, u, out->w);
    out->pdf = koksma__dot3(s->n, out->w) / KOKSMA__PI_F;
    out->lobe = KOKSMA__LOBE_DIFFUSE;
    for (int k = 0; k < 3; k++) {
        out->weight[k] = s->albedo[k];
    }
    return out->pdf > 0;
}

const koksma__bsdf koksma__bsdf_lambert = {
    .kind = {.name = "lambert", .title = "diffuse, as bright from every side", .cite = "pharr2016"},
    .lobes = KOKSMA__LOBE_DIFFUSE,
    .diffuse = KOKSMA__ALBEDO | KOKSMA__IMAGE,
    .is_lambert = true,
    .reciprocal = true,
    .value = koksma__lambert_bsdf_value,
    .sample = koksma__lambert_bsdf_sample,
};
