/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Chooses which samplers a sheet compares, and at which sizes. A text that names a file or contains {n} or {seed}
 * stands for files of points; any other text is the spec of a pattern. If the sheet's sampler is given by files, the
 * files determine the sizes: a family of files is measured at its sizes and seeds, a single file at its size, and all
 * other samplers at the same sizes.
 */
#include "study/sheet/sheet.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <koksma/render.h>

#include "core/elementary.h"
#include "core/files.h"
#include "core/status.h"
#include "patterns/files/files.h"

enum { MOST_POINTS = 4096, MOST_POINTS_QUICK = 1024, MOST_SPP = 256 };

static const char file_prefix[] = "file:";

static const char *const beside_by_default[] = {"random", "jittered", "sobol:scramble=owen"};

/* ---- Texts ------------------------------------------------------------------------------------------------- */

/* Whether a text names a file of points. The text of a pattern that has an operand is none, whatever its path is. */
static bool is_file(const char *text)
{
    char name[KOKSMA_MAX_SPEC];
    snprintf(name, sizeof name, "%.*s", (int)strcspn(text, ":"), text);
    const koksma_pattern *pattern = strchr(text, ':') ? koksma_pattern_find(name) : NULL;
    if (pattern && pattern->operand) {
        return false;
    }
    return koksma__file_is_family(text) || koksma__path_ends_in(text, ".npy") || koksma__path_ends_in(text, ".csv") ||
           koksma__path_ends_in(text, ".txt") ||
           (!koksma_pattern_find(text) && !strchr(text, ':') && !access(text, F_OK));
}

static koksma_status parse(const char *text, koksma__sheet_sampler *out)
{
    char spec[KOKSMA_MAX_SPEC + sizeof file_prefix];
    const bool file = is_file(text);
    snprintf(spec, sizeof spec, "%s%s", file ? file_prefix : "", text);
    KOKSMA__TRY(strlen(text) < KOKSMA_MAX_SPEC - sizeof file_prefix
                    ? koksma_pattern_spec(spec, &out->spec)
                    : koksma__fail(KOKSMA_ARGUMENT, "sampler '%.40s...': longer than %zu characters", text,
                                   KOKSMA_MAX_SPEC - sizeof file_prefix - 1));
    koksma_spec_text(&out->spec, out->text);
    out->same = koksma_has_one_set(&out->spec);
    out->sets = SIZE_MAX;
    return KOKSMA_OK;
}

/* ---- Files ------------------------------------------------------------------------------------------------- */

/* Counts the sets of n points with consecutive seeds from `seed` on. */
static size_t count_from(const koksma__file_set *sets, size_t count, size_t n, uint64_t seed)
{
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        found += sets[i].n == n && sets[i].seed == seed + found;
    }
    return found;
}

/* Keeps at most KOKSMA__SHEET_SIZES sizes, spread evenly on a logarithmic axis; the first and the last are always
   kept. */
static size_t thin(size_t *sizes, size_t n)
{
    size_t kept = 0;
    if (n <= KOKSMA__SHEET_SIZES) {
        return n;
    }
    const double first = koksma__log((double)sizes[0]),
                 step = (koksma__log((double)sizes[n - 1]) - first) / (KOKSMA__SHEET_SIZES - 1);
    for (size_t i = 0, k = 0; i < KOKSMA__SHEET_SIZES && k < n; i++) {
        while (k + 1 < n && fabs(koksma__log((double)sizes[k + 1]) - first - (double)i * step) <=
                                fabs(koksma__log((double)sizes[k]) - first - (double)i * step)) {
            k++;
        }
        sizes[kept++] = sizes[k++];
    }
    return kept;
}

/* Chooses the sizes (numbers of points) of a family of files. A size needs at least half as many sets as the size with the
   most sets. The smallest such size is always chosen, larger ones only if they have few enough points to be measured
   quickly; of these at most KOKSMA__SHEET_SIZES are kept. */
static koksma_status choose_sizes_of_family(koksma__sheet *sheet, koksma__sheet_sampler *sampler,
                                            const koksma__file_set *sets, size_t count)
{
    size_t *sizes = calloc(count + 1, sizeof *sizes), n = 0, most = 0;
    const size_t most_points = sheet->options->quick ? MOST_POINTS_QUICK : MOST_POINTS;
    KOKSMA__REQUIRE_MEMORY(sizes, count * sizeof *sizes);
    sampler->seed = sets[0].seed;
    for (size_t i = 0; i < count; i++) {
        sampler->seed = sets[i].seed < sampler->seed ? sets[i].seed : sampler->seed;
    }
    for (size_t i = 0; i < count; i++) {
        const size_t here = count_from(sets, count, sets[i].n, sampler->seed);
        most = here > most ? here : most;
    }
    sampler->sets = most;
    for (size_t i = 0; i < count; i++) {
        const size_t here = count_from(sets, count, sets[i].n, sampler->seed);
        if ((n && sizes[n - 1] == sets[i].n) || 2 * here < most || (n && sets[i].n > most_points)) {
            continue;
        }
        sizes[n++] = sets[i].n;
        sampler->sets = here < sampler->sets ? here : sampler->sets;
    }
    n = thin(sizes, n);
    sheet->n_sizes = n;
    memcpy(sheet->sizes, sizes, n * sizeof *sizes);
    free(sizes);
    return KOKSMA_OK;
}

