/* SPDX-License-Identifier: Apache-2.0 */
#include "render/lights/lights.h"

#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "render/vector3.h"
#include "warps/shared/disk_maps.h"

_Static_assert((int)KOKSMA__MAX_LAMPS >= (int)KOKSMA__MAX_LIGHTS, "every luminaire can be chosen");

#define AWAY 4e6f /* further than anything in a scene */

/* ---- The scene in floats ------------------------------------------------------------------------------- */

static float area_of(const koksma__light *l)
{
    const double a = l->half[0], b = l->half[1];
    return (float)(l->kind == KOKSMA__LIGHT_RECTANGLE ? 4 * a * b
                   : l->kind == KOKSMA__LIGHT_DISK    ? M_PI * a * a
                   : l->kind == KOKSMA__LIGHT_SPHERE  ? 4 * M_PI * a * a
                                                      : 0);
}

static koksma__lamp make_lamp(const koksma__light *from)
{
    koksma__lamp l = {.kind = from->kind, .visible = from->visible, .light_shape = -1, .area = area_of(from)};
    for (int k = 0; k < 3; k++) {
        l.centre[k] = (float)from->centre[k];
        l.axis_u[k] = (float)from->axis_u[k];
        l.axis_v[k] = (float)from->axis_v[k];
        l.normal[k] = (float)from->normal[k];
        l.radiance[k] = (float)from->radiance[k];
    }
    l.half[0] = (float)from->half[0];
    l.half[1] = (float)from->half[1];
    const float bright = koksma__luminance3(l.radiance);
    switch (from->kind) {
    case KOKSMA__LIGHT_RECTANGLE:
    case KOKSMA__LIGHT_DISK:
    case KOKSMA__LIGHT_SPHERE:
        l.power = bright * l.area / KOKSMA__PI_F;
        break;
    case KOKSMA__LIGHT_POINT:
        l.power = 4 * bright / KOKSMA__PI_F;
        break;
    default: /* of a directional one; meshes and environments are measured later */
        l.power = bright / KOKSMA__PI_F;
    }
    return l;
}

static koksma__batch_light make_rectangle(const koksma__light *from)
{
    koksma__batch_light l = {.power = (float)from->power};
    for (int k = 0; k < 3; k++) {
        const double u = from->half[0] * from->axis_u[k], v = from->half[1] * from->axis_v[k];
        l.corner[k] = (float)(from->centre[k] - u - v);
        l.edge_x[k] = (float)(2 * u);
        l.edge_y[k] = (float)(2 * v);
        l.normal[k] = (float)from->normal[k];
    }
    return l;
}

static void accumulate(koksma__lights *lights)
{
    double total = 0, sum = 0;
    for (size_t i = 0; i < lights->n; i++) {
        total += (double)lights->lamps[i].power;
    }
    for (size_t i = 0; i < lights->n; i++) {
        lights->cdf[i] = total > 0 ? (float)(sum / total) : (float)i / (float)lights->n;
        sum += (double)lights->lamps[i].power;
    }
    lights->cdf[lights->n] = 1;
}

/* What choosing by place needs of luminaire i: with a place, power times the cosines over the distance's square is
   the irradiance over pi. A sphere shows a quarter of its surface, as a disk, and any convex body does in the mean
   (Cauchy); a point sends a quarter of its power over pi^2 as intensity over pi. */
static void set_estimate(const koksma__lamp *l, int i, koksma__batch_lamps *to)
{
    const bool rectangle = l->kind == KOKSMA__LIGHT_RECTANGLE, away = l->kind >= KOKSMA__LIGHT_DIRECTIONAL;
    to->cx[i] = l->centre[0];
    to->cy[i] = l->centre[1];
    to->cz[i] = l->centre[2];
    to->nx[i] = l->normal[0];
    to->ny[i] = l->normal[1];
    to->nz[i] = l->normal[2];
    to->flat[i] = rectangle || l->kind == KOKSMA__LIGHT_DISK;
    to->reach[i] = rectangle ? hypotf(l->half[0], l->half[1]) : l->half[0];
    to->reach[i] = to->reach[i] > 1e-6f ? to->reach[i] : 1e-6f;
    to->power[i] = away ? 0 : to->flat[i] > 0 ? l->power : l->power / 4;
    to->far[i] = l->kind == KOKSMA__LIGHT_DIRECTIONAL ? l->power : 0;
    to->fixed[i] = l->kind == KOKSMA__LIGHT_ENVIRONMENT ? l->power : 0;
}

