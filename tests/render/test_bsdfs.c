/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Every line of materials.def, with parameters drawn from the ranges that it declares:
 *
 *   - what sample() returns is what value() says of that direction: pdf, and value = weight pdf
 *   - directions fall where the density says, by chi-square in cells that are fine where samples are, and the density
 *     integrates to the share of samples that are not lost
 *   - no energy is gained: the integral of value, by quadrature, is at most 1, and the mean weight agrees with it
 *   - a claim of reciprocity or of being Lambert holds; lobes that aren't asked for give nothing
 *   - a specular direction leads back where it came from, and both directions of glass share at most 1
 *
 * Lobes whose density is above SHARPEST are left out of the comparison with the density: floats of directions don't
 * resolve them (tests/render/test_materials.c has those of ggx).
 */
#include "kinds.h"
#include "render/materials/materials.h"
#include "render/vector3.h"

enum { TRIALS = test_repeats(24, 4), SAMPLES = 20000, CELL = 12, ANGLES = test_repeats(300, 60) };
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

/* Of kinds with images: in half of the cases what an image says here, by its factors and a base colour. */
static void draw_texture(uint64_t stream, koksma__surface *s)
{
    static float local[KOKSMA__LOCAL];
    const koksma__shading_material *m = s->material;
    if (m->bsdf->texture && draw(stream, 950) < 0.5) {
        const float factors[2] = {(float)draw(stream, 951), draw(stream, 952) < 0.3 ? 1 : (float)draw(stream, 953)};
        for (uint64_t k = 0; k < 3; k++) {
            s->albedo[k] = draw(stream, 960) < 0.3 ? 1 : (float)draw(stream, 954 + k);
        }
        m->bsdf->texture(m, factors, s->albedo, local);
        s->local = local;
    }
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
    draw_texture(stream, &s);
    return s;
}

static bool sample_of(const koksma__surface *s, unsigned lobes, uint64_t stream, uint64_t i, koksma__scatter *out)
{
    const float u[2] = {(float)draw(stream, 3 * i) * 0.9999999f, (float)draw(stream, 3 * i + 1) * 0.9999999f};
    return s->material->bsdf->sample(s, lobes, u, (float)draw(stream, 3 * i + 2) * 0.9999999f, out);
}

/* What a name, trial and lobes are called in messages. */
static const char *label(const koksma__bsdf *bsdf, uint64_t trial, unsigned lobes)
{
    static char text[128];
    snprintf(text, sizeof text, "%s (trial %d, lobes %u)", bsdf->kind.name, (int)trial, lobes);
    return text;
}

/* ---- One direction ----------------------------------------------------------------------------------------- */

static void check_sample(const koksma__surface *s, unsigned lobes, const koksma__scatter *out, const char *what)
{
    float value[3] = {0, 0, 0};
    const double length = sqrt((double)koksma__dot3(out->w, out->w));
    const float pdf = s->material->bsdf->value(s, out->w, lobes, value);
    assert_that(fabs(length - 1) < 1e-4, "%s: a direction of length %g", what, length);
    assert_that(out->lobe & lobes, "%s: a direction of lobe %u", what, out->lobe);
    if (out->lobe == KOKSMA__LOBE_SPECULAR) {
        assert_that(out->pdf == 0 && pdf == 0 && koksma__max3(value) == 0, "%s: a specular direction with a density",
                    what);
        return;
    }
    assert_that(fabs((double)(pdf - out->pdf)) <= 2e-3 * (double)out->pdf, "%s: sample() says pdf %g, value() %g",
                what, (double)out->pdf, (double)pdf);
    for (int k = 0; k < 3; k++) {
        assert_that(fabs((double)(value[k] - out->weight[k] * out->pdf)) <= 2e-3 * (double)value[k] + 1e-9,
                    "%s: value %g is not weight %g times pdf %g", what, (double)value[k], (double)out->weight[k],
                    (double)out->pdf);
    }
}

/* ---- The density, by chi-square, and the energy, by quadrature ---------------------------------------------------
 */

