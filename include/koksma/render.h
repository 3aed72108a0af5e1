/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A distribution ray tracer that samples with any pattern. Part of libkoksma-lab.
 *
 *     koksma_scene *scene;
 *     koksma_render_options options;
 *     koksma_image image;
 *     if (!koksma_scene_open("ball", &scene)) {
 *         koksma_render_options_init(&options, scene);
 *         koksma_pattern_spec("n-rooks", &options.pattern);
 *         koksma_render(scene, &options, NULL, &image);
 *     }
 *
 * A sample has one or two dimensions for each purpose: the position in the pixel, and what the scene needs: the lens,
 * the time, a point on each light, the choice of a light, the direction of scattering, its kind (reflection or
 * transmission), and Russian roulette. Such a purpose, with its sample dimensions, is called a use; koksma_use_at
 * lists them. Each use has its own point set, which is new for every pixel unless `scope` or `pairing` say
 * otherwise; or several uses form a group and share the dimensions of one set.
 */
#ifndef KOKSMA_RENDER_H
#define KOKSMA_RENDER_H

#include <koksma/image.h>
#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct koksma_scene koksma_scene;

/* Returns the name of scene i of those in the library; NULL past the end. */
KOKSMA_API const char *koksma_scene_name_at(size_t i);

/* One line of a table whose members have no functions of their own here.
     cite    keys of docs/references.bib, or "-"; NULL: the table has none
     fields  of a kind of a scene file: their names with blanks between; else "" */
typedef struct koksma_entry {
    const char *name, *title, *cite;
    char fields[256];
} koksma_entry;

/* Sets *out to kind i of the members "materials", "lights" or "shapes" of a scene file; returns false past the end. */
KOKSMA_API bool koksma_scene_kind_at(const char *member, size_t i, koksma_entry *out);

/* Sets *out to pipeline i of the renderer; returns false past the end. The renderer chooses the fastest pipeline that
   can render a scene with its options. */
KOKSMA_API bool koksma_pipeline_at(size_t i, koksma_entry *out);

/* Opens a scene.
     name_or_path  the name of a scene in the library; or a file: JSON if the text has a '/' or ends in ".json", a
                   mesh if it ends in .obj, .ply, .off, .gltf or .glb; a scene of pbrt-v4 or Mitsuba 3 if it ends in
                   .pbrt or .xml
     out           the scene, to be closed by koksma_scene_close. It is read-only: threads may share it
   Errors: UNKNOWN (no such name), MISSING, MALFORMED (the message names file, line, field and reason), MEMORY. */
KOKSMA_API koksma_status koksma_scene_open(const char *name_or_path, koksma_scene **out);

/* Frees a scene; it may be NULL. */
KOKSMA_API void koksma_scene_close(koksma_scene *scene);

/* Returns the library of this build that traces triangle meshes, such as "Embree 3.13.5"; NULL: there is none. */
KOKSMA_API const char *koksma_mesh_tracer(void);

/* Returns the title in the scene file; may be empty. Valid until the scene is closed. */
KOKSMA_API const char *koksma_scene_title(const koksma_scene *scene);

/* Writes warning i about the scene, which can be rendered all the same, as one line. Returns false past the last one.
     text  size characters, cut if too short */
KOKSMA_API bool koksma_scene_warning(const koksma_scene *scene, size_t i, char *text, size_t size);

/* Writes what a pbrt or Mitsuba scene has that is unknown here, and what was taken for it: line i, "FILE:LINE: ...".
   Returns false past the last one. These lines are among the scene's warnings, too.
     text  size characters, cut if too short */
KOKSMA_API bool koksma_scene_unknown(const koksma_scene *scene, size_t i, char *text, size_t size);

/* Numbers of what a scene contains; a mesh may be placed several times. */
typedef struct koksma_scene_counts {
    size_t shapes, meshes, placements, triangles, materials, lights;
} koksma_scene_counts;

/* Counts what a scene contains. */
KOKSMA_API koksma_scene_counts koksma_scene_count(const koksma_scene *scene);

