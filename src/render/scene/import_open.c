/* SPDX-License-Identifier: Apache-2.0 */
/* Opens scenes of other renderers: the ending of the file's name selects the reader, which fills an empty scene. */
#include "scene/import_open.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/hash.h"
#include "core/status.h"
#include "render/description_build.h"
#include "scene/import_shapes.h"
#include "scene/mitsuba.h"
#include "scene/pbrt.h"

/* A number in the hash by which stored studies find a scene; it is raised when a change of the code makes another
   scene from the same files. */
enum { READER_REVISION = 8 };

static bool is_pbrt(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && !strcmp(dot, ".pbrt");
}

bool koksma__is_import_file(const char *path)
{
    const char *dot = strrchr(path, '.');
    return is_pbrt(path) || (dot && !strcmp(dot, ".xml"));
}

static koksma_status open_text(const char *path, const char *text, size_t size, koksma_scene *scene)
{
    const char *slash = strrchr(path, '/');
    koksma__import im = {.scene = scene, .path = path, .n_files = 1, .held = size};
    scene->lights = calloc(KOKSMA__MAX_LIGHTS, sizeof *scene->lights);
    scene->materials = calloc(KOKSMA__MAX_MATERIALS, sizeof *scene->materials);
    if (!scene->lights || !scene->materials) {
        return koksma__fail_memory(KOKSMA__MAX_MATERIALS * sizeof *scene->materials);
    }
    snprintf(scene->title, sizeof scene->title, "%s", slash ? slash + 1 : path);
    scene->is_model = true;
    scene->clamp = INFINITY;
    scene->hash = koksma__hash(text, size) + READER_REVISION;
    const koksma_status status = (is_pbrt(path) ? koksma__pbrt_read : koksma__mitsuba_read)(&im, text, size);
    koksma__import_shapes_fini(&im);
    free(im.texts);
    if (!status) {
        koksma__scene_finish(scene);
    }
    return status;
}

koksma_status koksma__import_open(const char *path, koksma__named by, koksma_scene *scene)
{
    unsigned char *bytes;
    size_t size;
    KOKSMA__TRY(koksma__read_file(path, KOKSMA__FILE_SCENE, by, koksma__check_text, &bytes, &size));
    const koksma_status status = open_text(path, (const char *)bytes, size, scene);
    free(bytes);
    return status;
}
