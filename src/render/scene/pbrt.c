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
    size_t listed; /* the length of the list of warnings before it */
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
    void (*take)(reader *r); /* NULL: it does not describe the scene */
    unsigned numbers, texts; /* how many of them follow the name */
    bool has_parameters;
    kind_place kind;
    bool describes;     /* the parameters describe the scene, so that each unused one gives a warning */
    const char *target; /* of the attributes that it inherits; or NULL */
} directive;

/* ---- Transforms -------------------------------------------------------------------------------------------- */

/* Multiplies the active matrices by another, or, if `replaces`, replaces them. */
static void change(reader *r, const double by[12], bool replaces)
{
    for (unsigned i = 0; i < 2; i++) {
        double product[12];
        if (r->now.active >> i & 1) {
            koksma__matrix_multiply(replaces ? koksma__import_identity : r->now.matrix[i], by, product);
            memcpy(r->now.matrix[i], product, sizeof product);
        }
    }
}

static void take_identity(reader *r)
{
    change(r, koksma__import_identity, true);
}

static void take_translate(reader *r)
{
    const double *v = r->numbers;
    change(r, (const double[12]){1, 0, 0, v[0], 0, 1, 0, v[1], 0, 0, 1, v[2]}, false);
}

static void take_scale(reader *r)
{
    const double *v = r->numbers;
    change(r, (const double[12]){v[0], 0, 0, 0, 0, v[1], 0, 0, 0, 0, v[2], 0}, false);
}

static void take_rotate(reader *r)
{
    double m[12];
    koksma__import_fail_if(!koksma__import_rotation(r->numbers[0], r->numbers + 1, m), r->place,
                           "Rotate: the axis has no direction");
    change(r, m, false);
}

static void take_look_at(reader *r)
{
    double m[12], inverse[12];
    koksma__import_look_at(r->place, "LookAt", r->numbers, r->numbers + 3, r->numbers + 6, m);
    koksma__import_invert(m, inverse);
    change(r, inverse, false);
}

/* Reads a matrix, which is given column by column. */
static void take_transform(reader *r)
{
    double m[12];
    for (int i = 0; i < 12; i++) {
        m[i] = r->numbers[4 * (i % 4) + i / 4];
    }
    change(r, m, *r->directive->name == 'T');
}

static void name_space(reader *r, const char *name, double (*matrix)[12])
{
    koksma__import_hold(r->place, sizeof(space) + KOKSMA__HELD_WITH_NAME);
    space *to = koksma__import_add(r->place, &r->spaces, &r->n_spaces, sizeof *to);
    memcpy(to->matrix, matrix, sizeof to->matrix);
    koksma__import_put_name(r->place, &r->space_names, name, r->n_spaces - 1);
}

static void take_coordinate_system(reader *r)
{
    name_space(r, r->texts[0], r->now.matrix);
}

/* Finds the thing that the directive names. */
static size_t find_named(const reader *r, const koksma__names *names, const char *what)
{
    size_t i = 0;
    koksma__import_fail_if(!koksma__names_find(names, r->texts[0], strlen(r->texts[0]), &i), r->place, "no %s '%s'",
                           what, r->texts[0]);
    return i;
}

static void take_coordinate_transform(reader *r)
{
    const space *from = &r->spaces[find_named(r, &r->space_names, "coordinate system")];
    memcpy(r->now.matrix, from->matrix, sizeof r->now.matrix);
}

static void take_active(reader *r)
{
    static const char *const all[] = {[START] = "StartTime", [END] = "EndTime", [START | END] = "All"};
    const koksma__pbrt_token t = koksma__pbrt_token_next(r->source);
    unsigned which = START;
    while (which <= (START | END) && !(t.kind == KOKSMA__PBRT_WORD && koksma__text_is(t.at, t.length, all[which]))) {
        which++;
    }
    koksma__import_fail_if(which > (START | END), r->source->place, "ActiveTransform is StartTime, EndTime or All");
    r->now.active = which;
}

static void take_times(reader *r)
{
    memcpy(r->times, r->numbers, sizeof r->times);
}

