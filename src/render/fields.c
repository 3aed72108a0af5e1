/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads the fields that kinds of materials, lights and shapes declare, and composite fields that several kinds share:
 * directions, colours, the axes of flat shapes, images in other files. Every error message names file, line and field
 * (json/json.h).
 */
#include "render/fields.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/lookup.h"
#include "core/vector.h"
#include "render/scene_images.h"

const char *koksma__package_hint(const char *path)
{
    static const struct {
        const char *folder, *hint;
    } hints[] = {{"/usr/share/glmark2/", "; the Debian package glmark2-data contains it"},
                 {"/usr/share/blender/", "; the Debian package blender-data contains it"}};
    for (size_t i = 0; i < sizeof hints / sizeof *hints; i++) {
        if (!strncmp(path, hints[i].folder, strlen(hints[i].folder))) {
            return hints[i].hint;
        }
    }
    return "";
}

koksma_status koksma__parse_image(koksma_scene *scene, const char *name, const field *f, const char *path,
                                  koksma_image **out)
{
    char full[KOKSMA__MAX_PATH];
    KOKSMA__JSON_FAIL_IF(!koksma__path_beside(name, path, full), f, "the path is too long");
    const koksma_status status = koksma__scene_image(scene, full, &KOKSMA__PLAIN_IMAGE, out);
    if (status == KOKSMA_MISSING) {
        koksma__fail(status, "%s%s", koksma_error_text(), koksma__package_hint(full));
    }
    return status ? koksma__json_fail_in(f, status) : KOKSMA_OK;
}

koksma_status koksma__parse_point(const field *object, const char *key, double out[3])
{
    return koksma__json_get_numbers(object, key, true, -FAR, FAR, 3, out);
}

koksma_status koksma__parse_direction(const field *object, const char *key, double out[3])
{
    KOKSMA__TRY(koksma__parse_point(object, key, out));
    KOKSMA__JSON_FAIL_IF(!koksma__normalise(out), object, "'%s' is a direction of length 0", key);
    return KOKSMA_OK;
}

koksma_status koksma__parse_colour_value(const field *node, double max, double out[3])
{
    if (koksma__json_is_array(node)) {
        return koksma__json_numbers(node, 0, max, 3, out);
    }
    KOKSMA__JSON_FAIL_IF(koksma__json_is_text(node), node, "a colour is a number, or three of red, green and blue");
    const koksma_status status = koksma__json_number(node, 0, max, &out[0]);
    out[1] = out[2] = out[0];
    return status;
}

koksma_status koksma__parse_colour(const field *object, const char *key, bool needed, double max, double out[3])
{
    field node;
    if (!needed && !koksma__json_has(object, key)) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma__json_member(object, key, &node);
    return status ? status : koksma__parse_colour_value(&node, max, out);
}

koksma_status koksma__parse_axes(const field *object, const double normal[3], double axis_u[3], double axis_v[3])
{
    double up[3] = {0, 1, 0};
    if (koksma__json_has(object, "up")) {
        KOKSMA__TRY(koksma__parse_direction(object, "up", up));
    } else if (fabs(normal[1]) > 0.999999) {
        up[1] = 0;
        up[2] = -1;
    }
    koksma__cross(up, normal, axis_u);
    KOKSMA__JSON_FAIL_IF(!koksma__normalise(axis_u), object, "'up' is along the normal");
    koksma__cross(normal, axis_u, axis_v);
    return KOKSMA_OK;
}

/* ---- Declared parameters ---------------------------------------------------------------------------------- */

static koksma_status parse_half(const field *object, const char *key, double half[2])
{
    const koksma_status status = koksma__json_get_numbers(object, key, true, 0, FAR, 2, half);
    return !status && !(half[0] > TINY && half[1] > TINY) ? koksma__json_fail(object, "zero area") : status;
}

static koksma_status parse_radius(const field *object, const char *key, double half[2])
{
    const koksma_status status = koksma__json_get_number(object, key, true, 0, FAR, &half[0]);
    half[1] = half[0];
    return !status && !(half[0] > TINY) ? koksma__json_fail(object, "zero %s", key) : status;
}

static void set_fallback(const koksma__parameter *p, double *numbers, bool *flag)
{
    const int n = p->type == KOKSMA__NUMBER ? 1 : p->type == KOKSMA__RADIUS || p->type == KOKSMA__HALF ? 2 : 3;
    if (p->type == KOKSMA__FLAG) {
        *flag = p->fallback != 0;
        return;
    }
    for (int k = 0; k < n; k++) {
        numbers[k] = p->fallback;
    }
}

static koksma_status parse_parameter(const field *object, const koksma__parameter *p, void *to)
{
    double *numbers = (double *)(void *)((char *)to + p->at);
    bool *flag = (bool *)((char *)to + p->at);
    if (p->optional && !koksma__json_has(object, p->name)) {
        set_fallback(p, numbers, flag);
        return KOKSMA_OK;
    }
    switch (p->type) {
    case KOKSMA__NUMBER:
        return koksma__json_get_number(object, p->name, true, p->low, p->high, numbers);
    case KOKSMA__COLOUR:
        return koksma__parse_colour(object, p->name, true, p->high, numbers);
    case KOKSMA__POINT:
        return koksma__parse_point(object, p->name, numbers);
    case KOKSMA__DIRECTION:
        return koksma__parse_direction(object, p->name, numbers);
    case KOKSMA__FLAG:
        return koksma__json_get_flag(object, p->name, true, flag);
    case KOKSMA__RADIUS:
        return parse_radius(object, p->name, numbers);
    case KOKSMA__HALF:
        return parse_half(object, p->name, numbers);
    }
    return KOKSMA_OK;
}

koksma_status koksma__parse_fields(const field *object, const koksma__kind *kind, const char *const *common, void *to)
{
    enum { MOST = 32 };
    const char *keys[MOST + 1] = {NULL};
    size_t n = 0;
    for (size_t i = 0; common[i]; i++) {
        keys[n++] = common[i];
    }
    for (const koksma__parameter *p = kind->parameters; p && p->name && n < MOST; p++) {
        keys[n++] = p->name;
    }
    for (size_t i = 0; kind->keys && kind->keys[i] && n < MOST; i++) {
        keys[n++] = kind->keys[i];
    }
    koksma_status status = koksma__json_only(object, keys);
    for (const koksma__parameter *p = kind->parameters; !status && p && p->name; p++) {
        status = parse_parameter(object, p, to);
    }
    return status;
}

static const char *kind_name(const void *kinds, size_t i)
{
    const koksma__kind *kind = ((const koksma__kind *const *)kinds)[i];
    return kind ? kind->is_implied ? "" : kind->name : NULL;
}

koksma_status koksma__parse_kind(const field *object, const koksma__kind *const *kinds, size_t *out)
{
    const char *name = "";
    char known[512] = "";
    const koksma_status status = koksma__json_get_text(object, "kind", true, &name);
    for (*out = 0; !status && kinds[*out]; ++*out) {
        const size_t used = strlen(known);
        if (!kinds[*out]->is_implied && !strcmp(kinds[*out]->name, name)) {
            return KOKSMA_OK;
        }
        if (!kinds[*out]->is_implied) {
            snprintf(known + used, sizeof known - used, " %s", kinds[*out]->name);
        }
    }
    char meant[KOKSMA__MEANT];
    return status ? status
                  : koksma__json_fail(object, "no kind '%s'; %sknown here:%s", name,
                                      koksma__meant(name, kind_name, kinds, meant), known);
}
