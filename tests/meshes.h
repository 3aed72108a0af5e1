/* SPDX-License-Identifier: Apache-2.0 */
/* What tests of mesh files begin with. */
#ifndef KOKSMA_TESTS_MESHES_H
#define KOKSMA_TESTS_MESHES_H

#include <koksma/render.h>

#include "test.h"

/* Skips a test that needs Embree where the build is without it. */
static inline void need_meshes(void)
{
    if (!koksma_mesh_tracer()) {
        skip();
    }
}

#endif
