/* SPDX-License-Identifier: Apache-2.0 */
/*
 * `koksma scene check`: reads a scene file, warns about what can be rendered but looks like a mistake, and prints
 * what the scene contains.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli.h"
#include "rendering.h"

enum { MOST_PARTS = 40 };

static void put_range(cli_rows *rows, const char *key, double low, double high, double unit)
{
    char text[2 * CLI_NUMBER + 4], json[64], a[CLI_NUMBER], b[CLI_NUMBER];
    const bool ends = isfinite(low) && isfinite(high);
    snprintf(text, sizeof text,
             !ends      ? "endless"
             : unit > 1 ? "%s to %s %%"
                        : "%s to %s",
             cli_number(low * unit, a), cli_number(high * unit, b));
    snprintf(json, sizeof json, ends ? "[%.17g,%.17g]" : "null", low, high);
    cli_row_json(rows, key, json, text);
}

/* Prints a row for each of the first MOST_PARTS parts of the scene, or of all with --long or --json: its bounding box and
   the part of the image that the box covers. */
static void put_parts(const cli_arguments *arguments, cli_rows *rows, const koksma_scene *scene)
{
    koksma_scene_part part;
    const size_t most = cli_flag(arguments, "long") || cli_flag(arguments, "json") ? SIZE_MAX : MOST_PARTS;
    size_t i = 0;
    for (; i < most && koksma_scene_part_at(scene, i, &part); i++) {
        cli_row_text(rows, "part", part.name);
        put_range(rows, "x", part.low[0], part.high[0], 1);
        put_range(rows, "y", part.low[1], part.high[1], 1);
        put_range(rows, "z", part.low[2], part.high[2], 1);
        if (part.in_frame) {
            put_range(rows, "across", part.frame[0], part.frame[1], 100);
            put_range(rows, "down", part.frame[2], part.frame[3], 100);
        } else {
            cli_row_json(rows, "across", "null", "not in");
            cli_row_json(rows, "down", "null", "the picture");
        }
        cli_row_end(rows);
    }
    if (koksma_scene_part_at(scene, i, &part)) {
        cli_say("scene", "%s: the first %d parts; --long lists all", arguments->operands[1], MOST_PARTS);
    }
}

static int run(const cli_arguments *arguments)
{
    koksma_scene *scene;
    if (arguments->n_operands != 2 || strcmp(arguments->operands[0], "check") != 0) {
        const char *given = arguments->n_operands == 1 ? arguments->operands[0] : "ball";
        return cli_usage_error(arguments, "it takes check FILE, as in 'koksma scene check %s'",
                               strcmp(given, "check") ? given : "ball");
    }
    const koksma_status status = koksma_scene_open(arguments->operands[1], &scene);
    if (status) {
        return cli_fail(arguments, status);
    }
    cli_rows *rows = cli_rows_open(cli_flag(arguments, "json"));
    const koksma_scene_counts counts = koksma_scene_count(scene);
    const bool odd = cli_scene_warnings(arguments, arguments->operands[1], scene, NULL, SIZE_MAX) > 0;
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
    put_parts(arguments, rows, scene);
    koksma_scene_close(scene);
    return cli_rows_close(rows, odd ? CLI_NO : CLI_YES);
}

static const cli_option options[] = {CLI_UNKNOWN_OPTION, CLI_ROW_OPTIONS, {0}};

const cli_command cli_command_scene = {
    .name = "scene",
    .summary = "check a scene file",
    .synopsis = "check SCENE",
    .details = "SCENE is a name, a JSON file (docs/scenes.md), a mesh file, or a scene of pbrt-v4 (.pbrt) or "
               "Mitsuba (.xml). An error names file, line, field and reason (exit code 3). A warning reports "
               "something odd that can still be rendered (exit code 1). stdout lists what the scene contains (spp: "
               "samples a pixel that its own sampler asks for): the "
               "bounding box of each part, and the largest region of the image that the part can cover, both while "
               "the shutter is open: with every motion, and through the whole lens. Text has the first 40 parts, "
               "with --long all.\n",
    .examples = "koksma scene check ball\n",
    .options = options,
    .run = run,
};
