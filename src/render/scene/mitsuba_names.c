/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The table of Mitsuba's plug-ins (its form: plugins.c): what is read of them, with Mitsuba 3's defaults, and what
 * becomes of them. Names of Mitsuba 0.6 and 2 are here, too. A parameter that no row has is named as ignored
 * (koksma__xml_name_unread). Also the materials that have a name: conductors, and indices of refraction.
 */
#include "scene/mitsuba_reader.h"

#include <string.h>
#include <strings.h>

#define FILM                                                                                                         \
    "integer width:768 height:576; string ~file_format ~component_format "                                           \
    "~pixel_format=rgb|rgba|xyz|xyza|spectrum|spectrumalpha; boolean ~sample_border:0 ~compensate ~banner "          \
    "~high_quality_edges ~attach_log"
#define PATHS                                                                                                        \
    "integer max_depth:-1 ~rr_depth ~block_size ~samples_per_pass ~timeout; boolean hide_emitters "                  \
    "~strict_normals:0 "
#define SENSOR                                                                                                       \
    "float near_clip:0.01 far_clip:1e4 fov focal_length:50 ~shutter_open ~shutter_close; transform to_world; "       \
    "string fov_axis=x|y|diagonal|smaller|larger; float "
#define PLACED "transform to_world; boolean flip_normals"
#define MESH PLACED "; string filename; boolean face_normals flip_tex_coords"
#define LIGHT "float sampling_weight:1; transform to_world; colour "
#define METAL "colour specular_reflectance:1 eta k:1; string material"
#define GLASS "colour specular_transmittance:1; ior int_ior:1.5046 ext_ior:1.000277"
#define COATED "colour diffuse_reflectance:0.5; ior int_ior:1.49 ext_ior:1.000277"
#define ROUGH "; float alpha:0.1 alpha_u alpha_v; string distribution=beckmann|ggx|phong|as"
#define MATTE "colour reflectance|diffuse_reflectance:0.5"
#define SAMPLES "string values!; spectrum value; "

