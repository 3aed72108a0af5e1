/* SPDX-License-Identifier: Apache-2.0 */
/* Meshes against the analytic shapes that they approach, closed forms, and themselves. Without Embree the
   tests are skipped. Long because all of them share the shapes and their pictures. */
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <koksma/render.h>

#include "core/random.h"
#include "meshes.h"
#include "meshes/mesh.h"

enum { SIDE = 48 };

static koksma_scene *scene_of(const char *text)
{
    koksma_scene *scene;
    write_json("test_meshes.json", text);
    assert_ok(koksma_scene_open("./test_meshes.json", &scene));
    unlink("test_meshes.json");
    return scene;
}

static koksma_image render_by(const koksma_scene *scene, const char *integrator, int spp, int side, int threads)
{
    return picture_of(scene, integrator, "jittered", spp, side, threads);
}

static size_t count_meshes(const char *text)
{
    koksma_scene *scene = scene_of(text);
    const size_t n = koksma_scene_count(scene).meshes;
    koksma_scene_close(scene);
    return n;
}

/* The mean difference of two scenes' pictures. */
static double difference(const char *a, const char *b)
{
    koksma_scene *one = scene_of(a), *other = scene_of(b);
    koksma_image first = render_by(one, "distribution", 9, SIDE, 2);
    koksma_image second = render_by(other, "distribution", 9, SIDE, 2);
    koksma_image_error error;
    assert_ok(koksma_image_compare(&first, &second, &error));
    koksma_image_fini(&first);
    koksma_image_fini(&second);
    koksma_scene_close(one);
    koksma_scene_close(other);
    return error.mean;
}

