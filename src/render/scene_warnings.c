/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Warnings about a scene that can be rendered but may not be as intended: materials that are not used, lights that
 * emit nothing, parts of a model file that are not supported. Warnings are not stored: to find warning i, all checks
 * run in a fixed order and the warnings that they find are counted.
 */
#include "render/one_image.h"

#include <math.h>
#include <stdio.h>

#include "core/c_locale.h"
#include "core/status.h"
#include "render/materials/materials.h"

/* The warning that the caller requests: `left` is the number of warnings that are to be skipped before it. */
typedef struct asked {
    size_t left;
    char *text;
    size_t size;
} asked;

/* Counts a warning; if it is the requested one, writes it and returns true. */
KOKSMA_PRINTF(2, 3) static bool tell(asked *a, const char *format, ...)
{
    va_list arguments;
    if (a->left--) {
        return false;
    }
    va_start(arguments, format);
    koksma__vsnprintf(a->text, a->size, format, arguments);
    va_end(arguments);
    return true;
}

static bool is_used(const koksma_scene *scene, int material)
{
    for (size_t i = 0; i < scene->n_shapes; i++) {
        if (scene->shapes[i].material == material) {
            return true;
        }
    }
    for (size_t i = 0; i < scene->n_placements; i++) {
        if (scene->placements[i].material == material) {
            return true;
        }
    }
    return false;
}

static bool is_dark(const double rgb[3])
{
    return !(rgb[0] > 0) && !(rgb[1] > 0) && !(rgb[2] > 0);
}

static bool of_meshes(const koksma_scene *scene, asked *a)
{
    size_t n = 0, first = 0;
    for (size_t i = 0; i < scene->n_meshes; i++) {
        first = scene->meshes[i].n_degenerate && !n ? i : first;
        n += scene->meshes[i].n_degenerate > 0;
    }
    char more[64] = "";
    if (n > 1) {
        snprintf(more, sizeof more, " (and some of %zu more meshes)", n - 1);
    }
    const koksma__mesh *m = n ? &scene->meshes[first] : NULL;
    return m && tell(a, "mesh %zu%s%s: %zu of %zu triangles have no area%s", first, *m->name ? " " : "", m->name,
                     m->n_degenerate, m->n_triangles, more);
}

static bool of_placements(const koksma_scene *scene, asked *a)
{
    size_t n = 0, first = 0;
    for (size_t i = 0; i < scene->n_placements; i++) {
        if (koksma__matrix_flattens(scene->placements[i].matrix)) {
            first = n ? first : i;
            n++;
        }
    }
    const int mesh = n ? scene->placements[first].mesh : 0;
    return n && tell(a, "mesh %d%s%s is flattened, because the matrix of its placement has no inverse%s", mesh,
                     *scene->meshes[mesh].name ? " " : "", scene->meshes[mesh].name,
                     n > 1 ? ", and other meshes are, too" : "");
}

static bool of_camera(const koksma_scene *scene, asked *a)
{
    const koksma__camera *c = &scene->camera;
    const double degrees = c->fov_rad * 180 / 3.14159265358979;
    return (c->by_degrees && degrees > 0 && degrees < 3.2 &&
            tell(a, "the camera sees %.3g degrees; is the angle in radians?", degrees)) ||
           (c->lens_radius > c->focus_distance &&
            tell(a, "the lens's radius, %.3g, exceeds the focus distance, %.3g; is its unit right?", c->lens_radius,
                 c->focus_distance));
}

static bool of_lights(const koksma_scene *scene, asked *a)
{
    for (size_t i = 0; i < scene->n_lights; i++) {
        if (is_dark(scene->lights[i].radiance) && tell(a, "light %zu emits no light", i)) {
            return true;
        }
    }
    return (scene->unread.too_bright &&
            tell(a, "lights or emissive materials brighter than 1e6 (%zu) are dimmed to 1e6",
                 scene->unread.too_bright)) ||
           (!scene->n_lights && is_dark(scene->ambient) && is_dark(scene->background) &&
            tell(a, "no light, no ambient light, no background: the picture will be black"));
}

/* Warns about lights that rays cannot hit in a scene with mirrors or glass, because light that a mirror or glass
   reflects or refracts onto a surface is found only by paths that hit the light source. */
