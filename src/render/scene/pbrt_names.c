/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The vocabulary of pbrt-v4, so that the reader can name each parameter that pbrt would refuse: pbrt reports an unused
 * parameter as an error, and here it may be a lost light. A row has the parameters of some kinds of a directive, as text:
 * "TYPE NAME NAME; TYPE NAME=VALUE|VALUE", where a list of values is closed, and "~" marks a name that has no effect on
 * the pictures that Koksma makes. The kind "*" stands for all kinds. From pbrt-v4's source of 2024: each name is one that
 * a Create() function of samplers.cpp, lights.cpp, shapes.cpp, ... looks up. `st`, `point`, `vector`, `normal3`, `color`
 * and `exposuretime` are of earlier versions.
 */
#include "scene/pbrt.h"

#include <stdio.h>
#include <string.h>

#include "meshes/mesh_text.h"

/* What pbrt-v4 makes of a parameter. */
typedef enum verdict {
    NO_SUCH_NAME,
    NO_SUCH_TYPE,   /* it has a parameter of this name and another type */
    NO_SUCH_VALUE,  /* its value is not in the parameter's closed list */
    WITHOUT_EFFECT, /* known; it does not change the pictures that Koksma makes */
    KNOWN
} verdict;

typedef struct row {
    const char *directive, *kinds, *names;
} row;

#define RANDOMIZATION "string randomization=none|permutedigits|fastowen|owen"
#define RADII "float xradius yradius"
#define ROUGHNESS "floats roughness uroughness vroughness; bool remaproughness"
#define LENS "float lensradius focaldistance frameaspectratio screenwindow"
#define GRID "integer nx ny nz; point3 p0 p1; float Lescale g scale"
#define MAPPING "string mapping=uv|spherical|cylindrical|planar; float uscale vscale udelta vdelta; vector3 v1 v2"

