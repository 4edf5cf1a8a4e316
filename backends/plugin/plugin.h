/*
 * RasterCheck's plugin interface: any rasterizer in a shared library, judged by
 * `rastercheck run --backend plugin:PATH.so`. C11 or C++, no dependencies.
 *
 * A plugin is a shared library that exports one function, rastercheck_plugin_get(). It says what
 * the rasterizer promises (rastercheck_contract) and draws (rastercheck_draw to
 * rastercheck_output).
 *
 * Versions. Every struct begins with its size in bytes as its maker was compiled. Members are only
 * ever added at the end: who reads a struct reads no member beyond its size, and takes those that
 * are missing for 0. What cannot be done so raises RASTERCHECK_PLUGIN_ABI, and plugins of another
 * number are refused with a message.
 *
 * Threads. A plugin is loaded into a process of its own. Its functions are called by one thread,
 * one call at a time; it may start threads of its own. They are called with the default
 * floating-point environment (to nearest, subnormal numbers kept) and have to leave it so.
 *
 * What the process may do is limited: memory, time, no network, and no file but devices is written
 * to, made or removed, as far as the system can see to it. What it prints, on standard output and
 * standard error, is kept for messages. A plugin that crashes or does not come back in time fails
 * its case, and is loaded anew for the next one.
 */
#ifndef RASTERCHECK_PLUGIN_H
#define RASTERCHECK_PLUGIN_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What rastercheck_plugin.abi has to be. */
#define RASTERCHECK_PLUGIN_ABI 1u

/* ------------------------------------------------------------------------------------------------
 * What a plugin promises. Whatever it draws is held against the exact result by these words, so
 * they have to be honest: promise too little, and little is found; too much, and every case fails.
 * A struct of zeros promises the most: exactly what each case asks for, correctly rounded.
 */

/* rastercheck_contract.coverage: which triangle the samples are those of. */
enum {
  RASTERCHECK_COVERAGE_AS_ASKED =
      0,                           /* the one that each case asks for (rastercheck_draw.coverage) */
  RASTERCHECK_COVERAGE_EXACT = 1,  /* that of the unrounded vertices */
  RASTERCHECK_COVERAGE_SNAPPED = 2 /* that of window positions on a grid */
};

/* How a window position becomes a point of the grid. */
enum {
  RASTERCHECK_ROUNDING_NEAREST_EVEN = 0,
  RASTERCHECK_ROUNDING_HALF_UP = 1,    /* the nearest; halves towards greater x and y */
  RASTERCHECK_ROUNDING_UNSPECIFIED = 2 /* either neighbour */
};

/* Who owns a sample that lies exactly on an edge. Top and left are as displayed. */
enum {
  RASTERCHECK_TIE_RULE_AS_ASKED = 0, /* rastercheck_draw.tie_rule */
  RASTERCHECK_TIE_RULE_TOP_LEFT = 1,
  RASTERCHECK_TIE_RULE_BOTTOM_LEFT = 2,
  RASTERCHECK_TIE_RULE_UNSPECIFIED = 3
};

/* Which positions attributes and facing are computed from, where coverage is snapped. */
enum {
  RASTERCHECK_BASIS_AS_ASKED = 0, /* rastercheck_draw.basis */
  RASTERCHECK_BASIS_IDEAL = 1,    /* the unrounded ones */
  RASTERCHECK_BASIS_SNAPPED = 2,  /* those on the grid */
  RASTERCHECK_BASIS_UNSPECIFIED = 3
};

/* rastercheck_contract.claims: what smooth attributes are. */
enum {
  RASTERCHECK_CLAIM_PERSPECTIVE = 0, /* linear over the triangle in clip space */
  RASTERCHECK_CLAIM_AFFINE = 1       /* linear in the window: a rasterizer that never divides */
};

