/* SPDX-License-Identifier: Apache-2.0 */
/* Mutator: fuzz/mutate_json.c */
/* Fuzzes the parser of scene files: any text gives a scene or an error. */
#include "scene/scene.h"
#include "target.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    koksma_scene *scene;
    fuzz_check_status(koksma__scene_open_text("fuzz", (const char *)bytes, size, &scene));
    koksma_scene_close(scene);
    return 0;
}
