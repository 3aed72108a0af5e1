/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Adaptive sampling: pixels that need more samples get more. Part of libkoksma-lab.
 *
 *     koksma_adaptive_options adaptive;
 *     if (!koksma_adaptive_parse("hierarchical:levels=2", &adaptive)) {
 *         koksma_render_adaptive(scene, &options, &adaptive, NULL, &layers, NULL);
 *     }
 *
 * In the first round every pixel gets options->spp samples, or `first` times as many where the method has a parameter
 * of this name. After each round the method decides from the values so far which pixels get more samples and how many.
 * Rendering ends when no pixel needs more samples or the budget is spent.
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
    const char *name, *title, *cite; /* cite: keys of docs/references.bib, separated by blanks */
    const koksma_param *params;      /* array that ends at a member whose name is NULL (NULL: no parameters) */
    bool own_samples;                /* true: the method places samples by subdividing the unit square of each pair of
                              dimensions; patterns and pairing then have no effect */
    const void *functions;           /* used only inside the renderer */
} koksma_adaptive;

/* Returns method i of the table, or the method with this name, or NULL if there is none. */
KOKSMA_API const koksma_adaptive *koksma_adaptive_at(size_t i);
KOKSMA_API const koksma_adaptive *koksma_adaptive_find(const char *name);

enum { KOKSMA_MAX_SPACES = 16 };

/* The strata of one pixel in the unit square of one sample dimension pair, such as the lens. */
typedef struct koksma_space {
    char name[48];          /* the purpose of the dimension pair: "pixel", "light 2", "lobe, vertex 2" */
    size_t n, n_splits;     /* numbers of strata and of splits, equal in all spaces of a pixel; entry i of the lists
                               is the same stratum or split in every space */
    koksma_stratum *strata; /* array of n; the values are luminances. If a stratum was split in other spaces but not
                               in this one, each of its parts is listed here with the cell and the mean value of the
                               whole stratum */
    koksma_split *splits;   /* array of n_splits, the coarsest first; empty if options->probes is 0 */
} koksma_space;

/* The subdivision of one pixel, which koksma_plot_strata draws. */
typedef struct koksma_strata {
    int x, y;             /* input: coordinates of the pixel */
    size_t n_spaces;      /* output: number of spaces. One-dimensional spaces with aligned strata are left out,
                             because their cells overlap */
    koksma_space *spaces; /* output: the spaces. spaces[0] is the one in which neighbouring strata were compared */
} koksma_strata;

/* Frees the spaces and zeroes the struct. strata may be NULL, or zeroed. */
KOKSMA_API void koksma_strata_fini(koksma_strata *strata);

/* A method of adaptive sampling with its parameters, and limits on its samples. */
typedef struct koksma_adaptive_options {
    const koksma_adaptive *method;
    double params[KOKSMA_MAX_PARAMS]; /* values of the parameters, in the order of method->params */
    double budget;                    /* largest number of samples per pixel, averaged over the image; 0: no
                                         limit */
    int probes; /* number of extra samples in each stratum that is split, 0 to KOKSMA_MAX_PROBES. Probes test
                   whether the split was needed and do not enter the image. Must be 0 unless method->own_samples is
                   true */
    koksma_strata *strata; /* receives the strata of one pixel. Must be NULL unless method->own_samples is true */
} koksma_adaptive_options;

enum { KOKSMA_MAX_PROBES = 256 };

/* Parses "name" or "name:key=value,key=value"; sets budget and probes to 0. Errors: UNKNOWN (no method has the
   name), ARGUMENT (a bad parameter). */
KOKSMA_API koksma_status koksma_adaptive_parse(const char *text, koksma_adaptive_options *out);

/* Writes the canonical text of a method and its parameters; parameters at their defaults are left out.
     text  buffer of KOKSMA_MAX_SPEC characters */
KOKSMA_API void koksma_adaptive_text(const koksma_adaptive_options *options, char *text);

/* Statistics of an adaptive rendering. */
typedef struct koksma_adaptive_report {
    uint64_t samples;  /* samples of all pixels; includes samples that only guided the method, but not probes */
    uint64_t first;    /* samples of all pixels in the first round */
    uint64_t rounds;   /* number of rounds after the first */
    uint64_t splits;   /* number of strata that were split */
    uint64_t needless; /* number of splits that were not needed, because the values of the sample and of all probes
                          differed by less than the method's threshold */
} koksma_adaptive_report;

/* Renders a scene with adaptive sampling; allocates out, which koksma_layers_fini frees.
     options  as for koksma_render_layers; spp, times the method's parameter `first` if there is one, is the number of
              samples of the first round
     out      `samples` has the number of samples of each pixel; `variance` estimates the variance of the pixel's
              luminance as if its samples were independent; albedo, normal and depth come from the
              first round
     report   may be NULL
   Errors: those of koksma_render_layers; also ARGUMENT for splatting, for scope image, for a pattern that gives the
   same set for every seed (but sequences are taken, whose successive blocks differ, by methods without fresh sets), and
   for options with which the method would never stop. */
KOKSMA_API koksma_status koksma_render_adaptive(const koksma_scene *scene, const koksma_render_options *options,
                                                const koksma_adaptive_options *adaptive, const koksma_run *run,
                                                koksma_layers *out, koksma_adaptive_report *report);

/* Returns the bytes that the method needs before the first round, in addition to those that koksma_render_size_of
   returns for all layers. Methods that split strata need more memory with every split. */
KOKSMA_API uint64_t koksma_adaptive_size_of(const koksma_render_options *options,
                                            const koksma_adaptive_options *adaptive);

#ifdef __cplusplus
}
#endif

#endif
