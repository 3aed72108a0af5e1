/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The table of integrators. Each integrator is a row of flags that wavefront.c obeys, with a name, a default depth
 * and a source. The comment above each row has the integrator's formula. In these formulas E is emission, f
 * the BSDF, cos and cos' are the cosines at the surface and at the light, and V is 1 where the light is visible and 0
 * elsewhere.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/status.h"
#include "render/integrators/integrators.h"
#include "render/materials/materials.h"

/*
 * The integrator `utah` computes local illumination. A surface reflects the scene's ambient light and the light from
 * the centre of each light, without shadows and without light from other surfaces; mirrors and glass are black.
 *
 *     L(x, out) = E(x, out) + albedo ambient + sum over lights of f(in, out) cos(in) irradiance from its centre
 *
 * An environment has no centre: rays that hit nothing see it, but it does not illuminate surfaces; the ambient light
 * replaces it.
 *
 * Source: Phong 1975; Shirley 1991. Random numbers are used only for the position in the pixel, the position on the
 * lens and the time.
 */
static const koksma__integrator_flags utah = {.ambient = true};

/*
 * The integrator `whitted` is recursive ray tracing. Each vertex sends a shadow ray to the centre of each light;
 * mirrors reflect rays, and glass both reflects and refracts them, so that the rays of a sample form a tree. A branch
 * whose weight is below 1/1000 is cut (Hall's depth control), and its light is lost. Many branches may be cut: a
 * glass slab in a white furnace should reflect 2 R / (1 + R) in all, and loses .08 % of that at an angle of incidence
 * of 0.5 degrees, .25 % at 56 and .52 % at 89 (depth 40); the integrator `path` cuts no branch.
 *
 *     L(x, out) = local light as in utah, with V   +   R L(y, mirrored)   +   (1 - R) L(z, refracted)
 *
 * Here V, which multiplies the light from each centre, is 1 where that centre is visible and 0 elsewhere, and R is
 * the reflectance of a mirror or the Fresnel reflectance of glass. An environment has no centre: as in `utah`, rays
 * that hit nothing see it, but it does not illuminate surfaces. Source: Whitted 1980.
 */
static const koksma__integrator_flags whitted = {
    .followed = KOKSMA__LOBE_SPECULAR, .shadows = true, .ambient = true, .branches = true};

/*
 * The integrator `distribution` is distribution ray tracing. Positions on lights and on the lens, times, and
 * directions in glossy lobes are sampled; the scene's ambient light replaces light between diffuse surfaces.
 *
 *     L(x, out) = E(x, out) + albedo ambient + sum over lights of f E_l cos cos' V A / d^2 + weight L(y, w)
 *
 * The sum takes one sampled position on each light of area A, at the distance d, and y is the point that the ray in
 * the mirrored, refracted or glossy direction w hits; `weight` is f cos / pdf of that direction. Source: Cook, Porter
 * & Carpenter 1984; Shirley 1991, chapter 5.
 */
static const koksma__integrator_flags distribution = {
    .followed = KOKSMA__LOBE_SPECULAR | KOKSMA__LOBE_GLOSSY, .areas = true, .shadows = true, .ambient = true};

/*
 * The integrator `direct` computes direct illumination with sampled positions on lights; paths continue through
 * mirrors and glass. It differs from `distribution` in two points: there is no ambient light, and glossy surfaces
 * reflect only lights. The direct illumination by one light is the two-dimensional integral that studies of soft
 * shadows use.
 *
 *     L(x, out) = E(x, out) + sum over lights of f E_l cos cos' V A / d^2 + weight L(y, w), w mirrored or refracted
 *
 * Source: Shirley, Wang & Zimmerman 1996.
 */
static const koksma__integrator_flags direct = {.followed = KOKSMA__LOBE_SPECULAR, .areas = true, .shadows = true};

/*
 * The integrator `ambient-occlusion` computes the cosine-weighted fraction of the hemisphere above a surface that is
 * not occluded,
 *
 *     A(x) = 1 / pi  integral over the hemisphere of V(x, w) cos(w) dw,   and 1 where the eye sees no surface.
 *
 * Here V is 1 if the ray hits nothing at any distance. A(x) is a two-dimensional integral that depends only on
 * shapes: all surfaces are white and diffuse, and the shapes of lights are black. With more than one bounce (--depth)
 * light reflected by white surfaces is added. Source: Zhukov, Iones & Kronin 1998.
 *
 * The scene is replaced by one whose path-traced image is its ambient occlusion: all surfaces become white and diffuse,
 * all lights become black, samples are not clamped, and the background has radiance 1. A direction sampled from a
 * surface with the density cos / pi then contributes 1 if its ray leaves the scene and 0 if the ray hits anything. The
 * shapes, the camera and the cached geometry remain those of the original scene.
 */
