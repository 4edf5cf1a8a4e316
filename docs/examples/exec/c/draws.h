/*
 * Reads draws and writes answers: the part of an exec: program that every rasterizer needs. C11 and
 * POSIX.
 *
 * Copy this file, and include it before all others. docs/exec-protocol.md says what is exchanged,
 * rastercheck/plugin.h what the members of a draw and of what was drawn mean.
 */
#ifndef DRAWS_H
#define DRAWS_H

#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif

#include <inttypes.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "rastercheck/plugin.h"

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "numbers are exchanged as little-endian, which this file does not convert to"
#endif

/* Begins with only is_shared set. */
typedef struct draws {
  rastercheck_draw draw;     /* what is asked */
  rastercheck_output output; /* for what is drawn: the whole framebuffer */
  bool is_shared;            /* arrays pass through shared memory */
  FILE* answers;
  char line[65538], message[256];
  uint64_t bytes, memory_size, answer_at; /* further members of a draw's line */
  const char *interpolations, *locations;
  uint8_t* memory;
  uint64_t mapped;
  struct draws_buffer {
    void* data;
    size_t room;
  } attributes, arrays, frame, answer;
  uint64_t framed; /* samples, and attributes of each, that the frame is laid out for */
  uint32_t framed_attributes;
} draws;

static inline void draws_stop(const char* why) {
  fprintf(stderr, "%s\n", why);
  exit(EXIT_FAILURE);
}

/* Room for a number of bytes. What was there is lost if it has to grow. */
static inline void* draws_room(struct draws_buffer* buffer, size_t bytes) {
  if (bytes > buffer->room) {
    free(buffer->data);
    buffer->data = malloc(bytes);
    if (buffer->data == NULL) draws_stop("out of memory");
    buffer->room = bytes;
  }
  return buffer->data;
}

/* The index of the name that begins at a quote. */
static inline uint32_t draws_index(const char* names, const char* quote) {
  const size_t length = strcspn(quote + 1, "\"");
  for (uint32_t i = 0; *names != '\0'; ++i) {
    const size_t end = strcspn(names, " ");
    if (end == length && memcmp(names, quote + 1, length) == 0) return i;
    names += end + (names[end] == ' ');
  }
  draws_stop("a draw has a name that this program does not know");
  return 0;
}

static inline const char* draws_after_text(const char* quote) {
  const char* p = quote + 1;
  while (*p != '"' && *p != '\0') p += p[0] == '\\' && p[1] != '\0' ? 2 : 1;
  return p + (*p == '"');
}

/* The end of a value: the comma or bracket behind it. */
static inline const char* draws_after_value(const char* p) {
  for (int depth = 0; *p != '\0';) {
    if (depth == 0 && strchr(",]}", *p) != NULL) break;
    depth += (*p == '[' || *p == '{') - (*p == ']' || *p == '}');
    p = *p == '"' ? draws_after_text(p) : p + 1;
  }
  return p;
}

/* The names of a list, each into the same member of another attribute. */
static inline void draws_read_list(draws* d, const char* list, const char* names, size_t member) {
  uint32_t* const attributes = d->attributes.data;
  if (list == NULL) draws_stop("a draw has no interpolations or no locations");
  for (size_t i = 0; i < d->draw.attribute_count; ++i) {
    list += strcspn(list, "\"");
    attributes[2 * i + member] = draws_index(names, list);
    list = draws_after_text(list);
  }
}

static inline uint32_t draws_uint(const char* value) { return (uint32_t)strtoul(value, NULL, 10); }
static inline int32_t draws_int(const char* value) { return (int32_t)strtol(value, NULL, 10); }
static inline float draws_float(const char* value) { return strtof(value, NULL); }