koksma_status koksma__lights_init(const koksma_scene *scene, koksma__lights *out)
{
    const size_t n = scene->n_lights;
    *out = (koksma__lights){.n = n, .environment_lamp = -1};
    out->lamps = calloc(n + 1, sizeof *out->lamps);
    out->rectangles = calloc(n + 1, sizeof *out->rectangles);
    out->cdf = calloc(n + 1, sizeof *out->cdf);
    out->estimates = aligned_alloc(64, sizeof *out->estimates);
    if (!out->lamps || !out->rectangles || !out->cdf || !out->estimates) {
        return koksma__fail_memory((n + 1) * sizeof *out->lamps);
    }
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < n; i++) {
        out->lamps[i] = make_lamp(&scene->lights[i]);
        out->rectangles[i] = make_rectangle(&scene->lights[i]);
        if (scene->lights[i].kind == KOKSMA__LIGHT_MESH) {
            status = koksma__lamp_mesh_open(scene, &scene->lights[i], &out->lamps[i]);
        } else if (scene->lights[i].kind == KOKSMA__LIGHT_ENVIRONMENT) {
            status = koksma__environment_open(&scene->lights[i], &out->environment);
            out->environment_lamp = (int)i;
            out->lamps[i].environment = out->environment;
            out->lamps[i].power = status ? 0 : koksma__environment_mean(out->environment);
        }
    }
    for (size_t s = 0; s < scene->n_shapes; s++) {
        if (scene->shapes[s].light >= 0) {
            out->lamps[scene->shapes[s].light].light_shape = (int)s;
        }
    }
    accumulate(out);
    memset(out->estimates, 0, sizeof *out->estimates);
    for (int i = 0; i < KOKSMA__MAX_LAMPS; i++) {
        out->estimates->reach[i] = 1; /* dark ones divide by it */
    }
    for (size_t i = 0; i < n; i++) {
        set_estimate(&out->lamps[i], (int)i, out->estimates);
    }
    out->estimates->n = (int)n;
    out->estimates->whole = (int)((n + KOKSMA__LANE_STEP - 1) / KOKSMA__LANE_STEP * KOKSMA__LANE_STEP);
    return status;
}

void koksma__lights_fini(koksma__lights *lights)
{
    koksma__environment_close(lights->environment);
    for (size_t i = 0; lights->lamps && i < lights->n; i++) {
        koksma__lamp_mesh_close(lights->lamps[i].mesh);
    }
    free(lights->lamps);
    free(lights->rectangles);
    free(lights->cdf);
    free(lights->estimates);
    *lights = (koksma__lights){0};
}

/* ---- Places on luminaires ------------------------------------------------------------------------------- */

static void set_value(const koksma__lamp *lamp, float scale, koksma__beam *out)
{
    for (int k = 0; k < 3; k++) {
        out->value[k] = scale * lamp->radiance[k];
    }
}

/* The way to the place u, v (in the surface's own coordinates); the density over the area is 1 / area. */
static bool aim_flat(const koksma__lamp *lamp, const float p[3], float u, float v, koksma__beam *out)
{
    for (int k = 0; k < 3; k++) {
        out->d[k] = lamp->centre[k] + u * lamp->axis_u[k] + v * lamp->axis_v[k] - p[k];
    }
    const float square = koksma__dot3(out->d, out->d), at_light = -koksma__dot3(lamp->normal, out->d);
    if (!(at_light > 0)) {
        return false;
    }
    const float length = sqrtf(square);
    for (int k = 0; k < 3; k++) {
        out->w[k] = out->d[k] / length;
    }
    out->density = square * length / (at_light * lamp->area);
    set_value(lamp, 1 / out->density, out);
    return true;
}

/* A sphere's visible cap, uniform in solid angle (Shirley, Wang & Zimmerman 1996). */
static bool aim_sphere(const koksma__lamp *lamp, const float p[3], const float u[2], koksma__beam *out)
{
    float axis[3], a[3], b[3];
    const float radius = lamp->half[0];
    for (int k = 0; k < 3; k++) {
        axis[k] = lamp->centre[k] - p[k];
    }
    const float square = koksma__dot3(axis, axis), distance = sqrtf(square), part = radius * radius / square;
    if (!(part < 1)) {
        return false; /* inside */
    }
    for (int k = 0; k < 3; k++) {
        axis[k] /= distance;
    }
    koksma__frame3(axis, a, b);
    /* 1 - cos of the cone without cancellation: sin^2 / (1 + cos) */
    const float rest = part / (1 + sqrtf(1 - part)), off = u[0] * rest;
    const float cosine = 1 - off, sine = sqrtf(off * (2 - off)), turn = 2 * KOKSMA__PI_F * u[1];
    const float x = sine * cosf(turn), y = sine * sinf(turn);
    const float inside = radius * radius - square * sine * sine;
    const float t = distance * cosine - sqrtf(inside > 0 ? inside : 0);
    for (int k = 0; k < 3; k++) {
        out->w[k] = x * a[k] + y * b[k] + cosine * axis[k];
        out->d[k] = t * out->w[k];
    }
    out->density = 1 / (2 * KOKSMA__PI_F * rest);
    set_value(lamp, 1 / out->density, out);
    return true;
}

