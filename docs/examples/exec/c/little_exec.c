/*
 * A plugin as a program, for `rastercheck run --backend exec:./little_exec`:
 *
 *     cc -std=c11 -O2 -Iinclude little_exec.c little.c -o little_exec -lm
 *
 * `include` is where rastercheck/plugin.h is. little.c is docs/examples/plugin/little.c, or any
 * other plugin: what is below knows nothing of how it draws. Unlike `--backend plugin:`, nothing
 * here notices a plugin that writes beyond its arrays.
 *
 * With --shared-memory, arrays pass through shared memory instead of pipes.
 */
#include "draws.h"

/* What a contract's numbers mean in JSON. */
static const char* const roundings[] = {"nearest_even", "half_up", "unspecified"};
static const char* const ties[] = {"as_asked", "top_left", "bottom_left", "unspecified"};
static const char* const bases[] = {"as_asked", "ideal", "snapped", "unspecified"};
static const char* const claims[] = {"perspective", "affine"};
static const char* const depths[] = {"float32", "float64", "unorm16", "unorm24", "unorm32"};

typedef struct bit {
  uint32_t bit;
  const char* text;
} bit;
static const bit rules[] = {{RASTERCHECK_LACKS_OPENGL, "\"opengl\""},
                            {RASTERCHECK_LACKS_VULKAN, "\"vulkan\""},
                            {RASTERCHECK_LACKS_D3D, "\"d3d\""},
                            {0, NULL}};
static const bit sample_counts[] = {{1, "1"}, {2, "2"}, {4, "4"}, {8, "8"}, {16, "16"}, {0, NULL}};
static const bit lacks[] = {{RASTERCHECK_LACKS_NONPOSITIVE_W, "\"nonpositive_w\""},
                            {RASTERCHECK_LACKS_DEPTH_CLIPPING, "\"depth_clipping\""},
                            {RASTERCHECK_LACKS_SIDE_CLIPPING, "\"side_clipping\""},
                            {RASTERCHECK_LACKS_CLIP_DISTANCES, "\"clip_distances\""},
                            {RASTERCHECK_LACKS_DEPTH_CLAMP, "\"depth_clamp\""},
                            {RASTERCHECK_LACKS_DEPTH_RANGE, "\"depth_range\""},
                            {RASTERCHECK_LACKS_DEPTH_TEST, "\"depth_test\""},
                            {RASTERCHECK_LACKS_DEPTH_CLEAR, "\"depth_clear\""},
                            {RASTERCHECK_LACKS_VIEWPORT, "\"viewport\""},
                            {RASTERCHECK_LACKS_SCISSOR, "\"scissor\""},
                            {RASTERCHECK_LACKS_CULLING, "\"culling\""},
                            {RASTERCHECK_LACKS_SMOOTH, "\"smooth\""},
                            {RASTERCHECK_LACKS_NOPERSPECTIVE, "\"noperspective\""},
                            {RASTERCHECK_LACKS_FLAT, "\"flat\""},
                            {RASTERCHECK_LACKS_CENTER, "\"center\""},
                            {RASTERCHECK_LACKS_CENTROID, "\"centroid\""},
                            {0, NULL}};

static void write_text(FILE* to, const char* key, const char* text) {
  char plain[128];
  snprintf(plain, sizeof(plain), "%s", text);
  draws_make_plain(plain);
  fprintf(to, ",\"%s\":\"%s\"", key, plain);
}

/* A member of the bits that are set. */
static void write_list(FILE* to, const char* key, const bit* bits, uint32_t set) {
  fprintf(to, "\"%s\":[", key);
  const char* comma = "";
  for (; bits->text != NULL; ++bits) {
    if (!(set & bits->bit)) continue;
    fprintf(to, "%s%s", comma, bits->text);
    comma = ",";
  }
  fputc(']', to);
}

