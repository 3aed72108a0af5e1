/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The report of `koksma study images`, in the format and on the page of a study's report (docs/report-format.md):
 * which group has the least error at each number of samples and how certain that is, how errors fall with the number
 * of samples, the first image of each group beside the reference, and the command.
 */
#include "study/images/images.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "image/formats.h"
#include "study/report/document.h"

/* The maximum number of bytes of floats on a page, before base64 encoding, and the maximum number of images shown. */
enum { MOST_BYTES = 24 << 20, MAX_SHOWN = 24 };

/* Writes a group as its texts alone, such as "sobol ball" for "sampler=sobol scene=ball", so that the chart
   recognises the pattern's name and uses its colour. */
static const char *label_of(const koksma_images_row *row, char label[KOKSMA_IMAGES_GROUP])
{
    char *to = label;
    for (const char *at = row->group; *at;) {
        const char *end = at + strcspn(at, " "), *value = memchr(at, '=', (size_t)(end - at));
        value = value ? value + 1 : at;
        to += snprintf(to, (size_t)(label + KOKSMA_IMAGES_GROUP - to), "%s%.*s", to > label ? " " : "",
                       (int)(end - value), value);
        at = end + (*end == ' ');
    }
    if (to == label) {
        snprintf(label, KOKSMA_IMAGES_GROUP, "all images");
    }
    return label;
}

static bool same_group(const koksma_images_row *a, const koksma_images_row *b)
{
    return !strcmp(a->group, b->group);
}

/* Whether row i is the first with its number of samples. */
static bool begins_spp(const koksma__images *all, size_t i)
{
    size_t k = 0;
    while (all->rows[k].spp != all->rows[i].spp) {
        k++;
    }
    return k == i;
}

/* ---- Which group has the least error ----------------------------------------------------------------------- */

static void say_spp(koksma__document *d, long long spp)
{
    if (spp) {
        koksma__doc_say(d, "With %lld samples a pixel ", spp);
    }
}

/* Writes which group has the least error at this number of samples, and how many others are worse with 95 %
   confidence. */
static void put_answer(koksma__document *d, const koksma__images *all, long long spp)
{
    const koksma_images_row *first = NULL;
    size_t n = 0, more = 0;
    char label[KOKSMA_IMAGES_GROUP];
    for (size_t i = 0; i < all->n; i++) {
        if (all->rows[i].spp == spp) {
            n++;
            more += all->rows[i].behind_low > 0;
            first = !first || all->rows[i].position < first->position ? &all->rows[i] : first;
        }
    }
    koksma__doc_answer_begin(d, n > 1 && more == n - 1);
    say_spp(d, spp);
    koksma__doc_say(d, "`%s` has the error %.4g", label_of(first, label), first->mean);
    if (first->low < first->high) {
        koksma__doc_say(d, " (%.4g to %.4g)", first->low, first->high);
    }
    if (n == 1) {
        koksma__doc_say(d, "; there is no other group.");
    } else if (more == n - 1) {
        koksma__doc_say(d, more > 1 ? ", less than all %zu others." : ", less than the other.", more);
    } else {
        koksma__doc_say(
            d,
            ", the least of %zu groups; %zu have a larger error with 95 %% confidence, and for %zu it is undecided.",
            n, more, n - 1 - more);
    }
    koksma__doc_paragraph_end(d);
}

static void put_table(koksma__document *d, const koksma__images *all, long long spp)
{
    koksma__doc_sorted_table_begin(d, "error", false, false, spp ? "errors-%lld" : "errors", spp);
    koksma__doc_columns(d, "t images;n9 trials;i4 error;i3 behind the first#behind, %%;n4 rmse#RMSE;n3h largest "
                           "error;t coherent#bands;n9h position;n3h coherence");
    for (size_t i = 0; i < all->n; i++) {
        const koksma_images_row *row = &all->rows[i];
        if (row->spp == spp) {
            koksma__doc_row(d);
            koksma__doc_cells(d, "tniinntnn", row->group[0] ? row->group : "all images", (double)row->trials,
                              (koksma__estimate){row->mean, row->low, row->high},
                              row->position == 1 ? (koksma__estimate){0, 0, 0}
                                                 : (koksma__estimate){100 * row->behind, 100 * row->behind_low,
                                                                      100 * row->behind_high},
                              row->rmse, row->max,
                              !row->coherence.images    ? "–"
                              : row->coherence.coherent ? "yes"
                                                        : "no",
                              (double)row->position, row->coherence.coherence);
        }
    }
    koksma__doc_table_end(d);
}

