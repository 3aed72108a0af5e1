/* SPDX-License-Identifier: Apache-2.0 */
/*
 * lambert: reflects a share `albedo` of what comes, as bright from every side.
 *
 *     f = albedo / pi;   ways with density cos / pi, so that each weighs albedo
 */
#include "render/materials/lobes.h"

static float value(const koksma__surface *s, const float w[3], unsigned lobes, float value_out[3])
{
    return lobes & KOKSMA__LOBE_DIFFUSE ? koksma__lambert_value(s, w, value_out) : 0;
}

static bool sample(const koksma__surface *s, unsigned lobes, const float u[2], float choice, koksma__scatter *out)
{
    (void)choice;
    if (!(lobes & KOKSMA__LOBE_DIFFUSE)) {
        return false;
    }
    koksma__cosine_way(s->n, u, out->w);
    out->density = koksma__dot3(s->n, out->w) / KOKSMA__PI_F;
    out->lobe = KOKSMA__LOBE_DIFFUSE;
    for (int k = 0; k < 3; k++) {
        out->weight[k] = s->albedo[k];
    }
    return out->density > 0;
}

const koksma__material_rules koksma__material_lambert = {
    .cite = "pharr2016",
    .lobes = KOKSMA__LOBE_DIFFUSE,
    .value = value,
    .sample = sample,
};
