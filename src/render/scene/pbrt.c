/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads scenes of pbrt-v4 (Pharr, Jakob & Humphreys 2023; pbrt.org/fileformat-v4). A scene is a list of
 * directives, each with a text and parameters, that change a graphics state or use it to add a shape or light.
 * pbrt_values.c converts parameters to colours, materials and meshes. There are two current matrices, for the start and
 * for the end of the motion; where they differ, a shape or the camera moves; a camera that turns is not supported.
 * Curves are not read; the only medium read is a homogeneous one that contains the camera. Directives that do not
 * describe the scene (Integrator, ...; of a Sampler all but its number) are ignored, because the program's own
 * options choose them. The file is long because all of pbrt's directives are in one place.
 */
#include "scene/pbrt.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "core/capacity.h"
#include "core/elementary.h"
#include "core/vector.h"
#include "meshes/mesh_text.h"
#include "render/description_build.h"
#include "render/fields.h"
#include "render/lights/lights.h"
#include "render/medium.h"

enum { MOST_INCLUDED = 16, MOST_STATES = 1024 };

enum { START = 1, END = 2 };

typedef struct graphics {
    double matrix[2][12]; /* at the start and at the end of the motion */
    size_t n_attributes;  /* the attributes that count here are the first ones of all */
    double power;         /* of the light that the shapes that follow are; 0: its radiance is given */
    unsigned active;      /* which of the two matrices the directives change: START, END or both */
    koksma__import_surface surface;
    char outside[256]; /* name of the medium outside the shapes that follow */
} graphics;

typedef struct space {
    double matrix[2][12];
} space;

/* A medium, which may be used before it is made. */
typedef struct medium {
    char name[256];
    koksma__text_place used; /* first; no file: nowhere */
    bool is_made, is_read;
    double absorption[3], scattering[3], g;
} medium;

typedef struct object {
    koksma__import_item *items;
    size_t n;
} object;

typedef struct koksma__pbrt_source source;

typedef struct reader {
    koksma__pbrt_scene values;
    koksma__import *im;
    graphics now;
    graphics *stack;
    space *spaces;
    object *objects;
    medium *media;
    size_t n_stack, n_spaces, n_objects, n_media;
    koksma__names space_names, object_names, medium_names;
    bool in_object;        /* shapes are added to the last object */
    char object_name[256]; /* the name of that one */
    double times[2];       /* when motions start and end */
    koksma__pbrt_attribute *attributes;
    size_t n_attributes;
    /* The directive that is read: its row, where it is, its numbers or texts, and its parameters. */
    const struct directive *directive;
    source *source;
    koksma__text_place place;
    double numbers[16];
    char texts[3][1024];
    koksma__pbrt_parameters *parameters;
    koksma__pbrt_mistake mistake;
    bool used[KOKSMA__MAX_PBRT_PARAMETERS]; /* of the parameters */
    /* The camera, completed when the aspect ratio of the film is known. */
    bool has_camera, orthographic, has_window, in_world;
    koksma__text_place camera_place;
    char camera_medium[256];
    double camera[2][12], fov_deg, lens_radius, focus_distance, shutter[2];
    double window[4]; /* the screen window: x from [0] to [1], y from [2] to [3] */
    /* aspect ratio (width / height) of the screen window if the file has no `window`; 0: that of the image */
    double frame;
    /* the film's width and height in pixels, the part of it that is the picture, and its sensitivity */
    double film[2], crop[4], iso, exposure_time;
    int depth; /* of included files */
} reader;

/* Where a directive has its kind: in a text after its name, or in its parameter "type". */
typedef enum kind_place { NONE, FIRST, SECOND, THIRD, TYPE } kind_place;

typedef struct directive {
    const char *name;
    koksma_status (*take)(reader *r); /* NULL: it does not describe the scene */
    unsigned numbers, texts;          /* how many of them follow the name */
    bool has_parameters;
    kind_place kind;
    bool describes;     /* the parameters describe the scene, so that each unused one gives a warning */
    const char *target; /* of the attributes that it inherits; or NULL */
} directive;

/* ---- Transforms -------------------------------------------------------------------------------------------- */

/* Multiplies the active matrices by another, or, if `replaces`, replaces them. */
static koksma_status change(reader *r, const double by[12], bool replaces)
{
    for (unsigned i = 0; i < 2; i++) {
        double product[12];
        if (r->now.active >> i & 1) {
            koksma__matrix_multiply(replaces ? koksma__import_identity : r->now.matrix[i], by, product);
            memcpy(r->now.matrix[i], product, sizeof product);
        }
    }
    return KOKSMA_OK;
}

static koksma_status concat(reader *r, const double by[12])
{
    return change(r, by, false);
}

static koksma_status take_identity(reader *r)
{
    return change(r, koksma__import_identity, true);
}

static koksma_status take_translate(reader *r)
{
    const double *v = r->numbers;
    return concat(r, (const double[12]){1, 0, 0, v[0], 0, 1, 0, v[1], 0, 0, 1, v[2]});
}

static koksma_status take_scale(reader *r)
{
    const double *v = r->numbers;
    return concat(r, (const double[12]){v[0], 0, 0, 0, 0, v[1], 0, 0, 0, 0, v[2], 0});
}

static koksma_status take_rotate(reader *r)
{
    double m[12];
    return koksma__import_rotation(r->numbers[0], r->numbers + 1, m)
               ? concat(r, m)
               : koksma__import_fail(r->place, "Rotate: the axis has no direction");
}

static koksma_status take_look_at(reader *r)
{
    double m[12], inverse[12];
    KOKSMA__TRY(koksma__import_look_at(r->place, "LookAt", r->numbers, r->numbers + 3, r->numbers + 6, m));
    koksma__import_invert(m, inverse);
    return concat(r, inverse);
}

/* Reads a matrix, which is given column by column. */
static koksma_status take_transform(reader *r)
{
    double m[12];
    for (int i = 0; i < 12; i++) {
        m[i] = r->numbers[4 * (i % 4) + i / 4];
    }
    return change(r, m, *r->directive->name == 'T');
}

