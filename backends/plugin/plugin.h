/*
 * RasterCheck's plugin interface: any rasterizer in a shared library, judged by
 * `rastercheck run --backend plugin:PATH.so`. C11 or C++, no dependencies.
 *
 * A plugin is a shared library that exports one function, rastercheck_plugin_get(). The function
 * returns what the rasterizer promises (rastercheck_contract) and a function that draws (from a
 * rastercheck_draw to a rastercheck_output); for occlusion cullers, also one that answers queries;
 * and, if it has more of a pipeline than fragments, one that draws pictures.
 *
 * Versions. Every struct begins with its size in bytes, as compiled by whoever fills it in, except
 * rastercheck_bound and rastercheck_attribute, which never grow. Members are only ever added at the
 * end. A reader reads no member beyond that size and treats missing members as 0. Any other change
 * raises RASTERCHECK_PLUGIN_ABI; a plugin with a different number is refused with a message.
 *
 * Threads. Each plugin is loaded into a process of its own. One thread calls its functions, one
 * call at a time; the plugin may start threads of its own. Every call starts with the default
 * floating-point environment (round to nearest, subnormal numbers kept) and must return with it
 * unchanged.
 *
 * Limits. The process has limited memory and time, no network, and must not write, create or remove
 * any file but devices; the limits hold as far as the system can enforce them. Standard output and
 * standard error are kept for messages. If a plugin crashes or does not return in time, its case
 * fails and the plugin is loaded anew for the next case.
 */
#ifndef RASTERCHECK_PLUGIN_H
#define RASTERCHECK_PLUGIN_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The value that rastercheck_plugin.abi must have. */
#define RASTERCHECK_PLUGIN_ABI 1u

/* ------------------------------------------------------------------------------------------------
 * What a plugin promises. Everything it draws is compared with the exact result under these
 * promises, so they must be honest: promise too little and few errors are found; promise too much
 * and every case fails. A struct of zeros promises the most: exactly what each case asks for,
 * correctly rounded.
 */

/* rastercheck_contract.coverage: the triangle that decides which samples are covered. */
enum {
  RASTERCHECK_COVERAGE_AS_ASKED =
      0, /* the triangle that each case asks for (rastercheck_draw.coverage) */
  RASTERCHECK_COVERAGE_EXACT = 1,  /* the triangle of the unrounded vertices */
  RASTERCHECK_COVERAGE_SNAPPED = 2 /* the triangle of window positions rounded to a grid */
};

/* How a window position is rounded to the grid. */
enum {
  RASTERCHECK_ROUNDING_NEAREST_EVEN = 0,
  RASTERCHECK_ROUNDING_HALF_UP = 1,     /* to the nearest; halves towards greater x and y */
  RASTERCHECK_ROUNDING_UNSPECIFIED = 2, /* to either neighbour */
  RASTERCHECK_ROUNDING_HALF_DOWN = 3,   /* to the nearest; halves towards lesser x and y */
  RASTERCHECK_ROUNDING_FLOOR = 4,       /* to the next point towards lesser x and y */
  RASTERCHECK_ROUNDING_CEIL = 5,        /* to the next point towards greater x and y */
  RASTERCHECK_ROUNDING_TOWARD_ZERO = 6  /* to the next point towards the window's origin */
};

/* Which triangle owns a sample that lies exactly on an edge. Top and left are as displayed.
 * TOP_LEFT: the one whose left edge it is or, if the edge is horizontal, whose top edge it is.
 * TOP_THEN_LEFT: the one whose top edge it is or, if the edge is vertical, whose left edge it is;
 * and so on. */
enum {
  RASTERCHECK_TIE_RULE_AS_ASKED = 0, /* rastercheck_draw.tie_rule */
  RASTERCHECK_TIE_RULE_TOP_LEFT = 1,
  RASTERCHECK_TIE_RULE_BOTTOM_LEFT = 2,
  RASTERCHECK_TIE_RULE_UNSPECIFIED = 3,
  RASTERCHECK_TIE_RULE_TOP_RIGHT = 4,
  RASTERCHECK_TIE_RULE_BOTTOM_RIGHT = 5,
  RASTERCHECK_TIE_RULE_TOP_THEN_LEFT = 6,
  RASTERCHECK_TIE_RULE_TOP_THEN_RIGHT = 7,
  RASTERCHECK_TIE_RULE_BOTTOM_THEN_LEFT = 8,
  RASTERCHECK_TIE_RULE_BOTTOM_THEN_RIGHT = 9,
  RASTERCHECK_TIE_RULE_ALL = 10, /* every edge owns its samples: both triangles draw them */
  RASTERCHECK_TIE_RULE_NONE = 11 /* no edge does: neither triangle draws them */
};

/* Which positions attributes and facing are computed from if coverage is snapped. */
enum {
  RASTERCHECK_BASIS_AS_ASKED = 0, /* rastercheck_draw.basis */
  RASTERCHECK_BASIS_IDEAL = 1,    /* the unrounded positions */
  RASTERCHECK_BASIS_SNAPPED = 2,  /* the positions on the grid */
  RASTERCHECK_BASIS_UNSPECIFIED = 3
};

