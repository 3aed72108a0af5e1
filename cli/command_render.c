/* SPDX-License-Identifier: Apache-2.0 */
/*
 * `koksma render`: renders a scene into an image file and prints one row with the options, the number of rays and the
 * time. Before it starts it computes how much memory the image takes, and refuses an image that takes more than the
 * machine has. When it is interrupted it writes the image with the pixels that are done.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli.h"
#include "rendering.h"

/* MAP_BYTES: what a pixel of an error map takes: sums of two doubles and two floats for each of 3 channels. */
enum { REPLICATES = 8, MAP_BYTES = 3 * (2 * sizeof(double) + 2 * sizeof(float)) };

/* replicates: NULL without --error-map. */
static int put_row(const cli_arguments *arguments, const koksma_render_options *options, const cli_adaptive *adaptive,
                   const koksma_replicates *replicates, uint64_t rays, double seconds)
{
    const koksma_adaptive *method = adaptive->options.method;
    static char pattern[KOKSMA_MAX_PATTERNS_TEXT];
    koksma_render_patterns_text(options, pattern);
    cli_rows *rows = cli_rows_open(cli_flag(arguments, "json"));
    cli_row_text(rows, "scene", arguments->operands[0]);
    cli_row_text(rows, "pattern", method && method->own_samples ? "-" : pattern);
    cli_row_whole(rows, "spp", (uint64_t)options->spp);
    cli_row_whole(rows, "width", (uint64_t)options->width);
    cli_row_whole(rows, "height", (uint64_t)options->height);
    cli_adaptive_put(rows, adaptive, (double)options->width * options->height);
    if (replicates) {
        cli_row_whole(rows, "replicates", replicates->replicates);
        cli_row_number(rows, "mean", replicates->mean);
        cli_row_number(rows, "mean_low", replicates->mean_low);
        cli_row_number(rows, "mean_high", replicates->mean_high);
        cli_row_number(rows, "rmse", replicates->rmse);
        cli_row_number(rows, "rmse_low", replicates->rmse_low);
        cli_row_number(rows, "rmse_high", replicates->rmse_high);
    }
    cli_row_whole(rows, "rays", rays);
    cli_row_number(rows, "seconds", seconds);
    cli_row_end(rows);
    return cli_rows_close(rows, CLI_YES);
}

/* Writes the metadata of the image file into `text`: version, scene, patterns and options. */
static void describe(const cli_arguments *arguments, const koksma_scene *scene, const koksma_render_options *o,
                     const koksma_adaptive_options *adaptive, char *text, size_t size)
{
    char pattern[KOKSMA_MAX_SPEC];
    koksma_spec_text(&o->pattern, pattern);
    snprintf(text, size, "koksma %s scene=%s hash=%016llx pattern=%s", koksma_version(), arguments->operands[0],
             (unsigned long long)koksma_scene_hash(scene), pattern);
    for (size_t i = 0; koksma_use_at(i); i++) {
        if (o->patterns[i].pattern) {
            const size_t used = strlen(text);
            koksma_spec_text(&o->patterns[i], pattern);
            snprintf(text + used, size - used, " %s=%s", koksma_use_at(i)->name, pattern);
        }
    }
    for (size_t g = 0; g < KOKSMA_MAX_USE_GROUPS; g++) {
        if (o->groups[g].n_uses) {
            char uses[KOKSMA_MAX_SPEC];
            const size_t used = strlen(text);
            koksma_use_group_text(&o->groups[g], uses);
            koksma_spec_text(&o->groups[g].pattern, pattern);
            snprintf(text + used, size - used, " %s=%s", uses, pattern);
        }
    }
    const size_t used = strlen(text);
    snprintf(text + used, size - used,
             " spp=%d pairing=%s scope=%s lights=%s integrator=%s depth=%d filter=%s%s seed=%llu", o->spp,
             koksma_pairing_name(o->pairing), koksma_scope_name(o->scope), koksma_light_selection_name(o->lights),
             o->integrator->name, koksma_render_depth(scene, o), o->filter->name, o->splat ? " splat" : "",
             (unsigned long long)o->seed);
    if (adaptive->method) {
        const size_t length = strlen(text);
        koksma_adaptive_text(adaptive, pattern);
        snprintf(text + length, size - length, " adaptive=%s budget=%g", pattern, adaptive->budget);
    }
}

enum { PATH = 8192 }; /* a path that is cut here is one that no system opens, and is refused as such */