/* Whether something placed by the two matrices moves. */
static bool moves(const double *start, const double *end)
{
    return memcmp(start, end, 12 * sizeof *start) != 0;
}

/* Finds the poses at the start and the end of a motion, from the matrices. Returns false, with a warning, if there are
   none. */
static bool find_poses(const reader *r, koksma__pose poses[2])
{
    const double *start = r->now.matrix[0], *end = r->now.matrix[1];
    const bool found = koksma__matrix_mirrors(start) == koksma__matrix_mirrors(end) &&
                       koksma__pose_of_matrix(start, &poses[0]) && koksma__pose_of_matrix(end, &poses[1]);
    koksma__import_unknown_if(!found, r->place, "a motion that mirrors, or by a matrix without inverse, is ignored");
    return found;
}

/* ---- States ------------------------------------------------------------------------------------------------ */

static void push(reader *r)
{
    koksma__import_fail_if(r->n_stack == MOST_STATES, r->place, "more than %d attributes or objects are open",
                           MOST_STATES);
    graphics *to = koksma__import_add(r->place, &r->stack, &r->n_stack, sizeof *to);
    *to = r->now;
}

/* Takes the top entry from the stack, and restores the graphics state or the matrices from it. The stack keeps its
   memory, because koksma__add_one() computes the capacity from nothing but the number of items. */
static void pop(reader *r, bool matrix_alone)
{
    koksma__import_fail_if(!r->n_stack, r->place, "an AttributeEnd, ObjectEnd or TransformEnd without its begin");
    const graphics *from = &r->stack[--r->n_stack];
    if (matrix_alone) {
        memcpy(r->now.matrix, from->matrix, sizeof from->matrix);
        r->now.active = from->active;
        return;
    }
    r->now = *from;
    while (r->n_attributes > r->now.n_attributes) {
        free(r->attributes[--r->n_attributes].parameter.numbers);
    }
}

static void take_end(reader *r)
{
    pop(r, *r->directive->name == 'T');
}

static void take_reverse(reader *r)
{
    r->now.surface.turned = !r->now.surface.turned;
}

static void take_world(reader *r)
{
    r->now.active = START | END;
    r->in_world = true;
    take_identity(r);
}

static void take_object_begin(reader *r)
{
    koksma__import_fail_if(r->in_object, r->place, "an object within another object");
    push(r);
    koksma__import_hold(r->place, sizeof(object) + KOKSMA__HELD_WITH_NAME);
    koksma__import_add(r->place, &r->objects, &r->n_objects, sizeof(object));
    r->in_object = true;
    snprintf(r->object_name, sizeof r->object_name, "%.255s", r->texts[0]);
}

static void take_object_end(reader *r)
{
    koksma__import_fail_if(!r->in_object, r->place, "ObjectEnd without ObjectBegin");
    koksma__import_put_name(r->place, &r->object_names, r->object_name, r->n_objects - 1);
    r->in_object = false;
    pop(r, false);
}

static void take_instance(reader *r)
{
    const object *o = &r->objects[find_named(r, &r->object_names, "object")];
    koksma__pose poses[2];
    const bool moving = moves(r->now.matrix[0], r->now.matrix[1]) && find_poses(r, poses);
    for (size_t k = 0; k < o->n; k++) {
        koksma__import_put(&o->items[k], r->now.matrix[0], moving ? poses : NULL);
    }
}

/* ---- Shapes and lights ------------------------------------------------------------------------------------- */

