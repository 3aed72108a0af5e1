/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Samples direct light for a block of vertices: a position on each light, or on one chosen light, and a shadow ray to
 * it. With KOKSMA_LIGHTS_ONE a light is chosen with a probability proportional to its estimated light without shadows
 * (Shirley 1991, section 5.4, and Shirley, Wang & Zimmerman 1996), so that one shadow ray per vertex suffices for
 * many lights; the sampled light is divided by the probability. Other options choose uniformly or in proportion to
 * the power of the lights. The flags of the integrator determine the weight of light that a ray along a followed lobe
 * can also find.
 */
#include "render/pipelines/pipelines.h"

#include <string.h>

#include "render/samples/samples.h"

static void choose(const koksma__trace *trace, const koksma__vertices *v, const float *us, koksma__light_lanes *l)
{
    const koksma__frame *frame = trace->frame;
    const koksma__lights *lights = &frame->lights;
    const int last = (int)lights->n - 1;
    if (frame->light_selection == KOKSMA_LIGHTS_ONE) {
        frame->batch->choose(lights->estimates, &v->hits, us, v->whole, trace->scratch->estimates, l->light,
                             l->probability);
        return;
    }
    for (int i = 0; i < v->whole; i++) {
        int light = 0;
        if (frame->light_selection == KOKSMA_LIGHTS_UNIFORM) {
            light = (int)(us[i] * (float)lights->n);
            light = light < last ? light : last;
        }
        while (frame->light_selection == KOKSMA_LIGHTS_POWER && light < last && lights->cdf[light + 1] <= us[i]) {
            light++;
        }
        l->light[i] = light;
        l->probability[i] = frame->light_selection == KOKSMA_LIGHTS_UNIFORM
                                ? 1 / (float)lights->n
                                : lights->cdf[light + 1] - lights->cdf[light];
    }
}

float koksma__light_probability(const koksma__frame *frame, const float p[3], const float n[3], int light)
{
    const koksma__lights *lights = &frame->lights;
    float estimates[KOKSMA__MAX_BATCH_LIGHTS], total;
    switch (frame->light_selection) {
    case KOKSMA_LIGHTS_ALL:
        return 1;
    case KOKSMA_LIGHTS_UNIFORM:
        return 1 / (float)lights->n;
    case KOKSMA_LIGHTS_POWER:
        return lights->cdf[light + 1] - lights->cdf[light];
    default:
        total = frame->batch->estimate(lights->estimates, p, n, estimates);
        return total > 0 ? estimates[light] / total : 0;
    }
}

/* Samples one light per vertex, or its centre, and adds the unblocked light that the vertices reflect. */
static koksma_status add_samples(const koksma__trace *trace, koksma__vertices *v, const koksma__light_lanes *l,
                                 koksma__values *values)
{
    const koksma__frame *frame = trace->frame;
    koksma__shadows shadows;
    koksma__beams beams;
    KOKSMA__LANES(int32_t, aimed);
    _Alignas(64) koksma__lanes u[2], reflected[3];
    if (frame->flags->areas) {
        const uint32_t use = KOKSMA__USE_LIGHT + (uint32_t)(l->same < 0 ? 0 : l->same);
        KOKSMA__TRY(koksma__wavefront_pairs(trace, use, v, u[0], u[1]));
    } else {
        memset(u, 0, sizeof u);
    }
    frame->batch->beams(l, &v->hits, u, v->whole, &beams);
    const bool meets = trace->bounce < frame->depth || frame->flags->weight == KOKSMA__WEIGHT_ZERO;
    const koksma__light_weight weight = meets ? frame->flags->weight : KOKSMA__WEIGHT_ONE;
    const int sampled =
        frame->batch->reflect(&v->surfaces, l, &beams, frame->flags->followed, weight, v->whole, &shadows, reflected);
    if (!sampled) {
        return KOKSMA_OK;
    }
    if (frame->flags->shadows) {
        const koksma__shading_light *lights = frame->lights.lights;
        const int whole = v->whole, same = l->same < 0 ? -1 : lights[l->same].shape;
        for (int i = 0; i < whole; i++) {
            aimed[i] = same;
        }
        for (int i = 0; l->same < 0 && i < whole; i++) {
            aimed[i] = l->light[i] < 0 ? -1 : lights[l->light[i]].shape;
        }
        shadows.aimed = aimed;
        frame->geometry.occlude(&frame->geometry, &v->hits, v->whole, &shadows);
        values->rays += (uint64_t)sampled;
    }
    if (frame->scene->medium.is_there) {
        frame->batch->attenuate(&frame->scene->medium, &v->hits, &shadows, v->whole, reflected);
    }
    frame->batch->collect(&shadows, reflected, v);
    return KOKSMA_OK;
}

koksma_status koksma__wavefront_light(const koksma__trace *trace, koksma__vertices *v, koksma__values *values)
{
    const koksma__frame *frame = trace->frame;
    const int n = (int)frame->lights.n, whole = v->whole;
    const int32_t *form = v->surfaces.form;
    koksma__light_lanes l = {.lights = frame->lights.lights, .same = -1, .centres = !frame->flags->areas};
    _Alignas(64) koksma__lanes u;
    if (!v->surfaces.traits || !n || trace->bounce > frame->depth) {
        return KOKSMA_OK;
    }
    if (frame->light_selection != KOKSMA_LIGHTS_ALL) {
        KOKSMA__TRY(koksma__wavefront_pairs(trace, KOKSMA__USE_LIGHT_CHOICE, v, u, NULL));
        choose(trace, v, u, &l);
        for (int i = 0; i < whole; i++) {
            l.light[i] = form[i] < 0 ? -1 : l.light[i];
        }
        return add_samples(trace, v, &l, values);
    }
    for (l.same = 0; l.same < n; l.same++) {
        const int32_t light = l.same;
        for (int i = 0; i < whole; i++) {
            l.light[i] = form[i] < 0 ? -1 : light;
            l.probability[i] = 1;
        }
        KOKSMA__TRY(add_samples(trace, v, &l, values));
    }
    return KOKSMA_OK;
}
