/* SPDX-License-Identifier: Apache-2.0 */
/* A part of accel_embree.c, once for each width of packets: WIDTH rays at once. No include guard: it is included
   again, with another WIDTH. */
#define PACKET(name) PASTE(PASTE(name, _), WIDTH)

/* Rays start .. start + WIDTH - 1 of the block that are alive. */
static void PACKET(intersect)(const embree *e, const starts *s, const koksma__rays *rays, int start, bool coherent,
                              koksma__hits *hits)
{
    _Alignas(64) int valid[WIDTH];
    struct PASTE(RTCRayHit, WIDTH) packet;
    for (int i = 0; i < WIDTH; i++) {
        valid[i] = -1;
        packet.ray.tnear[i] = 0;
        packet.ray.mask[i] = ~0u;
        packet.ray.id[i] = packet.ray.flags[i] = 0;
        packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        packet.ray.tfar[i] = hits->t[start + i];
        packet.ray.time[i] = e->moves ? rays->time[start + i] : 0;
        packet.ray.dir_x[i] = rays->dx[start + i];
        packet.ray.dir_y[i] = rays->dy[start + i];
        packet.ray.dir_z[i] = rays->dz[start + i];
        packet.ray.org_x[i] = s->x[start + i];
        packet.ray.org_y[i] = s->y[start + i];
        packet.ray.org_z[i] = s->z[start + i];
    }
    CONTEXT(coherent);
    INTERSECT(WIDTH, valid, e, &packet);
    for (int i = 0; i < WIDTH; i++) {
        if (packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) {
            const uint32_t instance = packet.hit.instID[0][i];
            const uint32_t number = instance == RTC_INVALID_GEOMETRY_ID ? packet.hit.geomID[i] : instance;
            hits->t[start + i] = packet.ray.tfar[i];
            finish(&e->parts[number], packet.hit.primID[i], packet.hit.u[i], packet.hit.v[i], rays, start + i, hits);
        }
    }
}

static void PACKET(shade)(const embree *e, const starts *s, const koksma__hits *hits, int start,
                          koksma__shadows *shadows)
{
    _Alignas(64) int valid[WIDTH];
    struct PASTE(RTCRay, WIDTH) packet;
    int any = 0;
    for (int i = 0; i < WIDTH; i++) {
        valid[i] = shadows->light[start + i] > 0 ? -1 : 0;
        any |= valid[i];
        packet.tnear[i] = 0;
        packet.tfar[i] = SHADOW_END;
        packet.mask[i] = ~0u;
        packet.id[i] = packet.flags[i] = 0;
        packet.time[i] = e->moves ? hits->time[start + i] : 0;
        packet.dir_x[i] = shadows->dx[start + i];
        packet.dir_y[i] = shadows->dy[start + i];
        packet.dir_z[i] = shadows->dz[start + i];
        packet.org_x[i] = s->x[start + i];
        packet.org_y[i] = s->y[start + i];
        packet.org_z[i] = s->z[start + i];
    }
    if (any) {
        CONTEXT(false);
        OCCLUDED(WIDTH, valid, e, &packet);
        for (int i = 0; i < WIDTH; i++) {
            shadows->light[start + i] = valid[i] && packet.tfar[i] < 0 ? 0 : shadows->light[start + i];
        }
    }
}

#undef PACKET
