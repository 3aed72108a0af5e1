/* SPDX-License-Identifier: Apache-2.0 */
/* Layers: the images of one file. */
#ifndef KOKSMA_IMAGE_LAYERS_H
#define KOKSMA_IMAGE_LAYERS_H

#include "image/formats.h"

/* Writes the name of channel k of a layer. */
void koksma__layer_channel(const koksma_layer *layer, int k, char name[KOKSMA__CHANNEL_NAME]);

/* Returns the index of the first layer that has a channel of this name, or n if none has; *k is set to the index of
   the channel in the layer. */
size_t koksma__layers_find(const koksma_layer *layers, size_t n, const char *wanted, int *k);

/* Fails with ARGUMENT unless the layers are images of one size, and no two channels have the same name. Errors do not
   name the file. */
koksma_status koksma__layers_check(const koksma_layer *layers, size_t n);

#endif