static const row rows[] = {
    {"Accelerator", "bvh", "string splitmethod=sah|hlbvh|middle|equal; integer maxnodeprims"},
    {"Accelerator", "kdtree", "integer intersectcost traversalcost maxprims maxdepth; float emptybonus"},
    {"AreaLightSource", "diffuse", "colour L; float scale power; bool twosided; string filename"},
    {"Camera", "*", "float shutteropen shutterclose"},
    {"Camera", "perspective", LENS " fov"},
    {"Camera", "orthographic", LENS},
    {"Film", "*",
     "string ~filename sensor; integer xresolution yresolution pixelbounds; bool ~savefp16; float cropwindow "
     "~diagonal "
     "iso whitebalance maxcomponentvalue exposuretime"},
    {"Film", "rgb", ""},
    {"Film", "gbuffer", "string ~coordinatesystem=camera|world"},
    {"Film", "spectral", "integer ~nbuckets; float ~lambdamin ~lambdamax"},
    {"Integrator", "path volpath",
     "integer maxdepth; string lightsampler=uniform|power|bvh|exhaustive; bool regularize"},
    {"Integrator", "simplepath", "integer maxdepth; bool samplelights samplebsdf"},
    {"Integrator", "lightpath simplevolpath randomwalk", "integer maxdepth"},
    {"Integrator", "bdpt", "integer maxdepth; bool visualizestrategies visualizeweights regularize"},
    {"Integrator", "mlt",
     "integer maxdepth bootstrapsamples chains mutationsperpixel; float largestepprobability sigma; bool regularize"},
    {"Integrator", "sppm", "integer maxdepth photonsperiteration seed; float radius"},
    {"Integrator", "ambientocclusion", "bool cossample; float maxdistance"},
    {"Integrator", "function", "string function filename imagefilename; bool skipbad"},
    {"LightSource", "point", "colour I; float scale power; point3 from"},
    {"LightSource", "spot", "colour I; float scale power coneangle conedeltaangle; point3 from to"},
    {"LightSource", "distant", "colour L; float scale illuminance; point3 from to"},
    {"LightSource", "infinite", "colour L; float scale illuminance; point3 portal; string filename"},
    {"LightSource", "goniometric", "colour I; float scale power; string filename"},
    {"LightSource", "projection", "float scale power fov; string filename"},
    {"MakeNamedMaterial", "*", "string ~type"},
    {"MakeNamedMedium", "*", "string ~type"},
    {"MakeNamedMedium", "homogeneous", "string preset; colour sigma_a sigma_s Le; float Lescale scale g"},
    {"MakeNamedMedium", "uniformgrid",
     GRID
     "; colour sigma_a sigma_s Le; float density temperature temperatureoffset temperaturecutoff temperaturescale"},
    {"MakeNamedMedium", "rgbgrid", GRID "; colour sigma_a sigma_s Le"},
    {"MakeNamedMedium", "cloud", "float density g wispiness frequency; colour sigma_a sigma_s; point3 p0 p1"},
    {"MakeNamedMedium", "nanovdb",
     "string filename gridname temperaturename; colour sigma_a sigma_s; float Lescale temperatureoffset "
     "temperaturecutoff temperaturescale g scale"},
    {"Material", "*", "string normalmap; floats displacement"},
    {"Material", "interface none", ""},
    {"Material", "diffuse", "colour reflectance"},
    {"Material", "coateddiffuse",
     "colour reflectance albedo eta; floats thickness g; integer ~maxdepth ~nsamples; " ROUGHNESS},
    {"Material", "coatedconductor",
     "colour reflectance albedo interface.eta conductor.eta conductor.k; floats thickness g interface.roughness "
     "interface.uroughness interface.vroughness conductor.roughness conductor.uroughness conductor.vroughness; "
     "integer ~maxdepth ~nsamples; bool remaproughness"},
    {"Material", "conductor", "colour eta k reflectance; " ROUGHNESS},
    {"Material", "dielectric", "colour eta; " ROUGHNESS},
    {"Material", "thindielectric", "colour eta"},
    {"Material", "mix", "string materials; floats amount"},
    {"Material", "hair", "colour sigma_a reflectance color; floats eumelanin pheomelanin eta beta_m beta_n alpha"},
    {"Material", "measured", "string filename"},
    {"Material", "subsurface", "float g scale eta; string name; colour sigma_a sigma_s reflectance mfp; " ROUGHNESS},
    {"Material", "diffusetransmission", "colour reflectance transmittance; float scale"},
    {"PixelFilter", "box triangle", RADII},
    {"PixelFilter", "gaussian", RADII " sigma"},
    {"PixelFilter", "mitchell", RADII " B C"},
    {"PixelFilter", "sinc", RADII " tau"},
    {"Sampler", "*", "integer seed"},
    {"Sampler", "halton paddedsobol sobol zsobol", "integer pixelsamples; " RANDOMIZATION},
    {"Sampler", "independent pmj02bn", "integer pixelsamples"},
    {"Sampler", "stratified", "bool jitter; integer xsamples ysamples"},
    {"Shape", "*", "floats alpha"},
    {"Shape", "sphere cylinder", "float radius zmin zmax phimax"},
    {"Shape", "disk", "float height radius innerradius phimax"},
    {"Shape", "trianglemesh", "integer indices ~faceIndices; point3 P; point2 uv st; vector3 ~S; normal N"},
    {"Shape", "bilinearmesh",
     "integer indices ~faceIndices; point3 P; point2 uv st; normal N; string emissionfilename"},
    {"Shape", "curve",
     "float width width0 width1; integer degree splitdepth; string basis=bezier|bspline type=flat|ribbon|cylinder; "
     "point3 P; normal N"},
    {"Shape", "plymesh", "string filename; float edgelength; floats displacement"},
    {"Shape", "loopsubdiv", "integer levels indices; point3 P; string ~scheme"},
    {"Texture", "constant", "colour value"},
    {"Texture", "bilerp", "colour v00 v01 v10 v11; " MAPPING},
    {"Texture", "checkerboard", "integer dimension; colour tex1 tex2; " MAPPING},
    {"Texture", "dots", "colour inside outside; " MAPPING},
    {"Texture", "fbm wrinkled", "integer octaves; float roughness"},
    {"Texture", "windy", ""},
    {"Texture", "marble", "integer octaves; float roughness scale variation"},
    {"Texture", "imagemap",
     "float ~maxanisotropy scale; string filename encoding ~filter=point|bilinear|trilinear|ewa|EWA "
     "wrap=repeat|black|clamp|octahedralsphere; bool invert; " MAPPING},
    {"Texture", "ptex", "string filename encoding; float scale"},
    {"Texture", "mix", "colour tex1 tex2; floats amount"},
    {"Texture", "directionmix", "colour tex1 tex2; vector3 dir"},
    {"Texture", "scale", "colour tex; floats scale"},
    {"Option", "*",
     "bool disablepixeljitter disabletexturefiltering disablewavelengthjitter forcediffuse pixelstats wavefront; "
     "float "
     "displacementedgescale; string msereferenceimage msereferenceout rendercoordsys=camera|cameraworld|world; "
     "integer seed"}};

