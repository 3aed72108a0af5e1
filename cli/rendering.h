/* SPDX-License-Identifier: Apache-2.0 */
/* The options of commands that render or compare images: their lines in option tables, and their values. */
#ifndef KOKSMA_CLI_RENDERING_H
#define KOKSMA_CLI_RENDERING_H

#include <koksma/adaptive.h>
#include <koksma/image.h>
#include <koksma/render.h>

#include "cli.h"

#define CLI_INTEGRATOR_OPTION                                                                                        \
    {                                                                                                                \
        0, "integrator", "INTEGRATOR",                                                                               \
            "see 'koksma list integrators' (default: distribution, or path in a medium "                             \
            "and where a scene of pbrt or Mitsuba asks for it)"                                                      \
    }
#define CLI_FILTER_OPTION                                                                                            \
    {                                                                                                                \
        0, "filter", "FILTER", "pixel filter; see 'koksma list filters' (default: box)"                              \
    }
#define CLI_SAMPLING_OPTIONS                                                                                         \
    {0, "pairing", "shuffled|aligned|native", "how the point sets of a pixel are combined (default: shuffled)"},     \
        {0, "scope", "pixel|image", "what one point set covers (default: pixel)"},                                   \
        {0, "lights", "all|one|power|uniform|auto",                                                                  \
         "lights that get a shadow ray: all, or one chosen by its estimated contribution (one), by its power, or "   \
         "uniformly; auto: one with an integrator such as path and more than 8 lights, else all (default: auto)"},   \
        CLI_INTEGRATOR_OPTION, {0, "depth", "D", "the most bounces (default: the integrator's)"}, CLI_FILTER_OPTION, \
    {                                                                                                                \
        0, "splat", NULL,                                                                                            \
            "add each sample to all pixels that the filter reaches, instead of sampling the filter; this has less "  \
            "error"                                                                                                  \
    }

/* Reads --integrator and --filter; on entry *integrator and *filter have the defaults. Returns false after an error
   that names the option. */
int cli_one_scene(const cli_arguments *arguments);

bool cli_integrator_and_filter(const cli_arguments *arguments, const koksma_integrator **integrator,
                               const koksma_filter **filter);

/* Reads all options of CLI_SAMPLING_OPTIONS. Returns false after an error that names the option. */
bool cli_sampling_options(const cli_arguments *arguments, koksma_render_options *options);

/* Reads --spp and the patterns. lines: one text per line in the form that koksma_render_patterns accepts, or with
   @SPP at the end. Returns false after an error and sets *code to the exit code. */
bool cli_use_patterns(const cli_arguments *arguments, const char *lines, koksma_render_options *options, int *code);

/* Warns on stderr about each use that was given a pattern although rendering this scene needs no samples for it. */
void cli_warn_unused(const cli_arguments *arguments, const char *name, const koksma_scene *scene,
                     const koksma_render_options *options);

/* Prints at most `most` of the scene's warnings on stderr, and a line with the number of the others. options: print
   only warnings that matter with these options, or NULL for all. Returns the number of warnings. */
size_t cli_scene_warnings(const cli_arguments *arguments, const char *name, const koksma_scene *scene,
                          const koksma_render_options *options, size_t most);

/* Renders a small picture by the integrator of `options`, and says if it is black: *is_black. */
koksma_status cli_look(const cli_arguments *arguments, const char *name, const koksma_scene *scene,
                       const koksma_render_options *options, bool *is_black);
void cli_say_black(const cli_arguments *arguments, const char *name, int width, int height);

/* ---- Adaptive sampling -------------------------------------------------------------------------------- */

#define CLI_ADAPTIVE_OPTIONS                                                                                         \
    {0, "adaptive", "METHOD", "take more samples in pixels that need them; see 'koksma list adaptive'"},             \
        {0, "budget", "SPP", "with --adaptive: largest mean number of samples per pixel (default: no limit)"},       \
        {0, "strata", "X,Y:FILE", "with --adaptive: draw how pixel X,Y was split; .svg, .pdf or .png"},              \
        {0, "probe", "K",                                                                                            \
         "with --adaptive: take K more samples to test whether each split was needed (default: 0)"},                 \
    {                                                                                                                \
        0, "counts", "FILE",                                                                                         \
            "write an image of the number of samples of each pixel; in .png and .jpg white is the largest"           \
    }

/* Options and results of adaptive sampling. Without --adaptive, options.method is NULL and every pixel has the same
   number of samples. */
typedef struct cli_adaptive {
    koksma_adaptive_options options;
    koksma_adaptive_report report;
    koksma_strata strata;
    const char *strata_path; /* NULL without --strata */
} cli_adaptive;

/* Reads CLI_ADAPTIVE_OPTIONS into *adaptive. Returns false after an error and sets *code to the exit code. */
bool cli_adaptive_options(const cli_arguments *arguments, cli_adaptive *adaptive, int *code);

/* Adds the columns of adaptive sampling to the current row; without --adaptive it adds none. pixels: the number of
   pixels of the image. */
void cli_adaptive_put(cli_rows *rows, const cli_adaptive *adaptive, double pixels);

/* Writes the image of --counts if that option is given. For a .png or .jpg file it first divides the numbers in
   `samples` by the largest. */
koksma_status cli_adaptive_counts(const cli_arguments *arguments, koksma_image *samples);

/* Writes the drawing of --strata if that option is given, and then frees the strata. */
koksma_status cli_adaptive_strata(cli_adaptive *adaptive);

/* ---- The option --metric, and warnings about errors that few pixels carry ----------------------------- */

enum { CLI_MAX_METRICS = 16 };

typedef struct cli_metrics {
    size_t n;
    koksma_metric_spec specs[CLI_MAX_METRICS];
} cli_metrics;

/* Adds each metric of --metric, which is a list or `all`; without this option it adds none. A metric that is listed twice
   is an error if `once`, else it is added once. Returns false after an error. */
bool cli_metrics_parse(const cli_arguments *arguments, bool once, cli_metrics *metrics);

/* Reads --metric as one metric, by default mae. Returns false after an error. */
bool cli_one_metric(const cli_arguments *arguments, cli_metrics *metrics);

/* Warns of a value's caveat, and as below. */
void cli_warn_of_value(const char *command, const char *subject, const char *metric,
                       const koksma_metric_value *value);

/* Warns when few pixels carry most of the error. subject: the beginning of the message, such as a pattern's name. */
void cli_warn_of_few_pixels(const char *command, const char *subject, const char *metric,
                            const koksma_metric_value *value);

/* ---- Numbers in image files of 8 bits, which hold only colours from 0 to 1 ---------------------------- */

/* Whether a text names an image file, by its ending; it may be NULL. */
bool cli_is_image(const char *text);

/* Returns whether files of this name hold 8 bits per channel (PNG, JPEG): numbers above 1 are white in them. */
bool cli_has_eight_bits(const char *path);

#endif
