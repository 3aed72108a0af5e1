/* SPDX-License-Identifier: Apache-2.0 */
/*
 * mirror: reflects the fraction `reflectance` of the light from the mirrored direction (Whitted 1980).
 *
 *     L(out) = reflectance L(2 (n.out) n - out)
 */
#include "render/materials/lobes.h"

enum { REFLECTANCE };

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
        out->weight[k] = s->material->values[REFLECTANCE + k];
    }
    return true;
}

static const koksma__parameter parameters[] = {
    {"reflectance", KOKSMA__COLOUR, .high = 1, .at = KOKSMA__VALUE(REFLECTANCE)}, {0}};

const koksma__bsdf koksma__bsdf_mirror = {
    .kind = {.name = "mirror", .title = "a smooth mirror", .cite = "whitted1980", .parameters = parameters},
    .lobes = KOKSMA__LOBE_SPECULAR,
    .value = koksma__specular_bsdf_value,
    .sample = sample,
};
