/* SPDX-License-Identifier: Apache-2.0 */
/* The results of a study in DIR/results.sqlite (schema.sql). Rows survive the death of the program; a row that exists
   is never written again. All calls may come from several threads. */
#ifndef KOKSMA_STUDY_STORE_H
#define KOKSMA_STUDY_STORE_H

#include <koksma/image.h>

typedef struct koksma__store koksma__store;

typedef struct koksma__discrepancy_key {
    const char *pattern, *measure;
    long long n, dim, trial;
} koksma__discrepancy_key;

typedef struct koksma__image_key {
    const char *scene, *scene_hash, *pattern, *reference;
    long long spp, width, height, trial;
} koksma__image_key;

/* Opens or creates. Errors: IO (can't be written; another run holds it), MALFORMED (not such a database, or of
   another schema). */
koksma_status koksma__store_open(const char *path, const char *plan_name, koksma__store **store);
koksma_status koksma__store_close(koksma__store *store);

/* Puts everything so far on disk. */
koksma_status koksma__store_commit(koksma__store *store);

/* Whether the row exists. */
koksma_status koksma__store_has_discrepancy(koksma__store *store, const koksma__discrepancy_key *key, bool *has);
koksma_status koksma__store_has_image(koksma__store *store, const koksma__image_key *key, bool *has);

koksma_status koksma__store_put_discrepancy(koksma__store *store, const koksma__discrepancy_key *key, uint64_t seed,
                                            double value);
koksma_status koksma__store_put_image(koksma__store *store, const koksma__image_key *key, uint64_t seed,
                                      const koksma_image_error *error);
koksma_status koksma__store_put_reference(koksma__store *store, const char *scene, const char *scene_hash,
                                          const char *reference, double standard_error);

/* Values in order of the trials, the first key->trial of them; *values is the caller's. */
koksma_status koksma__store_discrepancies(koksma__store *store, const koksma__discrepancy_key *key, double **values,
                                          size_t *n);
koksma_status koksma__store_images(koksma__store *store, const koksma__image_key *key, koksma_image_error **errors,
                                   size_t *n);
/* NaN when unknown. */
koksma_status koksma__store_reference(koksma__store *store, const char *scene, const char *scene_hash,
                                      const char *reference, double *standard_error);

#endif
