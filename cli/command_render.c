/* SPDX-License-Identifier: Apache-2.0 */
/*
 * `koksma render`: renders a scene into an image file and prints one row with the options, the number of rays and the
 * time. Before it starts it computes how much memory the image takes, and refuses an image that takes more than the
 * machine has. When it is interrupted it writes the image with the pixels that are done.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <koksma/adaptive.h>

#include "cli.h"
#include "rendering.h"
#include "source.h"

/* MAP_BYTES: what a pixel of an error map takes: sums of two doubles and two floats for each of 3 channels. */
enum { REPLICATES = 8, MAP_BYTES = 3 * (2 * sizeof(double) + 2 * sizeof(float)) };

/* Reads how samples are drawn. */
static bool sampling_options(const cli_args *args, koksma_render_options *options)
{
    int pairing = options->pairing, scope = options->scope, lights = options->lights;
    uint64_t depth = 0;
    if (!cli_choice(args, "pairing", &pairing) || !cli_choice(args, "scope", &scope) ||
        !cli_choice(args, "lights", &lights) || !cli_whole(args, "depth", 0, 0, KOKSMA_MAX_DEPTH, &depth)) {
        return false;
    }
    options->pairing = (koksma_pairing)pairing;
    options->scope = (koksma_scope)scope;
    options->lights = (koksma_light_selection)lights;
    options->depth = cli_flag(args, "depth") ? (int)depth : -1;
    options->splat = cli_flag(args, "splat");
    return cli_integrator_and_filter(args, &options->integrator, &options->filter);
}

/* Reads --spp and the patterns. lines: one text per line in the form that koksma_render_patterns accepts, or with @SPP
   at the end. */
static int use_patterns(const cli_args *args, const char *lines, koksma_render_options *options)
{
    const char *const all = lines;
    uint64_t n = 0, spp;
    bool common = false; /* whether a line gave the pattern of all uses that have none of their own */
    while (*lines) {
        static char line[KOKSMA_MAX_PATTERNS_TEXT];
        const size_t length = strcspn(lines, "\n");
        if (length >= sizeof line) {
            return cli_error(args, "--pattern %.20s...: longer than %zu characters", lines, sizeof line - 1);
        }
        memcpy(line, lines, length);
        line[length] = '\0';
        lines += lines[length] ? length + 1 : length;
        if (!cli_take_counts(args, line, &n)) {
            return CLI_USAGE;
        }
        const koksma_spec before = options->pattern;
        options->pattern = (koksma_spec){0}; /* a line that names no uses sets it */
        const koksma_status status = koksma_render_patterns(line, options);
        if (status) {
            return cli_fail(args, status);
        }
        if (options->pattern.pattern && common) {
            return cli_error(
                args,
                "-p %s: another -p has the pattern of all uses; name the uses of this one, as in -p lens=PATTERN",
                line);
        }
        common = common || options->pattern.pattern;
        options->pattern = options->pattern.pattern ? options->pattern : before;
    }
    if (!cli_whole(args, "spp", n ? n : 16, 1, KOKSMA_MAX_SPP, &spp)) {
        return CLI_USAGE;
    }
    if (n && n != spp) {
        return cli_error(args, "-p has @%llu, but -n is %llu", (unsigned long long)n, (unsigned long long)spp);
    }
    options->spp = (int)spp;
    const bool of_pixel = options->scope == KOKSMA_SCOPE_PIXEL;
    for (const char *at = all; *at; at += strcspn(at, "\n"), at += *at == '\n') {
        cli_warn_file(args, at, of_pixel ? spp : 0);
    }
    bool said = !of_pixel || cli_warn_unbalanced(args, &options->pattern, spp);
    for (size_t i = 0; koksma_use_at(i) && !said; i++) {
        said = cli_warn_unbalanced(args, &options->patterns[i], spp);
    }
    return CLI_YES;
}