static void write_cube(void)
{
    FILE *file = fopen("cube.obj", "w");
    assert_non_null(file);
    for (int i = 0; i < 8; i++) {
        fprintf(file, "v %d %d %d\n", i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    }
    fputs("f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\nf 5 6 8 7\n", file);
    fclose(file);
}

#define HEAD                                                                                                         \
    "{'camera': {'eye': [3, 2.5, 6], 'target': [0, 0, 0], 'fov_deg': 40}, 'background': 0.3,'ambient': 0.1, "        \
    "'materials': [{'name': 'm', 'kind': 'lambert', 'albedo': 0.7}],'lights': [{'kind': 'rectangle', 'centre': [2, " \
    "5, 3], 'facing': [0, 0, 0], 'half': [1, 1],'strength': 1}], 'shapes': [{'kind': 'plane', 'centre': [0, -1.5, "  \
    "0], 'normal': [0, 1, 0],'material': 'm'},"
#define TAIL ", 'material': 'm'}]}"

TEST_CASE(a_cube_is_a_box)
{
    need_meshes();
    write_cube();
    /* The same samples see the same places: only rounding differs, which moves a few samples on edges. */
    assert_near(difference(HEAD "{'kind': 'box', 'centre': [0, 0, 0], 'half': [1, 1, 1]" TAIL,
                           HEAD "{'kind': 'mesh', 'file': 'cube.obj'" TAIL),
                0, 1e-5);
    assert_near(difference(HEAD "{'kind': 'box', 'centre': [0.3, 0, -0.2], 'half': [1, 0.5, 2], 'angle_deg': 30" TAIL,
                           HEAD "{'kind': 'mesh', 'file': 'cube.obj', 'translate': [0.3, 0, -0.2], 'scale': [1, 0.5, "
                                "2], 'rotate_deg': [0, 30, 0]" TAIL),
                0, 1e-5);
    unlink("cube.obj");
}

/* Shapes of one file, under other names of it, share a mesh, and are what shapes of equal files are: each with its own
   placement, material and normals, and named by its own name. */
TEST_CASE(a_file_is_one_mesh)
{
    need_meshes();
    write_cube();
    assert_int_equal(rename("cube.obj", "copy.obj"), 0);
    write_cube();
#define THREE(second)                                                                                                \
    "{'camera': {'eye': [3, 2.5, 6], 'target': [0, 0, 0], 'fov_deg': 40}, 'background': 0.3, 'materials': "          \
    "[{'name': 'm', 'kind': 'lambert', 'albedo': 0.7}, {'name': 'dark', 'kind': 'lambert', 'albedo': 0.2}], "        \
    "'lights': [], 'shapes': [{'kind': 'mesh', 'file': 'cube.obj', 'material': 'm'}, {'kind': 'mesh', 'file': "      \
    "'" second "', 'name': 'b', 'translate': [1, 2, 0], 'scale': 0.5, 'smooth': true, 'material': 'dark'}, "         \
    "{'kind': 'mesh', 'file': '" second                                                                              \
    "', 'translate': [-2, 1, 0], 'scale': 0.4, 'emission': [3, 2, 1]}, {'kind': 'instance', 'of': 'b', "             \
    "'translate': [0, -2, 0], 'rotate_deg': [0, 30, 0]" TAIL
    assert_int_equal(count_meshes(THREE("copy.obj")), 2);
    assert_int_equal(symlink("cube.obj", "same.obj"), 0);
    assert_int_equal(count_meshes(THREE("same.obj")), 1);
    assert_near(difference(THREE("copy.obj"), THREE("./same.obj")), 0, 0);
    unlink("same.obj");
    unlink("copy.obj");
    unlink("cube.obj");
}

TEST_CASE(an_instance_is_its_mesh_elsewhere)
{
    need_meshes();
    write_cube();
#define FAR_OFF "{'kind': 'mesh', 'file': 'cube.obj', 'name': 'c', 'translate': [0, 0, 90]" TAIL
    const char *alone = HEAD "{'kind': 'mesh', 'file': 'cube.obj', 'translate': [0.3, 0, -0.2], 'smooth': true, "
                             "'scale': [1, 0.5, 2], 'rotate_deg': [10, 20, 30], 'motion': [0.4, 0, 0]" TAIL;
    const char *instance =
        HEAD "{'kind': 'mesh', 'file': 'cube.obj', 'name': 'c', 'translate': [0, 0, 90], 'material': 'm'}, {'kind': "
             "'instance', 'of': 'c', 'translate': [0.3, 0, -0.2], 'smooth': true, 'scale': [1, 0.5, 2], "
             "'rotate_deg': [10, 20, 30], 'motion': [0.4, 0, 0]" TAIL;
    assert_near(difference(alone, instance), 0, 1e-4);
    unlink("cube.obj");
}

/* ---- Spheres ------------------------------------------------------------------------------------------- */

/* A ball of 8 4^level triangles: an octahedron whose faces are split into rows. */
static void write_ball(int level)
{
    const int n = 1 << level;
    FILE *file = fopen("ball.obj", "w");
    assert_non_null(file);
    for (int face = 0; face < 8; face++) {
        const double sign[3] = {face & 1 ? -1 : 1, face & 2 ? -1 : 1, face & 4 ? -1 : 1};
        for (int i = 0; i <= n; i++) {
            for (int j = 0; j <= n - i; j++) {
                double v[3] = {i, j, n - i - j}, length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
                for (int k = 0; k < 3; k++) {
                    v[k] *= sign[k] / length;
                }
                fprintf(file, "v %.17g %.17g %.17g\n", v[0], v[1], v[2]);
            }
        }
        const int total = (n + 1) * (n + 2) / 2;
        const bool turned = sign[0] * sign[1] * sign[2] < 0;
        for (int i = 0; i < n; i++) {
            const int row = 1 + face * total + i * (n + 1) - i * (i - 1) / 2, next = row + n + 1 - i;
            for (int j = 0; j < n - i; j++) {
                fprintf(file, turned ? "f %d %d %d\n" : "f %3$d %2$d %1$d\n", row + j, row + j + 1, next + j);
                if (j < n - i - 1) {
                    fprintf(file, turned ? "f %d %d %d\n" : "f %3$d %2$d %1$d\n", row + j + 1, next + j + 1,
                            next + j);
                }
            }
        }
    }
    fclose(file);
}

#define SPHERE HEAD "{'kind': 'sphere', 'centre': [0, 0, 0], 'radius': 1" TAIL
#define BALL(more) HEAD "{'kind': 'mesh', 'file': 'ball.obj'" more TAIL

TEST_CASE(a_fine_ball_is_a_sphere)
{
    need_meshes();
    write_ball(3);
    const double coarse = difference(SPHERE, BALL(""));
    const double smooth = difference(SPHERE, BALL(", 'smooth': true"));
    write_ball(5);
    const double fine = difference(SPHERE, BALL(""));
    /* flat normals are off by half an edge: halved twice over two levels */
    assert_true(fine < 0.4 * coarse);
    assert_true(smooth < 0.9 * coarse); /* the outline and the edge of the shadow stay */
    assert_true(fine < 5e-3);
    unlink("ball.obj");
}

/* A scene in metres looks as in millimetres, a thousandth of it in size: numbers differ by powers of two alone. */
TEST_CASE(normals_are_smooth_in_all_sizes)
{
    need_meshes();
    write_ball(2);
    koksma_image images[3];
    for (int i = 0; i < 3; i++) {
        static const double sizes[] = {1, 0x1p-10, 0x1p-19};
        char text[1024];
        snprintf(text, sizeof text,
                 "{'camera': {'eye': [0, 0, %.17g], 'target': [0, 0, 0], 'fov_deg': 30},'materials': [{'name': 'm', "
                 "'kind': 'lambert', 'albedo': 0.5}], 'shapes':[{'kind': 'mesh', 'file': 'ball.obj', 'material': "
                 "'m', 'smooth': true,'scale': %.17g}], 'lights': [{'kind': 'directional', 'direction': [-1, -2, "
                 "-3],'irradiance': 3}]}",
                 5 * sizes[i], sizes[i]);
        koksma_scene *scene = scene_of(text);
        images[i] = render_by(scene, "distribution", 1, SIDE, 1);
        koksma_scene_close(scene);
    }
    float brightest = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        brightest = fmaxf(brightest, images[0].pixels[i]);
        assert_near((double)images[1].pixels[i], (double)images[0].pixels[i], 1e-5);
        assert_near((double)images[2].pixels[i], (double)images[0].pixels[i], 1e-5);
    }
    assert_true(brightest > 0.4f); /* it is there */
    for (int i = 0; i < 3; i++) {
        koksma_image_fini(&images[i]);
    }
    unlink("ball.obj");
}