/* The classes of types, and the types that pbrt takes for each; it looks up a colour as a texture or spectrum. */
static const struct {
    const char *name, *types;
} classes[] = {{"colour", "rgb spectrum blackbody texture float color"},
               {"floats", "float texture"},
               {"point2", "point2 float"},
               {"point3", "point3 point"},
               {"vector3", "vector3 vector"},
               {"normal", "normal normal3"}};

/* A name of a row; texts that refer to the row. */
typedef struct entry {
    const char *type, *at, *values; /* values: NULL, or a closed list */
    size_t type_length, length, values_length;
    bool without_effect;
} entry;

/* Takes the next name from a row's text; e->type is that of the name before it. */
static bool next(const char **text, entry *e)
{
    const char *word = *text + strspn(*text, " ");
    bool is_type = !e->type;
    if (*word == ';') {
        word += 1 + strspn(word + 1, " ");
        is_type = true;
    }
    if (!*word) {
        return false;
    }
    if (is_type) {
        e->type = word;
        e->type_length = strcspn(word, " ");
        word += e->type_length;
        word += strspn(word, " ");
    }
    e->without_effect = *word == '~';
    word += e->without_effect;
    const size_t whole = strcspn(word, " ;");
    e->at = word;
    e->length = strcspn(word, " ;=");
    e->values = word[e->length] == '=' ? word + e->length + 1 : NULL;
    e->values_length = e->values ? whole - e->length - 1 : 0;
    *text = word + whole;
    return true;
}

/* Whether a list of words, separated by a character, has this word. */
static bool lists(const char *list, size_t size, char separator, const char *word)
{
    const size_t length = strlen(word);
    for (size_t from = 0, to; from < size; from = to + 1) {
        const char *end = memchr(list + from, separator, size - from);
        to = end ? (size_t)(end - list) : size;
        if (to - from == length && !memcmp(list + from, word, length)) {
            return true;
        }
    }
    return false;
}

/* Materials have one vocabulary, whether they have a name or not. */
static bool is_of(const row *r, const char *directive)
{
    return !strcmp(r->directive, directive) ||
           (!strcmp(directive, "MakeNamedMaterial") && !strcmp(r->directive, "Material"));
}

bool koksma__pbrt_is_kind(const char *directive, const char *kind)
{
    bool has_kinds = false;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (is_of(&rows[i], directive) && *rows[i].kinds != '*') {
            has_kinds = true;
            if (lists(rows[i].kinds, strlen(rows[i].kinds), ' ', kind)) {
                return true;
            }
        }
    }
    return !has_kinds;
}

static bool takes_type(const entry *e, const koksma__pbrt_parameter *p)
{
    for (size_t i = 0; i < sizeof classes / sizeof *classes; i++) {
        if (koksma__text_is(e->type, e->type_length, classes[i].name)) {
            return koksma__pbrt_is(p, classes[i].types);
        }
    }
    return koksma__text_is(e->type, e->type_length, p->type);
}

/* The names or values among which the nearest to a misspelt one is searched. */
typedef struct candidates {
    char names[96][40];
    size_t n;
} candidates;

static void add(candidates *to, const char *at, size_t length)
{
    if (to->n < sizeof to->names / sizeof *to->names) {
        snprintf(to->names[to->n++], sizeof *to->names, "%.*s", (int)length, at);
    }
}