/* Warns about each use that was given a pattern although rendering this scene needs no samples for it. */
static void warn_unused(const cli_args *args, const char *name, const koksma_scene *scene,
                        const koksma_render_options *options)
{
    for (size_t i = 0; koksma_use_at(i); i++) {
        if (options->patterns[i].pattern && !koksma_use_is_spent(scene, options, i)) {
            cli_say(args->command->name,
                    "%s: warning: this scene needs no samples for %s; the pattern for it has no effect", name,
                    koksma_use_at(i)->name);
        }
    }
    for (size_t g = 0; g < KOKSMA_MAX_USE_GROUPS; g++) {
        const koksma_use_group *group = &options->groups[g];
        char text[KOKSMA_MAX_SPEC];
        koksma_use_group_text(group, text);
        for (int i = 0; i < group->n_uses; i++) {
            if (!koksma_use_is_spent(scene, options, (size_t)group->uses[i])) {
                cli_say(args->command->name,
                        "%s: warning: this scene needs no samples for %s; its coordinates in %s have no effect", name,
                        koksma_use_at((size_t)group->uses[i])->name, text);
            }
        }
    }
}

/* Options and results of adaptive sampling. Without --adaptive, options.method is NULL and every pixel has the same
   number of samples. */
typedef struct adaptive_state {
    koksma_adaptive_options options;
    koksma_adaptive_report report;
    koksma_strata strata;
    const char *strata_path; /* NULL without --strata */
} adaptive_state;

/* ---- Adaptive sampling: its options, the columns of its statistics, and the files of --counts and --strata -------- */

/* Reads the options of adaptive sampling. */
static int adaptive_options(const cli_args *args, adaptive_state *adaptive)
{
    const char *text = cli_text(args, "adaptive", NULL), *counts = cli_text(args, "counts", NULL),
               *strata = cli_text(args, "strata", NULL);
    uint64_t probes;
    int used = 0;
    *adaptive = (adaptive_state){.options = {.method = NULL}};
    koksma_plot_format format;
    koksma_status status = counts ? koksma_image_check_path(counts) : KOKSMA_OK;
    status = status || !text ? status : koksma_adaptive_parse(text, &adaptive->options);
    status = status || !strata ? status : koksma_plot_format_of(strata, &format);
    if (status) {
        return cli_fail(args, status);
    }
    const koksma_adaptive *method = adaptive->options.method;
    if ((!text && !cli_refuse(args, "budget probe strata", "needs --adaptive METHOD")) ||
        (text && method->own_samples &&
         !cli_refuse(args, "pattern pairing", "has no effect: the adaptive method %s places its own samples",
                     method->name))) {
        return CLI_USAGE;
    }
    if (strata && (sscanf(strata, "%6d,%6d:%n", &adaptive->strata.x, &adaptive->strata.y, &used) != 2 || !used ||
                   !strata[used])) {
        return cli_error(args, "--strata %s: it takes X,Y:FILE, such as 41,60:strata.svg", strata);
    }
    adaptive->strata_path = strata ? strata + used : NULL;
    adaptive->options.strata = strata ? &adaptive->strata : NULL;
    if (!cli_real(args, "budget", 0, 1, KOKSMA_MAX_SPP, &adaptive->options.budget) ||
        !cli_whole(args, "probe", 0, 0, KOKSMA_MAX_PROBES, &probes)) {
        return CLI_USAGE;
    }
    adaptive->options.probes = (int)probes;
    return CLI_YES;
}

/* Adds the columns of adaptive sampling to the current row; without --adaptive none. */
static void put_adaptive(const adaptive_state *adaptive, double pixels)
{
    char method[KOKSMA_MAX_SPEC];
    const koksma_adaptive_report *report = &adaptive->report;
    if (!adaptive->options.method) {
        return;
    }
    koksma_adaptive_text(&adaptive->options, method);
    cli_row("adaptive %s mean_spp %g extra %g", method, (double)report->samples / pixels,
            (double)(report->samples - report->first) / pixels);
    if (report->splits) {
        cli_row("splits %llu", (unsigned long long)report->splits);
    }
    if (report->splits && adaptive->options.probes) {
        cli_row("needless %g", (double)report->needless / (double)report->splits);
    }
}

