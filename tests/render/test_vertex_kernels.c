/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Blocks of vertices of all kinds of materials: what their surfaces reflect of the lights, whose samples test_light_kinds
 * checks, and where they scatter (test_bsdfs): all instruction sets give the same bits, and misses get nothing.
 */
#include "lanes.h"
#include "render/one_image.h"

enum { ROUNDS = 200 };

static koksma_scene *every_kind(void)
{
    static const char text[] =
        "{'camera': {'eye': [0, 0, 5], 'target': [0, 0, 0], 'fov_deg': 20}, 'shapes': [],'materials': [{'name': 'a', "
        "'kind': 'lambert', 'albedo': [0.2, 0.5, 0.9]},{'name': 'b', 'kind': 'checker', 'albedos': [0.1, [0.9, 0.8, "
        "0.7]], 'period': 0.3, 'angle_deg': 20},{'name': 'c', 'kind': 'utah', 'albedo': [0.5, 0.4, 0.3], "
        "'reflectance': 0.4, 'exponent': 50},{'name': 'd', 'kind': 'phong', 'reflectance': [0.9, 0.8, 0.2], "
        "'exponent': 7},{'name': 'e', 'kind': 'ggx', 'reflectance': [0.9, 0.6, 0.2], 'roughness': 0.4},{'name': 'f', "
        "'kind': 'mirror', 'reflectance': 0.8},{'name': 'g', 'kind': 'dielectric', 'ior': 1.5}],'lights': [{'kind': "
        "'rectangle', 'centre': [0, 3, 0], 'facing': [0, 0, 0], 'half': [0.5, 1], 'radiance': [1, 2, 3]},{'kind': "
        "'disk', 'centre': [2, 2, 0], 'facing': [0, 0, 0], 'radius': 0.5, 'radiance': 3},{'kind': 'sphere', "
        "'centre': [-2, 2, 1], 'radius': 0.7, 'radiance': [3, 1, 1]},{'kind': 'point', 'centre': [0, 2, 2], "
        "'intensity': 3},{'kind': 'directional', 'direction': [1, -1, 0.2], 'irradiance': [1, 2, 2]},{'kind': "
        "'environment', 'radiance': [1, 0.5, 0.2]}]}";
    return scene_of(text);
}

/* A block of hits, one in eight a miss; rays that led there. */
static void random_hits(const koksma_scene *scene, koksma__rays *rays, koksma__hits *h)
{
    memset(h, 0, sizeof *h);
    memset(rays, 0, sizeof *rays);
    for (int i = 0; i < KOKSMA__BLOCK; i++) {
        float n[3];
        draw_direction(rays->d, i, uniform(0.5, 2));
        unit_vector(n);
        const float side = n[0] * rays->d[0][i] + n[1] * rays->d[1][i] + n[2] * rays->d[2][i] > 0 ? -1 : 1;
        set_lane(h->n, i, (const float[3]){side * n[0], side * n[1], side * n[2]});
        draw_lane(h->p, i, 1);
        h->u[i] = uniform(-1, 1);
        h->v[i] = uniform(-1, 1);
        h->back[i] = uniform(0, 1) < 0.5;
        h->primitive[i] = uniform(0, 8) < 1 ? -1 : i;
        h->material[i] = h->primitive[i] < 0 ? -1 : (int32_t)uniform(0, (double)scene->n_materials * 0.999);
    }
}

/* Every instruction set on the same block: returns the results of the first in outs[0]. */
typedef struct results {
    koksma__surfaces surfaces;
    koksma__beams beams;
    koksma__shadows shadows;
    koksma__directions directions;
    _Alignas(64) koksma__lanes reflected[3];
    int lit;
} results;

static void run(const koksma__batch_table *batch, const koksma__frame *f, const koksma__rays *rays,
                const koksma__hits *hits, const koksma__light_lanes *lights, const koksma__lanes u[5], bool goes_on,
                results *out)
{
    memset(out, 0, sizeof *out);
    out->surfaces.hits = hits;
    out->surfaces.materials = f->shading_materials;
    out->surfaces.table = &f->lane_materials;
    batch->surfaces(rays, KOKSMA__BLOCK, KOKSMA__BLOCK, &out->surfaces);
    batch->beams(lights, hits, u, KOKSMA__BLOCK, &out->beams);
    out->lit = batch->reflect(&out->surfaces, lights, &out->beams, f->flags->followed,
                              goes_on ? KOKSMA__WEIGHT_POWER : KOKSMA__WEIGHT_ONE, KOKSMA__BLOCK, &out->shadows,
                              out->reflected);
    batch->scatter(&out->surfaces, f->flags->followed, u + 2, KOKSMA__BLOCK, &out->directions);
}

/* Light `same` for all lanes, or each lane its own. */
static void check_block(const koksma__frame *f, int same, bool goes_on)
{
    static koksma__rays rays;
    static koksma__hits hits;
    static results found, other;
    static _Alignas(64) koksma__lanes u[5];
    koksma__light_lanes lights = {.lights = f->lights.lights, .same = same};
    random_hits(f->scene, &rays, &hits);
    for (int i = 0; i < KOKSMA__BLOCK; i++) {
        for (int k = 0; k < 5; k++) {
            u[k][i] = uniform(0, 0.9999999);
        }
        const int own = (int)uniform(0, (double)f->lights.n * 0.999);
        lights.light[i] = hits.primitive[i] < 0 ? -1 : same >= 0 ? same : own;
        lights.probability[i] = same >= 0 ? 1 : uniform(0.1, 1);
    }
    run(koksma__batch_find("ref"), f, &rays, &hits, &lights, u, goes_on, &found);
    for (int isa = 1; isa < 4; isa++) {
        const koksma__batch_table *batch = koksma__batch_find(isas[isa]);
        if (batch) {
            run(batch, f, &rays, &hits, &lights, u, goes_on, &other);
            assert_memory_equal(&found, &other, sizeof found);
        }
    }
    int lit = 0;
    for (int i = 0; i < KOKSMA__BLOCK; i++) {
        lit += found.shadows.light[i] > 0;
        if (hits.primitive[i] < 0) {
            assert_int_equal(found.surfaces.form[i], KOKSMA__UNLIT);
            assert_false(found.shadows.light[i] > 0 || found.directions.kept[i]);
        }
    }
    assert_int_equal(found.lit, lit);
}

TEST_CASE(every_instruction_set_gives_the_same_bits)
{
    koksma_scene *scene = every_kind();
    koksma_render_options options;
    koksma__frame frame;
    koksma_render_options_init(&options, scene);
    options.integrator = koksma_integrator_find("path");
    assert_ok(koksma__frame_open(scene, &options, NULL, &frame));
    for (int round = 0; round < ROUNDS; round++) {
        for (int light = -1; light < (int)frame.lights.n; light++) {
            check_block(&frame, light, round % 2 == 0);
        }
    }
    koksma__frame_close(&frame);
    koksma_scene_close(scene);
}