/* From the centre: `strength` times radiance, falling with the square of the distance. */
static bool aim_point(const koksma__lamp *lamp, const float p[3], float strength, koksma__beam *out)
{
    for (int k = 0; k < 3; k++) {
        out->d[k] = lamp->centre[k] - p[k];
    }
    const float square = koksma__dot3(out->d, out->d), length = sqrtf(square);
    if (!(length > 0)) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        out->w[k] = out->d[k] / length;
    }
    out->density = 0;
    set_value(lamp, strength / square, out);
    return true;
}

static bool aim_directional(const koksma__lamp *lamp, koksma__beam *out)
{
    for (int k = 0; k < 3; k++) {
        out->w[k] = -lamp->normal[k];
        out->d[k] = AWAY * out->w[k];
    }
    out->density = 0;
    set_value(lamp, 1, out);
    return true;
}

static bool aim_environment(const koksma__lamp *lamp, const float u[2], koksma__beam *out)
{
    out->density = koksma__environment_sample(lamp->environment, u, out->w);
    koksma__environment_radiance(lamp->environment, out->w, out->value);
    for (int k = 0; k < 3; k++) {
        out->d[k] = AWAY * out->w[k];
        out->value[k] /= out->density;
    }
    return koksma__max3(out->value) > 0;
}

bool koksma__lamp_sample(const koksma__lamp *lamp, const float p[3], const float u[2], koksma__beam *out)
{
    switch (lamp->kind) {
    case KOKSMA__LIGHT_RECTANGLE:
        return aim_flat(lamp, p, (2 * u[0] - 1) * lamp->half[0], (2 * u[1] - 1) * lamp->half[1], out);
    case KOKSMA__LIGHT_DISK: {
        const double square[2] = {(double)u[0], (double)u[1]};
        double x[2];
        koksma__map_concentric(square, x);
        return aim_flat(lamp, p, (float)x[0] * lamp->half[0], (float)x[1] * lamp->half[0], out);
    }
    case KOKSMA__LIGHT_SPHERE:
        return aim_sphere(lamp, p, u, out);
    case KOKSMA__LIGHT_MESH:
        return koksma__lamp_mesh_sample(lamp, p, u, out);
    case KOKSMA__LIGHT_POINT:
        return aim_point(lamp, p, 1, out);
    case KOKSMA__LIGHT_DIRECTIONAL:
        return aim_directional(lamp, out);
    case KOKSMA__LIGHT_ENVIRONMENT:
        return aim_environment(lamp, u, out);
    }
    return false;
}

bool koksma__lamp_centre(const koksma__lamp *lamp, const float p[3], koksma__beam *out)
{
    switch (lamp->kind) {
    case KOKSMA__LIGHT_RECTANGLE:
    case KOKSMA__LIGHT_DISK:
        if (!aim_flat(lamp, p, 0, 0, out)) {
            return false;
        }
        out->density = 0;
        return true;
    case KOKSMA__LIGHT_SPHERE:
        return aim_point(lamp, p, KOKSMA__PI_F * lamp->half[0] * lamp->half[0], out);
    case KOKSMA__LIGHT_MESH: /* a convex body shows a quarter of its surface in the mean (Cauchy) */
        if (!aim_point(lamp, p, lamp->area / 4, out)) {
            return false;
        }
        for (int k = 0; k < 3; k++) { /* ends before the mesh itself */
            const float rest = out->d[k] - lamp->half[0] * out->w[k];
            out->d[k] = rest * out->w[k] > 0 ? rest : 1e-3f * out->d[k];
        }
        return true;
    case KOKSMA__LIGHT_POINT:
        return aim_point(lamp, p, 1, out);
    case KOKSMA__LIGHT_DIRECTIONAL:
        return aim_directional(lamp, out);
    case KOKSMA__LIGHT_ENVIRONMENT: /* has none; ambient light stands for it */
        return false;
    }
    return false;
}

float koksma__lamp_density(const koksma__lamp *lamp, const float p[3], const float w[3], float t, const float n[3])
{
    switch (lamp->kind) {
    case KOKSMA__LIGHT_RECTANGLE:
    case KOKSMA__LIGHT_DISK:
    case KOKSMA__LIGHT_MESH: {
        const float cosine = -koksma__dot3(n, w);
        return cosine > 0 ? t * t / (cosine * lamp->area) : 0;
    }
    case KOKSMA__LIGHT_SPHERE: {
        float axis[3];
        for (int k = 0; k < 3; k++) {
            axis[k] = lamp->centre[k] - p[k];
        }
        const float part = lamp->half[0] * lamp->half[0] / koksma__dot3(axis, axis);
        return part < 1 ? (1 + sqrtf(1 - part)) / (2 * KOKSMA__PI_F * part) : 0;
    }
    case KOKSMA__LIGHT_ENVIRONMENT:
        return koksma__environment_density(lamp->environment, w);
    default:
        return 0;
    }
}
