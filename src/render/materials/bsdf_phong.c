/* SPDX-License-Identifier: Apache-2.0 */
/*
 * phong: the glossy mirror of Shirley (1991). It never reflects more than `reflectance`, and less where a part of the
 * lobe is under the surface.
 *
 *     f cos = reflectance (e + 1) / (2 pi) cos^e(angle to the mirrored way);   ways with the same density
 */
#include "render/materials/lobes.h"

static float value(const koksma__surface *s, const float w[3], unsigned lobes, float value_out[3])
{
    const float density = lobes & KOKSMA__LOBE_GLOSSY ? koksma__cosine_lobe_density(s, w) : 0;
    for (int k = 0; k < 3; k++) {
        value_out[k] += s->substance->reflectance[k] * density;
    }
    return density;
}

static bool sample(const koksma__surface *s, unsigned lobes, const float u[2], float choice, koksma__scatter *out)
{
    (void)choice;
    if (!(lobes & KOKSMA__LOBE_GLOSSY) || !koksma__cosine_lobe_way(s, u, out->w)) {
        return false;
    }
    out->density = koksma__cosine_lobe_density(s, out->w);
    out->lobe = KOKSMA__LOBE_GLOSSY;
    for (int k = 0; k < 3; k++) {
        out->weight[k] = s->substance->reflectance[k];
    }
    return out->density > 0;
}

const koksma__material_rules koksma__material_phong = {
    .cite = "shirley1991",
    .lobes = KOKSMA__LOBE_GLOSSY,
    .value = value,
    .sample = sample,
};
