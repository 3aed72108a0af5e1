/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The homogeneous medium in the wavefront tracer. Between the stages `closest` and `emission` a distance is sampled
 * along each ray (medium.c): the ray either reaches the surface that it hits, or is scattered before. A block can
 * contain both kinds of lanes: a point of the medium is represented as a surface whose material is the phase
 * function, so that lights and directions are sampled there as on surfaces. Shadow rays are attenuated by the
 * transmittance.
 */
#include "render/pipelines/pipelines.h"

#include <math.h>

#include "render/medium.h"

void koksma__wavefront_travel(const koksma_scene *scene, const float *pairs, koksma__paths *paths,
                              koksma__vertices *v)
{
    koksma__hits *h = &v->hits;
    const koksma__rays *r = &paths->rays;
    for (int i = 0; i < v->n; i++) {
        const float o[3] = {r->ox[i], r->oy[i], r->oz[i]}, d[3] = {r->dx[i], r->dy[i], r->dz[i]};
        const double end = h->primitive[i] < 0 ? (double)INFINITY : (double)h->t[i];
        const float beta[3] = {paths->beta[0][i], paths->beta[1][i], paths->beta[2][i]};
        float t, weight[3];
        const bool scatters =
            koksma__medium_sample(&scene->medium, o, d, end, pairs[2 * (size_t)paths->sample[i]], beta, &t, weight);
        for (int k = 0; k < 3; k++) {
            paths->beta[k][i] *= weight[k];
        }
        if (scatters) {
            h->t[i] = t;
            h->px[i] = o[0] + t * d[0];
            h->py[i] = o[1] + t * d[1];
            h->pz[i] = o[2] + t * d[2];
            h->nx[i] = h->ny[i] = h->nz[i] = h->u[i] = h->v[i] = 0;
            h->back[i] = 1; /* counts as a back, because the back of a surface emits no light */
            h->primitive[i] = 0;
            h->material[i] = (int32_t)scene->n_materials;
        }
    }
}

void koksma__wavefront_detach(const koksma_scene *scene, koksma__vertices *v)
{
    for (int i = 0; scene->medium.is_there && i < v->n; i++) {
        v->hits.primitive[i] = v->hits.material[i] == (int32_t)scene->n_materials ? -1 : v->hits.primitive[i];
    }
}

void koksma__wavefront_attenuate(const koksma_scene *scene, const koksma__vertices *v, const koksma__shadows *shadows,
                                 koksma__lanes light[3])
{
    for (int i = 0; scene->medium.is_there && i < v->n; i++) {
        const float p[3] = {v->hits.px[i], v->hits.py[i], v->hits.pz[i]};
        const float d[3] = {shadows->dx[i], shadows->dy[i], shadows->dz[i]};
        float passed[3];
        if (!(shadows->light[i] > 0)) {
            continue;
        }
        koksma__medium_transmittance(&scene->medium, p, d, 1, passed);
        for (int k = 0; k < 3; k++) {
            light[k][i] *= passed[k];
        }
    }
}
