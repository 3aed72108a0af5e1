/* SPDX-License-Identifier: Apache-2.0 */
/* A part of accel_embree.c, once for each width of packets: WIDTH rays at once. No include guard: it is included
   again, with another WIDTH. */
#define PACKET(name) PASTE(PASTE(name, _), WIDTH)

/* Rays start .. start + WIDTH - 1 of the block; on gets the parts (as primitives) and triangles that are closer than
   what hits has, and the return value is their number. */
static int PACKET(intersect)(const embree *e, const starts *s, const koksma__rays *rays, int start, bool coherent,
                             const koksma__hits *hits, koksma__landings *on)
{
    _Alignas(64) int valid[WIDTH];
    struct PASTE(RTCRayHit, WIDTH) packet;
    int landed = 0;
    memcpy(packet.ray.org_x, s->x + start, sizeof packet.ray.org_x);
    memcpy(packet.ray.org_y, s->y + start, sizeof packet.ray.org_y);
    memcpy(packet.ray.org_z, s->z + start, sizeof packet.ray.org_z);
    memcpy(packet.ray.dir_x, rays->dx + start, sizeof packet.ray.dir_x);
    memcpy(packet.ray.dir_y, rays->dy + start, sizeof packet.ray.dir_y);
    memcpy(packet.ray.dir_z, rays->dz + start, sizeof packet.ray.dir_z);
    memcpy(packet.ray.tfar, hits->t + start, sizeof packet.ray.tfar);
    for (int i = 0; i < WIDTH; i++) {
        valid[i] = -1;
        packet.ray.tnear[i] = 0;
        packet.ray.mask[i] = ~0u;
        packet.ray.id[i] = packet.ray.flags[i] = 0;
        packet.ray.time[i] = e->moves ? rays->time[start + i] : 0;
        packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    CONTEXT(coherent);
    INTERSECT(WIDTH, valid, e, &packet);
    memcpy(on->t + start, packet.ray.tfar, sizeof packet.ray.tfar);
    memcpy(on->u + start, packet.hit.u, sizeof packet.hit.u);
    memcpy(on->v + start, packet.hit.v, sizeof packet.hit.v);
    memcpy(on->triangle + start, packet.hit.primID, sizeof packet.hit.primID);
    for (int i = 0; i < WIDTH; i++) {
        const uint32_t instance = packet.hit.instID[0][i], geometry = packet.hit.geomID[i];
        /* RTC_INVALID_GEOMETRY_ID is -1 */
        on->primitive[start + i] = (int32_t)(instance == RTC_INVALID_GEOMETRY_ID ? geometry : instance);
        if (geometry != RTC_INVALID_GEOMETRY_ID) {
            fetch_triangle(&e->parts[on->primitive[start + i]], packet.hit.primID[i]);
            landed++;
        }
    }
    return landed;
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
        /* from where it starts, off the triangle, to where it would have ended */
        packet.dir_x[i] = shadows->dx[start + i] + (hits->px[start + i] - s->x[start + i]);
        packet.dir_y[i] = shadows->dy[start + i] + (hits->py[start + i] - s->y[start + i]);
        packet.dir_z[i] = shadows->dz[start + i] + (hits->pz[start + i] - s->z[start + i]);
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
