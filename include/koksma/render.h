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
 * A sample has one or two dimensions for each purpose: the position in the pixel and, if the scene needs them, the
 * position on the lens, the time, a point on each light, the choice of a light, the direction of scattering, its
 * kind (reflection or transmission), Russian roulette, and the distance at which a medium scatters. Such a
 * purpose, with its sample dimensions, is called a use; koksma_use_at lists the uses. By default each use has its own
 * point set, which is generated anew for every pixel; the options `scope` and `pairing` change this. Several uses can
 * form a group that shares the dimensions of one set.
 */
#ifndef KOKSMA_RENDER_H
#define KOKSMA_RENDER_H

#include <koksma/image.h>
#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct koksma_scene koksma_scene;

/* Returns the name of scene i of the library, or NULL past the last scene. */
KOKSMA_API const char *koksma_scene_name_at(size_t i);

/* Name and description of an entry of a table, such as a kind of material or a pipeline.
     cite    keys of docs/references.bib, or "-"; NULL: the table has no citations
     fields  for a kind of object of a scene file: the names of its fields, separated by blanks; otherwise "" */
typedef struct koksma_entry {
    const char *name, *title, *cite;
    char fields[256];
} koksma_entry;

/* Sets *out to kind i of the objects that a member of a scene file lists: `member` is "materials", "lights" or
   "shapes". Returns false past the end. */
KOKSMA_API bool koksma_scene_kind_at(const char *member, size_t i, koksma_entry *out);

/* Sets *out to pipeline i of the renderer; returns false past the end. The renderer chooses the fastest pipeline that
   can render a scene with its options. */
KOKSMA_API bool koksma_pipeline_at(size_t i, koksma_entry *out);

/* Opens a scene of the library or a scene file.
     name_or_path  the name of a scene in the library, or a path: of a mesh if it ends in .obj, .ply, .ply.gz,
                   .gltf, .glb or .serialized, of a pbrt-v4 scene if it ends in .pbrt, of a Mitsuba 3 scene if it ends
                   in .xml, of a JSON scene if it ends in .json or else contains a '/'
     out           receives the scene, which koksma_scene_close frees. A scene is read-only: threads may share it
   Errors: UNKNOWN (no such name), MISSING, MALFORMED (the message names file, line, field and reason), MEMORY. */
KOKSMA_API koksma_status koksma_scene_open(const char *name_or_path, koksma_scene **out);

/* Frees a scene; it may be NULL. */
KOKSMA_API void koksma_scene_close(koksma_scene *scene);

/* Returns the library with which this build traces triangle meshes, such as "Embree 3.13.5"; NULL: this build has
   none. */
KOKSMA_API const char *koksma_mesh_tracer(void);

/* Returns the title in the scene file, which may be empty. The string is valid until the scene is closed. */
KOKSMA_API const char *koksma_scene_title(const koksma_scene *scene);

/* Writes warning i about a scene as one line; a scene with warnings can still be rendered. Returns false past the
   last warning.
     text  buffer of `size` characters, to which the warning is cut */
KOKSMA_API bool koksma_scene_warning(const koksma_scene *scene, size_t i, char *text, size_t size);

/* Writes line i, "FILE:LINE: ...", of the list of features of a pbrt or Mitsuba scene that this renderer does not
   support, each with its replacement, or of the names in a model's files that their formats do not have.
   Returns false past the last line. The scene's warnings include these lines.
     text  buffer of `size` characters, to which the line is cut */
KOKSMA_API bool koksma_scene_unknown(const koksma_scene *scene, size_t i, char *text, size_t size);

/* Sets whether the calling thread refuses to open scenes with the features that koksma_scene_unknown lists, and models
   with parts that are not read, and returns the previous setting. false, the initial setting: the features are
   replaced. true: koksma_scene_open, and functions that open scenes by their names (rankings, studies when they
   read a plan, datasheets), fail with MALFORMED and name the first feature. */
KOKSMA_API bool koksma_scene_refuse_unknown(bool refuse);

/* Numbers of the objects that a scene contains. `placements` counts the copies of meshes: a mesh may be placed
   several times. media: 1 if the scene has a medium, which only the integrator path and its variants render, else 0.
   paths: 1 if it has a medium or materials of glTF, or is a scene of pbrt or Mitsuba whose integrator follows paths
   between surfaces, else 0. spp: samples per pixel that the sampler of a pbrt or Mitsuba scene asks for; 0: none. */
typedef struct koksma_scene_counts {
    size_t shapes, meshes, placements, triangles, materials, lights, media, paths, spp;
} koksma_scene_counts;

/* Counts the objects of a scene. */
KOKSMA_API koksma_scene_counts koksma_scene_count(const koksma_scene *scene);