/* Where a part of a scene is, and what of the picture it may cover. */
typedef struct koksma_scene_part {
    char name[80];          /* the kind of a shape; of a placed mesh "mesh" and its name */
    double low[3], high[3]; /* a box around it at time 0; infinite for a plane */
    bool in_frame;          /* false: the camera sees nothing of it but reflections and shadows */
    double frame[4];        /* of the picture that the box covers at most: left, right, top, bottom, from 0 to 1 */
} koksma_scene_part;

/* Finds part i of a scene: its shapes, then its placed meshes. Returns false past the last one. */
KOKSMA_API bool koksma_scene_part_at(const koksma_scene *scene, size_t i, koksma_scene_part *out);

/* Sets the light that comes from far away, in place of the scene's environment, if it has one, and of the key light, the sky
   and the ground that a bare mesh file gets. image: a file of latitude and longitude, times radiance; NULL: the same
   radiance from everywhere, 0 to 1e6. The scene's hash changes. The scene must not have been rendered before. Errors:
   ARGUMENT, MISSING, MALFORMED, UNSUPPORTED, MEMORY. */
KOKSMA_API koksma_status koksma_scene_set_sky(koksma_scene *scene, const char *image, double radiance);

/* Returns a 64-bit hash of the scene's text, which changes when the file changes. */
KOKSMA_API uint64_t koksma_scene_hash(const koksma_scene *scene);

/* ---- How it is sampled ---------------------------------------------------------------------------------- */

/* How the point sets of a pixel's uses are combined, sample by sample. */
typedef enum koksma_pairing {
    KOKSMA_PAIRING_SHUFFLED, /* by independent random permutations: uncorrelated jitter (Cook 1986; Shirley 1991) */
    KOKSMA_PAIRING_ALIGNED,  /* in the order of the pattern: sample i takes point i of every set */
    KOKSMA_PAIRING_NATIVE    /* one set with the dimensions of all uses together */
} koksma_pairing;

/* What one point set covers. */
typedef enum koksma_scope {
    KOKSMA_SCOPE_PIXEL, /* a new set of spp points for each pixel */
    KOKSMA_SCOPE_IMAGE  /* one set of spp * width * height points for the whole image, regardless of pixels */
} koksma_scope;

/* Which lights get a shadow ray at a vertex. */
typedef enum koksma_light_selection {
    KOKSMA_LIGHTS_ALL,     /* all */
    KOKSMA_LIGHTS_ONE,     /* one, chosen in proportion to its estimated contribution (Shirley 1991, section 5.4) */
    KOKSMA_LIGHTS_POWER,   /* one, in proportion to its power */
    KOKSMA_LIGHTS_UNIFORM, /* one, all with equal probability */
    KOKSMA_LIGHTS_AUTO /* the default: ONE where the integrator follows paths between diffuse surfaces and the scene
                              has more than 8 lights, else ALL */
} koksma_light_selection;

/* Return the word of a scene file or option: "shuffled", "pixel", "all", ...; NULL for a value past the last. */
KOKSMA_API const char *koksma_pairing_name(koksma_pairing pairing);
KOKSMA_API const char *koksma_scope_name(koksma_scope scope);
KOKSMA_API const char *koksma_light_selection_name(koksma_light_selection selection);

/* The number of uses. In the order of koksma_use_at: pixel, lens, time, light-choice, lobe, lobe-choice, roulette,
   light. */
enum { KOKSMA_N_USES = 8 };

/* A purpose on which a sample spends one or two dimensions. */
typedef struct koksma_use {
    const char *name, *help;
    int dim; /* 1 or 2 */
} koksma_use;

/* Returns use i; NULL past the end. */
KOKSMA_API const koksma_use *koksma_use_at(size_t i);

/* Uses that share the dimensions of one point set: sample i takes the coordinates of point i, in the order of `uses`.
   One set covers what a sample needs once (pixel, lens, time), the first vertex of the path, and one light there.
   Every further vertex and every further light takes another set of the same pattern, combined with the others by
   `pairing`. */
