/* SPDX-License-Identifier: Apache-2.0 */
/* The scenes that plans name, each opened once. */
#define _GNU_SOURCE /* tdestroy */
#include "study/plan/plan.h"

#include <search.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/files.h"
#include "core/status.h"
#include "render/description_build.h"
#include "scene/scene.h"

enum { RATIO = 64, MOST_GIB = 4 };

static int compare_scenes(const void *a, const void *b)
{
    return strcmp(((const koksma__study_scene *)a)->name, ((const koksma__study_scene *)b)->name);
}

static void free_scene(void *item)
{
    koksma__study_scene *s = item;
    koksma_scene_close(s->scene);
    free((char *)s->name);
    free(s);
}

/* Adds the memory of a scene, and the length of its files, to the sums. */
static koksma_status count(koksma__scene_files *files, const koksma_scene *scene, const char *name)
{
    struct stat file;
    files->bytes += scene->image_bytes + sizeof *scene->materials * scene->n_materials +
                    sizeof *scene->shapes * scene->n_shapes + sizeof *scene->lights * scene->n_lights +
                    sizeof *scene->placements * scene->n_placements;
    for (size_t i = 0; i < scene->n_meshes; i++) {
        files->bytes += koksma__mesh_bytes(&scene->meshes[i]);
    }
    files->file_bytes += scene->image_file_bytes + scene->mesh_files.bytes;
    files->file_bytes += strpbrk(name, "./") && !stat(name, &file) ? (uint64_t)file.st_size : 0;
    if (files->bytes > (uint64_t)MOST_GIB << 30 && files->bytes / RATIO > files->file_bytes) {
        return koksma__refused(koksma__fail(KOKSMA_MALFORMED,
                                            "%s: with it the scenes of the study take more than %d GiB and more than "
                                            "%d times their files: use fewer or smaller ones",
                                            name, MOST_GIB, RATIO));
    }
    return KOKSMA_OK;
}

/* Opens the scene s->name. */
static koksma_status open_scene(koksma__scene_files *files, koksma__study_scene *s)
{
    koksma_render_options options;
    KOKSMA__REQUIRE_MEMORY(s->name, 1);
    KOKSMA__TRY(koksma__scene_open(s->name, KOKSMA__BY_FILE, &s->scene));
    KOKSMA__TRY(count(files, s->scene, s->name));
    koksma_render_options_init(&options, s->scene);
    s->width = options.width;
    s->height = options.height;
    snprintf(s->hash, sizeof s->hash, "%016llx", (unsigned long long)koksma_scene_hash(s->scene));
    return tsearch(s, &files->tree, compare_scenes) ? KOKSMA_OK : koksma__fail_memory(sizeof *s);
}

const koksma__study_scene *koksma__scene_files_find(const koksma__scene_files *files, const char *name)
{
    const koksma__study_scene wanted = {.name = name}, *const *found = tfind(&wanted, &files->tree, compare_scenes);
    return found ? *found : NULL;
}

koksma_status koksma__scene_files_open(koksma__scene_files *files, const char *name)
{
    if (koksma__scene_files_find(files, name)) {
        return KOKSMA_OK;
    }
    koksma__study_scene *s = calloc(1, sizeof *s);
    KOKSMA__REQUIRE_MEMORY(s, sizeof *s);
    s->name = strdup(name);
    const koksma_status status = open_scene(files, s);
    if (status) {
        free_scene(s);
    }
    return status;
}

void koksma__scene_files_fini(koksma__scene_files *files)
{
    tdestroy(files->tree, free_scene);
    *files = (koksma__scene_files){0};
}
