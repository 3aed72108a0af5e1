/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reference images. The paper took 400 jittered samples; a reference whose own error is not far below the errors that
 * are measured against it hides or adds error, so a plan may ask for the mean of many independent renders. Their
 * spread gives the reference's own expected absolute error: for k replicates with the sample deviation s at a pixel,
 * a normal error of deviation s / sqrt k has the mean absolute value sqrt(2/pi) s / sqrt k; the mean of that over the
 * pixels is kept.
 */
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/hash.h"
#include "core/status.h"
#include "study/study.h"

uint64_t koksma__job_seed(const char *format, ...)
{
    char key[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(key, sizeof key, format, arguments);
    va_end(arguments);
    return koksma__hash(key, strlen(key));
}

void koksma__reference_name(const koksma__reference *reference, char *text)
{
    snprintf(text, KOKSMA__REFERENCE_NAME, "%s:%s@%lldx%lld", reference->name, reference->pattern, reference->spp,
             reference->replicates);
}

koksma_status koksma__study_render(const koksma__study_scene *scene, const char *pattern, long long spp,
                                   uint64_t seed, const koksma_run *run, koksma_image *out)
{
    koksma_render_options options;
    koksma_render_options_init(&options, scene->scene);
    const koksma_status status = koksma_pattern_spec(pattern, &options.pattern);
    options.spp = (int)spp;
    options.seed = seed;
    options.width = scene->width;
    options.height = scene->height;
    return status ? status : koksma_render(scene->scene, &options, run, out);
}

/* Sums and sums of squares over replicates, in double. */
typedef struct sums {
    double *sum, *squares;
    size_t count;
} sums;

static koksma_status add_image(sums *s, const koksma_image *image)
{
    if (!s->sum) {
        s->count = (size_t)image->width * (size_t)image->height * (size_t)image->channels;
        s->sum = calloc(2 * s->count, sizeof *s->sum);
        if (!s->sum) {
            return koksma__fail_memory(2 * s->count * sizeof *s->sum);
        }
        s->squares = s->sum + s->count;
    }
    for (size_t i = 0; i < s->count; i++) {
        const double x = (double)image->pixels[i];
        s->sum[i] += x;
        s->squares[i] += x * x;
    }
    return KOKSMA_OK;
}

static double standard_error(const sums *s, double k)
{
    double total = 0;
    for (size_t i = 0; i < s->count; i++) {
        const double mean = s->sum[i] / k;
        const double variance = fmax(s->squares[i] / k - mean * mean, 0) * k / (k - 1);
        total += sqrt(2 / M_PI * variance / k);
    }
    return total / (double)s->count;
}

static koksma_status render_reference(const koksma__study_scene *scene, const koksma__reference *reference,
                                      const koksma_run *run, koksma_image *out, double *error)
{
    koksma_status status = KOKSMA_OK;
    sums s = {0};
    const double k = (double)reference->replicates;
    for (long long r = 0; !status && r < reference->replicates; r++) {
        const uint64_t seed = koksma__job_seed("reference|%s|%s|%s|%lld|%lld", scene->name, scene->hash,
                                               reference->pattern, reference->spp, r);
        koksma_image_fini(out);
        status = koksma__study_render(scene, reference->pattern, reference->spp, seed, run, out);
        if (!status) {
            status = add_image(&s, out);
        }
    }
    for (size_t i = 0; !status && i < s.count; i++) {
        out->pixels[i] = (float)(s.sum[i] / k);
    }
    *error = status || reference->replicates < 2 ? (double)NAN : standard_error(&s, k);
    free(s.sum);
    return status;
}

/* The file's name holds all that the picture depends on. */
static void reference_path(const koksma_study *study, const koksma__study_scene *scene,
                           const koksma__reference *reference, char *path, size_t size)
{
    char name[KOKSMA__REFERENCE_NAME];
    koksma__reference_name(reference, name);
    snprintf(path, size, "%s/references/%016llx.exr", study->folder,
             (unsigned long long)koksma__job_seed("%s|%s|%s|%dx%d|%s", scene->name, scene->hash, name, scene->width,
                                                  scene->height, koksma_version()));
}

koksma_status koksma__reference_image(koksma_study *study, const koksma__study_scene *scene,
                                      const koksma__reference *reference, const koksma_run *run, koksma_image *out)
{
    char path[1100], name[KOKSMA__REFERENCE_NAME];
    struct stat info;
    double error;
    snprintf(path, sizeof path, "%s/references", study->folder);
    if (mkdir(path, 0777) && errno != EEXIST) {
        return koksma__fail(KOKSMA_IO, "%s: can't be made: %s", path, strerror(errno));
    }
    *out = (koksma_image){0};
    reference_path(study, scene, reference, path, sizeof path);
    koksma__reference_name(reference, name);
    if (!stat(path, &info)) {
        return koksma_image_read(path, out);
    }
    koksma_status status = render_reference(scene, reference, run, out, &error);
    if (!status) {
        status = koksma__store_put_reference(study->store, scene->name, scene->hash, name, error);
    }
    if (!status) {
        status = koksma__store_commit(study->store);
    }
    if (!status) { /* the picture last: where it is, the row is */
        status = koksma_image_write(path, out, name);
    }
    if (status) {
        koksma_image_fini(out);
    }
    return status;
}