typedef struct koksma_use_group {
    koksma_spec pattern;
    int n_uses;              /* 2 or more; 0: no group */
    int uses[KOKSMA_N_USES]; /* indices for koksma_use_at */
} koksma_use_group;

enum { KOKSMA_MAX_USE_GROUPS = KOKSMA_N_USES / 2, KOKSMA_MAX_PATTERNS_TEXT = KOKSMA_MAX_SPEC * (KOKSMA_N_USES + 1) };

/* How light is followed through the scene. */
typedef struct koksma_integrator {
    const char *name, *title, *cite;
    int depth;         /* the most bounces, unless the options set another number */
    const void *flags; /* for the renderer */
} koksma_integrator;

/* Returns integrator i of the table, or the one with this name; NULL if there is none. */
KOKSMA_API const koksma_integrator *koksma_integrator_at(size_t i);
KOKSMA_API const koksma_integrator *koksma_integrator_find(const char *name);

/* A separable pixel filter f(x) f(y), with f(x) = 0 for |x| >= radius; lengths in pixels. The filter need not be
   normalised. */
typedef struct koksma_filter {
    const char *name, *title, *cite;
    double radius;
    double (*value)(double x);
} koksma_filter;

/* Returns filter i of the table, or the one with this name; NULL if there is none. */
KOKSMA_API const koksma_filter *koksma_filter_at(size_t i);
KOKSMA_API const koksma_filter *koksma_filter_find(const char *name);

/* Returns the frequency response of a filter along one axis: the Fourier transform of f at this frequency, in cycles
   a pixel, divided by that at 0. */
KOKSMA_API double koksma_filter_response(const koksma_filter *filter, double frequency);

/* Returns the fraction of the integral of the squared response that lies above half a cycle a pixel, where pixels
   alias: 0 for the ideal filter. */
KOKSMA_API double koksma_filter_leakage(const koksma_filter *filter);

/* How to render. koksma_render_options_init sets all members. */
typedef struct koksma_render_options {
    koksma_spec pattern;                 /* of every use that `patterns` and `groups` do not name */
    koksma_spec patterns[KOKSMA_N_USES]; /* of use i; all zero: `pattern` */
    koksma_use_group
        groups[KOKSMA_MAX_USE_GROUPS]; /* a use may be in one group, unless it has an entry in `patterns` */
    int spp;                           /* samples a pixel, which is the n of the pattern; 1 to KOKSMA_MAX_SPP */
    int width, height;                 /* pixels, 1 to KOKSMA_MAX_IMAGE_SIDE */
    uint64_t seed;
    koksma_pairing pairing;
    koksma_scope scope;
    koksma_light_selection lights;
    const koksma_integrator *integrator;
    int depth; /* the most bounces, 0 to KOKSMA_MAX_DEPTH; -1: the integrator's default */
    const koksma_filter *filter;
    bool splat; /* true: add each sample to all pixels that the filter reaches and divide by the sum of weights;
                   false: draw the position of each pixel's samples from the filter (Ernst, Stamminger & Greiner 2006), which
                   has two to three times the error. Both keep a constant image constant, also with negative lobes.
                   With one sample a pixel, drawing uses the positive part of the filter only. Splatting has no
                   samples beyond the frame: at the borders the filter is cut off */
} koksma_render_options;

enum { KOKSMA_MAX_SPP = 1 << 20, KOKSMA_MAX_DEPTH = 64 };

/* Sets the defaults: pattern n-rooks, 16 samples a pixel, the size in the scene file, seed 0, pairing shuffled, scope
   pixel, lights auto, integrator distribution, filter box. */
KOKSMA_API void koksma_render_options_init(koksma_render_options *options, const koksma_scene *scene);

/* Sets patterns from a text: "PATTERN" for all uses without another one, "USE=PATTERN" for one use, "USE+USE=PATTERN"
   for a group, or several of these separated by ';': "random;pixel+time=scan-time". Uses that the text does not name
   keep their patterns.
   Errors: UNKNOWN (a pattern or use), DIM (the pattern cannot have the dimensions of its group), ARGUMENT (a use that
   has a pattern already, or a parameter of the pattern); options are then unchanged. */