/* rastercheck_contract.keeps: promises to the bit; any of these, added. */
enum {
  /* An attribute with one value at all vertices has it everywhere; of zeros whichever sign. */
  RASTERCHECK_KEEPS_CONSTANTS = 1,
  /* A sample exactly at a vertex has the vertex's values. Held against what is drawn only where it
   * is certain where the vertex is: not with a position_error and values from the grid. */
  RASTERCHECK_KEEPS_VERTEX_VALUES = 2,
  /* Triangles whose vertices have one z/w have one depth. */
  RASTERCHECK_KEEPS_EQUAL_DEPTH = 4,
  /* An interpolated attribute that is -0 at all vertices is -0, and one that is 0 is 0. */
  RASTERCHECK_KEEPS_SIGN_OF_ZERO = 8
};

/* rastercheck_contract.depth_format: what depth tests compare. Depths that become equal when they
 * are rounded to it may be taken for equal, and the first drawn of them be left; those that are
 * farther apart than a step may not. */
enum {
  RASTERCHECK_DEPTH_FLOAT32 = 0, /* what is handed over as output.depth, to the bit */
  RASTERCHECK_DEPTH_FLOAT64 = 1, /* before it was rounded to float32 */
  RASTERCHECK_DEPTH_UNORM16 = 2, /* steps of 1/(2^16 - 1) */
  RASTERCHECK_DEPTH_UNORM24 = 3,
  RASTERCHECK_DEPTH_UNORM32 = 4
};

/* rastercheck_contract.lacks: what is not drawn; any of these, added. Cases with it are not asked
 * for, and no law says anything of them. */
enum {
  RASTERCHECK_LACKS_OPENGL = 1 << 0, /* OpenGL's conventions: see rastercheck_draw.rules */
  RASTERCHECK_LACKS_VULKAN = 1 << 1,
  RASTERCHECK_LACKS_D3D = 1 << 2,
  RASTERCHECK_LACKS_NONPOSITIVE_W = 1 << 3,  /* vertices with w <= 0 */
  RASTERCHECK_LACKS_DEPTH_CLIPPING = 1 << 4, /* vertices beyond the near or far plane */
  RASTERCHECK_LACKS_CLIP_DISTANCES = 1 << 5,
  RASTERCHECK_LACKS_DEPTH_CLAMP = 1 << 6,
  RASTERCHECK_LACKS_DEPTH_RANGE = 1 << 7, /* any but min_depth 0, max_depth 1 */
  RASTERCHECK_LACKS_DEPTH_TEST = 1 << 8,
  RASTERCHECK_LACKS_VIEWPORT = 1 << 9, /* any but the whole framebuffer */
  RASTERCHECK_LACKS_SCISSOR = 1 << 10,
  RASTERCHECK_LACKS_CULLING = 1 << 11,
  RASTERCHECK_LACKS_SMOOTH = 1 << 12, /* attributes of that interpolation */
  RASTERCHECK_LACKS_NOPERSPECTIVE = 1 << 13,
  RASTERCHECK_LACKS_FLAT = 1 << 14,
  RASTERCHECK_LACKS_CENTER = 1 << 15,   /* attributes at the centre of pixels of several samples */
  RASTERCHECK_LACKS_CENTROID = 1 << 16, /* and at their centroid */
  /* Depth buffers that begin with anything but 1: see rastercheck_draw.depth_clear. */
  RASTERCHECK_LACKS_DEPTH_CLEAR = 1 << 17,
  /* Vertices beyond the viewport's sides: only triangles that lie within it are drawn. */
  RASTERCHECK_LACKS_SIDE_CLIPPING = 1 << 18
};

/* How far a value v may be off, in units of the float32 spacing at max(|v|, |values of the
 * vertices|):
 *
 *   constant + per_horizon * g + per_condition * K + range_share * (range of the vertices' values)
 *
 * docs/judge-your-rasterizer.md says what g and K are; of depth only the constant counts, in units
 * of the spacing at max(|min_depth|, |max_depth|). No number may be negative. A constant of 0
 * stands for 1/2: correctly rounded. */
typedef struct rastercheck_bound {
  float constant;
  float per_horizon;
  float per_condition;
  float range_share; /* in float32 spacings of the greatest value, times the range in these */
} rastercheck_bound;