/* rastercheck_contract.claims: how smooth attributes vary. */
enum {
  RASTERCHECK_CLAIM_PERSPECTIVE = 0, /* linear over the triangle in clip space */
  RASTERCHECK_CLAIM_AFFINE = 1       /* linear in the window, for a rasterizer that never divides */
};

/* rastercheck_contract.keeps: promises that are exact to the bit. Add up the ones that hold. */
enum {
  /* An attribute with the same value at all vertices has that value everywhere; zeros may have
   * either sign. */
  RASTERCHECK_KEEPS_CONSTANTS = 1,
  /* A sample exactly at a vertex has the vertex's values. Checked only if the position of the
   * vertex is certain: not if position_error is above 0 and values come from positions on the grid.
   */
  RASTERCHECK_KEEPS_VERTEX_VALUES = 2,
  /* Triangles whose vertices all have the same z/w have the same depth everywhere. */
  RASTERCHECK_KEEPS_EQUAL_DEPTH = 4,
  /* An interpolated attribute that is -0 at all vertices is -0; one that is +0 at all vertices is
   * +0. */
  RASTERCHECK_KEEPS_SIGN_OF_ZERO = 8
};

/* rastercheck_contract.depth_format: what depth tests compare. Depths that round to the same value
 * of the format may count as equal, so that the first one drawn stays; depths more than one step
 * apart may not. */
enum {
  RASTERCHECK_DEPTH_FLOAT32 = 0, /* exactly the value written to output.depth */
  RASTERCHECK_DEPTH_FLOAT64 = 1, /* the value before it was rounded to float32 */
  RASTERCHECK_DEPTH_UNORM16 = 2, /* steps of 1/(2^16 - 1) */
  RASTERCHECK_DEPTH_UNORM24 = 3,
  RASTERCHECK_DEPTH_UNORM32 = 4
};

/* rastercheck_contract.lacks: what the plugin does not draw. Add up the ones that apply. The plugin
 * is never asked for such cases, and no property checks them. */
enum {
  RASTERCHECK_LACKS_OPENGL = 1 << 0, /* OpenGL's conventions: see rastercheck_draw.rules */
  RASTERCHECK_LACKS_VULKAN = 1 << 1,
  RASTERCHECK_LACKS_D3D = 1 << 2,
  RASTERCHECK_LACKS_NONPOSITIVE_W = 1 << 3,  /* vertices with w <= 0 */
  RASTERCHECK_LACKS_DEPTH_CLIPPING = 1 << 4, /* vertices beyond the near or far plane */
  RASTERCHECK_LACKS_CLIP_DISTANCES = 1 << 5,
  RASTERCHECK_LACKS_DEPTH_CLAMP = 1 << 6,
  RASTERCHECK_LACKS_DEPTH_RANGE = 1 << 7, /* any range but min_depth 0, max_depth 1 */
  RASTERCHECK_LACKS_DEPTH_TEST = 1 << 8,
  RASTERCHECK_LACKS_VIEWPORT = 1 << 9, /* any viewport but the whole framebuffer */
  RASTERCHECK_LACKS_SCISSOR = 1 << 10,
  RASTERCHECK_LACKS_CULLING = 1 << 11,
  RASTERCHECK_LACKS_SMOOTH = 1 << 12, /* attributes with this interpolation */
  RASTERCHECK_LACKS_NOPERSPECTIVE = 1 << 13,
  RASTERCHECK_LACKS_FLAT = 1 << 14,
  RASTERCHECK_LACKS_CENTER = 1 << 15, /* attributes at the centre of pixels with several samples */
  RASTERCHECK_LACKS_CENTROID = 1 << 16, /* attributes at the centroid of such pixels */
  /* Depth buffers that start at any value but 1: see rastercheck_draw.depth_clear. */
  RASTERCHECK_LACKS_DEPTH_CLEAR = 1 << 17,
  /* Vertices beyond the viewport's sides: the plugin draws only triangles that lie within it. */
  RASTERCHECK_LACKS_SIDE_CLIPPING = 1 << 18,
  RASTERCHECK_LACKS_VIEWPORT_FRACTIONS = 1 << 19, /* viewports whose sides lie between pixels */
  /* Depth: the plugin writes no output.depth. It may still draw cases with a depth test. */
  RASTERCHECK_LACKS_DEPTH = 1 << 20
};

/* rastercheck_contract.draws: what the plugin draws and is asked for only if it says so. Add up the
 * ones that apply. */
enum {
  RASTERCHECK_DRAWS_DEPTH_BIAS = 1 << 0,  /* rastercheck_draw.bias_constant and bias_slope */
  RASTERCHECK_DRAWS_UNORM_DEPTH = 1 << 1, /* rastercheck_draw.depth_bits */
  RASTERCHECK_DRAWS_LINES = 1 << 2,       /* rastercheck_draw.primitive: RASTERCHECK_LINES */
  RASTERCHECK_DRAWS_POINTS = 1 << 3       /* RASTERCHECK_POINTS */
};

/* rastercheck_contract.clips: the vertices whose triangles may be clipped at the sides. */
enum {
  RASTERCHECK_CLIPS_FAR_FROM_ORIGIN = 0, /* by their distance from the window's origin */
  RASTERCHECK_CLIPS_BEYOND_VIEWPORT = 1  /* by their distance from the viewport */
};