static bool of_hidden_lights(const koksma_scene *scene, asked *a)
{
    size_t hidden = 0;
    bool thrown = false;
    for (size_t i = 0; i < scene->n_lights; i++) {
        hidden += !scene->lights[i].visible && !is_dark(scene->lights[i].radiance);
    }
    for (size_t i = 0; i < scene->n_materials && !thrown; i++) {
        thrown = scene->materials[i].bsdf->lobes & KOKSMA__LOBE_SPECULAR && is_used(scene, (int)i);
    }
    return hidden && thrown &&
           tell(a,
                "rays cannot hit some lights (%zu): with the integrator path, mirrors and glass cast none of their "
                "light on other surfaces",
                hidden);
}

/* Warns about an environment whose image is black, has negative numbers, or is not twice as wide as high. This check is
   the last one, because it reads the whole image. */
static bool of_environment(const koksma_scene *scene, asked *a)
{
    for (size_t i = 0; i < scene->n_lights; i++) {
        const koksma_image *image = scene->lights[i].image;
        const size_t pixels = image ? (size_t)image->width * (size_t)image->height : 0;
        size_t negative = 0, lit = 0;
        for (size_t p = 0; p < pixels; p++) {
            const float *rgb = image->pixels + p * (size_t)image->channels;
            const bool colour = image->channels == 3;
            negative += rgb[0] < 0 || (colour && (rgb[1] < 0 || rgb[2] < 0));
            lit += rgb[0] > 0 || (colour && (rgb[1] > 0 || rgb[2] > 0));
        }
        if (pixels && scene->lights[i].kind == &koksma__light_environment && image->width != 2 * image->height &&
            tell(a, "the image of light %zu has %d x %d pixels: one of all directions is twice as wide as high", i,
                 image->width, image->height)) {
            return true;
        }
        if (pixels && (negative || !lit) && !is_dark(scene->lights[i].radiance) &&
            (lit ? tell(a, "the image of light %zu has negative numbers in %zu of %zu pixels; they count as 0", i,
                        negative, pixels)
                 : tell(a, "light %zu emits no light: no number in its image is above 0", i))) {
            return true;
        }
    }
    return false;
}

static bool of_materials(const koksma_scene *scene, asked *a)
{
    for (size_t i = 0; i < scene->n_materials; i++) {
        const koksma__material *m = &scene->materials[i];
        if ((!scene->is_model && !is_used(scene, (int)i) && tell(a, "material '%s' is not used", m->name)) ||
            (*m->lost && tell(a, "the texture of material %zu is ignored: %s", i, m->lost)) ||
            (*m->dark &&
             tell(a, "material %zu emits no light, because its emissive texture is missing: %s", i, m->dark))) {
            return true;
        }
    }
    for (size_t i = 0; i < scene->n_notes; i++) {
        if (tell(a, "%s", scene->notes[i])) {
            return true;
        }
    }
    return false;
}

static bool of_unread(const koksma__unread *u, asked *a)
{
    const struct {
        size_t n;
        const char *what, *so;
    } all[] = {
        {u->animations, "animations", "objects stand still, as the file places them without animation"},
        {u->skins, "skins", "their meshes are shown undeformed"},
        {u->vertex_colours, "meshes' vertex colours", "colours come only from materials"},
        {u->second_uvs, "textures' own texture coordinates",
         "these textures use the coordinates of their material's first texture"},
        {u->morphs, "morph targets", "meshes are shown undeformed"},
        {u->lines, "points and lines", "only triangles are shown"},
        {u->see_through, "materials' transparencies", "these materials are opaque"},
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        if (all[i].n && tell(a, "%s (%zu) are not read: %s", all[i].what, all[i].n, all[i].so)) {
            return true;
        }
    }
    return u->extensions && tell(a, "extensions (%zu) are not read: %s", u->extensions, u->extension);
}

static void say_unknown(const koksma__unknown *u, char *text, size_t size)
{
    char more[48] = "";
    if (u->n > 1) {
        snprintf(more, sizeof more, " (and at %zu more places)", u->n - 1);
    }
    snprintf(text, size, "%s:%lu: %s%s", u->file, u->line, u->text, more);
    if (size) {
        koksma_text_escape(text, size);
    }
}

