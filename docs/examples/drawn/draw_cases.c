/*
 * Draws the cases of a folder that `rastercheck cases --out DIR` has made, on whatever machine, and
 * writes their drawings beside them. C11, no dependencies: plugin.h is a header of numbers.
 * docs/image-tests.md tells how to build it and have its drawings judged.
 *
 *   draw_cases DIR
 *
 * The rasterizer is whoever exports rastercheck_plugin_get(), such as little.c. Another one is
 * called in its place in draw_case(): `draw` has all that is to be drawn, and `output` has room for
 * what was drawn.
 *
 * Files are little-endian, and so must be the machine. The formats: a file of draws begins with
 * "RCDRAW1\n" and the 28 numbers of read_draw(), with "RCDRAW2\n" and 32, or with "RCDRAW3\n" and
 * 36, and then has its arrays; a drawing begins with "RCDRAWN1" and the number of draws, each of
 * which write_output() writes.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rastercheck/plugin.h"

/* Reads a whole file, null-terminated. The caller frees it. Returns null if it cannot be read. */
static char* read_file(const char* name, size_t* size) {
  FILE* file = fopen(name, "rb");
  char* bytes = NULL;
  size_t room = 1 << 12;
  *size = 0;
  if (file == NULL) return NULL;
  do {
    room *= 2;
    char* more = realloc(bytes, room);
    if (more == NULL) break;
    bytes = more;
    *size += fread(bytes + *size, 1, room - 1 - *size, file);
  } while (*size == room - 1);
  fclose(file);
  if (bytes != NULL) bytes[*size] = '\0';
  return bytes;
}

/* Takes an array of 32-bit numbers from the file; null if it has no elements. */
static const void* take(const uint32_t** at, size_t count) {
  const uint32_t* begin = *at;
  *at += count;
  return count == 0 ? NULL : begin;
}

static float as_float(uint32_t word) {
  float number;
  memcpy(&number, &word, sizeof number);
  return number;
}

/* Reads a file of draws. The arrays stay in `bytes`. Returns 0 if the file is of another kind. */
static int read_draw(const char* bytes, size_t size, rastercheck_draw* draw) {
  const uint32_t* w = (const uint32_t*)(bytes + 8);
  if (size < 8 || memcmp(bytes, "RCDRAW", 6) != 0 || bytes[7] != '\n') return 0;
  const int kind = bytes[6] - '0';
  if (kind < 1 || kind > 3 || size < 8 + (28 + 4 * ((size_t)kind - 1)) * 4) return 0;
  *draw = (rastercheck_draw){
      .size = sizeof *draw,
      .rules = w[0],
      .width = w[1],
      .height = w[2],
      .samples = w[3],
      .viewport_x = as_float(w[4]),
      .viewport_y = as_float(w[5]),
      .viewport_width = as_float(w[6]),
      .viewport_height = as_float(w[7]),
      .min_depth = as_float(w[8]),
      .max_depth = as_float(w[9]),
      .scissor_x = (int32_t)w[10],
      .scissor_y = (int32_t)w[11],
      .scissor_width = (int32_t)w[12],
      .scissor_height = (int32_t)w[13],
      .cull = w[14],
      .front_face = w[15],
      .depth_test = w[16],
      .depth_clamp = w[17],
      .coverage = w[18],
      .subpixel_bits = w[19],
      .rounding = w[20],
      .tie_rule = w[21],
      .basis = w[22],
      .vertex_count = w[23],
      .attribute_count = w[24],
      .clip_distance_count = w[25],
      .triangle_count = w[26],
      .depth_clear = as_float(w[27]),
  };
  w += 28;
  if (kind >= 2) {
    draw->bias_constant = as_float(w[0]);
    draw->bias_slope = as_float(w[1]);
    draw->bias_clamp = as_float(w[2]);
    draw->depth_bits = w[3];
    w += 4;
  }
  if (kind == 3) {
    draw->primitive = w[0];
    draw->line_mode = w[1];
    draw->line_width = as_float(w[2]);
    draw->point_size = as_float(w[3]);
    w += 4;
  }
  const size_t vertices = draw->vertex_count;
  draw->sample_positions = take(&w, (size_t)draw->samples * 2);
  draw->positions = take(&w, vertices * 4);
  draw->attributes = take(&w, (size_t)draw->attribute_count * 2);
  draw->attribute_values = take(&w, vertices * draw->attribute_count);
  draw->clip_distances = take(&w, vertices * draw->clip_distance_count);
  draw->indices = take(&w, (size_t)draw->triangle_count * 3);
  return 1;
}

static void write_word(FILE* file, uint32_t word) { fwrite(&word, sizeof word, 1, file); }

/* Writes the answer to one draw: the status and, of what was drawn, the rectangle that it lies in.
 */
static void write_output(FILE* file, uint32_t status, const rastercheck_draw* draw,
                         const rastercheck_output* out) {
  const uint32_t length = status == RASTERCHECK_OK ? 0 : (uint32_t)strlen(out->message);
  write_word(file, status);
  write_word(file, out->min_x);
  write_word(file, out->min_y);
  write_word(file, out->max_x);
  write_word(file, out->max_y);
  write_word(file, length);
  fwrite(out->message, 1, length, file);
  for (uint32_t i = length; i % 4 != 0; ++i) fputc(0, file);
  if (status != RASTERCHECK_OK) return;
  const size_t columns = (size_t)(out->max_x - out->min_x) * draw->samples;
  const size_t values = draw->attribute_count;
  for (uint32_t y = out->min_y; y < out->max_y; ++y) {
    const size_t row = ((size_t)y * draw->width + out->min_x) * draw->samples;
    for (size_t i = row; i < row + columns; ++i) {
      write_word(file, out->coverage[i] ? out->triangle[i] + 1 : 0);
    }
  }
  for (uint32_t y = out->min_y; y < out->max_y; ++y) {
    const size_t row = ((size_t)y * draw->width + out->min_x) * draw->samples;
    fwrite(out->depth + row, sizeof(float), columns, file);
  }
  for (uint32_t y = out->min_y; y < out->max_y && values > 0; ++y) {
    const size_t row = ((size_t)y * draw->width + out->min_x) * draw->samples;
    fwrite(out->attributes + row * values, sizeof(float), columns * values, file);
  }
}