/* rastercheck_contract.beyond: what becomes of a triangle with such a vertex, with a vertex beyond
 * the near or far plane, or with w <= 0. */
enum {
  RASTERCHECK_BEYOND_CLIPPED = 0, /* the part within is drawn */
  RASTERCHECK_BEYOND_LEFT_OUT = 1 /* nothing of it is drawn */
};

/* rastercheck_contract.culls: triangles never drawn, by their orientation as displayed. */
enum {
  RASTERCHECK_CULLS_NOTHING = 0,
  RASTERCHECK_CULLS_CLOCKWISE = 1,
  RASTERCHECK_CULLS_COUNTER_CLOCKWISE = 2
};

/* rastercheck_contract.conservative: whether whole pixels are covered instead of samples. All
 * samples of a covered pixel are then covered. docs/rules.md has the exact rules. */
enum {
  RASTERCHECK_CONSERVATIVE_NO = 0,
  RASTERCHECK_CONSERVATIVE_OUTER = 1, /* every pixel that the triangle touches */
  RASTERCHECK_CONSERVATIVE_INNER = 2  /* only pixels that lie in the triangle */
};

/* rastercheck_contract.depth_function: which fragments a depth test keeps, those whose depth has
 * this relation to the stored one. With the last two, greater is nearer. */
enum {
  RASTERCHECK_DEPTH_FUNCTION_LESS = 0,
  RASTERCHECK_DEPTH_FUNCTION_LESS_OR_EQUAL = 1,
  RASTERCHECK_DEPTH_FUNCTION_GREATER = 2,
  RASTERCHECK_DEPTH_FUNCTION_GREATER_OR_EQUAL = 3
};

/* rastercheck_contract.depth_error: the side of the exact depth on which depths lie. The bound of
 * depth holds on the other side; with a constant of 2^24 or more, that side is unbounded. */
enum {
  RASTERCHECK_DEPTH_ON_EITHER_SIDE = 0,
  RASTERCHECK_DEPTH_NEVER_NEARER = 1, /* less is nearer, unless depth_function says otherwise */
  RASTERCHECK_DEPTH_NEVER_FARTHER = 2
};

/* rastercheck_contract.depth_store: which number k of a unorm format of b bits a depth d becomes,
 * if rastercheck_draw.depth_bits asks for one. */
enum {
  RASTERCHECK_STORE_NEAREST = 0,        /* |k - d (2^b - 1)| <= 0.5 */
  RASTERCHECK_STORE_NEARLY_NEAREST = 1, /* 0.6, as in D3D */
  RASTERCHECK_STORE_EITHER = 2          /* either neighbour */
};

/* rastercheck_contract.bias_slope: how steep a plane of depths is held to be. */
enum {
  RASTERCHECK_SLOPE_GREATEST = 0, /* max(|dz/dx|, |dz/dy|) */
  RASTERCHECK_SLOPE_ROOT = 1,     /* sqrt((dz/dx)^2 + (dz/dy)^2) */
  RASTERCHECK_SLOPE_BETWEEN = 2   /* anything from one to the other */
};

/* rastercheck_contract.bias_unit: what bias_constant is multiplied by in a unorm format of b
 * bits. */
enum {
  RASTERCHECK_UNIT_OF_RULES = 0,     /* 2^-b; with RULES_D3D, 1/(2^b - 1) as a float */
  RASTERCHECK_UNIT_POWER = 1,        /* 2^-b */
  RASTERCHECK_UNIT_DOUBLE_POWER = 2, /* 2^(1-b) */
  RASTERCHECK_UNIT_EITHER_POWER = 3, /* anything from 2^-b to 2^(1-b) */
  RASTERCHECK_UNIT_LEAST_VALUE = 4,  /* 1/(2^b - 1) as a float */
  RASTERCHECK_UNIT_OPEN = 5          /* anything from 0 to 2^(1-b) */
};

/* rastercheck_contract.bias_exponent: what bias_constant is multiplied by in float32 is 2^(e - 23)
 * with e the exponent of a greatest depth. */
enum {
  RASTERCHECK_EXPONENT_OF_VERTICES = 0, /* of the three vertices, each clamped to the depth range;
                                           a vertex with w <= 0 counts as the range's greater end */
  RASTERCHECK_EXPONENT_OPEN = 1 /* of these, or of what is left of the triangle after clipping */
};

/* rastercheck_contract.pictures: what pictures may do otherwise. Add up the ones that apply. */
enum {
  /* Their fragments may have other depths and attributes than those of draw(). */
  RASTERCHECK_PICTURES_OTHER_FRAGMENTS = 1 << 0,
  /* A resolved colour need not be the mean of the samples, but lies between the least and the
   * greatest of them. */
  RASTERCHECK_PICTURES_NO_MEAN = 1 << 1,
  /* Texture coordinates are rounded: a texel is that of the coordinates that draw() draws; with
   * OTHER_FRAGMENTS, of any that the bounds of their attributes permit. So it is, too, if one of
   * the bounds of pictures is not 0. */
  RASTERCHECK_PICTURES_ROUNDED_COORDINATES = 1 << 2
};

