/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The table of pbrt-v4's plug-ins (its form: plugins.c), with what is made of its materials. Values are read by it, with
 * its defaults, and each parameter is named that pbrt would refuse: pbrt reports an unused parameter as an error, and
 * here it may be a lost light. From pbrt-v4's source of 2024: each name is one that a Create() function of samplers.cpp,
 * lights.cpp, shapes.cpp, ... looks up. `st`, `point`, `vector`, `normal3`, `color` and `exposuretime` are of earlier
 * versions.
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

#define RANDOMIZATION "string randomization=none|permutedigits|fastowen|owen"
#define RADII "float xradius yradius"
#define ROUGHNESS "floats roughness uroughness vroughness; bool remaproughness:1"
#define LENS "float lensradius focaldistance:1e6 frameaspectratio screenwindow"
#define GRID "integer nx ny nz; point3 p0 p1; float Lescale g scale:1"
#define MAPPING "string mapping=uv|spherical|cylindrical|planar; float uscale:1 vscale:1 udelta vdelta; vector3 v1 v2"

/* A row that the tables of values need not know more about. */
#define ROW(of, kinds, parameters)                                                                                   \
    {                                                                                                                \
        of, kinds, parameters, 0, NULL                                                                               \
    }

static const koksma__plugin rows[] = {
    ROW("Accelerator", "bvh", "string splitmethod=sah|hlbvh|middle|equal; integer maxnodeprims"),
    ROW("Accelerator", "kdtree", "integer intersectcost traversalcost maxprims maxdepth; float emptybonus"),
    ROW("AreaLightSource", "diffuse", "colour L; float scale:1 power; bool twosided; string filename"),
    ROW("Camera", "*", "float shutteropen shutterclose:1"),
    ROW("Camera", "perspective", LENS " fov:90"),
    ROW("Camera", "orthographic", LENS),
    ROW("Film", "*",
        "string ~filename sensor; integer xresolution:1280 yresolution:720 pixelbounds; bool ~savefp16; "
        "float cropwindow ~diagonal iso:100 whitebalance maxcomponentvalue exposuretime"),
    ROW("Film", "rgb", ""),
    ROW("Film", "gbuffer", "string ~coordinatesystem=camera|world"),
    ROW("Film", "spectral", "integer ~nbuckets; float ~lambdamin ~lambdamax"),
    ROW("Integrator", "path volpath",
        "integer maxdepth; string lightsampler=uniform|power|bvh|exhaustive; bool regularize"),
    ROW("Integrator", "simplepath", "integer maxdepth; bool samplelights samplebsdf"),
    ROW("Integrator", "lightpath simplevolpath randomwalk", "integer maxdepth"),
    ROW("Integrator", "bdpt", "integer maxdepth; bool visualizestrategies visualizeweights regularize"),
    ROW("Integrator", "mlt",
        "integer maxdepth bootstrapsamples chains mutationsperpixel; float largestepprobability sigma; "
        "bool regularize"),
    ROW("Integrator", "sppm", "integer maxdepth photonsperiteration seed; float radius"),
    ROW("Integrator", "ambientocclusion", "bool cossample; float maxdistance"),
    ROW("Integrator", "function", "string function filename imagefilename; bool skipbad"),
    ROW("LightSource", "point", "colour I; float scale:1 power; point3 from"),
    ROW("LightSource", "spot", "colour I; float scale:1 power coneangle:30 conedeltaangle:5; point3 from to"),
    ROW("LightSource", "distant", "colour L; float scale:1 illuminance; point3 from to"),
    ROW("LightSource", "infinite", "colour L; float scale:1 illuminance; point3 portal; string filename"),
    ROW("LightSource", "goniometric", "colour I; float scale:1 power; string filename"),
    ROW("LightSource", "projection", "float scale:1 power fov; string filename"),
    ROW("MakeNamedMaterial", "*", "string ~type"),
    ROW("MakeNamedMedium", "*", "string ~type"),
    ROW("MakeNamedMedium", "homogeneous", "string preset; colour sigma_a sigma_s Le; float Lescale scale:1 g"),
    ROW("MakeNamedMedium", "uniformgrid",
        GRID "; colour sigma_a sigma_s Le; float density temperature temperatureoffset temperaturecutoff "
             "temperaturescale"),
    ROW("MakeNamedMedium", "rgbgrid", GRID "; colour sigma_a sigma_s Le"),
    ROW("MakeNamedMedium", "cloud", "float density g wispiness frequency; colour sigma_a sigma_s; point3 p0 p1"),
    ROW("MakeNamedMedium", "nanovdb",
        "string filename gridname temperaturename; colour sigma_a sigma_s; float Lescale temperatureoffset "
        "temperaturecutoff temperaturescale g scale"),
    ROW("Material", "*", "string normalmap; floats displacement"),
    {"Material", "?", "colour reflectance", KOKSMA__MATTE, "matte"},
    {"Material", "interface none", "", KOKSMA__NOTHING, NULL},
    {"Material", "diffuse", "colour reflectance", KOKSMA__MATTE, NULL},
    {"Material", "coateddiffuse",
     "colour reflectance albedo eta:1.5; floats thickness g; integer ~maxdepth ~nsamples; " ROUGHNESS, KOKSMA__COATED,
     NULL},
    {"Material", "coatedconductor",
     "colour reflectance albedo interface.eta conductor.eta conductor.k; floats thickness g interface.roughness "
     "interface.uroughness interface.vroughness conductor.roughness conductor.uroughness conductor.vroughness; "
     "integer ~maxdepth ~nsamples; bool remaproughness:1",
     KOKSMA__METAL, "a metal without a coat"},
    {"Material", "conductor", "colour eta k reflectance; " ROUGHNESS, KOKSMA__METAL, NULL},
    {"Material", "dielectric", "colour eta:1.5; " ROUGHNESS, KOKSMA__GLASS, NULL},
    {"Material", "thindielectric", "colour eta", KOKSMA__NOTHING, "nothing"},
    {"Material", "mix", "string materials; floats amount", 0, NULL},
    {"Material", "hair", "colour color reflectance sigma_a; floats eumelanin pheomelanin eta beta_m beta_n alpha",
     KOKSMA__MATTE, "matte"},
    {"Material", "measured", "string filename", KOKSMA__MATTE, "matte grey"},
    {"Material", "subsurface",
     "colour reflectance sigma_a sigma_s mfp; float g scale eta:1.5; string name; " ROUGHNESS, KOKSMA__COATED,
     "a coated surface"},
    {"Material", "diffusetransmission", "colour reflectance transmittance; float scale", KOKSMA__MATTE,
     "matte and opaque"},
    ROW("PixelFilter", "box triangle", RADII),
    ROW("PixelFilter", "gaussian", RADII " sigma"),
    ROW("PixelFilter", "mitchell", RADII " B C"),
    ROW("PixelFilter", "sinc", RADII " tau"),
    ROW("Sampler", "*", "integer seed"),
    ROW("Sampler", "halton paddedsobol sobol zsobol", "integer pixelsamples; " RANDOMIZATION),
    ROW("Sampler", "independent pmj02bn", "integer pixelsamples"),
    ROW("Sampler", "stratified", "bool jitter; integer xsamples ysamples"),
    ROW("Shape", "*", "floats alpha"),
    ROW("Shape", "sphere cylinder", "float radius:1 zmin:-1 zmax:1 phimax:360"),
    ROW("Shape", "disk", "float height radius:1 innerradius phimax:360"),
    ROW("Shape", "trianglemesh", "integer indices ~faceIndices; point3 P; point2 uv st; vector3 ~S; normal N"),
    ROW("Shape", "bilinearmesh",
        "integer indices ~faceIndices; point3 P; point2 uv st; normal N; string emissionfilename"),
    ROW("Shape", "curve",
        "float width width0 width1; integer degree splitdepth; string basis=bezier|bspline "
        "type=flat|ribbon|cylinder; "
        "point3 P; normal N"),
    ROW("Shape", "plymesh", "string filename; float edgelength; floats displacement"),
    ROW("Shape", "loopsubdiv", "integer levels:3 indices; point3 P; string ~scheme"),
    ROW("Texture", "constant", "colour value"),
    ROW("Texture", "bilerp", "colour v00 v01 v10 v11; " MAPPING),
    ROW("Texture", "checkerboard", "integer dimension:2; colour tex1 tex2; " MAPPING),
    ROW("Texture", "dots", "colour inside outside; " MAPPING),
    ROW("Texture", "fbm wrinkled", "integer octaves; float roughness"),
    ROW("Texture", "windy", ""),
    ROW("Texture", "marble", "integer octaves; float roughness scale variation"),
    ROW("Texture", "imagemap",
        "float ~maxanisotropy scale:1; string filename encoding ~filter=bilinear|point|trilinear|ewa|EWA "
        "wrap=repeat|black|clamp|octahedralsphere; bool invert; " MAPPING),
    ROW("Texture", "ptex", "string filename encoding; float scale"),
    ROW("Texture", "mix", "colour tex1 tex2; floats amount"),
    ROW("Texture", "directionmix", "colour tex1 tex2; vector3 dir"),
    ROW("Texture", "scale", "colour tex; floats scale"),
    ROW("Option", "*",
        "bool disablepixeljitter disabletexturefiltering disablewavelengthjitter forcediffuse pixelstats wavefront; "
        "float displacementedgescale; string msereferenceimage msereferenceout "
        "rendercoordsys=camera|cameraworld|world; "
        "integer seed")};