/* Finds file i of those that the command writes: `option` is its part of the command line; the path is empty if the option
   isn't given. Returns false past the last one. */
static bool file_at(const cli_arguments *arguments, const cli_adaptive *adaptive, int i, char option[64],
                    char path[PATH])
{
    const char *output = cli_text(arguments, "output", ""), *strata = adaptive->strata_path;
    const struct {
        const char *name, *path;
    } own[] = {{"-o", output},
               {"--counts", cli_text(arguments, "counts", "")},
               {"--strata", strata ? strata : ""},
               {"--error-map", cli_text(arguments, "error-map", "")}};
    const int n = sizeof own / sizeof *own;
    if (i < n) {
        snprintf(option, 64, "%s", own[i].name);
        snprintf(path, PATH, "%s", own[i].path);
    }
    return i < n;
}

/* Returns false, after an error, if two options write one file. */
static bool check_files(const cli_arguments *arguments, const cli_adaptive *adaptive)
{
    static char path[PATH], other[PATH];
    char option[64], with[64];
    for (int i = 0; file_at(arguments, adaptive, i, option, path); i++) {
        for (int k = 0; k < i && *path; k++) {
            file_at(arguments, adaptive, k, with, other);
            if (*other && cli_is_same_output(path, other)) {
                cli_usage_error(arguments, "%s and %s would both write %s", with, option, other);
                return false;
            }
        }
    }
    return true;
}

/* Tries whether all files can be written, before the work. Returns the exit code. */
static int try_files(const cli_arguments *arguments, const cli_adaptive *adaptive)
{
    static char path[PATH];
    char option[64];
    int code = CLI_YES;
    for (int i = 0; !code && file_at(arguments, adaptive, i, option, path); i++) {
        code = *path ? cli_try_output(arguments, path) : CLI_YES;
    }
    return code;
}

static koksma_status write_image(const cli_arguments *arguments, const koksma_scene *scene,
                                 const koksma_render_options *options, const koksma_adaptive_options *adaptive,
                                 koksma_layers *layers)
{
    static char metadata[(KOKSMA_N_USES + 2) * KOKSMA_MAX_SPEC];
    const koksma_layer own[] = {{"", &layers->image},          {"albedo", &layers->albedo},
                                {"normal", &layers->normal},   {"Z", &layers->depth},
                                {"samples", &layers->samples}, {"variance", &layers->variance}};
    const char *output = cli_text(arguments, "output", "");
    const size_t n = layers->albedo.pixels ? sizeof own / sizeof *own : 1;
    describe(arguments, scene, options, adaptive, metadata, sizeof metadata);
    const koksma_status status = koksma_image_write_layers(output, own, n, metadata);
    return status ? status : cli_adaptive_counts(arguments, &layers->samples);
}

/* Before rendering, a message announces the memory of images that need at least this number of bytes. */
#define LARGE (1ull << 30)

static double in_gib(uint64_t bytes)
{
    return (double)bytes / (1024.0 * 1024 * 1024);
}

/* Prints how much memory a large image takes. Returns false, after an error, if this is more than the machine has,
   because swapping would take longer than rendering. */
static bool announce_size(const cli_arguments *arguments, const koksma_scene *scene,
                          const koksma_render_options *options, const koksma_adaptive_options *adaptive)
{
    const bool layers = adaptive->method || koksma_image_has_layers(cli_text(arguments, "output", ""));
    const koksma_render_size size = koksma_render_size_of(scene, options, layers);
    const uint64_t first =
        size.film + size.samples + (adaptive->method ? koksma_adaptive_size_of(options, adaptive) : 0) +
        (cli_text(arguments, "error-map", NULL) ? (uint64_t)options->width * (uint64_t)options->height * MAP_BYTES
                                                : 0);
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    const uint64_t machine = pages > 0 && page > 0 ? (uint64_t)pages * (uint64_t)page : UINT64_MAX;
    if (first > machine) {
        cli_say("render",
                "%d x %d pixels need %.1f GiB of memory, but this machine has %.1f; use a smaller --size%s%s",
                options->width, options->height, in_gib(first), in_gib(machine),
                layers && !adaptive->method ? ", or .pfm, which has no layers" : "",
                options->splat ? ", or no --splat" : "");
        return false;
    }
    if (first + size.file >= LARGE && !cli_flag(arguments, "quiet")) {
        cli_say("render", "%d x %d pixels take %.1f GiB of memory, and up to %.1f more while %s is written",
                options->width, options->height, in_gib(first), in_gib(size.file), cli_text(arguments, "output", ""));
    }
    return true;
}