/* How far a value v may be off, in units of the float32 spacing at max(|v|, |values of the
 * vertices|):
 *
 *   constant + per_horizon * g + per_condition * K + range_share * (range of the vertices' values)
 *
 * docs/judge-your-rasterizer.md defines g and K. For depth only the constant counts, in units of
 * the spacing at max(|min_depth|, |max_depth|). No number may be negative. A constant of 0 stands
 * for 1/2: correctly rounded. */
typedef struct rastercheck_bound {
  float constant;
  float per_horizon;
  float per_condition;
  float range_share; /* range is measured in float32 spacings at the vertices' greatest |value| */
} rastercheck_bound;

typedef struct rastercheck_contract {
  uint32_t size;          /* sizeof(rastercheck_contract) */
  uint32_t coverage;      /* RASTERCHECK_COVERAGE_… */
  uint32_t subpixel_bits; /* with SNAPPED: the grid spacing is 2^-subpixel_bits pixels; 0…16 */
  uint32_t rounding;      /* with SNAPPED: RASTERCHECK_ROUNDING_… */
  /* With SNAPPED: how far the computed window position may be off before it is rounded, in grid
   * units, 0…65536. */
  float position_error;
  /* With SNAPPED and AS_ASKED: how far edges cut by clipping may be off, in addition to the
   * position error, in grid units. 0: cut edges stay exactly where the uncut ones are. */
  float clip_tolerance;
  /* With SNAPPED and AS_ASKED: vertices that lie outside the viewport, and farther than this many
   * pixels from the window's origin in x or y, may be clipped. 0 stands for 32768. If triangles are
   * clipped at the viewport, use a number smaller than the distance from the origin to any
   * vertex outside the viewport. */
  float guard_band;
  uint32_t tie_rule; /* RASTERCHECK_TIE_RULE_… */
  uint32_t basis;    /* RASTERCHECK_BASIS_… */
  uint32_t claims;   /* RASTERCHECK_CLAIM_… */
  uint32_t keeps;    /* RASTERCHECK_KEEPS_…, added */
  rastercheck_bound smooth;
  rastercheck_bound noperspective;
  rastercheck_bound depth;
  /* Limits: the plugin is never asked for a case beyond these. */
  uint32_t lacks;          /* RASTERCHECK_LACKS_…, added */
  uint32_t sample_counts;  /* those supported of 1, 2, 4, 8 and 16, added; 0: all */
  uint32_t max_size;       /* greatest width and height of a framebuffer, pixels; 0: no limit */
  uint32_t max_attributes; /* per vertex; 0: no limit */
  uint32_t depth_format;   /* RASTERCHECK_DEPTH_… */

  /* With SNAPPED: if not 0, the grid spacing is 1/steps_per_pixel pixels, and subpixel_bits must be
   * 0. Need not be a power of two; 1…65536. */
  uint32_t steps_per_pixel;
  /* With SNAPPED: how window y is rounded, if otherwise than window x: RASTERCHECK_ROUNDING_… + 1.
   * 0: like x. */
  uint32_t rounding_of_y;
  /* How guard_band is meant: RASTERCHECK_CLIPS_…. With BEYOND_VIEWPORT, vertices farther than
   * guard_band pixels outside the viewport may be clipped, and 0 stands for 0. */
  uint32_t clips;
  uint32_t beyond; /* RASTERCHECK_BEYOND_… */
  /* With SNAPPED and AS_ASKED: how far a point's distance from a plane that cuts the triangle may
   * be off, in addition to clip_tolerance, as a share of max|z| + max|w| of the vertices (of the
   * greatest clip distance for those). */
  float clip_error;
  /* The magnitudes of clip positions, clip distances and attribute values about which the plugin
   * promises something; 0 always belongs to them. A greatest magnitude of 0 stands for no limit. */
  float least_number;
  float greatest_number;
  uint32_t culls;   /* RASTERCHECK_CULLS_… */
  float least_area; /* triangles with less area in the window, in square pixels, may be left out */
  /* If sample_parts is not 0: the plugin samples each pixel at (sample_x/sample_parts,
   * sample_y/sample_parts) of a pixel from the corner of least window x and y, whatever
   * rastercheck_draw.sample_positions says. At most 256 parts, x and y below that. Then
   * sample_counts must be 1. */
  uint32_t sample_x;
  uint32_t sample_y;
  uint32_t sample_parts;
  /* How far values may be off in addition to their bounds, in units of the value itself: 1/510 for
   * values from 0 to 1 that are stored in 8 bits. */
  float smooth_absolute;
  float noperspective_absolute;
  float depth_absolute;
  uint32_t depth_function; /* RASTERCHECK_DEPTH_FUNCTION_… */
  uint32_t depth_error;    /* RASTERCHECK_DEPTH_ON_EITHER_SIDE, … */
  /* Width and height of framebuffers must be multiples of this; 0: any size. */
  uint32_t size_multiple;
  uint32_t conservative; /* RASTERCHECK_CONSERVATIVE_… */
  /* With OUTER: how far beyond the pixels that it touches a triangle may cover more; with INNER:
   * how near to its border a pixel inside may be missing. In pixels, along both axes, 0…16384. */
  float conservative_error;
  /* With OUTER: by how much pixels are grown to all sides before they are tested, in pixels,
   * 0…16384. */
  float conservative_growth;
  /* With OUTER: 1 if edges are shifted outwards by the error, which reaches farther at sharp
   * corners; 0 if pixels are grown by it. */
  uint32_t shifts_edges;
  /* With OUTER: 1 if triangles without area cover the pixels that they touch; 0 if they cover
   * nothing. */
  uint32_t covers_degenerates;
  uint32_t draws;         /* RASTERCHECK_DRAWS_…, added */
  uint32_t depth_store;   /* RASTERCHECK_STORE_… */
  uint32_t bias_slope;    /* RASTERCHECK_SLOPE_… */
  uint32_t bias_unit;     /* RASTERCHECK_UNIT_… */
  uint32_t bias_exponent; /* RASTERCHECK_EXPONENT_… */

  /* Of pictures (rastercheck_plugin.draw_picture). If the next seven are 0, a picture is to the bit
   * what its fragments leave, and a texel is that of the exact coordinates. */
  uint32_t pictures; /* RASTERCHECK_PICTURES_…, added */
  /* How far a float32 colour may be off: if blended, in 2^-24 of the summed sizes of the products
   * that are added; a mean or a difference likewise; a texel's k/255 in units of 2^-24. */
  float float_error;
  /* How far 255 times a colour may be from the byte that it is stored as: stored as it is, blended,
   * or as the mean of samples; at most 255. 0 stands for 1/2: to nearest. */
  float byte_store;
  float byte_blend;
  float byte_mean;
  /* How far from its coordinates a texel may be: a share of their distance from 0, and texels. */
  float texel_share;
  float texel_distance;
  /* Differences across quads are off by at most quad_share times the sizes that cases/contract.h
   * defines; 0 promises nothing. If one of the seven above is not 0, they are held instead against
   * the values that draw() draws, within float_error. */
  float quad_share;
  /* Filtered colours of a texture of W times H texels are off by at most
   *   W (filter_share max|s| + filter_constant) + H (filter_share max|t| + filter_constant)
   *   + units * 2^-24
   * where units is `bilinear` or `trilinear`. If both are 0, nothing is promised. */
  float filter_share;
  float filter_constant;
  float bilinear;
  float trilinear;
  float derivative_share; /* of derivatives that choose a trilinear level: cases/contract.h */
} rastercheck_contract;