static void take_shape(reader *r)
{
    double form[12];
    koksma__import_item item = {.surface = r->now.surface, .place = r->place};
    if (r->in_object && item.surface.emits) {
        item.surface.emits = false;
        koksma__import_unknown(r->place, "a light within an object is dark");
    }
    memcpy(form, koksma__import_identity, sizeof form);
    if (!koksma__pbrt_shape(&r->values, r->texts[0], r->parameters, r->now.power, r->now.matrix[0], &item, form)) {
        return;
    }
    koksma__matrix_multiply(r->now.matrix[0], form, item.matrix);
    if (moves(r->now.matrix[0], r->now.matrix[1])) {
        memcpy(item.motion.before, form, sizeof form);
        item.motion.moves = find_poses(r, item.motion.poses);
    }
    if (!r->in_object) {
        koksma__import_put(&item, NULL, NULL);
        return;
    }
    object *open = &r->objects[r->n_objects - 1];
    koksma__import_hold(r->place, sizeof item);
    koksma__import_item *to = koksma__import_add(r->place, &open->items, &open->n, sizeof *to);
    *to = item;
}

static void take_area_light(reader *r)
{
    koksma__import_surface *surface = &r->now.surface;
    surface->emits = true;
    surface->two_sided = koksma__pbrt_flag(r->parameters, "twosided");
    r->now.power = koksma__pbrt_number(r->parameters, "power");
    koksma__pbrt_emission(&r->values, r->parameters, "L", surface->radiance);
}

/* Scales a light's colour so that it has the power or illuminance that the parameters give. */
static void scale_light(koksma__pbrt_parameters *p, const char *type, double rgb[3])
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

static void take_light(reader *r)
{
    const char *type = r->texts[0];
    koksma__pbrt_parameters *p = r->parameters;
    koksma__light light = {.kind = &koksma__light_point};
    double from[3] = {0}, to[3] = {0, 0, 1}, along[3];
    const bool far = !strcmp(type, "distant"), around = !strcmp(type, "infinite"), spot = !strcmp(type, "spot");
    koksma__pbrt_emission(&r->values, p, far || around ? "L" : "I", light.radiance);
    koksma__import_unknown_if(moves(r->now.matrix[0], r->now.matrix[1]), p->place,
                              "a moving light stays where it is at the start");
    koksma__pbrt_point(p, "from", from);
    koksma__pbrt_point(p, "to", to);
    if (around && *koksma__pbrt_word(p, "filename")) {
        koksma__import_sky(p->place, koksma__pbrt_word(p, "filename"), koksma__pbrt_number(p, "illuminance"),
                           light.radiance, r->now.matrix[0]);
        return;
    }
    scale_light(p, type, light.radiance);
    koksma__subtract(to, from, to);
    koksma__import_apply(r->now.matrix[0], to, 0, along);
    if (around) {
        light.kind = &koksma__light_environment;
        light.visible = true;
    } else if (far) {
        light.kind = &koksma__light_directional;
        memcpy(light.normal, along, sizeof along);
        koksma__import_fail_if(!koksma__import_normalise(light.normal), p->place,
                               "a distant light without a direction");
    } else {
        koksma__import_apply(r->now.matrix[0], from, 1, light.centre);
    }
    if (spot) {
        const double outer = koksma__pbrt_number(p, "coneangle");
        koksma__import_spot(p->place, along, outer - koksma__pbrt_number(p, "conedeltaangle"), outer,
                            KOKSMA__FALLOFF_SMOOTH, &light);
    }
    koksma__import_unknown_if(!around && !far && !spot && strcmp(type, "point") != 0, p->place,
                              "light '%s' is replaced by a point light equal in all directions%s", type,
                              koksma__pbrt_kind_meant("LightSource", type, (char[KOKSMA__OR_MEANT]){0}));
    koksma__import_light(p->place, &light);
}

/* What the film makes of radiance, in pbrt-v4: the time for which the shutter is open, or the film's own exposure time of
   earlier versions, times its sensitivity. Lights, which come after the film and the camera, get this factor. */
static void set_exposure(reader *r)
{
    const double open = r->shutter[1] - r->shutter[0];
    r->values.exposure = (r->exposure_time > 0 ? r->exposure_time : open) * r->iso / 100;
}

