/* SPDX-License-Identifier: Apache-2.0 */
/* The layers of an image file: checks which layers may be written together, and names their channels. */
#include "image/layers.h"

#include <stdio.h>
#include <string.h>

#include "core/status.h"
#include "image/formats.h"
#include "image/image.h"

void koksma__layer_channel(const koksma_layer *layer, int k, char name[KOKSMA__CHANNEL_NAME])
{
    const char *dot = *layer->name ? "." : "";
    if (layer->image->channels == 1 && *layer->name) {
        snprintf(name, KOKSMA__CHANNEL_NAME, "%s", layer->name);
    } else {
        snprintf(name, KOKSMA__CHANNEL_NAME, "%s%s%c", layer->name, dot,
                 "YRGB"[layer->image->channels == 3 ? k + 1 : 0]);
    }
}

size_t koksma__layers_find(const koksma_layer *layers, size_t n, const char *wanted, int *k)
{
    char name[KOKSMA__CHANNEL_NAME];
    for (size_t l = 0; l < n; l++) {
        for (*k = 0; *k < layers[l].image->channels; ++*k) {
            koksma__layer_channel(&layers[l], *k, name);
            if (!strcmp(name, wanted)) {
                return l;
            }
        }
    }
    return n;
}

static koksma_status check_layer(const koksma_layer *layer, const koksma_image *first)
{
    KOKSMA__FAIL_IF(!layer->name || !layer->image, KOKSMA_ARGUMENT, "a layer without %s",
                    layer->name ? "an image" : "a name");
    KOKSMA__FAIL_IF(!layer->image->pixels, KOKSMA_ARGUMENT, "an image without pixels");
    const koksma_status status =
        koksma__image_check_shape(layer->image->width, layer->image->height, layer->image->channels);
    if (status) {
        return status;
    }
    KOKSMA__FAIL_IF(strlen(layer->name) > KOKSMA__LAYER_NAME, KOKSMA_ARGUMENT, "the layer's name '%s' is too long",
                    layer->name);
    KOKSMA__FAIL_IF(layer->image->width != first->width || layer->image->height != first->height, KOKSMA_ARGUMENT,
                    "layer '%s' is of another size", layer->name);
    return KOKSMA_OK;
}

koksma_status koksma__layers_check(const koksma_layer *layers, size_t n)
{
    char name[KOKSMA__CHANNEL_NAME];
    koksma_status status = n ? koksma__array_check("layers", layers, n, sizeof *layers)
                             : koksma__fail(KOKSMA_ARGUMENT, "no image to write");
    for (size_t l = 0; !status && l < n; l++) {
        status = check_layer(&layers[l], layers->image);
    }
    for (size_t l = 0; !status && l < n; l++) {
        for (int k = 0; k < layers[l].image->channels; k++) {
            int first;
            koksma__layer_channel(&layers[l], k, name);
            KOKSMA__FAIL_IF(koksma__layers_find(layers, n, name, &first) != l || first != k, KOKSMA_ARGUMENT,
                            "two layers have a channel '%s'", name);
        }
    }
    return status;
}