/* ------------------------------------------------------------------------------------------------
 * What to draw. All arrays belong to the caller. They may be read until draw() returns and lie in
 * read-only pages. They have the alignment of their elements, no more.
 */

/* rastercheck_draw.rules: which API's conventions apply. */
enum {
  RASTERCHECK_RULES_OPENGL = 0, /* -w <= z <= w, window y up, flat: the last vertex */
  RASTERCHECK_RULES_VULKAN = 1, /* 0 <= z <= w, window y down (as NDC y), flat: the first vertex */
  RASTERCHECK_RULES_D3D = 2     /* 0 <= z <= w, window y down (NDC y up), flat: the first vertex,
                                   depth clamped to the depth range */
};

/* rastercheck_draw.cull */
enum { RASTERCHECK_CULL_NONE = 0, RASTERCHECK_CULL_BACK = 1, RASTERCHECK_CULL_FRONT = 2 };

/* rastercheck_draw.front_face: the orientation of front faces as displayed. */
enum { RASTERCHECK_FRONT_FACE_CCW = 0, RASTERCHECK_FRONT_FACE_CW = 1 };

/* rastercheck_attribute.interpolation */
enum {
  RASTERCHECK_SMOOTH = 0,        /* linear over the triangle in clip space */
  RASTERCHECK_NOPERSPECTIVE = 1, /* linear in the window */
  RASTERCHECK_FLAT = 2           /* the value of one vertex: see rastercheck_draw.rules */
};

/* rastercheck_attribute.location: where in the pixel the attribute is evaluated. */
enum {
  RASTERCHECK_AT_SAMPLE = 0,
  RASTERCHECK_AT_CENTER = 1,
  RASTERCHECK_AT_CENTROID = 2 /* the centre where all samples are covered, else within the triangle;
                                 D3D: else the first covered sample */
};

typedef struct rastercheck_attribute {
  uint32_t interpolation;
  uint32_t location;
} rastercheck_attribute;

/* rastercheck_draw.primitive: what the vertices are joined to. What this header says of triangles
 * holds for lines and points, too, and so do bounds of values; docs/rules.md (§9 and §10) has the
 * exact rules. */
enum {
  RASTERCHECK_TRIANGLES = 0,
  RASTERCHECK_LINES = 1, /* from a to b, the indices being a, b, b */
  RASTERCHECK_POINTS = 2 /* squares around a, the indices being a, a, a */
};

/* rastercheck_draw.line_mode: which samples a line covers. The major axis is the one along which
 * its ends are farther apart, x if equally far. */
