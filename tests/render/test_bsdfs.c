/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Every line of materials.def, with parameters drawn from the ranges that it declares:
 *
 *   - what is sampled is what the value says of that direction: pdf, and value = weight pdf
 *   - directions fall where the density says, by chi-square in cells that are fine where samples are, and the density
 *     integrates to the share of samples that are not lost
 *   - no energy is gained: the integral of value, by quadrature, is at most 1, and the mean weight agrees with it
 *   - a claim of reciprocity or of being Lambert holds; lobes that aren't asked for give nothing
 *   - a specular direction leads back where it came from, and both directions of glass share at most 1
 *
 * All by the loops that the renderer uses for blocks of surfaces, here copies of one surface.
 *
 * Lobes whose density is above SHARPEST are left out of the comparison with the density: floats of directions don't
 * resolve them (tests/render/test_materials.c has those of ggx).
 */
#include "kinds.h"
#include "lanes.h"
#include "render/materials/materials.h"

enum { TRIALS = test_repeats(24, 4), SAMPLES = 80 * KOKSMA__BLOCK, CELL = 12, ANGLES = test_repeats(300, 60) };
#define SHARPEST 1e3

/* A material of the kind, through the parser; redrawn where the kind refuses parameters together. */
static koksma_scene *made(const koksma__bsdf *bsdf, uint64_t stream)
{
    for (uint64_t attempt = 0; attempt < 1000; attempt++) {
        char fields[1024], diffuse[256] = "", text[2048];
        double u[6];
        koksma_scene *scene = NULL;
        kind_fields(&bsdf->kind, stream + 1000000 * attempt, fields, sizeof fields);
        for (uint64_t i = 0; i < 6; i++) {
            u[i] = draw(stream + 1000000 * attempt, 900 + i);
        }
        if (bsdf->diffuse & KOKSMA__ALBEDO) {
            snprintf(diffuse, sizeof diffuse, ", 'albedo': [%.17g, %.17g, %.17g]", u[0], u[1], u[0] < 0.5 ? 1 : u[2]);
        } else if (bsdf->diffuse) {
            snprintf(diffuse, sizeof diffuse, ", 'albedos': [%.17g, [1, %.17g, %.17g]]", u[0], u[1], u[2]);
        }
        snprintf(text, sizeof text,
                 "{'camera': {'eye': [0, 0, 1], 'target': [0, 0, 0], 'fov_deg': 9}, 'shapes': [],'materials': "
                 "[{'name': 'm', 'kind': '%s'%s%s}]}",
                 bsdf->kind.name, diffuse, fields);
        if (!open_text(text, &scene)) {
            assert_ptr_equal(scene->materials[0].bsdf, bsdf);
            return scene;
        }
        assert_that(bsdf->check, "%s: %s: %s", bsdf->kind.name, text, koksma_error_text());
    }
    fail_msg("%s refuses all parameters of its ranges", bsdf->kind.name);
    return NULL;
}

/* A point with a random normal, seen at a cosine that is 1, small, or anything. */
static koksma__surface surface_of(const koksma__shading_material *m, uint64_t stream, uint64_t i)
{
    koksma__surface s = {.material = m, .inside = draw(stream, 7000 + i) < 0.5};
    float side[3], other[3];
    const double u = draw(stream, 8000 + i), v = draw(stream, 9000 + i);
    const double cosine = u < 0.2 ? 1 : u < 0.4 ? 0.02 + 0.2 * v : 0.05 + 0.95 * v, sine = sqrt(1 - cosine * cosine);
    draw_unit(stream, 10000 + i, s.n);
    frame3(s.n, side, other);
    for (int k = 0; k < 3; k++) {
        s.out[k] = (float)(cosine * (double)s.n[k] + sine * (double)side[k]);
        s.albedo[k] = m->albedo[u < 0.7][k];
    }
    return s;
}