/* Sets the environment light of a scene that has not been rendered yet. It replaces the scene's environment and,
   for a mesh file, the default key light, sky and ground. `image` is the path of an environment map in latitude and
   longitude, which is multiplied by `radiance` (NULL: light with this radiance, 0 to 1e6, from all directions). The
   scene's hash changes. Errors: ARGUMENT, MISSING, MALFORMED, UNSUPPORTED, MEMORY. */
KOKSMA_API koksma_status koksma_scene_set_sky(koksma_scene *scene, const char *image, double radiance);

/* Returns a 64-bit hash of the scene's text, which changes when the file changes. */
KOKSMA_API uint64_t koksma_scene_hash(const koksma_scene *scene);

/* ---- Sampling options ---------------------------------------------------------------------------------- */

/* How the point sets of the uses of a pixel are combined into samples. */
typedef enum koksma_pairing {
    KOKSMA_PAIRING_SHUFFLED, /* each set is shuffled by an independent random permutation: uncorrelated jitter (Cook
                                1986; Shirley 1991) */
    KOKSMA_PAIRING_ALIGNED,  /* sample i takes point i of every set, in the order of the pattern */
    KOKSMA_PAIRING_NATIVE    /* one set with the dimensions of all uses together */
} koksma_pairing;

/* Whether a point set covers a pixel or the image. */
typedef enum koksma_scope {
    KOKSMA_SCOPE_PIXEL, /* a new set of spp points for each pixel */
    KOKSMA_SCOPE_IMAGE  /* one set of spp * width * height points for the whole image; its points need not be spp in
                           each pixel */
} koksma_scope;

/* Which lights get a shadow ray at a vertex. */
typedef enum koksma_light_selection {
    KOKSMA_LIGHTS_ALL,     /* all lights */
    KOKSMA_LIGHTS_ONE,     /* one light, with probability proportional to its estimated contribution (Shirley 1991,
                              section 5.4) */
    KOKSMA_LIGHTS_POWER,   /* one light, with probability proportional to its power */
    KOKSMA_LIGHTS_UNIFORM, /* one light, all with equal probability */
    KOKSMA_LIGHTS_AUTO     /* the default: ONE if the integrator follows paths between diffuse surfaces and the scene
                              has more than 8 lights, otherwise ALL */
} koksma_light_selection;

/* Return the word for an enumeration value in scene files and options: "shuffled", "pixel", "all", ..., or NULL for an
   unknown value. */
KOKSMA_API const char *koksma_pairing_name(koksma_pairing pairing);
KOKSMA_API const char *koksma_scope_name(koksma_scope scope);
KOKSMA_API const char *koksma_light_selection_name(koksma_light_selection selection);

/* The number of uses. Their order in koksma_use_at is pixel, lens, time, light-choice, lobe, lobe-choice, roulette,
   distance, light. */
enum { KOKSMA_N_USES = 9 };

/* A use: a purpose for which a sample needs one or two dimensions. */
typedef struct koksma_use {
    const char *name, *help;
    int dim; /* 1 or 2 */
} koksma_use;

/* Returns use i, or NULL past the last use. */
KOKSMA_API const koksma_use *koksma_use_at(size_t i);

/* A group of uses that share the dimensions of one point set: sample i takes the coordinates of point i, in the
   order of `uses`. One set covers the uses that occur once in a sample (pixel, lens, time), the first vertex of the
   path, and one light at that vertex. Every further vertex and every further light takes another set of the same
   pattern, combined with the others by `pairing`. */
typedef struct koksma_use_group {
    koksma_spec pattern;
    int n_uses;              /* number of uses in the group, 2 or more; 0: no group */
    int uses[KOKSMA_N_USES]; /* indices for koksma_use_at */
} koksma_use_group;

enum { KOKSMA_MAX_USE_GROUPS = KOKSMA_N_USES / 2, KOKSMA_MAX_PATTERNS_TEXT = KOKSMA_MAX_SPEC * (KOKSMA_N_USES + 1) };

/* An integrator: a method that computes the light along a camera ray. */
typedef struct koksma_integrator {
    const char *name, *title, *cite;
    int depth;         /* default for the largest number of bounces */
    const void *flags; /* used only inside the renderer */
} koksma_integrator;

/* Returns integrator i of the table, or the integrator with this name, or NULL if there is none. */
KOKSMA_API const koksma_integrator *koksma_integrator_at(size_t i);
KOKSMA_API const koksma_integrator *koksma_integrator_find(const char *name);

/* A separable pixel filter f(x) f(y), with f(x) = 0 for |x| >= radius; lengths in pixels. The filter need not be
   normalised. */