static koksma_status name_space(reader *r, const char *name, double (*matrix)[12])
{
    KOKSMA__TRY(koksma__import_hold(r->im, r->place, sizeof(space) + KOKSMA__HELD_WITH_NAME));
    space *to = koksma__add_one(&r->spaces, &r->n_spaces, sizeof *to);
    KOKSMA__TRY(to ? KOKSMA_OK : KOKSMA_MEMORY);
    memcpy(to->matrix[0], matrix[0], sizeof to->matrix[0]);
    memcpy(to->matrix[1], matrix[1], sizeof to->matrix[1]);
    return koksma__names_put(&r->space_names, name, strlen(name), r->n_spaces - 1);
}

static koksma_status take_coordinate_system(reader *r)
{
    return name_space(r, r->texts[0], r->now.matrix);
}

static koksma_status take_coordinate_transform(reader *r)
{
    size_t i;
    if (!koksma__names_find(&r->space_names, r->texts[0], strlen(r->texts[0]), &i)) {
        return koksma__import_fail(r->place, "no coordinate system '%s'", r->texts[0]);
    }
    memcpy(r->now.matrix, r->spaces[i].matrix, sizeof r->now.matrix);
    return KOKSMA_OK;
}

static koksma_status take_active(reader *r)
{
    static const char *const all[] = {[START] = "StartTime", [END] = "EndTime", [START | END] = "All"};
    koksma__pbrt_token t;
    KOKSMA__TRY(koksma__pbrt_token_next(r->source, &t));
    for (unsigned i = START; i <= (START | END); i++) {
        if (t.kind == KOKSMA__PBRT_WORD && koksma__text_is(t.at, t.length, all[i])) {
            r->now.active = i;
            return KOKSMA_OK;
        }
    }
    return koksma__import_fail(r->source->place, "ActiveTransform is StartTime, EndTime or All");
}

static koksma_status take_times(reader *r)
{
    memcpy(r->times, r->numbers, sizeof r->times);
    return KOKSMA_OK;
}

/* Whether something placed by the two matrices moves. */
static bool moves(const double *start, const double *end)
{
    return memcmp(start, end, 12 * sizeof *start) != 0;
}

/* Finds the poses at the start and the end of a motion, from their matrices. Sets *found to false, with a
   warning, if there are none. */
static koksma_status find_poses(reader *r, koksma__text_place place, const double *start, const double *end,
                                koksma__pose poses[2], bool *found)
{
    *found = koksma__matrix_mirrors(start) == koksma__matrix_mirrors(end) &&
             koksma__pose_of_matrix(start, &poses[0]) && koksma__pose_of_matrix(end, &poses[1]);
    return *found ? KOKSMA_OK
                  : koksma__import_unknown(r->im, place,
                                           "a motion that mirrors, or by a matrix without inverse, is ignored");
}

/* ---- States ------------------------------------------------------------------------------------------------ */

static koksma_status push(reader *r)
{
    if (r->n_stack == MOST_STATES) {
        return koksma__import_fail(r->place, "more than %d attributes or objects are open", MOST_STATES);
    }
    graphics *to = koksma__add_one(&r->stack, &r->n_stack, sizeof *to);
    KOKSMA__TRY(to ? KOKSMA_OK : KOKSMA_MEMORY);
    *to = r->now;
    return KOKSMA_OK;
}

/* Takes the top entry from the stack, and restores the graphics state or the matrices from it. The stack keeps its
   memory, because koksma__add_one() computes the capacity from nothing but the number of items. */
static koksma_status pop(reader *r, bool matrix_alone)
{
    if (!r->n_stack) {
        return koksma__import_fail(r->place, "an AttributeEnd, ObjectEnd or TransformEnd without its begin");
    }
    const graphics *from = &r->stack[--r->n_stack];
    if (matrix_alone) {
        memcpy(r->now.matrix, from->matrix, sizeof from->matrix);
        r->now.active = from->active;
    } else {
        r->now = *from;
        while (r->n_attributes > r->now.n_attributes) {
            free(r->attributes[--r->n_attributes].parameter.numbers);
        }
    }
    return KOKSMA_OK;
}

static koksma_status take_end(reader *r)
{
    return pop(r, *r->directive->name == 'T');
}

static koksma_status take_reverse(reader *r)
{
    r->now.surface.turned = !r->now.surface.turned;
    return KOKSMA_OK;
}

static koksma_status take_world(reader *r)
{
    r->now.active = START | END;
    r->in_world = true;
    return take_identity(r);
}

static koksma_status take_object_begin(reader *r)
{
    if (r->in_object) {
        return koksma__import_fail(r->place, "an object within another object");
    }
    KOKSMA__TRY(push(r));
    KOKSMA__TRY(koksma__import_hold(r->im, r->place, sizeof(object) + KOKSMA__HELD_WITH_NAME));
    r->in_object = koksma__add_one(&r->objects, &r->n_objects, sizeof(object)) != NULL;
    snprintf(r->object_name, sizeof r->object_name, "%.255s", r->texts[0]);
    return r->in_object ? KOKSMA_OK : KOKSMA_MEMORY;
}

static koksma_status take_object_end(reader *r)
{
    if (!r->in_object) {
        return koksma__import_fail(r->place, "ObjectEnd without ObjectBegin");
    }
    KOKSMA__TRY(koksma__names_put(&r->object_names, r->object_name, strlen(r->object_name), r->n_objects - 1));
    r->in_object = false;
    return pop(r, false);
}

static koksma_status take_instance(reader *r)
{
    size_t i;
    if (!koksma__names_find(&r->object_names, r->texts[0], strlen(r->texts[0]), &i)) {
        return koksma__import_fail(r->place, "no object '%s'", r->texts[0]);
    }
    const object *o = &r->objects[i];
    koksma__pose poses[2];
    bool moving = moves(r->now.matrix[0], r->now.matrix[1]);
    if (moving) {
        KOKSMA__TRY(find_poses(r, r->place, r->now.matrix[0], r->now.matrix[1], poses, &moving));
    }
    for (size_t k = 0; k < o->n; k++) {
        KOKSMA__TRY(koksma__import_put(r->im, &o->items[k], r->now.matrix[0], moving ? poses : NULL));
    }
    return KOKSMA_OK;
}

/* ---- Shapes and lights ------------------------------------------------------------------------------------- */