enum {
  /* those at most line_width/2 beside it, between the perpendiculars through its ends */
  RASTERCHECK_LINE_RECTANGULAR = 0,
  /* those at most line_width/2 from it along the minor axis, and between its ends along the major
   * axis */
  RASTERCHECK_LINE_PARALLELOGRAM = 1,
  /* those of the pixels that the diamond-exit rule selects, each replicated along the minor axis to
   * line_width, rounded */
  RASTERCHECK_LINE_BRESENHAM = 2
};

/* The triangles of a case that one call draws. Without a depth test that is a single triangle; with
 * a depth test, all triangles of the case. */
typedef struct rastercheck_draw {
  uint32_t size;
  uint32_t rules; /* RASTERCHECK_RULES_… */

  /* The framebuffer's size in pixels, and samples per pixel. Row 0 has the least window y. */
  uint32_t width;
  uint32_t height;
  uint32_t samples;
  /* [samples][2]: x and y within the pixel, 0…1 from the corner with the least window x and y. */
  const float* sample_positions;

  /* NDC [-1, 1] maps to [x, x + width], [y, y + height] (D3D: y flipped), in pixels. Sizes may be
   * negative or fractional. Nothing may be drawn outside the viewport. */
  float viewport_x;
  float viewport_y;
  float viewport_width;
  float viewport_height;
  float min_depth; /* within 0…1; may be greater than max_depth */
  float max_depth;
  /* The pixels that may be drawn; the whole framebuffer if the case has no scissor. The rectangle
   * may extend beyond the framebuffer. */
  int32_t scissor_x;
  int32_t scissor_y;
  int32_t scissor_width;
  int32_t scissor_height;

  uint32_t cull;       /* RASTERCHECK_CULL_… */
  uint32_t front_face; /* RASTERCHECK_FRONT_FACE_… */
  /* 1: at each sample keep the fragment of least depth, the first one of equals, or what
   * contract.depth_function says instead. */
  uint32_t depth_test;
  uint32_t depth_clamp; /* 1: do not clip at the near and far planes; clamp depth to the range */

  /* What the case asks for. Only a rasterizer that promises AS_ASKED needs these. */
  uint32_t coverage;      /* EXACT or SNAPPED */
  uint32_t subpixel_bits; /* with SNAPPED */
  uint32_t rounding;      /* with SNAPPED: NEAREST_EVEN or HALF_UP */
  uint32_t tie_rule;      /* TOP_LEFT or BOTTOM_LEFT */
  uint32_t basis;         /* IDEAL or SNAPPED; UNSPECIFIED allows either */

  uint32_t vertex_count;
  const float* positions; /* [vertex_count][4]: clip positions x, y, z, w; finite */
  uint32_t attribute_count;
  const rastercheck_attribute* attributes; /* [attribute_count]; may be null if the count is 0 */
  const float* attribute_values; /* [vertex_count][attribute_count]; null if there are none */
  uint32_t clip_distance_count;
  const float* clip_distances; /* [vertex_count][clip_distance_count]; null if there are none */
  uint32_t triangle_count;
  const uint32_t* indices; /* [triangle_count][3]: indices of vertices */
  /* With a depth test, the initial value of the depth buffer: fragments that are not nearer are not
   * drawn. If the case does not specify one, it is 1, and fragments of depth 1 may then be drawn;
   * with contract.depth_function GREATER or GREATER_OR_EQUAL, it is 0. */
  float depth_clear;
  /* Add to all depths of a triangle: bias_slope times its slope, plus bias_constant times the unit
   * of the depth format (rastercheck_contract.bias_slope, bias_unit, bias_exponent). The sum of
   * both is at most bias_clamp if that is positive, at least bias_clamp if that is negative. Then
   * the depth is clamped: with RULES_D3D or depth_clamp to min_depth…max_depth, else to 0…1.
   */
  float bias_constant;
  float bias_slope;
  float bias_clamp;
  /* 0: depths are float32. 16 or 24: they are stored as k/(2^depth_bits - 1), k an integer, and
   * depth tests compare what is stored. output.depth is then the float nearest to it. */
  uint32_t depth_bits;
  uint32_t primitive; /* RASTERCHECK_TRIANGLES, LINES or POINTS; "triangles" above are these */
  uint32_t line_mode; /* RASTERCHECK_LINE_… */
  float line_width;   /* pixels, above 0 */
  float point_size;   /* sides of the squares, in pixels, above 0 */
} rastercheck_draw;

/* ------------------------------------------------------------------------------------------------
 * What the plugin drew. The arrays belong to the caller, have the shapes below, and may be written
 * until draw() returns. Each array ends where accessible memory ends: writing one element too far
 * is reported. Samples not marked as covered are ignored.
 */