/* In a white furnace a convex white body is as bright as its surroundings: no ray that starts on it may meet it, be
   it small, large or far from the origin. */
TEST_CASE(convex_bodies_do_not_shade_themselves)
{
    need_meshes();
    write_ball(4);
    static const struct {
        double scale, away;
    } cases[] = {{1, 0}, {1e-3, 0}, {1e4, 0}, {1, 1000}, {0.01, 100}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1024];
        const double s = cases[i].scale, x = cases[i].away;
        snprintf(text, sizeof text,
                 "{'camera': {'eye': [%g, 0, %g], 'target': [%g, 0, 0], 'fov_deg': 30}, 'materials': [{'name': 'm', "
                 "'kind': 'lambert', 'albedo': 1}], 'lights': [{'kind': 'environment', 'radiance': 1}], 'shapes': "
                 "[{'kind': 'mesh', 'file': 'ball.obj', 'scale': %g, 'translate': [%g, 0, 0], 'material': 'm'}]}",
                 x, 4 * s, x, s, x);
        koksma_scene *scene = scene_of(text);
        koksma_image image = render_by(scene, "path", 16, 24, 2);
        for (int p = 0; p < 24 * 24; p++) { /* with MIS the weights of a sample sum to 1 in the mean only */
            assert_true(fabsf(image.pixels[p] - 1) < 0.35f);
        }
        double sum = 0;
        for (int p = 0; p < 24 * 24; p++) {
            sum += (double)image.pixels[p] / (24 * 24);
        }
        assert_near(sum, 1, 5e-3);
        koksma_image_fini(&image);
        koksma_scene_close(scene);
    }
    unlink("ball.obj");
}

/* ---- Light and time ------------------------------------------------------------------------------------- */

static void write_square(void)
{
    FILE *file = fopen("square.ply", "w");
    assert_non_null(file);
    fputs("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
          "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
          "-1 0 1\n1 0 1\n1 0 -1\n-1 0 -1\n4 0 1 2 3\n",
          file);
    fclose(file);
}

