/* SPDX-License-Identifier: Apache-2.0 */
/* Scenes with meshes are traced by the module koksma-embree.so, which this file loads for the first such scene. */
#include "render/accel/accel.h"

#include "meshes/mesh.h"
#include "modules/module.h"

static const koksma__mesh_host host = {koksma__accel_shapes, koksma__batch, koksma__normal_matrix,
                                       koksma__placement_at, koksma__matrix_mirrors};
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