/* Takes a member of a draw's line. */
static inline void draws_read_member(draws* d, const char* key, size_t length, const char* value) {
  rastercheck_draw* const draw = &d->draw;
#define DRAWS_READ(name, to, what) \
  if (length == sizeof(#name) - 1 && memcmp(key, #name, length) == 0) (to)->name = what
  DRAWS_READ(rules, draw, draws_index("opengl vulkan d3d", value));
  DRAWS_READ(width, draw, draws_uint(value));
  DRAWS_READ(height, draw, draws_uint(value));
  DRAWS_READ(samples, draw, draws_uint(value));
  DRAWS_READ(viewport_x, draw, draws_float(value));
  DRAWS_READ(viewport_y, draw, draws_float(value));
  DRAWS_READ(viewport_width, draw, draws_float(value));
  DRAWS_READ(viewport_height, draw, draws_float(value));
  DRAWS_READ(min_depth, draw, draws_float(value));
  DRAWS_READ(max_depth, draw, draws_float(value));
  DRAWS_READ(scissor_x, draw, draws_int(value));
  DRAWS_READ(scissor_y, draw, draws_int(value));
  DRAWS_READ(scissor_width, draw, draws_int(value));
  DRAWS_READ(scissor_height, draw, draws_int(value));
  DRAWS_READ(cull, draw, draws_index("none back front", value));
  DRAWS_READ(front_face, draw, draws_index("ccw cw", value));
  DRAWS_READ(depth_test, draw, *value == 't');
  DRAWS_READ(depth_clamp, draw, *value == 't');
  DRAWS_READ(depth_clear, draw, draws_float(value));
  DRAWS_READ(bias_constant, draw, draws_float(value));
  DRAWS_READ(bias_slope, draw, draws_float(value));
  DRAWS_READ(bias_clamp, draw, draws_float(value));
  DRAWS_READ(depth_bits, draw, draws_uint(value));
  DRAWS_READ(primitive, draw, draws_index("triangles lines points", value));
  DRAWS_READ(line_mode, draw, draws_index("rectangular parallelogram bresenham", value));
  DRAWS_READ(line_width, draw, draws_float(value));
  DRAWS_READ(point_size, draw, draws_float(value));
  DRAWS_READ(coverage, draw, draws_index("as_asked exact snapped", value));
  DRAWS_READ(subpixel_bits, draw, draws_uint(value));
  DRAWS_READ(rounding, draw, draws_index("nearest_even half_up", value));
  DRAWS_READ(tie_rule, draw, draws_index("as_asked top_left bottom_left", value));
  DRAWS_READ(basis, draw, draws_index("as_asked ideal snapped unspecified", value));
  DRAWS_READ(vertex_count, draw, draws_uint(value));
  DRAWS_READ(triangle_count, draw, draws_uint(value));
  DRAWS_READ(attribute_count, draw, draws_uint(value));
  DRAWS_READ(clip_distance_count, draw, draws_uint(value));
  DRAWS_READ(interpolations, d, value);
  DRAWS_READ(locations, d, value);
  DRAWS_READ(bytes, d, strtoull(value, NULL, 10));
  DRAWS_READ(memory_size, d, strtoull(value, NULL, 10));
  DRAWS_READ(answer_at, d, strtoull(value, NULL, 10));
#undef DRAWS_READ
}

/* Reads an object. Knows no escapes (there are none in a draw) but skips them in other members. */
static inline void draws_read_line(draws* d) {
  for (const char* p = d->line; *(p += strcspn(p, "\"")) != '\0'; p = draws_after_value(p)) {
    const char* const key = p + 1;
    p = draws_after_text(p);
    const size_t length = (size_t)(p - key) - 1;
    p += strspn(p, " \t:");
    draws_read_member(d, key, length, p);
  }
  d->draw.attributes =
      draws_room(&d->attributes, d->draw.attribute_count * sizeof(rastercheck_attribute));
  draws_read_list(d, d->interpolations, "smooth noperspective flat", 0);
  draws_read_list(d, d->locations, "sample center centroid", 1);
}

static inline void draws_read_arrays(draws* d) {
  rastercheck_draw* const draw = &d->draw;
  if (d->is_shared && d->mapped != d->memory_size) {
    if (d->memory != NULL) munmap(d->memory, d->mapped);
    void* const memory = mmap(NULL, d->memory_size, PROT_READ | PROT_WRITE, MAP_SHARED, 3, 0);
    if (memory == MAP_FAILED) draws_stop("the shared memory cannot be mapped");
    d->memory = memory;
    d->mapped = d->memory_size;
  }
  void* const arrays = d->is_shared ? d->memory : draws_room(&d->arrays, d->bytes);
  if (!d->is_shared && fread(arrays, 1, d->bytes, stdin) != d->bytes) {
    draws_stop("a draw's arrays end early");
  }
  const size_t vertices = draw->vertex_count;
  draw->sample_positions = arrays;
  draw->positions = draw->sample_positions + 2 * (size_t)draw->samples;
  const float* const values = draw->positions + 4 * vertices;
  const float* const distances = values + vertices * draw->attribute_count;
  draw->attribute_values = draw->attribute_count > 0 ? values : NULL;
  draw->clip_distances = draw->clip_distance_count > 0 ? distances : NULL;
  draw->indices = (const void*)(distances + vertices * draw->clip_distance_count);
}

/* Empties the output. Between draws of the same shape it is kept empty: see draws_answer(). */
static inline void draws_make_frame(draws* d) {
  const uint32_t attributes = d->draw.attribute_count;
  const uint64_t samples = (uint64_t)d->draw.width * d->draw.height * d->draw.samples;
  if (d->framed != samples || d->framed_attributes != attributes) {
    const size_t floats = samples * (1 + (size_t)attributes) * sizeof(float);
    uint8_t* const frame = draws_room(&d->frame, floats + samples * (sizeof(uint32_t) + 1));
    memset(frame, 0xFF, floats); /* NaN */
    memset(frame + floats, 0, samples * (sizeof(uint32_t) + 1));
    d->output.depth = (void*)frame;
    d->output.attributes = attributes > 0 ? d->output.depth + samples : NULL;
    d->output.triangle = (void*)(frame + floats);
    d->output.coverage = (void*)(d->output.triangle + samples);
    d->framed = samples;
    d->framed_attributes = attributes;
  }
  memset(d->message, 0, sizeof(d->message));
  d->output.size = sizeof(d->output);
  d->output.min_x = d->output.min_y = 0;
  d->output.max_x = d->draw.width;
  d->output.max_y = d->draw.height;
  d->output.message = d->message;
  d->output.message_size = sizeof(d->message) - 1;
}

/* Makes a text plain: whatever is not ASCII, or needs an escape in JSON, becomes a blank. */
static inline void draws_make_plain(char* text) {
  for (; *text != '\0'; ++text) {
    if (*text < ' ' || *text > '~' || *text == '"' || *text == '\\') *text = ' ';
  }
}

/* Reads RasterCheck's hello. The program's own, a line, has to be written to d->answers. */
static inline void draws_begin(draws* d) {
  /* Whatever else is written to standard output goes to standard error. */
  d->answers = fdopen(dup(STDOUT_FILENO), "wb");
  if (d->answers == NULL || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) draws_stop("no output");
  setvbuf(d->answers, NULL, _IONBF, 0); /* each answer is written at once */
  setvbuf(stdin, NULL, _IOFBF, 1 << 20);
  if (fgets(d->line, sizeof(d->line), stdin) == NULL) draws_stop("no input");
}

/* Reads a draw; false at the end of the input. */
static inline bool draws_next(draws* d) {
  if (fgets(d->line, sizeof(d->line), stdin) == NULL) return false;
  d->draw.size = sizeof(d->draw);
  draws_read_line(d);
  draws_read_arrays(d);
  draws_make_frame(d);
  return true;
}

/* Appends numbers begin to end of an array to an answer, and fills them with what was there before
 * the draw. */
static inline uint8_t* draws_take(uint8_t* to, void* array, size_t begin, size_t end, int filling) {
  uint8_t* const from = (uint8_t*)array + begin * sizeof(uint32_t);
  const size_t bytes = (end - begin) * sizeof(uint32_t);
  memcpy(to, from, bytes);
  memset(from, filling, bytes);
  return to + bytes;
}

/* Answers with what is in the output, and empties it. */
static inline void draws_answer(draws* d) {
  const rastercheck_output* const out = &d->output;
  const size_t samples = d->draw.samples, values = d->draw.attribute_count, width = d->draw.width;
  size_t min_x = width, min_y = d->draw.height, max_x = 0, max_y = 0;
  if (out->min_x > out->max_x || out->max_x > width || out->max_y > d->draw.height) {
    draws_stop("the rasterizer gave an invalid rectangle");
  }
  for (size_t y = out->min_y; y < out->max_y; ++y) {
    const uint8_t* const row = out->coverage + y * width * samples;
    const size_t begin = out->min_x * samples, end = out->max_x * samples;
    const uint8_t* const first = memchr(row + begin, 1, end - begin);
    if (first == NULL) continue;
    size_t last = end - 1;
    while (row[last] != 1) --last;
    const size_t first_x = (size_t)(first - row) / samples, last_x = last / samples;
    if (first_x < min_x) min_x = first_x;
    if (last_x >= max_x) max_x = last_x + 1;
    if (y < min_y) min_y = y;
    max_y = y + 1;
  }
  if (max_y == 0) min_x = min_y = 0;
  const size_t bytes = (max_x - min_x) * (max_y - min_y) * samples * (2 + values) * sizeof(float);
  char* const line = draws_room(&d->answer, 256 + bytes);
  const int length = sprintf(
      line,
      "{\"status\":\"ok\",\"min_x\":%zu,\"min_y\":%zu,\"max_x\":%zu,\"max_y\":%zu,\"bytes\":%zu}\n",
      min_x, min_y, max_x, max_y, bytes);
  uint8_t* to = d->is_shared ? d->memory + d->answer_at : (uint8_t*)line + length;
  for (size_t part = 0; part < 3; ++part) {
    for (size_t y = min_y; y < max_y; ++y) {
      const size_t begin = (y * width + min_x) * samples, end = (y * width + max_x) * samples;
      for (size_t i = begin; part == 0 && i < end; ++i) {
        out->triangle[i] = out->coverage[i] == 1 ? out->triangle[i] + 1 : 0;
      }
      if (part == 0) to = draws_take(to, out->triangle, begin, end, 0);
      if (part == 1) to = draws_take(to, out->depth, begin, end, 0xFF);
      if (part == 2 && values > 0)
        to = draws_take(to, out->attributes, begin * values, end * values, 0xFF);
    }
  }
  memset(out->coverage + out->min_y * width * samples, 0,
         (out->max_y - out->min_y) * width * samples);
  fwrite(line, 1, (size_t)length + (d->is_shared ? 0 : bytes), d->answers);
}

/* Answers "unsupported" or "failed", with the message in the output. */
static inline void draws_refuse(draws* d, const char* status) {
  d->framed = 0; /* whatever was drawn before */
  draws_make_plain(d->message);
  fprintf(d->answers, "{\"status\":\"%s\",\"message\":\"%s\"}\n", status, d->message);
}

#endif