static void integrate(sphere_cells *t, const koksma__surface *s, unsigned lobes, double *density, double energy[3])
{
    *density = energy[0] = energy[1] = energy[2] = 0;
    for (size_t i = 0; i < t->n; i++) {
        cell *c = &t->cells[i];
        for (int j = 0; j < 25 && !c->halves; j++) {
            const double *x = gauss5[j / 5], *y = gauss5[j % 5];
            const double part = 4 * M_PI * c->width * c->height * x[1] * y[1];
            float w[3], value[3] = {0, 0, 0};
            from_square(t, c->x + c->width * x[0], c->y + c->height * y[0], w);
            c->expected += part * (double)s->material->bsdf->value(s, w, lobes, value);
            for (int k = 0; k < 3; k++) {
                energy[k] += part * (double)value[k];
            }
        }
        *density += c->expected;
        c->expected *= SAMPLES;
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
    for (uint64_t i = 0; i < SAMPLES; i++) {
        koksma__scatter out;
        if (sample_of(s, lobes, stream, i, &out)) {
            check_sample(s, lobes, &out, what);
            to_square(&t, out.w, &points[n][0], &points[n][1]);
            highest = fmax(highest, (double)out.pdf);
            n++;
        }
    }
    if (highest < (lobes & (lobes - 1) ? SHARPEST / 10 : SHARPEST)) { /* of two lobes one may have a tenth */
        make_cells(&t, points, n, CELL);
        integrate(&t, s, lobes, &density, energy);
        for (uint64_t i = 0; i < SAMPLES; i++) { /* others than those that the cells were made of */
            koksma__scatter out;
            if (sample_of(s, lobes, stream + 500000, i, &out)) {
                kept++;
                count_direction(&t, out.w);
                for (int k = 0; k < 3; k++) {
                    sums[k] += (double)out.weight[k] / SAMPLES;
                    squares[k] += (double)(out.weight[k] * out.weight[k]) / SAMPLES;
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
            const koksma__shading_material m = koksma__shading_material_of(&scene->materials[0]);
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
    enum { N = 512 };
    double sums[3] = {0}, squares[3] = {0};
    for (uint64_t i = 0; i < N; i++) {
        koksma__scatter out;
        if (sample_of(s, s->material->bsdf->lobes, stream, i, &out)) {
            check_sample(s, s->material->bsdf->lobes, &out, what);
            for (int k = 0; k < 3; k++) {
                sums[k] += (double)out.weight[k] / N;
                squares[k] += (double)(out.weight[k] * out.weight[k]) / N;
            }
        }
    }
    for (int k = 0; k < 3; k++) {
        const double spread = sqrt(fmax(squares[k] - sums[k] * sums[k], 0) / N);
        assert_that(sums[k] <= 1 + 5 * spread + 1e-4, "%s: reflects %g +- %g of what it gets", what, sums[k], spread);
    }
}

static void check_reciprocity(const koksma__surface *s, uint64_t stream, const char *what)
{
    for (uint64_t i = 0; i < 20; i++) {
        float w[3], there[3] = {0, 0, 0}, back[3] = {0, 0, 0};
        draw_unit(stream, i, w);
        const float cosine = koksma__dot3(s->n, w), seen = koksma__dot3(s->n, s->out);
        if (cosine < 0.05f) {
            continue;
        }
        koksma__surface other = *s;
        memcpy(other.out, w, sizeof w);
        s->material->bsdf->value(s, w, s->material->bsdf->lobes, there);
        s->material->bsdf->value(&other, s->out, s->material->bsdf->lobes, back);
        for (int k = 0; k < 3; k++) {
            const double a = (double)(there[k] / cosine), b = (double)(back[k] / seen);
            assert_that(fabs(a - b) <= 2e-3 * fmax(a, b) + 1e-6,
                        "%s: claims reciprocity, but has %g one way and %g the other", what, a, b);
            assert_that(!s->material->bsdf->is_lambert || fabs(a - (double)s->albedo[k] / M_PI) <= 1e-5,
                        "%s: claims to be Lambert, but has %g with albedo %g", what, a, (double)s->albedo[k]);
        }
    }
}

/* Light that comes along the direction must be able to leave along out, with the same weight. */
static void check_specular(const koksma__surface *s, const koksma__scatter *out, const char *what)
{
    koksma__surface other = *s;
    const bool through = koksma__dot3(s->n, out->w) < 0;
    double nearest = 4;
    memcpy(other.out, out->w, sizeof other.out);
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
            const koksma__shading_material m = koksma__shading_material_of(&scene->materials[0]);
            const koksma__surface s = surface_of(&m, 1000 * b + trial, trial);
            const char *what = label(bsdf, trial, bsdf->lobes);
            koksma__scatter out, other;
            float value[3] = {0, 0, 0};
            check_energy(&s, 3000 * b + trial, what);
            if (bsdf->reciprocal) {
                check_reciprocity(&s, 400 * b + trial, what);
            }
            if (bsdf->lobes & KOKSMA__LOBE_SPECULAR && sample_of(&s, KOKSMA__LOBE_SPECULAR, trial, 0, &out)) {
                check_specular(&s, &out, what);
            }
            if (bsdf->split) {
                bsdf->split(&s, &out, &other);
                for (int k = 0; k < 3; k++) {
                    assert_true(out.weight[k] >= 0 && other.weight[k] >= 0 &&
                                out.weight[k] + other.weight[k] < 1.00001f);
                }
            }
            assert_that(bsdf->value(&s, s.n, ~bsdf->lobes, value) == 0 && koksma__max3(value) == 0 &&
                            !sample_of(&s, ~bsdf->lobes & 7u, trial, 0, &out),
                        "%s: gives light of lobes that it doesn't have", what);
            koksma_scene_close(scene);
        }
    }
}
