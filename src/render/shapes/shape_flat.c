/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The flat shapes, n.(p - c) = 0 within bounds in the coordinates (u, v):
 *
 *     plane       no bounds
 *     rectangle   |u| <= half[0] and |v| <= half[1]
 *     disk        u^2 + v^2 <= r^2
 *
 * A ray meets the plane at t = n.(c - o) / n.d, then the position must lie within the bounds. A kind defines its bounds
 * as a function of (u, v), which the compiler inlines into the kind's copy of each loop: FLAT_LOOPS.
 *
 * A ray that starts on a flat shape never meets it, without any epsilon.
 */
#include "core/elementary.h"
#include "core/vector.h"
#include "render/pipelines/batch_kernel.h"
#include "render/shapes/shapes.h"

/* ---- Loops ------------------------------------------------------------------------------------------------------ */

/* The bounds: 1 where (u, v) is on the shape, 0 elsewhere. */
typedef int within(const koksma__batch_shape *s, float u, float v);

/* The frame of a shape. */
typedef struct plane {
    koksma__v3 centre, normal, u, v;
} plane;

INLINE plane plane_of(const koksma__batch_shape *s)
{
    return (plane){koksma__v3_of(s->centre), koksma__v3_of(s->normal), koksma__v3_of(s->axis_u),
                   koksma__v3_of(s->axis_v)};
}

/* Where the line e + t d, from the centre, meets the plane, and its coordinates there. */
INLINE float meet(const plane *f, koksma__v3 e, koksma__v3 d, float *u, float *v)
{
    const float t = -koksma__v3_dot(f->normal, e) / koksma__v3_dot(f->normal, d);
    const koksma__v3 q = koksma__v3_add(e, koksma__v3_scale(d, t));
    *u = koksma__v3_dot(q, f->u);
    *v = koksma__v3_dot(q, f->v);
    return t;
}

INLINE void flat_hit(const koksma__batch_shape *shape, const koksma__rays *restrict r, const int32_t *restrict from,
                     int n, koksma__hits *restrict h, within *inside)
{
    const koksma__batch_shape copy = *shape, *s = &copy;
    const plane f = plane_of(s);
    const int32_t id = s->id;
    for (int i = 0; i < STEP(n); i++) {
        float u, v;
        const float t = meet(&f, koksma__v3_subtract(AT(r->o, i), f.centre), AT(r->d, i), &u, &v);
        const int hit = (from[i] != id) & (t > 0) & (t < h->t[i]) & inside(s, u, v);
        h->t[i] = hit ? t : h->t[i];
        h->primitive[i] = hit ? id : h->primitive[i];
    }
}

/* The loops `hit` and `finish` combined, for a block of rays that start on no shape and can hit no other shape. */
INLINE int flat_only(const koksma__batch_shape *shape, const koksma__rays *restrict r, int n,
                     koksma__hits *restrict h, within *inside)
{
    const koksma__batch_shape copy = *shape, *s = &copy;
    const plane f = plane_of(s);
    const int32_t id = s->id, material = s->material;
    const koksma__v3 none = {0, 0, 0};
    int count = 0;
    for (int i = 0; i < STEP(n); i++) {
        const koksma__v3 o = AT(r->o, i), d = AT(r->d, i);
        float u, v;
        const float t = meet(&f, koksma__v3_subtract(o, f.centre), d, &u, &v);
        const int hit = (t > 0) & (t < INFINITY) & inside(s, u, v), back = koksma__v3_dot(f.normal, d) > 0;
        const koksma__v3 p = koksma__v3_add(o, koksma__v3_scale(d, t)), q = koksma__v3_subtract(p, f.centre);
        const koksma__v3 normal = koksma__v3_scale(f.normal, back ? -1.0f : 1.0f);
        h->t[i] = hit ? t : INFINITY;
        koksma__put(h->p, i, 1, koksma__either(hit, p, none));
        koksma__put(h->n, i, 1, koksma__either(hit, normal, none));
        h->u[i] = hit ? koksma__v3_dot(q, f.u) : 0;
        h->v[i] = hit ? koksma__v3_dot(q, f.v) : 0;
        h->back[i] = hit & back;
        h->primitive[i] = hit ? id : -1;
        h->material[i] = hit ? material : -1;
        count += hit;
    }
    return count;
}

/* aimed: the shape of the light at which each ray is aimed. Neither that shape nor the shape on which the ray starts
   can block the ray. */
INLINE void flat_shade(const koksma__batch_shape *shape, const koksma__hits *restrict h, const int32_t *aimed, int n,
                       koksma__shadows *restrict r, within *inside)
{
    const koksma__batch_shape copy = *shape, *s = &copy;
    const plane f = plane_of(s);
    const int32_t id = s->id;
    for (int i = 0; i < STEP(n); i++) {
        float u, v;
        const float t = meet(&f, koksma__v3_subtract(AT(h->p, i), f.centre), AT(r->d, i), &u, &v);
        const int other = (h->primitive[i] != id) & (aimed[i] != id);
        const int hit = other & (t > 0) & (t < KOKSMA__SHADOW_END) & inside(s, u, v);
        r->light[i] *= hit ? 0.0f : 1.0f;
    }
}

