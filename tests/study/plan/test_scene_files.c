/* SPDX-License-Identifier: Apache-2.0 */
/* The scenes of plans: each name is opened once, and all together have a limit of memory. */
#include "study/plan/plan.h"
#include "test.h"

static const koksma__study_scene *opened(koksma__scene_files *files, const char *name)
{
    assert_ok(koksma__scene_files_open(files, name));
    const koksma__study_scene *s = koksma__scene_files_find(files, name);
    assert_non_null(s);
    assert_string_equal(s->name, name);
    return s;
}

TEST_CASE(a_name_is_opened_once)
{
    koksma__scene_files files = {0};
    assert_null(koksma__scene_files_find(&files, "ball"));
    const koksma__study_scene *ball = opened(&files, "ball");
    assert_true(opened(&files, "checker")->scene != ball->scene);
    assert_ptr_equal(opened(&files, "ball"), ball);
    assert_int_equal(koksma__scene_files_open(&files, "bal"), KOKSMA_UNKNOWN);
    assert_non_null(strstr(koksma_error_text(), "did you mean 'ball'"));
    assert_null(koksma__scene_files_find(&files, "bal"));
    koksma__scene_files_fini(&files);
}

TEST_CASE(all_have_a_limit)
{
    koksma__scene_files files = {.bytes = (uint64_t)4 << 30};
    assert_int_equal(koksma__scene_files_open(&files, "ball"), KOKSMA_MALFORMED);
    assert_non_null(strstr(koksma_error_text(), "ball: with it the scenes of the study take more than 4 GiB"));
    koksma__scene_files_fini(&files);
    files = (koksma__scene_files){.bytes = (uint64_t)4 << 30, .file_bytes = ((uint64_t)4 << 30) / 60};
    assert_ok(koksma__scene_files_open(&files, "ball")); /* large files may stand for large scenes */
    koksma__scene_files_fini(&files);
}
