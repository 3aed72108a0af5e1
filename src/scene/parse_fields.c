/* SPDX-License-Identifier: Apache-2.0 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/vector.h"
#include "image/formats.h"
#include "scene/parse.h"

const char *koksma__package_hint(const char *path)
{
    static const struct {
        const char *folder, *hint;
    } hints[] = {{"/usr/share/glmark2/", "; Debian's package glmark2-data has it"},
                 {"/usr/share/blender/", "; Debian's package blender-data has it"}};
    for (size_t i = 0; i < sizeof hints / sizeof *hints; i++) {
        if (!strncmp(path, hints[i].folder, strlen(hints[i].folder))) {
            return hints[i].hint;
        }
    }
    return "";
}

koksma_status koksma__parse_image(const char *name, const field *f, const char *path, koksma_image **out)
{
    char full[KOKSMA__MAX_PATH];
    if (!koksma__path_beside(name, path, full)) {
        return koksma__json_fail(f, "the path is too long");
    }
    *out = calloc(1, sizeof **out);
    if (!*out) {
        return koksma__fail_memory(sizeof **out);
    }
    koksma_status status = koksma_image_read(full, *out);
    status = status ? status : koksma__image_check(*out, full);
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
    koksma_status status = koksma__parse_point(object, key, out);
    if (!status && !koksma__normalise(out)) {
        return koksma__json_fail(object, "'%s' is a direction of length 0", key);
    }
    return status;
}

koksma_status koksma__parse_colour_value(const field *node, double max, double out[3])
{
    if (koksma__json_is_array(node)) {
        return koksma__json_numbers(node, 0, max, 3, out);
    }
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
        const koksma_status status = koksma__parse_direction(object, "up", up);
        if (status) {
            return status;
        }
    } else if (fabs(normal[1]) > 0.999999) {
        up[1] = 0;
        up[2] = -1;
    }
    koksma__cross(up, normal, axis_u);
    if (!koksma__normalise(axis_u)) {
        return koksma__json_fail(object, "'up' is along the normal");
    }
    koksma__cross(normal, axis_u, axis_v);
    return KOKSMA_OK;
}

koksma_status koksma__parse_half(const field *object, double half[2])
{
    koksma_status status = koksma__json_get_numbers(object, "half", true, 0, FAR, 2, half);
    if (!status && !(half[0] > TINY && half[1] > TINY)) {
        return koksma__json_fail(object, "zero area");
    }
    return status;
}

koksma_status koksma__parse_radius(const field *object, double half[2])
{
    koksma_status status = koksma__json_get_number(object, "radius", true, 0, FAR, &half[0]);
    half[1] = half[0];
    if (!status && !(half[0] > TINY)) {
        return koksma__json_fail(object, "zero radius");
    }
    return status;
}

koksma_status koksma__parse_kind(const field *object, const char *kinds, const char **out)
{
    const koksma_status status = koksma__json_get_text(object, "kind", true, out);
    if (status) {
        return status;
    }
    const size_t length = strlen(*out);
    for (const char *at = kinds; length && (at = strstr(at, *out)); at += length) {
        if ((at == kinds || at[-1] == ' ') && (at[length] == ' ' || !at[length]) && !strchr(*out, ' ')) {
            return KOKSMA_OK;
        }
    }
    return koksma__json_fail(object, "no kind '%s'; known here: %s", *out, kinds);
}
