/* SPDX-License-Identifier: Apache-2.0 */
/* Analytic shapes: no tree, every shape against every block of rays. */
#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "render/intersect.h"

typedef struct shapes {
    koksma__batch_shapes all;
    const koksma__batch_table *batch;
    koksma__batch_shape list[];
} shapes;

static int closest(const koksma__geometry *geometry, const koksma__rays *rays, int n, koksma__hits *hits)
{
    const shapes *s = geometry->made;
    return s->batch->closest(&s->all, rays, n, hits);
}

static void occlude(const koksma__geometry *geometry, const koksma__hits *hits, int n, koksma__shadows *shadows)
{
    const shapes *s = geometry->made;
    s->batch->occlude(&s->all, hits, n, shadows);
}

static void release(koksma__geometry *geometry)
{
    free(geometry->made);
    *geometry = (koksma__geometry){0};
}

static koksma__batch_shape in_floats(const koksma__shape *from)
{
    koksma__batch_shape s = {.kind = (int)from->kind, .material = from->material};
    for (int k = 0; k < 3; k++) {
        s.centre[k] = (float)from->centre[k];
        s.normal[k] = (float)from->normal[k];
        s.axis_u[k] = (float)from->axis_u[k];
        s.axis_v[k] = (float)from->axis_v[k];
    }
    const bool is_round = from->kind == KOKSMA__SHAPE_DISK || from->kind == KOKSMA__SHAPE_SPHERE;
    s.half_u = (float)from->half[0];
    s.half_v = (float)from->half[1];
    s.radius2 = is_round ? (float)(from->half[0] * from->half[0]) : INFINITY;
    s.inverse_radius = (float)(1 / from->half[0]);
    return s;
}

koksma_status koksma__accel_shapes(const koksma_scene *scene, koksma__geometry *out)
{
    const size_t size = sizeof(shapes) + scene->n_shapes * sizeof(koksma__batch_shape);
    shapes *s = malloc(size);
    *out = (koksma__geometry){0};
    if (!s) {
        return koksma__fail_memory(size);
    }
    for (size_t i = 0; i < scene->n_shapes; i++) {
        s->list[i] = in_floats(&scene->shapes[i]);
    }
    s->all = (koksma__batch_shapes){scene->n_shapes, s->list};
    s->batch = koksma__batch();
    *out = (koksma__geometry){s, closest, occlude, release};
    return KOKSMA_OK;
}
