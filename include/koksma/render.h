/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A distribution ray tracer that samples with any pattern.
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
 * Each pixel spends its samples on named uses: the place in the pixel, and what the scene has a need of: the lens,
 * the time, a place on each luminaire, which luminaire, lobe or end of a path (koksma_use_at lists all). Each use
 * gets a set of points of its own in the one or two dimensions that it has, drawn afresh for every pixel unless
 * `scope` or `pairing` says otherwise; or several uses form a group and take the coordinates of one set.
 */
#ifndef KOKSMA_RENDER_H
#define KOKSMA_RENDER_H

#include <koksma/image.h>
#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct koksma_scene koksma_scene;

/* The name of shipped scene i; NULL past the end. */
KOKSMA_API const char *koksma_scene_name_at(size_t i);

/* Opens a shipped scene by its name, or a file: JSON when the text has a '/' or ends in ".json", a mesh when it
   ends in .obj, .ply, .off, .gltf or .glb. Errors: UNKNOWN (no such name), MISSING, MALFORMED (with file, line, field
   and reason), MEMORY. */
KOKSMA_API koksma_status koksma_scene_open(const char *name_or_path, koksma_scene **out);
KOKSMA_API void koksma_scene_close(koksma_scene *scene);

/* What traces triangle meshes in this build: "Embree 3.13.5"; NULL: nothing does. */
KOKSMA_API const char *koksma_mesh_tracer(void);

/* What it shows, in its own words; may be empty. */
KOKSMA_API const char *koksma_scene_title(const koksma_scene *scene);

/* What is odd in a scene that can be rendered all the same: warning i as a line of text; false past the end. */
KOKSMA_API bool koksma_scene_warning(const koksma_scene *scene, size_t i, char *text, size_t size);

/* What it has: shapes, meshes, placements of meshes, triangles, luminaires. */
typedef struct koksma_scene_counts {
    size_t shapes, meshes, placements, triangles, materials, lights;
} koksma_scene_counts;
KOKSMA_API koksma_scene_counts koksma_scene_count(const koksma_scene *scene);

/* 64 bits of the scene's text: it changes when the file changes. */
KOKSMA_API uint64_t koksma_scene_hash(const koksma_scene *scene);

/* ---- How it is sampled ---------------------------------------------------------------------------------- */

/* How the patterns of a pixel's uses are put together, sample by sample. */
typedef enum koksma_pairing {
    KOKSMA_PAIRING_SHUFFLED, /* by independent random permutations: uncorrelated jitter (Cook 1986; Shirley 1991) */
    KOKSMA_PAIRING_ALIGNED,  /* in the order in which the pattern gives them */
    KOKSMA_PAIRING_NATIVE    /* one pattern in as many dimensions as the uses have together */
} koksma_pairing;

/* What a pattern covers. */
typedef enum koksma_scope {
    KOKSMA_SCOPE_PIXEL, /* a pattern of spp points afresh in each pixel */
    KOKSMA_SCOPE_IMAGE  /* one pattern of spp width height points over the image, without regard to pixels */
} koksma_scope;

/* Which luminaires get a shadow ray at a vertex. */
typedef enum koksma_light_selection {
    KOKSMA_LIGHTS_ALL,     /* each */
    KOKSMA_LIGHTS_ONE,     /* one, chosen in proportion to its estimated contribution (Shirley 1991, section 5.4) */
    KOKSMA_LIGHTS_POWER,   /* one, in proportion to its power */
    KOKSMA_LIGHTS_UNIFORM, /* one, each as likely */
} koksma_light_selection;

/* "shuffled", "aligned", …; "pixel", "image"; "all", "one", …; NULL past the end. */
KOKSMA_API const char *koksma_pairing_name(koksma_pairing pairing);
KOKSMA_API const char *koksma_scope_name(koksma_scope scope);
KOKSMA_API const char *koksma_light_selection_name(koksma_light_selection selection);

/* Uses of a sample, in the order of koksma_use_at: pixel, lens, time, light-choice, lobe, lobe-choice, roulette,
 * light.
 */
