/* SPDX-License-Identifier: Apache-2.0 */
/* What koksma_rank_patterns and koksma_rank_to_error begin with. */
#ifndef KOKSMA_STUDY_RANKING_RANKING_SETUP_H
#define KOKSMA_STUDY_RANKING_RANKING_SETUP_H

#include "study/plan/variants.h"
#include "study/run/run_control.h"
#include "study/run/study.h"

/* Checks the options, writes the canonical text of the settings of all images, and opens the scene, which the caller closes
   by koksma_scene_close(scene->scene), also after an error. Errors: those of koksma_rank_patterns. */
koksma_status koksma__rank_open(const koksma_rank_options *options, koksma__run_control *control,
                                koksma__study_scene *scene, char variant[KOKSMA__VARIANT_TEXT]);

#endif
