/* SPDX-License-Identifier: Apache-2.0 */
/*
 * `koksma scene check`: reads a scene file, warns about what can be rendered but looks like a mistake, and prints
 * what the scene contains.
 */
#include <stdio.h>
#include <string.h>

#include "cli.h"
#include "rendering.h"

enum { MOST_LOOKED_AT = 1000000 }; /* triangles of a scene that is rendered small: a tree of more takes seconds */

static int run(const cli_args *args)
{
    koksma_scene *scene;
    if (args->n_operands != 2 || strcmp(args->operands[0], "check") != 0) {
        return cli_error(args, "it takes check and one scene, as in 'koksma scene check ball'");
    }
    koksma_status status = koksma_scene_open(args->operands[1], &scene);
    if (status) {
        return cli_fail(args, status);
    }
    const koksma_scene_counts counts = koksma_scene_count(scene);
    const bool odd = cli_scene_warnings(args, args->operands[1], scene, NULL, SIZE_MAX) > 0;
    bool is_black = false;
    koksma_render_options options;
    koksma_render_options_init(&options, scene);
    if (!(odd && !counts.lights) && counts.triangles <= MOST_LOOKED_AT) {
        status = cli_look(args, args->operands[1], scene, &options, &is_black);
    }
    cli_row("scene %s shapes %zu meshes %zu placements %zu triangles %zu materials %zu lights %zu "
            "media %zu",
            args->operands[1], counts.shapes, counts.meshes, counts.placements, counts.triangles, counts.materials,
            counts.lights, counts.media);
    if (counts.spp) {
        cli_row("spp %zu\n", counts.spp);
    } else {
        cli_row_json("spp", "null", "-");
        cli_row_end();
    }
    koksma_scene_close(scene);
    const int code = cli_rows_close(odd || is_black ? CLI_NO : CLI_YES);
    return status ? cli_fail(args, status) : code;
}

static const cli_option options[] = {CLI_UNKNOWN_OPTION, CLI_ROW_OPTIONS, {0}};

const cli_command cli_command_scene = {
    .name = "scene",
    .summary = "check a scene file",
    .synopsis = "check SCENE",
    .details = "SCENE is a name, a JSON file (docs/scenes.md), a mesh file, or a scene of pbrt-v4 (.pbrt) or "
               "Mitsuba (.xml). An error names file, line, field and reason (exit code 3). A warning reports "
               "something odd that can still be rendered, or that a small picture of up to a million triangles is "
               "black (exit code 1). stdout lists what the scene contains (spp: samples a pixel that its own sampler "
               "asks for).\n",
    .examples = "koksma scene check ball\n",
    .options = options,
    .run = run,
};