enum { KOKSMA_N_USES = 8 };

typedef struct koksma_use {
    const char *name, *help;
    int dim; /* 1 or 2 */
} koksma_use;

/* Use i; NULL past the end. */
KOKSMA_API const koksma_use *koksma_use_at(size_t i);

/* Uses that one pattern samples together, in as many dimensions as they have in all: sample i takes the coordinates
   of point i, in the order of `uses`. A set serves what a sample has once (pixel, lens, time) with the first vertex
   of its path and one luminaire there; every further vertex, and every further luminaire, takes its coordinates of a
   set of its own, paired with the others as separate uses are. */
typedef struct koksma_use_group {
    koksma_spec pattern;
    int n_uses;              /* 2 or more; 0: there is no such group */
    int uses[KOKSMA_N_USES]; /* as in koksma_use_at */
} koksma_use_group;

enum { KOKSMA_MAX_USE_GROUPS = KOKSMA_N_USES / 2, KOKSMA_MAX_PATTERNS_TEXT = KOKSMA_MAX_SPEC * (KOKSMA_N_USES + 1) };

/* How light is followed. */
typedef struct koksma_integrator {
    const char *name, *title, *cite;
    int depth;         /* bounces at most, unless the options say so */
    const void *rules; /* for the renderer */
} koksma_integrator;

/* Member i of the table, NULL past the end; by name, NULL if unknown. */
KOKSMA_API const koksma_integrator *koksma_integrator_at(size_t i);
KOKSMA_API const koksma_integrator *koksma_integrator_find(const char *name);

/* A separable pixel filter f(x) f(y), f(x) = 0 for |x| >= radius, in pixels. Its scale is idle. */
typedef struct koksma_filter {
    const char *name, *title, *cite;
    double radius;
    double (*value)(double x);
} koksma_filter;

/* Member i of the table, NULL past the end; by name, NULL if unknown. */
KOKSMA_API const koksma_filter *koksma_filter_at(size_t i);
KOKSMA_API const koksma_filter *koksma_filter_find(const char *name);

/* The Fourier transform of f along an axis over its value at 0: what is left of a wave of that many cycles a pixel.
 */
KOKSMA_API double koksma_filter_response(const koksma_filter *filter, double frequency);

/* The part of the integral of the squared response that is beyond half a cycle a pixel, the most that pixels can
   show: 0 is the ideal filter. */
KOKSMA_API double koksma_filter_leakage(const koksma_filter *filter);

typedef struct koksma_render_options {
    koksma_spec pattern;                 /* of every use that has none of its own */
    koksma_spec patterns[KOKSMA_N_USES]; /* of use i, where it is not all zero */
    koksma_use_group
        groups[KOKSMA_MAX_USE_GROUPS]; /* a use has a pattern of its own or is in one group, or neither */
    int spp;                           /* samples a pixel: the n of the pattern */
    int width, height;
    uint64_t seed;
    koksma_pairing pairing;
    koksma_scope scope;
    koksma_light_selection lights;
    const koksma_integrator *integrator;
    int depth; /* bounces at most; -1: the integrator's */
    const koksma_filter *filter;
    bool splat; /* samples are spread over all pixels that the filter reaches, and divided by the sum of its values;
                   else each pixel draws its samples from the filter (Ernst, Stamminger & Greiner 2006), which
                   leaves two to three times the error. Both keep a constant picture, whatever signs the filter has;
                   one drawn sample a pixel has the filter's positive part alone. No splatted sample lies beyond the
                   frame: at its borders the filter is cut, and the exact picture another */
} koksma_render_options;

enum { KOKSMA_MAX_SPP = 1 << 20, KOKSMA_MAX_DEPTH = 64 };

/* n-rooks, 16 samples a pixel, the scene's own size, seed 0, shuffled, in pixels, all lights, distribution, box. */
KOKSMA_API void koksma_render_options_init(koksma_render_options *options, const koksma_scene *scene);

