/* SPDX-License-Identifier: Apache-2.0 */
/*
 * For those who have errors in doubles and no images of them.
 */
#ifndef KOKSMA_IMAGE_COHERENCE_H
#define KOKSMA_IMAGE_COHERENCE_H

#include <koksma/image.h>

/* As koksma_coherence_add, of an image's errors [y * width + x], which are overwritten. Errors: MALFORMED (an error
   is not a finite number), MEMORY. */
koksma_status koksma__coherence_add_errors(koksma_coherence *coherence, double *errors);

#endif