static double pixel(const char *text, const char *integrator)
{
    koksma_scene *scene = scene_of(text);
    koksma_image image = render_by(scene, integrator, 4096, 1, 1);
    const double value = (double)image.pixels[0];
    koksma_image_fini(&image);
    koksma_scene_close(scene);
    return value;
}

#define PATCH                                                                                                        \
    "{'camera': {'eye': [5, 1, 9], 'target': [0, 0, 0], 'fov_deg': 0.01},'materials': [{'name': 'm', 'kind': "       \
    "'lambert', 'albedo': 0.9}],'lights': [{'kind': 'rectangle', 'centre': [0, 2, 0], 'normal': [0, -1, 0], "        \
    "'half': [1, 0.5],'radiance': 2}], 'shapes': [{'kind': 'mesh', 'file': 'square.ply', 'scale': 3, 'material': "   \
    "'m'}"

TEST_CASE(light_on_meshes_is_its_form_factor)
{
    need_meshes();
    write_square();
    const double full = 0.9 * 2 * 4 * corner_factor(0.5, 0.25);
    assert_near(pixel(PATCH "]}", "distribution"), full, 1e-4);
    assert_near(pixel(PATCH ", {'kind': 'mesh', 'file': 'square.ply', 'translate': [1, 1.5, 0]" TAIL, "distribution"),
                full / 2, 2e-3);
    assert_near(pixel(PATCH ", {'kind': 'mesh', 'file': 'square.ply', 'translate': [0, 2.5, 0]" TAIL, "distribution"),
                full, 1e-4);
    unlink("square.ply");
}

/* A black square passes before a white sky: it covers the point while |x + 4 t - 2| < 1. */
TEST_CASE(motion_covers_its_share_of_time)
{
    need_meshes();
    write_square();
#define PASSING(shutter)                                                                                             \
    "{'camera': {'eye': [0, 5, 0], 'target': [0, 0, 0], 'up': [0, 0, -1], 'fov_deg': 0.01, 'shutter': [" shutter     \
    "]}, 'background': 1, 'materials': [{'name': 'm', 'kind': 'lambert', 'albedo': 0}],'shapes': [{'kind': 'mesh', " \
    "'file': 'square.ply', 'translate': [-2, 0, 0], 'motion': [4, 0, 0]" TAIL
    assert_near(pixel(PASSING("0, 1"), "distribution"), 0.5, 2e-3);
    assert_near(pixel(PASSING("0, 0.5"), "distribution"), 0.5, 2e-3);
    assert_near(pixel(PASSING("0, 0.3"), "distribution"), 5.0 / 6, 2e-3);
    unlink("square.ply");
}

/* A black half plane at the angles 90 to 270 degrees turns by 120 in its own plane before a white sky: it leaves the
   angle 90 + 120 s after the share s of the time and reaches 270 + 120 s. Of the whole turning disk it covers half. */
TEST_CASE(rotation_covers_its_share_of_time)
{
    need_meshes();
    test_write("half.ply",
               "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
               "z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
               "-3 0 3\n0 0 3\n0 0 -3\n-3 0 -3\n4 0 1 2 3\n");
#define TURNING(more)                                                                                                \
    "{'camera': {'eye': [%.12g, 5, %.12g], 'target': [%.12g, 0, %.12g], 'up': [0, 0, -1], 'orthographic_height': "   \
    "%g}, 'background': 1, 'materials': [{'name': 'm', 'kind': 'lambert', 'albedo': 0}], 'shapes': [{'kind': "       \
    "'mesh', 'file': 'half.ply', 'to': {'rotate_deg': [0, 120, 0]}" more
    for (int angle_deg = 7; angle_deg < 360; angle_deg += 16) {
        const double x = cos(angle_deg * M_PI / 180), z = -sin(angle_deg * M_PI / 180);
        const int past = angle_deg < 90 ? angle_deg + 360 : angle_deg; /* 90 to 450 */
        const double covered = past < 210   ? (past - 90) / 120.0
                               : past < 270 ? 1
                               : past < 390 ? 1 - (past - 270) / 120.0
                                            : 0;
        char text[1024];
        snprintf(text, sizeof text, TURNING(TAIL), x, z, x, z, 1e-5);
        assert_near(pixel(text, "distribution"), 1 - covered, 2e-3);
    }
    char text[1024];
    snprintf(text, sizeof text, TURNING(TAIL), 0.0, 0.0, 0.0, 0.0, 2.0);
    assert_near(pixel(text, "distribution"), 0.5, 2e-3);
    unlink("half.ply");
}