/* Writes an image; for a .png or .jpg file it first divides the numbers by the largest, which is white. */
static koksma_status write_scaled(const char *path, koksma_image *image, const char *metadata)
{
    const size_t values = (size_t)image->width * (size_t)image->height * (size_t)image->channels;
    float largest = 0;
    for (size_t v = 0; v < values; v++) {
        largest = image->pixels[v] > largest ? image->pixels[v] : largest;
    }
    for (size_t v = 0; v < values && cli_has_eight_bits(path) && largest > 0; v++) {
        image->pixels[v] /= largest;
    }
    return koksma_image_write(path, image, metadata);
}

/* Writes the drawing of --strata if that option is given, and then frees the strata. */
static koksma_status write_strata(adaptive_state *adaptive)
{
    koksma_plot_format format;
    unsigned char *bytes = NULL;
    size_t size;
    char caption[96];
    const koksma_strata *strata = &adaptive->strata;
    if (!adaptive->strata_path) {
        return KOKSMA_OK;
    }
    koksma_strata_panel panels[KOKSMA_MAX_SPACES];
    for (size_t i = 0; i < strata->n_spaces; i++) {
        const koksma_space *space = &strata->spaces[i];
        panels[i] = (koksma_strata_panel){.strata = space->strata,
                                          .n = space->n,
                                          .splits = space->splits,
                                          .n_splits = space->n_splits,
                                          .caption = space->name};
    }
    snprintf(caption, sizeof caption, "pixel %d,%d: %zu strata, samples for %s", strata->x, strata->y,
             strata->spaces[0].n, strata->spaces[0].name);
    panels[0].caption = caption;
    koksma_status status = koksma_plot_format_of(adaptive->strata_path, &format);
    status = status ? status : koksma_plot_strata(panels, strata->n_spaces, 0, format, &bytes, &size);
    status = status ? status : koksma_plot_write(adaptive->strata_path, bytes, size);
    free(bytes);
    koksma_strata_fini(&adaptive->strata);
    return status;
}

/* replicates: NULL without --error-map. */
static int put_row(const cli_args *args, const koksma_render_options *options, const adaptive_state *adaptive,
                   const koksma_replicates *replicates, uint64_t rays, double seconds)
{
    const koksma_adaptive *method = adaptive->options.method;
    static char pattern[KOKSMA_MAX_PATTERNS_TEXT];
    koksma_render_patterns_text(options, pattern);
    cli_row("scene %s pattern %s spp %d width %d height %d", args->operands[0],
            method && method->own_samples ? "-" : pattern, options->spp, options->width, options->height);
    put_adaptive(adaptive, (double)options->width * options->height);
    if (replicates) {
        cli_row("replicates %zu mean %g mean_low %g mean_high %g rmse %g rmse_low %g rmse_high %g",
                replicates->replicates, replicates->mean, replicates->mean_low, replicates->mean_high,
                replicates->rmse, replicates->rmse_low, replicates->rmse_high);
    }
    cli_row("rays %llu seconds %g\n", (unsigned long long)rays, seconds);
    return cli_rows_close(CLI_YES);
}

/* Writes the metadata of the image file into `text`: version, scene, patterns and options. */
static void describe(const cli_args *args, const koksma_scene *scene, const koksma_render_options *o,
                     const koksma_adaptive_options *adaptive, char *text, size_t size)
{
    char pattern[KOKSMA_MAX_SPEC], uses[KOKSMA_MAX_SPEC];
    koksma_spec_text(&o->pattern, pattern);
    snprintf(text, size, "koksma %s scene=%s hash=%016llx pattern=%s", koksma_version(), args->operands[0],
             (unsigned long long)koksma_scene_hash(scene), pattern);
    for (size_t i = 0; koksma_use_at(i); i++) {
        if (o->patterns[i].pattern) {
            koksma_spec_text(&o->patterns[i], pattern);
            CLI_APPEND(text, size, " %s=%s", koksma_use_at(i)->name, pattern);
        }
    }
    for (size_t g = 0; g < KOKSMA_MAX_USE_GROUPS; g++) {
        if (o->groups[g].n_uses) {
            koksma_use_group_text(&o->groups[g], uses);
            koksma_spec_text(&o->groups[g].pattern, pattern);
            CLI_APPEND(text, size, " %s=%s", uses, pattern);
        }
    }
    CLI_APPEND(text, size, " spp=%d pairing=%s scope=%s lights=%s integrator=%s depth=%d filter=%s%s seed=%llu",
               o->spp, koksma_pairing_name(o->pairing), koksma_scope_name(o->scope),
               koksma_light_selection_name(o->lights), o->integrator->name, koksma_render_depth(scene, o),
               o->filter->name, o->splat ? " splat" : "", (unsigned long long)o->seed);
    if (adaptive->method) {
        koksma_adaptive_text(adaptive, pattern);
        CLI_APPEND(text, size, " adaptive=%s budget=%g", pattern, adaptive->budget);
    }
}

