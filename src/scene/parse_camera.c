/* SPDX-License-Identifier: Apache-2.0 */
/* The camera: a pinhole, or a thin lens (Potmesil & Chakravarty 1981; Cook, Porter & Carpenter 1984), and the time
   that its shutter is open. */
#include "core/vector.h"
#include "scene/parse.h"

static koksma_status parse_lens(const field *f, koksma__camera *camera)
{
    const char *map = "concentric";
    koksma_status status = koksma__json_get_number(f, "lens_radius", false, 0, FAR, &camera->lens_radius);
    status = status ? status : koksma__json_get_text(f, "lens_map", false, &map);
    if (status) {
        return status;
    }
    camera->focus_distance = 1;
    if (camera->lens_radius > 0 || koksma__json_has(f, "focus_distance")) {
        status = koksma__json_get_number(f, "focus_distance", true, TINY, FAR, &camera->focus_distance);
    }
    camera->lens_map = koksma__lens_map(map);
    KOKSMA__JSON_FAIL_IF(!status && !camera->lens_map, f, "no lens_map '%s'; it takes concentric or polar", map);
    return status;
}

static koksma_status parse_shutter(const field *f, koksma__camera *camera)
{
    koksma_status status = KOKSMA_OK;
    camera->shutter[1] = 1;
    if (koksma__json_has(f, "shutter")) {
        status = koksma__json_get_numbers(f, "shutter", true, 0, 1, 2, camera->shutter);
    }
    KOKSMA__JSON_FAIL_IF(!status && camera->shutter[0] > camera->shutter[1], f, "the shutter closes before it opens");
    return !status && koksma__json_has(f, "motion") ? koksma__parse_point(f, "motion", camera->motion) : status;
}

koksma_status koksma__parse_camera(const field *root, koksma__camera *camera)
{
    field f;
    double target[3], up[3] = {0, 1, 0}, fov_deg = 0;
    koksma_status status = koksma__json_member(root, "camera", &f);
    status = status ? status
                    : koksma__json_only(&f, KEYS("eye", "target", "up", "fov_deg", "lens_radius", "focus_distance",
                                                 "lens_map", "shutter", "motion"));
    status = status ? status : koksma__parse_point(&f, "eye", camera->eye);
    status = status ? status : koksma__parse_point(&f, "target", target);
    status = status ? status : koksma__json_get_number(&f, "fov_deg", true, 0.01, 179, &fov_deg);
    if (!status && koksma__json_has(&f, "up")) {
        status = koksma__parse_direction(&f, "up", up);
    }
    status = status ? status : parse_lens(&f, camera);
    status = status ? status : parse_shutter(&f, camera);
    if (status) {
        return status;
    }
    camera->fov_rad = fov_deg * TURN / 360;
    koksma__subtract(target, camera->eye, camera->forward);
    KOKSMA__JSON_FAIL_IF(!koksma__normalise(camera->forward), &f, "'eye' and 'target' are one point");
    koksma__cross(camera->forward, up, camera->right);
    KOKSMA__JSON_FAIL_IF(!koksma__normalise(camera->right), &f, "'up' is along the line of sight");
    koksma__cross(camera->forward, camera->right, camera->down);
    return KOKSMA_OK;
}