typedef struct koksma_filter {
    const char *name, *title, *cite;
    double radius;
    double (*value)(double x);
} koksma_filter;

/* Returns filter i of the table, or the filter with this name, or NULL if there is none. */
KOKSMA_API const koksma_filter *koksma_filter_at(size_t i);
KOKSMA_API const koksma_filter *koksma_filter_find(const char *name);

/* Returns the frequency response of a filter along one axis: the Fourier transform of f at this frequency, in
   cycles per pixel, divided by the transform at frequency 0. */
KOKSMA_API double koksma_filter_response(const koksma_filter *filter, double frequency);

/* Returns the fraction of a filter's energy (the integral of its squared response) at frequencies above half a cycle
   per pixel, where pixels alias; the fraction is 0 for the ideal filter. */
KOKSMA_API double koksma_filter_leakage(const koksma_filter *filter);

/* Options of the renderer. koksma_render_options_init sets all members to their defaults. */
typedef struct koksma_render_options {
    koksma_spec pattern;                 /* pattern of every use that has no entry in `patterns` or `groups` */
    koksma_spec patterns[KOKSMA_N_USES]; /* patterns[i] is for use i; all zero: the use takes `pattern` */
    /* a use may be in at most one group, and only if it has no entry in `patterns` */
    koksma_use_group groups[KOKSMA_MAX_USE_GROUPS];
    int spp;           /* samples per pixel, which is the n of the pattern; 1 to KOKSMA_MAX_SPP */
    int width, height; /* pixels, 1 to KOKSMA_MAX_IMAGE_SIDE */
    uint64_t seed;
    koksma_pairing pairing;
    koksma_scope scope;
    koksma_light_selection lights;
    const koksma_integrator *integrator;
    /* largest number of bounces, 0 to KOKSMA_MAX_DEPTH; -1: that of the scene's file for path tracing, if the file has
       one, else the integrator's default (koksma_render_depth()) */
    int depth;
    const koksma_filter *filter;
    /* true (splatting): add each sample to all pixels that the filter reaches and divide by the sum of weights; false
       (filter importance sampling): draw the position of each pixel's samples from the filter (Ernst, Stamminger &
       Greiner 2006), which has two to three times the error of splatting. Both methods keep a constant image
       constant, also if the filter has negative lobes. With one sample per pixel, importance sampling uses only the
       positive part of the filter. Splatting has no samples outside the image: at its borders the filter is cut off */
    bool splat;
} koksma_render_options;

enum { KOKSMA_MAX_SPP = 1 << 20, KOKSMA_MAX_DEPTH = 64 };

/* Sets the default options: pattern n-rooks, 16 samples per pixel, the image size in the scene file, seed 0,
   pairing shuffled, scope pixel, lights auto, integrator path where the scene asks for it (koksma_scene_counts.paths), else
   distribution, depth -1, filter box, no splatting. */
KOKSMA_API void koksma_render_options_init(koksma_render_options *options, const koksma_scene *scene);

/* Sets patterns from a text: "PATTERN" for all uses without a pattern, "USE=PATTERN" for one use, "USE+USE=PATTERN"
   for a group, or several of these separated by ';': "random;pixel+time=scan-time". Uses that the text does not
   name keep their patterns.
   Errors: UNKNOWN (no such pattern or use), DIM (the pattern does not accept the number of dimensions of its
   group), ARGUMENT (a use that already has a pattern, or a bad parameter of the pattern). After an error options
   are unchanged. */
KOKSMA_API koksma_status koksma_render_patterns(const char *text, koksma_render_options *options);

/* Writes the canonical text of all patterns: the common pattern, then those of uses and groups in the order of
   koksma_use_at.
     text  KOKSMA_MAX_PATTERNS_TEXT characters */
KOKSMA_API void koksma_render_patterns_text(const koksma_render_options *options, char *text);

/* Writes the names of a group's uses, such as "pixel+time".
     text  KOKSMA_MAX_SPEC characters */
KOKSMA_API void koksma_use_group_text(const koksma_use_group *group, char *text);

/* ---- Rendering ------------------------------------------------------------------------------------------- */

/* Returns the largest number of bounces with which these options render the scene. */
KOKSMA_API int koksma_render_depth(const koksma_scene *scene, const koksma_render_options *options);

/* Returns whether rendering this scene with these options needs use i. A pattern for a use that is not needed, such
   as the lens of a pinhole camera, has no effect. */
KOKSMA_API bool koksma_use_is_spent(const koksma_scene *scene, const koksma_render_options *options, size_t i);

/* Writes warning i among the scene's warnings that apply to these options, as koksma_scene_warning does. */
KOKSMA_API bool koksma_render_warning(const koksma_scene *scene, const koksma_render_options *options, size_t i,
                                      char *text, size_t size);