/* Refuses options that would write one file, and files that can't be written, before the work. Returns the exit code. */
static int check_files(const cli_args *args, const adaptive_state *adaptive)
{
    const struct {
        const char *option, *path;
    } all[] = {{"-o", cli_text(args, "output", NULL)},
               {"--counts", cli_text(args, "counts", NULL)},
               {"--strata", adaptive->strata_path},
               {"--error-map", cli_text(args, "error-map", NULL)}};
    const size_t n = sizeof all / sizeof *all;
    int code = CLI_YES;
    for (size_t i = 0; i < n; i++) {
        for (size_t k = 0; k < i && all[i].path; k++) {
            if (all[k].path && !strcmp(all[i].path, all[k].path) && !cli_is_stream(all[k].path)) {
                return cli_error(args, "%s and %s would both write %s", all[k].option, all[i].option, all[k].path);
            }
        }
    }
    for (size_t i = 0; i < n && !code; i++) {
        code = cli_try_output(args, all[i].path);
    }
    return code;
}

static koksma_status write_image(const cli_args *args, const koksma_scene *scene,
                                 const koksma_render_options *options, const koksma_adaptive_options *adaptive,
                                 koksma_layers *layers)
{
    static char metadata[(KOKSMA_N_USES + 2) * KOKSMA_MAX_SPEC];
    const koksma_layer own[] = {{"", &layers->image},          {"albedo", &layers->albedo},
                                {"normal", &layers->normal},   {"Z", &layers->depth},
                                {"samples", &layers->samples}, {"variance", &layers->variance}};
    const char *output = cli_text(args, "output", "");
    const size_t n = layers->albedo.pixels ? sizeof own / sizeof *own : 1;
    describe(args, scene, options, adaptive, metadata, sizeof metadata);
    const koksma_status status = koksma_image_write_layers(output, own, n, metadata);
    const char *counts = cli_text(args, "counts", NULL);
    return status || !counts ? status : write_scaled(counts, &layers->samples, "samples of each pixel");
}

/* Before rendering, a message announces the memory of images that need at least this number of bytes. */
#define LARGE (1ull << 30)

static double in_gib(uint64_t bytes)
{
    return (double)bytes / (1024.0 * 1024 * 1024);
}

/* Prints how much memory a large image takes. Returns false, after an error, if this is more than the machine has,
   because swapping would take longer than rendering. */
static bool announce_size(const cli_args *args, const koksma_scene *scene, const koksma_render_options *options,
                          const koksma_adaptive_options *adaptive)
{
    const bool layers = adaptive->method || koksma_image_has_layers(cli_text(args, "output", ""));
    const koksma_render_size size = koksma_render_size_of(scene, options, layers);
    const uint64_t first =
        size.film + size.samples + (adaptive->method ? koksma_adaptive_size_of(options, adaptive) : 0) +
        (cli_text(args, "error-map", NULL) ? (uint64_t)options->width * (uint64_t)options->height * MAP_BYTES : 0);
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
    if (first + size.file >= LARGE) {
        cli_note(args, "%d x %d pixels take %.1f GiB of memory, and up to %.1f more while %s is written",
                 options->width, options->height, in_gib(first), in_gib(size.file), cli_text(args, "output", ""));
    }
    return true;
}

/* Reads --replicates, and refuses what has no error map. Returns false after an error; *replicates is 0 without
   --error-map. */
