/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The table of integrators. Each is a row of flags that wavefront.c follows, with its name, depth and source; an
 * integrator with an algorithm of its own has hooks in another file (irradiance_cache.c). The comment above a row has
 * its formula: E is emission, f the material, cos and cos' are at the surface and at the light, V is 1 where the
 * light is seen.
 */
#include <string.h>

#include "core/status.h"
#include "render/integrators/ambient_occlusion.h"
#include "render/integrators/irradiance_cache.h"

/*
 * utah: the local model. A surface reflects the scene's ambient light and what comes from the centre of each
 * light, without shadows and without seeing other surfaces; mirrors and glass are black.
 *
 *     L(x, out) = E(x, out) + albedo ambient + sum over lights of f(in, out) cos(in) irradiance from its centre
 *
 * An environment has no centre: rays see it, and no surface has light from it; that is what ambient light stands for.
 *
 * Source: Phong 1975; Shirley 1991. Nothing in it is random but the position in the pixel, on the lens and in time.
 */
static const koksma__integrator_flags utah = {.ambient = true};

/*
 * whitted: recursive ray tracing. A shadow ray to the centre of each light; mirrors and glass send rays on, glass
 * both ways, so that rays make a tree. A branch that weighs less than 1/1000 is cut (Hall's depth control), which
 * leaves out that much of each. Many may be cut: a glass slab in a white furnace, which reflects 2 R / (1 + R) in
 * all, loses .08 % of that at 0.5 degrees, .25 % at 56 and .52 % at 89 (depth 40); path cuts none.
 *
 *     L(x, out) = local light, as utah has it, with V   +   R L(y, mirrored)   +   (1 - R) L(z, refracted)
 *
 * with V = 1 where the centre of the light is seen and R a mirror's reflectance or Fresnel's share. An
 * environment has no centre: as in utah, rays see it and no surface has light from it. Source: Whitted 1980.
 */
static const koksma__integrator_flags whitted = {
    .followed = KOKSMA__LOBE_SPECULAR, .shadows = true, .ambient = true, .branches = true};

/*
 * distribution: distribution ray tracing. Positions on lights, on the lens, in time, and directions in glossy lobes
 * are sampled; light between diffuse surfaces is the scene's ambient.
 *
 *     L(x, out) = E(x, out) + albedo ambient + sum over lights of f E_l cos cos' V A / d^2 + weight L(y, w)
 *
 * with one position on each light, of area A, at distance d, seen (V = 1) or not; and y where the mirrored,
 * refracted or glossy direction goes on. Source: Cook, Porter & Carpenter 1984; Shirley 1991, chapter 5.
 */
static const koksma__integrator_flags distribution = {
    .followed = KOKSMA__LOBE_SPECULAR | KOKSMA__LOBE_GLOSSY, .areas = true, .shadows = true, .ambient = true};

/*
 * direct: what lights give straight to surfaces, positions on lights sampled; mirrors and glass are followed. As
 * distribution, without ambient light, and with the light that glossy surfaces reflect of lights alone: the integral
 * that studies of soft shadows are about, of two dimensions for each light.
 *
 *     L(x, out) = E(x, out) + sum over lights of f E_l cos cos' V A / d^2 + weight L(y, w), w mirrored or refracted
 *
 * Source: Shirley, Wang & Zimmerman 1996.
 */
static const koksma__integrator_flags direct = {.followed = KOKSMA__LOBE_SPECULAR, .areas = true, .shadows = true};

/*
 * ambient-occlusion: how much of a white sky a surface sees, weighed by the cosine,
 *
 *     A(x) = 1 / pi  integral over the hemisphere of V(x, w) cos(w) dw,   and 1 where the eye sees no surface:
 *
 * V is 1 where nothing is met at any distance. An integral of two dimensions that depends on shapes alone: all
 * materials and lights are as white surfaces, and shapes of lights are black. More bounces than one (--depth) add what
 * white surfaces reflect. Source: Zhukov, Iones & Kronin 1998.
 */
static const koksma__integrator_flags ambient_occlusion = {.followed = KOKSMA__LOBE_DIFFUSE,
                                                           .replace_scene = koksma__ambient_occlusion_scene,
                                                           .release_scene = koksma__ambient_occlusion_release};

/*
 * path: all light paths (Kajiya 1986), one direction on from each vertex. Lights are sampled at each vertex and
 * met by reflected rays, the two weighed by the power heuristic (Veach 1997, section 9.2); from the fifth vertex on a
 * path whose weight is below 1 goes on with that probability, which keeps the mean. Unbiased with two exceptions: paths
 * end at the depth limit; and no path finds the light that reaches a surface by a mirror or glass from lights that
 * rays can't meet (points, directional lights, lights that are not `visible`).
 */
#define PATH                                                                                                         \
    .followed = KOKSMA__LOBE_SPECULAR | KOKSMA__LOBE_GLOSSY | KOKSMA__LOBE_DIFFUSE, .areas = true, .shadows = true,  \
    .roulette = true
static const koksma__integrator_flags path = {PATH};

/*
 * path-balance, path-light, path-bsdf: path with other weights, for studies of the strategies (Veach 1997, section 9.2):
 * the balance heuristic p / (p + q); lights that rays can meet by sampling them alone, but for what mirrors and glass show;
 * and by reflected rays alone. What rays can't meet is sampled by all. They have the mean of path at any depth.
 */
static const koksma__integrator_flags path_balance = {PATH, .weight = KOKSMA__WEIGHT_BALANCE};
static const koksma__integrator_flags path_light = {PATH, .weight = KOKSMA__WEIGHT_ONE};
static const koksma__integrator_flags path_bsdf = {PATH, .weight = KOKSMA__WEIGHT_ZERO};

/* irradiance-cache: as distribution, with light between diffuse surfaces from the cache instead of ambient light. */
static const koksma__integrator_flags irradiance_cache = {.followed = KOKSMA__LOBE_SPECULAR | KOKSMA__LOBE_GLOSSY,
                                                          .areas = true,
                                                          .shadows = true,
                                                          .is_biased = true,
                                                          .open = koksma__irradiance_cache_open,
                                                          .close = koksma__irradiance_cache_close,
                                                          .indirect = koksma__irradiance_cache_indirect};

static const koksma_integrator rows[] = {
    {"utah", "local light and ambient light, no shadows", "phong1975 shirley1991", 0, &utah},
    {"whitted", "sharp shadows, mirrors and glass", "whitted1980", 6, &whitted},
    {"distribution", "soft shadows, lens, motion, glossy reflection", "cook1984 shirley1991", 6, &distribution},
    {"path", "path tracing with next-event estimation; caustics of visible lights only", "kajiya1986 veach1997", 16,
     &path},
    {"path-balance", "path with the balance heuristic in place of the power heuristic", "kajiya1986 veach1997", 16,
     &path_balance},
    {"path-light", "path with lights found by sampling them alone", "kajiya1986 veach1997", 16, &path_light},
    {"path-bsdf", "path with lights found by reflected rays alone", "kajiya1986 veach1997", 16, &path_bsdf},
    {"direct", "soft shadows of lights alone; mirrors and glass", "shirley1996", 6, &direct},
    {"ambient-occlusion", "how much of a white sky surfaces see; shapes only", "zhukov1998", 1, &ambient_occlusion},
    {"irradiance-cache", "diffuse light between surfaces, interpolated", "ward1988", 6, &irradiance_cache},
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
