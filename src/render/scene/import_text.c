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

void koksma__import_hold(koksma__text_place place, uint64_t bytes)
{
    place.im->held += bytes;
    koksma__import_fail_if(place.im->held > MOST_HELD, place,
                           "what the texts of the scene describe up to here takes more than %d MiB of memory; meshes "
                           "in files of their own do not count",
                           MOST_HELD >> 20);
}

void koksma__import_check_uv(koksma__text_place place, const double *values, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        koksma__import_fail_if(!(fabs(values[i]) <= FAR), place,
                               "a texture is scaled or moved by %g; the most is 1e6", values[i]);
    }
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

koksma__open_text koksma__import_text(koksma__text_place place, const char *path)
{
    koksma__import *im = place.im;
    char full[KOKSMA__MAX_PATH];
    unsigned char *read = NULL;
    size_t size = 0;
    koksma__import_path(place, path, full);
    koksma__import_fail_if(++im->n_files > MOST_INCLUDES, place, "more than %d files are included", MOST_INCLUDES);
    koksma__import_fail_if(!is_below(im->path, full), place,
                           "it includes '%s', which is not below the scene's own folder", path);
    char **name = koksma__import_add(place, &im->names, &im->n_names, sizeof *name);
    *name = strdup(path);
    koksma__import_pass(place, *name ? KOKSMA_OK : koksma__fail_memory(strlen(path)));
    koksma__open_text *text = koksma__import_add(place, &im->texts, &im->n_texts, sizeof *text);
    koksma__import_check(place, read_text(full, &read, &size));
    *text = (koksma__open_text){*name, (char *)read, size};
    koksma__import_hold(place, size);
    koksma__import_spend(place, size / KOKSMA__STEP_TEXT);
    im->scene->hash += koksma__hash(read, size) * im->n_files;
    return *text;
}

void koksma__import_text_close(koksma__import *im)
{
    const koksma__open_text last = im->texts[--im->n_texts];
    free(last.bytes);
    im->held -= last.size;
}
