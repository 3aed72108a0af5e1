/* SPDX-License-Identifier: Apache-2.0 */
/* The size of the tile of mask-offset and mask-file, which a renderer repeats over the image, and of images. */
#include "patterns/masks/tile_size.h"

#include <koksma/mask.h>

#include <stdlib.h>
#include <string.h>

#include "core/point_files.h"
#include "core/status.h"
#include "patterns/patterns.h"

koksma_status koksma__tile_size(const koksma_spec *spec, size_t size[2])
{
    size[0] = size[1] = spec->pattern == &koksma__pattern_mask_offset ? (size_t)spec->params[0] : 0;
    if (spec->pattern == &koksma__pattern_mask_file) {
        size_t shape[3];
        float *values;
        KOKSMA__TRY(koksma__npy_read_mask(spec->path, KOKSMA__BY_FILE, KOKSMA_MASK_MAX, shape, &values));
        free(values);
        size[0] = shape[1];
        size[1] = shape[0];
    }
    return KOKSMA_OK;
}

bool koksma__fit_image(koksma_spec *spec, int width)
{
    const koksma_param *p = spec->pattern == &koksma__pattern_mask_offset ? NULL : spec->pattern->params;
    while (p && p->name && strcmp(p->name, "width") != 0) {
        p++;
    }
    if (p && p->name) {
        spec->params[p - spec->pattern->params] = width;
    }
    return p && p->name;
}
