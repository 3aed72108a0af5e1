/* SPDX-License-Identifier: Apache-2.0 */
/* Meshes: our rays/s beside those of bare Embree (packets, its default tree) on the same rays in the same run, on one
   thread, best of a few rounds; for the bunny of Debian's glmark2-data and for the same with each triangle in 16.
   Ours is with places, normals and materials, from a robust tree. `render` is a whole picture, ambient light only,
   against bare Embree's camera rays; the tree is there. Then the time to load and build the larger. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "render/accel/accel.h"

#if !defined KOKSMA_EMBREE

int main(void)
{
    puts("skipped: this build has no Embree");
    return 0;
}

#else

#if KOKSMA_EMBREE == 3
#include <embree3/rtcore.h>
#define INTERSECT(width, valid, scene, packet)                                                                       \
    (rtcInitIntersectContext(&context), context.flags = how, rtcIntersect##width(valid, scene, &context, packet))
#define CONTEXT(coherent)                                                                                            \
    struct RTCIntersectContext context;                                                                              \
    const enum RTCIntersectContextFlags how =                                                                        \
        (coherent) ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT
#else
#include <embree4/rtcore.h>
#define INTERSECT(width, valid, scene, packet)                                                                       \
    (rtcInitIntersectArguments(&context), context.flags = how, rtcIntersect##width(valid, scene, packet, &context))
#define CONTEXT(coherent)                                                                                            \
    struct RTCIntersectArguments context;                                                                            \
    const enum RTCRayQueryFlags how = (coherent) ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT
#endif

#define BUNNY "/usr/share/glmark2/models/bunny.obj"
#define LARGE "/tmp/koksma-bench-meshes.ply"

enum { ROUNDS = 4, N_BLOCKS = 1 << 14, WIDTH = 512, SPP = 16 };

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- The larger mesh --------------------------------------------------------------------------------------- */

static void put_triangle(FILE *file, const double a[3], const double b[3], const double c[3], int level)
{
    double ab[3], bc[3], ca[3];
    if (!level) {
        for (int i = 0; i < 9; i++) {
            const float x = (float)(i < 3 ? a : i < 6 ? b : c)[i % 3];
            fwrite(&x, sizeof x, 1, file);
        }
        return;
    }
    for (int k = 0; k < 3; k++) {
        ab[k] = (a[k] + b[k]) / 2;
        bc[k] = (b[k] + c[k]) / 2;
        ca[k] = (c[k] + a[k]) / 2;
    }
    put_triangle(file, a, ab, ca, level - 1);
    put_triangle(file, ab, b, bc, level - 1);
    put_triangle(file, ca, bc, c, level - 1);
    put_triangle(file, ab, bc, ca, level - 1);
}

static bool write_large(const koksma__mesh *m)
{
    FILE *file = fopen(LARGE, "wb");
    const size_t n = 16 * m->n_triangles;
    if (!file) {
        return false;
    }
    fprintf(file,
            "ply\nformat binary_little_endian 1.0\nelement vertex %zu\nproperty float x\nproperty float y\n"
            "property float z\nelement face %zu\nproperty list uchar int vertex_indices\nend_header\n",
            3 * n, n);
    for (size_t t = 0; t < m->n_triangles; t++) {
        double v[3][3];
        for (size_t i = 0; i < 9; i++) {
            v[i / 3][i % 3] = (double)m->vertices[3 * m->indices[3 * t + i / 3] + i % 3];
        }
        put_triangle(file, v[0], v[1], v[2], 2);
    }
    for (size_t t = 0; t < n; t++) {
        const int32_t corners[3] = {(int32_t)(3 * t), (int32_t)(3 * t + 1), (int32_t)(3 * t + 2)};
        fputc(3, file);
        fwrite(corners, sizeof *corners, 3, file);
    }
    return !fclose(file);
}

/* ---- Rays --------------------------------------------------------------------------------------------------- */

static double uniform(void)
{
    static uint64_t state = 1;
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) * 0x1p-53;
}