static koksma_status put(reader *r, const koksma__import_item *item)
{
    if (!r->in_object) {
        return koksma__import_put(r->im, item, NULL, NULL);
    }
    object *open = &r->objects[r->n_objects - 1];
    KOKSMA__TRY(koksma__import_hold(r->im, item->place, sizeof *item));
    koksma__import_item *to = koksma__add_one(&open->items, &open->n, sizeof *to);
    KOKSMA__TRY(to ? KOKSMA_OK : KOKSMA_MEMORY);
    *to = *item;
    return KOKSMA_OK;
}

static koksma_status take_shape(reader *r)
{
    double form[12];
    bool is_there = true;
    koksma__import_item item = {.surface = r->now.surface, .place = r->place};
    if (r->in_object && item.surface.emits) {
        item.surface.emits = false;
        KOKSMA__TRY(koksma__import_unknown(r->im, r->place, "a light within an object is dark"));
    }
    memcpy(form, koksma__import_identity, sizeof form);
    KOKSMA__TRY(koksma__pbrt_shape(&r->values, r->texts[0], r->parameters, r->now.power, r->now.matrix[0], &item,
                                   form, &is_there));
    koksma__matrix_multiply(r->now.matrix[0], form, item.matrix);
    if (is_there && moves(r->now.matrix[0], r->now.matrix[1])) {
        memcpy(item.motion.before, form, sizeof form);
        KOKSMA__TRY(
            find_poses(r, r->place, r->now.matrix[0], r->now.matrix[1], item.motion.poses, &item.motion.moves));
    }
    return is_there ? put(r, &item) : KOKSMA_OK;
}

static koksma_status take_area_light(reader *r)
{
    koksma__import_surface *surface = &r->now.surface;
    surface->emits = true;
    surface->two_sided = koksma__pbrt_flag(r->parameters, "twosided");
    r->now.power = koksma__pbrt_number(r->parameters, "power");
    return koksma__pbrt_emission(&r->values, r->parameters, "L", surface->radiance);
}

/* Transforms a point (w = 1) or a direction (w = 0) by a matrix. */
static void move_point(const double m[12], const double p[3], double w, double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = koksma__dot(m + 4 * k, p) + w * m[4 * k + 3];
    }
}

/* Scales a light's colour so that it has the power or illuminance that the parameters give. */
static void scale_light(const koksma__pbrt_parameters *p, const char *type, double rgb[3])
{
    const bool far = !strcmp(type, "distant"), around = !strcmp(type, "infinite");
    const double given = koksma__pbrt_number(p, far || around ? "illuminance" : "power");
    double own = far ? 1 : around ? M_PI : 2 * TURN;
    if (!strcmp(type, "spot")) { /* full within the inner cone, half on average between the cones */
        const double outer = koksma__pbrt_number(p, "coneangle");
        const double inner = outer - koksma__pbrt_number(p, "conedeltaangle");
        own = TURN * (1 - (koksma__cos(inner * TURN / 360) + koksma__cos(outer * TURN / 360)) / 2);
    }
    for (int k = 0; given > 0 && own > 0 && k < 3; k++) {
        rgb[k] *= given / own;
    }
}

static koksma_status take_light(reader *r)
{
    const char *type = r->texts[0];
    const koksma__pbrt_parameters *p = r->parameters;
    koksma__light light = {.kind = &koksma__light_point};
    double from[3] = {0}, to[3] = {0, 0, 1}, along[3];
    const bool far = !strcmp(type, "distant"), around = !strcmp(type, "infinite");
    KOKSMA__TRY(koksma__pbrt_emission(&r->values, p, far || around ? "L" : "I", light.radiance));
    KOKSMA__TRY(koksma__import_unknown_if(moves(r->now.matrix[0], r->now.matrix[1]), r->im, p->place,
                                          "a moving light stays where it is at the start"));
    koksma__pbrt_point(p, "from", from);
    koksma__pbrt_point(p, "to", to);
    if (around && *koksma__pbrt_word(p, "filename")) {
        const double illuminance = koksma__pbrt_number(p, "illuminance");
        return koksma__import_sky(r->im, p->place, koksma__pbrt_word(p, "filename"), illuminance, light.radiance,
                                  r->now.matrix[0]);
    }
    scale_light(p, type, light.radiance);
    if (around) {
        light.kind = &koksma__light_environment;
        light.visible = true;
    } else if (far) {
        light.kind = &koksma__light_directional;
        koksma__subtract(to, from, to);
        move_point(r->now.matrix[0], to, 0, light.normal);
        if (!koksma__import_normalise(light.normal)) {
            return koksma__import_fail(p->place, "a distant light without a direction");
        }
    } else {
        move_point(r->now.matrix[0], from, 1, light.centre);
        if (!strcmp(type, "spot")) {
            const double outer = koksma__pbrt_number(p, "coneangle");
            koksma__subtract(to, from, to);
            move_point(r->now.matrix[0], to, 0, along);
            KOKSMA__TRY(koksma__import_spot(p->place, along, outer - koksma__pbrt_number(p, "conedeltaangle"), outer,
                                            KOKSMA__FALLOFF_SMOOTH, &light));
        } else if (strcmp(type, "point") != 0) {
            KOKSMA__TRY(koksma__import_unknown(
                r->im, p->place, "light '%s' is replaced by a point light equal in all directions%s", type,
                koksma__pbrt_kind_meant("LightSource", type, (char[KOKSMA__OR_MEANT]){0})));
        }
    }
    return koksma__import_light(r->im, p->place, &light);
}

/* What the film makes of radiance, in pbrt-v4: the time for which the shutter is open, or the film's own exposure time of
   earlier versions, times its sensitivity. Lights, which come after the film and the camera, get this factor. */
static void set_exposure(reader *r)
{
    const double open = r->shutter[1] - r->shutter[0];
    r->values.exposure = (r->exposure_time > 0 ? r->exposure_time : open) * r->iso / 100;
}

