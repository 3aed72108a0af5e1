/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Opens and closes scenes. A scene is opened by the name of a scene that is embedded in the library, from a JSON
 * file, from another renderer's file, or from a mesh file.
 */
#include "scene/scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/files.h"
#include "core/hash.h"
#include "core/lookup.h"
#include "core/status.h"
#include "meshes/mesh_file.h"
#include "render/description_build.h"
#include "render/one_image.h"
#include "render/scene_images.h"
#include "scene/mitsuba_reader.h"
#include "scene/pbrt.h"
#include "scene/scenes_embedded.h"

enum { N_SHIPPED = sizeof embedded_texts / sizeof *embedded_texts };

const char *koksma_scene_name_at(size_t i)
{
    return i < N_SHIPPED ? embedded_texts[i].name : NULL;
}

static const char *shipped_name(const void *table, size_t i)
{
    (void)table;
    return koksma_scene_name_at(i);
}

/* Allocates an empty scene and the cache that rendering needs. */
static koksma_status new_scene(koksma_scene **out)
{
    koksma_scene *scene = *out = calloc(1, sizeof *scene);
    koksma__scene_cache *cache = calloc(1, sizeof *cache);
    if (!scene || !cache || pthread_mutex_init(&cache->lock, NULL)) {
        free(scene);
        free(cache);
        *out = NULL;
        return koksma__fail_memory(sizeof *scene + sizeof *cache);
    }
    scene->cache = cache;
    return KOKSMA_OK;
}

static koksma_status close_failed(koksma_status status, koksma_scene **out)
{
    if (status) {
        koksma_scene_close(*out);
        *out = NULL;
    }
    return status;
}

koksma_status koksma__scene_open_text(const char *name, const char *text, size_t size, koksma_scene **out)
{
    KOKSMA__TRY(new_scene(out));
    (*out)->hash = koksma__hash(text, size);
    return close_failed(koksma__scene_parse(name, text, size, *out), out);
}

static _Thread_local bool refuses_unknown;

bool koksma_scene_refuse_unknown(bool refuse)
{
    const bool before = refuses_unknown;
    refuses_unknown = refuse;
    return before;
}

/* Closes a scene with unsupported parts and fails, if the options refuse it. */
static koksma_status refuse_unknown(koksma_scene **out)
{
    char text[512];
    if (!refuses_unknown || !koksma__scene_unread(*out, text, sizeof text)) {
        return KOKSMA_OK;
    }
    return close_failed(koksma__fail(KOKSMA_MALFORMED, "%s; the options refuse scenes with unsupported parts", text),
                        out);
}

/* ---- Scenes of other renderers: the ending of the file's name selects the reader -------------------------- */

/* A number in the hash by which stored studies find a scene; it is raised when a change of the code makes another
   scene from the same files. */
enum { READER_REVISION = 9 };

static bool is_pbrt(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && !strcmp(dot, ".pbrt");
}

/* Whether a file with this name (.pbrt, .xml) is a scene of another renderer. */
static bool is_import_file(const char *path)
{
    const char *dot = strrchr(path, '.');
    return is_pbrt(path) || (dot && !strcmp(dot, ".xml"));
}

/* Returns the status of reading a scene's text as the format `as`, an ending of files' names. A failure names the format
   that the text begins as, if it is another: XML, JSON, glTF with its "asset", or pbrt's directives and comments. */
static koksma_status check_format(koksma_status status, const char *as, const char *path, const char *text)
{
    const char first = text[strspn(text, " \t\r\n")];
    const char *meant = first == '<'                                                   ? ".xml"
                        : first == '{' && strstr(text, "\"asset\"")                    ? ".gltf"
                        : first == '{'                                                 ? ".json"
                        : first == '#' || ((first | 32) >= 'a' && (first | 32) <= 'z') ? ".pbrt"
                                                                                       : as;
    KOKSMA__FAIL_IF(status == KOKSMA_MALFORMED && strcmp(as, meant) != 0, KOKSMA_MALFORMED,
                    "scene '%s': its text is no %s but looks like %s; name it so", path, as, meant);
    return status;
}

static koksma_status read_import_text(const char *path, const char *text, size_t size, koksma_scene *scene)
{
    koksma__import im = {.scene = scene, .path = path, .n_files = 1, .held = size};
    KOKSMA__TRY(koksma__scene_begin(scene, path));
    scene->is_model = true;
    scene->hash = koksma__hash(text, size) + READER_REVISION;
    const koksma_status status = (is_pbrt(path) ? koksma__pbrt_read : koksma__mitsuba_read)(&im, text, size);
    koksma__import_fini(&im);
    if (!status) {
        koksma__scene_finish(scene);
    }
    return status;
}