/* Reads --replicates, and refuses what has no error map. Returns false after an error; *replicates is 0 without
   --error-map. */
static bool parse_error_map(const cli_arguments *arguments, uint64_t *replicates)
{
    const char *path = cli_text(arguments, "error-map", NULL);
    *replicates = 0;
    if (!path && cli_text(arguments, "replicates", NULL)) {
        cli_usage_error(arguments, "--replicates has an effect only with --error-map");
        return false;
    }
    if (path && !cli_refuse(arguments, "adaptive",
                            "excludes --error-map, which is for images with equal samples in all pixels")) {
        return false;
    }
    if (path && koksma_image_check_path(path)) {
        cli_fail(arguments, KOKSMA_ARGUMENT);
        return false;
    }
    return !path || cli_whole(arguments, "replicates", REPLICATES, 3, KOKSMA_MAX_REPLICATES, replicates);
}

/* Writes the map of --error-map; in files of 8 bits white is the largest error. */
static koksma_status write_map(const char *path, koksma_image *map, const char *metadata)
{
    const size_t values = (size_t)map->width * (size_t)map->height * (size_t)map->channels;
    float largest = 0;
    for (size_t v = 0; v < values; v++) {
        largest = map->pixels[v] > largest ? map->pixels[v] : largest;
    }
    for (size_t v = 0; v < values && cli_has_eight_bits(path) && largest > 0; v++) {
        map->pixels[v] /= largest;
    }
    return koksma_image_write(path, map, metadata);
}

/* Warns of a picture without anything in it, or with too much for 8 bits. */
static void warn_of_flat(const cli_arguments *arguments, const koksma_scene *scene, const koksma_image *image)
{
    const char *name = arguments->operands[0];
    const bool has_8_bits = cli_has_eight_bits(cli_text(arguments, "output", ""));
    const float least = has_8_bits ? 1.5e-4F : -INFINITY; /* up to it, sRGB has the byte 0 */
    const size_t channels = (size_t)image->channels, n = (size_t)image->width * (size_t)image->height * channels;
    size_t same = channels, black = 0, white = 0;
    while (black < n && image->pixels[black] <= least) {
        black++;
    }
    for (size_t i = 0; i < n; i++) {
        white += image->pixels[i] > 1;
    }
    while (same < n && image->pixels[same] == image->pixels[same - channels]) {
        same++;
    }
    if (black == n || koksma_render_is_black(scene, image)) {
        cli_say_black(arguments, name, image->width, image->height);
    } else if (same == n && n > channels) {
        cli_say("render", "%s: warning: all pixels are equal; is the camera inside a shape?", name);
    } else if (has_8_bits && 2 * white > n) {
        cli_say("render", "%s: warning: %.0f %% of the values are above 1 and cut off; .exr and .pfm keep them", name,
                100 * (double)white / (double)n);
    }
}

/* Renders the mean of several images and its map of errors. Returns the exit code. */
static int render_map(const cli_arguments *arguments, const koksma_scene *scene, const koksma_render_options *options,
                      const cli_adaptive *adaptive, size_t count)
{
    static char metadata[(KOKSMA_N_USES + 2) * KOKSMA_MAX_SPEC];
    koksma_replicates replicates;
    cli_work work;
    if (!cli_work_begin(arguments, "rendering", &work)) {
        return CLI_USAGE;
    }
    const double start = cli_seconds();
    koksma_status status = koksma_render_replicates(scene, options, count, &work.run, &replicates);
    const double seconds = cli_seconds() - start;
    cli_work_end();
    if (status) {
        return cli_fail(arguments, status);
    }
    describe(arguments, scene, options, &adaptive->options, metadata, sizeof metadata);
    const size_t used = strlen(metadata);
    snprintf(metadata + used, sizeof metadata - used, " replicates=%zu", count);
    status = koksma_image_write(cli_text(arguments, "output", ""), &replicates.image, metadata);
    status = status ? status : write_map(cli_text(arguments, "error-map", ""), &replicates.error, metadata);
    if (!cli_flag(arguments, "quiet")) {
        warn_of_flat(arguments, scene, &replicates.image);
    }
    const int code = status ? cli_fail(arguments, status)
                            : put_row(arguments, options, adaptive, &replicates, replicates.rays, seconds);
    koksma_replicates_fini(&replicates);
    return code;
}