static const char *candidate(const void *from, size_t i)
{
    const candidates *c = from;
    return i < c->n ? c->names[i] : NULL;
}

static void find_nearest(const candidates *c, const char *name, char nearest[40])
{
    const char *found = koksma_closest_name(name, candidate, c);
    snprintf(nearest, 40, "%s", found ? found : "");
}

static verdict judge_value(const entry *e, const koksma__pbrt_parameter *p, char nearest[40])
{
    candidates values = {.n = 0};
    if (!e->values || lists(e->values, e->values_length, '|', p->text)) {
        return e->without_effect ? WITHOUT_EFFECT : KNOWN;
    }
    for (size_t from = 0; from < e->values_length; from++) {
        const size_t length = strcspn(e->values + from, "| ;");
        add(&values, e->values + from, length);
        from += length;
    }
    find_nearest(&values, p->text, nearest);
    return NO_SUCH_VALUE;
}

/* Judges a parameter. For a name or value that does not exist, `nearest` is the one that may be meant, or empty; for a
   type, the class of types that the parameter has. */
static verdict judge(const char *directive, const char *kind, const koksma__pbrt_parameter *p, char nearest[40])
{
    const bool all = !kind || !koksma__pbrt_is_kind(directive, kind);
    verdict best = NO_SUCH_NAME;
    candidates names = {.n = 0};
    *nearest = 0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const char *text = rows[i].names;
        entry e = {0};
        if (!is_of(&rows[i], directive) ||
            !(all || *rows[i].kinds == '*' || lists(rows[i].kinds, strlen(rows[i].kinds), ' ', kind))) {
            continue;
        }
        while (next(&text, &e)) {
            add(&names, e.at, e.length);
            if (!koksma__text_is(e.at, e.length, p->name)) {
                continue;
            }
            if (takes_type(&e, p)) {
                return judge_value(&e, p, nearest);
            }
            best = NO_SUCH_TYPE;
            snprintf(nearest, 40, "%.*s", (int)e.type_length, e.type);
        }
    }
    if (best == NO_SUCH_NAME) {
        find_nearest(&names, p->name, nearest);
    }
    return best;
}

koksma_status koksma__pbrt_name_unused(koksma__import *im, const char *directive, const char *kind,
                                       const koksma__pbrt_parameters *p)
{
    for (size_t i = p->n_inherited; i < p->n; i++) {
        char nearest[40];
        if (!p->used[i] && judge(directive, kind, &p->items[i], nearest) == KNOWN) {
            KOKSMA__TRY(koksma__import_unknown(im, (koksma__text_place){p->place.file, p->items[i].line},
                                               "parameter '%s' of %s is ignored", p->items[i].name, directive));
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma__pbrt_name_parameters(koksma__import *im, const char *directive, const char *kind,
                                           const koksma__pbrt_parameters *p)
{
    for (size_t i = p->n_inherited; i < p->n; i++) {
        const koksma__pbrt_parameter *at = &p->items[i];
        const koksma__text_place place = {p->place.file, at->line};
        char nearest[40];
        koksma_status status = KOKSMA_OK;
        switch (judge(directive, kind, at, nearest)) {
        case NO_SUCH_NAME:
            status = koksma__import_unknown(im, place, "parameter '%s' of %s is unknown%s%s%s", at->name, directive,
                                            *nearest ? "; did you mean '" : "", nearest, *nearest ? "'?" : "");
            break;
        case NO_SUCH_TYPE:
            status = koksma__import_unknown(im, place, "parameter '%s' of %s has the type '%s'; pbrt reads it as %s",
                                            at->name, directive, at->type, nearest);
            break;
        case NO_SUCH_VALUE:
            status =
                koksma__import_unknown(im, place, "%s of %s: the value '%.40s' is unknown%s%s%s", at->name, directive,
                                       at->text, *nearest ? "; did you mean '" : "", nearest, *nearest ? "'?" : "");
            break;
        case KNOWN:
        case WITHOUT_EFFECT:
            break;
        }
        KOKSMA__TRY(status);
    }
    return KOKSMA_OK;
}
