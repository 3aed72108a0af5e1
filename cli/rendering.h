/* SPDX-License-Identifier: Apache-2.0 */
/* The options of commands that render or compare images: their lines in option tables, and their values. */
#ifndef KOKSMA_CLI_RENDERING_H
#define KOKSMA_CLI_RENDERING_H

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

/* Reports that there is not one operand. */
int cli_one_scene(const cli_args *args);

/* Reads --integrator and --filter; on entry *integrator and *filter have the defaults. */
bool cli_integrator_and_filter(const cli_args *args, const koksma_integrator **integrator,
                               const koksma_filter **filter);

/* Prints at most `most` of the scene's warnings on stderr, and a line with the number of the others. options: print
   only warnings that matter with these options, or NULL for all. Returns the number of warnings. */
size_t cli_scene_warnings(const cli_args *args, const char *name, const koksma_scene *scene,
                          const koksma_render_options *options, size_t most);

/* Renders a small picture by the integrator of `options`, and says if it is black: *is_black. */
koksma_status cli_look(const cli_args *args, const char *name, const koksma_scene *scene,
                       const koksma_render_options *options, bool *is_black);
void cli_say_black(const cli_args *args, const char *name, int width, int height);

/* ---- The option --metric, and warnings about errors that few pixels carry ----------------------------- */

enum { CLI_MAX_METRICS = 16 };

typedef struct cli_metrics {
    size_t n;
    koksma_metric_spec specs[CLI_MAX_METRICS];
} cli_metrics;

/* Adds each metric of --metric, which is a list or `all`; without this option it adds none. A metric that is listed twice
   is an error if `once`, else it is added once. Returns false after an error. */
bool cli_metrics_parse(const cli_args *args, bool once, cli_metrics *metrics);

/* Reads --metric as one metric, by default mae. Returns false after an error. */
bool cli_one_metric(const cli_args *args, cli_metrics *metrics);

/* Warns of a value's caveat, and when few pixels carry most of the error. subject: the beginning of the message, such as a
   pattern's name. */
void cli_warn_of_value(const char *command, const char *subject, const char *metric,
                       const koksma_metric_value *value);

/* ---- Numbers in image files of 8 bits, which hold only colours from 0 to 1 ---------------------------- */

/* Whether a text names an image file, by its ending; it may be NULL. */
bool cli_is_image(const char *text);

/* Returns whether files of this name hold 8 bits per channel (PNG, JPEG): numbers above 1 are white in them. */
bool cli_has_eight_bits(const char *path);

#endif
