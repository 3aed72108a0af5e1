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

/* Which luminaire a vertex asks, and with which chance; lamp -1: none. */
typedef struct choice {
    int lamp;
    float chance;
} choice;

static choice choose_by_estimate(const koksma__frame *frame, const float p[3], const float n[3], float u)
{
    float estimates[KOKSMA__MAX_LAMPS];
    const koksma__batch_lamps *lamps = frame->lights.estimates;
    const float total = frame->batch->estimate(lamps, p, n, estimates);
    choice chosen = {-1, 0};
    float rest = u * total;
    for (int l = 0; l < lamps->n && total > 0; l++) {
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
    int lamp = 0;
    switch (frame->options->lights) {
    case KOKSMA_LIGHTS_UNIFORM:
        lamp = (int)(u * (float)lights->n);
        return (choice){lamp < last ? lamp : last, 1 / (float)lights->n};
    case KOKSMA_LIGHTS_POWER:
        while (lamp < last && lights->cdf[lamp + 1] <= u) {
            lamp++;
        }
        return (choice){lamp, lights->cdf[lamp + 1] - lights->cdf[lamp]};
    default:
        return choose_by_estimate(frame, s->p, s->n, u);
    }
}

float koksma__lamp_chance(const koksma__frame *frame, const float p[3], const float n[3], int lamp)
{
    const koksma__lights *lights = &frame->lights;
    float estimates[KOKSMA__MAX_LAMPS], total;
    switch (frame->options->lights) {
    case KOKSMA_LIGHTS_ALL:
        return 1;
    case KOKSMA_LIGHTS_UNIFORM:
        return 1 / (float)lights->n;
    case KOKSMA_LIGHTS_POWER:
        return lights->cdf[lamp + 1] - lights->cdf[lamp];
    default:
        total = frame->batch->estimate(lights->estimates, p, n, estimates);
        return total > 0 ? estimates[lamp] / total : 0;
    }
}

/* What surface s reflects of the beam, which was chosen with this chance. */
static void reflect(const koksma__trace *trace, const koksma__surface *s, const koksma__lamp *lamp,
                    const koksma__beam *beam, float chance, float out[3])
{
    const koksma__material_rules *material = koksma__material_rules_of(s->substance->kind);
    const bool goes_on = trace->bounce < trace->frame->depth;
    const unsigned followed = goes_on && lamp->visible ? trace->frame->rules->followed & s->substance->lobes : 0;
    float alone[3] = {0, 0, 0}, shared[3] = {0, 0, 0}, weight = 1;
    material->value(s, beam->w, s->substance->lobes & ~followed, alone);
    if (followed) {
        const float met = material->value(s, beam->w, followed, shared), sampled = beam->density * chance;
        weight = beam->density > 0 ? sampled * sampled / (sampled * sampled + met * met) : 1;
    }
    for (int k = 0; k < 3; k++) {
        out[k] = (alone[k] + weight * shared[k]) * beam->value[k] / chance;
    }
}

/* One luminaire a vertex, chosen[i], with the places us[2 i], …; its light, shaded, is added. */
static void ask(const koksma__trace *trace, const koksma__vertices *v, const choice *chosen, const float *us,
                koksma__values *values)
{
    const koksma__frame *frame = trace->frame;
    koksma__shadows shadows;
    KOKSMA__LANES(int32_t, aimed);
    float light[KOKSMA__BLOCK][3];
    int asked = 0;
    memset(shadows.light, 0, sizeof shadows.light);
    shadows.aimed = aimed;
    for (int i = 0; i < v->whole; i++) {
        aimed[i] = -1;
        shadows.dx[i] = shadows.dy[i] = shadows.dz[i] = 1;
    }
    for (int i = 0; i < v->n; i++) {
        koksma__beam beam;
        if (!v->lit[i] || chosen[i].lamp < 0) {
            continue;
        }
        const koksma__surface *s = &v->surfaces[i];
        const koksma__lamp *lamp = &frame->lights.lamps[chosen[i].lamp];
        const bool lit = frame->rules->areas ? koksma__lamp_sample(lamp, s->p, us + 2 * v->paths[i].sample, &beam)
                                             : koksma__lamp_centre(lamp, s->p, &beam);
        if (lit) {
            reflect(trace, s, lamp, &beam, chosen[i].chance, light[i]);
        }
        if (lit && koksma__max3(light[i]) > 0) {
            shadows.dx[i] = beam.d[0];
            shadows.dy[i] = beam.d[1];
            shadows.dz[i] = beam.d[2];
            shadows.light[i] = 1;
            aimed[i] = lamp->light_shape;
            asked++;
        }
    }
    if (asked && frame->rules->shadows) {
        frame->geometry.occlude(&frame->geometry, v->hits, v->whole, &shadows);
        values->rays += (uint64_t)asked;
    }
    for (int i = 0; asked && i < v->n; i++) {
        float *sum = trace->room->sums + 3 * v->paths[i].sample;
        for (int k = 0; shadows.light[i] > 0 && k < 3; k++) {
            sum[k] += v->paths[i].beta[k] * light[i][k];
        }
    }
}

static koksma_status ask_all(const koksma__trace *trace, const koksma__vertices *v, uint32_t base,
                             koksma__values *values)
{
    choice chosen[KOKSMA__BLOCK];
    koksma_status status = KOKSMA_OK;
    for (size_t l = 0; !status && l < trace->frame->lights.n; l++) {
        const float *us = NULL;
        for (int i = 0; i < v->n; i++) {
            chosen[i] = (choice){(int)l, 1};
        }
        if (trace->frame->rules->areas) {
            status = koksma__tracer_draw(trace, base + KOKSMA__USE_LIGHT + (uint32_t)l, &us);
        }
        if (!status) {
            ask(trace, v, chosen, us, values);
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
        return ask_all(trace, v, base, values);
    }
    koksma_status status = koksma__tracer_draw(trace, base + KOKSMA__USE_LIGHT_CHOICE, &choices);
    if (!status && frame->rules->areas) {
        status = koksma__tracer_draw(trace, base + KOKSMA__USE_LIGHT, &us);
    }
    for (int i = 0; !status && i < v->n; i++) {
        chosen[i] = v->lit[i] ? choose(frame, &v->surfaces[i], choices[2 * v->paths[i].sample]) : (choice){-1, 0};
    }
    if (!status) {
        ask(trace, v, chosen, us, values);
    }
    return status;
}