static int render(const cli_arguments *arguments, const koksma_scene *scene, const koksma_render_options *options,
                  cli_adaptive *adaptive)
{
    koksma_layers layers;
    cli_work work;
    if (!cli_work_begin(arguments, "rendering", &work)) {
        return CLI_USAGE;
    }
    const double start = cli_seconds();
    koksma_status status = adaptive->options.method ? koksma_render_adaptive(scene, options, &adaptive->options,
                                                                             &work.run, &layers, &adaptive->report)
                           : koksma_image_has_layers(cli_text(arguments, "output", ""))
                               ? koksma_render_layers(scene, options, &work.run, &layers)
                               : koksma_render_only(scene, options, &work.run, &layers);
    const double seconds = cli_seconds() - start;
    cli_work_end();
    const bool done = !status || (status == KOKSMA_INTERRUPTED && layers.image.pixels);
    const koksma_status written =
        done ? write_image(arguments, scene, options, &adaptive->options, &layers) : KOKSMA_OK;
    if (!status && !cli_flag(arguments, "quiet")) {
        warn_of_flat(arguments, scene, &layers.image);
    }
    koksma_layers_fini(&layers);
    if (!status && !written) {
        status = cli_adaptive_strata(adaptive);
    }
    if (status == KOKSMA_INTERRUPTED && done && !written) {
        cli_say("render", "interrupted; %s has the pixels that were done", cli_text(arguments, "output", ""));
        return koksma_status_exit_code(status);
    }
    return status || written ? cli_fail(arguments, status ? status : written)
                             : put_row(arguments, options, adaptive, NULL, layers.rays, seconds);
}

/* Applies the options --sky and --environment to the scene. Returns false after an error and sets *code to the exit
   code. */
static bool set_sky(const cli_arguments *arguments, koksma_scene *scene, int *code)
{
    const char *image = cli_text(arguments, "environment", NULL);
    double radiance = 1;
    if (!image && !cli_text(arguments, "sky", NULL)) {
        return true;
    }
    *code = CLI_USAGE;
    if (!cli_real(arguments, "sky", 1, 0, 1e6, &radiance)) {
        return false;
    }
    const koksma_status status = koksma_scene_set_sky(scene, image, radiance);
    *code = status ? cli_fail(arguments, status) : CLI_USAGE;
    return !status;
}

/* Takes the number of samples of the scene's own sampler, where the command line has none. */
static void take_count(const cli_arguments *arguments, const koksma_scene *scene, koksma_render_options *options)
{
    const size_t own = koksma_scene_count(scene).spp;
    const bool typed = cli_text(arguments, "spp", NULL) || strchr(cli_text(arguments, "pattern", ""), '@');
    if (own && own <= KOKSMA_MAX_SPP && own != (size_t)options->spp && !typed) {
        options->spp = (int)own;
        if (!cli_flag(arguments, "quiet")) {
            cli_say("render", "%s: its sampler takes %zu samples a pixel, and so does this picture; -n N chooses",
                    arguments->operands[0], own);
        }
    }
}

static int run(const cli_arguments *arguments)
{
    koksma_scene *scene;
    koksma_render_options options;
    cli_adaptive adaptive;
    if (arguments->n_operands != 1) {
        return cli_one_scene(arguments);
    }
    if (!cli_text(arguments, "output", NULL)) {
        return cli_usage_error(arguments, "-o FILE, the image, is missing");
    }
    koksma_status status = koksma_image_check_path(cli_text(arguments, "output", ""));
    status = status ? status : koksma_scene_open(arguments->operands[0], &scene);
    if (status) {
        return cli_fail(arguments, status);
    }
    int code = CLI_USAGE;
    uint64_t replicates;
    koksma_render_options_init(&options, scene);
    if (set_sky(arguments, scene, &code) && cli_whole(arguments, "seed", 0, 0, UINT64_MAX, &options.seed) &&
        cli_size(arguments, &options.width, &options.height) && cli_sampling_options(arguments, &options) &&
        cli_use_patterns(arguments, cli_text(arguments, "pattern", ""), &options, &code) &&
        cli_adaptive_options(arguments, &adaptive, &code) && parse_error_map(arguments, &replicates) &&
        check_files(arguments, &adaptive)) {
        if (!cli_flag(arguments, "quiet")) {
            cli_scene_warnings(arguments, arguments->operands[0], scene, &options, 3);
            cli_warn_unused(arguments, arguments->operands[0], scene, &options);
        }
        take_count(arguments, scene, &options);
        code = try_files(arguments, &adaptive);
        code = code ? code
               : announce_size(arguments, scene, &options, &adaptive.options)
                   ? replicates ? render_map(arguments, scene, &options, &adaptive, (size_t)replicates)
                                : render(arguments, scene, &options, &adaptive)
                   : koksma_status_exit_code(KOKSMA_MEMORY);
    }
    koksma_scene_close(scene);
    return code;
}