/* The classes of types, and the types that pbrt takes for each; it looks up a colour as a texture or spectrum. */
static const struct {
    const char *name, *types;
} classes[] = {{"colour", "rgb spectrum blackbody texture float color"},
               {"floats", "float texture"},
               {"point2", "point2 float"},
               {"point3", "point3 point"},
               {"vector3", "vector3 vector"},
               {"normal", "normal normal3"}};

const koksma__plugins koksma__pbrt_plugins = {rows, sizeof rows / sizeof *rows};

/* Materials have one vocabulary, whether they have a name or not. */
static bool is_of(const koksma__plugin *row, const char *directive)
{
    return !strcmp(row->of, directive) || (!strcmp(directive, "MakeNamedMaterial") && !strcmp(row->of, "Material"));
}

static bool has_kind(const koksma__plugin *row, const char *kind)
{
    return koksma__lists(row->kinds, strlen(row->kinds), ' ', kind);
}

bool koksma__pbrt_is_kind(const char *directive, const char *kind)
{
    bool has_kinds = false;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (is_of(&rows[i], directive) && !strchr("*?", *rows[i].kinds)) {
            has_kinds = true;
            if (has_kind(&rows[i], kind)) {
                return true;
            }
        }
    }
    return !has_kinds;
}

/* Writes what to do with a name of pbrt-v3's materials. Returns whether it is one. */
static bool is_old(const char *name, char text[KOKSMA__OR_MEANT])
{
    static const char old[] = "Kd Ks Kr Kt disney fourier glass kdsubsurface matte metal mirror plastic substrate "
                              "translucent uber";
    const bool found = koksma__lists(old, strlen(old), ' ', name);
    snprintf(text, KOKSMA__OR_MEANT, "%s",
             found ? "; of pbrt-v3: 'pbrt --upgrade FILE' makes it one of pbrt-v4" : "");
    return found;
}

