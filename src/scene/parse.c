/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Scene files: the root object and its lists, in the order that references need (materials before shapes before
 * lights), as docs/scenes.md says. Every failure names file, line and field.
 */
#include "scene/parse.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static koksma_status parse_image(const field *root, koksma_scene *scene)
{
    field image;
    long long width = 128, height = 96;
    koksma_status status = KOKSMA_OK;
    if (koksma__json_has(root, "image")) {
        status = koksma__json_member(root, "image", &image);
        status = status ? status : koksma__json_only(&image, KEYS("width", "height"));
        status = status ? status : koksma__json_get_whole(&image, "width", true, 1, KOKSMA_MAX_IMAGE_SIDE, &width);
        status = status ? status : koksma__json_get_whole(&image, "height", true, 1, KOKSMA_MAX_IMAGE_SIDE, &height);
    }
    scene->width = (int)width;
    scene->height = (int)height;
    return status;
}

/* The list `key`; room for its items (size bytes each) in *out when out is given. */
static koksma_status open_list(const field *root, const char *key, size_t max, size_t size, void *out, field *list,
                               size_t *n)
{
    koksma_status status = koksma__json_member(root, key, list);
    status = status ? status : koksma__json_length(list, max, n);
    if (status || !out) {
        return status;
    }
    void *items = calloc(*n + 1, size);
    KOKSMA__REQUIRE_MEMORY(items, *n * size);
    memcpy(out, &items, sizeof items);
    return KOKSMA_OK;
}

static koksma_status parse_lists(const char *name, const field *root, koksma_scene *scene)
{
    field list, item;
    size_t n = 0;
    scene->lights = calloc(KOKSMA__MAX_LIGHTS, sizeof *scene->lights); /* meshes bring some, too */
    KOKSMA__REQUIRE_MEMORY(scene->lights, KOKSMA__MAX_LIGHTS * sizeof *scene->lights);
    koksma_status status =
        open_list(root, "materials", KOKSMA__MAX_MATERIALS, sizeof *scene->materials, &scene->materials, &list, &n);
    for (size_t i = 0; !status && i < n; i++) {
        item = koksma__json_item(&list, i);
        status = koksma__parse_material(name, &item, scene);
    }
    status = status ? status : open_list(root, "shapes", KOKSMA__MAX_SHAPES, 0, NULL, &list, &n);
    for (size_t i = 0; !status && i < n; i++) {
        item = koksma__json_item(&list, i);
        status = koksma__parse_shape(name, &item, scene);
    }
    if (status || !koksma__json_has(root, "lights")) {
        return status;
    }
    status = open_list(root, "lights", KOKSMA__MAX_LIGHTS, 0, NULL, &list, &n);
    for (size_t i = 0; !status && i < n; i++) {
        item = koksma__json_item(&list, i);
        status = koksma__parse_light(name, &item, scene);
    }
    return status;
}

static koksma_status parse_root(const char *name, const field *root, koksma_scene *scene)
{
    const char *title = "", *note;
    koksma_status status = koksma__json_only(root, KEYS("title", "note", "image", "camera", "background", "ambient",
                                                        "clamp", "materials", "shapes", "lights"));
    status = status ? status : koksma__json_get_text(root, "title", false, &title);
    snprintf(scene->title, sizeof scene->title, "%s", title);
    scene->clamp = INFINITY;
    status = status ? status : koksma__json_get_text(root, "note", false, &note);
    status = status ? status : parse_image(root, scene);
    status = status ? status : koksma__parse_camera(root, &scene->camera);
    status = status ? status : koksma__parse_colour(root, "background", false, BRIGHT, scene->background);
    status = status ? status : koksma__parse_colour(root, "ambient", false, BRIGHT, scene->ambient);
    status = status ? status : koksma__json_get_number(root, "clamp", false, TINY, BRIGHT, &scene->clamp);
    status = status ? status : parse_lists(name, root, scene);
    if (!status) {
        koksma__scene_finish(scene);
    }
    return status;
}

koksma_status koksma__scene_parse(const char *name, const char *text, size_t size, koksma_scene *scene)
{
    koksma__json *document;
    koksma_status status = koksma__json_open("scene", name, text, size, &document);
    if (!status) {
        const field root = koksma__json_root(document);
        status = parse_root(name, &root, scene);
    }
    koksma__json_close(document);
    return status;
}