static void take_camera(reader *r)
{
    const char *type = r->texts[0];
    koksma__pbrt_parameters *p = r->parameters;
    r->orthographic = !strcmp(type, "orthographic");
    koksma__import_fail_if(!r->orthographic && strcmp(type, "perspective") != 0, p->place,
                           "camera '%s' is not read; 'perspective' and 'orthographic' are", type);
    koksma__import_fail_if(!koksma__import_invert(r->now.matrix[0], r->camera[0]) ||
                               !koksma__import_invert(r->now.matrix[1], r->camera[1]),
                           p->place, "the camera's matrix has no inverse");
    koksma__import_unknown_if(r->in_world, p->place, "a Camera after WorldBegin, which pbrt refuses");
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
    r->has_window = window != NULL;
    koksma__import_fail_if(window && window->n != 4, p->place,
                           "a screen window is four numbers: x from, x to, y from, y to");
    if (window) {
        memcpy(r->window, window->numbers, sizeof r->window);
    }
    r->frame = fmax(koksma__pbrt_number(p, "frameaspectratio"), 0);
    name_space(r, "camera", r->camera);
}

/* Reads the part of the film that is the picture, in pixels: x from [0] to [1], y from [2] to [3]. A crop window is in
   fractions of the film, whose pixels are rounded upwards, and has priority over bounds in pixels, as in pbrt. */
static void take_crop(koksma__pbrt_parameters *p, const double sides[2], double crop[4])
{
    const koksma__pbrt_parameter *window = koksma__pbrt_find_typed(p, "cropwindow", "float"),
                                 *bounds = koksma__pbrt_find_typed(p, "pixelbounds", "integer"),
                                 *from = window ? window : bounds;
    const char *name = from ? from->name : "";
    koksma__import_fail_if(from && from->n != 4, p->place, "%s: it is four numbers: x from, x to, y from, y to",
                           name);
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
    koksma__import_fail_if(!(crop[0] < crop[1] && crop[2] < crop[3]), p->place, "%s: no pixel of the film is in it",
                           name);
}

static void take_film(reader *r)
{
    koksma__pbrt_parameters *p = r->parameters;
    const double width = koksma__pbrt_whole(p, "xresolution"), height = koksma__pbrt_whole(p, "yresolution");
    koksma__import_fail_if(
        !(width >= 1 && height >= 1 && width <= KOKSMA_MAX_IMAGE_SIDE && height <= KOKSMA_MAX_IMAGE_SIDE), p->place,
        "a film of %g x %g pixels; each side must be 1 to %d", width, height, KOKSMA_MAX_IMAGE_SIDE);
    r->film[0] = width;
    r->film[1] = height;
    take_crop(p, r->film, r->crop);
    r->im->scene->width = (int)(r->crop[1] - r->crop[0]);
    r->im->scene->height = (int)(r->crop[3] - r->crop[2]);
    koksma__import_unknown_if(r->in_world, p->place, "a Film after WorldBegin, which pbrt refuses");
    r->iso = koksma__pbrt_number(p, "iso");
    r->exposure_time = koksma__pbrt_number(p, "exposuretime");
    set_exposure(r);
    const char *sensor = koksma__pbrt_word(p, "sensor");
    koksma__import_unknown_if(*sensor && strcmp(sensor, "cie1931"), p->place,
                              "the sensor '%.40s' is replaced by 'cie1931'", sensor);
}

/* ---- Materials and textures --------------------------------------------------------------------------------- */

static void take_material(reader *r)
{
    r->now.surface.material = koksma__pbrt_material(&r->values, r->texts[0], r->parameters);
}

static void take_make_material(reader *r)
{
    koksma__pbrt_name_material(&r->values, r->texts[0], r->parameters);
}

static void take_named_material(reader *r)
{
    r->now.surface.material = koksma__pbrt_find_material(&r->values, r->place, r->texts[0]);
}

static void take_texture(reader *r)
{
    koksma__pbrt_texture(&r->values, r->texts[0], r->texts[1], r->texts[2], r->parameters);
}

/* An integrator that shows something else than the light of the scene is named. */
static void take_integrator(reader *r)
{
    const char *type = r->texts[0];
    koksma__import_unknown_if(!strcmp(type, "ambientocclusion") || !strcmp(type, "function"), r->place,
                              "integrator '%s' is ignored: the picture shows the scene's light", type);
}

