/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Whether the images of a pattern have visible bands, from the coherence rows of a store. Each row belongs to one
 * image: it has the coherence (the peak of the error's power spectrum divided by its mean) and the probability p that
 * white noise has a coherence at least as large.
 *
 * A pattern is "in bands" when more than half of its images are coherent, each judged alone (p < KOKSMA_COHERENT_P,
 * coherence >= KOKSMA_COHERENT_LEAST). Patterns whose errors are white noise are called "in bands" in at most 2
 * KOKSMA_COHERENT_P = 1 % of all cases, however strongly the images of a pattern depend on each other (Markov's
 * inequality for the number of coherent images). `koksma rank` and the pictures of a report use spectra averaged over
 * images, which show weaker waves than single images.
 */
#ifndef KOKSMA_STUDY_REPORT_COHERENCE_ROWS_H
#define KOKSMA_STUDY_REPORT_COHERENCE_ROWS_H

#include "stats/statistics.h"
#include "study/run/study.h"

typedef struct koksma__row_coherence {
    koksma__summary mean; /* summary of the images' coherences */
    size_t coherent;      /* number of coherent images among all mean.n */
} koksma__row_coherence;

/* The text of a table cell: whether the pattern is in bands, "yes" or "no"; "not known" without rows. */
const char *koksma__bands_text(const koksma__row_coherence *coherence);

/* Whether more than half of the images are coherent. */
bool koksma__in_bands(const koksma__row_coherence *coherence);

/* Reads the coherence of a block's images of one pattern, against the block's last reference. If the store has no
   such rows, mean.n is 0. */
koksma_status koksma__image_coherence(koksma_study *study, const koksma__image_block *block, const char *scene,
                                      const char *variant, const char *pattern, long long spp,
                                      koksma__row_coherence *out);

#endif
