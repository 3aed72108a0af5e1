/* SPDX-License-Identifier: Apache-2.0 */
/* Mutator: fuzz/mutate_json.c */
/* A glTF file in memory, JSON or binary. Files that it names are looked for in the current folder. */
#include "meshes/readers.h"
#include "target.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    koksma__mesh_file file = {.path = "fuzz.gltf"};
    if (size) { /* an empty file is refused before */
        fuzz_check_status(koksma__gltf_read(bytes, size, &file));
    }
    koksma__mesh_file_fini(&file);
    return 0;
}
