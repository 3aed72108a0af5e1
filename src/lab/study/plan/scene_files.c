/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A scene file is known by the device and number of the file and of its folder, and by the end of its name: the folder
 * is where the paths in a scene start, and the end of the name says how it is read. So two links to a file are one scene
 * unless they lie in different folders. A file that cannot be opened is not tried again either, because trying may take
 * seconds and an audit asks for the scene of each row.
 */
#define _GNU_SOURCE /* tdestroy */
#include "study/plan/plan.h"

#include <inttypes.h>
#include <search.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/capacity.h"
#include "core/files.h"
#include "core/status.h"
#include "render/description_build.h"
#include "scene/scene.h"

enum { RATIO = 64, MOST_GIB = 4, KEY = KOKSMA__MAX_PATH + 96 };

/* A scene, or the reason why it cannot be opened. */
typedef struct scene_file {
    char *key; /* of the file, or a built-in scene's name */
    koksma_scene *scene;
    koksma_status failed;
    char *reason;
} scene_file;

static int compare_files(const void *a, const void *b)
{
    return strcmp(((const scene_file *)a)->key, ((const scene_file *)b)->key);
}

static void free_file(void *item)
{
    scene_file *file = item;
    koksma_scene_close(file->scene);
    KOKSMA__FREE(file->key, file->reason, file);
}

static void key_of(const char *name, char key[KEY])
{
    char folder[KOKSMA__MAX_PATH];
    struct stat file, above;
    const char *end = strrchr(name, '.');
    if (strpbrk(name, "./") && koksma__path_beside(name, ".", folder) && !stat(name, &file) &&
        !stat(folder, &above)) {
        snprintf(key, KEY, "%ju %ju %ju %ju %s", (uintmax_t)file.st_dev, (uintmax_t)file.st_ino,
                 (uintmax_t)above.st_dev, (uintmax_t)above.st_ino, end && !strchr(end, '/') ? end : "");
    } else {
        snprintf(key, KEY, "%s", name);
    }
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

koksma_status koksma__scene_files_open(koksma__scene_files *files, const char *name, koksma_scene **out)
{
    char key[KEY];
    const scene_file wanted = {.key = key};
    key_of(name, key);
    scene_file *const *found = tfind(&wanted, &files->tree, compare_files);
    *out = found ? (*found)->scene : NULL;
    if (found) {
        return *out ? KOKSMA_OK : koksma__fail((*found)->failed, "%s", (*found)->reason);
    }
    scene_file *file = calloc(1, sizeof *file);
    KOKSMA__REQUIRE_MEMORY(file, sizeof *file);
    file->failed = koksma__scene_open(name, KOKSMA__BY_FILE, &file->scene);
    file->failed = file->failed ? file->failed : count(files, file->scene, name);
    const koksma_status status = file->failed;
    if (status) {
        koksma_scene_close(file->scene);
        file->scene = NULL;
        file->reason = strdup(koksma_error_text());
    }
    file->key = strdup(key);
    const bool has_all = file->key && (file->reason || !status) && status != KOKSMA_MEMORY;
    if (!has_all || !tsearch(file, &files->tree, compare_files)) {
        free_file(file);
        return status ? status : koksma__fail_memory(sizeof *file);
    }
    files->n++;
    *out = file->scene;
    return status;
}

void koksma__scene_files_fini(koksma__scene_files *files)
{
    tdestroy(files->tree, free_file);
    *files = (koksma__scene_files){0};
}