static const koksma__plugin rows[] = {
    {"bsdf", "?", MATTE, KOKSMA__MATTE, "Lambert"},
    {"bsdf", "diffuse", MATTE, KOKSMA__MATTE, NULL},
    {"bsdf", "roughdiffuse", MATTE "; float ~alpha", KOKSMA__MATTE, "Lambert"},
    {"bsdf", "phong ward", "colour diffuse_reflectance:0.5", KOKSMA__MATTE, "its diffuse part"},
    {"bsdf", "conductor", METAL, KOKSMA__METAL, NULL},
    {"bsdf", "roughconductor", METAL ROUGH, KOKSMA__METAL, NULL},
    {"bsdf", "dielectric", GLASS, KOKSMA__GLASS, NULL},
    {"bsdf", "roughdielectric", GLASS ROUGH, KOKSMA__GLASS, NULL},
    {"bsdf", "plastic", COATED, KOKSMA__COATED, NULL},
    {"bsdf", "roughplastic", COATED "; float alpha:0.1 alpha_u alpha_v", KOKSMA__COATED, NULL},
    {"bsdf", "pplastic", COATED "; float alpha:0.1 alpha_u alpha_v", KOKSMA__COATED, "one that does not polarise"},
    {"bsdf", "principled", "colour base_color:0.5; float roughness:0.5 metallic spec_trans; ior eta:1.5",
     KOKSMA__PRINCIPLED, "metal, glass or a coated surface"},
    {"bsdf", "polarizer thindielectric", "", KOKSMA__NOTHING, "nothing"},
    {"bsdf", "null", "", KOKSMA__NOTHING, NULL},
    {"bsdf", "mask", "colour opacity:0.5", KOKSMA__MASK, NULL},
    {"bsdf", "blendbsdf", "colour weight!", KOKSMA__BLEND, NULL},
    {"bsdf", "twosided", "", KOKSMA__WITHIN, NULL},
    {"bsdf", "bumpmap normalmap coating mixturebsdf bump roughcoating", "", KOKSMA__WITHIN, "the BSDF within it"},

    {"texture", "bitmap",
     "string filename filter_type=bilinear|nearest|trilinear|ewa wrap_mode=repeat|clamp|mirror|zero|one; "
     "boolean raw; transform to_uv; float uscale:1 vscale:1 uoffset voffset",
     KOKSMA__BITMAP, NULL},
    {"texture", "checkerboard",
     "colour color0:0.4 color1:0.2; transform to_uv; float uscale:1 vscale:1 uoffset voffset", KOKSMA__CHECKERBOARD,
     NULL},
    {"texture", "d65", "float scale:1; colour color:1", KOKSMA__D65, NULL},
    {"texture", "srgb_d65", "float scale:1; colour color!", KOKSMA__D65, NULL}, /* of Mitsuba 2 */
    {"texture", "uniform", "float value! ~wavelength_min ~wavelength_max", KOKSMA__UNIFORM, NULL},
    {"texture", "srgb", "colour color!; boolean ~unbounded", KOKSMA__SRGB, NULL},
    {"texture", "regular", SAMPLES "float wavelength_min|lambda_min! wavelength_max|lambda_max!", KOKSMA__REGULAR,
     NULL},
    {"texture", "irregular", SAMPLES "string wavelengths!", KOKSMA__IRREGULAR, NULL},
    {"texture", "blackbody", "float temperature!", KOKSMA__TEMPERATURE, "its colour with luminance 1"},

    {"shape", "?", PLACED, KOKSMA__N_BASIC_FORMS, NULL},
    {"shape", "sphere", PLACED "; point center; float radius:1", KOKSMA__FORM_SPHERE, NULL},
    {"shape", "rectangle", PLACED, KOKSMA__FORM_SQUARE, NULL},
    {"shape", "disk", PLACED, KOKSMA__FORM_DISK, NULL},
    {"shape", "cube", PLACED, KOKSMA__FORM_CUBE, NULL},
    {"shape", "cylinder", PLACED "; point p0 p1; float radius:1", KOKSMA__FORM_CYLINDER, NULL},
    {"shape", "obj", MESH ":1", KOKSMA__FORM_MESH, NULL},
    {"shape", "ply", MESH, KOKSMA__FORM_MESH, NULL},
    {"shape", "serialized", MESH "; integer shape_index", KOKSMA__FORM_MESH, NULL},
    {"shape", "instance", "transform to_world", 0, NULL},
    {"shape", "shapegroup", "", 0, NULL},

    {"emitter", "?", LIGHT "intensity:1 radiance:1; point position", KOKSMA__POINT_LIGHT,
     "a point light equal in all directions"},
    {"emitter", "area", LIGHT "radiance:1", 0, NULL},
    {"emitter", "constant", LIGHT "radiance:1", KOKSMA__SKY, NULL},
    {"emitter", "sunsky sky sun", LIGHT "radiance:1", KOKSMA__SKY, "a white sky"},
    {"emitter", "envmap", LIGHT "radiance:1; float scale:1; string filename", KOKSMA__PICTURE, NULL},
    {"emitter", "directional", LIGHT "irradiance:1; vector direction", KOKSMA__FAR_LIGHT, NULL},
    {"emitter", "point", LIGHT "intensity:1; point position", KOKSMA__POINT_LIGHT, NULL},
    {"emitter", "spot", LIGHT "intensity:1; point position; float cutoff_angle:20 beam_width", KOKSMA__SPOT, NULL},

    {"medium", "?", "", 0, NULL},
    {"medium", "homogeneous",
     "colour albedo:0.75 sigma_t:1 sigma_s sigma_a; float scale:1; boolean ~sample_emitters; string "
     "~sampling_density "
     "material",
     0, NULL},
    {"volume", "constvolume", "colour value|color:1", 0, NULL}, /* "color" of Mitsuba 2 */
    {"phase", "isotropic", "", 0, NULL},
    {"phase", "hg", "float g:0.8", 0, NULL},

    {"sensor", "perspective", SENSOR "~focus_distance", 0, NULL},
    {"sensor", "thinlens", SENSOR "focus_distance:1 aperture_radius", 0, NULL},
    {"sensor", "orthographic", SENSOR "~focus_distance", 0, NULL},
    {"film", "?", "integer width:768 height:576", 0, "one of pixels"},
    {"film", "hdrfilm tiledhdrfilm ldrfilm", FILM, 0, NULL},

    /* what the program's own options choose */
    {"sampler", "independent", "integer ~sample_count ~seed", 0, NULL},
    {"sampler", "stratified multijitter", "integer ~sample_count ~seed; boolean ~jitter", 0, NULL},
    {"sampler", "orthogonal", "integer ~sample_count ~seed ~strength; boolean ~jitter", 0, NULL},
    {"sampler", "ldsampler", "integer ~sample_count ~seed ~dimension", 0, NULL},
    {"sampler", "halton hammersley sobol", "integer ~sample_count ~scramble", 0, NULL},
    {"rfilter", "box tent", "float ~radius", 0, NULL},
    {"rfilter", "gaussian", "float ~radius ~stddev", 0, NULL},
    {"rfilter", "mitchell", "float ~a ~b ~c", 0, NULL},
    {"rfilter", "catmullrom", "", 0, NULL},
    {"rfilter", "lanczos", "integer ~lobes", 0, NULL},
    {"integrator", "path volpath volpath_simple prb prb_basic prbvolpath ptracer", PATHS, 0, NULL},
    {"integrator", "volpathmis", PATHS "~use_spectral_mis", 0, NULL},
    {"integrator", "bdpt", PATHS "~light_image ~sample_direct", 0, NULL},
    {"integrator", "pssmlt",
     PATHS "~bidirectional ~two_stage; integer ~direct_samples ~luminance_samples; float ~p_large", 0, NULL},
    {"integrator", "direct",
     "integer ~emitter_samples ~bsdf_samples ~shading_samples ~block_size ~samples_per_pass ~timeout; "
     "boolean hide_emitters ~strict_normals:0",
     0, NULL},
    {"integrator", "aov", "string ~aovs", 0, NULL}};

