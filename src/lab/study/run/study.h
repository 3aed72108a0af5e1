/* SPDX-License-Identifier: Apache-2.0 */
/* The open study: its plan, store, scenes and references. */
#ifndef KOKSMA_STUDY_RUN_STUDY_H
#define KOKSMA_STUDY_RUN_STUDY_H

#include <koksma/image.h>
#include <koksma/koksma.h>
#include <koksma/render.h>
#include <koksma/study.h>

#include "study/plan/plan.h"
#include "study/plan/variants.h"
#include "study/store/store.h"

/* The capacity for paths in a study's folder. */
enum { KOKSMA__PATH = 1200 };

/* Writes the path of the results in a study's folder. Errors: ARGUMENT (the folder's name is too long). */
koksma_status koksma__results_path(const char *folder, char path[KOKSMA__PATH]);

/* The width and height of an image block's pictures: those of the block if it states them, otherwise the scene's. */
void koksma__block_size(const koksma__image_block *block, const koksma__study_scene *scene, int *width, int *height);

/* The parameters of a render of a study, except its scene. */
typedef struct koksma__picture {
    const char *pattern, *variant;
    bool of_reference; /* apply only the options of the variant that change the exact image */
    long long spp;
    int width, height;
    uint64_t seed;
} koksma__picture;

/* Sets *variant to the options for rendering the picture: those of the scene, changed as picture->variant says, with
   the picture's pattern, samples, size and seed. */
koksma_status koksma__picture_set(const koksma__study_scene *scene, const koksma__picture *picture,
                                  koksma__variant *variant);

/* Renders a picture. Allocates *out. */
koksma_status koksma__study_render(const koksma__study_scene *scene, const koksma__picture *picture,
                                   const koksma_run *run, koksma_image *out);

/* The seed of a job: the hash of its key, a formatted text. */
uint64_t koksma__job_seed(const char *format, ...) KOKSMA_PRINTF(1, 2);

enum { KOKSMA__REFERENCE_NAME = KOKSMA_MAX_SPEC + 128 };

/* A reference image and everything that it depends on; references.h has its functions. */
typedef struct koksma__reference_image {
    const koksma__study_scene *scene;
    const koksma__reference *reference;
    char options[KOKSMA__VARIANT_TEXT];
    int width, height;
    koksma_image image; /* its pixels are NULL until a job needs them */
    uint64_t hash;      /* of all members above `image` */
    size_t next[2];     /* a tree of the study's references by their hashes (references.c) */
} koksma__reference_image;

struct koksma__tasks;
struct koksma__task;

/* Receives the results of a run instead of the store; an audit uses it to compare results with the store. A run with
   a sink renders all references again. Every function may be called on any thread. */
typedef struct koksma__sink {
    void *context;
    /* marks the jobs that need not be done, as if they were done before */
    koksma_status (*look_up)(void *context, struct koksma__tasks *tasks);
    koksma_status (*put_job)(void *context, const struct koksma__task *task, const koksma__result *results);
    koksma_status (*put_reference)(void *context, const koksma__reference_image *reference,
                                   const koksma__reference_row *row);
} koksma__sink;

struct koksma_study {
    koksma__plan plan;
    char *folder;
    koksma__store *store;
    bool is_written;            /* whether the store was opened for a run */
    bool quick;                 /* whether blocks have their `quick` numbers of trials */
    koksma__plan_totals totals; /* of its plans, with their scenes */
    size_t n_references;
    koksma__reference_image *references;
    koksma__texts failed;     /* lines for readers on the jobs that failed alone (failed_jobs.c) */
    const koksma__sink *sink; /* NULL: results go into the store */
};

/* Opens the study of a folder by the plan in its store, for an audit. Errors: those of koksma_study_open. */
koksma_status koksma__study_open_stored(const char *folder, koksma_study **out);

/* Adds to the text of an error of a file that the study needs: if the current folder is not that of the study's last run,
   the folder of that run, because relative paths start there. Returns the status. */
koksma_status koksma__study_fail_here(koksma_study *study, koksma_status status);

/* Reopens the store for writing if it is open for reading only, which is the case for a folder that was opened
   without a plan. Errors: those of the store. */
koksma_status koksma__study_open_to_write(koksma_study *study);

/* Forgets what the study knows of the files that patterns name: their hashes, and the images of references. A run and a
   report begin with it, because files may change while a study is open. In an MPI run only rank 0 has hashes. */
void koksma__study_forget_files(koksma_study *study);

/* The open scene with the given name; NULL if there is none. */
const koksma__study_scene *koksma__study_scene_of(const koksma_study *study, const char *name);

#endif
