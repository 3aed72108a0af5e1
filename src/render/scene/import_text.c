/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Limits what scenes of other renderers take: counts the memory and refuses what is too much, and reads the texts that they
 * include, perhaps packed by gzip.
 */
#include "scene/import.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/hash.h"
#include "core/status.h"
#include "meshes/readers.h"
#include "render/fields.h"

enum { MOST_HELD = 384 << 20 };

koksma_status koksma__import_hold(koksma__import *im, koksma__text_place place, uint64_t bytes)
{
    im->held += bytes;
    return im->held <= MOST_HELD
               ? KOKSMA_OK
               : koksma__import_fail(
                     place,
                     "what the texts of the scene describe up to here takes more than %d MiB of memory; "
                     "meshes in files of their own do not count",
                     MOST_HELD >> 20);
}

koksma_status koksma__import_hold_mesh(koksma__import *im, koksma__text_place place, const koksma__mesh *mesh)
{
    const size_t numbers = 3 + (mesh->normals ? 3 : 0) + (mesh->uvs ? 2 : 0);
    return koksma__import_hold(
        im, place, 2 * sizeof *mesh + sizeof(float) * (numbers * mesh->n_vertices + 3 * mesh->n_triangles));
}

koksma_status koksma__import_check_uv(koksma__text_place place, const double *values, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        if (!(fabs(values[i]) <= FAR)) {
            return koksma__import_fail(place, "a texture is scaled or moved by %g; the most is 1e6", values[i]);
        }
    }
    return KOKSMA_OK;
}

enum { MOST_INCLUDES = 4096 };

/* Whether the file `full` is below the folder of the scene, after following symbolic links. A file that does not
   exist passes; opening it fails later. */
static bool is_below(const char *scene, const char *full)
{
    char folder[KOKSMA__MAX_PATH];
    const char *slash = strrchr(scene, '/');
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - scene) + 1 : 1, slash ? scene : ".");
    char *above = realpath(folder, NULL), *real = realpath(full, NULL);
    const size_t length = above ? strlen(above) : 0;
    const bool below = !real || (above && !strncmp(real, above, length) && (length == 1 || real[length] == '/'));
    free(above);
    free(real);
    return below;
}

/* Reads a text file, which is compressed by gzip if its name ends in .gz. */
static koksma_status read_text(const char *path, unsigned char **bytes, size_t *size)
{
    const char *dot = strrchr(path, '.');
    if (!dot || strcmp(dot, ".gz") != 0) {
        return koksma__read_file(path, KOKSMA__FILE_SCENE, KOKSMA__BY_FILE, koksma__check_text, bytes, size);
    }
    unsigned char *packed = NULL;
    KOKSMA__TRY(koksma__read_file(path, KOKSMA__FILE_SCENE, KOKSMA__BY_FILE, NULL, &packed, size));
    koksma_status status =
        koksma__inflate_all(packed, *size, (size_t)koksma__file_most(KOKSMA__FILE_SCENE), bytes, size);
    free(packed);
    status = status ? status : koksma__check_text(*bytes, *size);
    if (status) {
        free(*bytes);
        *bytes = NULL;
        return koksma__fail_in(status, path);
    }
    return KOKSMA_OK;
}

koksma_status koksma__import_text(koksma__import *im, koksma__text_place place, const char *path, char **bytes,
                                  size_t *size)
{
    char full[KOKSMA__MAX_PATH];
    unsigned char *read = NULL;
    KOKSMA__TRY(koksma__import_path(im, place, path, full));
    if (++im->n_files > MOST_INCLUDES) {
        return koksma__import_fail(place, "more than %d files are included", MOST_INCLUDES);
    }
    if (!is_below(im->path, full)) {
        return koksma__import_fail(place, "it includes '%s', which is not below the scene's own folder", path);
    }
    KOKSMA__TRY(koksma__import_fail_at(place, read_text(full, &read, size)));
    koksma_status status = koksma__import_hold(im, place, *size);
    status = status ? status : koksma__import_spend(im, place, *size / KOKSMA__STEP_TEXT);
    if (status) {
        free(read);
        return status;
    }
    *bytes = (char *)read;
    im->scene->hash += koksma__hash(read, *size) * im->n_files;
    return KOKSMA_OK;
}

void koksma__import_text_close(koksma__import *im, char *bytes, size_t size)
{
    free(bytes);
    im->held -= size;
}