static bool parse_error_map(const cli_args *args, uint64_t *replicates)
{
    const char *path = cli_text(args, "error-map", NULL);
    *replicates = 0;
    if (!path) {
        return cli_refuse(args, "replicates", "has an effect only with --error-map");
    }
    if (koksma_image_check_path(path)) {
        return !cli_fail(args, KOKSMA_ARGUMENT);
    }
    return cli_refuse(args, "adaptive",
                      "excludes --error-map, which is for images with equal samples in all pixels") &&
           cli_whole(args, "replicates", REPLICATES, 3, KOKSMA_MAX_REPLICATES, replicates);
}

/* Warns of a picture without anything in it, or with too much for 8 bits. */
static void warn_of_flat(const cli_args *args, const koksma_scene *scene, const koksma_image *image)
{
    const char *name = args->operands[0];
    const bool has_8_bits = cli_has_eight_bits(cli_text(args, "output", ""));
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
        cli_say_black(args, name, image->width, image->height);
    } else if (same == n && n > channels) {
        cli_say("render", "%s: warning: all pixels are equal; is the camera inside a shape?", name);
    } else if (has_8_bits && 2 * white > n) {
        cli_say("render", "%s: warning: %.0f %% of the values are above 1 and cut off; .exr and .pfm keep them", name,
                100 * (double)white / (double)n);
    }
}

/* Renders the mean of several images and its map of errors. Returns the exit code. */
static int render_map(const cli_args *args, const koksma_scene *scene, const koksma_render_options *options,
                      const adaptive_state *adaptive, size_t count)
{
    static char metadata[(KOKSMA_N_USES + 2) * KOKSMA_MAX_SPEC];
    koksma_replicates replicates;
    cli_work work;
    if (!cli_work_begin(args, "rendering", &work)) {
        return CLI_USAGE;
    }
    const double start = cli_seconds();
    koksma_status status = koksma_render_replicates(scene, options, count, &work.run, &replicates);
    const double seconds = cli_seconds() - start;
    cli_work_end();
    if (status) {
        return cli_fail(args, status);
    }
    describe(args, scene, options, &adaptive->options, metadata, sizeof metadata);
    CLI_APPEND(metadata, sizeof metadata, " replicates=%zu", count);
    status = koksma_image_write(cli_text(args, "output", ""), &replicates.image, metadata);
    status = status ? status : write_scaled(cli_text(args, "error-map", ""), &replicates.error, metadata);
    if (!cli_flag(args, "quiet")) {
        warn_of_flat(args, scene, &replicates.image);
    }
    const int code =
        status ? cli_fail(args, status) : put_row(args, options, adaptive, &replicates, replicates.rays, seconds);
    koksma_replicates_fini(&replicates);
    return code;
}

static int render(const cli_args *args, const koksma_scene *scene, const koksma_render_options *options,
                  adaptive_state *adaptive)
{
    koksma_layers layers;
    cli_work work;
    if (!cli_work_begin(args, "rendering", &work)) {
        return CLI_USAGE;
    }
    const double start = cli_seconds();
    koksma_status status = adaptive->options.method ? koksma_render_adaptive(scene, options, &adaptive->options,
                                                                             &work.run, &layers, &adaptive->report)
                           : koksma_image_has_layers(cli_text(args, "output", ""))
                               ? koksma_render_layers(scene, options, &work.run, &layers)
                               : koksma_render_only(scene, options, &work.run, &layers);
    const double seconds = cli_seconds() - start;
    cli_work_end();
    const bool done = !status || (status == KOKSMA_INTERRUPTED && layers.image.pixels);
    const koksma_status written = done ? write_image(args, scene, options, &adaptive->options, &layers) : KOKSMA_OK;
    if (!status && !cli_flag(args, "quiet")) {
        warn_of_flat(args, scene, &layers.image);
    }
    koksma_layers_fini(&layers);
    if (!status && !written) {
        status = write_strata(adaptive);
    }
    if (status == KOKSMA_INTERRUPTED && done && !written) {
        cli_say("render", "interrupted; %s has the pixels that were done", cli_text(args, "output", ""));
        return koksma_status_exit_code(status);
    }
    return status || written ? cli_fail(args, status ? status : written)
                             : put_row(args, options, adaptive, NULL, layers.rays, seconds);
}

