/* SPDX-License-Identifier: Apache-2.0 */
/* What is looked at before assimp reads a glTF file. */
#include "meshes/mesh.h"
#include "target.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    if (size) { /* an empty file is refused before */
        fuzz_check_status(koksma__gltf_check("fuzz.gltf", bytes, size));
    }
    return 0;
}
