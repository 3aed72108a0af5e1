/* SPDX-License-Identifier: Apache-2.0 */
/* Scenes with meshes are traced by the module koksma-embree.so, which this file loads for the first such scene. */
#include "render/accel/accel.h"

#include <math.h>

#include "core/vector.h"
#include "meshes/mesh.h"
#include "modules/module.h"

bool koksma__face_of(const float a[3], const float b[3], const float c[3], koksma__batch_face *out)
{
    double edges[2][3], normal[3], across[2][3], largest = 0, steepest = 0;
    for (int k = 0; k < 3; k++) {
        edges[0][k] = (double)b[k] - (double)a[k];
        edges[1][k] = (double)c[k] - (double)a[k];
        largest = fmax(largest, fmax(fabs((double)a[k]), fmax(fabs((double)b[k]), fabs((double)c[k]))));
    }
    koksma__cross(edges[0], edges[1], normal);
    koksma__cross(edges[1], normal, across[0]);
    koksma__cross(normal, edges[0], across[1]);
    const double square = koksma__dot(normal, normal);
    *out = (koksma__batch_face){0};
    for (int k = 0; square > 0 && k < 3; k++) {
        const double u = across[0][k] / square, v = across[1][k] / square;
        out->corner[k] = a[k];
        out->normal[k] = (float)(normal[k] / sqrt(square));
        out->across[0][k] = (float)u;
        out->across[1][k] = (float)v;
        steepest = fmax(steepest, fabs(u) + fabs(v));
    }
    out->slack = (float)(0x1p-22 * steepest);
    out->size = (float)largest;
    return square > 0;
}

static const koksma__mesh_host host = {koksma__accel_shapes, koksma__batch,          koksma__normal_matrix,
                                       koksma__placement_at, koksma__matrix_mirrors, koksma__face_of};
static const koksma__module module = {"embree", "Embree", {koksma__fail, koksma__fail_memory, &host}};

const char *koksma_mesh_tracer(void)
{
    const void *functions;
    return koksma__module_load(&module, &functions) ? NULL : ((const koksma__mesh_functions *)functions)->tracer();
}

koksma_status koksma__accel_meshes(const koksma_scene *scene, koksma__geometry *out)
{
    const void *functions;
    const koksma_status status = koksma__module_load(&module, &functions);
    *out = (koksma__geometry){0};
    return status ? status : ((const koksma__mesh_functions *)functions)->make(scene, out);
}