/* A camera's, in rows of pixels with SPP samples each; or chords between random places of the bunny's box. */
static void make_rays(bool camera, koksma__rays *blocks)
{
    for (size_t i = 0; i < (size_t)N_BLOCKS * KOKSMA__BLOCK; i++) {
        koksma__rays *r = &blocks[i / KOKSMA__BLOCK];
        const size_t lane = i % KOKSMA__BLOCK, pixel = i / SPP;
        double o[3] = {0, 0.3, 3.2}, d[3] = {0, 0, -1};
        if (camera) {
            d[0] = ((double)(pixel % WIDTH) + uniform()) / WIDTH - 0.5;
            d[1] = 0.35 * (0.5 - ((double)pixel / WIDTH + uniform()) * SPP * WIDTH / (N_BLOCKS * KOKSMA__BLOCK));
        }
        for (int k = 0; !camera && k < 3; k++) {
            o[k] = 2 * uniform() - 1;
            d[k] = 2 * uniform() - 1 - o[k];
        }
        for (int k = 0; k < 3; k++) {
            r->o[k][lane] = (float)o[k];
            r->d[k][lane] = (float)d[k];
        }
        r->time[lane] = 0;
    }
}

/* ---- Bare Embree ---------------------------------------------------------------------------------------------- */

static RTCScene bare_scene(RTCDevice device, const koksma__mesh *m)
{
    RTCScene scene = rtcNewScene(device);
    RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, m->indices, 0, 12, m->n_triangles);
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, m->vertices, 0, 12, m->n_vertices);
    rtcCommitGeometry(g);
    rtcAttachGeometry(scene, g);
    rtcReleaseGeometry(g);
    rtcCommitScene(scene);
    return scene;
}

#define BARE(width)                                                                                                  \
    static void bare_##width(RTCScene scene, const koksma__rays *r, int start, bool coherent, uint64_t *hits)        \
    {                                                                                                                \
        CONTEXT(coherent);                                                                                           \
        _Alignas(64) int valid[width];                                                                               \
        struct RTCRayHit##width p;                                                                                   \
        const size_t size = width * sizeof(float);                                                                   \
        memcpy(p.ray.org_x, r->o[0] + start, size);                                                                  \
        memcpy(p.ray.org_y, r->o[1] + start, size);                                                                  \
        memcpy(p.ray.org_z, r->o[2] + start, size);                                                                  \
        memcpy(p.ray.dir_x, r->d[0] + start, size);                                                                  \
        memcpy(p.ray.dir_y, r->d[1] + start, size);                                                                  \
        memcpy(p.ray.dir_z, r->d[2] + start, size);                                                                  \
        for (int i = 0; i < width; i++) {                                                                            \
            valid[i] = -1;                                                                                           \
            p.ray.tnear[i] = p.ray.time[i] = 0;                                                                      \
            p.ray.tfar[i] = INFINITY;                                                                                \
            p.ray.mask[i] = ~0u;                                                                                     \
            p.ray.flags[i] = 0;                                                                                      \
            p.hit.geomID[i] = p.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;                                          \
        }                                                                                                            \
        INTERSECT(width, valid, scene, &p);                                                                          \
        for (int i = 0; i < width; i++) {                                                                            \
            *hits += p.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;                                                     \
        }                                                                                                            \
    }
BARE(8)
BARE(16)

/* ---- Rates ---------------------------------------------------------------------------------------------------- */

typedef struct rates {
    double bare, ours, render;
    uint64_t bare_hits, our_hits;
} rates;

static double render_s(const koksma_scene *scene, int spp, uint64_t *rays)
{
    koksma_render_options options;
    koksma_image image;
    const koksma_run run = {.threads = 1};
    koksma_render_options_init(&options, scene);
    koksma_pattern_spec("jittered", &options.pattern);
    options.width = 640;
    options.height = 480;
    options.spp = spp;
    *rays = 640u * 480 * (unsigned)spp;
    const double begun = now_s();
    if (koksma_render(scene, &options, &run, &image)) {
        fprintf(stderr, "bench-meshes: %s\n", koksma_error_text());
    }
    const double seconds = now_s() - begun;
    koksma_image_fini(&image);
    return seconds;
}