/* The points are those of the program's own options; `koksma rank` takes their number from here. */
static void take_sampler(reader *r)
{
    koksma__pbrt_parameters *p = r->parameters;
    const double n = !strcmp(r->texts[0], "stratified")
                         ? koksma__pbrt_whole(p, "xsamples") * koksma__pbrt_whole(p, "ysamples")
                         : koksma__pbrt_whole(p, "pixelsamples");
    r->im->scene->spp = n >= 1 && n <= KOKSMA_MAX_SPP ? (int)n : 0;
}

static void take_option(reader *r)
{
    koksma__import_unknown_if(koksma__pbrt_flag(r->parameters, "forcediffuse"), r->place,
                              "option 'forcediffuse' is ignored");
}

static void take_colour_space(reader *r)
{
    koksma__import_unknown_if(strcasecmp(r->texts[0], "srgb") != 0, r->place, "colour space '%s' is replaced by sRGB",
                              r->texts[0]);
}

/* Finds the medium with this name, or adds it. */
static medium *find_medium(reader *r, const char *name)
{
    size_t i;
    if (koksma__names_find(&r->medium_names, name, strlen(name), &i)) {
        return &r->media[i];
    }
    koksma__import_hold(r->place, sizeof(medium) + KOKSMA__HELD_WITH_NAME);
    medium *to = koksma__import_add(r->place, &r->media, &r->n_media, sizeof *to);
    koksma__import_put_name(r->place, &r->medium_names, name, r->n_media - 1);
    snprintf(to->name, sizeof to->name, "%s", name);
    return to;
}

/* Remembers the first use of a medium, which may be made later. */
static void use_medium(reader *r, const char *name)
{
    medium *m = *name ? find_medium(r, name) : NULL;
    if (m && !m->used.file) {
        m->used = r->source->place;
    }
}

static void take_medium(reader *r)
{
    koksma__pbrt_parameters *p = r->parameters;
    medium *to = find_medium(r, r->texts[0]);
    to->is_made = true;
    if (strcmp(koksma__pbrt_word(p, "type"), "homogeneous") != 0 || koksma__pbrt_find(p, "preset") ||
        koksma__pbrt_find(p, "Le")) {
        koksma__import_unknown(p->place, "media that vary in space, emit light or are presets are ignored");
        return;
    }
    koksma__pbrt_coefficient(&r->values, p, "sigma_a", to->absorption);
    koksma__pbrt_coefficient(&r->values, p, "sigma_s", to->scattering);
    to->g = fmax(-0.999, fmin(koksma__pbrt_number(p, "g"), 0.999));
    to->is_read = true;
}

/* Reads the media inside and outside the shapes that follow; a single name is for both. */
static void take_interface(reader *r)
{
    const char *inside = r->texts[0], *outside = r->texts[1];
    memcpy(r->texts[1], inside, sizeof r->texts[1]);
    if (koksma__pbrt_token_peek(r->source).kind == KOKSMA__PBRT_TEXT) {
        koksma__pbrt_text(r->source, r->texts[1], sizeof r->now.outside);
    }
    snprintf(r->now.outside, sizeof r->now.outside, "%.255s", outside);
    use_medium(r, inside);
    use_medium(r, outside);
    koksma__import_unknown_if((*inside && strcmp(inside, outside) != 0) ||
                                  (r->has_camera && strcmp(outside, r->camera_medium) != 0),
                              r->source->place, "media of shapes are ignored: the camera's medium is everywhere");
}