static koksma_status take_camera(reader *r)
{
    const char *type = r->texts[0];
    const koksma__pbrt_parameters *p = r->parameters;
    r->orthographic = !strcmp(type, "orthographic");
    if (!r->orthographic && strcmp(type, "perspective") != 0) {
        return koksma__import_fail(p->place, "camera '%s' is not read; 'perspective' and 'orthographic' are", type);
    }
    if (!koksma__import_invert(r->now.matrix[0], r->camera[0]) ||
        !koksma__import_invert(r->now.matrix[1], r->camera[1])) {
        return koksma__import_fail(p->place, "the camera's matrix has no inverse");
    }
    KOKSMA__TRY(
        koksma__import_unknown_if(r->in_world, r->im, p->place, "a Camera after WorldBegin, which pbrt refuses"));
    r->has_camera = true;
    r->camera_place = p->place;
    snprintf(r->camera_medium, sizeof r->camera_medium, "%s", r->now.outside);
    r->fov_deg = koksma__pbrt_number(p, "fov");
    r->lens_radius = koksma__pbrt_number(p, "lensradius");
    r->focus_distance = koksma__pbrt_number(p, "focaldistance");
    r->shutter[0] = koksma__pbrt_number(p, "shutteropen");
    r->shutter[1] = koksma__pbrt_number(p, "shutterclose");
    set_exposure(r);
    const koksma__pbrt_parameter *window = koksma__pbrt_find_typed(p, "screenwindow", "float");
    r->has_window = window && window->n == 4;
    if (window && !r->has_window) {
        return koksma__import_fail(p->place, "a screen window is four numbers: x from, x to, y from, y to");
    }
    if (r->has_window) {
        memcpy(r->window, window->numbers, sizeof r->window);
    }
    r->frame = fmax(koksma__pbrt_number(p, "frameaspectratio"), 0);
    return name_space(r, "camera", r->camera);
}

/* Reads the part of the film that is the picture, in pixels: x from [0] to [1], y from [2] to [3]. A crop window is in
   fractions of the film, whose pixels are rounded upwards, and has priority over bounds in pixels, as in pbrt. */
static koksma_status take_crop(const koksma__pbrt_parameters *p, const double sides[2], double crop[4])
{
    const koksma__pbrt_parameter *window = koksma__pbrt_find_typed(p, "cropwindow", "float"),
                                 *bounds = koksma__pbrt_find_typed(p, "pixelbounds", "integer"),
                                 *from = window ? window : bounds;
    if (from && from->n != 4) {
        return koksma__import_fail(p->place, "%s: it is four numbers: x from, x to, y from, y to", from->name);
    }
    for (int i = 0; i < 4; i++) {
        const double *v = from ? from->numbers + i / 2 * 2 : NULL, side = sides[i / 2];
        crop[i] = i % 2 ? side : 0;
        if (window) {
            const double at = i % 2 ? fmax(v[0], v[1]) : fmin(v[0], v[1]);
            crop[i] = (double)ceilf((float)side * (float)fmin(fmax(at, 0), 1));
        } else if (bounds) {
            crop[i] = fmin(fmax(v[i % 2], 0), side);
        }
    }
    return crop[0] < crop[1] && crop[2] < crop[3]
               ? KOKSMA_OK
               : koksma__import_fail(p->place, "%s: no pixel of the film is in it", from->name);
}

static koksma_status take_film(reader *r)
{
    const koksma__pbrt_parameters *p = r->parameters;
    const double width = koksma__pbrt_whole(p, "xresolution"), height = koksma__pbrt_whole(p, "yresolution");
    if (!(width >= 1 && height >= 1 && width <= KOKSMA_MAX_IMAGE_SIDE && height <= KOKSMA_MAX_IMAGE_SIDE)) {
        return koksma__import_fail(p->place, "a film of %g x %g pixels; each side must be 1 to %d", width, height,
                                   KOKSMA_MAX_IMAGE_SIDE);
    }
    r->film[0] = width;
    r->film[1] = height;
    KOKSMA__TRY(take_crop(p, r->film, r->crop));
    r->im->scene->width = (int)(r->crop[1] - r->crop[0]);
    r->im->scene->height = (int)(r->crop[3] - r->crop[2]);
    KOKSMA__TRY(
        koksma__import_unknown_if(r->in_world, r->im, p->place, "a Film after WorldBegin, which pbrt refuses"));
    r->iso = koksma__pbrt_number(p, "iso");
    r->exposure_time = koksma__pbrt_number(p, "exposuretime");
    set_exposure(r);
    const char *sensor = koksma__pbrt_word(p, "sensor");
    return koksma__import_unknown_if(*sensor && strcmp(sensor, "cie1931"), r->im, p->place,
                                     "the sensor '%.40s' is replaced by 'cie1931'", sensor);
}

/* ---- Materials and textures --------------------------------------------------------------------------------- */

static koksma_status take_material(reader *r)
{
    return koksma__pbrt_material(&r->values, r->texts[0], r->parameters, &r->now.surface.material);
}

static koksma_status take_make_material(reader *r)
{
    return koksma__pbrt_name_material(&r->values, r->texts[0], r->parameters);
}

static koksma_status take_named_material(reader *r)
{
    return koksma__pbrt_find_material(&r->values, r->place, r->texts[0], &r->now.surface.material);
}

static koksma_status take_texture(reader *r)
{
    return koksma__pbrt_texture(&r->values, r->texts[0], r->texts[1], r->texts[2], r->parameters);
}

/* An integrator that shows something else than the light of the scene is named. */
static koksma_status take_integrator(reader *r)
{
    const char *type = r->texts[0];
    return strcmp(type, "ambientocclusion") && strcmp(type, "function")
               ? KOKSMA_OK
               : koksma__import_unknown(r->im, r->place,
                                        "integrator '%s' is ignored: the picture shows the scene's light", type);
}

/* The points are those of the program's own options; `koksma rank` takes their number from here. */
static koksma_status take_sampler(reader *r)
{
    const koksma__pbrt_parameters *p = r->parameters;
    const double n = !strcmp(r->texts[0], "stratified")
                         ? koksma__pbrt_whole(p, "xsamples") * koksma__pbrt_whole(p, "ysamples")
                         : koksma__pbrt_whole(p, "pixelsamples");
    r->im->scene->spp = n >= 1 && n <= KOKSMA_MAX_SPP ? (int)n : 0;
    return KOKSMA_OK;
}

static koksma_status take_option(reader *r)
{
    return koksma__import_unknown_if(koksma__pbrt_flag(r->parameters, "forcediffuse"), r->im, r->place,
                                     "option 'forcediffuse' is ignored");
}

