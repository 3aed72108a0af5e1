/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The homogeneous medium in the wavefront tracer. Between the stages `closest` and `emission` a distance is sampled
 * along each ray (batch_medium.c): it either reaches the surface that it hits, or is scattered before. A block can
 * contain both kinds of lanes: a point of the medium is represented as a surface whose material is the phase
 * function, so that lights and directions are sampled there as on surfaces. Shadow rays are attenuated by the
 * transmittance.
 */
#include "render/pipelines/pipelines.h"

#include "render/medium.h"

void koksma__wavefront_travel(const koksma__frame *frame, const float *pairs, koksma__paths *paths,
                              koksma__vertices *v)
{
    _Alignas(64) koksma__lanes u;
    frame->batch->pairs(pairs, paths->sample, v->whole, u, NULL);
    frame->batch->travel(&frame->scene->medium, u, (int32_t)frame->scene->n_materials, v->whole, paths, &v->hits);
}

void koksma__wavefront_detach(const koksma_scene *scene, koksma__vertices *v)
{
    for (int i = 0; scene->medium.is_there && i < v->n; i++) {
        v->hits.primitive[i] = v->hits.material[i] == (int32_t)scene->n_materials ? -1 : v->hits.primitive[i];
    }
}

void koksma__wavefront_attenuate(const koksma__frame *frame, const koksma__vertices *v,
                                 const koksma__shadows *shadows, koksma__lanes light[3])
{
    if (frame->scene->medium.is_there) {
        frame->batch->attenuate(&frame->scene->medium, &v->hits, shadows, v->whole, light);
    }
}
