/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Finds where the parts of a scene are while the shutter is open: the boxes of shapes and placed meshes, and the region
 * of the image that such a box can cover. The time is cut into intervals; the box of an interval is the union of those
 * at its ends, enlarged by how far a turning shape can leave the lines between its ends.
 *
 * A point is seen from the eye at (x, y, z), z along the line of sight. Its image through a lens of radius r that is
 * focused at the distance F is a disk about (x/z, y/z) with the radius r |1/z - 1/F|; an orthographic camera's is a disk
 * about (x, y) with the radius r |1 - z/F|. The ends of these disks along x and y are maxima and minima of quotients of
 * linear functions of the point and, as the eye moves on a line, of the time. Where z > 0 these are extreme at corners of
 * the box at the ends of the interval. A box that reaches behind the camera, or is infinite, may cover the whole image.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/status.h"
#include "core/vector.h"
#include "render/description.h"
#include "render/shapes/shapes.h"

/* The number of intervals into which the times from 0 to 1 are cut for a part that moves, at least. */
enum { INTERVALS = 32 };

typedef struct box {
    double low[3], high[3];
} box;

static const box nothing = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void unite(box *to, const box *with, const double margin[3])
{
    for (int k = 0; k < 3; k++) {
        to->low[k] = fmin(to->low[k], with->low[k] - margin[k]);
        to->high[k] = fmax(to->high[k], with->high[k] + margin[k]);
    }
}

/* ---- Shapes --------------------------------------------------------------------------------------------- */

/* An infinite side perpendicular to an axis adds nothing to the extent along that axis. */
static double product(double part, double half)
{
    return part > 0 ? part * half : 0;
}

/* The extent of a flat shape from its centre along an axis, of which its sides have the parts u and v. A disk of a
   scene file has no second side; one of another format has that of the square around it. */
static double flat_reach(const koksma__shape *shape, double u, double v)
{
    return shape->half[1] ? product(fabs(u), shape->half[0]) + product(fabs(v), shape->half[1])
                          : koksma__hypot(u, v) * shape->half[0];
}

/* The vector w, turned as the shape is at time t. */
static void turn(const koksma__shape *shape, const double w[3], double t, double out[3])
{
    const double *axis = shape->turn.axis, along = koksma__dot(axis, w), angle = t * shape->turn.angle_rad;
    double across[3];
    koksma__cross(axis, w, across);
    for (int k = 0; k < 3; k++) {
        out[k] =
            koksma__cos(angle) * w[k] + koksma__sin(angle) * across[k] + (1 - koksma__cos(angle)) * along * axis[k];
    }
}

/* The shape's box at time t. */
static box shape_at(const koksma__shape *shape, double t)
{
    const bool turns = shape->turn.turns;
    const double grown = turns ? 1 + t * (shape->turn.scale - 1) : 1;
    double from[3], offset[3], u[3], v[3];
    box out;
    koksma__subtract(shape->centre, shape->turn.pivot, from);
    memcpy(u, shape->axis_u, sizeof u);
    memcpy(v, shape->axis_v, sizeof v);
    if (turns) {
        turn(shape, from, t, offset);
        turn(shape, shape->axis_u, t, u);
        turn(shape, shape->axis_v, t, v);
    }
    for (int k = 0; k < 3; k++) {
        const double centre = turns ? shape->turn.pivot[k] + grown * offset[k] : shape->centre[k];
        const double reach = grown * (shape->type->is_flat  ? flat_reach(shape, u[k], v[k])
                                      : shape->type->radius ? shape->type->radius(shape)
                                                            : shape->half[0]);
        out.low[k] = centre + t * shape->motion[k] - reach;
        out.high[k] = centre + t * shape->motion[k] + reach;
    }
    return out;
}

/* The largest coordinate k of the part of w that is square to the axis, as it turns. */
static double swing(const koksma__shape *shape, const double w[3], int k)
{
    double across[3];
    koksma__cross(shape->turn.axis, w, across);
    return koksma__hypot(w[k] - koksma__dot(shape->turn.axis, w) * shape->turn.axis[k], across[k]);
}

/* How far a point of the shape can be beyond the line between its places at the ends of an interval of length h: at
   most h^2 / 8 times its acceleration, and that of the scaled and turned vector s(t) R(t) w with the angular velocity a
   is at most (2 |s'| a + s a^2) times the swing of w. */
static void bulge(const koksma__shape *shape, double out[3])
{
    const double angle = fabs(shape->turn.angle_rad), scale = shape->turn.scale;
    const double bend =
        (2 * fabs(scale - 1) * angle + fmax(scale, 1) * angle * angle) / (8.0 * INTERVALS * INTERVALS);
    double offset[3];
    koksma__subtract(shape->centre, shape->turn.pivot, offset);
    for (int k = 0; k < 3; k++) {
        out[k] = !shape->turn.turns ? 0 : bend * swing(shape, offset, k);
        if (shape->turn.turns && shape->type->is_flat) {
            out[k] += flat_reach(shape, bend * swing(shape, shape->axis_u, k), bend * swing(shape, shape->axis_v, k));
        }
    }
}

/* ---- Placed meshes -------------------------------------------------------------------------------------- */

/* The box of a placed mesh at time t. */
static box placement_at(const koksma_scene *scene, const koksma__placement *placement, double t)
{
    koksma__placement now = *placement;
    box out;
    if (now.steps) { /* the matrix is linear within a step */
        const double at = t * now.steps, step = fmin(floor(at), now.steps - 1);
        double next[12];
        koksma__placement_at(placement, step / now.steps, now.matrix);
        koksma__placement_at(placement, (step + 1) / now.steps, next);
        for (int i = 0; i < 12; i++) {
            now.matrix[i] += (at - step) * (next[i] - now.matrix[i]);
        }
        koksma__placement_box(&scene->meshes[now.mesh], &now);
    }
    for (int k = 0; k < 3; k++) {
        out.low[k] = now.low[k] + t * now.motion[k];
        out.high[k] = now.high[k] + t * now.motion[k];
    }
    return out;
}