static koksma_status take_colour_space(reader *r)
{
    return koksma__import_unknown_if(strcasecmp(r->texts[0], "srgb") != 0, r->im, r->place,
                                     "colour space '%s' is replaced by sRGB", r->texts[0]);
}

/* Finds the medium with this name, or adds it; NULL after an error. */
static medium *find_medium(reader *r, const char *name)
{
    size_t i;
    if (koksma__names_find(&r->medium_names, name, strlen(name), &i)) {
        return &r->media[i];
    }
    const koksma_status status = koksma__import_hold(r->im, r->place, sizeof(medium) + KOKSMA__HELD_WITH_NAME);
    medium *to = status ? NULL : koksma__add_one(&r->media, &r->n_media, sizeof *to);
    if (!to || koksma__names_put(&r->medium_names, name, strlen(name), r->n_media - 1)) {
        return NULL;
    }
    snprintf(to->name, sizeof to->name, "%s", name);
    return to;
}

/* Remembers the first use of a medium, which may be made later. */
static koksma_status use_medium(reader *r, const char *name)
{
    medium *m = *name ? find_medium(r, name) : NULL;
    if (m && !m->used.file) {
        m->used = r->source->place;
    }
    return m || !*name ? KOKSMA_OK : KOKSMA_MALFORMED;
}

/* Fails if a medium is used and nowhere made, as in pbrt. */
static koksma_status check_media(const reader *r)
{
    for (size_t i = 0; i < r->n_media; i++) {
        if (!r->media[i].is_made) {
            return koksma__import_fail(r->media[i].used, "no medium '%s'", r->media[i].name);
        }
    }
    return KOKSMA_OK;
}

static koksma_status take_medium(reader *r)
{
    const koksma__pbrt_parameters *p = r->parameters;
    medium *to = find_medium(r, r->texts[0]);
    if (!to) {
        return KOKSMA_MALFORMED;
    }
    to->is_made = true;
    if (strcmp(koksma__pbrt_word(p, "type"), "homogeneous") != 0 || koksma__pbrt_find(p, "preset") ||
        koksma__pbrt_find(p, "Le")) {
        return koksma__import_unknown(r->im, p->place,
                                      "media that vary in space, emit light or are presets are ignored");
    }
    KOKSMA__TRY(koksma__pbrt_coefficient(&r->values, p, "sigma_a", to->absorption));
    KOKSMA__TRY(koksma__pbrt_coefficient(&r->values, p, "sigma_s", to->scattering));
    to->g = fmax(-0.999, fmin(koksma__pbrt_number(p, "g"), 0.999));
    to->is_read = true;
    return KOKSMA_OK;
}

/* Reads the media inside and outside the shapes that follow; a single name is for both. */
static koksma_status take_interface(reader *r)
{
    const char *inside = r->texts[0], *outside = r->texts[1];
    koksma__pbrt_token t;
    memcpy(r->texts[1], inside, sizeof r->texts[1]);
    KOKSMA__TRY(koksma__pbrt_token_peek(r->source, &t));
    KOKSMA__TRY(t.kind == KOKSMA__PBRT_TEXT ? koksma__pbrt_text(r->source, r->texts[1], sizeof r->now.outside)
                                            : KOKSMA_OK);
    snprintf(r->now.outside, sizeof r->now.outside, "%.255s", outside);
    KOKSMA__TRY(use_medium(r, inside));
    KOKSMA__TRY(use_medium(r, outside));
    return koksma__import_unknown_if(
        (*inside && strcmp(inside, outside) != 0) || (r->has_camera && strcmp(outside, r->camera_medium) != 0), r->im,
        r->source->place, "media of shapes are ignored: the camera's medium is everywhere");
}

/* Keeps parameters for the directives of a target that follow, until the AttributeEnd. */
static koksma_status take_attribute(reader *r)
{
    static const char *const targets[][2] = {{"shape", "Shape"},
                                             {"light", "LightSource"},
                                             {"material", "Material"},
                                             {"medium", "MakeNamedMedium"},
                                             {"texture", "Texture"}};
    const char *target = r->texts[0];
    const koksma__pbrt_parameters *p = r->parameters;
    size_t which = 0;
    while (which < sizeof targets / sizeof *targets && strcmp(targets[which][0], target) != 0) {
        which++;
    }
    if (which == sizeof targets / sizeof *targets) {
        return koksma__import_fail(
            p->place, "Attribute: '%s' is not a target; shape, light, material, medium and texture are", target);
    }
    KOKSMA__TRY(koksma__pbrt_name_parameters(r->im, targets[which][1], NULL, p));
    for (size_t i = 0; i < p->n; i++) {
        KOKSMA__TRY(koksma__import_hold(r->im, p->place,
                                        sizeof *r->attributes + p->items[i].n * sizeof *p->items[i].numbers));
        koksma__pbrt_attribute *to = koksma__add_one(&r->attributes, &r->n_attributes, sizeof *to);
        KOKSMA__TRY(to ? KOKSMA_OK : KOKSMA_MEMORY);
        to->target = targets[which][0];
        KOKSMA__TRY(koksma__pbrt_parameter_copy(&p->items[i], &to->parameter));
    }
    r->now.n_attributes = r->n_attributes;
    return KOKSMA_OK;
}

/* ---- Files ------------------------------------------------------------------------------------------------- */

static koksma_status read_source(reader *r, source *s);

static koksma_status take_include(reader *r)
{
    char *bytes = NULL;
    size_t size = 0;
    if (r->depth == MOST_INCLUDED) {
        return koksma__import_fail(r->place, "files include each other more than %d deep", MOST_INCLUDED);
    }
    KOKSMA__TRY(koksma__import_text(r->im, r->place, r->texts[0], &bytes, &size));
    char **kept = koksma__add_one(&r->values.texts, &r->values.n_texts, sizeof *kept);
    char *name = kept ? strdup(r->texts[0]) : NULL;
    /* messages about places in the file point to the name, which must therefore be kept after the file is closed */
    if (!name) {
        koksma__import_text_close(r->im, bytes, size);
        return kept ? koksma__fail_memory(sizeof r->texts[0]) : KOKSMA_MEMORY;
    }
    *kept = name;
    source inner = {.at = bytes, .end = bytes + size, .place = {name, 1}};
    r->depth++;
    const koksma_status status = read_source(r, &inner);
    r->depth--;
    koksma__import_text_close(r->im, bytes, size);
    return status;
}