/* A matrix is its pose's again, and the pose's stretch is symmetric, of positive or, where the matrix mirrors, negative
   eigenvalues: that is the polar decomposition, and there is one only. */
TEST_CASE(poses_are_polar_decompositions)
{
    for (uint64_t i = 0; i < 400; i++) {
        double m[12], back[12], largest = 0;
        koksma__pose pose[2];
        for (int k = 0; k < 12; k++) {
            double u[2];
            koksma__random_pair(4, 0, i, (uint32_t)k, u);
            m[k] = i < 4 ? (k % 5 == 0 ? (k == 5 || i == 3 ? -1 : 1) * (double)(1 + i) : 0) : 20 * u[0] - 10;
            largest = fmax(largest, fabs(m[k]));
        }
        assert_true(koksma__pose_of_matrix(m, &pose[0]));
        pose[1] = pose[0];
        koksma__poses_at(pose, 0.3, back);
        const double *s = pose[0].stretch, sign = koksma__matrix_mirrors(m) ? -1 : 1;
        for (int k = 0; k < 12; k++) {
            assert_near(back[k], m[k], 1e-11 * largest);
        }
        for (int k = 0; k < 9; k++) {
            assert_near(s[k], s[k / 3 + k % 3 * 3], 1e-11 * largest);
        }
        const double minor = s[0] * s[4] - s[1] * s[3]; /* Sylvester's criterion */
        const double whole = s[0] * (s[4] * s[8] - s[5] * s[7]) - s[1] * (s[3] * s[8] - s[5] * s[6]) +
                             s[2] * (s[3] * s[7] - s[4] * s[6]);
        assert_true(sign * s[0] > 0 && minor > 0 && sign * whole > 0);
    }
    koksma__pose pose;
    assert_false(koksma__pose_of_matrix((const double[12]){1, 2, 3, 0, 2, 4, 6, 0, 0, 0, 1, 0}, &pose));
}

/* The poses at both ends have the matrices of their angles; half of the rotation twice is the whole one, and all
   positions between go straight. */
TEST_CASE(poses_turn_evenly)
{
    for (uint64_t i = 0; i < 200; i++) {
        double angles[2][3], at[2][3], scale[2][3], m[3][12], expected[12];
        koksma__pose poses[2];
        for (uint32_t e = 0; e < 2; e++) {
            for (int k = 0; k < 3; k++) {
                double u[2];
                koksma__random_pair(3, e, i, (uint32_t)k, u);
                angles[e][k] = 720 * u[0] - 360;
                at[e][k] = 10 * u[1] - 5;
                scale[e][k] = 0.5 + u[1];
            }
            poses[e] = koksma__pose_of(at[e], angles[e], scale[e]);
        }
        for (int e = 0; e < 2; e++) {
            koksma__poses_at(poses, e, m[0]);
            koksma__placement_matrix(at[e], angles[e], scale[e], expected);
            for (int k = 0; k < 12; k++) {
                assert_near(m[0][k], expected[k], 1e-12);
            }
        }
        for (int k = 0; k < 3; k++) {
            poses[0].stretch[4 * k] = poses[1].stretch[4 * k] = 1;
        }
        for (int t = 0; t < 3; t++) {
            koksma__poses_at(poses, t / 2.0, m[t]);
        }
        const int steps = koksma__pose_steps(poses);
        double trace = -1;
        for (int r = 0; r < 3; r++) {
            assert_near(m[1][4 * r + 3], (at[0][r] + at[1][r]) / 2, 1e-12);
            for (int c = 0; c < 3; c++) { /* half whole^-1 half = end: half start^T half */
                double sum = 0;
                for (int j = 0; j < 3; j++) {
                    for (int l = 0; l < 3; l++) {
                        sum += m[1][4 * r + j] * m[0][4 * l + j] * m[1][4 * l + c];
                    }
                }
                assert_near(sum, m[2][4 * r + c], 1e-9);
                trace += m[0][4 * r + c] * m[2][4 * r + c];
            }
        }
        const double angle_deg = acos(fmax(-1, fmin(1, trace / 2))) * 180 / M_PI; /* of the rotation between */
        assert_true(steps >= 1 && steps <= KOKSMA__MAX_STEPS && fabs(angle_deg / 1.5 + 0.5 - steps) <= 0.5 + 1e-6);
    }
}