/* Keeps parameters for the directives of a target that follow, until the AttributeEnd. */
static void take_attribute(reader *r)
{
    static const char *const targets[][2] = {{"shape", "Shape"},
                                             {"light", "LightSource"},
                                             {"material", "Material"},
                                             {"medium", "MakeNamedMedium"},
                                             {"texture", "Texture"}};
    const size_t n_targets = sizeof targets / sizeof *targets;
    const koksma__pbrt_parameters *p = r->parameters;
    size_t which = 0;
    while (which < n_targets && strcmp(targets[which][0], r->texts[0]) != 0) {
        which++;
    }
    koksma__import_fail_if(which == n_targets, p->place,
                           "Attribute: '%s' is not a target; shape, light, material, medium and texture are",
                           r->texts[0]);
    koksma__pbrt_name_parameters(targets[which][1], NULL, p);
    for (size_t i = 0; i < p->n; i++) {
        koksma__import_hold(p->place, sizeof *r->attributes + p->items[i].n * sizeof *p->items[i].numbers);
        koksma__pbrt_attribute *to = koksma__import_add(p->place, &r->attributes, &r->n_attributes, sizeof *to);
        to->target = targets[which][0];
        koksma__pbrt_parameter_copy(p->place, &p->items[i], &to->parameter);
    }
    r->now.n_attributes = r->n_attributes;
}

/* ---- Files ------------------------------------------------------------------------------------------------- */

static void read_source(reader *r, source *s);