/* Returns whether a picture of the scene has nothing in it: every value is at most 1e-6, and at most 1e-6 of the brightest
   light. A light that is turned away leaves less than that by rounding. */
KOKSMA_API bool koksma_render_is_black(const koksma_scene *scene, const koksma_image *image);

/* A rendered image and further layers with values of its pixels. All layers have the same size; `image` has 3
   channels, or 1 for a scene without colour. */
typedef struct koksma_layers {
    koksma_image image;
    koksma_image albedo;   /* albedo of the first hit, mean over the samples; 3 channels */
    koksma_image normal;   /* normal of the first hit, turned towards the camera, mean over the samples; 3
                              channels */
    koksma_image depth;    /* distance of the first hit, mean over the samples that hit an object; 0 if no sample
                              did */
    koksma_image samples;  /* number of samples of the pixel */
    koksma_image variance; /* variance of the pixel's luminance, estimated from its samples (with splatting also
                              from those of neighbouring pixels) as if they were independent; for stratified patterns
                              this estimate is too large. 0 with fewer than two samples */
    uint64_t rays;         /* number of rays cast */
} koksma_layers;

/* Frees all images and zeroes the struct. layers may be NULL, or zeroed. */
KOKSMA_API void koksma_layers_fini(koksma_layers *layers);

/* Bytes that rendering needs in addition to the scene and a few MiB per thread (with splatting also a few rows of
   pixels per thread). */
typedef struct koksma_render_size {
    uint64_t film;    /* the image, its layers and the sums of splatted samples */
    uint64_t samples; /* peak memory of the point set of scope image */
    uint64_t file;    /* the uncompressed image file, which is built in memory at the end */
} koksma_render_size;

/* Estimates the memory for rendering a scene.
     all_layers  true for koksma_render_layers and an EXR file with all layers; false for the image only */
KOKSMA_API koksma_render_size koksma_render_size_of(const koksma_scene *scene, const koksma_render_options *options,
                                                    bool all_layers);

/* Renders an image; allocates out. The cost is O(spp) per pixel; the number of rays per sample depends on scene and
   integrator. The time limit in koksma_run has no effect; keep_going can cancel.
   Errors: ARGUMENT (an option out of range), those of koksma_generate for n = spp, MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_render(const koksma_scene *scene, const koksma_render_options *options,
                                       const koksma_run *run, koksma_image *out);

/* Render the image of koksma_render with all layers (koksma_render_layers) or only with `samples` and `rays`, which
   is faster (koksma_render_only); allocate out. After INTERRUPTED out has the finished pixels (`samples` is 0 in
   the others), and the caller must free it.
   Errors: those of koksma_render. */
KOKSMA_API koksma_status koksma_render_layers(const koksma_scene *scene, const koksma_render_options *options,
                                              const koksma_run *run, koksma_layers *out);
KOKSMA_API koksma_status koksma_render_only(const koksma_scene *scene, const koksma_render_options *options,
                                            const koksma_run *run, koksma_layers *out);

/* The mean of independent renders of one scene, with its standard errors. `image` and `error` have the same shape. */
typedef struct koksma_replicates {
    koksma_image image; /* mean of the replicates, in linear light */
    koksma_image
        error; /* standard error of each value of `image`: the standard deviation of the replicates, divided by
                           sqrt R; it is an estimate from R values itself, with an error of 1 / sqrt(2 R - 2) of it */
    size_t replicates;
    uint64_t rays;
    double mean, mean_low, mean_high; /* luminance of the picture, the mean over its pixels, and its 95 % interval by
                                         Student's t over the replicates */
    double rmse, rmse_low,
        rmse_high; /* root mean square error of the luminance of `image`, estimated from the spread of
                                         the replicates, and its 95 % interval by Student's t; NaN where there is none */
} koksma_replicates;

enum { KOKSMA_MAX_REPLICATES = 100000 };

/* Renders `replicates` images of options->spp samples with the seeds options->seed, options->seed + 1, ..., each as
   koksma_render, and allocates the images of *out. Memory: 16 bytes for each value of the image beside one render.
     replicates  3 to KOKSMA_MAX_REPLICATES
   Errors: those of koksma_render; ARGUMENT (the number; a use whose pattern has one set, or is not known to be unbiased:
   replicates don't show its error). */
KOKSMA_API koksma_status koksma_render_replicates(const koksma_scene *scene, const koksma_render_options *options,
                                                  size_t replicates, const koksma_run *run, koksma_replicates *out);

/* Frees the images and zeroes the struct. replicates may be NULL, or zeroed. */
KOKSMA_API void koksma_replicates_fini(koksma_replicates *replicates);

#ifdef __cplusplus
}
#endif

#endif
