/* SPDX-License-Identifier: Apache-2.0 */
/* Luminous meshes: a triangle in proportion to its area, then a place on it (Turk 1990), so all places are as likely.
   A shadow ray ends a little before the triangle, 2^-20 of its largest coordinate, by which batch_triangles.c also
   starts: rounding would else let it meet the luminaire that it goes to. */
#include <stdlib.h>

#include "core/status.h"
#include "render/lights/lights.h"
#include "render/vector3.h"

struct koksma__lamp_mesh {
    size_t n;
    double *cdf; /* of the areas; n + 1 */
    float corners[][9];
};

/* The triangles as they stand, and the sums of their areas. */
static void fill(const koksma__mesh *mesh, const koksma__placement *placement, koksma__lamp_mesh *m)
{
    for (size_t t = 0; t < m->n; t++) {
        m->cdf[t + 1] = m->cdf[t] + koksma__placed_triangle(mesh, placement->matrix, t, m->corners[t]);
    }
}

koksma_status koksma__lamp_mesh_open(const koksma_scene *scene, const koksma__light *light, koksma__lamp *lamp)
{
    const koksma__placement *placement = &scene->placements[light->placement];
    const koksma__mesh *mesh = &scene->meshes[placement->mesh];
    koksma__lamp_mesh *m = calloc(1, sizeof *m + mesh->n_triangles * sizeof m->corners[0]);
    double *cdf = calloc(mesh->n_triangles + 1, sizeof *cdf);
    double square = 0;
    if (!m || !cdf) {
        free(m);
        free(cdf);
        return koksma__fail_memory(mesh->n_triangles * sizeof m->corners[0]);
    }
    m->n = mesh->n_triangles;
    m->cdf = cdf;
    fill(mesh, placement, m);
    for (int k = 0; k < 3; k++) {
        const double half = (placement->high[k] - placement->low[k]) / 2;
        lamp->centre[k] = (float)((placement->high[k] + placement->low[k]) / 2);
        square += half * half;
    }
    lamp->mesh = m;
    lamp->area = (float)cdf[m->n];
    lamp->half[0] = lamp->half[1] = (float)sqrt(square);
    lamp->power = koksma__luminance3(lamp->radiance) * lamp->area / KOKSMA__PI_F;
    return lamp->area > 0 ? KOKSMA_OK : koksma__fail(KOKSMA_MALFORMED, "a luminous mesh without area");
}

void koksma__lamp_mesh_close(koksma__lamp_mesh *m)
{
    if (m) {
        free(m->cdf);
        free(m);
    }
}

bool koksma__lamp_mesh_sample(const koksma__lamp *lamp, const float p[3], const float u[2], koksma__beam *out)
{
    const koksma__lamp_mesh *m = lamp->mesh;
    const double target = (double)u[0] * m->cdf[m->n];
    size_t low = 0, high = m->n;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        *(m->cdf[middle] <= target ? &low : &high) = middle;
    }
    const double size = m->cdf[low + 1] - m->cdf[low];
    const float *c = m->corners[low], root = sqrtf((float)(size > 0 ? (target - m->cdf[low]) / size : 0));
    const float b = 1 - root, a = u[1] * root, rest = 1 - a - b;
    float e[3], f[3], n[3], largest = 0;
    for (int k = 0; k < 9; k++) {
        largest = fmaxf(largest, fabsf(c[k]));
    }
    for (int k = 0; k < 3; k++) {
        e[k] = c[3 + k] - c[k];
        f[k] = c[6 + k] - c[k];
        out->d[k] = rest * c[k] + a * c[3 + k] + b * c[6 + k] - p[k];
    }
    for (int k = 0; k < 3; k++) {
        n[k] = e[(k + 1) % 3] * f[(k + 2) % 3] - e[(k + 2) % 3] * f[(k + 1) % 3];
    }
    const float square = koksma__dot3(out->d, out->d), length = sqrtf(square);
    koksma__unit3(n);
    const float at_light = -koksma__dot3(n, out->d);
    if (!(at_light > 0)) {
        return false; /* from behind, or no triangle at all */
    }
    out->density = square * length / (at_light * lamp->area);
    for (int k = 0; k < 3; k++) {
        out->w[k] = out->d[k] / length;
        out->value[k] = lamp->radiance[k] / out->density;
        out->d[k] += 0x1p-20f * largest * n[k];
    }
    return true;
}
