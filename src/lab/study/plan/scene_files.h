/* SPDX-License-Identifier: Apache-2.0 */
/* The scenes that the plans of a study name. Each file is opened once, in whatever blocks and under whatever names the
   plans name it, because a file of some kilobytes may stand for a scene of two gigabytes. */
#ifndef KOKSMA_STUDY_PLAN_SCENE_FILES_H
#define KOKSMA_STUDY_PLAN_SCENE_FILES_H

#include <koksma/render.h>

/* The scenes that were opened; zeroed at first. */
typedef struct koksma__scene_files {
    void *tree; /* of tsearch(3) */
    size_t n;
    uint64_t bytes, file_bytes; /* what all scenes take, and the files that they are from */
} koksma__scene_files;

/* Gives the scene of this name or path, which a plan names and which `files` owns. All scenes may take 4 GiB together
   or, if that is more, 64 times their files. Errors: those of koksma_scene_open; MALFORMED for more. */
koksma_status koksma__scene_files_open(koksma__scene_files *files, const char *name, koksma_scene **out);

void koksma__scene_files_fini(koksma__scene_files *files);

#endif