/* A ball that turns about itself is a ball; one that is moved by `to` is one that is moved by `motion`, and instances
   and shadows do the same. */
TEST_CASE(poses_are_placements)
{
    need_meshes();
    write_ball(6);
    assert_true(difference(BALL(", 'smooth': true, 'to': {'rotate_deg': [30, 100, -20]}"), BALL(", 'smooth': true")) <
                3e-3);
    assert_true(difference(BALL(", 'translate': [0.1, 0, 0], 'motion': [0.3, 0.2, 0]"),
                           BALL(", 'translate': [0.1, 0, 0], 'to': {'translate': [0.4, 0.2, 0]}")) < 1e-4);
    assert_true(
        difference(BALL(", 'to': {'rotate_deg': [0, 90, 0], 'scale': 0.5}"), HEAD
                   "{'kind': 'mesh', 'file': 'ball.obj', 'name': 'b', 'translate': [0, 0, 90], 'material': 'm'}, "
                   "{'kind': 'instance', 'of': 'b', 'to': {'rotate_deg': [0, 90, 0], 'scale': 0.5}" TAIL) == 0);
    assert_true(difference(BALL(", 'to': {'scale': 0.5}"), BALL("")) > 1e-2);
    koksma_scene *scene;
    write_json("both.json", BALL(", 'motion': [1, 0, 0], 'to': {'scale': 0.5}"));
    assert_int_equal(koksma_scene_open("./both.json", &scene), KOKSMA_MALFORMED);
    assert_non_null(strstr(koksma_error_text(), "it takes one of 'motion' and 'to'"));
    unlink("both.json");
    unlink("ball.obj");
}

TEST_CASE(threads_and_modes_leave_no_trace)
{
    need_meshes();
    write_ball(3);
    volatile float small = 1e-38f, scale = 0.125f;
    koksma_scene *scene = scene_of(BALL(", 'smooth': true, 'motion': [0.3, 0, 0]"));
    koksma_image one = render_by(scene, "path", 4, SIDE, 1);
    for (int threads = 2; threads <= 5; threads += 3) {
        koksma_image many = render_by(scene, "path", 4, SIDE, threads);
        assert_memory_equal(one.pixels, many.pixels, SIDE * SIDE * sizeof(float));
        koksma_image_fini(&many);
    }
    koksma_image_fini(&one);
    koksma_scene_close(scene);
    assert_true(small * scale > 0); /* denormals are still numbers */
    unlink("ball.obj");
}

typedef struct picture {
    const koksma_scene *scene;
    koksma_image image;
} picture;

static void *draw_picture(void *to)
{
    picture *p = to;
    p->image = render_by(p->scene, "distribution", 4, SIDE, 1);
    return NULL;
}

/* A scene makes its tree once, for whoever comes first. */
TEST_CASE(pictures_of_a_scene_share_its_tree)
{
    need_meshes();
    enum { N = 4 };
    write_ball(3);
    koksma_scene *scene = scene_of(BALL(", 'smooth': true"));
    picture pictures[N];
    pthread_t threads[N];
    for (int i = 0; i < N; i++) {
        pictures[i].scene = scene;
        assert_int_equal(pthread_create(&threads[i], NULL, draw_picture, &pictures[i]), 0);
    }
    for (int i = 0; i < N; i++) {
        pthread_join(threads[i], NULL);
        assert_memory_equal(pictures[0].image.pixels, pictures[i].image.pixels, SIDE * SIDE * sizeof(float));
    }
    for (int i = 0; i < N; i++) {
        koksma_image_fini(&pictures[i].image);
    }
    koksma_scene_close(scene);
    unlink("ball.obj");
}