KOKSMA_API koksma_status koksma_render_patterns(const char *text, koksma_render_options *options);

/* Writes the canonical text of all patterns: the common one, then uses and groups in the order of koksma_use_at.
     text  KOKSMA_MAX_PATTERNS_TEXT characters */
KOKSMA_API void koksma_render_patterns_text(const koksma_render_options *options, char *text);

/* Writes the names of a group's uses, such as "pixel+time".
     text  KOKSMA_MAX_SPEC characters */
KOKSMA_API void koksma_use_group_text(const koksma_use_group *group, char *text);

/* ---- Rendering ------------------------------------------------------------------------------------------- */

/* Returns the number of rays that one sample casts for its first hit: one from the camera and one to each light. */
KOKSMA_API int koksma_scene_rays_per_sample(const koksma_scene *scene);

/* Returns whether rendering this scene with these options needs use i. A pattern for a use that is not needed, such
   as the lens of a pinhole camera, has no effect. */
KOKSMA_API bool koksma_use_is_spent(const koksma_scene *scene, const koksma_render_options *options, size_t i);

/* Writes warning i of the scene that matters with these options, as koksma_scene_warning does. */
KOKSMA_API bool koksma_render_warning(const koksma_scene *scene, const koksma_render_options *options, size_t i,
                                      char *text, size_t size);

/* An image and further values of its pixels. All have the same size; the image has 3 channels, or 1 for a scene
   without colour. */
typedef struct koksma_layers {
    koksma_image image;
    koksma_image albedo;   /* of the first hit, mean over the samples; 3 channels */
    koksma_image normal;   /* of the first hit, towards the camera, mean over the samples; 3 channels */
    koksma_image depth;    /* distance of the first hit, mean over the samples that hit something; 0: none did */
    koksma_image samples;  /* number of samples of the pixel */
    koksma_image variance; /* of the pixel's luminance, estimated from its samples (with splatting also those of
                              pixels around) as if they were independent: too large for stratified patterns. 0 with
                              fewer than two samples */
    uint64_t rays;         /* number of rays cast */
} koksma_layers;

/* Frees all images and zeroes the struct. layers may be NULL, or zeroed. */
KOKSMA_API void koksma_layers_fini(koksma_layers *layers);

/* Bytes that rendering takes in addition to the scene and a few MiB for each thread (with splatting also a few rows
   of pixels for each). */
typedef struct koksma_render_size {
    uint64_t film;    /* the image and its layers, and sums of splats */
    uint64_t samples; /* the point set of scope image, at its peak */
    uint64_t file;    /* the uncompressed file, which is made in memory at the end */
} koksma_render_size;

/* Estimates the memory for rendering a scene.
     all_layers  true for koksma_render_layers and an EXR with all layers; false for the image only */
KOKSMA_API koksma_render_size koksma_render_size_of(const koksma_scene *scene, const koksma_render_options *options,
                                                    bool all_layers);

/* Renders an image; allocates out. Costs O(spp) for each pixel, and each sample a number of rays that depends on
   scene and integrator. A time limit (koksma_run) has no effect; keep_going can cancel.
   Errors: ARGUMENT (an option out of range), those of koksma_generate for n = spp, MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_render(const koksma_scene *scene, const koksma_render_options *options,
                                       const koksma_run *run, koksma_image *out);

/* Render the same image with all layers, or only with `samples` and `rays`, which is faster; allocate out.
   After INTERRUPTED out has the pixels that are done (`samples` is 0 in the others), and the caller must free it.
   Errors: those of koksma_render. */
KOKSMA_API koksma_status koksma_render_layers(const koksma_scene *scene, const koksma_render_options *options,
                                              const koksma_run *run, koksma_layers *out);
KOKSMA_API koksma_status koksma_render_only(const koksma_scene *scene, const koksma_render_options *options,
                                            const koksma_run *run, koksma_layers *out);

#ifdef __cplusplus
}
#endif

#endif
