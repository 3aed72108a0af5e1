/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Whether the images of a pattern have bands, from the coherence rows of a store. Each row is of one image: the peak
 * of its error's spectrum over the mean, and the probability p that white noise has as large a one.
 *
 * A pattern is "in bands" when more than half of its images are coherent, each judged alone (p < KOKSMA_COHERENT_P,
 * coherence >= KOKSMA_COHERENT_LEAST). However much the images have in common, white noise is called so in at most
 * 2 KOKSMA_COHERENT_P = 1 % of all cases (Markov's inequality on the number of coherent images).
 * Averaged spectra, which `rank` and the pictures of a report use, find weaker waves than single images show.
 */
#ifndef KOKSMA_STUDY_REPORT_COHERENCE_ROWS_H
#define KOKSMA_STUDY_REPORT_COHERENCE_ROWS_H

#include "stats/statistics.h"
#include "study/run/study.h"

typedef struct koksma__row_coherence {
    koksma__summary mean; /* of the images' coherences */
    size_t coherent;      /* so many of mean.n images */
} koksma__row_coherence;

/* What a table prints: "yes", "no"; "not known" without rows. */
const char *koksma__bands_text(const koksma__row_coherence *coherence);

/* More than half of the images are coherent. */
bool koksma__in_bands(const koksma__row_coherence *coherence);

/* Of a block's images of one pattern against the block's last reference. mean.n = 0: the store has none. */
koksma_status koksma__image_coherence(koksma_study *study, const koksma__image_block *block, const char *scene,
                                      const char *variant, const char *pattern, long long spp,
                                      koksma__row_coherence *out);

#endif