static void write_limits(FILE* to, const rastercheck_contract* c) {
  fputs(",\"limits\":{", to);
  write_list(to, "rules", rules, ~c->lacks);
  fputc(',', to);
  write_list(to, "sample_counts", sample_counts, c->sample_counts ? c->sample_counts : 31);
  fputc(',', to);
  write_list(to, "lacks", lacks, c->lacks);
  if (c->max_size > 0) fprintf(to, ",\"max_size\":%" PRIu32, c->max_size);
  if (c->max_attributes > 0) fprintf(to, ",\"max_attributes\":%" PRIu32, c->max_attributes);
  fputc('}', to);
}

/* Floats are written in hex, which is exact. */
static void write_bound(FILE* to, const char* key, rastercheck_bound bound) {
  fprintf(to, "\"%s\":{\"constant\":\"%a\",", key,
          bound.constant == 0 ? 0.5 : (double)bound.constant);
  fprintf(to, "\"per_horizon\":\"%a\",\"per_condition\":\"%a\",\"range_share\":\"%a\"}",
          (double)bound.per_horizon, (double)bound.per_condition, (double)bound.range_share);
}

static void write_contract(FILE* to, const rastercheck_contract* c) {
  fputs(",\"contract\":{\"format\":\"rastercheck-contract\",\"version\":1,\"coverage\":", to);
  if (c->coverage == RASTERCHECK_COVERAGE_SNAPPED) {
    fprintf(to, "{\"subpixel_bits\":%" PRIu32 ",\"rounding\":\"%s\",\"position_error\":\"%a\"}",
            c->subpixel_bits, roundings[c->rounding], (double)c->position_error);
  } else {
    fputs(c->coverage == RASTERCHECK_COVERAGE_EXACT ? "\"exact\"" : "\"as_asked\"", to);
  }
  fprintf(to, ",\"tie_rule\":\"%s\",\"basis\":\"%s\",\"claims\":\"%s\",\"depth_format\":\"%s\"",
          ties[c->tie_rule], bases[c->basis], claims[c->claims], depths[c->depth_format]);
  fprintf(to, ",\"clip_tolerance\":\"%a\"", (double)c->clip_tolerance);
  if (c->guard_band > 0) fprintf(to, ",\"guard_band\":\"%a\"", (double)c->guard_band);
  const struct {
    uint32_t bit;
    const char* key;
  } keeps[] = {{RASTERCHECK_KEEPS_CONSTANTS, "keeps_constants"},
               {RASTERCHECK_KEEPS_VERTEX_VALUES, "keeps_vertex_values"},
               {RASTERCHECK_KEEPS_EQUAL_DEPTH, "keeps_equal_depth"},
               {RASTERCHECK_KEEPS_SIGN_OF_ZERO, "keeps_sign_of_zero"}};
  for (int i = 0; i < 4; ++i) {
    fprintf(to, ",\"%s\":%s", keeps[i].key, c->keeps & keeps[i].bit ? "true" : "false");
  }
  fputs(",\"bounds\":{", to);
  write_bound(to, "smooth", c->smooth);
  fputc(',', to);
  write_bound(to, "noperspective", c->noperspective);
  fputc(',', to);
  write_bound(to, "depth", (rastercheck_bound){.constant = c->depth.constant});
  fputs("}}", to);
}

int main(int argc, char** argv) {
  static draws d;
  const rastercheck_plugin* const plugin = rastercheck_plugin_get();
  d.is_shared = argc > 1 && strcmp(argv[1], "--shared-memory") == 0;
  draws_begin(&d);
  fprintf(d.answers, "{\"protocol\":1,\"shared_memory\":%s", d.is_shared ? "true" : "false");
  write_text(d.answers, "name", plugin->name);
  write_text(d.answers, "version", plugin->version);
  write_contract(d.answers, plugin->contract);
  write_limits(d.answers, plugin->contract);
  fputs("}\n", d.answers);
  while (draws_next(&d)) {
    const uint32_t result = plugin->draw(&d.draw, &d.output);
    if (result == RASTERCHECK_OK) {
      draws_answer(&d);
    } else {
      draws_refuse(&d, result == RASTERCHECK_UNSUPPORTED ? "unsupported" : "failed");
    }
  }
  return 0;
}