static const directive directives[] = {
    {"ActiveTransform", take_active, 0, 0, false, NONE, false, NULL},
    {"AreaLightSource", take_area_light, 0, 1, true, FIRST, true, "light"},
    {"Accelerator", NULL, 0, 1, true, FIRST, false, NULL},
    {"Attribute", take_attribute, 0, 1, true, NONE, false, NULL},
    {"AttributeBegin", push, 0, 0, false, NONE, false, NULL},
    {"AttributeEnd", take_end, 0, 0, false, NONE, false, NULL},
    {"Camera", take_camera, 0, 1, true, FIRST, true, NULL},
    {"ColorSpace", take_colour_space, 0, 1, true, NONE, false, NULL},
    {"ConcatTransform", take_transform, 16, 0, false, NONE, false, NULL},
    {"CoordSysTransform", take_coordinate_transform, 0, 1, false, NONE, false, NULL},
    {"CoordinateSystem", take_coordinate_system, 0, 1, false, NONE, false, NULL},
    {"Film", take_film, 0, 1, true, FIRST, true, NULL},
    {"Identity", take_identity, 0, 0, false, NONE, false, NULL},
    {"Import", take_include, 0, 1, false, NONE, false, NULL},
    {"Include", take_include, 0, 1, false, NONE, false, NULL},
    {"Integrator", take_integrator, 0, 1, true, FIRST, false, NULL},
    {"LightSource", take_light, 0, 1, true, FIRST, true, "light"},
    {"LookAt", take_look_at, 9, 0, false, NONE, false, NULL},
    {"MakeNamedMaterial", take_make_material, 0, 1, true, TYPE, true, "material"},
    {"MakeNamedMedium", take_medium, 0, 1, true, TYPE, true, "medium"},
    {"Material", take_material, 0, 1, true, FIRST, true, "material"},
    {"MediumInterface", take_interface, 0, 1, false, NONE, false, NULL},
    {"NamedMaterial", take_named_material, 0, 1, false, NONE, false, NULL},
    {"ObjectBegin", take_object_begin, 0, 1, false, NONE, false, NULL},
    {"ObjectEnd", take_object_end, 0, 0, false, NONE, false, NULL},
    {"ObjectInstance", take_instance, 0, 1, false, NONE, false, NULL},
    {"Option", take_option, 0, 0, true, NONE, false, NULL},
    {"PixelFilter", NULL, 0, 1, true, FIRST, false, NULL},
    {"ReverseOrientation", take_reverse, 0, 0, false, NONE, false, NULL},
    {"Rotate", take_rotate, 4, 0, false, NONE, false, NULL},
    {"Sampler", take_sampler, 0, 1, true, FIRST, false, NULL},
    {"Scale", take_scale, 3, 0, false, NONE, false, NULL},
    {"Shape", take_shape, 0, 1, true, FIRST, true, "shape"},
    {"Texture", take_texture, 0, 3, true, THIRD, true, "texture"},
    {"Transform", take_transform, 16, 0, false, NONE, false, NULL},
    {"TransformBegin", push, 0, 0, false, NONE, false, NULL},
    {"TransformEnd", take_end, 0, 0, false, NONE, false, NULL},
    {"TransformTimes", take_times, 2, 0, false, NONE, false, NULL},
    {"Translate", take_translate, 3, 0, false, NONE, false, NULL},
    {"WorldBegin", take_world, 0, 0, false, NONE, false, NULL}};

/* The number of warnings so far; a warning that occurs at several places counts once for each place. */
static size_t count_unknown(const reader *r)
{
    size_t n = 0;
    for (size_t i = 0; i < r->im->scene->n_unknown; i++) {
        n += r->im->scene->unknown[i].n;
    }
    return n;
}

/* The kind of the directive that is read; "" if it has none. */
static const char *kind_of(const reader *r)
{
    const koksma__pbrt_parameters *p = r->parameters;
    const kind_place where = r->directive->kind;
    const char *kind = where == FIRST || where == THIRD ? r->texts[where - FIRST] : "";
    for (size_t i = 0; where == TYPE && i < p->n; i++) {
        kind = strcmp(p->items[i].name, "type") ? kind : p->items[i].text;
    }
    return *kind || !strstr(r->directive->name, "Material") ? kind : "none";
}

/* Warns about a kind that pbrt-v4 does not have. */
static koksma_status name_kind(const reader *r, const char *name, const char *kind)
{
    char meant[KOKSMA__OR_MEANT];
    return koksma__import_unknown_if(!koksma__pbrt_is_kind(name, kind), r->im, r->parameters->place,
                                     "%s '%.40s' is not one of pbrt-v4%s", name, kind,
                                     koksma__pbrt_kind_meant(name, kind, meant));
}

/* Warns about parameters that pbrt-v4 would refuse, whoever reads the directive, before it is read. */
static koksma_status judge_parameters(void *from)
{
    const reader *r = from;
    const char *name = r->directive->name, *kind = kind_of(r);
    r->parameters->directive = name;
    r->parameters->kind = kind;
    if (!strcmp(name, "Attribute")) {
        return KOKSMA_OK; /* take_attribute() knows whose parameters they are */
    }
    const bool typed = r->directive->kind != TYPE || koksma__pbrt_find(r->parameters, "type");
    KOKSMA__TRY(r->directive->kind == TYPE && typed ? name_kind(r, name, kind) : KOKSMA_OK);
    KOKSMA__TRY(koksma__pbrt_name_parameters(r->im, name, typed ? kind : NULL, r->parameters));
    return typed ? KOKSMA_OK
                 : koksma__import_fail(r->parameters->place, "%s: its type is missing, as in \"string type\" \"%s\"",
                                       name, strcmp(name, "MakeNamedMedium") ? "diffuse" : "homogeneous");
}

/* Warns about a kind that pbrt-v4 does not have, and about parameters that nothing has looked up. n_before: the number of
   warnings before the directive was read; if there are more, these name its replacement as a whole. */