const char *koksma__pbrt_kind_meant(const char *directive, const char *kind, char *text)
{
    *text = '\0';
    const char *of = strcmp(directive, "MakeNamedMaterial") ? directive : "Material";
    return koksma__pbrt_is_kind(directive, kind) || (!strcmp(of, "Material") && is_old(kind, text))
               ? text
               : koksma__kind_meant(&koksma__pbrt_plugins, of, kind, text);
}

static bool takes_type(const koksma__entry *e, const koksma__pbrt_parameter *p)
{
    for (size_t i = 0; i < sizeof classes / sizeof *classes; i++) {
        if (koksma__text_is(e->type, e->type_length, classes[i].name)) {
            return koksma__pbrt_is(p, classes[i].types);
        }
    }
    return koksma__text_is(e->type, e->type_length, p->type);
}

static verdict judge_value(const koksma__entry *e, const koksma__pbrt_parameter *p, char meant[KOKSMA__OR_MEANT])
{
    koksma__word_list values = {.n = 0};
    if (!e->values || koksma__lists(e->values, e->values_length, '|', p->text)) {
        return e->without_effect ? WITHOUT_EFFECT : KNOWN;
    }
    koksma__word_list_add(&values, e->values, e->values_length, "|", "|");
    koksma__or_meant(koksma__word_list_closest(&values, p->text), meant);
    return NO_SUCH_VALUE;
}

/* Judges a parameter. For a name or value that does not exist, `meant` asks for the one that may be meant, or is empty; for
   a type, it is the class of types that the parameter has. */
static verdict judge(const char *directive, const char *kind, const koksma__pbrt_parameter *p,
                     char meant[KOKSMA__OR_MEANT])
{
    const bool all = !kind || !koksma__pbrt_is_kind(directive, kind);
    verdict best = NO_SUCH_NAME;
    koksma__word_list names = {.n = 0};
    *meant = 0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (!is_of(&rows[i], directive) || !(all || *rows[i].kinds == '*' || has_kind(&rows[i], kind))) {
            continue;
        }
        for (koksma__entry e = koksma__entries_of(&rows[i]); koksma__entry_next(&e);) {
            koksma__word_list_add(&names, e.name, e.length, "", "");
            if (!koksma__text_is(e.name, e.length, p->name)) {
                continue;
            }
            if (takes_type(&e, p)) {
                return judge_value(&e, p, meant);
            }
            best = NO_SUCH_TYPE;
            snprintf(meant, KOKSMA__OR_MEANT, "%.*s", (int)e.type_length, e.type);
        }
    }
    if (best == NO_SUCH_NAME && !is_old(p->name, meant)) {
        koksma__or_meant(koksma__word_list_closest(&names, p->name), meant);
    }
    return best;
}