/* Applies the options --sky and --environment to the scene. Returns the exit code. */
static int set_sky(const cli_args *args, koksma_scene *scene)
{
    const char *image = cli_text(args, "environment", NULL);
    double radiance;
    if (!image && !cli_text(args, "sky", NULL)) {
        return CLI_YES;
    }
    if (!cli_real(args, "sky", 1, 0, 1e6, &radiance)) {
        return CLI_USAGE;
    }
    const koksma_status status = koksma_scene_set_sky(scene, image, radiance);
    return status ? cli_fail(args, status) : CLI_YES;
}

/* Takes the number of samples of the scene's own sampler, where the command line has none. */
static void take_count(const cli_args *args, const koksma_scene *scene, koksma_render_options *options)
{
    const size_t own = koksma_scene_count(scene).spp;
    const bool typed = cli_text(args, "spp", NULL) || strchr(cli_text(args, "pattern", ""), '@');
    if (own && own <= KOKSMA_MAX_SPP && own != (size_t)options->spp && !typed) {
        options->spp = (int)own;
        cli_note(args, "%s: its sampler takes %zu samples a pixel, and so does this picture; -n N chooses",
                 args->operands[0], own);
    }
}

static int run(const cli_args *args)
{
    koksma_scene *scene;
    koksma_render_options options;
    adaptive_state adaptive;
    if (args->n_operands != 1) {
        return cli_one_scene(args);
    }
    if (!cli_text(args, "output", NULL)) {
        return cli_error(args, "-o FILE, the image, is missing");
    }
    koksma_status status = koksma_image_check_path(cli_text(args, "output", ""));
    status = status ? status : koksma_scene_open(args->operands[0], &scene);
    if (status) {
        return cli_fail(args, status);
    }
    uint64_t replicates;
    koksma_render_options_init(&options, scene);
    int code = set_sky(args, scene);
    code = code || (cli_whole(args, "seed", 0, 0, UINT64_MAX, &options.seed) &&
                    cli_size(args, &options.width, &options.height) && sampling_options(args, &options))
               ? code
               : CLI_USAGE;
    code = code ? code : use_patterns(args, cli_text(args, "pattern", ""), &options);
    code = code ? code : adaptive_options(args, &adaptive);
    code = code || parse_error_map(args, &replicates) ? code : CLI_USAGE;
    code = code ? code : check_files(args, &adaptive);
    if (!code) {
        if (!cli_flag(args, "quiet")) {
            cli_scene_warnings(args, args->operands[0], scene, &options, 3);
            warn_unused(args, args->operands[0], scene, &options);
        }
        take_count(args, scene, &options);
        code = !announce_size(args, scene, &options, &adaptive.options) ? koksma_status_exit_code(KOKSMA_MEMORY)
               : replicates ? render_map(args, scene, &options, &adaptive, (size_t)replicates)
                            : render(args, scene, &options, &adaptive);
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
    {0, "pairing", "shuffled|aligned|native", "how the point sets of a pixel are combined (default: shuffled)"},
    {0, "scope", "pixel|image", "what one point set covers (default: pixel)"},
    {0, "lights", "all|one|power|uniform|auto",
     "lights that get a shadow ray: all, or one chosen by its estimated contribution (one), by its power, or "
     "uniformly; auto: one with an integrator such as path and more than 8 lights, else all (default: auto)"},
    CLI_INTEGRATOR_OPTION,
    {0, "depth", "D", "the most bounces (default: the integrator's)"},
    CLI_FILTER_OPTION,
    {0, "splat", NULL,
     "add each sample to all pixels that the filter reaches, instead of sampling the filter; this has less "
     "error"},
    {0, "adaptive", "METHOD", "take more samples in pixels that need them; see 'koksma list adaptive'"},
    {0, "budget", "SPP", "with --adaptive: largest mean number of samples per pixel (default: no limit)"},
    {0, "strata", "X,Y:FILE", "with --adaptive: draw how pixel X,Y was split; .svg, .pdf or .png"},
    {0, "probe", "K", "with --adaptive: take K more samples to test whether each split was needed (default: 0)"},
    {0, "counts", "FILE",
     "write an image of the number of samples of each pixel; in .png and .jpg white is the largest"},
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
        ".ply.gz, .gltf, .glb, .serialized), or a scene of pbrt-v4 (.pbrt) or Mitsuba 3 (.xml).\n"
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