static koksma_status name_unread(reader *r, size_t n_before)
{
    const char *name = r->directive->name, *kind = kind_of(r);
    const bool silent = n_before == count_unknown(r);
    KOKSMA__TRY(r->directive->kind != NONE && silent ? name_kind(r, name, kind) : KOKSMA_OK);
    return r->directive->describes && silent ? koksma__pbrt_name_unused(r->im, name, kind, r->parameters) : KOKSMA_OK;
}

/* Reads what follows a directive's name up to its parameters' end. */
static koksma_status read_arguments(reader *r)
{
    const directive *d = r->directive;
    KOKSMA__TRY(d->numbers ? koksma__pbrt_numbers(r->source, d->numbers, r->numbers) : KOKSMA_OK);
    for (unsigned i = 0; i < d->texts; i++) {
        const bool is_path = d->take == take_include;
        KOKSMA__TRY(koksma__pbrt_text(r->source, r->texts[i], is_path ? sizeof r->texts[i] : 256));
    }
    r->place = r->source->place;
    return d->has_parameters ? koksma__pbrt_parameters_read(r->source, r->parameters) : KOKSMA_OK;
}

/* Reads a directive, and names what is not read of it. */
static koksma_status read_directive(reader *r, source *s, const directive *d)
{
    const size_t before = count_unknown(r), listed = r->im->scene->n_unknown;
    memset(r->used, 0, sizeof r->used);
    r->mistake.at = NULL;
    r->directive = d;
    r->source = s;
    s->directive = d->name;
    r->parameters->attributes = r->attributes;
    r->parameters->n_attributes = r->n_attributes;
    r->parameters->target = d->target ? d->target : "";
    KOKSMA__TRY(d->target ? koksma__import_spend(r->im, s->place, r->n_attributes) : KOKSMA_OK);
    koksma_status status = read_arguments(r);
    if (d->take == take_include) {
        return status ? status : take_include(r); /* its directives are done */
    }
    status = koksma__pbrt_end(r->parameters, status || !d->take ? status : d->take(r));
    const koksma__unknown *list = r->im->scene->unknown;
    status = koksma__unknown_explain(status, list, r->im->scene->n_unknown > listed ? listed + 1 : 0);
    status = status ? status : name_unread(r, before);
    koksma__pbrt_parameters_fini(r->parameters);
    return status;
}

static koksma_status read_source(reader *r, source *s)
{
    for (;;) {
        koksma__pbrt_token t;
        KOKSMA__TRY(koksma__pbrt_token_next(s, &t));
        if (t.kind == KOKSMA__PBRT_END) {
            return KOKSMA_OK;
        }
        size_t i = 0;
        const size_t n = sizeof directives / sizeof *directives;
        while (i < n && (*directives[i].name != *t.at || !koksma__text_is(t.at, t.length, directives[i].name))) {
            i++;
        }
        if (t.kind != KOKSMA__PBRT_WORD || i == n) {
            koksma__word_list names = {.n = 0};
            char meant[KOKSMA__OR_MEANT], word[48];
            for (i = 0; i < n; i++) {
                koksma__word_list_add(&names, directives[i].name, strlen(directives[i].name), "", "");
            }
            snprintf(word, sizeof word, "%.*s", t.length < 40 ? (int)t.length : 40, t.at);
            return koksma__import_fail(s->place, "'%s' is not a directive of pbrt-v4%s", word,
                                       !strcmp(word, "WorldEnd")
                                           ? " but of pbrt-v3; 'pbrt --upgrade FILE' prints a file as one of pbrt-v4"
                                           : koksma__or_meant(koksma__word_list_closest(&names, word), meant));
        }
        KOKSMA__TRY(read_directive(r, s, &directives[i]));
    }
}

/* Sets the screen window of a file that has none: -1 to 1 along the shorter side of the image, or of the frame if the
   parameter frameaspectratio is given. */
static void default_window(reader *r, double aspect)
{
    const double frame = r->frame > 0 ? r->frame : aspect, x = fmax(frame, 1), y = fmax(1 / frame, 1);
    const double window[4] = {-x, x, -y, y};
    memcpy(r->window, window, sizeof window);
}

/* Checks the shape of the screen window. Its coordinates -1 and 1 are at the edges of the angle of view. */
static koksma_status check_window(reader *r, double aspect)
{
    const double *w = r->window, height = w[3] - w[2];
    if (!(w[1] > w[0] && w[3] > w[2])) {
        return koksma__import_fail(r->camera_place, "the screen window is empty; it is x from, x to, y from, y to");
    }
    return koksma__import_unknown_if(
        fabs((w[1] - w[0]) / height - aspect) > 1e-3 * aspect, r->im, r->camera_place,
        "the screen window and the image have different aspect ratios: the window's height is used");
}

/* Sets the camera's motion, which is straight here: a camera that turns as well stays at rest. */
static koksma_status set_motion(reader *r, double motion[3])
{
    double largest = 0;
    bool turns = false;
    for (int i = 0; i < 9; i++) {
        largest = fmax(largest, fabs(r->camera[0][i / 3 * 4 + i % 3]));
    }
    for (int i = 0; i < 12; i++) {
        const double change = r->camera[1][i] - r->camera[0][i];
        turns |= i % 4 < 3 && fabs(change) > 1e-6 * largest;
        motion[i / 4] = i % 4 == 3 ? change : 0;
        if (i % 4 == 3 && !(fabs(r->camera[1][i]) <= FAR)) {
            return koksma__import_fail(r->camera_place, "the camera moves beyond 1e6");
        }
    }
    if (turns) {
        memset(motion, 0, 3 * sizeof *motion);
        return koksma__import_unknown(r->im, r->camera_place, "the camera turns or zooms: it stays as at the start");
    }
    return KOKSMA_OK;
}

