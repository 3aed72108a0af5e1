/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Makes the tables of a study for images that another renderer made, identified by their file names. All images
 * are compared with the reference in parallel; the coherence of the errors, which takes 16 bytes per pixel, is
 * computed for one row of the table at a time.
 */
#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/series.h>

#include "core/files.h"
#include "core/parallel.h"
#include "core/status.h"
#include "image/formats.h"
#include "stats/stats.h"
#include "study/images/images.h"
#include "study/run/study.h"

/* One image file. */
typedef struct picture {
    const char *path;
    koksma__image_name name;
    /* aligned to 8 bytes even where a double needs less, so that an array of the struct can be read as doubles */
    _Alignas(8) koksma_image_error error;
    double robust, top_share;
} picture;
_Static_assert(sizeof(picture) % sizeof(double) == 0,
               "the stride between pictures must be a whole number of doubles");

typedef struct pictures {
    size_t n;
    picture *at;
    koksma_image reference;
    const koksma_metric_spec *metric; /* metric of the errors, or NULL for the mean absolute error */
} pictures;

static int compare_pictures(const void *a, const void *b)
{
    const picture *p = a, *q = b;
    const int group = strcmp(p->name.group, q->name.group);
    if (group || p->name.spp != q->name.spp) {
        return group ? group : p->name.spp < q->name.spp ? -1 : 1;
    }
    return p->name.trial != q->name.trial ? (p->name.trial < q->name.trial ? -1 : 1) : strcmp(p->path, q->path);
}

static koksma_status collect(const char *places, const char *pattern, const glob_t *found, pictures *out)
{
    out->at = calloc(found->gl_pathc + 1, sizeof *out->at);
    KOKSMA__REQUIRE_MEMORY(out->at, found->gl_pathc * sizeof *out->at);
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < found->gl_pathc; i++) {
        picture p = {.path = found->gl_pathv[i]};
        bool fits;
        status = koksma__image_name_read(places, p.path, &p.name, &fits);
        if (!status && fits) {
            out->at[out->n++] = p;
        }
    }
    KOKSMA__TRY(status);
    qsort(out->at, out->n, sizeof *out->at, compare_pictures);
    if (!found->gl_pathc) {
        return koksma__fail(KOKSMA_MISSING, "%s: no such images: no file matches '%s'%s", places, pattern,
                            strpbrk(places, "*?[") ? "; only names in braces, such as {pattern}, stand for other text"
                                                   : "");
    }
    return out->n
               ? KOKSMA_OK
               : koksma__fail(KOKSMA_MISSING,
                              "%s: no such images: none of %zu files that match '%s' has digits at {spp} and {trial}",
                              places, (size_t)found->gl_pathc, pattern);
}

/* ---- Errors -------------------------------------------------------------------------------------------- */

/* Replaces the mean absolute error in p->error by the error in the metric. */
static koksma_status apply_metric(const pictures *all, const koksma_image *image, picture *p)
{
    koksma_metric_spec mae = {.metric = NULL};
    koksma_metric_value value;
    KOKSMA__TRY(koksma_metric_parse("mae", &mae));
    KOKSMA__TRY(koksma_metric_evaluate(all->metric ? all->metric : &mae, image, &all->reference, &value));
    p->error.mean = all->metric ? value.value : p->error.mean;
    p->robust = value.robust;
    p->top_share = value.top_share;
    return KOKSMA_OK;
}

static koksma_status compare_one(void *context, size_t i)
{
    pictures *all = context;
    koksma_image image;
    KOKSMA__TRY(koksma__image_read(all->at[i].path, KOKSMA__FILE_IMAGE, KOKSMA__BY_FILE, &image));
    koksma_status status = koksma_image_compare(&image, &all->reference, &all->at[i].error);
    /* images with a NaN are refused, because one NaN would make the mean of a whole group NaN */
    status = status ? koksma__fail_in(status, all->at[i].path) : koksma_image_check_finite(&image, all->at[i].path);
    status = status ? status : apply_metric(all, &image, &all->at[i]);
    koksma_image_fini(&image);
    return status;
}

/* Fits the slope of a group and stores it in all its rows. */
static koksma_status add_slope(koksma_images_row *rows, size_t n)
{
    koksma__summary *means = calloc(n, sizeof *means);
    double *spp = calloc(n, sizeof *spp);
    size_t used = 0;
    for (size_t i = 0; means && spp && i < n; i++) {
        if (rows[i].spp > 0 && rows[i].mean > 0) {
            const double t = rows[i].trials > 1 ? koksma_student_975(rows[i].trials - 1) : (double)NAN;
            spp[used] = (double)rows[i].spp;
            means[used++] = (koksma__summary){.n = rows[i].trials,
                                              .mean = rows[i].mean,
                                              .sd = (rows[i].high - rows[i].mean) / t * sqrt((double)rows[i].trials)};
        }
    }
    const bool made = means && spp;
    const koksma__estimate slope = koksma__trend_of(spp, means, used).slope;
    for (size_t i = 0; made && i < n; i++) {
        rows[i].slope = slope.value;
        rows[i].slope_low = slope.low;
        rows[i].slope_high = slope.high;
    }
    free(means);
    free(spp);
    return made ? KOKSMA_OK : koksma__fail_memory(n * (sizeof *means + sizeof *spp));
}

static void fill_row(const picture *first, size_t n, koksma_images_row *row)
{
    const size_t stride = sizeof *first / sizeof(double);
    const koksma__summary mean = koksma__summarize_sizes(&first->error.mean, n, stride);
    snprintf(row->group, sizeof row->group, "%s", first->name.group);
    row->spp = first->name.spp;
    row->trials = n;
    row->mean = mean.mean;
    row->low = mean.low;
    row->high = mean.high;
    row->sd = koksma__summarize_sizes(&first->error.sd, n, stride).mean;
    row->max = koksma__summarize_sizes(&first->error.max, n, stride).mean;
    row->rmse = koksma__summarize_sizes(&first->error.rmse, n, stride).mean;
    row->robust = koksma__summarize_sizes(&first->robust, n, stride).mean;
    row->top_share = koksma__summarize_sizes(&first->top_share, n, stride).mean;
}

