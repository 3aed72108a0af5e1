/* SPDX-License-Identifier: Apache-2.0 */
/* box: six rectangles that face outwards, rotated about y by angle_deg. */
#include "core/vector.h"
#include "render/description_build.h"
#include "render/shapes/shapes.h"

/* Makes the side with number `side` (0 to 5: -x +x -y +y -z +z of the box's axes), a rectangle with the axes that a
   rectangle with this normal has by default: v is the box's y, or -z for top and bottom; u = v x normal. */
static void make_side(koksma__shape *shape, double axes[3][3], const double half[3], int side)
{
    const int along = side / 2;
    const double sign = side % 2 ? 1 : -1;
    shape->type = &KOKSMA__SHAPE(rectangle);
    for (int k = 0; k < 3; k++) {
        shape->centre[k] += sign * half[along] * axes[along][k];
        shape->normal[k] = sign * axes[along][k];
        shape->axis_v[k] = along == 1 ? -axes[2][k] : axes[1][k];
    }
    koksma__cross(shape->axis_v, shape->normal, shape->axis_u);
    shape->half[0] = half[along == 0 ? 2 : 0];
    shape->half[1] = half[along == 1 ? 2 : 1];
}

static koksma_status parse(const char *name, const field *f, koksma_scene *scene, koksma__shape *box)
{
    double half[3], angle_deg = 0;
    koksma_status status = koksma__json_get_numbers(f, "half", true, 0, FAR, 3, half);
    (void)name;
    status = status ? status : koksma__json_get_number(f, "angle_deg", false, -360, 360, &angle_deg);
    KOKSMA__JSON_FAIL_IF(!status && !(half[0] > TINY && half[1] > TINY && half[2] > TINY), f, "zero volume");
    status = status ? status : koksma__shape_motion(f, true, box);
    const double c = cos(angle_deg * TURN / 360), s = sin(angle_deg * TURN / 360);
    double axes[3][3] = {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
    for (int side = 0; !status && side < 6; side++) {
        koksma__shape *shape = NULL;
        status = koksma__scene_add_shape(scene, box, &shape);
        if (status) {
            return koksma__json_fail_in(f, status);
        }
        make_side(shape, axes, half, side);
    }
    return status;
}

const koksma__shape_type koksma__shape_box = {
    .kind = {.name = "box",
             .title = "six rectangles, turned about y",
             .cite = "-",
             .parameters =
                 (const koksma__parameter[]){{"centre", KOKSMA__POINT, .at = offsetof(koksma__shape, centre)}, {0}},
             .keys = (const char *const[]){"half", "angle_deg", "motion", "to", NULL},
             .example = "\"half\": [0.2, 0.3, 0.4], \"angle_deg\": 20"},
    .takes_checker = true,
    .takes_image = true,
    .parse = parse,
};
