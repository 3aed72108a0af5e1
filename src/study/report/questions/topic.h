/* SPDX-License-Identifier: Apache-2.0 */
/* A question of a plan with its blocks, and the answers: one file of questions/ for each line of questions.def. */
#ifndef KOKSMA_STUDY_REPORT_QUESTIONS_TOPIC_H
#define KOKSMA_STUDY_REPORT_QUESTIONS_TOPIC_H

#include "study/report/document.h"
#include "study/run/study.h"

typedef struct koksma__topic {
    const char *id;                                  /* in the names of the CSV files */
    const koksma__discrepancy_block **discrepancies; /* as many as the plan has at most */
    const koksma__image_block **images;
    size_t n_discrepancies, n_images;
    size_t n_groups; /* of scenes, of the question */
    const koksma__scene_group *groups;
} koksma__topic;

/* Appends the answer; nothing where the blocks have not what it takes. */
#define QUESTION(name, fields, heading, rows)                                                                        \
    koksma_status koksma__answer_##name(koksma_study *study, koksma__document *d, const koksma__topic *topic);
#include "study/plan/questions.def"
#undef QUESTION

#endif