/* Sets the seed of the first set of a sampler that the sheet's sampler is compared with. Lowers its number of sets
   so that it has that many sets of every size of the sheet, with consecutive seeds from the first seed on. */
static void count_sets(const koksma__sheet *sheet, koksma__sheet_sampler *sampler, const koksma__file_set *sets,
                       size_t count)
{
    sampler->seed = sets[0].seed;
    for (size_t i = 0; i < sheet->n_sizes; i++) {
        const size_t here = count_from(sets, count, sets[0].n ? sheet->sizes[i] : 0, sampler->seed);
        sampler->sets = here < sampler->sets ? here : sampler->sets;
    }
}

/* Reads a file whose name does not contain the size, and makes its size the only one of the sheet. */
static koksma_status size_of_file(koksma__sheet *sheet, koksma__sheet_sampler *sampler)
{
    koksma_points points = {0};
    const koksma_status status = koksma_generate_whole(&sampler->spec, sampler->seed, NULL, 0, &points);
    sheet->sizes[0] = points.n;
    sheet->n_sizes = 1;
    koksma_points_fini(&points);
    return status;
}

/* Finds seeds and numbers of sets of a sampler whose points are in files; for samplers[0] it also finds the sheet's
   sizes. */
static koksma_status look_at_files(koksma__sheet *sheet, koksma__sheet_sampler *sampler)
{
    koksma__file_set *sets = NULL;
    size_t count = 0;
    const char *path = sampler->spec.path;
    const bool first = sampler == sheet->all;
    koksma_status status = koksma__file_is_family(path) ? koksma__file_sets(path, &sets, &count) : KOKSMA_OK;
    if (!status && koksma__file_has(path, "{n}") && first) {
        status = choose_sizes_of_family(sheet, sampler, sets, count);
    } else if (!status && count) {
        sampler->seed = sets[0].seed;
        sampler->sets = count_from(sets, count, sets[0].n, sampler->seed);
        status = first ? size_of_file(sheet, sampler) : KOKSMA_OK;
        if (!first) {
            count_sets(sheet, sampler, sets, count);
        }
    } else if (!status && first) {
        status = size_of_file(sheet, sampler);
    }
    if (!koksma__file_has(path, "{seed}")) { /* the family has one set of each size, the same for every seed */
        sampler->seed = 0;
        sampler->sets = SIZE_MAX;
    }
    free(sets);
    return status;
}

/* Finds the highest dimension that samplers[0] supports. */
static koksma_status find_dimensions(koksma__sheet *sheet)
{
    const koksma__sheet_sampler *sampler = &sheet->all[0];
    sheet->max_dim = sampler->spec.pattern->max_dim;
    if (!koksma__reads_points(sampler->spec.pattern)) {
        return KOKSMA_OK;
    }
    char path[KOKSMA_MAX_SPEC];
    koksma_points points = {0};
    koksma_status status = koksma__file_name(sampler->spec.path, sheet->sizes[0], sampler->seed, path);
    status = status ? status : koksma_points_read(path, &points);
    sheet->max_dim = points.dim;
    koksma_points_fini(&points);
    return status;
}

/* ---- Choosing samplers and sizes ----------------------------------------------------------------------- */

koksma_status koksma__sheet_points(const koksma__sheet_sampler *sampler, size_t n, int dim, size_t trial,
                                   const koksma_run *run, koksma_points *out)
{
    KOKSMA__TRY(koksma_points_init(out, n, dim));
    const koksma_status status = koksma_generate(&sampler->spec, sampler->seed + trial, run, out);
    if (status) {
        koksma_points_fini(out);
    }
    return status;
}

size_t koksma__sheet_trials(const koksma__sheet_sampler *sampler, size_t wanted)
{
    return sampler->same ? 1 : sampler->sets < wanted ? sampler->sets : wanted;
}

size_t koksma__sheet_size(const koksma__sheet *sheet, size_t most)
{
    size_t found = sheet->sizes[0];
    for (size_t i = 0; i < sheet->n_sizes; i++) {
        found = sheet->sizes[i] <= most ? sheet->sizes[i] : found;
    }
    return found;
}