/* Sets the camera. pbrt's angle of view is that of a screen window of -1 to 1. */
static koksma_status set_camera(reader *r)
{
    const double aspect = r->film[0] / r->film[1], *w = r->window;
    if (!r->has_camera) {
        return koksma__import_fail((koksma__text_place){r->im->path, 1}, "no Camera");
    }
    koksma__camera camera = {.lens_radius = r->lens_radius, .focus_distance = r->focus_distance};
    if (!r->has_window) {
        default_window(r, aspect);
    }
    KOKSMA__TRY(check_window(r, aspect));
    KOKSMA__TRY(set_motion(r, camera.motion));
    /* what the film shows from top to bottom, and the middle of the picture from that of the window, to the right and up */
    const double height = r->orthographic ? w[3] - w[2] : koksma__tan(r->fov_deg * TURN / 720) * (w[3] - w[2]);
    const double part = (r->crop[3] - r->crop[2]) / r->film[1];
    const double x = ((r->crop[0] + r->crop[1]) / 2 - r->film[0] / 2) * height / r->film[1];
    const double y = (r->film[1] / 2 - (r->crop[2] + r->crop[3]) / 2) * height / r->film[1];
    if (r->orthographic) {
        camera.height = height * part;
        for (int k = 0; k < 3; k++) { /* moves the camera to the middle of the window */
            double *row = r->camera[0] + 4 * k;
            row[3] += ((w[0] + w[1]) / 2 + x) * row[0] + ((w[2] + w[3]) / 2 + y) * row[1];
        }
    } else {
        const double half = koksma__tan(r->fov_deg * TURN / 720);
        camera.fov_rad = 2 * koksma__atan(height * part / 2);
        camera.shift[0] = x + (w[0] + w[1]) / 2 * half;
        camera.shift[1] = -y - (w[2] + w[3]) / 2 * half;
    }
    return koksma__import_camera(r->im, r->camera_place, r->camera[0], 1, &camera);
}

/* Sets the times at which the shutter opens and closes, as fractions of the interval of the motion (TransformTimes).
   Without an exposure all lights are black. */
static koksma_status set_shutter(reader *r)
{
    koksma_scene *scene = r->im->scene;
    const double length = r->times[1] - r->times[0];
    koksma__scene_finish(scene);
    if (scene->n_lights && !(r->values.exposure > 0)) {
        return koksma__import_fail(
            r->camera_place,
            "a shutter that is open from %g to %g, at ISO %g, makes all light black; pbrt refuses it", r->shutter[0],
            r->shutter[1], r->iso);
    }
    if (!scene->moves) {
        return KOKSMA_OK;
    }
    if (!(length > 0 && r->shutter[0] <= r->shutter[1])) {
        return koksma__import_fail(r->camera_place, "TransformTimes or the shutter end before they begin");
    }
    for (int i = 0; i < 2; i++) {
        scene->camera.shutter[i] = fmin(fmax((r->shutter[i] - r->times[0]) / length, -FAR), FAR);
    }
    return KOKSMA_OK;
}

/* Fills the scene with the medium that contains the camera. */
static koksma_status set_medium(reader *r)
{
    koksma__medium *to = &r->im->scene->medium;
    size_t i;
    if (*r->camera_medium && koksma__names_find(&r->medium_names, r->camera_medium, strlen(r->camera_medium), &i) &&
        r->media[i].is_read) {
        koksma__medium_init(to, r->media[i].absorption, r->media[i].scattering, r->media[i].g);
    }
    if (koksma__medium_check(r->im->scene)) {
        to->is_there = false;
        return koksma__import_unknown(
            r->im, r->camera_place,
            "the camera's medium is ignored, because it would absorb all light of distant lights");
    }
    return KOKSMA_OK;
}

/* Whether the text has a line that begins with WorldEnd, which pbrt-v4 does not have. */
static bool is_of_v3(const char *text, size_t size)
{
    static const char end[] = "\nWorldEnd";
    const size_t length = sizeof end - 1;
    for (const char *at = text; size >= length && (at = memchr(at, '\n', size - length + 1 - (size_t)(at - text)));
         at++) {
        if (!memcmp(at, end, length)) {
            return true;
        }
    }
    return false;
}

koksma_status koksma__pbrt_read(koksma__import *im, const char *text, size_t size)
{
    reader r = {.im = im,
                .values = {.im = im, .exposure = 1},
                .shutter = {0, 1},
                .iso = 100,
                .film = {1280, 720},
                .crop = {0, 1280, 0, 720},
                .now.surface.material = -2,
                .now.active = START | END,
                .times = {0, 1}};
    source s = {.at = text, .end = text + size, .place = {im->path, 1}};
    im->scene->width = 1280;
    im->scene->height = 720;
    im->scene->paths = true;
    r.parameters = calloc(1, sizeof *r.parameters);
    KOKSMA__REQUIRE_MEMORY(r.parameters, sizeof *r.parameters);
    r.parameters->place = s.place;
    r.parameters->used = r.used;
    r.parameters->directive = r.parameters->kind = r.parameters->target = "";
    r.parameters->mistake = &r.mistake;
    r.parameters->judge = judge_parameters;
    r.parameters->reader = &r;
    r.place = s.place;
    koksma_status status = take_identity(&r);
    status = status ? status : name_space(&r, "world", r.now.matrix);
    status = status ? status : koksma__pbrt_material(&r.values, "diffuse", r.parameters, &r.now.surface.material);
    status = status ? status : read_source(&r, &s);
    status =
        status ? status
               : koksma__import_unknown_if(!r.in_world, im, s.place,
                                           "no WorldBegin, from which on the scene is described: what precedes it is "
                                           "read as if it followed");
    status = status
                 ? status
                 : koksma__import_unknown_if(r.n_stack > 0, im, s.place,
                                             "%zu AttributeBegin or ObjectBegin without an end: what follows keeps "
                                             "their transforms and materials",
                                             r.n_stack);
    if (status == KOKSMA_MALFORMED && is_of_v3(text, size) && !strstr(koksma_error_text(), "pbrt-v3")) {
        status = koksma__fail(status, "%s; the file is of pbrt-v3: 'pbrt --upgrade FILE' prints one of pbrt-v4",
                              koksma_error_text());
    }
    status = status ? status : check_media(&r);
    status = status ? status : set_camera(&r);
    status = status ? status : set_medium(&r);
    status = status ? status : set_shutter(&r);
    for (size_t i = 0; i < r.n_objects; i++) {
        free(r.objects[i].items);
    }
    for (size_t i = 0; i < r.n_attributes; i++) {
        free(r.attributes[i].parameter.numbers);
    }
    KOKSMA__FREE(r.objects, r.spaces, r.media, r.stack, r.parameters, r.attributes);
    koksma__names_fini(&r.medium_names);
    koksma__names_fini(&r.space_names);
    koksma__names_fini(&r.object_names);
    koksma__pbrt_scene_fini(&r.values);
    return status;
}