static const cli_option options[] = {
    {'p', "pattern", "[USE[+USE]=]PATTERN...",
     "pattern (or SPEC@N) of all uses, of one use, or of a group; may be repeated (default: n-rooks)"},
    {'n', "spp", "N", "samples a pixel (default: those of the scene's sampler, or 16)"},
    {0, "size", "WxH", "pixels (default: the scene's)"},
    {'s', "seed", "S", "seed of the random numbers (default: 0)"},
    {0, "sky", "L",
     "light of this radiance from all directions; replaces the sky of the scene or the default lights of a mesh "
     "file"},
    {0, "environment", "FILE", "light from an environment map in latitude and longitude, multiplied by --sky"},
    {0, "error-map", "FILE",
     "write the standard error of each pixel, from independent images; -o then has their mean"},
    {0, "replicates", "R", "with --error-map: number of images, 3 to 100000 (default: 8)"},
    {'o', "output", "FILE", "the image file, {image-formats}; an .exr has all layers"},
    CLI_UNKNOWN_OPTION,
    CLI_SAMPLING_OPTIONS,
    CLI_ADAPTIVE_OPTIONS,
    CLI_ROW_OPTIONS,
    CLI_RUN_OPTIONS,
    {0},
};

const cli_command cli_command_render = {
    .name = "render",
    .summary = "render a scene",
    .synopsis = "SCENE [-p [USE[+USE]=]PATTERN]... [-n SPP] [--size WxH] [--integrator I] [--filter F] [-s S] "
                "[--adaptive METHOD [--budget SPP]] -o FILE",
    .details =
        "SCENE is a name from 'koksma list scenes', a JSON file (docs/scenes.md), a mesh file (.obj, .ply, "
        ".ply.gz, .off, .gltf, .glb, .serialized), or a scene of pbrt-v4 (.pbrt) or Mitsuba 3 (.xml).\n"
        "\n"
        "A use is a purpose for which a sample needs one or two dimensions, such as the position on the lens; see "
        "'koksma list uses'. Each use has its own point set in every pixel. --pairing combines them: 'shuffled' by "
        "random permutations, 'aligned' in the order of the pattern, 'native' as one set with all dimensions. Uses "
        "joined by '+' (pixel+time=scan-time) share the dimensions of one set. --scope image spreads one set of "
        "SPP x pixels points over the whole image.\n"
        "\n"
        "--adaptive takes SPP samples in every pixel, or first x SPP if METHOD has a parameter first, and then "
        "adds samples in rounds until METHOD stops or the budget is spent.\n"
        "\n"
        "--error-map renders R images of SPP samples with the seeds S, S + 1, ..., S + R - 1: -o is their mean, "
        "and FILE its standard error, in each pixel and channel the standard deviation of the images divided by "
        "sqrt R (a .png or .jpg is scaled so that the largest is white). mean: luminance of the picture, with its "
        "95 % interval by Student's t over the images. rmse: the root mean square error of the picture, from the "
        "spread of the images, likewise. The patterns must be random and unbiased, since no spread shows the error "
        "of others. An interrupted one writes nothing.\n"
        "\n"
        "A render that is interrupted (Ctrl-C) writes the pixels that are done, with 0 in the others, also over an "
        "older image, and ends with exit code 130.\n",
    .examples = "koksma render ball -p sobol:scramble=owen -n 16 -o ball.png\n"
                "koksma render balls -p random -p pixel+time=scan-time -n 16 -o balls.exr\n"
                "koksma render ball -p random -n 16 --error-map error.exr -o mean.exr\n"
                "koksma render cornell --integrator path --filter mitchell --splat -o c.exr\n"
                "koksma render glossy --adaptive hierarchical --counts counts.png -o glossy.exr\n",
    .options = options,
    .run = run,
};