/* Of kinds with images: in half of the cases what an image says here, by its factors and a base colour. */
static void draw_texture(uint64_t stream, koksma__shading_material *m)
{
    if (m->bsdf->texture && draw(stream, 950) < 0.5) {
        const float factors[2] = {(float)draw(stream, 951), draw(stream, 952) < 0.3 ? 1 : (float)draw(stream, 953)};
        float local[KOKSMA__LOCAL], albedo[3];
        for (uint64_t k = 0; k < 3; k++) {
            albedo[k] = draw(stream, 960) < 0.3 ? 1 : (float)draw(stream, 954 + k);
        }
        m->bsdf->texture(m, factors, albedo, local);
        memcpy(m->values, local, sizeof local);
        memcpy(m->albedo[0], albedo, sizeof albedo);
        memcpy(m->albedo[1], albedo, sizeof albedo);
    }
}

/* A block of n copies of a surface, which has no other lobes than these. */
static const koksma__surfaces *block_of(const koksma__surface *s, unsigned lobes, int n)
{
    static koksma__surfaces block;
    static koksma__hits hits;
    const koksma__bsdf *bsdf = s->material->bsdf;
    block.hits = &hits;
    block.materials = s->material;
    block.traits = 1u << bsdf->form | lobes << KOKSMA__LOBES_AT;
    for (int i = 0; i < n; i++) {
        set_lane(hits.n, i, s->n);
        set_lane(block.out, i, s->out);
        set_lane(block.albedo, i, s->albedo);
        hits.back[i] = s->inside;
        block.form[i] = (int32_t)bsdf->form;
        block.derived[i] = s->material->derived;
        for (int k = 0; k < 4; k++) {
            block.parameters[k][i] = s->material->values[k];
        }
    }
    return &block;
}

/* Samples first .. first + KOKSMA__BLOCK - 1 of a stream. */
static const koksma__directions *sample_of(const koksma__surface *s, unsigned lobes, uint64_t stream, uint64_t first)
{
    static koksma__directions out;
    static _Alignas(64) koksma__lanes u[3];
    for (uint64_t i = 0; i < 3 * KOKSMA__BLOCK; i++) {
        u[i % 3][i / 3] = (float)draw(stream, 3 * first + i) * 0.9999999f;
    }
    koksma__batch()->scatter(block_of(s, lobes, KOKSMA__BLOCK), lobes, u, KOKSMA__BLOCK, &out);
    return &out;
}

/* The values for n directions, and their densities, of which reflect() tells by the weights of a light that is
   chosen with a tiny density: p / (p + density). Densities where all values are 0 stay unknown (-1). */
static void value_of(const koksma__surface *s, unsigned lobes, const koksma__lanes *w, int n, koksma__lanes values[3],
                     float *densities)
{
    static koksma__light_lanes lights;
    static koksma__beams beams;
    static koksma__shadows shadows;
    static _Alignas(64) koksma__lanes weighed[3];
    const float p = 1e-6f;
    const koksma__surfaces *block = block_of(s, lobes, n);
    memcpy(beams.w, w, sizeof beams.w);
    for (int i = 0; i < n; i++) {
        set_lane(beams.value, i, (const float[3]){1, 1, 1});
        beams.pdf[i] = p;
        lights.probability[i] = 1;
        beams.lit[i] = beams.visible[i] = 1;
    }
    koksma__batch()->reflect(block, &lights, &beams, lobes, KOKSMA__WEIGHT_ONE, n, &shadows, values);
    koksma__batch()->reflect(block, &lights, &beams, lobes, KOKSMA__WEIGHT_BALANCE, n, &shadows, weighed);
    for (int i = 0; i < n; i++) {
        const int k = values[0][i] > 0 ? 0 : values[1][i] > 0 ? 1 : 2;
        densities[i] = values[k][i] > 0 ? p * (values[k][i] / weighed[k][i] - 1) : -1;
    }
}

/* What a name, trial and lobes are called in messages. */
static const char *label(const koksma__bsdf *bsdf, uint64_t trial, unsigned lobes)
{
    static char text[128];
    snprintf(text, sizeof text, "%s (trial %d, lobes %u)", bsdf->kind.name, (int)trial, lobes);
    return text;
}

/* ---- One direction ----------------------------------------------------------------------------------------- */