static koksma_status make_rows(const pictures *all, koksma_images_row **rows, size_t *n)
{
    *rows = calloc(all->n, sizeof **rows);
    KOKSMA__REQUIRE_MEMORY(*rows, all->n * sizeof **rows);
    for (size_t i = 0, end; i < all->n; i = end) {
        for (end = i + 1; end < all->n && !strcmp(all->at[end].name.group, all->at[i].name.group) &&
                          all->at[end].name.spp == all->at[i].name.spp;) {
            end++;
        }
        fill_row(&all->at[i], end - i, &(*rows)[(*n)++]);
    }
    for (size_t i = 0, end; i < *n; i = end) {
        for (end = i + 1; end < *n && !strcmp((*rows)[end].group, (*rows)[i].group);) {
            end++;
        }
        KOKSMA__TRY(add_slope(*rows + i, end - i));
    }
    return KOKSMA_OK;
}

/* Computes the interval of the relative difference between a row's error and that of the best row of equal spp;
   pairs images by trial, and leaves the interval unknown unless both rows have the same trials. */
static koksma_status add_behind(const picture *first, size_t n_first, const picture *images, koksma_images_row *row)
{
    bool paired = n_first == row->trials;
    double *values = calloc(2 * row->trials, sizeof *values);
    if (!values) {
        return koksma__fail_memory(2 * row->trials * sizeof *values);
    }
    for (size_t i = 0; paired && i < row->trials; i++) {
        paired = images[i].name.trial == first[i].name.trial;
        values[i] = images[i].error.mean;
        values[row->trials + i] = first[i].error.mean;
    }
    if (paired) {
        const koksma__estimate e = koksma__relative_change(values, values + row->trials, row->trials);
        row->behind_low = e.low;
        row->behind_high = e.high;
    }
    free(values);
    return KOKSMA_OK;
}

/* Ranks the rows of equal spp: computes each row's position, and by how much its error exceeds the smallest. The
   images in `all` are in the order of the rows. */
static koksma_status add_positions(const pictures *all, koksma_images_row *rows, size_t n)
{
    const picture *images = all->at;
    for (size_t i = 0; i < n; images += rows[i++].trials) {
        size_t best = i;
        rows[i].position = 1;
        for (size_t k = 0; k < n; k++) {
            rows[i].position += rows[k].spp == rows[i].spp && rows[k].mean < rows[i].mean;
            best = rows[k].spp == rows[i].spp && rows[k].mean < rows[best].mean ? k : best;
        }
        const picture *first = all->at;
        for (size_t k = 0; k < best; k++) {
            first += rows[k].trials;
        }
        rows[i].behind = rows[best].mean > 0 ? rows[i].mean / rows[best].mean - 1 : 0;
        rows[i].behind_low = rows[i].behind_high = NAN;
        KOKSMA__TRY(best == i ? KOKSMA_OK : add_behind(first, rows[best].trials, images, &rows[i]));
    }
    return KOKSMA_OK;
}

/* Computes the coherence of each row. The images in `all` are in the order of the rows. */
static koksma_status add_coherence(const pictures *all, const koksma_run *run, koksma_images_row *rows, size_t n)
{
    koksma_status status = KOKSMA_OK;
    const picture *p = all->at;
    for (size_t i = 0; !status && i < n; i++) {
        koksma_coherence coherence;
        status = koksma_coherence_init(&coherence, all->reference.width, all->reference.height);
        for (size_t k = 0; !status && k < rows[i].trials; k++, p++) {
            koksma_image image = {0};
            status = koksma__keep_going(run, 1)
                         ? koksma__image_read(p->path, KOKSMA__FILE_IMAGE, KOKSMA__BY_FILE, &image)
                         : koksma__fail_interrupted();
            if (!status) {
                status = koksma_coherence_add(&coherence, &image, &all->reference);
                koksma_image_fini(&image);
            }
        }
        koksma_coherence_find(&coherence, &rows[i].coherence);
        koksma_coherence_fini(&coherence);
    }
    return status;
}

koksma_status koksma_study_images(const char *places, const char *reference, const koksma_metric_spec *metric,
                                  const koksma_run *run, koksma_images_row **rows, size_t *n)
{
    KOKSMA__REQUIRE(places, reference, rows, n);
    KOKSMA__REQUIRE_RUN(run);
    char pattern[KOKSMA__PATH];
    glob_t found = {0};
    pictures all = {.metric = metric};
    *rows = NULL;
    *n = 0;
    KOKSMA__TRY(koksma__image_names_pattern(places, pattern, sizeof pattern));
    koksma_status status = glob(pattern, 0, NULL, &found) == GLOB_NOSPACE ? koksma__fail_memory(sizeof pattern)
                                                                          : collect(places, pattern, &found, &all);
    status = status ? status : koksma_image_read(reference, &all.reference);
    status = status ? status : koksma_image_check_finite(&all.reference, reference);
    status = status ? status : koksma__parallel(run, all.n, compare_one, &all);
    status = status ? status : make_rows(&all, rows, n);
    status = status ? status : add_positions(&all, *rows, *n);
    status = status ? status : add_coherence(&all, run, *rows, *n);
    if (status) {
        free(*rows);
        *rows = NULL;
        *n = 0;
    }
    koksma_image_fini(&all.reference);
    free(all.at);
    globfree(&found);
    return status;
}
