/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Light from luminaires at a block of vertices: a place on each, or on one that is chosen, and a shadow ray there.
 * The choice (Shirley 1991, section 5.4; Shirley, Wang & Zimmerman 1996) is in proportion to what each luminaire
 * would give without shadows, so one shadow ray a vertex is enough for a room of them; the estimate is divided by the
 * chance. Light that a followed lobe would meet by itself too is weighed by the power heuristic.
 */
#include <string.h>

#include "render/pipelines/wavefront.h"
#include "render/vector3.h"

/* Which light a vertex samples, and with which probability; light -1: none. */
typedef struct choice {
    int light;
    float probability;
} choice;

static choice choose_by_estimate(const koksma__frame *frame, const float p[3], const float n[3], float u)
{
    float estimates[KOKSMA__MAX_BATCH_LIGHTS];
    const koksma__batch_lights *all = frame->lights.estimates;
    const float total = frame->batch->estimate(all, p, n, estimates);
    choice chosen = {-1, 0};
    float rest = u * total;
    for (int l = 0; l < all->n && total > 0; l++) {
        if (estimates[l] > 0) {
            chosen = (choice){l, estimates[l] / total}; /* the last one that can be, when rounding eats the rest */
            if (rest < estimates[l]) {
                break;
            }
            rest -= estimates[l];
        }
    }
    return chosen;
}

static choice choose(const koksma__frame *frame, const koksma__surface *s, float u)
{
    const koksma__lights *lights = &frame->lights;
    const int last = (int)lights->n - 1;
    int light = 0;
    switch (frame->options->lights) {
    case KOKSMA_LIGHTS_UNIFORM:
        light = (int)(u * (float)lights->n);
        return (choice){light < last ? light : last, 1 / (float)lights->n};
    case KOKSMA_LIGHTS_POWER:
        while (light < last && lights->cdf[light + 1] <= u) {
            light++;
        }
        return (choice){light, lights->cdf[light + 1] - lights->cdf[light]};
    default:
        return choose_by_estimate(frame, s->p, s->n, u);
    }
}

float koksma__light_probability(const koksma__frame *frame, const float p[3], const float n[3], int light)
{
    const koksma__lights *lights = &frame->lights;
    float estimates[KOKSMA__MAX_BATCH_LIGHTS], total;
    switch (frame->options->lights) {
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

/* What surface s reflects of the beam, which was chosen with this chance. */
static void reflect(const koksma__trace *trace, const koksma__surface *s, const koksma__shading_light *light,
                    const koksma__beam *beam, float probability, float out[3])
{
    const koksma__bsdf *bsdf = s->material->bsdf;
    const bool goes_on = trace->bounce < trace->frame->depth;
    const unsigned followed = goes_on && light->visible ? trace->frame->flags->followed & bsdf->lobes : 0;
    float alone[3] = {0, 0, 0}, shared[3] = {0, 0, 0}, weight = 1;
    bsdf->value(s, beam->w, bsdf->lobes & ~followed, alone);
    if (followed) {
        const float met = bsdf->value(s, beam->w, followed, shared), sampled = beam->pdf * probability;
        weight = beam->pdf > 0 ? sampled * sampled / (sampled * sampled + met * met) : 1;
    }
    for (int k = 0; k < 3; k++) {
        out[k] = (alone[k] + weight * shared[k]) * beam->value[k] / probability;
    }
}

/* One luminaire a vertex, chosen[i], with the places us[2 i], …; its light, shaded, is added. */
static void add_samples(const koksma__trace *trace, const koksma__vertices *v, const choice *chosen, const float *us,
                        koksma__values *values)
{
    const koksma__frame *frame = trace->frame;
    koksma__shadows shadows;
    KOKSMA__LANES(int32_t, aimed);
    float reflected[KOKSMA__BLOCK][3];
    int sampled = 0;
    memset(shadows.light, 0, sizeof shadows.light);
    shadows.aimed = aimed;
    for (int i = 0; i < v->whole; i++) {
        aimed[i] = -1;
        shadows.dx[i] = shadows.dy[i] = shadows.dz[i] = 1;
    }
    for (int i = 0; i < v->n; i++) {
        koksma__beam beam;
        if (!v->lit[i] || chosen[i].light < 0) {
            continue;
        }
        const koksma__surface *s = &v->surfaces[i];
        const koksma__shading_light *light = &frame->lights.lights[chosen[i].light];
        const bool lit = frame->flags->areas ? light->kind->sample(light, s->p, us + 2 * v->paths[i].sample, &beam)
                                             : light->kind->centre && light->kind->centre(light, s->p, &beam);
        if (lit) {
            reflect(trace, s, light, &beam, chosen[i].probability, reflected[i]);
        }
        if (lit && koksma__max3(reflected[i]) > 0) {
            shadows.dx[i] = beam.d[0];
            shadows.dy[i] = beam.d[1];
            shadows.dz[i] = beam.d[2];
            shadows.light[i] = 1;
            aimed[i] = light->shape;
            sampled++;
        }
    }
    if (sampled && frame->flags->shadows) {
        frame->geometry.occlude(&frame->geometry, v->hits, v->whole, &shadows);
        values->rays += (uint64_t)sampled;
    }
    for (int i = 0; sampled && i < v->n; i++) {
        float *sum = trace->scratch->sums + 3 * v->paths[i].sample;
        for (int k = 0; shadows.light[i] > 0 && k < 3; k++) {
            sum[k] += v->paths[i].beta[k] * reflected[i][k];
        }
    }
}

static koksma_status sample_all(const koksma__trace *trace, const koksma__vertices *v, uint32_t base,
                                koksma__values *values)
{
    choice chosen[KOKSMA__BLOCK];
    koksma_status status = KOKSMA_OK;
    for (size_t l = 0; !status && l < trace->frame->lights.n; l++) {
        const float *us = NULL;
        for (int i = 0; i < v->n; i++) {
            chosen[i] = (choice){(int)l, 1};
        }
        if (trace->frame->flags->areas) {
            status = koksma__tracer_draw(trace, base + KOKSMA__USE_LIGHT + (uint32_t)l, &us);
        }
        if (!status) {
            add_samples(trace, v, chosen, us, values);
        }
    }
    return status;
}

koksma_status koksma__tracer_light(const koksma__trace *trace, const koksma__vertices *v, koksma__values *values)
{
    const koksma__frame *frame = trace->frame;
    const uint32_t base = (uint32_t)trace->bounce * KOKSMA__USES_A_BOUNCE;
    const float *us = NULL, *choices = NULL;
    choice chosen[KOKSMA__BLOCK];
    int lit = 0;
    for (int i = 0; i < v->n; i++) {
        lit += v->lit[i];
    }
    if (!lit || !frame->lights.n) {
        return KOKSMA_OK;
    }
    if (frame->options->lights == KOKSMA_LIGHTS_ALL) {
        return sample_all(trace, v, base, values);
    }
    koksma_status status = koksma__tracer_draw(trace, base + KOKSMA__USE_LIGHT_CHOICE, &choices);
    if (!status && frame->flags->areas) {
        status = koksma__tracer_draw(trace, base + KOKSMA__USE_LIGHT, &us);
    }
    for (int i = 0; !status && i < v->n; i++) {
        chosen[i] = v->lit[i] ? choose(frame, &v->surfaces[i], choices[2 * v->paths[i].sample]) : (choice){-1, 0};
    }
    if (!status) {
        add_samples(trace, v, chosen, us, values);
    }
    return status;
}