typedef struct rastercheck_contract {
  uint32_t size;          /* sizeof(rastercheck_contract) */
  uint32_t coverage;      /* RASTERCHECK_COVERAGE_… */
  uint32_t subpixel_bits; /* of SNAPPED: the grid has 2^-subpixel_bits pixels; 0…16 */
  uint32_t rounding;      /* of SNAPPED: RASTERCHECK_ROUNDING_… */
  /* Of SNAPPED: how far the computed window position may be off before it is rounded, in grid
   * units, 0…65536. */
  float position_error;
  /* SNAPPED and AS_ASKED: how far edges that were cut by clipping may be off besides the
   * position error, in grid units; 0: they are where the uncut ones are. */
  float clip_tolerance;
  /* SNAPPED and AS_ASKED: vertices outside the viewport and farther than this from the window's
   * origin in x or y may be clipped, in pixels; 0: 32768. Any number so small that no vertex
   * outside is nearer says that triangles are clipped at the viewport. */
  float guard_band;
  uint32_t tie_rule; /* RASTERCHECK_TIE_RULE_… */
  uint32_t basis;    /* RASTERCHECK_BASIS_… */
  uint32_t claims;   /* RASTERCHECK_CLAIM_… */
  uint32_t keeps;    /* RASTERCHECK_KEEPS_…, added */
  rastercheck_bound smooth;
  rastercheck_bound noperspective;
  rastercheck_bound depth;
  /* Limits: what is beyond them is not asked for. */
  uint32_t lacks;          /* RASTERCHECK_LACKS_…, added */
  uint32_t sample_counts;  /* of 1, 2, 4, 8 and 16 those that there are, added; 0: all */
  uint32_t max_size;       /* of a framebuffer's width and height, pixels; 0: no limit */
  uint32_t max_attributes; /* of a vertex; 0: no limit */
  uint32_t depth_format;   /* RASTERCHECK_DEPTH_… */
} rastercheck_contract;

/* ------------------------------------------------------------------------------------------------
 * What is drawn. All arrays belong to the caller, may be read until draw() returns, and cannot be
 * written: they lie in read-only pages. They are aligned as their elements are, no more.
 */

/* rastercheck_draw.rules: whose conventions hold. */
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
  RASTERCHECK_FLAT = 2           /* the value of one vertex: see rules */
};

/* rastercheck_attribute.location: where in the pixel it is evaluated. */
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

/* A draw: the triangles of a case that are to be drawn together. Without a depth test that is one
 * triangle; with it, all of the case. */
typedef struct rastercheck_draw {
  uint32_t size;
  uint32_t rules; /* RASTERCHECK_RULES_… */

  /* The framebuffer: pixels, and samples of each. Row 0 is the one with the least window y. */
  uint32_t width;
  uint32_t height;
  uint32_t samples;
  /* [samples][2]: x and y within the pixel, 0…1 from its corner of least window x and y. */
  const float* sample_positions;

  /* NDC [-1, 1] becomes [x, x + width], [y, y + height] (D3D: y turned over), in pixels; sizes may
   * be negative and fractional. Nothing is drawn outside. */
  float viewport_x;
  float viewport_y;
  float viewport_width;
  float viewport_height;
  float min_depth; /* within 0…1; may be greater than max_depth */
  float max_depth;
  /* Pixels that may be drawn; the whole framebuffer where the case has no scissor. It may reach
   * beyond the framebuffer. */
  int32_t scissor_x;
  int32_t scissor_y;
  int32_t scissor_width;
  int32_t scissor_height;

  uint32_t cull;        /* RASTERCHECK_CULL_… */
  uint32_t front_face;  /* RASTERCHECK_FRONT_FACE_… */
  uint32_t depth_test;  /* 1: of each sample the fragment of least depth, the first of equals */
  uint32_t depth_clamp; /* 1: not clipped by the near and far plane, depth clamped to the range */

  /* What the case asks for; of use to a rasterizer that promises AS_ASKED. */
  uint32_t coverage;      /* EXACT or SNAPPED */
  uint32_t subpixel_bits; /* of SNAPPED */
  uint32_t rounding;      /* of SNAPPED: NEAREST_EVEN or HALF_UP */
  uint32_t tie_rule;      /* TOP_LEFT or BOTTOM_LEFT */
  uint32_t basis;         /* IDEAL or SNAPPED; UNSPECIFIED: either */

  uint32_t vertex_count;
  const float* positions; /* [vertex_count][4]: clip positions x, y, z, w; finite */
  uint32_t attribute_count;
  const rastercheck_attribute* attributes; /* [attribute_count]; may be null where there is none */
  const float* attribute_values; /* [vertex_count][attribute_count]; null where there is none */
  uint32_t clip_distance_count;
  const float* clip_distances; /* [vertex_count][clip_distance_count]; null where there is none */
  uint32_t triangle_count;
  const uint32_t* indices; /* [triangle_count][3]: vertices */
  /* The depth buffer begins with this, where there is a depth test: fragments that are not nearer
   * are not drawn. It is 1 where a case does not say; then fragments of depth 1 may be drawn. */
  float depth_clear;
} rastercheck_draw;