static void check_samples(const koksma__surface *s, unsigned lobes, const koksma__directions *out, const char *what)
{
    static _Alignas(64) koksma__lanes values[3], densities;
    value_of(s, lobes, out->w, KOKSMA__BLOCK, values, densities);
    for (int i = 0; i < KOKSMA__BLOCK; i++) {
        const double pdf = (double)out->pdf[i], density = (double)densities[i];
        double w[3], weight[3];
        get_lane(out->w, i, w);
        get_lane(out->weight, i, weight);
        if (!out->kept[i]) {
            continue;
        }
        const double length = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
        assert_that(fabs(length - 1) < 1e-4, "%s: a direction of length %g", what, length);
        assert_that(density < 0 || fabs(density - pdf) <= 2e-3 * pdf, "%s: a sample has pdf %g, its direction %g",
                    what, pdf, density);
        for (int k = 0; k < 3; k++) { /* both are 0 of a specular direction */
            const double value = (double)values[k][i];
            assert_that(fabs(value - weight[k] * pdf) <= 2e-3 * value + 1e-9,
                        "%s: value %g is not weight %g times pdf %g", what, value, weight[k], pdf);
        }
    }
}

/* ---- The density, by chi-square, and the energy, by quadrature ---------------------------------------------------
 */

static void integrate(sphere_cells *t, const koksma__surface *s, unsigned lobes, double *density, double energy[3])
{
    static _Alignas(64) koksma__lanes ws[3], values[3], densities;
    *density = energy[0] = energy[1] = energy[2] = 0;
    for (size_t i = 0; i < t->n; i++) {
        cell *c = &t->cells[i];
        for (int j = 0; j < 25 && !c->halves; j++) {
            float w[3];
            from_square(t, c->x + c->width * gauss5[j / 5][0], c->y + c->height * gauss5[j % 5][0], w);
            set_lane(ws, j, w);
        }
        if (!c->halves) {
            value_of(s, lobes, ws, 2 * KOKSMA__LANE_STEP, values, densities);
        }
        for (int j = 0; j < 25 && !c->halves; j++) {
            const double part = 4 * M_PI * c->width * c->height * gauss5[j / 5][1] * gauss5[j % 5][1];
            c->expected += part * fmax((double)densities[j], 0);
            for (int k = 0; k < 3; k++) {
                energy[k] += part * (double)values[k][j];
            }
        }
        *density += c->expected;
        c->expected *= SAMPLES;
    }
}

/* Adds the weights of a block of samples, and their squares, over n. */
static void add_weights(const koksma__directions *out, double n, double sums[3], double squares[3])
{
    for (int i = 0; i < KOKSMA__BLOCK; i++) {
        for (int k = 0; out->kept[i] && k < 3; k++) {
            sums[k] += (double)out->weight[k][i] / n;
            squares[k] += (double)(out->weight[k][i] * out->weight[k][i]) / n;
        }
    }
}