/* Writes the name of the metric in words. */
static void metric_of(const koksma__images *all, char text[KOKSMA_MAX_SPEC])
{
    snprintf(text, KOKSMA_MAX_SPEC, "the mean absolute difference of luminance");
    if (all->metric) {
        koksma_metric_text(all->metric, text);
    }
}

static void put_errors(koksma__document *d, const koksma__images *all)
{
    char metric[KOKSMA_MAX_SPEC];
    metric_of(all, metric);
    koksma__doc_section(d, "errors", "Which images are nearest to the reference?");
    koksma__doc_paragraph(
        d,
        "Error: %s to the reference, averaged over the trials. Behind: the relative difference of a group's error to "
        "the error of the first group. Its interval comes from the differences of images with equal {trial}, and is "
        "known only if both groups have the same trials. Each interval alone holds with 95 %% confidence: they "
        "are " KOKSMA__MEAN_INTERVALS
        ". Bands: the error has a pattern, which eyes notice more than noise (`koksma compare --help`).",
        metric);
    for (size_t i = 0; i < all->n; i++) {
        if (begins_spp(all, i)) {
            put_answer(d, all, all->rows[i].spp);
            put_table(d, all, all->rows[i].spp);
        }
    }
    koksma__doc_end(d);
}

/* ---- How errors fall --------------------------------------------------------------------------------------- */

static void put_chart(koksma__document *d, const koksma__images *all)
{
    char label[KOKSMA_IMAGES_GROUP], metric[KOKSMA_MAX_SPEC] = "mean absolute error";
    if (all->metric) {
        koksma_metric_text(all->metric, metric);
    }
    koksma__doc_chart_begin(
        d, &(koksma__chart){"Error against samples a pixel", "samples a pixel", metric, true, true, -1, NULL});
    for (size_t i = 0; i < all->n; i++) {
        const koksma_images_row *row = &all->rows[i];
        if (i == 0 || !same_group(row, row - 1)) {
            koksma__doc_series_begin(d, label_of(row, label), NULL, KOKSMA__SERIES_LINE);
        }
        koksma__doc_point(d, (double)row->spp, row->mean, row->low, row->high);
        if (i + 1 == all->n || !same_group(row, row + 1)) {
            koksma__doc_end(d);
        }
    }
    koksma__doc_end(d);
}

static void put_slopes(koksma__document *d, const koksma__images *all)
{
    bool any = false;
    for (size_t i = 0; i < all->n; i++) {
        any |= !isnan(all->rows[i].slope);
    }
    if (!any) {
        return;
    }
    koksma__doc_section(d, "slopes", "How does the error fall with the samples?");
    koksma__doc_paragraph(d,
                          "Slope of the logarithm of the error over that of the number of samples, with its 95 %% "
                          "interval; independent random samples have -0.5. Simulated intervals hold in 94 to 98 %%.");
    put_chart(d, all);
    koksma__doc_sorted_table_begin(d, "slope", false, false, "slopes");
    koksma__doc_columns(d, "t images;i3 slope");
    for (size_t i = 0; i < all->n; i++) {
        const koksma_images_row *row = &all->rows[i];
        if (i == 0 || !same_group(row, row - 1)) {
            koksma__doc_row(d);
            koksma__doc_cells(d, "ti", row->group[0] ? row->group : "all images",
                              (koksma__estimate){row->slope, row->slope_low, row->slope_high});
        }
    }
    koksma__doc_table_end(d);
    koksma__doc_end(d);
}

/* ---- Pictures ---------------------------------------------------------------------------------------------- */

