/* SPDX-License-Identifier: Apache-2.0 */
/*
 * utah: the local model of Phong (1975) as the sum of a Lambert part and a cosine lobe, which together reflect no
 * more than albedo + reflectance <= 1. Ways are chosen from either lobe in proportion to its luminance, and weigh
 * material over the density of the mixture.
 *
 *     f cos = albedo cos / pi + reflectance (e + 1) / (2 pi) cos^e(angle to the mirrored way)
 */
#include "render/materials/lobes.h"

static float share(const koksma__surface *s, unsigned lobes)
{
    const bool diffuse = lobes & KOKSMA__LOBE_DIFFUSE, glossy = lobes & KOKSMA__LOBE_GLOSSY;
    return diffuse && glossy ? s->substance->diffuse_share : diffuse ? 1 : 0;
}

static float value(const koksma__surface *s, const float w[3], unsigned lobes, float value_out[3])
{
    const float diffuse = lobes & KOKSMA__LOBE_DIFFUSE ? koksma__lambert_value(s, w, value_out) : 0;
    const float glossy = lobes & KOKSMA__LOBE_GLOSSY ? koksma__cosine_lobe_density(s, w) : 0;
    for (int k = 0; k < 3; k++) {
        value_out[k] += s->substance->reflectance[k] * glossy;
    }
    const float part = share(s, lobes);
    return part * diffuse + (1 - part) * glossy;
}

static bool sample(const koksma__surface *s, unsigned lobes, const float u[2], float choice, koksma__scatter *out)
{
    lobes &= KOKSMA__LOBE_DIFFUSE | KOKSMA__LOBE_GLOSSY;
    float all[3] = {0, 0, 0};
    if (!lobes) {
        return false;
    }
    if (choice < share(s, lobes)) {
        koksma__cosine_way(s->n, u, out->w);
        out->lobe = KOKSMA__LOBE_DIFFUSE;
    } else {
        out->lobe = KOKSMA__LOBE_GLOSSY;
        if (!koksma__cosine_lobe_way(s, u, out->w)) {
            return false;
        }
    }
    out->density = value(s, out->w, lobes, all);
    for (int k = 0; k < 3; k++) {
        out->weight[k] = out->density > 0 ? all[k] / out->density : 0;
    }
    return out->density > 0;
}

const koksma__material_rules koksma__material_utah = {
    .cite = "phong1975",
    .lobes = KOKSMA__LOBE_DIFFUSE | KOKSMA__LOBE_GLOSSY,
    .value = value,
    .sample = sample,
};
