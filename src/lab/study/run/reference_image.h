/* SPDX-License-Identifier: Apache-2.0 */
/* The reference images of an open study; references.h declares the functions on them. */
#ifndef KOKSMA_STUDY_RUN_REFERENCE_IMAGE_H
#define KOKSMA_STUDY_RUN_REFERENCE_IMAGE_H

#include "study/run/picture.h"
#include "study/run/results_path.h"

enum { KOKSMA__REFERENCE_NAME = KOKSMA_MAX_SPEC + 128 };

/* A reference image and everything that it depends on. */
typedef struct koksma__reference_image {
    const koksma__study_scene *scene;
    const koksma__reference *reference;
    char options[KOKSMA__VARIANT_TEXT];
    int width, height;
    koksma_image image; /* its pixels are NULL until a job needs them */
    bool failed;        /* whether an audit could not render it; the pixels are then those of another picture */
    uint64_t hash;      /* of all members above `image` */
    size_t next[2];     /* a tree of the study's references by their hashes (references.c) */
} koksma__reference_image;

#endif
