/* SPDX-License-Identifier: Apache-2.0 */
/* The scenes of plans: one file is one scene under all its names, but a link in another folder, where the paths in the
   scene lead elsewhere, or with an end that says another format, is a scene of its own. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "study/plan/plan.h"
#include "test.h"

static const char scene[] =
    "{\"camera\": {\"eye\": [0, 1, 0], \"target\": [0, 1, -1], \"fov_deg\": 20}, \"background\": "
    "0.5, \"ambient\": 1, \"materials\": [], \"shapes\": []}";

static void write_text(const char *path, const char *text)
{
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    assert_true(fputs(text, f) >= 0 && !fclose(f));
}

static int enter_folder(void **state)
{
    char folder[] = "/tmp/koksma-scenes-XXXXXX";
    assert_non_null(mkdtemp(folder));
    assert_int_equal(chdir(folder), 0);
    *state = strdup(folder);
    return !*state;
}

static int leave_folder(void **state)
{
    static const char *const names[] = {"a.json", "link.json", "hard.json", "b/a.json", "bad.json", "a.pbrt"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        unlink(names[i]);
    }
    rmdir("b");
    rmdir(*state);
    free(*state);
    return 0;
}

static koksma_scene *opened(koksma__scene_files *files, const char *name)
{
    koksma_scene *out;
    assert_ok(koksma__scene_files_open(files, name, &out));
    assert_non_null(out);
    return out;
}

static void a_file_is_one_scene(void **state)
{
    koksma__scene_files files = {0};
    char path[128];
    write_text("a.json", scene);
    assert_int_equal(mkdir("b", 0700), 0);
    assert_int_equal(symlink("a.json", "link.json"), 0);
    assert_int_equal(link("a.json", "hard.json"), 0);
    snprintf(path, sizeof path, "%s/a.json", (char *)*state);
    koksma_scene *first = opened(&files, "a.json");
    assert_ptr_equal(opened(&files, "a.json"), first);
    assert_ptr_equal(opened(&files, "./b/.././a.json"), first);
    assert_ptr_equal(opened(&files, path), first);
    assert_ptr_equal(opened(&files, "link.json"), first);
    assert_ptr_equal(opened(&files, "hard.json"), first);
    assert_int_equal(files.n, 1);

    koksma_scene *other;
    assert_int_equal(link("a.json", "b/a.json"), 0);
    assert_true(opened(&files, "b/a.json") != first);
    assert_int_equal(symlink("a.json", "a.pbrt"), 0);
    assert_int_equal(koksma__scene_files_open(&files, "a.pbrt", &other), KOKSMA_MALFORMED);
    assert_null(other);
    assert_true(opened(&files, "ball") != first);
    assert_ptr_equal(opened(&files, "ball"), opened(&files, "ball"));
    assert_int_equal(files.n, 4);
    koksma__scene_files_fini(&files);
}

/* What cannot be opened keeps its reason, also when the file is repaired meanwhile. */
static void a_reason_is_kept(void **state)
{
    (void)state;
    koksma__scene_files files = {0};
    koksma_scene *out;
    char reason[1024];
    write_text("bad.json", "{");
    assert_int_equal(koksma__scene_files_open(&files, "./bad.json", &out), KOKSMA_MALFORMED);
    snprintf(reason, sizeof reason, "%s", koksma_error_text());
    assert_non_null(strstr(reason, "./bad.json"));
    write_text("bad.json", scene);
    assert_int_equal(koksma__scene_files_open(&files, "bad.json", &out), KOKSMA_MALFORMED);
    assert_string_equal(koksma_error_text(), reason);
    assert_int_equal(koksma__scene_files_open(&files, "bal", &out), KOKSMA_UNKNOWN);
    assert_int_equal(koksma__scene_files_open(&files, "bal", &out), KOKSMA_UNKNOWN);
    assert_non_null(strstr(koksma_error_text(), "did you mean 'ball'"));
    koksma__scene_files_fini(&files);
}

static void all_have_a_limit(void **state)
{
    (void)state;
    koksma__scene_files files = {.bytes = (uint64_t)4 << 30};
    koksma_scene *out;
    assert_int_equal(koksma__scene_files_open(&files, "ball", &out), KOKSMA_MALFORMED);
    assert_non_null(strstr(koksma_error_text(), "ball: with it the scenes of the study take more than 4 GiB"));
    koksma__scene_files_fini(&files);
    files = (koksma__scene_files){.bytes = (uint64_t)4 << 30, .file_bytes = ((uint64_t)4 << 30) / 60};
    assert_ok(koksma__scene_files_open(&files, "ball", &out)); /* large files may stand for large scenes */
    koksma__scene_files_fini(&files);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_file_is_one_scene, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(a_reason_is_kept, enter_folder, leave_folder),
        cmocka_unit_test(all_have_a_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