/* Sets patterns by a text: "PATTERN" for the uses that have no other, "USE=PATTERN" for one use, "USE+USE=PATTERN"
   for a group, or several of these with ';' between: "random;pixel+time=scan-time". What the text doesn't name stays.
   Errors: UNKNOWN (a pattern or use), DIM (a pattern that has not the dimensions of its group), ARGUMENT (a use that
   has a pattern already, the pattern's own); options are then as before. */
KOKSMA_API koksma_status koksma_render_patterns(const char *text, koksma_render_options *options);

/* The canonical text of all of them, the common pattern first, then uses and groups in the order of koksma_use_at.
   text has room for KOKSMA_MAX_PATTERNS_TEXT characters. */
KOKSMA_API void koksma_render_patterns_text(const koksma_render_options *options, char *text);

/* The names of a group's uses with '+' between, such as "pixel+time"; text has room for KOKSMA_MAX_SPEC characters.
 */
KOKSMA_API void koksma_use_group_text(const koksma_use_group *group, char *text);

/* ---- Rendering ------------------------------------------------------------------------------------------- */

/* Rays that one sample casts at its first hit: one from the camera, and one to each luminaire. */
KOKSMA_API int koksma_scene_rays_per_sample(const koksma_scene *scene);

/* Whether samples of this scene by these options are spent on use i: a pattern for another (of the lens, where there
   is a pinhole) changes nothing. */
KOKSMA_API bool koksma_use_is_spent(const koksma_scene *scene, const koksma_render_options *options, size_t i);

/* Those of the scene's warnings that matter to a picture by these options: warning i; false past the end. */
KOKSMA_API bool koksma_render_warning(const koksma_scene *scene, const koksma_render_options *options, size_t i,
                                      char *text, size_t size);

/* A picture and what else is known of its pixels, all of one size. The image has 3 channels, or 1 for a scene without
   colour. */
typedef struct koksma_layers {
    koksma_image image;
    koksma_image albedo;   /* of what is seen first, over the samples; 3 channels */
    koksma_image normal;   /* likewise, towards the eye; 3 channels */
    koksma_image depth;    /* distance of what is seen first, over the samples that hit something; 0: none */
    koksma_image samples;  /* how many a pixel had */
    koksma_image variance; /* of the pixel's luminance, from the samples that it is made of (splatted: also those of
                              pixels around) as if they were independent: for a stratified pattern too large; 0 for
                              less than two of them */
    uint64_t rays;         /* cast */
} koksma_layers;

KOKSMA_API void koksma_layers_fini(koksma_layers *layers);

/* Bytes that a picture by these options takes, beside the scene and a few MiB for each thread (with splatting, a few
   rows of pixels more for each). */
typedef struct koksma_render_size {
    uint64_t film;    /* the image and its layers, and sums of splats */
    uint64_t samples; /* of scope image, which are drawn beforehand: at their peak */
    uint64_t file;    /* what is written, uncompressed: made in memory when the picture is done */
} koksma_render_size;

/* all_layers: as koksma_render_layers has it, and an EXR keeps it. */
KOKSMA_API koksma_render_size koksma_render_size_of(const koksma_scene *scene, const koksma_render_options *options,
                                                    bool all_layers);

/* Renders; allocates out. Equal arguments give equal bits on any number of threads. run may be NULL.
   Errors: ARGUMENT, what the pattern says about spp (N, DIM, IMPOSSIBLE, …), MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_render(const koksma_scene *scene, const koksma_render_options *options,
                                       const koksma_run *run, koksma_image *out);

/* The same picture with its layers; or with its image, sample counts and rays only, which is faster. When it is
   INTERRUPTED out holds the pixels that are done (the others have 0 in `samples`), and the caller frees it too. */
KOKSMA_API koksma_status koksma_render_layers(const koksma_scene *scene, const koksma_render_options *options,
                                              const koksma_run *run, koksma_layers *out);
KOKSMA_API koksma_status koksma_render_only(const koksma_scene *scene, const koksma_render_options *options,
                                            const koksma_run *run, koksma_layers *out);

#ifdef __cplusplus
}
#endif

#endif