static void check_density(const koksma__surface *s, unsigned lobes, uint64_t stream, const char *what)
{
    double(*points)[2] = malloc(SAMPLES * sizeof *points), sums[3] = {0}, squares[3] = {0}, highest = 0, density;
    double energy[3], limit;
    sphere_cells t = {.n = 0};
    size_t n = 0, kept = 0;
    assert_non_null(points);
    memcpy(t.axis, s->n, sizeof t.axis);
    frame3(t.axis, t.u, t.v);
    for (uint64_t first = 0; first < SAMPLES; first += KOKSMA__BLOCK) {
        const koksma__directions *out = sample_of(s, lobes, stream, first);
        if (first % (8 * KOKSMA__BLOCK) == 0) {
            check_samples(s, lobes, out, what);
        }
        for (int i = 0; i < KOKSMA__BLOCK; i++) {
            const float w[3] = {out->w[0][i], out->w[1][i], out->w[2][i]};
            if (out->kept[i]) {
                to_square(&t, w, &points[n][0], &points[n][1]);
                highest = fmax(highest, (double)out->pdf[i]);
                n++;
            }
        }
    }
    if (highest < (lobes & (lobes - 1) ? SHARPEST / 10 : SHARPEST)) { /* of two lobes one may have a tenth */
        make_cells(&t, points, n, CELL);
        integrate(&t, s, lobes, &density, energy);
        for (uint64_t first = 0; first < SAMPLES; first += KOKSMA__BLOCK) { /* others than those of the cells */
            const koksma__directions *out = sample_of(s, lobes, stream + 500000, first);
            add_weights(out, SAMPLES, sums, squares);
            for (int i = 0; i < KOKSMA__BLOCK; i++) {
                const float w[3] = {out->w[0][i], out->w[1][i], out->w[2][i]};
                if (out->kept[i]) {
                    kept++;
                    count_direction(&t, w);
                }
            }
        }
        const double share = (double)kept / SAMPLES, error = sqrt(share * (1 - share) / SAMPLES);
        assert_that(fabs(density - share) <= 5 * error + 2e-3,
                    "%s: the density integrates to %g, and %g of the samples are not lost", what, density, share);
        const double chi = chi_square(&t, &limit);
        assert_that(chi <= limit, "%s: samples don't match the density: chi-square %g, limit %g", what, chi, limit);
        for (int k = 0; k < 3; k++) {
            const double spread = sqrt(fmax(squares[k] - sums[k] * sums[k], 0) / SAMPLES);
            assert_that(energy[k] <= 1 + 2e-3, "%s: reflects %g of what it gets (quadrature)", what, energy[k]);
            assert_that(fabs(energy[k] - sums[k]) <= 5 * spread + 2e-3,
                        "%s: reflects %g by quadrature, %g +- %g by samples", what, energy[k], sums[k], spread);
        }
    }
    free(points);
    free(t.cells);
}

TEST_CASE(densities_are_those_of_the_samples)
{
    for (size_t b = 0; koksma__bsdfs[b]; b++) {
        const koksma__bsdf *bsdf = koksma__bsdfs[b];
        for (uint64_t trial = 0; trial < TRIALS; trial++) {
            koksma_scene *scene = made(bsdf, 100 * b + trial);
            koksma__shading_material m = koksma__shading_material_of(&scene->materials[0]);
            draw_texture(100 * b + trial, &m);
            const koksma__surface s = surface_of(&m, 100 * b + trial, 0);
            const unsigned smooth = bsdf->lobes & ~(unsigned)KOKSMA__LOBE_SPECULAR;
            const unsigned one = trial % 3 == 1 ? KOKSMA__LOBE_DIFFUSE : KOKSMA__LOBE_GLOSSY;
            const unsigned lobes = trial % 3 == 0 || !(smooth & one) ? smooth : one;
            if (smooth) {
                check_density(&s, lobes, 77 * b + trial, label(bsdf, trial, lobes));
            }
            koksma_scene_close(scene);
        }
    }
}

/* ---- Many angles -------------------------------------------------------------------------------------------- */

static void check_energy(const koksma__surface *s, uint64_t stream, const char *what)
{
    enum { N = 2 * KOKSMA__BLOCK };
    double sums[3] = {0}, squares[3] = {0};
    for (uint64_t first = 0; first < N; first += KOKSMA__BLOCK) {
        const koksma__directions *out = sample_of(s, s->material->bsdf->lobes, stream, first);
        check_samples(s, s->material->bsdf->lobes, out, what);
        add_weights(out, N, sums, squares);
    }
    for (int k = 0; k < 3; k++) {
        const double spread = sqrt(fmax(squares[k] - sums[k] * sums[k], 0) / N);
        assert_that(sums[k] <= 1 + 5 * spread + 1e-4, "%s: reflects %g +- %g of what it gets", what, sums[k], spread);
    }
}

