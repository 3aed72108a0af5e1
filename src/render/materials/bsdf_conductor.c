/* SPDX-License-Identifier: Apache-2.0 */
/*
 * conductor: a smooth metal, which reflects the light from the mirrored direction by Fresnel's equations for an index of
 * refraction eta + i k in each channel (conductor.h):
 *
 *     L(out) = tint F(n.out) L(2 (n.out) n - out)
 */
#include "render/materials/conductor.h"

static bool sample(const koksma__surface *s, unsigned lobes, const float u[2], float choice, koksma__scatter *out)
{
    (void)u, (void)choice;
    if (!(lobes & KOKSMA__LOBE_SPECULAR)) {
        return false;
    }
    koksma__mirror3(s->out, s->n, out->w);
    out->pdf = 0;
    out->lobe = KOKSMA__LOBE_SPECULAR;
    for (int k = 0; k < 3; k++) {
        out->weight[k] = koksma__conductor_colour(s->material, k, koksma__dot3(s->n, s->out));
    }
    return true;
}

static const koksma__parameter parameters[] = {KOKSMA__CONDUCTOR_PARAMETERS, {0}};

const koksma__bsdf koksma__bsdf_conductor = {
    .kind = {.name = "conductor",
             .title = "a smooth metal with Fresnel's reflectance for the index eta + i k",
             .cite = "whitted1980 born1999",
             .parameters = parameters},
    .lobes = KOKSMA__LOBE_SPECULAR,
    .value = koksma__specular_bsdf_value,
    .sample = sample,
};
