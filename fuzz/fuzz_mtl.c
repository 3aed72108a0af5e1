/* SPDX-License-Identifier: Apache-2.0 */
/* Mutator: fuzz/mutate_words.c */
/* A material file of an OBJ mesh. */
#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

#include "meshes/readers.h"
#include "target.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    char path[64];
    koksma__mesh_file file = {.path = "fuzz.obj"};
    koksma__mtl_names names = {0};
    snprintf(path, sizeof path, "%s/koksma-fuzz-%ld.mtl", fuzz_place(), (long)getpid());
    const int descriptor = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (descriptor < 0 || write(descriptor, bytes, size) != (ssize_t)size || close(descriptor)) {
        abort();
    }
    fuzz_check_status(koksma__mtl_read(path, &names, &file));
    koksma__mtl_names_fini(&names);
    koksma__mesh_file_fini(&file);
    unlink(path);
    return 0;
}