/* Checks that a sampler has a first set of every size. */
static koksma_status try_sizes(koksma__sheet *sheet, const koksma__sheet_sampler *sampler)
{
    const koksma_run run = koksma__sheet_one_set(sheet);
    for (size_t i = 0; i < sheet->n_sizes; i++) {
        koksma_points points = {0};
        KOKSMA__TRY(koksma__sheet_points(sampler, sheet->sizes[i], 2, 0, &run, &points));
        koksma_points_fini(&points);
    }
    return KOKSMA_OK;
}

/* Adds a sampler. If the first sampler, which the sheet describes, cannot make the points of some size, that is an
   error; any other sampler that cannot is left out with a note. Missing and malformed files are errors. */
static koksma_status add_sampler(koksma__sheet *sheet, const char *text, bool by_default)
{
    koksma__sheet_sampler *sampler = &sheet->all[sheet->n_samplers];
    const bool first = sheet->n_samplers == 0;
    *sampler = (koksma__sheet_sampler){0};
    KOKSMA__TRY(parse(text, sampler));
    for (size_t i = 0; i < sheet->n_samplers; i++) {
        if (!strcmp(sampler->text, sheet->all[i].text)) {
            return by_default ? KOKSMA_OK
                              : koksma__fail(KOKSMA_ARGUMENT, "sampler '%s' is given twice", sampler->text);
        }
    }
    koksma_status status = koksma__reads_points(sampler->spec.pattern) ? look_at_files(sheet, sampler) : KOKSMA_OK;
    status = status ? status : try_sizes(sheet, sampler);
    if (first && status == KOKSMA_DIM && koksma__reads_points(sampler->spec.pattern)) {
        char reason[1024]; /* a sheet takes no such file */
        snprintf(reason, sizeof reason, "%s", koksma_error_text());
        return koksma__fail(KOKSMA_MALFORMED, "%s", reason);
    }
    if (status && !first && status != KOKSMA_MISSING && status != KOKSMA_MALFORMED && status != KOKSMA_MEMORY &&
        status != KOKSMA_INTERRUPTED) {
        koksma__sheet_note_error(sheet, sampler->text);
        return KOKSMA_OK;
    }
    sheet->samplers[sheet->n_samplers++] = sampler;
    return status;
}

/* Chooses numbers of samples per pixel: those of 4, 16 and 64 that the sampler has; if none, up to three of the
   sizes, the smallest first. */
static void choose_spp(koksma__sheet *sheet)
{
    static const int usual[] = {4, 16, 64};
    const bool any = !koksma__reads_points(sheet->samplers[0]->spec.pattern);
    for (size_t k = sheet->options->quick; k < (sheet->options->quick ? 2 : 3); k++) {
        bool there = any;
        for (size_t i = 0; i < sheet->n_sizes; i++) {
            there |= sheet->sizes[i] == (size_t)usual[k];
        }
        if (there) {
            sheet->spp[sheet->n_spp++] = usual[k];
        }
    }
    const bool none = sheet->n_spp == 0; /* the sampler has no sets of 4, 16 or 64 points */
    for (size_t i = 0; i < sheet->n_sizes && none && sheet->n_spp < (sheet->options->quick ? 1 : KOKSMA__SHEET_SPP);
         i++) {
        if (sheet->sizes[i] <= MOST_SPP) {
            sheet->spp[sheet->n_spp++] = (int)sheet->sizes[i];
        }
    }
}

koksma_status koksma__sheet_choose(koksma__sheet *sheet)
{
    static const size_t usual[] = {16, 64, 256, 1024, 4096};
    static const char *const scenes[] = {"ball", "checker", "cornell"};
    const koksma_datasheet_options *o = sheet->options;
    sheet->n_sizes = o->quick ? 3 : sizeof usual / sizeof *usual;
    memcpy(sheet->sizes, usual, sheet->n_sizes * sizeof *usual);
    sheet->trials = o->quick ? 8 : 16;
    sheet->max_trials = o->quick ? 8 : 64;
    sheet->scenes = o->scenes ? o->scenes : scenes;
    sheet->n_scenes = o->scenes ? o->n_scenes : sizeof scenes / sizeof *scenes;
    koksma_status status = koksma_metric_parse(o->metric ? o->metric : "mae", &sheet->metric);
    koksma_metric_text(&sheet->metric, sheet->metric_text);
    status = status ? status : add_sampler(sheet, o->sampler, false);
    status = status ? status : find_dimensions(sheet);
    const size_t n = o->beside ? o->n_beside : sizeof beside_by_default / sizeof *beside_by_default;
    for (size_t i = 0; !status && i < n; i++) {
        status = add_sampler(sheet, o->beside ? o->beside[i] : beside_by_default[i], !o->beside);
    }
    /* the scenes are checked before the measures are computed, which takes minutes */
    for (size_t i = 0; !status && i < sheet->n_scenes; i++) {
        koksma_scene *scene = NULL;
        status = koksma_scene_open(sheet->scenes[i], &scene);
        koksma_scene_close(scene);
    }
    if (!status) {
        choose_spp(sheet);
    }
    return status;
}