typedef struct rastercheck_output {
  uint32_t size;
  /* [height][width][samples]: initially 0. Set to 1 if the draw covers the sample. */
  uint8_t* coverage;
  /* Same shape: index of the draw's triangle that is visible there. Initially 0, so only a draw of
   * several triangles needs to write it. */
  uint32_t* triangle;
  /* Same shape: depth in the depth range. A rasterizer that stores depth in fewer bits hands over
   * what it stores, as a float, and says how coarse it is: contract.depth_absolute and
   * contract.depth_format. Initially NaN. Exception, also for `triangle` and
   * `attributes`: after an earlier draw of the case whose rectangle (min_x to max_y) exceeded 65536
   * samples, values that the plugin wrote at uncovered samples may still be there. */
  float* depth;
  /* [height][width][samples][attribute_count]: the attributes. Initially NaN; null if there are
   * none. */
  float* attributes;
  /* The rectangle that holds everything written: min_x <= x < max_x, min_y <= y < max_y. Initially
   * the whole framebuffer; a rasterizer that makes it smaller is judged faster. */
  uint32_t min_x;
  uint32_t min_y;
  uint32_t max_x;
  uint32_t max_y;
  /* [message_size]: room for a null-terminated text that says why draw() did not return
   * RASTERCHECK_OK. Initially all 0. */
  char* message;
  uint32_t message_size;
  uint32_t reserved; /* 0 */
} rastercheck_output;

/* What draw() may return. */
enum {
  RASTERCHECK_OK = 0,
  RASTERCHECK_UNSUPPORTED = 1, /* the plugin does not draw this kind of case: the case is skipped */
  RASTERCHECK_FAILED = 2 /* the plugin should have drawn the case: it fails, with the message */
};

/* ------------------------------------------------------------------------------------------------
 * Occlusion queries, for occlusion cullers: is anything of these triangles visible behind those?
 *
 * The answer OCCLUDED is wrong if some sample of the occludee must be visible: if the occludee must
 * cover it, and its depth there, as far as the contract lets it be off, is less than the depth of
 * every occluder that may cover the sample, and less than depth_clear. `coverage`, `tie_rule`, the
 * bound `depth`, `depth_format` and the limits of the contract count, as they do for draw(). The
 * answer VISIBLE is never wrong, but is counted where nothing can be visible.
 */

/* rastercheck_answer.visibility */
enum { RASTERCHECK_VISIBLE = 0, RASTERCHECK_OCCLUDED = 1 };

/* Two draws with the same state and vertices: only triangle_count and indices differ. They have
 * depth_test 1 and no attributes. All arrays are the caller's, as those of draw(). */
typedef struct rastercheck_query {
  uint32_t size;
  uint32_t reserved;                 /* 0 */
  const rastercheck_draw* occluders; /* may have no triangles; `indices` is null then */
  const rastercheck_draw* occludee;  /* has a triangle or more */
} rastercheck_query;

typedef struct rastercheck_answer {
  uint32_t size;
  uint32_t visibility; /* initially RASTERCHECK_VISIBLE */
  /* [message_size]: as rastercheck_output.message */
  char* message;
  uint32_t message_size;
  uint32_t reserved; /* 0 */
} rastercheck_answer;

/* ------------------------------------------------------------------------------------------------
 * Pictures, for rasterizers that have more than fragments: depth functions, blending, formats,
 * resolving, textures.
 *
 * Triangles are drawn in their order. A fragment that passes the depth test is blended over the
 * colour of its sample, and the result is stored. Blending is done in double, products first, every
 * operation rounded to nearest; for RGBA8, in units of bytes: with 255 s and with the byte that is
 * there, while the factor a stays in 0…1. What is stored is the nearest float, or the nearest byte,
 * ties to even. A mean is the samples' sum in double, in their order, divided by their number, and
 * stored likewise. A contract may leave more open.
 */

/* rastercheck_pipeline.depth_function: fragments whose depth has this relation to the sample's are
 * drawn. */
enum {
  RASTERCHECK_COMPARE_ALWAYS = 0,
  RASTERCHECK_COMPARE_NEVER = 1,
  RASTERCHECK_COMPARE_LESS = 2,
  RASTERCHECK_COMPARE_EQUAL = 3,
  RASTERCHECK_COMPARE_LESS_OR_EQUAL = 4,
  RASTERCHECK_COMPARE_GREATER = 5,
  RASTERCHECK_COMPARE_NOT_EQUAL = 6,
  RASTERCHECK_COMPARE_GREATER_OR_EQUAL = 7
};

/* rastercheck_pipeline.blend: what a fragment's colour s, of alpha a, makes of the colour d that is
 * there. Alpha is channel 3. */
enum {
  RASTERCHECK_BLEND_OFF = 0,     /* s */
  RASTERCHECK_BLEND_OVER = 1,    /* a s + (1 - a) d; alpha: a + (1 - a) d. Four channels */
  RASTERCHECK_BLEND_ADDITIVE = 2 /* s + d, of alpha too */
};

/* rastercheck_pipeline.format */
enum {
  RASTERCHECK_COLOR_FLOAT32 = 0, /* nothing is clamped */
  /* Bytes k, which mean k/255. s is first clamped to 0…1, NaN to 0; bytes to at most 255. */
  RASTERCHECK_COLOR_RGBA8 = 1
};

/* rastercheck_pipeline.shading: where colours come from if there is no texture. */
enum {
  RASTERCHECK_SHADING_ATTRIBUTES = 0, /* a channel for each attribute */
  /* Red, green, blue, alpha: the first three or four attributes. Alpha is 1 if there are three. */
  RASTERCHECK_SHADING_VERTEX_COLORS = 1,
  /* The attributes' differences across quads: odd column minus even column, or odd row minus even
   * row, also where the triangle does not cover the neighbour. */
  RASTERCHECK_SHADING_DIFFERENCES_X = 2,
  RASTERCHECK_SHADING_DIFFERENCES_Y = 3,
  RASTERCHECK_SHADING_FACING = 4, /* 1, 1, 1, 1 on front faces, 0, 0, 0, 1 on back faces */
  /* Window x and y of the sample, the depth of the fragment, and 1/w. */
  RASTERCHECK_SHADING_WINDOW_COORDINATES = 5
};