/* ------------------------------------------------------------------------------------------------
 * What came out. The arrays belong to the caller, have the shapes below, and may be written until
 * draw() returns. They end where memory that may be touched ends: writing one element too far is
 * reported. What is not marked as covered is not looked at.
 */
typedef struct rastercheck_output {
  uint32_t size;
  /* [height][width][samples]: all 0; to be 1 where the draw covers the sample. */
  uint8_t* coverage;
  /* The same shape: which triangle of the draw is seen there. All 0, so only a draw of several
   * triangles has to write it. */
  uint32_t* triangle;
  /* The same shape: depth in the depth range. All NaN; but of a draw that may write to more than
   * 65536 samples (min_x to max_y), what draws before it wrote without covering it may be left,
   * here and in `triangle` and `attributes`. */
  float* depth;
  /* [height][width][samples][attribute_count]: the attributes. All NaN; null where there is none.
   */
  float* attributes;
  /* All that is written lies in min_x <= x < max_x, min_y <= y < max_y. It is the whole
   * framebuffer; a rasterizer that makes it smaller is judged faster. */
  uint32_t min_x;
  uint32_t min_y;
  uint32_t max_x;
  uint32_t max_y;
  /* [message_size] For a text, ended by 0, that says why draw() returned something else than
   * RASTERCHECK_OK. All 0. */
  char* message;
  uint32_t message_size;
  uint32_t reserved; /* 0 */
} rastercheck_output;

/* What draw() returns. */
enum {
  RASTERCHECK_OK = 0,
  RASTERCHECK_UNSUPPORTED = 1, /* a case of a kind that is not drawn: nothing is said of it */
  RASTERCHECK_FAILED = 2       /* it should have been drawn: the case fails, with the message */
};

/* ------------------------------------------------------------------------------------------------
 * The plugin. It belongs to the plugin, as do its texts and its contract, and stays as it is until
 * the process ends.
 */
typedef struct rastercheck_plugin {
  uint32_t size;       /* sizeof(rastercheck_plugin) */
  uint32_t abi;        /* RASTERCHECK_PLUGIN_ABI */
  const char* name;    /* one line of UTF-8, of which 100 bytes are shown; not null */
  const char* version; /* one line of UTF-8, not null */
  const rastercheck_contract* contract; /* not null */
  /* Draws. Neither pointer is null. It is to write `output` and nothing else that lasts: the same
   * draw gives the same output, whatever was drawn before. */
  uint32_t (*draw)(const rastercheck_draw* draw, rastercheck_output* output);
} rastercheck_plugin;

#if defined(_WIN32)
#define RASTERCHECK_PLUGIN_EXPORT __declspec(dllexport)
#else
#define RASTERCHECK_PLUGIN_EXPORT __attribute__((visibility("default")))
#endif

/* The one function that a plugin defines. Called once, first; a null pointer is refused. */
RASTERCHECK_PLUGIN_EXPORT const rastercheck_plugin* rastercheck_plugin_get(void);

#ifdef __cplusplus
}
#endif

#endif
