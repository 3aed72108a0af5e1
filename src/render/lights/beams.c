/* SPDX-License-Identifier: Apache-2.0 */
/* What several kinds of lights share: emitters that are sampled by area, and lights that are treated as points. */
#include "render/lights/beams.h"

#include "render/scene_images.h"

void koksma__emitter_open(koksma__shading_light *light, double area, float reach)
{
    light->area = (float)area;
    light->reach = reach;
    light->power = koksma__luminance3(light->radiance) * light->area / KOKSMA__PI_F;
}

float koksma__area_pdf(const koksma__shading_light *light, const float p[3], const float w[3], float t,
                       const float n[3])
{
    (void)p;
    const float cosine = -koksma__dot3(n, w);
    return cosine > 0 ? t * t / (cosine * light->area) : 0;
}

bool koksma__point_beam(const koksma__shading_light *light, const float p[3], float strength, koksma__beam *out)
{
    for (int k = 0; k < 3; k++) {
        out->d[k] = light->centre[k] - p[k];
    }
    const float square = koksma__dot3(out->d, out->d), length = sqrtf(square);
    if (!(length > 0)) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        out->w[k] = out->d[k] / length;
    }
    out->pdf = 0;
    koksma__set_value(light, strength / square, out);
    return true;
}

void koksma__mesh_glow(const koksma__mesh_light *m, size_t t, float a, float b, float rgb[3])
{
    const float *uvs = m->mesh->uvs, w[3] = {1 - a - b, a, b};
    const uint32_t *index = m->mesh->indices + 3 * t;
    float at[2] = {0, 0};
    for (int c = 0; c < 3; c++) {
        at[0] += w[c] * uvs[2 * (size_t)index[c]];
        at[1] += w[c] * uvs[2 * (size_t)index[c] + 1];
    }
    koksma__texture(m->map->image, &m->map->mapping, at[0], at[1], KOKSMA__BRIGHTEST, rgb);
}
