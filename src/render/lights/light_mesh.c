/* SPDX-License-Identifier: Apache-2.0 */
/*
 * mesh: a Lambert emitter that is a placed mesh, made by "emission" of a shape. A triangle is chosen in proportion
 * to its area (a binary search in the sums, O(log n)), then a position on it (Turk 1990), so that positions are
 * uniform over the whole area. A shadow ray ends before the triangle by 2^-20 of its largest coordinate (rays that
 * leave a triangle start as far off it, batch_triangles.c); otherwise rounding could make the ray hit the light that
 * it is aimed at.
 */
#include <stdlib.h>

#include "render/lights/surface_lights.h"

typedef struct mesh_light {
    size_t n;
    double *cdf; /* of the areas; n + 1 */
    float corners[][9];
} mesh_light;

/* The triangles as they stand, and the sums of their areas. */
static void fill(const koksma__mesh *mesh, const koksma__placement *placement, mesh_light *m)
{
    for (size_t t = 0; t < m->n; t++) {
        m->cdf[t + 1] = m->cdf[t] + koksma__placed_triangle(mesh, placement->matrix, t, m->corners[t]);
    }
}

static koksma_status open_light(const koksma_scene *scene, const koksma__light *from, koksma__shading_light *light)
{
    const koksma__placement *placement = &scene->placements[from->placement];
    const koksma__mesh *mesh = &scene->meshes[placement->mesh];
    mesh_light *m = calloc(1, sizeof *m + mesh->n_triangles * sizeof m->corners[0]);
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
        light->centre[k] = (float)((placement->high[k] + placement->low[k]) / 2);
        square += half * half;
    }
    light->data = m;
    light->half[0] = light->half[1] = (float)sqrt(square);
    koksma__emitter_open(light, cdf[m->n], light->half[0]);
    return light->area > 0 ? KOKSMA_OK : koksma__fail(KOKSMA_MALFORMED, "a luminous mesh without area");
}

static void close_light(void *data)
{
    mesh_light *m = data;
    free(m->cdf);
    free(m);
}

static bool sample(const koksma__shading_light *light, const float p[3], const float u[2], koksma__beam *out)
{
    const mesh_light *m = light->data;
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
    out->pdf = square * length / (at_light * light->area);
    for (int k = 0; k < 3; k++) {
        out->w[k] = out->d[k] / length;
        out->value[k] = light->radiance[k] / out->pdf;
        out->d[k] += 0x1p-20f * largest * n[k];
    }
    return true;
}

/* A convex body shows a quarter of its surface in the mean (Cauchy). */
static bool centre(const koksma__shading_light *light, const float p[3], koksma__beam *out)
{
    if (!koksma__point_beam(light, p, light->area / 4, out)) {
        return false;
    }
    for (int k = 0; k < 3; k++) { /* ends before the mesh itself */
        const float rest = out->d[k] - light->half[0] * out->w[k];
        out->d[k] = rest * out->w[k] > 0 ? rest : 1e-3f * out->d[k];
    }
    return true;
}

const koksma__light_kind koksma__light_mesh = {
    .kind = {.name = "mesh", .title = "a luminous mesh", .cite = "turk1990", .is_implied = true},
    .open = open_light,
    .close = close_light,
    .sample = sample,
    .centre = centre,
    .pdf = koksma__area_pdf,
};
