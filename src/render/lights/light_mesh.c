/* SPDX-License-Identifier: Apache-2.0 */
/*
 * mesh: a placed mesh that is a Lambert emitter, because its shape has the field "emission". A triangle is chosen in
 * proportion to its area (a binary search in the sums, O(log n)), then a position on it (Turk 1990), so that
 * positions are uniform over the whole area. With an image of the emission, the weight of a triangle is its emission,
 * estimated at 16 positions, plus a twentieth of the mean emission, so that every emitting triangle can be chosen;
 * the image is looked up at the position chosen. A two-sided mesh emits the same from both sides. A shadow ray ends
 * before the triangle by 2^-20 of the position's largest coordinate (rays that leave a triangle start at the same
 * distance from it, batch_triangles.c); otherwise rounding could make the ray hit the light at which it is aimed.
 */
#include <stdlib.h>

#include "core/capacity.h"
#include "render/lights/beams.h"
#include "render/scene_images.h"

/* Copies the triangles in world coordinates and sums their areas. */
static void fill(const koksma__mesh *mesh, const koksma__placement *placement, koksma__mesh_light *m)
{
    for (size_t t = 0; t < m->n; t++) {
        koksma__mesh_light_face *face = &m->faces[t];
        const float *c = face->corners;
        float e[3], f[3];
        m->cdf[t + 1] = m->cdf[t] + koksma__placed_triangle(mesh, placement->matrix, t, face->corners);
        for (int k = 0; k < 3; k++) {
            e[k] = c[3 + k] - c[k];
            f[k] = c[6 + k] - c[k];
        }
        for (int k = 0; k < 3; k++) {
            face->normal[k] = e[(k + 1) % 3] * f[(k + 2) % 3] - e[(k + 2) % 3] * f[(k + 1) % 3];
        }
        for (int k = 0; k < 9; k++) {
            face->largest = fmaxf(face->largest, fabsf(c[k]));
        }
        koksma__unit3(face->normal);
    }
}

/* Weighs the triangles by their emission; *mean is the luminance of the image, averaged over the area. Errors:
   MEMORY. */
static koksma_status weigh(koksma__mesh_light *m, double *mean)
{
    const double area = m->cdf[m->n];
    double sum = 0;
    m->densities = calloc(m->n + 1, sizeof *m->densities);
    KOKSMA__REQUIRE_MEMORY(m->densities, m->n * sizeof *m->densities);
    for (size_t t = 0; t < m->n; t++) {
        double luminance = 0;
        for (int i = 0; i < 16; i++) { /* the centroids of 16 congruent triangles */
            float rgb[3], a = (float)(i / 4) / 4 + 1 / 12.0f, b = (float)(i % 4) / 4 + 1 / 12.0f;
            if (a + b > 1) {
                a = 1 - a;
                b = 1 - b;
            }
            koksma__mesh_glow(m, t, a, b, rgb);
            luminance += (double)koksma__luminance3(rgb) / 16;
        }
        m->densities[t] = (float)luminance;
        sum += luminance * (m->cdf[t + 1] - m->cdf[t]);
    }
    *mean = sum / area;
    double before = 0, total = 0;
    for (size_t t = 0; t < m->n; t++) {
        const double size = m->cdf[t + 1] - before, each = (double)m->densities[t] + 0.05 * *mean + 1e-6;
        before = m->cdf[t + 1];
        total += each * size;
        m->densities[t] = (float)each;
        m->cdf[t + 1] = total;
    }
    for (size_t t = 0; t < m->n; t++) {
        m->densities[t] = (float)((double)m->densities[t] / total);
    }
    return KOKSMA_OK;
}

static koksma_status open_light(const koksma_scene *scene, const koksma__light *from, koksma__shading_light *light)
{
    const koksma__placement *placement = &scene->placements[from->placement];
    const koksma__mesh *mesh = &scene->meshes[placement->mesh];
    koksma__mesh_light *m = calloc(1, sizeof *m + mesh->n_triangles * sizeof m->faces[0]);
    double *cdf = calloc(mesh->n_triangles + 1, sizeof *cdf);
    double square = 0;
    if (!m || !cdf) {
        free(m);
        free(cdf);
        return koksma__fail_memory(mesh->n_triangles * sizeof m->faces[0]);
    }
    m->n = mesh->n_triangles;
    m->cdf = cdf;
    m->mesh = mesh;
    light->data = m;
    fill(mesh, placement, m);
    const double area = cdf[m->n];
    const koksma__map *map =
        placement->material < 0 ? NULL : &scene->materials[placement->material].maps[KOKSMA__MAP_EMISSION];
    double mean = 1;
    if (map && map->image && mesh->uvs && area > 0) {
        m->map = map;
        KOKSMA__TRY(weigh(m, &mean));
    }
    for (int k = 0; k < 3; k++) {
        const double half = (placement->high[k] - placement->low[k]) / 2;
        light->centre[k] = (float)((placement->high[k] + placement->low[k]) / 2);
        square += half * half;
    }
    light->half[0] = light->half[1] = (float)sqrt(square);
    light->two_sided = from->two_sided;
    koksma__emitter_open(light, area, light->half[0]);
    light->power *= (float)mean * (light->two_sided ? 2 : 1);
    return light->area > 0 ? KOKSMA_OK : koksma__fail(KOKSMA_MALFORMED, "a mesh that emits light has no area");
}

static void close_light(void *data)
{
    koksma__mesh_light *m = data;
    KOKSMA__FREE(m->cdf, m->densities, m);
}

static float met(const koksma__shading_light *light, uint32_t triangle, const float uv[2], float radiance[3])
{
    const koksma__mesh_light *m = light->data;
    float glow[3] = {1, 1, 1};
    if (m->map) {
        koksma__texture(m->map->image, &m->map->mapping, uv[0], uv[1], KOKSMA__BRIGHTEST, glow);
    }
    for (int k = 0; k < 3; k++) {
        radiance[k] = light->radiance[k] * glow[k];
    }
    return m->map ? m->densities[triangle] : 1 / light->area;
}

/* On average over directions, the projected area of a convex body is a quarter of its surface (Cauchy), and that of a
   two-sided sheet half of its area. */
static bool centre(const koksma__shading_light *light, const float p[3], koksma__beam *out)
{
    if (!koksma__point_beam(light, p, light->area / (light->two_sided ? 2 : 4), out)) {
        return false;
    }
    for (int k = 0; k < 3; k++) { /* end the shadow ray outside of the sphere around the mesh */
        const float rest = out->d[k] - light->half[0] * out->w[k];
        out->d[k] = rest * out->w[k] > 0 ? rest : 1e-3f * out->d[k];
    }
    return true;
}

const koksma__light_kind koksma__light_mesh = {
    .kind = {.name = "mesh", .title = "a luminous mesh", .cite = "turk1990", .is_implied = true},
    .form = KOKSMA__BEAMS_MESH,
    .open = open_light,
    .close = close_light,
    .centre = centre,
    .pdf = koksma__area_pdf,
    .met = met,
};