/* Draws, unless the case needs what the plugin's `draws` lacks. */
static uint32_t draw_or_refuse(const rastercheck_plugin* plugin, const rastercheck_draw* draw,
                               rastercheck_output* out) {
  const uint32_t draws = plugin->contract->draws;
  const int has_bias = draw->bias_constant != 0 || draw->bias_slope != 0;
  if ((has_bias && (draws & RASTERCHECK_DRAWS_DEPTH_BIAS) == 0) ||
      (draw->depth_bits != 0 && (draws & RASTERCHECK_DRAWS_UNORM_DEPTH) == 0)) {
    snprintf(out->message, out->message_size, "a depth bias, or depths of %u bits",
             draw->depth_bits);
    return RASTERCHECK_UNSUPPORTED;
  }
  if ((draw->primitive == RASTERCHECK_LINES && (draws & RASTERCHECK_DRAWS_LINES) == 0) ||
      (draw->primitive == RASTERCHECK_POINTS && (draws & RASTERCHECK_DRAWS_POINTS) == 0)) {
    snprintf(out->message, out->message_size, "lines or points");
    return RASTERCHECK_UNSUPPORTED;
  }
  return plugin->draw(draw, out);
}

/* Draws a case and writes its drawing. Returns 0 if there is not enough memory. */
static int draw_case(const rastercheck_plugin* plugin, const rastercheck_draw* whole, FILE* file) {
  const size_t samples = (size_t)whole->width * whole->height * whole->samples;
  const size_t values = samples * whole->attribute_count;
  char message[256];
  rastercheck_output out = {
      .size = sizeof out,
      .coverage = malloc(samples),
      .triangle = malloc(samples * sizeof(uint32_t)),
      .depth = malloc(samples * sizeof(float)),
      .attributes = values == 0 ? NULL : malloc(values * sizeof(float)),
      .message = message,
      .message_size = sizeof message,
  };
  const int is_there = out.coverage != NULL && out.triangle != NULL && out.depth != NULL &&
                       (values == 0 || out.attributes != NULL);
  /* Without a depth test, each triangle is drawn alone. */
  const uint32_t together = whole->depth_test ? whole->triangle_count : 1;
  if (is_there && whole->triangle_count > 0) {
    write_word(file, whole->triangle_count / together);
    for (uint32_t first = 0; first < whole->triangle_count; first += together) {
      rastercheck_draw draw = *whole;
      draw.triangle_count = together;
      draw.indices = whole->indices + 3 * (size_t)first;
      memset(out.coverage, 0, samples);
      memset(out.triangle, 0, samples * sizeof(uint32_t));
      for (size_t i = 0; i < samples; ++i) out.depth[i] = NAN;
      for (size_t i = 0; i < values; ++i) out.attributes[i] = NAN;
      memset(message, 0, sizeof message);
      out.min_x = out.min_y = 0;
      out.max_x = draw.width;
      out.max_y = draw.height;
      write_output(file, draw_or_refuse(plugin, &draw, &out), &draw, &out);
    }
  } else {
    write_word(file, 0);
  }
  free(out.coverage);
  free(out.triangle);
  free(out.depth);
  free(out.attributes);
  return is_there;
}

/* Draws the case DIR/cases/NAME.draw to DIR/drawn/NAME.drawn. Says what went wrong; 0 if it did. */
static int draw_file(const rastercheck_plugin* plugin, const char* folder, const char* name) {
  char path[4096];
  size_t size = 0;
  rastercheck_draw draw;
  snprintf(path, sizeof path, "%s/cases/%s.draw", folder, name);
  char* bytes = read_file(path, &size);
  int is_drawn = bytes != NULL && read_draw(bytes, size, &draw);
  if (!is_drawn) fprintf(stderr, "%s: cannot be read\n", path);
  if (is_drawn) {
    snprintf(path, sizeof path, "%s/drawn/%s.drawn", folder, name);
    FILE* file = fopen(path, "wb");
    if (file != NULL) fwrite("RCDRAWN1", 1, 8, file);
    is_drawn = file != NULL && draw_case(plugin, &draw, file);
    if (file != NULL && fclose(file) != 0) is_drawn = 0;
    if (!is_drawn) fprintf(stderr, "%s: cannot be drawn or written\n", path);
  }
  free(bytes);
  return is_drawn;
}

int main(int argc, char** argv) {
  char path[4096];
  char name[64];
  int count = 0;
  if (argc != 2) {
    fprintf(stderr, "usage: draw_cases DIR\n");
    return 2;
  }
  snprintf(path, sizeof path, "%s/list.txt", argv[1]);
  FILE* list = fopen(path, "r");
  if (list == NULL) {
    fprintf(stderr, "%s: cannot be read\n", path);
    return 2;
  }
  while (fscanf(list, "%63s", name) == 1) {
    if (!draw_file(rastercheck_plugin_get(), argv[1], name)) return 1;
    ++count;
  }
  fclose(list);
  printf("%d cases drawn\n", count);
  return 0;
}
