/* SPDX-License-Identifier: Apache-2.0 */
/* What a report says of the metric that ranks patterns: its name, in how many images it was evaluated, and where a few
   pixels carry most of the error. */
#ifndef KOKSMA_STUDY_REPORT_METRIC_WORDS_H
#define KOKSMA_STUDY_REPORT_METRIC_WORDS_H

#include "study/report/means.h"
#include "study/report/questions/topic.h"

typedef struct koksma__metric_facts {
    size_t images, measured; /* numbers of images of the topic, and of those with a row of the metric */
    size_t means,
        few; /* numbers of means with that metric, and of those in which a few pixels carry most of the error */
    /* the mean in which they carry most */
    const char *scene, *variant, *pattern;
    long long spp;
    koksma__metric_means worst;
} koksma__metric_facts;

/* Reads all means of the topic's images. */
koksma_status koksma__metric_facts_find(koksma_study *study, const koksma__topic *topic, koksma__metric_facts *out);

/* Writes a paragraph that names the metric; and, where they apply, one on images without it and a warning of means that a
   few pixels decide. */
void koksma__metric_say(koksma__document *d, const char *metric, const koksma__metric_facts *facts);

#endif