/* A soup of triangles whose corners lie on a grid around 0, some of them at -0: the normal of a corner is that of the sum
   of the areas of all triangles that have a corner there. */
TEST_CASE(normals_are_those_of_all_triangles_at_a_place)
{
    enum { N = 300 };
    koksma__mesh mesh = {0};
    uint32_t random = 1;
    assert_ok(koksma__mesh_init(3 * N, N, false, false, &mesh));
    for (uint32_t i = 0; i < 9 * N; i++) {
        random = random * 1664525 + 1013904223;
        mesh.vertices[i] = (float)(random >> 30) * (random & 1 << 20 ? 0.375f : -0.375f);
        mesh.indices[i / 3] = i / 3;
    }
    assert_ok(koksma__mesh_check(&mesh));
    assert_ok(koksma__mesh_smooth(&mesh));
    for (size_t i = 0; i < 3 * N; i++) {
        const float *v = mesh.vertices + 3 * i;
        double sum[3] = {0}, length = 0;
        for (size_t t = 0; t < N; t++) {
            const float *w = mesh.vertices + 9 * t;
            size_t touches = 0;
            for (size_t c = 0; c < 3; c++) {
                touches += w[3 * c] == v[0] && w[3 * c + 1] == v[1] && w[3 * c + 2] == v[2];
            }
            for (size_t k = 0; k < 3; k++) {
                const size_t x = (k + 1) % 3, y = (k + 2) % 3;
                sum[k] += (double)touches *
                          (double)((w[3 + x] - w[x]) * (w[6 + y] - w[y]) - (w[3 + y] - w[y]) * (w[6 + x] - w[x]));
            }
        }
        for (size_t k = 0; k < 3; k++) {
            length += sum[k] * sum[k];
        }
        for (size_t k = 0; k < 3; k++) {
            assert_float_equal((double)mesh.normals[3 * i + k], length > 0 ? sum[k] / sqrt(length) : 0, 1e-6);
        }
    }
    koksma__mesh_fini(&mesh);
}

/* The normals of a corner of a tetrahedron, as Mitsuba 3.9.1 gives them for the same mesh (its vertex_normals), and of
   a cube's corner whose faces are cut so that one has two triangles there: its diagonal, whatever their areas. */
TEST_CASE(normals_by_angles_are_those_of_mitsuba)
{
    static const float places[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                       {1, 0, 0}, {0, 4, 0}, {0, 0, 1}, {1, 4, 0}};
    static const uint32_t corners[7][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3},
                                           {4, 5, 7}, {4, 4, 5}, {6, 6, 6}};
    static const double wanted[4][3] = {{-0.57735026, -0.57735026, -0.57735026},
                                        {0.92102444, -0.27542147, -0.27542147},
                                        {-0.27542147, 0.92102444, -0.27542147},
                                        {-0.27542147, -0.27542147, 0.92102444}};
    koksma__mesh mesh = {0};
    assert_ok(koksma__mesh_init(8, 7, false, false, &mesh));
    memcpy(mesh.vertices, places, sizeof places);
    memcpy(mesh.indices, corners, sizeof corners);
    assert_ok(koksma__mesh_check(&mesh));
    assert_ok(koksma__mesh_smooth_by_angles(&mesh));
    for (size_t i = 0; i < 12; i++) {
        assert_float_equal((double)mesh.normals[i], wanted[i / 3][i % 3], 1e-6);
    }
    /* vertex 4 lies where vertex 1 does, but has its own triangles; vertex 6 has none with an area */
    assert_float_equal((double)mesh.normals[14], -1, 0);
    assert_true(mesh.normals[18] == 0 && mesh.normals[19] == 0 && mesh.normals[20] == 0);
    koksma__mesh_fini(&mesh);
    static const float corner[7][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 5}, {3, 3, 0}, {0, 1, 1}, {1, 0, 1}};
    static const uint32_t faces[4][3] = {{0, 1, 4}, {0, 4, 2}, {0, 2, 3}, {0, 3, 1}};
    assert_ok(koksma__mesh_init(7, 4, false, false, &mesh));
    memcpy(mesh.vertices, corner, sizeof corner);
    memcpy(mesh.indices, faces, sizeof faces);
    assert_ok(koksma__mesh_check(&mesh));
    assert_ok(koksma__mesh_smooth_by_angles(&mesh));
    for (size_t k = 0; k < 3; k++) {
        assert_float_equal((double)mesh.normals[k], sqrt(1.0 / 3), 1e-6);
    }
    koksma__mesh_fini(&mesh);
}

