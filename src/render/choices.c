/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The names of the render options that are enumerations (pairing, scope, selection of lights), for the parsers of
 * plans and of the command line; and the function that frees an image with its layers.
 */
#include <stddef.h>

#include <koksma/render.h>

#define NAME_AT(names, i) ((unsigned)(i) < sizeof(names) / sizeof *(names) ? (names)[i] : NULL)

const char *koksma_pairing_name(koksma_pairing pairing)
{
    static const char *const names[] = {[KOKSMA_PAIRING_SHUFFLED] = "shuffled",
                                        [KOKSMA_PAIRING_ALIGNED] = "aligned",
                                        [KOKSMA_PAIRING_NATIVE] = "native"};
    return NAME_AT(names, pairing);
}

const char *koksma_scope_name(koksma_scope scope)
{
    static const char *const names[] = {[KOKSMA_SCOPE_PIXEL] = "pixel", [KOKSMA_SCOPE_IMAGE] = "image"};
    return NAME_AT(names, scope);
}

const char *koksma_light_selection_name(koksma_light_selection selection)
{
    static const char *const names[] = {[KOKSMA_LIGHTS_ALL] = "all",
                                        [KOKSMA_LIGHTS_ONE] = "one",
                                        [KOKSMA_LIGHTS_POWER] = "power",
                                        [KOKSMA_LIGHTS_UNIFORM] = "uniform",
                                        [KOKSMA_LIGHTS_AUTO] = "auto"};
    return NAME_AT(names, selection);
}

void koksma_layers_fini(koksma_layers *layers)
{
    if (layers) {
        koksma_image_fini(&layers->image);
        koksma_image_fini(&layers->albedo);
        koksma_image_fini(&layers->normal);
        koksma_image_fini(&layers->depth);
        koksma_image_fini(&layers->samples);
        koksma_image_fini(&layers->variance);
    }
}