static bool of_unknown(const koksma_scene *scene, asked *a)
{
    for (size_t i = 0; i < scene->n_unknown; i++) {
        if (tell(a, "%s", "")) {
            say_unknown(&scene->unknown[i], a->text, a->size);
            return true;
        }
    }
    return false;
}

/* Warns about missing material files of an OBJ file, and about materials that no material file defines. */
static bool of_names(const koksma__unread *u, asked *a)
{
    const struct {
        size_t n;
        const char *name, *what;
    } all[] = {{u->libraries, u->library, "there is no such material file"},
               {u->materials, u->material, "no material file defines this material: it is grey"}};
    for (size_t i = 0; i < 2; i++) {
        char more[48] = "";
        if (all[i].n > 1) {
            snprintf(more, sizeof more, " (and so with %zu more)", all[i].n - 1);
        }
        if (all[i].n && tell(a, "%s: %s%s", all[i].name, all[i].what, more)) {
            return true;
        }
    }
    return false;
}

static bool of_all(const koksma_scene *scene, asked *a)
{
    return (!scene->n_shapes && !scene->n_placements && tell(a, "no shapes")) || of_camera(scene, a) ||
           of_unknown(scene, a) || of_unread(&scene->unread, a) || of_names(&scene->unread, a);
}

bool koksma__scene_warning(const koksma_scene *scene, const koksma__integrator_flags *flags, size_t i, char *text,
                           size_t size)
{
    asked a = {i, text, size};
    const bool lit = !flags || !flags->replace_scene;
    const bool by_paths = lit && (!flags || flags->followed & KOKSMA__LOBE_DIFFUSE);
    const bool found = of_materials(scene, &a) || of_all(scene, &a) || of_meshes(scene, &a) ||
                       of_placements(scene, &a) || (lit && of_lights(scene, &a)) ||
                       (by_paths && of_hidden_lights(scene, &a)) || (lit && of_environment(scene, &a));
    if (found && size) {
        koksma_text_escape(text, size);
    }
    return found;
}

bool koksma__scene_unread(const koksma_scene *scene, char *text, size_t size)
{
    asked a = {0, text, size};
    const bool found = of_unknown(scene, &a) || of_unread(&scene->unread, &a) || of_names(&scene->unread, &a);
    if (found) {
        koksma_text_escape(text, size);
    }
    return found;
}

bool koksma_scene_warning(const koksma_scene *scene, size_t i, char *text, size_t size)
{
    KOKSMA__REQUIRE_OR(false, scene, text);
    return koksma__scene_warning(scene, NULL, i, text, size);
}

bool koksma_render_is_black(const koksma_scene *scene, const koksma_image *image)
{
    KOKSMA__REQUIRE_OR(false, scene, image);
    double brightest = 0;
    for (int k = 0; k < 3; k++) {
        brightest = fmax(brightest, fmax(scene->ambient[k], scene->background[k]));
        for (size_t i = 0; i < scene->n_lights; i++) {
            brightest = fmax(brightest, scene->lights[i].radiance[k]);
        }
    }
    const float least = (float)(1e-6 * fmin(brightest, 1));
    const size_t n = (size_t)image->width * (size_t)image->height * (size_t)image->channels;
    size_t black = 0;
    while (black < n && image->pixels[black] <= least) {
        black++;
    }
    return n && black == n;
}

bool koksma_scene_unknown(const koksma_scene *scene, size_t i, char *text, size_t size)
{
    KOKSMA__REQUIRE_OR(false, scene, text);
    if (i < scene->n_unknown) {
        say_unknown(&scene->unknown[i], text, size);
    }
    return i < scene->n_unknown;
}

koksma_scene_counts koksma_scene_count(const koksma_scene *scene)
{
    KOKSMA__REQUIRE_OR((koksma_scene_counts){0}, scene);
    koksma_scene_counts counts = {.shapes = scene->n_shapes,
                                  .meshes = scene->n_meshes,
                                  .placements = scene->n_placements,
                                  .materials = scene->n_materials,
                                  .lights = scene->n_lights,
                                  .media = scene->medium.is_there,
                                  .paths = koksma__scene_asks_for_paths(scene),
                                  .spp = (size_t)scene->spp};
    for (size_t i = 0; i < scene->n_placements; i++) {
        counts.triangles += scene->meshes[scene->placements[i].mesh].n_triangles;
    }
    return counts;
}