/* Reads a scene of another renderer into an empty scene. */
static koksma_status read_import(const char *path, koksma__named by, koksma_scene *scene)
{
    unsigned char *bytes;
    size_t size;
    KOKSMA__TRY(koksma__read_file(path, KOKSMA__FILE_SCENE, by, koksma__check_text, &bytes, &size));
    const koksma_status status = check_format(read_import_text(path, (const char *)bytes, size, scene),
                                              is_pbrt(path) ? ".pbrt" : ".xml", path, (const char *)bytes);
    free(bytes);
    return status;
}

/* Opens a scene of another renderer or a model, by its reader. */
static koksma_status open_foreign(const char *path, koksma__named by,
                                  koksma_status (*read)(const char *path, koksma__named by, koksma_scene *scene),
                                  koksma_scene **out)
{
    const koksma_status status = new_scene(out);
    KOKSMA__TRY(status ? status : close_failed(read(path, by, *out), out));
    return refuse_unknown(out);
}

static bool is_path(const char *text)
{
    const char *dot = strrchr(text, '.');
    return koksma__is_mesh_file(text) || is_import_file(text) || strchr(text, '/') || (dot && !strcmp(dot, ".json"));
}

/* Endings of scene files that other programs write as glTF, too. */
static const char *const exported[] = {".blend", ".fbx", ".usd", ".usda", ".usdc", ".usdz", ".dae",
                                       ".stl",   ".3ds", ".max", ".ma",   ".mb",   ".c4d",  ".hip"};

koksma_status koksma__scene_open(const char *name_or_path, koksma__named by, koksma_scene **out)
{
    KOKSMA__REQUIRE(name_or_path, out);
    *out = NULL;
    KOKSMA__FAIL_IF(!name_or_path, KOKSMA_ARGUMENT, "the name of the scene is missing");
    for (size_t i = 0; i < N_SHIPPED; i++) {
        if (!strcmp(embedded_texts[i].name, name_or_path)) {
            return koksma__scene_open_text(name_or_path, embedded_texts[i].text, embedded_texts[i].size, out);
        }
    }
    if (!is_path(name_or_path)) {
        const char *dot = strrchr(name_or_path, '.');
        for (size_t i = 0; dot && i < sizeof exported / sizeof *exported; i++) {
            KOKSMA__FAIL_IF(!strcmp(dot, exported[i]), KOKSMA_MALFORMED,
                            "no scene '%s': %s files are not read; export the scene as glTF (.glb, .gltf)",
                            name_or_path, dot);
        }
        const koksma_status status =
            koksma__fail_unknown("scene", name_or_path, shipped_name, NULL,
                                 "'koksma list scenes' names them, and a scene's file ends in .json, .pbrt, .xml or "
                                 "as a model, such as .obj, .ply or .gltf");
        return koksma__is_file(name_or_path) ? KOKSMA_MALFORMED : status;
    }
    if (koksma__is_mesh_file(name_or_path)) {
        return open_foreign(name_or_path, by, koksma__model_parse, out);
    }
    if (is_import_file(name_or_path)) {
        return open_foreign(name_or_path, by, read_import, out);
    }
    unsigned char *bytes;
    size_t size;
    koksma_status status = koksma__read_file(name_or_path, KOKSMA__FILE_SCENE, by, koksma__check_text, &bytes, &size);
    if (!status) {
        status = koksma__scene_open_text(name_or_path, (const char *)bytes, size, out);
        status = check_format(status, ".json", name_or_path, (const char *)bytes);
        free(bytes);
    }
    return status;
}

koksma_status koksma_scene_open(const char *name_or_path, koksma_scene **out)
{
    return koksma__scene_open(name_or_path, KOKSMA__BY_USER, out);
}

void koksma__scene_fini(koksma_scene *scene)
{
    koksma__scene_images_fini(scene);
    for (size_t i = 0; i < scene->n_meshes; i++) {
        koksma__mesh_fini(&scene->meshes[i]);
    }
    free(scene->meshes);
    koksma__names_fini(&scene->mesh_names);
    koksma__names_fini(&scene->mesh_files.known);
    free(scene->placements);
    free(scene->notes);
    free(scene->materials);
    free(scene->shapes);
    free(scene->lights);
    free(scene->unknown);
}

void koksma_scene_close(koksma_scene *scene)
{
    if (scene) {
        if (scene->cache->made) {
            scene->cache->release(scene->cache->made);
        }
        pthread_mutex_destroy(&scene->cache->lock);
        free(scene->cache);
        koksma__scene_fini(scene);
        free(scene);
    }
}

const char *koksma_scene_title(const koksma_scene *scene)
{
    KOKSMA__REQUIRE_OR(NULL, scene);
    return scene->title;
}

uint64_t koksma_scene_hash(const koksma_scene *scene)
{
    KOKSMA__REQUIRE_OR(0, scene);
    return koksma__scene_hash(scene);
}
