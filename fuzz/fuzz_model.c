/* SPDX-License-Identifier: Apache-2.0 */
/* Mutator: fuzz/mutate_words.c */
/* A mesh file or another renderer's scene: the first line is the ending of its name (.obj .ply .ply.gz .gltf
   .glb .serialized .pbrt .xml), the rest the file. */
#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

#include <koksma/render.h>

#include "target.h"

/* The file's path without its ending. */
static const char *place(void)
{
    static char path[64];
    if (!*path) {
        snprintf(path, sizeof path, "%s/koksma-fuzz-%ld", fuzz_place(), (long)getpid());
    }
    return path;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    static const char *const endings[] = {".obj", ".ply", ".ply.gz", ".gltf", ".glb", ".serialized", ".pbrt", ".xml"};
    char path[80];
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        const size_t length = strlen(endings[i]);
        if (size <= length || memcmp(bytes, endings[i], length) != 0 || bytes[length] != '\n') {
            continue;
        }
        snprintf(path, sizeof path, "%s%s", place(), endings[i]);
        const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
        if (file < 0 || write(file, bytes + length + 1, size - length - 1) != (ssize_t)(size - length - 1)) {
            abort();
        }
        close(file);
        koksma_scene *scene;
        const koksma_status status = koksma_scene_open(path, &scene);
        fuzz_check_status(status);
        if (!status) {
            koksma_scene_close(scene);
        }
        unlink(path);
    }
    return 0;
}