static koksma_status open_occlusion(const koksma_scene *scene, koksma_scene **out)
{
    koksma_scene *copy = malloc(sizeof *copy);
    *out = copy;
    KOKSMA__REQUIRE_MEMORY(copy, sizeof *copy);
    *copy = *scene;
    copy->materials = calloc(scene->n_materials + 1, sizeof *copy->materials);
    copy->lights = calloc(scene->n_lights + 1, sizeof *copy->lights);
    if (!copy->materials || !copy->lights) {
        return koksma__fail_memory(scene->n_materials * sizeof *copy->materials +
                                   scene->n_lights * sizeof *copy->lights);
    }
    for (size_t i = 0; i < scene->n_materials; i++) {
        koksma__material *m = &copy->materials[i];
        m->bsdf = &koksma__bsdf_lambert;
        m->albedo[0][0] = m->albedo[0][1] = m->albedo[0][2] = 1;
    }
    for (size_t i = 0; i < scene->n_lights; i++) { /* the lights' shapes remain and occlude */
        koksma__light *l = &copy->lights[i];
        *l = scene->lights[i];
        memset(l->radiance, 0, sizeof l->radiance);
        l->visible = false;
    }
    copy->medium.is_there = false;
    copy->clamp = INFINITY; /* the scene's limit is one of its light */
    for (int k = 0; k < 3; k++) {
        copy->background[k] = 1;
        copy->ambient[k] = 0;
    }
    return KOKSMA_OK;
}

static void release_occlusion(koksma_scene *scene)
{
    KOKSMA__FREE(scene->materials, scene->lights, scene);
}

static const koksma__integrator_flags ambient_occlusion = {
    .followed = KOKSMA__LOBE_DIFFUSE, .replace_scene = open_occlusion, .release_scene = release_occlusion};

/*
 * The integrator `path` is path tracing (Kajiya 1986), which samples one direction at each vertex. Lights are sampled
 * at each vertex and also hit by reflected rays; the power heuristic combines both (Veach 1997, section 9.2). From
 * the fifth vertex on, a path whose weight is below 1 survives with that probability (Russian roulette), which
 * preserves the mean. The result is unbiased with two exceptions: paths end at the depth limit, and no path finds
 * light that a mirror or glass casts on a surface from lights that rays cannot hit (points, directional lights,
 * lights that are not `visible`).
 */
#define PATH                                                                                                         \
    .followed = KOKSMA__LOBE_SPECULAR | KOKSMA__LOBE_GLOSSY | KOKSMA__LOBE_DIFFUSE, .areas = true, .shadows = true,  \
    .media = true, .roulette = true
static const koksma__integrator_flags path = {PATH};

/*
 * The integrators `path-balance`, `path-light` and `path-bsdf` are `path` with other weights, to study the sampling
 * strategies (Veach 1997, section 9.2). The integrator `path-balance` uses the balance heuristic p / (p + q). For
 * lights that rays can hit, `path-light` uses only light sampling, except in mirrors and glass, and `path-bsdf` uses
 * only reflected rays. Lights that rays cannot hit are sampled by all three integrators. All three have the same mean
 * as `path` at any depth.
 */
static const koksma__integrator_flags path_balance = {PATH, .weight = KOKSMA__WEIGHT_BALANCE};
static const koksma__integrator_flags path_light = {PATH, .weight = KOKSMA__WEIGHT_ONE};
static const koksma__integrator_flags path_bsdf = {PATH, .weight = KOKSMA__WEIGHT_ZERO};

static const koksma_integrator rows[] = {
    {"utah", "local light and ambient light, no shadows", "phong1975 shirley1991", 0, &utah},
    {"whitted", "sharp shadows, mirrors and glass", "whitted1980", 6, &whitted},
    {"distribution", "soft shadows, lens, motion, glossy reflection", "cook1984 shirley1991", 6, &distribution},
    {"path", "path tracing with next-event estimation; caustics of visible lights only", "kajiya1986 veach1997", 16,
     &path},
    {"path-balance", "path tracing with the balance heuristic in place of the power heuristic",
     "kajiya1986 veach1997", 16, &path_balance},
    {"path-light", "path tracing that finds lights only by light sampling", "kajiya1986 veach1997", 16, &path_light},
    {"path-bsdf", "path tracing that finds lights only by reflected rays", "kajiya1986 veach1997", 16, &path_bsdf},
    {"direct", "soft shadows, mirrors and glass; no ambient light", "shirley1996", 6, &direct},
    {"ambient-occlusion", "the fraction of a white sky that each surface point sees; depends on shapes only",
     "zhukov1998", 1, &ambient_occlusion},
};

const koksma_integrator *koksma_integrator_at(size_t i)
{
    return i < sizeof rows / sizeof *rows ? &rows[i] : NULL;
}

const koksma_integrator *koksma_integrator_find(const char *name)
{
    KOKSMA__REQUIRE_OR(NULL, name);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (!strcmp(rows[i].name, name)) {
            return &rows[i];
        }
    }
    return NULL;
}