static koksma_status put_picture(koksma__document *d, const char *path, const char *name)
{
    koksma_image image;
    KOKSMA__TRY(koksma__image_read(path, KOKSMA__FILE_IMAGE, KOKSMA__BY_FILE, &image));
    koksma__doc_picture(d, &image, name);
    koksma_image_fini(&image);
    return KOKSMA_OK;
}

/* Shows the first image of each group at the largest number of samples, beside the reference. */
static koksma_status put_pictures(koksma__document *d, const koksma__images *all)
{
    const koksma_image *r = all->reference;
    const size_t bytes = 4 * (size_t)r->width * (size_t)r->height * (size_t)r->channels;
    size_t n = 0;
    long long spp = 0;
    for (size_t i = 0; i < all->n; i++) {
        n = all->rows[i].spp > spp ? 0 : n;
        spp = all->rows[i].spp > spp ? all->rows[i].spp : spp;
        n += all->rows[i].spp == spp;
    }
    koksma__doc_section(d, "pictures", "Pictures");
    size_t shown = MOST_BYTES / (bytes + 1);
    shown = shown > MAX_SHOWN ? MAX_SHOWN : shown ? shown - 1 : 0; /* one of the shown images is the reference */
    koksma_status status = KOKSMA_OK;
    if (shown < n) {
        koksma__doc_paragraph(d, "%zu of %zu groups are shown: a page has at most %d, and %d MiB of images.", shown,
                              n, MAX_SHOWN, MOST_BYTES >> 20);
    }
    if (shown) {
        koksma__doc_pictures_begin(d, all->reference_path, r->width, r->height);
        koksma__doc_picture(d, r, "reference");
        for (size_t i = 0; i < all->n && shown && !status; i++) {
            char label[KOKSMA_IMAGES_GROUP];
            if (all->rows[i].spp == spp) {
                status = put_picture(d, all->first[i], label_of(&all->rows[i], label));
                shown--;
            }
        }
        koksma__doc_end(d);
    }
    koksma__doc_end(d);
    return status;
}

/* ---- The report -------------------------------------------------------------------------------------------- */

static void put_origin(koksma__document *d, const koksma__images *all)
{
    const size_t size = strlen(all->places) + strlen(all->reference_path) + 64;
    char *line = malloc(size);
    koksma__doc_section(d, "origin", "How this was made");
    koksma__doc_paragraph(d, "koksma %s compared %zu rows of images, found by their names, with `%s`.",
                          koksma_version(), all->n, all->reference_path);
    if (line) {
        snprintf(line, size, "koksma study images '%s' --reference '%s'", all->places, all->reference_path);
        koksma__doc_commands(d, (const char *const[]){line}, 1);
    } else if (!d->json.status) {
        d->json.status = koksma__fail_memory(size);
    }
    free(line);
    koksma__doc_end(d);
}

koksma_status koksma__images_report(const koksma__images *images, const char *folder)
{
    koksma__document d = {.json.in_html = true};
    koksma__json_begin_object(&d.json, NULL);
    koksma__json_write_text(&d.json, "format", "koksma-images");
    koksma__json_write_whole(&d.json, "version", 1);
    koksma__json_begin_text(&d.json, "title");
    koksma__json_add_text(&d.json, images->places);
    koksma__json_add_text(&d.json, " against ");
    koksma__json_add_text(&d.json, images->reference_path);
    koksma__json_end_text(&d.json);
    koksma__json_write_text(&d.json, "about", "");
    koksma__json_write_text(&d.json, "koksma", koksma_version());
    koksma__json_begin_array(&d.json, "content");
    put_errors(&d, images);
    put_slopes(&d, images);
    koksma_status status = put_pictures(&d, images);
    put_origin(&d, images);
    koksma__json_end(&d.json);
    koksma__json_end(&d.json);
    status = status ? status : d.json.status;
    status = status ? status : koksma__page_write(folder, KOKSMA__PAGE_IMAGES, d.json.text);
    koksma__json_writer_fini(&d.json);
    return status;
}