/* Defines the loops `hit`, `only` and `shade` of a kind of shape, whose bounds kind_within tests. */
#define FLAT_LOOPS(kind)                                                                                             \
    static void kind##_hit(const koksma__batch_shape *s, const koksma__rays *rays, const int32_t *from, int n,       \
                           koksma__hits *hits)                                                                       \
    {                                                                                                                \
        flat_hit(s, rays, from, n, hits, kind##_within);                                                             \
    }                                                                                                                \
    static int kind##_only(const koksma__batch_shape *s, const koksma__rays *rays, int n, koksma__hits *hits)        \
    {                                                                                                                \
        return flat_only(s, rays, n, hits, kind##_within);                                                           \
    }                                                                                                                \
    static void kind##_shade(const koksma__batch_shape *s, const koksma__hits *hits, const int32_t *aimed, int n,    \
                             koksma__shadows *shadows)                                                               \
    {                                                                                                                \
        flat_shade(s, hits, aimed, n, shadows, kind##_within);                                                       \
    }

static int plane_within(const koksma__batch_shape *s, float u, float v)
{
    (void)s, (void)u, (void)v;
    return 1;
}

static int rectangle_within(const koksma__batch_shape *s, float u, float v)
{
    return (fabsf(u) <= s->half_u) & (fabsf(v) <= s->half_v);
}

static int disk_within(const koksma__batch_shape *s, float u, float v)
{
    return u * u + v * v <= s->radius2;
}

FLAT_LOOPS(plane)
FLAT_LOOPS(rectangle)
FLAT_LOOPS(disk)

/* ---- Kinds ------------------------------------------------------------------------------------------------------ */

/* Converts p to the shape's coordinates u and v; returns the height above its plane. */
static double coordinates(const koksma__shape *shape, const double p[3], double uv[2])
{
    double q[3];
    koksma__subtract(p, shape->centre, q);
    uv[0] = koksma__dot(q, shape->axis_u);
    uv[1] = koksma__dot(q, shape->axis_v);
    return koksma__dot(q, shape->normal);
}

static double plane_equation(const koksma__shape *shape, const double p[3], double *beyond)
{
    double uv[2];
    *beyond = -1;
    return coordinates(shape, p, uv);
}

static double rectangle_equation(const koksma__shape *shape, const double p[3], double *beyond)
{
    double uv[2];
    const double height = coordinates(shape, p, uv);
    *beyond = fmax(fabs(uv[0]) - shape->half[0], fabs(uv[1]) - shape->half[1]);
    return height;
}

static double disk_equation(const koksma__shape *shape, const double p[3], double *beyond)
{
    double uv[2];
    const double height = coordinates(shape, p, uv);
    *beyond = koksma__hypot(uv[0], uv[1]) - shape->half[0];
    return height;
}

static koksma_status parse_plane(const char *name, const field *f, koksma_scene *scene, koksma__shape *shape)
{
    shape->half[0] = shape->half[1] = (double)INFINITY;
    return koksma__shape_axes(name, f, scene, shape);
}

/* The parameters of a plane are the end of those of the others. */
static const koksma__parameter of_rectangle[] = {{"half", KOKSMA__HALF, .at = offsetof(koksma__shape, half)},
                                                 {"centre", KOKSMA__POINT, .at = offsetof(koksma__shape, centre)},
                                                 {"normal", KOKSMA__DIRECTION, .at = offsetof(koksma__shape, normal)},
                                                 {0}};
static const koksma__parameter of_disk[] = {{"radius", KOKSMA__RADIUS, .at = offsetof(koksma__shape, half)},
                                            {"centre", KOKSMA__POINT, .at = offsetof(koksma__shape, centre)},
                                            {"normal", KOKSMA__DIRECTION, .at = offsetof(koksma__shape, normal)},
                                            {0}};

#define FURTHER_KEYS KEYS("up", "motion", "to")

const koksma__shape_type KOKSMA__SHAPE(plane) = {
    .kind = {.name = "plane",
             .title = "an infinite plane",
             .cite = "-",
             .parameters = of_rectangle + 1,
             .keys = FURTHER_KEYS},
    .is_flat = true,
    .takes_checker = true,
    .parse = parse_plane,
    .equation = plane_equation,
    .hit = plane_hit,
    .shade = plane_shade,
    .only = plane_only,
};

const koksma__shape_type KOKSMA__SHAPE(rectangle) = {
    .kind = {.name = "rectangle",
             .title = "a rectangle of half sides `half` along u and v",
             .cite = "-",
             .parameters = of_rectangle,
             .keys = FURTHER_KEYS},
    .is_flat = true,
    .takes_checker = true,
    .takes_image = true,
    .parse = koksma__shape_axes,
    .equation = rectangle_equation,
    .hit = rectangle_hit,
    .shade = rectangle_shade,
    .only = rectangle_only,
};

const koksma__shape_type KOKSMA__SHAPE(disk) = {
    .kind = {.name = "disk", .title = "a disk", .cite = "-", .parameters = of_disk, .keys = FURTHER_KEYS},
    .is_flat = true,
    .takes_checker = true,
    .parse = koksma__shape_axes,
    .equation = disk_equation,
    .hit = disk_hit,
    .shade = disk_shade,
    .only = disk_only,
};
