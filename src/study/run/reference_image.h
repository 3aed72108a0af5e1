/* SPDX-License-Identifier: Apache-2.0 */
/* A reference image, as the open study has it (references.h has what is done with it). */
#ifndef KOKSMA_STUDY_RUN_REFERENCE_IMAGE_H
#define KOKSMA_STUDY_RUN_REFERENCE_IMAGE_H

#include "study/run/picture.h"

enum { KOKSMA__REFERENCE_NAME = KOKSMA_MAX_SPEC + 128, KOKSMA__PATH = 1200 };

/* A reference image and all that it depends on. */
typedef struct koksma__reference_image {
    const koksma__study_scene *scene;
    const koksma__reference *reference;
    char options[KOKSMA__VARIANT_TEXT];
    int width, height;
    koksma_image image; /* no pixels until it is needed */
} koksma__reference_image;

#endif