/* rastercheck_texture.wrap_s and wrap_t */
enum { RASTERCHECK_WRAP_REPEAT = 0, RASTERCHECK_WRAP_CLAMP = 1, RASTERCHECK_WRAP_MIRROR = 2 };

/* rastercheck_texture.filter */
enum {
  RASTERCHECK_FILTER_NEAREST = 0, /* the texel (floor(s width), floor(t height)), wrapped */
  RASTERCHECK_FILTER_BILINEAR = 1,
  RASTERCHECK_FILTER_TRILINEAR = 2
};

/* Looked up at the first two attributes, s and t. */
typedef struct rastercheck_texture {
  uint32_t size;
  uint32_t width;
  uint32_t height;
  uint32_t wrap_s; /* RASTERCHECK_WRAP_… */
  uint32_t wrap_t;
  uint32_t filter;       /* RASTERCHECK_FILTER_… */
  const uint8_t* texels; /* [height][width][4]: red, green, blue, alpha; k means k/255 */
} rastercheck_texture;

typedef struct rastercheck_pipeline {
  uint32_t size;
  uint32_t depth_function; /* RASTERCHECK_COMPARE_… */
  uint32_t writes_depth;   /* 1: a fragment that is drawn leaves its depth; 0: depths stay */
  float clear_depth;       /* the depth of all samples at first; their colours are 0 */
  uint32_t blend;          /* RASTERCHECK_BLEND_… */
  uint32_t format;         /* RASTERCHECK_COLOR_… */
  uint32_t shading;        /* RASTERCHECK_SHADING_… */
  /* 1: the picture has one sample a pixel, whose colour is the mean of the samples' colours, and
   * whose depth is that of sample 0. */
  uint32_t resolves;
  /* Fragments leave no colour and no depth if the texture's alpha or, without a texture, the last
   * attribute is less. Differences across quads are taken before. -infinity: none do. */
  float discard_below;
  const rastercheck_texture* texture; /* replaces the shading; null if there is none */
} rastercheck_pipeline;

/* Each array ends where accessible memory ends, as those of a rastercheck_output. */
typedef struct rastercheck_picture {
  uint32_t size;
  uint32_t width;
  uint32_t height;
  uint32_t samples;  /* a pixel: 1 if the picture is resolved */
  uint32_t channels; /* draw.attribute_count of attributes and differences, else 4 */
  uint32_t message_size;
  /* [height][width][samples][channels]. Every number must be written, also where nothing is drawn.
   * A byte k is handed over as the float (float)k / 255. Null if there are no channels. */
  float* color;
  float* depth;  /* [height][width][samples]: likewise */
  char* message; /* [message_size]: as rastercheck_output.message */
} rastercheck_picture;

/* ------------------------------------------------------------------------------------------------
 * What rastercheck_plugin_get() returns. The struct, its texts and its contract belong to the
 * plugin and must stay unchanged until the process ends.
 */
typedef struct rastercheck_plugin {
  uint32_t size;       /* sizeof(rastercheck_plugin) */
  uint32_t abi;        /* RASTERCHECK_PLUGIN_ABI */
  const char* name;    /* one line of UTF-8, not null; at most 100 bytes are shown */
  const char* version; /* one line of UTF-8, not null */
  const rastercheck_contract* contract; /* not null */
  /* Draws. Neither pointer is null. Must write `output` and change no other state that lasts: the
   * same draw must give the same output, whatever was drawn before. */
  uint32_t (*draw)(const rastercheck_draw* draw, rastercheck_output* output);
  /* Answers an occlusion query; may be null. Neither pointer is null. Returns what draw() may
   * return, and keeps no state that changes a later answer. A culler that draws nothing has a
   * draw() that returns RASTERCHECK_UNSUPPORTED. */
  uint32_t (*query)(const rastercheck_query* query, rastercheck_answer* answer);
  /* Draws a picture; may be null. No pointer is null. `draw` has all triangles of a case, and its
   * depth_test is 0: the pipeline's depth function takes its place. Returns what draw() may return,
   * UNSUPPORTED for pipelines that the plugin does not draw; the same call must give the same
   * picture. */
  uint32_t (*draw_picture)(const rastercheck_draw* draw, const rastercheck_pipeline* pipeline,
                           rastercheck_picture* picture);
} rastercheck_plugin;

#if defined(_WIN32)
#define RASTERCHECK_PLUGIN_EXPORT __declspec(dllexport)
#else
#define RASTERCHECK_PLUGIN_EXPORT __attribute__((visibility("default")))
#endif

/* The one function that a plugin must define. Called once, before any other; returning null is an
 * error. */
RASTERCHECK_PLUGIN_EXPORT const rastercheck_plugin* rastercheck_plugin_get(void);

#ifdef __cplusplus
}
#endif

#endif