/* ---- The image ------------------------------------------------------------------------------------------ */

/* Adds to the part's frame what the box can cover at the times from `start` to `end`. */
static void look(const koksma_scene *scene, const box *b, double start, double end, koksma_scene_part *part)
{
    const koksma__camera *camera = &scene->camera;
    const bool parallel = camera->height > 0;
    const double half_height = parallel ? camera->height / 2 : koksma__tan(camera->fov_rad / 2);
    const double half[2] = {half_height * scene->width / scene->height, half_height};
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    int behind = 0, endless = 0;
    for (int corner = 0; corner < 16; corner++) {
        double d[3];
        for (int k = 0; k < 3; k++) {
            d[k] = (corner >> k & 1 ? b->high[k] : b->low[k]) - camera->eye[k] -
                   (corner & 8 ? end : start) * camera->motion[k];
            endless += !isfinite(d[k]);
        }
        const double z = koksma__dot(d, camera->forward), far = parallel ? 1 : z;
        const double blur = camera->lens_radius * fabs(1 - z / camera->focus_distance);
        const double at[2] = {koksma__dot(d, camera->right), koksma__dot(d, camera->down)};
        behind += z <= 0;
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], (1 + ((at[k] - blur) / far - camera->shift[k]) / half[k]) / 2);
            high[k] = fmax(high[k], (1 + ((at[k] + blur) / far - camera->shift[k]) / half[k]) / 2);
        }
    }
    const bool whole = endless || (behind % 16 && !parallel);
    for (int k = 0; k < 2; k++) {
        low[k] = whole ? 0 : fmax(low[k], 0);
        high[k] = whole ? 1 : fmin(high[k], 1);
    }
    if (!whole && (behind == 16 || low[0] >= high[0] || low[1] >= high[1])) {
        return;
    }
    for (int k = 0; k < 2; k++) {
        part->frame[2 * k] = part->in_frame ? fmin(part->frame[2 * k], low[k]) : low[k];
        part->frame[2 * k + 1] = part->in_frame ? fmax(part->frame[2 * k + 1], high[k]) : high[k];
    }
    part->in_frame = true;
}

/* ---- Parts ---------------------------------------------------------------------------------------------- */

static int by_placement(const void *key, const void *name)
{
    const size_t a = *(const size_t *)key, b = ((const koksma__part_name *)name)->placement;
    return (a > b) - (a < b);
}

/* The name of a placed mesh. */
static const char *name_of(const koksma_scene *scene, size_t placement)
{
    const koksma__part_name *own =
        scene->n_part_names ? bsearch(&placement, scene->part_names, scene->n_part_names, sizeof *own, by_placement)
                            : NULL;
    return own ? own->name : scene->meshes[scene->placements[placement].mesh].name;
}

/* The box of a part, which is `shape` or, if that is NULL, `placement`, at time t. */
static box box_at(const koksma_scene *scene, const koksma__shape *shape, const koksma__placement *placement, double t)
{
    return shape ? shape_at(shape, t) : placement_at(scene, placement, t);
}

/* Sets box and frame of a part. */
static void find(const koksma_scene *scene, const koksma__shape *shape, const koksma__placement *placement,
                 koksma_scene_part *part)
{
    const double *shutter = scene->camera.shutter, *motion = shape ? shape->motion : placement->motion;
    const double opens = fmin(fmax(shutter[0], 0), 1), closes = fmin(fmax(shutter[1], 0), 1);
    const int steps = shape ? 0 : placement->steps; /* no interval is in two of them */
    const bool moves = steps || (shape && shape->turn.turns) || motion[0] != 0 || motion[1] != 0 || motion[2] != 0;
    const int n = !moves ? 1 : steps ? (INTERVALS + steps - 1) / steps * steps : INTERVALS;
    double margin[3] = {0};
    box all = nothing, before = box_at(scene, shape, placement, opens);
    if (shape) {
        bulge(shape, margin);
    }
    for (int i = 0; i < n; i++) {
        const double start = fmax(opens, (double)i / n), end = fmin(closes, (i + 1.0) / n);
        if (start <= end) {
            const box after = box_at(scene, shape, placement, end);
            box within = nothing;
            unite(&within, &before, margin);
            unite(&within, &after, margin);
            unite(&all, &within, (const double[3]){0});
            look(scene, &within, start, end, part);
            before = after;
        }
    }
    memcpy(part->low, all.low, sizeof part->low);
    memcpy(part->high, all.high, sizeof part->high);
}

bool koksma_scene_part_at(const koksma_scene *scene, size_t i, koksma_scene_part *out)
{
    KOKSMA__REQUIRE_OR(false, scene, out);
    if (i >= scene->n_shapes + scene->n_placements) {
        return false;
    }
    *out = (koksma_scene_part){.in_frame = false};
    if (i < scene->n_shapes) {
        const koksma__shape *shape = &scene->shapes[i];
        snprintf(out->name, sizeof out->name, "%s%s", shape->light < 0 ? "" : "light ", shape->type->kind.name);
        find(scene, shape, NULL, out);
    } else {
        const koksma__placement *placement = &scene->placements[i - scene->n_shapes];
        const char *name = name_of(scene, i - scene->n_shapes);
        snprintf(out->name, sizeof out->name, "%smesh%s%s", placement->light < 0 ? "" : "light ", *name ? " " : "",
                 name);
        find(scene, NULL, placement, out);
    }
    return true;
}
