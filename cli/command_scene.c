/* SPDX-License-Identifier: Apache-2.0 */
/*
 * `koksma scene check`: reads a scene file, warns about what can be rendered but looks like a mistake, and prints
 * what the scene contains.
 */
#include <stdio.h>
#include <string.h>

#include "cli.h"
#include "rendering.h"

static int run(const cli_arguments *arguments)
{
    koksma_scene *scene;
    if (arguments->n_operands != 2 || strcmp(arguments->operands[0], "check") != 0) {
        return cli_usage_error(arguments, "it takes check and one scene, as in 'koksma scene check ball'");
    }
    koksma_status status = koksma_scene_open(arguments->operands[1], &scene);
    if (status) {
        return cli_fail(arguments, status);
    }
    cli_rows *rows = cli_rows_open(cli_flag(arguments, "json"));
    const koksma_scene_counts counts = koksma_scene_count(scene);
    const bool odd = cli_scene_warnings(arguments, arguments->operands[1], scene, NULL, SIZE_MAX) > 0;
    bool is_black = false;
    koksma_render_options options;
    koksma_render_options_init(&options, scene);
    status =
        odd && !counts.lights ? KOKSMA_OK : cli_look(arguments, arguments->operands[1], scene, &options, &is_black);
    cli_row_text(rows, "scene", arguments->operands[1]);
    cli_row_whole(rows, "shapes", counts.shapes);
    cli_row_whole(rows, "meshes", counts.meshes);
    cli_row_whole(rows, "placements", counts.placements);
    cli_row_whole(rows, "triangles", counts.triangles);
    cli_row_whole(rows, "materials", counts.materials);
    cli_row_whole(rows, "lights", counts.lights);
    cli_row_whole(rows, "media", counts.media);
    if (counts.spp) {
        cli_row_whole(rows, "spp", counts.spp);
    } else {
        cli_row_json(rows, "spp", "null", "-");
    }
    cli_row_end(rows);
    koksma_scene_close(scene);
    const int code = cli_rows_close(rows, odd || is_black ? CLI_NO : CLI_YES);
    return status ? cli_fail(arguments, status) : code;
}

static const cli_option options[] = {CLI_UNKNOWN_OPTION, CLI_ROW_OPTIONS, {0}};

const cli_command cli_command_scene = {
    .name = "scene",
    .summary = "check a scene file",
    .synopsis = "check SCENE",
    .details = "SCENE is a name, a JSON file (docs/scenes.md), a mesh file, or a scene of pbrt-v4 (.pbrt) or "
               "Mitsuba (.xml). An error names file, line, field and reason (exit code 3). A warning reports "
               "something odd that can still be rendered, or that a small picture is black (exit code 1). stdout "
               "lists what the scene contains (spp: "
               "samples a pixel that its own sampler asks for).\n",
    .examples = "koksma scene check ball\n",
    .options = options,
    .run = run,
};
