/* SPDX-License-Identifier: Apache-2.0 */
/* Counts the memory that a scene of another renderer takes, and refuses what is too much, and transforms
   of textures that are too large. */
#include "scene/import_limits.h"

#include <math.h>

#include "render/fields.h"

enum { MOST_HELD = 384 << 20 };

koksma_status koksma__import_hold(koksma__import *im, koksma__text_place place, uint64_t bytes)
{
    im->held += bytes;
    return im->held <= MOST_HELD
               ? KOKSMA_OK
               : koksma__import_fail(
                     place,
                     "what the texts of the scene describe up to here takes more than %d MiB of memory; "
                     "meshes in files of their own do not count",
                     MOST_HELD >> 20);
}

koksma_status koksma__import_hold_mesh(koksma__import *im, koksma__text_place place, const koksma__mesh *mesh)
{
    const size_t numbers = 3 + (mesh->normals ? 3 : 0) + (mesh->uvs ? 2 : 0);
    return koksma__import_hold(
        im, place, 2 * sizeof *mesh + sizeof(float) * (numbers * mesh->n_vertices + 3 * mesh->n_triangles));
}

koksma_status koksma__import_check_uv(koksma__text_place place, const double *values, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        if (!(fabs(values[i]) <= FAR)) {
            return koksma__import_fail(place, "a texture is scaled or moved by %g; the most is 1e6", values[i]);
        }
    }
    return KOKSMA_OK;
}
