/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Adaptive sampling: pixels that need more samples get more. Part of libkoksma-lab.
 *
 *     koksma_adaptive_options adaptive;
 *     if (!koksma_adaptive_parse("hierarchical:levels=2", &adaptive)) {
 *         koksma_render_adaptive(scene, &options, &adaptive, NULL, &layers, NULL);
 *     }
 *
 * In the first round every pixel gets options->spp samples. After each round the method decides from the values so
 * far which pixels get more samples and how many, until none needs any or the budget is spent.
 */
#ifndef KOKSMA_ADAPTIVE_H
#define KOKSMA_ADAPTIVE_H

#include <koksma/plot.h>
#include <koksma/render.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A method of adaptive sampling. */
typedef struct koksma_adaptive {
    const char *name, *title, *cite; /* cite: keys of docs/references.bib */
    const koksma_param *params;      /* up to one whose name is NULL; NULL: none */
    bool own_samples;      /* it subdivides the squares of all samples itself: patterns and pairing have no effect */
    const void *functions; /* for the renderer */
} koksma_adaptive;

/* Returns method i of the table, or the method with this name; NULL if there is none. */
KOKSMA_API const koksma_adaptive *koksma_adaptive_at(size_t i);
KOKSMA_API const koksma_adaptive *koksma_adaptive_find(const char *name);

enum { KOKSMA_MAX_SPACES = 16 };

/* The strata of one pixel in the unit square of one sample dimension pair, such as the lens. */
typedef struct koksma_space {
    char name[48];      /* what the samples are for: "pixel", "light 2", "lobe, vertex 2" */
    size_t n, n_splits; /* equal in all spaces of the pixel; the lists have the same order in all */
    koksma_stratum
        *strata;          /* n; values are luminances. Where this space is not split, all parts of a stratum show its
                               cell and their mean */
    koksma_split *splits; /* n_splits, the coarsest first; none without probes. With reuse=fresh they are the cells of
                               the samples that decided */
} koksma_space;

/* The subdivision of one pixel, for a picture of it (koksma_plot_strata). */
typedef struct koksma_strata {
    int x, y;             /* in: the pixel */
    size_t n_spaces;      /* out; spaces whose cells overlap (of one dimension, in aligned strata) are left out */
    koksma_space *spaces; /* out; the first is the one in which neighbours were compared */
} koksma_strata;

/* Frees the spaces and zeroes the struct. strata may be NULL, or zeroed. */
KOKSMA_API void koksma_strata_fini(koksma_strata *strata);

/* A method with its parameters, and limits. */
typedef struct koksma_adaptive_options {
    const koksma_adaptive *method;
    double params[KOKSMA_MAX_PARAMS]; /* in the order of method->params */
    double budget;                    /* the most samples a pixel, averaged over the image; 0: no limit */
    int probes; /* 0 to KOKSMA_MAX_PROBES extra samples in each stratum that is split, to find out whether the split was
                   needed; they do not enter the image. Only for methods with own_samples */
    koksma_strata *strata; /* receives the strata of one pixel; may be NULL. Only for methods with own_samples */
} koksma_adaptive_options;

enum { KOKSMA_MAX_PROBES = 256 };

/* Parses "name" or "name:key=value,key=value"; sets no budget and no probes. Errors: UNKNOWN (name), ARGUMENT (a
   parameter). */
KOKSMA_API koksma_status koksma_adaptive_parse(const char *text, koksma_adaptive_options *out);

/* Writes the canonical text of method and parameters, without parameters at their defaults.
     text  KOKSMA_MAX_SPEC characters */
KOKSMA_API void koksma_adaptive_text(const koksma_adaptive_options *options, char *text);

/* What an adaptive rendering did. */
typedef struct koksma_adaptive_report {
    uint64_t samples;  /* of all pixels, including samples that only decided, without probes */
    uint64_t first;    /* samples of the first round */
    uint64_t rounds;   /* rounds after the first */
    uint64_t splits;   /* strata that were split */
    uint64_t needless; /* splits where all probes and the sample differ by less than the threshold */
} koksma_adaptive_report;

/* Renders adaptively; allocates out, which koksma_layers_fini frees.
     options  as for koksma_render_layers; spp is the number of samples of the first round
     out      `samples` has the number of samples of each pixel; `variance` that of the pixel's luminance as if its
              samples were independent; albedo, normal and depth are those of the first round
     report   may be NULL
   Errors: those of koksma_render_layers; ARGUMENT also for splatting, scope image, a pattern whose sets are all
   equal, and options under which the method would never stop. */
KOKSMA_API koksma_status koksma_render_adaptive(const koksma_scene *scene, const koksma_render_options *options,
                                                const koksma_adaptive_options *adaptive, const koksma_run *run,
                                                koksma_layers *out, koksma_adaptive_report *report);

/* Returns the bytes that the method needs in addition to koksma_render_size_of with all layers, before the first
   round. Methods that split strata need more with every split. */
KOKSMA_API uint64_t koksma_adaptive_size_of(const koksma_render_options *options,
                                            const koksma_adaptive_options *adaptive);

#ifdef __cplusplus
}
#endif

#endif
