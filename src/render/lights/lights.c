/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The table of lights, and a scene's lights ready for sampling: each opened by its kind, their powers as a cumulative
 * table, and, in arrays for SIMD lanes, the data from which batch_lights.c estimates their contribution at a point.
 */
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/platform/system.h"
#include "core/status.h"
#include "render/lights/lights.h"

_Static_assert((int)KOKSMA__MAX_BATCH_LIGHTS >= (int)KOKSMA__MAX_LIGHTS, "every light can be chosen");

const koksma__light_kind *const koksma__light_types[] = {
#define LIGHT(name) &koksma__light_##name,
#include "render/lights/lights.def"
#undef LIGHT
    NULL};

const koksma__kind *const koksma__light_kinds[] = {
#define LIGHT(name) &koksma__light_##name.kind,
#include "render/lights/lights.def"
#undef LIGHT
    NULL};

static koksma_status open_light(const koksma_scene *scene, const koksma__light *from, koksma__shading_light *l)
{
    *l = (koksma__shading_light){.kind = from->kind, .visible = from->visible, .shape = -1};
    for (int k = 0; k < 3; k++) {
        l->centre[k] = (float)from->centre[k];
        l->axis_u[k] = (float)from->axis_u[k];
        l->axis_v[k] = (float)from->axis_v[k];
        l->normal[k] = (float)from->normal[k];
        l->radiance[k] = (float)from->radiance[k];
    }
    l->half[0] = (float)from->half[0];
    l->half[1] = (float)from->half[1];
    for (int i = 0; i < KOKSMA__MAX_VALUES; i++) {
        l->values[i] = (float)from->values[i];
    }
    return l->kind->open(scene, from, l);
}

static void accumulate(koksma__lights *lights)
{
    double total = 0, sum = 0;
    for (size_t i = 0; i < lights->n; i++) {
        total += (double)lights->lights[i].power;
    }
    for (size_t i = 0; i < lights->n; i++) {
        lights->cdf[i] = total > 0 ? (float)(sum / total) : (float)i / (float)lights->n;
        sum += (double)lights->lights[i].power;
    }
    lights->cdf[lights->n] = 1;
}

/* Sets the data of light i for estimates of its contribution at a point: for a light with a position, power times the
   cosines divided by the squared distance is the irradiance over pi. A sphere appears as a disk with a quarter of its
   surface, and so does any convex body on average over directions (Cauchy); for a point light the intensity over pi
   is a quarter of the power over pi^2. */
static void set_estimate(const koksma__shading_light *l, int i, koksma__batch_lights *to)
{
    const koksma__light_distance distance = l->kind->distance;
    for (int k = 0; k < 3; k++) {
        to->centre[k][i] = l->centre[k];
        to->normal[k][i] = l->normal[k];
    }
    to->flat[i] = l->kind->is_flat;
    to->reach[i] = l->reach > 1e-6f ? l->reach : 1e-6f;
    to->power[i] = distance != KOKSMA__LIGHT_NEAR ? 0 : l->kind->is_flat ? l->power : l->power / 4;
    to->far[i] = distance == KOKSMA__LIGHT_PARALLEL ? l->power : 0;
    to->fixed[i] = distance == KOKSMA__LIGHT_AROUND ? l->power : 0;
}

koksma_status koksma__lights_init(const koksma_scene *scene, koksma__lights *out)
{
    const size_t n = scene->n_lights;
    *out = (koksma__lights){.n = n, .first_around = n};
    out->lights = calloc(n + 1, sizeof *out->lights);
    out->rectangles = calloc(n + 1, sizeof *out->rectangles);
    out->cdf = calloc(n + 1, sizeof *out->cdf);
    out->estimates = koksma__aligned(sizeof *out->estimates);
    KOKSMA__REQUIRE_MEMORY(out->lights && out->rectangles && out->cdf && out->estimates,
                           (n + 1) * sizeof *out->lights);
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < n; i++) {
        const koksma__light *from = &scene->lights[i];
        status = open_light(scene, from, &out->lights[i]);
        if (from->kind->lanes) {
            from->kind->lanes(from, &out->rectangles[i]);
        }
        if (from->kind->radiance && out->first_around == n) {
            out->first_around = i;
        }
    }
    if (status) {
        return status;
    }
    for (size_t s = 0; s < scene->n_shapes; s++) {
        if (scene->shapes[s].light >= 0) {
            out->lights[scene->shapes[s].light].shape = (int)s;
        }
    }
    accumulate(out);
    memset(out->estimates, 0, sizeof *out->estimates);
    for (int i = 0; i < KOKSMA__MAX_BATCH_LIGHTS; i++) {
        out->estimates->reach[i] = 1; /* not 0, because estimates divide by it even for dark lights */
    }
    for (size_t i = 0; i < n; i++) {
        set_estimate(&out->lights[i], (int)i, out->estimates);
    }
    out->estimates->n = (int)n;
    out->estimates->whole = (int)((n + KOKSMA__LANE_STEP - 1) / KOKSMA__LANE_STEP * KOKSMA__LANE_STEP);
    return status;
}

void koksma__lights_fini(koksma__lights *lights)
{
    for (size_t i = 0; lights->lights && i < lights->n; i++) {
        if (lights->lights[i].data) {
            lights->lights[i].kind->close(lights->lights[i].data);
        }
    }
    KOKSMA__FREE(lights->lights, lights->rectangles, lights->cdf);
    koksma__aligned_free(lights->estimates);
    *lights = (koksma__lights){0};
}
