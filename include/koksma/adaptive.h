/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Adaptive sampling: pixels that need more samples get more.
 *
 *     koksma_adaptive_options adaptive;
 *     if (!koksma_adaptive_parse("hierarchical:levels=2", &adaptive)) {
 *         koksma_render_adaptive(scene, &options, &adaptive, NULL, &layers, NULL);
 *     }
 *
 * Every pixel gets options->spp samples at first. Then, in rounds, the method says from the values so far which
 * pixels want how many more, until none does or the budget is spent.
 */
#ifndef KOKSMA_ADAPTIVE_H
#define KOKSMA_ADAPTIVE_H

#include <koksma/plot.h>
#include <koksma/render.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct koksma_adaptive {
    const char *name, *title, *cite;
    const koksma_param *params;
    bool own_samples;  /* it draws strata of its own: the options' patterns and pairing are idle */
    const void *rules; /* for the renderer */
} koksma_adaptive;

/* Member i of the table, NULL past the end; by name, NULL if unknown. */
KOKSMA_API const koksma_adaptive *koksma_adaptive_at(size_t i);
KOKSMA_API const koksma_adaptive *koksma_adaptive_find(const char *name);

enum { KOKSMA_MAX_SPACES = 16 };

/* The strata of one pixel in the square of one use. */
typedef struct koksma_space {
    char name[48];          /* of the use: "pixel", "light 2", "lobe, vertex 2" */
    size_t n, n_splits;     /* equal in all spaces of the pixel, as are the orders of the lists */
    koksma_stratum *strata; /* values are luminances. In a use that is not split, parts of a stratum have its cell,
                               and their mean */
    koksma_split *splits;   /* the coarsest first; none without probes, which find the needless ones. With reuse=fresh
                               they are where the deciding samples were */
} koksma_space;

/* The subdivision of one pixel, for a picture of it (koksma_plot_strata). */
typedef struct koksma_strata {
    int x, y;             /* which pixel: set before */
    size_t n_spaces;      /* of all uses but those whose cells overlap: of one number, in aligned strata */
    koksma_space *spaces; /* first that in which neighbours were compared; koksma_strata_fini frees them */
} koksma_strata;

KOKSMA_API void koksma_strata_fini(koksma_strata *strata);

typedef struct koksma_adaptive_options {
    const koksma_adaptive *method;
    double params[KOKSMA_MAX_PARAMS];
    double budget; /* samples a pixel, in the mean over the image, at most; 0: the method alone decides */
    int probes; /* samples, which count for nothing else, in each stratum that is split, to see whether it needed to
                   be; only methods with samples of their own. 0: not asked */
    koksma_strata *strata; /* NULL, or where the strata of one pixel go; only methods with samples of their own */
} koksma_adaptive_options;

enum { KOKSMA_MAX_PROBES = 256 };

/* Parses "name" or "name:key=value,key=value"; no budget, no probes. Errors: UNKNOWN, ARGUMENT. */
KOKSMA_API koksma_status koksma_adaptive_parse(const char *text, koksma_adaptive_options *out);

/* The canonical text of method and parameters. text has room for KOKSMA_MAX_SPEC characters. */
KOKSMA_API void koksma_adaptive_text(const koksma_adaptive_options *options, char *text);

typedef struct koksma_adaptive_report {
    uint64_t samples;  /* of all pixels, also those that only decided; without probes */
    uint64_t first;    /* of them in the first round */
    uint64_t rounds;   /* after the first */
    uint64_t splits;   /* strata that were split */
    uint64_t needless; /* of them, where all probes and the sample itself were within the threshold of each other */
} koksma_adaptive_report;

/* Renders as koksma_render_layers does: `samples` says how many a pixel had, `variance` is that of the pixel's
   luminance as if its samples were independent; albedo, normal and depth are of the first round. report may be NULL.
   Equal arguments give equal bits on any number of threads.
   Errors: those of koksma_render_layers; ARGUMENT for splatting, scope image, a pattern whose sets are all the same,
   and a method without anything that stops it. */
KOKSMA_API koksma_status koksma_render_adaptive(const koksma_scene *scene, const koksma_render_options *options,
                                                const koksma_adaptive_options *adaptive, const koksma_run *run,
                                                koksma_layers *out, koksma_adaptive_report *report);

/* Bytes that the method keeps of the pixels beside koksma_render_size_of with all layers: before the first round;
   where strata are split they grow with them. */
KOKSMA_API uint64_t koksma_adaptive_size_of(const koksma_render_options *options,
                                            const koksma_adaptive_options *adaptive);

#ifdef __cplusplus
}
#endif

#endif