void koksma__pbrt_name_unused(const koksma__pbrt_parameters *p)
{
    for (size_t i = p->n_inherited; i < p->n; i++) {
        char meant[KOKSMA__OR_MEANT];
        const koksma__text_place place = {p->place.im, p->place.file, p->items[i].line};
        koksma__import_unknown_if(!p->used[i] && judge(p->directive, p->kind, &p->items[i], meant) == KNOWN, place,
                                  "parameter '%s' of %s is ignored", p->items[i].name, p->directive);
    }
}

void koksma__pbrt_name_parameters(const char *directive, const char *kind, const koksma__pbrt_parameters *p)
{
    for (size_t i = p->n_inherited; i < p->n; i++) {
        const koksma__pbrt_parameter *at = &p->items[i];
        const koksma__text_place place = {p->place.im, p->place.file, at->line};
        char meant[KOKSMA__OR_MEANT];
        const verdict found = judge(directive, kind, at, meant);
        koksma__import_unknown_if(found == NO_SUCH_NAME, place, "parameter '%s' of %s is unknown%s", at->name,
                                  directive, meant);
        koksma__import_unknown_if(found == NO_SUCH_TYPE, place,
                                  "parameter '%s' of %s has the type '%s'; pbrt reads it as %s", at->name, directive,
                                  at->type, meant);
        koksma__import_unknown_if(found == NO_SUCH_VALUE, place, "%s of %s: the value '%.40s' is unknown%s", at->name,
                                  directive, at->text, meant);
    }
}

/* ---- Values -------------------------------------------------------------------------------------------------- */

/* The number that a parameter has if it is missing. */
static double otherwise(const koksma__pbrt_parameters *p, const char *name)
{
    koksma__entry e;
    const char *of = !strcmp(p->directive, "MakeNamedMaterial") ? "Material" : p->directive;
    return koksma__plugin_entry(&koksma__pbrt_plugins, of, p->kind, name, &e) ? koksma__entry_number(&e) : 0;
}

const koksma__pbrt_parameter *koksma__pbrt_find(koksma__pbrt_parameters *p, const char *name)
{
    const koksma__pbrt_parameter *found = NULL;
    for (size_t i = 0; i < p->n; i++) {
        if (!strcmp(p->items[i].name, name)) {
            found = &p->items[i];
            p->used[i] = true;
        }
    }
    return found;
}

bool koksma__pbrt_is(const koksma__pbrt_parameter *parameter, const char *list)
{
    return koksma__lists(list, strlen(list), ' ', parameter->type);
}

static void need(bool is_right, const koksma__pbrt_parameters *p, const koksma__pbrt_parameter *at,
                 const char *expected)
{
    if (!is_right) {
        koksma__import_fail((koksma__text_place){p->place.im, p->place.file, at->line},
                            "%s: a '%s' of %zu values; expected: %s", at->name, at->type, at->n + at->n_texts,
                            expected);
    }
}

const koksma__pbrt_parameter *koksma__pbrt_find_typed(koksma__pbrt_parameters *p, const char *name, const char *list)
{
    const koksma__pbrt_parameter *found = koksma__pbrt_find(p, name);
    need(!found || koksma__pbrt_is(found, list), p, found, list);
    return found;
}

/* Finds a parameter with `count` numbers, or one text. */
static const koksma__pbrt_parameter *find_values(koksma__pbrt_parameters *p, const char *name, const char *list,
                                                 size_t count)
{
    const koksma__pbrt_parameter *found = koksma__pbrt_find_typed(p, name, list);
    need(!found || found->n_texts == 1 || found->n == count, p, found, "one value");
    return found;
}

double koksma__pbrt_number(koksma__pbrt_parameters *p, const char *name)
{
    const koksma__pbrt_parameter *found = koksma__pbrt_find(p, name);
    if (found && koksma__pbrt_is(found, "texture spectrum rgb")) {
        p->used[found - p->items] = false;
        return otherwise(p, name);
    }
    found = find_values(p, name, "float integer", 1);
    return found ? found->numbers[0] : otherwise(p, name);
}

double koksma__pbrt_whole(koksma__pbrt_parameters *p, const char *name)
{
    const koksma__pbrt_parameter *found = find_values(p, name, "integer", 1);
    return found ? found->numbers[0] : otherwise(p, name);
}

const char *koksma__pbrt_word(koksma__pbrt_parameters *p, const char *name)
{
    const koksma__pbrt_parameter *found = find_values(p, name, "string", 1);
    return found ? found->text : "";
}

bool koksma__pbrt_flag(koksma__pbrt_parameters *p, const char *name)
{
    const koksma__pbrt_parameter *found = find_values(p, name, "bool", 1);
    return found ? !strcmp(found->text, "true") : otherwise(p, name) != 0;
}

void koksma__pbrt_point(koksma__pbrt_parameters *p, const char *name, double out[3])
{
    const koksma__pbrt_parameter *found = find_values(p, name, "point3 point vector3 vector", 3);
    if (found) {
        memcpy(out, found->numbers, 3 * sizeof *out);
    }
}
