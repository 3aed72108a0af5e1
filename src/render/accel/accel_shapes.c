/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The geometry of scenes with only analytic shapes: every shape is intersected with every block of rays, or with those that
 * meet its bundle. A flat shape casts no shadow if all other shapes and all lights lie on one side of its plane, because no
 * segment between two points on that side crosses the plane; shadow rays therefore skip, for example, a floor. In a
 * scene with a medium no shape is skipped, because shadow rays may start at any point of the medium.
 */
#include "render/accel/accel.h"

#include <math.h>
#include <stdlib.h>

#include "core/capacity.h"
#include "core/status.h"
#include "core/vector.h"
#include "render/lights/lights.h"
#include "render/shapes/shapes.h"

typedef struct shapes {
    const koksma_scene *scene;
    koksma__batch_shapes all, occluders;
    const koksma__batch_table *batch;
    koksma__batch_shape *list; /* all, then the occluders; so the arrays below */
    koksma__batch_bundle *bundles;
    uint32_t *order;
} shapes;

static int closest(const koksma__geometry *geometry, const koksma__rays *rays, const int32_t *from, int n,
                   koksma__hits *hits)
{
    const shapes *s = geometry->made;
    return s->batch->closest(&s->all, rays, from, n, hits);
}

static void occlude(const koksma__geometry *geometry, const koksma__hits *hits, int n, koksma__shadows *shadows)
{
    const shapes *s = geometry->made;
    s->batch->occlude(&s->occluders, hits, n, shadows);
}

static int light_of(const koksma__geometry *geometry, int32_t primitive)
{
    const shapes *s = geometry->made;
    return s->scene->shapes[primitive].light;
}

static void release(koksma__geometry *geometry)
{
    shapes *s = geometry->made;
    KOKSMA__FREE(s->list, s->bundles, s->order, s);
    *geometry = (koksma__geometry){0};
}

/* How far the shape or rectangle reaches below the plane of `flat`, where `sign` says which side is above; negative
   if it lies above the plane. */
static double depth(const koksma__shape *flat, double sign, const double centre[3], const double reach_u[3],
                    const double reach_v[3], double radius)
{
    double offset[3];
    koksma__subtract(centre, flat->centre, offset);
    return radius + fabs(koksma__dot(reach_u, flat->normal)) + fabs(koksma__dot(reach_v, flat->normal)) -
           sign * koksma__dot(offset, flat->normal);
}

static double depth_of_rectangle(const koksma__shape *flat, double sign, const double centre[3], const double u[3],
                                 const double v[3], const double half[2])
{
    double reach_u[3], reach_v[3];
    for (int k = 0; k < 3; k++) {
        reach_u[k] = half[0] * u[k];
        reach_v[k] = half[1] * v[k];
    }
    return depth(flat, sign, centre, reach_u, reach_v, 0);
}

static bool all_on_one_side(const koksma_scene *scene, const koksma__shape *flat, double sign)
{
    static const double none[3] = {0, 0, 0};
    const double tiny = 1e-9;
    bool all = flat->type->is_flat && !scene->moves && !scene->medium.is_there;
    for (size_t i = 0; all && i < scene->n_shapes; i++) {
        const koksma__shape *s = &scene->shapes[i];
        const double radius = s->type->radius ? s->type->radius(s) : s->half[0];
        all =
            s == flat || (s->type->is_flat ? depth_of_rectangle(flat, sign, s->centre, s->axis_u, s->axis_v, s->half)
                                           : depth(flat, sign, s->centre, none, none, radius)) < tiny;
    }
    for (size_t i = 0; all && i < scene->n_placements; i++) {
        const koksma__placement *p = &scene->placements[i];
        double middle[3], reach = 0;
        for (int k = 0; k < 3; k++) {
            middle[k] = (p->low[k] + p->high[k]) / 2;
            reach += fabs(flat->normal[k]) * (p->high[k] - p->low[k]) / 2;
        }
        all = depth(flat, sign, middle, none, none, reach) < tiny;
    }
    for (size_t i = 0; all && i < scene->n_lights; i++) {
        const koksma__light *l = &scene->lights[i];
        all = l->kind->is_flat ? depth_of_rectangle(flat, sign, l->centre, l->axis_u, l->axis_v, l->half) < tiny
                               : l->kind->distance == KOKSMA__LIGHT_NEAR &&
                                     depth(flat, sign, l->centre, none, none, l->half[0]) < tiny;
    }
    return all;
}

static koksma_status fill(shapes *s)
{
    const koksma_scene *scene = s->scene;
    const size_t n = scene->n_shapes;
    s->all = (koksma__batch_shapes){.n = n, .shapes = s->list};
    s->occluders = (koksma__batch_shapes){.shapes = s->list + n};
    for (size_t i = 0; i < n; i++) {
        const koksma__shape *shape = &scene->shapes[i];
        s->list[i] = koksma__batch_shape_of(shape, (int32_t)i);
        if (!all_on_one_side(scene, shape, 1) && !all_on_one_side(scene, shape, -1)) {
            s->list[n + s->occluders.n++] = s->list[i];
        }
    }
    KOKSMA__TRY(koksma__bundle(&s->all, s->bundles, s->order));
    return koksma__bundle(&s->occluders, s->bundles + n, s->order + n);
}

koksma_status koksma__accel_shapes(const koksma_scene *scene, koksma__geometry *out)
{
    const size_t n = 2 * scene->n_shapes + 1;
    shapes *s = calloc(1, sizeof *s);
    *out = (koksma__geometry){0};
    KOKSMA__REQUIRE_MEMORY(s, sizeof *s);
    *out = (koksma__geometry){s, &s->all, &s->occluders, closest, occlude, light_of, NULL, release};
    s->scene = scene;
    s->batch = koksma__batch();
    s->list = malloc(n * sizeof *s->list);
    s->bundles = malloc(n * sizeof *s->bundles);
    s->order = malloc(n * sizeof *s->order);
    const koksma_status status =
        s->list && s->bundles && s->order ? fill(s) : koksma__fail_memory(n * sizeof *s->list);
    if (status) {
        release(out);
    }
    return status;
}
