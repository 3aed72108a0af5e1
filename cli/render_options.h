/* SPDX-License-Identifier: Apache-2.0 */
/* The options of all commands that render: their lines in option tables, and their values. */
#ifndef KOKSMA_CLI_RENDER_OPTIONS_H
#define KOKSMA_CLI_RENDER_OPTIONS_H

#include <koksma/render.h>

#include "cli.h"

#define CLI_INTEGRATOR_OPTION                                                                                        \
    {                                                                                                                \
        0, "integrator", "INTEGRATOR", "see 'koksma list integrators' (default: distribution)"                       \
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
bool cli_integrator_and_filter(const cli_arguments *arguments, const koksma_integrator **integrator,
                               const koksma_filter **filter);

/* Reads all options of CLI_SAMPLING_OPTIONS. Returns false after an error that names the option. */
bool cli_sampling_options(const cli_arguments *arguments, koksma_render_options *options);

/* Reads --spp and the patterns. lines: one text per line in the form that koksma_render_patterns accepts, or with
   @SPP at the end. Returns false after an error and sets *code to the exit code. */
bool cli_use_patterns(const cli_arguments *arguments, const char *lines, koksma_render_options *options, int *code);

/* Warns on stderr about each use that was given a pattern although rendering this scene needs no samples for it. */
void cli_idle_uses(const cli_arguments *arguments, const char *name, const koksma_scene *scene,
                   const koksma_render_options *options);

/* Prints at most `most` of the scene's warnings on stderr, and a line with the number of the others. options: print
   only warnings that matter with these options, or NULL for all. Returns the number of warnings. */
size_t cli_scene_warnings(const cli_arguments *arguments, const char *name, const koksma_scene *scene,
                          const koksma_render_options *options, size_t most);

#endif
