/* SPDX-License-Identifier: Apache-2.0 */
/* Plans, scenes and glTF files with every field removed, and replaced by values of each kind, one at a time: each is read,
   or refused with one line that names the file. The files are those of fuzz/corpus. A field at the same place of several
   files is damaged in the first of them, or the first two. */
#include <dirent.h>
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

#include "meshes/readers.h"
#include "scene/scene.h"
#include "study/plan/plan_read.h"
#include "test.h"

typedef koksma_status (*reader)(const char *text, size_t size);

typedef struct walk {
    reader read;
    const char *name; /* with which every error begins */
    json_t *root;
    json_t *seen; /* for each place, in how many files it was damaged */
    size_t damaged;
} walk;

static koksma_status read_plan(const char *text, size_t size)
{
    koksma__plan plan = {0};
    const koksma__plan_trials trials = {0};
    const koksma_status status = koksma__plan_parse("p", text, size, &trials, &plan);
    koksma__plan_fini(&plan);
    return status;
}

static koksma_status read_scene(const char *text, size_t size)
{
    koksma_scene *scene;
    const koksma_status status = koksma__scene_open_text("p", text, size, &scene);
    koksma_scene_close(scene);
    return status;
}

static koksma_status read_gltf(const char *text, size_t size)
{
    koksma__mesh_file file = {.path = "p.gltf"};
    const koksma_status status = koksma__gltf_read((const unsigned char *)text, size, &file);
    koksma__mesh_file_fini(&file);
    return status;
}

static void read_damaged(walk *w)
{
    char *text = json_dumps(w->root, JSON_COMPACT);
    assert_non_null(text);
    const koksma_status status = w->read(text, strlen(text));
    if (status) {
        const char *error = koksma_error_text();
        assert_that(strncmp(error, w->name, strlen(w->name)) == 0 && !strchr(error, '\n'), "\"%s\" for %s", error,
                    text);
        assert_true(status == KOKSMA_MALFORMED || status == KOKSMA_MISSING || status == KOKSMA_ARGUMENT);
    }
    free(text);
    w->damaged++;
}

/* Values of every kind, and numbers and texts that no field takes. */
static json_t *wrong_value(size_t i)
{
    static const char *const values[] = {
        "null",      "true", "\"\"", "\"\\u00e9 %s\"", "[]",    "{}",  "[[{}]]",
        "{\"\": 0}", "0",    "-1",   "-1e300",         "1e300", "0.5", "9223372036854775807"};
    return i < sizeof values / sizeof *values ? json_loads(values[i], JSON_DECODE_ANY, NULL) : NULL;
}

static void damage(walk *w, json_t *parent, const char *place);

/* Damages the value at `key`, or at index `item` where key is NULL, and all below it. */
static void damage_value(walk *w, json_t *parent, const char *key, size_t item, const char *place)
{
    json_t *value = json_incref(key ? json_object_get(parent, key) : json_array_get(parent, item));
    const json_int_t seen = json_integer_value(json_object_get(w->seen, place));
    json_object_set_new(w->seen, place, json_integer(seen + 1));
    json_t *wrong;
    for (size_t i = 0; seen < test_repeats(2, 1) && (wrong = wrong_value(i)); i++) {
        if (key) {
            json_object_set_new(parent, key, wrong);
        } else {
            json_array_set_new(parent, item, wrong);
        }
        read_damaged(w);
    }
    if (key) {
        json_object_del(parent, key);
        if (seen < test_repeats(2, 1)) {
            read_damaged(w);
        }
        json_object_set(parent, key, value);
    } else {
        json_array_remove(parent, item);
        if (seen < test_repeats(2, 1)) {
            read_damaged(w);
        }
        json_array_insert(parent, item, value);
    }
    damage(w, value, place);
    json_decref(value);
}

static void damage(walk *w, json_t *parent, const char *place)
{
    char below[512];
    json_t *names = json_array(); /* the object's own iterators end where it changes */
    const char *key;
    json_t *value;
    json_object_foreach(parent, key, value)
    {
        json_array_append_new(names, json_string(key));
    }
    for (size_t i = 0; i < json_array_size(names); i++) {
        key = json_string_value(json_array_get(names, i));
        snprintf(below, sizeof below, "%s.%s", place, key);
        damage_value(w, parent, key, 0, below);
    }
    json_decref(names);
    for (size_t i = 0; i < json_array_size(parent) && i < 2; i++) {
        snprintf(below, sizeof below, "%s[]", place);
        damage_value(w, parent, NULL, i, below);
    }
}

static void walk_files(const char *folder, const char *ending, reader read, const char *name)
{
    struct dirent **entries;
    walk w = {.read = read, .name = name, .seen = json_object()};
    const int n = scandir(folder, &entries, NULL, alphasort);
    assert_true(n > 0);
    for (int i = 0; i < n; i++) {
        char path[4096];
        const char *end = strrchr(entries[i]->d_name, '.');
        snprintf(path, sizeof path, "%s/%s", folder, entries[i]->d_name);
        if (end && !strcmp(end, ending) && (w.root = json_load_file(path, 0, NULL))) {
            damage(&w, w.root, "");
            json_decref(w.root);
        }
        free(entries[i]);
    }
    free(entries);
    assert_true(w.damaged > 1000);
    json_decref(w.seen);
}

TEST_CASE(plans)
{
    walk_files(KOKSMA_TESTS "/../fuzz/corpus/plan", ".json", read_plan, "plan 'p': line ");
}

TEST_CASE(scenes)
{
    walk_files(KOKSMA_TESTS "/../fuzz/corpus/scene", ".json", read_scene, "scene 'p': line ");
}

TEST_CASE(gltf)
{
    walk_files(KOKSMA_TESTS "/../fuzz/corpus/gltf_check", ".gltf", read_gltf, "");
}