static rates measure(const koksma_scene *scene, const koksma__rays *blocks, bool camera)
{
    const double n = 1e-6 * N_BLOCKS * KOKSMA__BLOCK;
    RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
    RTCScene bare = bare_scene(device, scene->meshes);
    const bool wide = rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
    koksma__geometry ours;
    rates best = {0};
    int32_t from[KOKSMA__BLOCK];
    memset(from, 0xff, sizeof from);
    if (koksma__accel_meshes(scene, &ours)) {
        fprintf(stderr, "bench-meshes: %s\n", koksma_error_text());
        exit(1);
    }
    uint64_t rays;
    render_s(scene, 1, &rays); /* builds the tree that the scene keeps */
    for (int round = 0; round < ROUNDS; round++) {
        best.bare_hits = best.our_hits = 0;
        double begun = now_s();
        for (size_t b = 0; b < N_BLOCKS; b++) {
            for (int i = 0; i < KOKSMA__BLOCK; i += wide ? 16 : 8) {
                (wide ? bare_16 : bare_8)(bare, &blocks[b], i, camera, &best.bare_hits);
            }
        }
        best.bare = fmax(best.bare, n / (now_s() - begun));
        begun = now_s();
        for (size_t b = 0; b < N_BLOCKS; b++) {
            koksma__hits hits;
            best.our_hits += (uint64_t)ours.closest(&ours, &blocks[b], camera ? NULL : from, KOKSMA__BLOCK, &hits);
        }
        best.ours = fmax(best.ours, n / (now_s() - begun));
        if (camera) {
            const double seconds = render_s(scene, SPP, &rays);
            best.render = fmax(best.render, 1e-6 * (double)rays / seconds);
        }
    }
    ours.release(&ours);
    rtcReleaseScene(bare);
    rtcReleaseDevice(device);
    return best;
}

static koksma_scene *open_scene(const char *file)
{
    koksma_scene *scene = NULL;
    FILE *text = fopen("/tmp/koksma-bench-meshes.json", "w");
    if (text) {
        fprintf(text,
                "{\"camera\": {\"eye\": [0, 0.3, 3.2], \"target\": [0, 0, 0], \"fov_deg\": 35}, \"ambient\": 1, "
                "\"background\": 0.5, \"materials\": [{\"name\": \"m\", \"kind\": \"lambert\", \"albedo\": 0.7}], "
                "\"shapes\": [{\"kind\": \"mesh\", \"file\": \"%s\", \"material\": \"m\"}]}",
                file);
        fclose(text);
        if (koksma_scene_open("/tmp/koksma-bench-meshes.json", &scene)) {
            fprintf(stderr, "bench-meshes: %s\n", koksma_error_text());
        }
    }
    unlink("/tmp/koksma-bench-meshes.json");
    return scene;
}

static void bench(const koksma_scene *scene, koksma__rays *blocks)
{
    for (int camera = 1; camera >= 0; camera--) {
        make_rays(camera, blocks);
        const rates r = measure(scene, blocks, camera);
        const char *name = camera ? "camera" : "random";
        printf("%9zu  %s  %6.1f  %6.1f  %8.2f  %8.5f", scene->meshes->n_triangles, name, r.bare, r.ours,
               r.ours / r.bare, (double)r.our_hits / (double)r.bare_hits);
        if (camera) {
            printf("  %6.1f  %8.2f", r.render, r.render / r.bare);
        }
        putchar('\n');
        fflush(stdout);
    }
}

int main(void)
{
    koksma__rays *blocks = aligned_alloc(64, N_BLOCKS * sizeof *blocks);
    if (access(BUNNY, R_OK)) {
        puts("skipped: " BUNNY " is not there; Debian's glmark2-data has it");
        free(blocks);
        return 0;
    }
    koksma_scene *scene = blocks ? open_scene(BUNNY) : NULL;
    if (!scene || !write_large(scene->meshes)) {
        return 1;
    }
    printf("Mrays/s on one thread, %s\n", koksma_mesh_tracer());
    puts("triangles  rays      bare    ours  fraction  hits/bare's  render  fraction");
    bench(scene, blocks);
    koksma_scene_close(scene);
    const double begun = now_s();
    scene = open_scene(LARGE);
    const double loaded = now_s();
    koksma__geometry built;
    if (!scene || koksma__accel_meshes(scene, &built)) {
        return 1;
    }
    const double done = now_s();
    built.release(&built);
    bench(scene, blocks);
    printf("%zu triangles: %.2f s to load (binary PLY), %.2f s to build\n", scene->meshes->n_triangles,
           loaded - begun, done - loaded);
    koksma_scene_close(scene);
    unlink(LARGE);
    free(blocks);
    return 0;
}

#endif
