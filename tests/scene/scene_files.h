/* SPDX-License-Identifier: Apache-2.0 */
/* Scenes of pbrt and Mitsuba that a test writes into a folder of its own. */
#ifndef KOKSMA_TESTS_SCENE_FILES_H
#define KOKSMA_TESTS_SCENE_FILES_H

#include <dirent.h>
#include <stdio.h>
#include <unistd.h>

#include "rendering.h"

static char folder[64];

static inline void write_bytes(const char *name, const void *bytes, size_t size)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    test_write_bytes(path, bytes, size);
}

static inline void write_file(const char *name, const char *text)
{
    write_bytes(name, text, strlen(text));
}

static inline koksma_status open_as(const char *name, const char *text, koksma_scene **out)
{
    char path[128];
    write_file(name, text);
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return koksma_scene_open(path, out);
}

static inline koksma_scene *opened(const char *name, const char *text)
{
    koksma_scene *scene = NULL;
    assert_that(!open_as(name, text, &scene), "%s: %s", text, koksma_error_text());
    return scene;
}

/* A build without expat reads no XML, and one without Embree traces no meshes. */
static inline bool can_read(const char *name)
{
    koksma_scene *scene = NULL;
    const koksma_status status = open_as(name, "<scene version=\"3.0.0\"/>", &scene);
    koksma_scene_close(scene);
    return status != KOKSMA_UNSUPPORTED;
}

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/koksma-scenes-XXXXXX");
    return !mkdtemp(folder);
}

static int remove_folder(void **state)
{
    (void)state;
    char path[512];
    DIR *all = opendir(folder);
    for (const struct dirent *file; all && (file = readdir(all));) {
        snprintf(path, sizeof path, "%s/%s", folder, file->d_name);
        unlink(path);
    }
    closedir(all);
    return rmdir(folder);
}

TEST_GROUP(make_folder, remove_folder)

#endif
