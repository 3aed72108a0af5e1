/* SPDX-License-Identifier: Apache-2.0 */
/* A question of a plan with its blocks, and the functions that answer questions: one file of questions/ for each
   line of questions.def. */
#ifndef KOKSMA_STUDY_REPORT_QUESTIONS_TOPIC_H
#define KOKSMA_STUDY_REPORT_QUESTIONS_TOPIC_H

#include "study/report/document.h"
#include "study/run/study.h"

typedef struct koksma__topic {
    const char *id;                                  /* id of the question, part of the names of its CSV files */
    const koksma__discrepancy_block **discrepancies; /* has capacity for all blocks of the plan */
    const koksma__image_block **images;
    size_t n_discrepancies, n_images;
    const char *metric; /* canonical spec of the metric by which images are compared */
    size_t n_groups;    /* number of the question's groups of scenes */
    const koksma__scene_group *groups;
} koksma__topic;

/* Declares the function that appends the answer to a kind of question; it appends nothing if the blocks lack what
   the answer needs. */
#define QUESTION(name, fields, heading, rows)                                                                        \
    koksma_status koksma__answer_##name(koksma_study *study, koksma__document *d, const koksma__topic *topic);
#include "study/plan/questions.def"
#undef QUESTION

#endif
