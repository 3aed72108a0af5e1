/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Coherence of errors that are given as doubles instead of images.
 */
#ifndef KOKSMA_IMAGE_COHERENCE_H
#define KOKSMA_IMAGE_COHERENCE_H

#include <koksma/image.h>

/* Does what koksma_coherence_add does, from the errors of an image's pixels: errors[y * width + x], which the
   function overwrites. Errors: MALFORMED (an error is not a finite number), MEMORY. */
koksma_status koksma__coherence_add_errors(koksma_coherence *coherence, double *errors);

#endif