/* Loop's surface: each of a tetrahedron's corners, with three neighbours, has the limit (1 - 3 g) v + g N, g = 1 / (3 + 3 /
   (8 * 3/16)) = 1/5, at any level; numbers follow Euler's formula. On a plane of regular triangles the masks keep linear
   functions, so that inner vertices stay; the corners of a square's border have 3/5 v + 1/5 (p + q), at level 0. */
TEST_CASE(loops_surface_has_its_limits)
{
    static const float places[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    static const uint32_t corners[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
    koksma__mesh mesh = {0}, fine = {0};
    assert_ok(koksma__mesh_init(4, 4, false, false, &mesh));
    memcpy(mesh.vertices, places, sizeof places);
    memcpy(mesh.indices, corners, sizeof corners);
    assert_ok(koksma__mesh_check(&mesh));
    for (int levels = 0; levels < 5; levels++) {
        assert_ok(koksma__mesh_loop(&mesh, levels, &fine));
        assert_int_equal(fine.n_triangles, (size_t)4 << 2 * levels);
        assert_int_equal(fine.n_vertices, fine.n_triangles / 2 + 2); /* V - E + F = 2, E = 3 F / 2 */
        for (size_t i = 0; i < 12; i++) {                            /* N = -v: the corners' sum is 0 */
            assert_float_equal((double)fine.vertices[i], ((double)places[i / 3][i % 3] * (2.0 / 5 - 1.0 / 5)), 1e-6);
            assert_float_equal((double)fine.normals[i], ((double)places[i / 3][i % 3] / sqrt(3.0)), 1e-6);
        }
        koksma__mesh_fini(&fine);
    }
    koksma__mesh_fini(&mesh);
    enum { N = 6 };
    assert_ok(koksma__mesh_init(N * N, 2 * (N - 1) * (N - 1), false, false, &mesh));
    uint32_t *to = mesh.indices;
    for (uint32_t i = 0; i < N * N; i++) {
        const uint32_t x = i % N, y = i / N, quad[6] = {i, i + 1, i + N + 1, i, i + N + 1, i + N};
        mesh.vertices[3 * i] = (float)x;
        mesh.vertices[3 * i + 1] = (float)y;
        mesh.vertices[3 * i + 2] = (float)(x + 2 * y);
        if (x < N - 1 && y < N - 1) {
            memcpy(to, quad, sizeof quad);
            to += 6;
        }
    }
    assert_ok(koksma__mesh_check(&mesh));
    for (int levels = 0; levels < 3; levels++) {
        assert_ok(koksma__mesh_loop(&mesh, levels, &fine));
        for (size_t i = 0; i < N * N; i++) {
            const size_t x = i % N, y = i / N;
            const bool far = x >= 2 && y >= 2 && x < N - 2 && y < N - 2; /* of the border's own rule */
            assert_float_equal((double)fine.vertices[3 * i + 2],
                               ((double)fine.vertices[3 * i] + 2 * (double)fine.vertices[3 * i + 1]), 1e-5);
            assert_true(!far || fabs((double)fine.vertices[3 * i] - (double)x) < 1e-6);
        }
        assert_true(levels ||
                    fabs((double)fine.vertices[0] - 0.2) < 1e-6); /* corner (0, 0): 1/5 of (1, 0) and (0, 1) */
        koksma__mesh_fini(&fine);
    }
    koksma__mesh_fini(&mesh);
}