const koksma__plugins koksma__mitsuba_plugins = {rows, sizeof rows / sizeof *rows};

/* The constants are mi.traverse(mi.load_dict({'type': 'conductor', 'material': NAME})) of Mitsuba 3.9.1. */
bool koksma__mitsuba_conductor(const char *name, double eta[3], double k[3])
{
    static const struct {
        const char *name;
        double eta[3], k[3];
    } all[] = {
        {"a-C", {2.944, 2.227, 1.968}, {0.8875, 0.7993, 0.8153}},
        {"Ag", {0.1553, 0.1167, 0.1384}, {4.828, 3.122, 2.147}},
        {"Al", {1.658, 0.8804, 0.5212}, {9.224, 6.27, 4.837}},
        {"AlAs", {3.605, 3.233, 2.216}, {0.0006794, 0, 0.007513}},
        {"AlSb", {0, 4.139, 4.669}, {0, 0.09401, 1.301}},
        {"Au", {0.143, 0.3753, 1.442}, {3.983, 2.386, 1.603}},
        {"Be", {4.185, 3.185, 2.784}, {3.835, 3.01, 2.869}},
        {"Cr", {4.37, 2.917, 1.655}, {5.207, 4.231, 3.755}},
        {"CsI", {2.145, 1.702, 1.662}, {0, 0, 0}},
        {"Cu", {0.201, 0.9237, 1.102}, {3.913, 2.453, 2.142}},
        {"Cu2O", {3.552, 2.95, 2.752}, {0.1142, 0.1939, 0.6061}},
        {"CuO", {3.248, 2.448, 2.21}, {0.5211, 0.57, 0.7222}},
        {"d-C", {2.709, 2.319, 2.229}, {0, 0, 0}},
        {"Hg", {2.399, 1.44, 0.9096}, {6.328, 4.372, 3.422}},
        {"HgTe", {4.779, 3.231, 2.66}, {1.632, 1.581, 1.729}},
        {"Ir", {3.086, 2.082, 1.618}, {5.592, 4.067, 3.267}},
        {"K", {0.06404, 0.04641, 0.03818}, {2.104, 1.349, 0.9131}},
        {"Li", {0.2658, 0.1956, 0.2209}, {3.54, 2.311, 1.669}},
        {"MgO", {2.09, 1.651, 1.595}, {0, 0, 0}},
        {"Mo", {4.484, 3.525, 2.776}, {4.111, 3.421, 3.151}},
        {"Nb", {3.42, 2.79, 2.396}, {3.441, 2.738, 2.58}},
        {"Rh", {2.586, 1.86, 1.554}, {6.782, 4.703, 3.976}},
        {"Se", {4.058, 2.843, 2.821}, {0.754, 0.6384, 0.5218}},
        {"SiC", {3.172, 2.526, 2.479}, {0, 0, 1.019e-05}},
        {"SnTe", {4.524, 1.982, 1.282}, {0, 0, 0}},
        {"Ta", {2.063, 2.393, 2.628}, {2.408, 1.741, 1.947}},
        {"Te", {7.39, 4.482, 2.637}, {3.256, 3.527, 3.292}},
        {"ThF4", {1.831, 1.442, 1.388}, {0, 0, 0}},
        {"TiC", {3.701, 2.837, 2.582}, {3.266, 2.352, 2.173}},
        {"TiN", {1.648, 1.151, 1.38}, {3.368, 1.943, 1.102}},
        {"TiO2", {3.457, 2.802, 2.905}, {0.0001053, 0, 0.0006529}},
        {"VC", {3.658, 2.753, 2.533}, {3.068, 2.199, 1.963}},
        {"VN", {2.866, 2.119, 1.94}, {3.032, 2.056, 1.616}},
        {"W", {4.371, 3.3, 2.998}, {3.501, 2.605, 2.273}},
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        if (!strcmp(all[i].name, name)) {
            memcpy(eta, all[i].eta, sizeof all[i].eta);
            memcpy(k, all[i].k, sizeof all[i].k);
            return true;
        }
    }
    return false;
}

bool koksma__mitsuba_index(const char *name, double *out)
{
    static const struct {
        const char *name;
        double ior;
    } known[] = {{"vacuum", 1},        {"helium", 1.000036},        {"hydrogen", 1.000132},
                 {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.333},
                 {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
                 {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
                 {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
                 {"pyrex", 1.47},      {"acrylic glass", 1.49},     {"polypropylene", 1.49},
                 {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
                 {"pet", 1.575},       {"diamond", 2.419}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (!strcasecmp(known[i].name, name)) {
            *out = known[i].ior;
            return true;
        }
    }
    return false;
}