static void take_include(reader *r)
{
    koksma__import_fail_if(r->depth == MOST_INCLUDED, r->place, "files include each other more than %d deep",
                           MOST_INCLUDED);
    const koksma__open_text text = koksma__import_text(r->place, r->texts[0]);
    source inner = {.at = text.bytes, .end = text.bytes + text.size, .place = {r->im, text.name, 1}};
    r->depth++;
    read_source(r, &inner);
    r->depth--;
    koksma__import_text_close(r->im);
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
static void name_kind(const reader *r, const char *name, const char *kind)
{
    char meant[KOKSMA__OR_MEANT];
    koksma__import_unknown_if(!koksma__pbrt_is_kind(name, kind), r->parameters->place,
                              "%s '%.40s' is not one of pbrt-v4%s", name, kind,
                              koksma__pbrt_kind_meant(name, kind, meant));
}

/* Warns about parameters that pbrt-v4 would refuse, whoever reads the directive, before it is read. */
static void judge_parameters(const reader *r)
{
    const char *name = r->directive->name, *kind = kind_of(r);
    r->parameters->directive = name;
    r->parameters->kind = kind;
    if (!strcmp(name, "Attribute")) {
        return; /* take_attribute() knows whose parameters they are */
    }
    const bool typed = r->directive->kind != TYPE || koksma__pbrt_find(r->parameters, "type");
    if (r->directive->kind == TYPE && typed) {
        name_kind(r, name, kind);
    }
    koksma__pbrt_name_parameters(name, typed ? kind : NULL, r->parameters);
    koksma__import_fail_if(!typed, r->parameters->place, "%s: its type is missing, as in \"string type\" \"%s\"",
                           name, strcmp(name, "MakeNamedMedium") ? "diffuse" : "homogeneous");
}

/* Reads what follows a directive's name up to its parameters' end. */
static void read_arguments(reader *r)
{
    const directive *d = r->directive;
    if (d->numbers) {
        koksma__pbrt_numbers(r->source, d->numbers, r->numbers);
    }
    for (unsigned i = 0; i < d->texts; i++) {
        koksma__pbrt_text(r->source, r->texts[i], d->take == take_include ? sizeof r->texts[i] : 256);
    }
    r->place = r->source->place;
    if (d->has_parameters) {
        koksma__pbrt_parameters_read(r->source, r->parameters);
        judge_parameters(r);
    }
}

enum { NO_DIRECTIVE = -1 }; /* in place of r->listed */

/* Reads a directive, and names what is not read of it. */
static void read_directive(reader *r, source *s, const directive *d)
{
    koksma__pbrt_parameters *p = r->parameters;
    const size_t before = count_unknown(r);
    memset(p->used, 0, sizeof p->used);
    r->listed = d->take == take_include ? (size_t)NO_DIRECTIVE : r->im->scene->n_unknown;
    r->directive = d;
    r->source = s;
    s->directive = d->name;
    p->attributes = r->attributes;
    p->n_attributes = r->n_attributes;
    p->target = d->target ? d->target : "";
    koksma__import_spend(s->place, d->target ? r->n_attributes : 0);
    read_arguments(r);
    if (d->take) {
        d->take(r);
    }
    r->listed = (size_t)NO_DIRECTIVE;
    if (d->take == take_include) {
        return; /* its directives are done */
    }
    const bool silent = before == count_unknown(r); /* else warnings name its replacement as a whole */
    if (silent && d->kind != NONE) {
        name_kind(r, d->name, kind_of(r));
    }
    if (silent && d->describes) {
        koksma__pbrt_name_unused(p);
    }
    koksma__pbrt_parameters_fini(p);
}

static const directive *find_directive(const source *s, const koksma__pbrt_token *t)
{
    const directive *d = directives, *end = directives + sizeof directives / sizeof *directives;
    while (d < end && (*d->name != *t->at || !koksma__text_is(t->at, t->length, d->name))) {
        d++;
    }
    if (t->kind == KOKSMA__PBRT_WORD && d < end) {
        return d;
    }
    koksma__word_list names = {.n = 0};
    char meant[KOKSMA__OR_MEANT], word[48];
    for (d = directives; d < end; d++) {
        koksma__word_list_add(&names, d->name, strlen(d->name), "", "");
    }
    snprintf(word, sizeof word, "%.*s", t->length < 40 ? (int)t->length : 40, t->at);
    koksma__import_fail(s->place, "'%s' is not a directive of pbrt-v4%s", word,
                        !strcmp(word, "WorldEnd")
                            ? " but of pbrt-v3; 'pbrt --upgrade FILE' prints a file as one of pbrt-v4"
                            : koksma__or_meant(koksma__word_list_closest(&names, word), meant));
}

static void read_source(reader *r, source *s)
{
    koksma__pbrt_token t = koksma__pbrt_token_next(s);
    for (; t.kind != KOKSMA__PBRT_END; t = koksma__pbrt_token_next(s)) {
        read_directive(r, s, find_directive(s, &t));
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

/* Sets the camera's motion, which is straight here: a camera that turns as well stays at rest. */
static void set_motion(reader *r, double motion[3])
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
        koksma__import_fail_if(i % 4 == 3 && !(fabs(r->camera[1][i]) <= FAR), r->camera_place,
                               "the camera moves beyond 1e6");
    }
    if (turns) {
        memset(motion, 0, 3 * sizeof *motion);
        koksma__import_unknown(r->camera_place, "the camera turns or zooms: it stays as at the start");
    }
}

/* Sets the camera. pbrt's angle of view is that of a screen window of -1 to 1. */
static void set_camera(reader *r)
{
    const double aspect = r->film[0] / r->film[1], *w = r->window;
    koksma__import_fail_if(!r->has_camera, (koksma__text_place){r->im, r->im->path, 1}, "no Camera");
    koksma__camera camera = {.lens_radius = r->lens_radius, .focus_distance = r->focus_distance};
    if (!r->has_window) {
        default_window(r, aspect);
    }
    koksma__import_fail_if(!(w[1] > w[0] && w[3] > w[2]), r->camera_place,
                           "the screen window is empty; it is x from, x to, y from, y to");
    koksma__import_unknown_if(
        fabs((w[1] - w[0]) / (w[3] - w[2]) - aspect) > 1e-3 * aspect, r->camera_place,
        "the screen window and the image have different aspect ratios: the window's height is used");
    set_motion(r, camera.motion);
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
    koksma__import_camera(r->camera_place, r->camera[0], 1, &camera);
}

/* Sets the times at which the shutter opens and closes, as fractions of the interval of the motion (TransformTimes).
   Without an exposure all lights are black. */
static void set_shutter(reader *r)
{
    koksma_scene *scene = r->im->scene;
    const double length = r->times[1] - r->times[0];
    koksma__scene_finish(scene);
    koksma__import_fail_if(scene->n_lights && !(r->values.exposure > 0), r->camera_place,
                           "a shutter that is open from %g to %g, at ISO %g, makes all light black; pbrt refuses it",
                           r->shutter[0], r->shutter[1], r->iso);
    koksma__import_fail_if(scene->moves && !(length > 0 && r->shutter[0] <= r->shutter[1]), r->camera_place,
                           "TransformTimes or the shutter end before they begin");
    for (int i = 0; i < 2 && scene->moves; i++) {
        scene->camera.shutter[i] = fmin(fmax((r->shutter[i] - r->times[0]) / length, -FAR), FAR);
    }
}

/* Fills the scene with the medium that contains the camera. */
static void set_medium(reader *r)
{
    size_t i;
    if (*r->camera_medium && koksma__names_find(&r->medium_names, r->camera_medium, strlen(r->camera_medium), &i) &&
        r->media[i].is_read) {
        koksma__medium_init(&r->im->scene->medium, r->media[i].absorption, r->media[i].scattering, r->media[i].g);
    }
    koksma__import_check_medium(r->camera_place, "camera's");
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

/* Reads the texts of the scene. */
static void read_all(void *data)
{
    reader *r = data;
    source s = *r->source;
    take_identity(r);
    name_space(r, "world", r->now.matrix);
    r->now.surface.material = koksma__pbrt_material(&r->values, "diffuse", r->parameters);
    read_source(r, &s);
    koksma__import_unknown_if(
        !r->in_world, s.place,
        "no WorldBegin, from which on the scene is described: what precedes it is read as if it followed");
    koksma__import_unknown_if(
        r->n_stack > 0, s.place,
        "%zu AttributeBegin or ObjectBegin without an end: what follows keeps their transforms and materials",
        r->n_stack);
}

/* Sets what directives together describe. */
static void finish(void *data)
{
    reader *r = data;
    for (size_t i = 0; i < r->n_media; i++) { /* as in pbrt */
        koksma__import_fail_if(!r->media[i].is_made, r->media[i].used, "no medium '%s'", r->media[i].name);
    }
    set_camera(r);
    set_medium(r);
    set_shutter(r);
}

koksma_status koksma__pbrt_read(koksma__import *im, const char *text, size_t size)
{
    source s = {.at = text, .end = text + size, .place = {im, im->path, 1}};
    reader r = {.im = im,
                .values = {.im = im, .exposure = 1},
                .source = &s,
                .place = s.place,
                .listed = (size_t)NO_DIRECTIVE,
                .shutter = {0, 1},
                .iso = 100,
                .film = {1280, 720},
                .crop = {0, 1280, 0, 720},
                .now.surface.material = -2,
                .now.active = START | END,
                .times = {0, 1}};
    koksma_scene *scene = im->scene;
    scene->width = 1280;
    scene->height = 720;
    scene->paths = true;
    r.parameters = calloc(1, sizeof *r.parameters);
    KOKSMA__REQUIRE_MEMORY(r.parameters, sizeof *r.parameters);
    r.parameters->place = s.place;
    r.parameters->directive = r.parameters->kind = r.parameters->target = "";
    koksma_status status = koksma__import_try(im, read_all, &r);
    status = koksma__unknown_explain(status, scene->unknown, scene->n_unknown > r.listed ? r.listed + 1 : 0);
    if (status == KOKSMA_MALFORMED && is_of_v3(text, size) && !strstr(koksma_error_text(), "pbrt-v3")) {
        status = koksma__fail(status, "%s; the file is of pbrt-v3: 'pbrt --upgrade FILE' prints one of pbrt-v4",
                              koksma_error_text());
    }
    status = status ? status : koksma__import_try(im, finish, &r);
    for (size_t i = 0; i < r.n_objects; i++) {
        free(r.objects[i].items);
    }
    for (size_t i = 0; i < r.n_attributes; i++) {
        free(r.attributes[i].parameter.numbers);
    }
    koksma__pbrt_parameters_fini(r.parameters);
    KOKSMA__FREE(r.objects, r.spaces, r.media, r.stack, r.parameters, r.attributes);
    koksma__names_fini(&r.medium_names);
    koksma__names_fini(&r.space_names);
    koksma__names_fini(&r.object_names);
    koksma__pbrt_scene_fini(&r.values);
    return status;
}