static void check_reciprocity(const koksma__surface *s, uint64_t stream, const char *what)
{
    static _Alignas(64) koksma__lanes ws[3], outs[3], theres[3], backs[3], densities;
    const unsigned lobes = s->material->bsdf->lobes;
    for (uint64_t i = 0; i < 20; i++) {
        float w[3];
        draw_unit(stream, i, w);
        const float cosine = koksma__dot3(s->n, w), seen = koksma__dot3(s->n, s->out);
        if (cosine < 0.05f) {
            continue;
        }
        koksma__surface other = *s;
        memcpy(other.out, w, sizeof w);
        for (int lane = 0; lane < KOKSMA__LANE_STEP; lane++) {
            set_lane(ws, lane, w);
            set_lane(outs, lane, s->out);
        }
        value_of(s, lobes, ws, KOKSMA__LANE_STEP, theres, densities);
        value_of(&other, lobes, outs, KOKSMA__LANE_STEP, backs, densities);
        for (int k = 0; k < 3; k++) {
            const double a = (double)(theres[k][0] / cosine), b = (double)(backs[k][0] / seen);
            assert_that(fabs(a - b) <= 2e-3 * fmax(a, b) + 1e-6,
                        "%s: claims reciprocity, but has %g one way and %g the other", what, a, b);
            assert_that(!s->material->bsdf->is_lambert || fabs(a - (double)s->albedo[k] / M_PI) <= 1e-5,
                        "%s: claims to be Lambert, but has %g with albedo %g", what, a, (double)s->albedo[k]);
        }
    }
}

/* Light that comes along the direction must be able to leave along out, with the same weight. */
static void check_specular(const koksma__surface *s, const float w[3], const char *what)
{
    koksma__surface other = *s;
    const bool through = koksma__dot3(s->n, w) < 0;
    double nearest = 4;
    memcpy(other.out, w, sizeof other.out);
    for (int k = 0; k < 3; k++) {
        other.n[k] = through ? -s->n[k] : s->n[k];
    }
    other.inside = through ? !s->inside : s->inside;
    for (uint64_t i = 0; i < 4096; i++) {
        const float u[2] = {0.5f, 0.5f};
        koksma__scatter back;
        if (s->material->bsdf->sample(&other, KOKSMA__LOBE_SPECULAR, u, ((float)i + 0.5f) / 4096, &back)) {
            double square = 0;
            for (int k = 0; k < 3; k++) {
                square += (double)(back.w[k] - s->out[k]) * (double)(back.w[k] - s->out[k]);
            }
            nearest = fmin(nearest, square);
        }
    }
    assert_that(nearest < 1e-6, "%s: no way back from a specular direction (off by %g)", what, sqrt(nearest));
}

TEST_CASE(no_energy_is_gained_at_any_angle)
{
    for (size_t b = 0; koksma__bsdfs[b]; b++) {
        const koksma__bsdf *bsdf = koksma__bsdfs[b];
        for (uint64_t trial = 0; trial < ANGLES; trial++) {
            koksma_scene *scene = made(bsdf, 5000 + 1000 * b + trial);
            koksma__shading_material m = koksma__shading_material_of(&scene->materials[0]);
            draw_texture(1000 * b + trial, &m);
            const koksma__surface s = surface_of(&m, 1000 * b + trial, trial);
            const char *what = label(bsdf, trial, bsdf->lobes);
            const koksma__directions *way = sample_of(&s, KOKSMA__LOBE_SPECULAR, trial, 0);
            const float w[3] = {way->w[0][0], way->w[1][0], way->w[2][0]};
            koksma__scatter out, other;
            if (bsdf->lobes & KOKSMA__LOBE_SPECULAR && way->kept[0]) {
                check_specular(&s, w, what);
            }
            check_energy(&s, 3000 * b + trial, what);
            if (bsdf->reciprocal) {
                check_reciprocity(&s, 400 * b + trial, what);
            }
            if (bsdf->split) {
                bsdf->split(&s, &out, &other);
                for (int k = 0; k < 3; k++) {
                    assert_true(out.weight[k] >= 0 && other.weight[k] >= 0 &&
                                out.weight[k] + other.weight[k] < 1.00001f);
                }
            }
            way = sample_of(&s, ~bsdf->lobes & 7u, trial, 0);
            for (int i = 0; i < KOKSMA__BLOCK; i++) {
                assert_that(!way->kept[i] || !(way->weight[0][i] + way->weight[1][i] + way->weight[2][i] > 0),
                            "%s: gives light of lobes that it doesn't have", what);
            }
            koksma_scene_close(scene);
        }
    }
}
