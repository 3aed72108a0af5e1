/* SPDX-License-Identifier: Apache-2.0 */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/read_file.h"
#include "core/status.h"
#include "study/study.h"

enum { MAX_PLAN = 1 << 22 };

static koksma_status load_plan(const char *name, long long trials, koksma__plan *plan)
{
    const size_t length = strlen(name);
    if (!strchr(name, '/') && !(length > 5 && !strcmp(name + length - 5, ".json"))) {
        size_t size;
        const char *text = koksma__plan_shipped(name, &size);
        if (!text) {
            return koksma__fail(KOKSMA_UNKNOWN, "no plan '%s' ships; a plan of your own is a file, such as ./%s.json",
                                name, name);
        }
        return koksma__plan_parse(name, text, size, trials, plan);
    }
    unsigned char *text = NULL;
    size_t size = 0;
    koksma_status status = koksma__read_file(name, MAX_PLAN, &text, &size);
    if (status) {
        return status;
    }
    status = koksma__plan_parse(name, (const char *)text, size, trials, plan);
    free(text);
    return status;
}

const koksma__study_scene *koksma__study_scene_of(const koksma_study *study, const char *name)
{
    for (size_t i = 0; i < study->n_scenes; i++) {
        if (!strcmp(study->scenes[i].name, name)) {
            return &study->scenes[i];
        }
    }
    return NULL;
}

static koksma_status open_scene(koksma_study *study, const char *name)
{
    if (koksma__study_scene_of(study, name)) {
        return KOKSMA_OK;
    }
    koksma__study_scene *scenes = realloc(study->scenes, (study->n_scenes + 1) * sizeof *scenes);
    if (!scenes) {
        return koksma__fail_memory((study->n_scenes + 1) * sizeof *scenes);
    }
    study->scenes = scenes;
    koksma__study_scene *s = &scenes[study->n_scenes];
    *s = (koksma__study_scene){.name = name};
    const koksma_status status = koksma_scene_open(name, &s->scene);
    if (status) {
        return status;
    }
    koksma_render_options options;
    koksma_render_options_init(&options, s->scene);
    s->width = options.width;
    s->height = options.height;
    snprintf(s->hash, sizeof s->hash, "%016llx", (unsigned long long)koksma_scene_hash(s->scene));
    study->n_scenes++;
    return KOKSMA_OK;
}

static koksma_status open_scenes(koksma_study *study)
{
    koksma_status status = KOKSMA_OK;
    for (size_t b = 0; b < study->plan.n_images; b++) {
        for (size_t i = 0; !status && i < study->plan.images[b].scenes.n; i++) {
            status = open_scene(study, study->plan.images[b].scenes.at[i]);
        }
    }
    for (size_t f = 0; !status && f < study->plan.n_figures; f++) {
        if (study->plan.figures[f].scene) {
            status = open_scene(study, study->plan.figures[f].scene);
        }
    }
    return status;
}

static koksma_status open_store(koksma_study *study, const char *folder)
{
    char path[1100];
    if (strlen(folder) > 1000) {
        return koksma__fail(KOKSMA_ARGUMENT, "the folder's name is longer than 1000 characters");
    }
    if (mkdir(folder, 0777) && errno != EEXIST) {
        return koksma__fail(KOKSMA_IO, "%s: can't be made: %s", folder, strerror(errno));
    }
    study->folder = strdup(folder);
    if (!study->folder) {
        return koksma__fail_memory(strlen(folder));
    }
    snprintf(path, sizeof path, "%s/results.sqlite", folder);
    return koksma__store_open(path, study->plan.name, &study->store);
}

koksma_status koksma_study_open(const char *plan, const char *folder, long long trials, koksma_study **out)
{
    koksma_study *study = calloc(1, sizeof *study);
    *out = NULL;
    if (!study) {
        return koksma__fail_memory(sizeof *study);
    }
    koksma_status status = load_plan(plan, trials, &study->plan);
    if (!status) {
        status = open_scenes(study);
    }
    if (!status) {
        status = open_store(study, folder);
    }
    if (status) {
        koksma_study_close(study);
        return status;
    }
    *out = study;
    return KOKSMA_OK;
}

koksma_status koksma_study_close(koksma_study *study)
{
    if (!study) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma__store_close(study->store);
    for (size_t i = 0; i < study->n_scenes; i++) {
        koksma_scene_close(study->scenes[i].scene);
    }
    free(study->scenes);
    koksma__plan_fini(&study->plan);
    free(study->folder);
    free(study);
    return status;
}
